;;; (bight bench validation) --- the page of bight bench validation: engine against measurement.
;;;
;;; The program gives rows, each an error with how sure its reference is and what our own intervals are
;;; estimated to cost, and curves.  Here every case gets a sentence, both curves with their difference,
;;; and a verdict: agreement is an error within the reference's uncertainty and twice our own estimate;
;;; anything else is said to differ, by how much, and what is known of why.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench validation)
  #:use-module ((bight bench plot) #:select (call-with-svg color-of draw-line draw-text
                                       (tenth . in-tenths)))
  #:use-module (bight bench report)
  #:use-module (bight bench row)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core markup) #:select (as-xml))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (read-curves verdict-of write-validation))

;;; What the cases are, and what is known of why one differs: a title, a sentence, and that.

(define cases
  '(("tank" "A leaded rope in a tank, led by a vehicle"
     "Filliung et al. (ICRA 2024), cable 6, surge run: 16 places along 2.85 m of rope, motion capture; ours \
follows the measured path of the vehicle. The reference is the authors' own fit to their markers, off from \
these by the uncertainty. Drawn as theirs: the turned catenary nearest to our line, in place of the line."
     "What they publish are turned catenaries fitted to the markers, a frame at a time, not the markers; our line \
and their markers lie equally far beside such curves. Between the curves most is the vertical: the rope hung 1.3 \
degrees beside the one that is told, and with that one, and a drag coefficient of 1.2, ours is nearer.")
    ("cable-1" "A cable swung in air by two robot arms"
     "Chen et al. (CoRL 2024), cable 1 of five, a metre each: motion capture of some twelve markers. Their \
first two and last two are held by the arms and lead ours, the others are what it is held against. Mass and \
bending stiffness are not told: EI by mass per metre is found on the first 2.5 s, and the next 2.5 s, flown on \
without looking, are what counts. The uncertainty is how much the chords between the markers vary in sum."
     "Nothing of the cable is told but its markers. Ours loses nothing as it bends here, and leaves its clamps where two \
markers 2 cm apart point; `identify' finds tilts of 0.1 to 0.7 rad beside these, and with them the damping, and is then \
20 mm off in the mean over the five.")
    ("cable-2" "Another, swung in air" "As cable 1." "As cable 1.")
    ("cable-3" "Another, swung in air" "As cable 1." "As cable 1.")
    ("cable-4" "Another, swung in air" "As cable 1." "As cable 1.")
    ("cable-5" "Another, swung in air" "As cable 1." "As cable 1.")
    ("moordyn-a" "A heavy line at rest" "MoorDyn's case A: 100 m hung between two points 60 m apart, still \
water; held against the elastic catenary." "The line is a chain of straight intervals, of second order.")
    ("moordyn-b" "A neutral line in a current" "MoorDyn's case B: 100 m across a current of 0.5 m/s; held \
against a collocation of the same equations." "The line is a chain of straight intervals, of second order.")
    ("moordyn-c" "The same line, led by a vehicle for a minute" "MoorDyn 2.7.1, its own runs with 200 and 400 \
segments extrapolated. Ours with 200 intervals, and extrapolated likewise from 100 and 200; the plot after it \
weighs work against error."
     "The same line cut into as many straight pieces errs as much in MoorDyn; extrapolated, both agree.")
    ("jumper-1" "A flexible jumper, its top swung along it"
     "Lowe and Langley (OMAE 2006), case 1: 170 m, 0.4 m thick, the top moved by 10 m in 27 s. Their curve was \
read off a printed figure. Ours has run three periods before; how far theirs does not repeat itself a period \
later is counted into its uncertainty."
     "At rest theirs is 11.40 and 45.71 kN; the same line without bending would have 11.47 and 45.72, by the \
elastic catenary. How its ends are held against bending is not said; ours are free to turn. What differs at \
most does so where the tension changes fastest: moved in time by some hundredths of a second, which is how \
well a figure is read, theirs is nearer.")
    ("jumper-2" "The same, swung across" "Lowe and Langley, case 2: the top moved across the jumper."
     "As in case 1.")
    ("jumper-6" "The same in waves across it" "Lowe and Langley, case 6: both ends held, a regular wave of 10 m \
in 10 s across the jumper."
     "Their waves are told as \"Airy wave A=5 m T=10 s\", \"deep-water k=w^2/g\", and so are ours. The first \
harmonic of the tension is alike, the second, which drag makes, is a ninth smaller in theirs; a tenth less drag mends \
it, which in still water would be wrong. How a line that moves feels their waves is not said.")
    ("orcaflex-a1" "A chain on the bottom, its fairlead heaving a little"
     "OrcaFlex, 410 m of chain of 390 kg/m in 50 m of water, half of it on the bottom; as published with \
MoorDyn's tests."
     "How sure the reference is, it does not say. The chain is what OrcaFlex's help makes of studless chain of \
0.14 m bar, and lies as high as that has it: half of 3.35 bars above the bottom, in springs of \"1.0e5 Pa/m\". The rows \
below vary what is not said.")
    ("orcaflex-a2" "The same, heaving hard"
     "As before, with 2.5 times the motion: the tension falls to a third of that at rest."
     "As before; the worst share is where the chain comes down on the bottom and the tension is lowest. Half as many \
intervals move ours by as much.")
    ("table-catenary" "Catenaries" "The inextensible catenary, to 13 digits." "")
    ("table-elastic" "Elastic catenaries" "Irvine's closed form, to 13 digits." "")
    ("table-current" "Lines in uniform, sheared and turning currents" "Both ends held, in three dimensions; \
integrated elsewhere to nine digits." "The table's own digits end there.")
    ("table-free-end" "Towed bodies and thrusting vehicles" "A line marched from the force at its lower end; \
integrated elsewhere to nine digits." "The table's own digits end there.")
    ("table-neutral" "A neutral line in a current without drag along it" "Its shape is a catenary, its tension \
the same everywhere: exact." "")
    ("table-sinking" "A line that sinks flat" "Its speed is vt tanh (t/tau): exact. The moving line, in steps \
of 0.2 ms." "")
    ("table-point-load" "A cable with a load on it" "Michalos and Birnstiel's cable of 1000 feet, with 8 kip at a \
joint and without: two elastic catenaries, to ten digits. The moving line at rest."
     "The line is a chain of straight intervals, of second order.")))

(define (case-ref name k)
  (let ((found (assoc name cases)))
    (if found (list-ref found k) (if (= k 1) name ""))))


;;; Verdicts.

(define (counter row name)
  ;; The number NAME among the counters of ROW, or #f.
  (any (lambda (pair)
         (and (string-prefix? (string-append name "=") pair)
              (text->number (substring pair (+ 1 (string-length name))))))
       (string-split (row-counters row) #\;)))

(define (varied? row)
  (and (counter row "varied") #t))

(define (judged? row)
  (and (row-error row) (null? (row-ratios row)) (not (varied? row))))

(define (agrees? row)
  ;; Never with what is not known to be sure.
  (and=> (row-uncertainty row)
         (lambda (u) (<= (row-error row) (+ u (* 2 (or (counter row "own") 0)))))))

(define (verdict-of row)
  "Return what ROW, an error and what it is sure to, comes to: words."
  (let ((e (row-error row)) (u (row-uncertainty row)))
    (cond ((not e) "left out: its file is not there")
          ((inf? e) "failed")
          ((varied? row) "if it were so")
          ((and u (<= e u)) "agrees within the reference's uncertainty")
          ((agrees? row) "agrees within that and what our own intervals cost")
          (u (simple-format #f "differs by ~a, ~a times the reference's uncertainty" (short-number e)
                            (short-number (/ e u))))
          (else (simple-format #f "differs by ~a; how sure the reference is, is not known"
                               (short-number e))))))

(define (case-verdict rows)
  ;; In a few words, of the judged ROWS of a case.
  (let ((off (remove agrees? rows)))
    (cond ((null? rows) "")
          ((null? off) "Agrees.")
          ((= (length off) (length rows)) "Differs.")
          (else (simple-format #f "Agrees in ~a of ~a." (- (length rows) (length off)) (length rows))))))


;;; Curves.

(define (read-curves file)
  "Return what is drawn of each case in FILE: an alist from (CASE AXES) to alists from a line's name to its
points, pairs of numbers; all in the order of the file."
  (let ((rows (read-csv (call-with-input-file file
                          (lambda (port)
                            (let loop ((lines '()))
                              (let ((line (read-line port)))
                                (if (eof-object? line) (reverse lines) (loop (cons line lines)))))))))
        (table (make-hash-table))
        (order '()))
    (for-each (lambda (row)
                (let ((key (map cdr (list-head row 3)))
                      (point (cons (text->number (assoc-ref row "x")) (text->number (assoc-ref row "y")))))
                  (unless (hash-ref table key) (set! order (cons key order)))
                  (when (and (real? (car point)) (real? (cdr point)))
                    (hash-set! table key (cons point (hash-ref table key '()))))))
              rows)
    (let ((keys (reverse order)))
      (map (lambda (chart)
             (cons chart
                   (filter-map (lambda (key)
                                 (and (equal? chart (list-head key 2))
                                      (cons (third key) (reverse (hash-ref table key '())))))
                               keys)))
           (delete-duplicates (map (lambda (key) (list-head key 2)) keys))))))

(define (difference lines)
  ;; The points of the first of two LINES less those of the second, where both have the same x, or #f.
  (and (= 2 (length lines))
       (let ((a (cdr (first lines))) (b (cdr (second lines))))
         (and (= (length a) (length b))
              (every (lambda (p q) (= (car p) (car q))) a b)
              (map (lambda (p q) (cons (car p) (- (cdr p) (cdr q)))) a b)))))

(define (nice-step span)
  ;; About a sixth of SPAN, in 1, 2 or 5.
  (let* ((raw (/ span 6.)) (unit (expt 10. (floor (/ (log raw) (log 10))))) (m (/ raw unit)))
    (* unit (cond ((< m 1.5) 1) ((< m 3.5) 2) ((< m 7.5) 5) (else 10)))))

(define (range-of numbers)
  (let ((low (apply min numbers)) (high (apply max numbers)))
    (if (< low high) (cons low high) (cons (- low 1) (+ high 1)))))

(define (tics range)
  (let ((step (nice-step (- (cdr range) (car range)))))
    (let loop ((k (ceiling (/ (car range) step))) (all '()))
      (if (> (* k step) (cdr range)) (reverse all) (loop (+ k 1) (cons (* k step) all))))))

(define (scale range from to)
  (lambda (x) (+ from (* (- to from) (/ (- x (car range)) (- (cdr range) (car range)))))))

(define left 90)
(define right 560)

(define (draw-panel port lines xs top bottom title colors)
  ;; LINES over the range XS between the heights TOP and BOTTOM.
  (let* ((ys (range-of (map cdr (append-map cdr lines))))
         (x (scale xs left right)) (y (scale ys bottom top)))
    (for-each (lambda (v)
                (draw-line port left (y v) right (y v) "stroke='#d0d7de'")
                (draw-text port (- left 6) (+ 4 (y v)) (short-number v) "text-anchor='end'"))
              (tics ys))
    (for-each (lambda (v) (draw-line port (x v) top (x v) bottom "stroke='#d0d7de'")) (tics xs))
    (draw-text port 0 0 title "text-anchor='middle'"
               (simple-format #f "transform='translate(18 ~a) rotate(-90)'" (in-tenths (/ (+ top bottom) 2))))
    (for-each (lambda (line color)
                (simple-format port "<polyline fill='none' stroke='~a' stroke-width='1.5' points='~a'/>~%" color
                               (string-join (map (lambda (p)
                                                   (string-append (in-tenths (x (car p))) "," (in-tenths (y (cdr p)))))
                                                 (cdr line)))))
              lines colors)))

(define (split-axes axes)
  ;; "Y over X" as a pair.
  (let ((i (string-contains axes " over ")))
    (if i (cons (substring axes 0 i) (substring axes (+ i 6))) (cons axes ""))))

(define (chart-svg title axes lines)
  ;; LINES, and below them the difference if they are two over the same places.
  (let* ((off (difference lines))
         (names (split-axes axes))
         (xs (range-of (map car (append-map cdr lines))))
         (x (scale xs left right))
         (colors (map color-of (iota (length lines)))))
    (call-with-svg title
      (lambda (port)
        (draw-panel port lines xs 40 (if off 270 385) (car names) colors)
        (when off
          (draw-panel port (list (cons "" off)) xs 290 385 "difference" '("#57606a")))
        (for-each (lambda (v) (draw-text port (x v) 401 (short-number v) "text-anchor='middle'")) (tics xs))
        (draw-text port (/ (+ left right) 2) 424 (cdr names) "text-anchor='middle'")
        (for-each (lambda (line color i)
                    (draw-line port (+ right 10) (+ 50 (* 18 i)) (+ right 26) (+ 50 (* 18 i))
                               (simple-format #f "stroke='~a' stroke-width='3'" color))
                    (draw-text port (+ right 30) (+ 54 (* 18 i)) (car line) "font-size='11'"))
                  lines colors (iota (length lines)))))))


;;; The page.

(define style "body{font:14px/1.5 sans-serif;margin:2em auto;max-width:900px;padding:0 1em;color:#24292f}\
table{border-collapse:collapse;font-size:12px;margin:1em 0}td,th{padding:2px 8px;text-align:left;\
border-bottom:1px solid #d0d7de}tr.off{background:#fff8c5}tr.varied{color:#57606a}\
pre{background:#f6f8fa;padding:1em;white-space:pre-wrap}svg{max-width:100%;height:auto}b{font-size:15px}")

(define (write-row port row)
  (simple-format port "<tr~a>~a</tr>~%"
                 (cond ((varied? row) " class='varied'")
                       ((and (row-error row) (not (agrees? row))) " class='off'")
                       (else ""))
                 (string-concatenate
                  (map (lambda (cell) (string-append "<td>" (as-xml cell) "</td>"))
                       (list (row-setting row) (row-metric row) (short-number (row-error row))
                             (short-number (row-uncertainty row)) (short-number (counter row "own"))
                             (row-reference row) (verdict-of row))))))

(define (write-rows port rows)
  (display "<table><tr><th>setting</th><th>difference, in</th><th></th><th>reference's uncertainty</th>\
<th>our own</th><th>against</th><th>verdict</th></tr>\n" port)
  (for-each (lambda (row) (write-row port row)) rows)
  (display "</table>\n" port))

(define (write-case port name rows charts fronts)
  (let* ((shown (filter (lambda (row) (null? (row-ratios row))) rows))
         (judged (filter judged? rows))
         (why (case-ref name 3)))
    (simple-format port "<h2 id='~a'>~a</h2><p>~a</p><p><b>~a</b> ~a</p>~%" name
                   (as-xml (case-ref name 1)) (as-xml (case-ref name 2)) (case-verdict judged)
                   (if (every agrees? judged) "" (as-xml why)))
    (for-each (lambda (chart)
                (display (chart-svg (case-ref name 1) (second (car chart)) (cdr chart)) port))
              (filter (lambda (chart) (string=? name (caar chart))) charts))
    (for-each (lambda (front)
                (when (string=? name (row-case (caar front))) (display (cdr front) port)))
              fronts)
    (write-rows port shown)))

(define (left-out? row)
  (not (row-error row)))

(define (write-page port report charts fronts)
  (let* ((rows (remove row-calibration? (rows-of report "validation")))
         (there (remove left-out? rows))
         (names (delete-duplicates (map row-case there)))
         (judged (filter judged? there)))
    (simple-format port "<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>bight bench \
validation</title><style>~a</style></head><body><h1>Against measurements, other codes and tables</h1>~%\
<p>~a cases, ~a comparisons: ~a agree, ~a differ. An agreement is a difference within the reference's own \
uncertainty and twice what our own intervals and steps are estimated to cost, from a run with half as many. \
What differs is marked, with what is known of why. Grey rows vary what a reference leaves open.</p>~%<pre>~a\
</pre>~%<p>~a</p>~%"
                   style (length names) (length judged) (count agrees? judged)
                   (length (remove agrees? judged))
                   (as-xml (call-with-output-string (lambda (port) (print-head port report))))
                   (string-join (map (lambda (name) (simple-format #f "<a href='#~a'>~a</a>" name name)) names)
                                " &middot; "))
    (for-each (lambda (name)
                (write-case port name (filter (lambda (row) (string=? name (row-case row))) there)
                            charts fronts))
              names)
    (let ((missing (filter left-out? rows)))
      (unless (null? missing)
        (display "<h2>Left out</h2><p>Their files are not in the folder of the data:</p><ul>\n" port)
        (for-each (lambda (row)
                    (simple-format port "<li>~a: ~a</li>~%" (as-xml (case-ref (row-case row) 1))
                                   (as-xml (row-setting row))))
                  missing)
        (display "</ul>\n" port)))
    (display "</body></html>\n" port)))

(define (print-verdicts report)
  ;; A line for each case.
  (let ((rows (remove row-calibration? (rows-of report "validation"))))
    (for-each (lambda (name)
                (let ((of (filter (lambda (row) (string=? name (row-case row))) rows)))
                  (simple-format #t "~a ~a~%" (string-pad-right name 16)
                                 (if (any left-out? of)
                                     (string-append "left out: " (row-setting (find left-out? of)) " is not there")
                                     (case-verdict (filter judged? of))))))
              (delete-duplicates (map row-case rows)))))

(define (write-validation folder report fronts)
  "Write validation.html to FOLDER, which has the curves in curves.csv: the page of REPORT, with FRONTS, an
alist from lists of rows to plots; and print a line for each case."
  (let ((charts (read-curves (string-append folder "/curves.csv"))))
    (call-with-output-file (string-append folder "/validation.html")
      (lambda (port) (write-page port report charts fronts))
      #:encoding "UTF-8")
    (print-verdicts report)))
