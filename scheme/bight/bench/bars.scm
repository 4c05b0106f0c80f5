;;; (bight bench bars) --- "Where the time goes": the parts of each dive as a bar, and what each part of a scene costs.
;;;
;;; A dive is a bar as long as its CPU time is shared out: a piece for each part of bight, in one colour and order for
;;; all dives.  Below stands the table of the bench skip, what a part of a scene adds to a step.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench bars)
  #:use-module ((bight bench plot) #:select (call-with-svg color-of draw-text tenth))
  #:use-module (bight bench row)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core markup) #:select (as-xml))
  #:use-module ((srfi srfi-1) #:hide (tenth))
  #:export (counter-of
            bars-svg
            write-where
            print-where))

(define (counter-of row name)
  "Return the number that the counter NAME of ROW has, or #f."
  (any (lambda (word)
         (and (string-prefix? (string-append name "=") word)
              (text->number (substring word (+ 1 (string-length name))))))
       (string-split (row-counters row) #\;)))

(define (share row) (or (counter-of row "share_percent") 0))

(define (dives rows)
  ;; Lists of the ROWS of one dive, in order.
  (let ((rows (remove row-calibration? rows)))
    (map (lambda (name) (filter (lambda (row) (string=? name (row-case row))) rows))
         (delete-duplicates (map row-case rows)))))

(define (seconds rows)
  ;; The CPU time of a dive, s.
  (* 1e-9 (fold + 0 (filter-map row-cpu rows))))

(define (to-a-tenth x) (/ (round (* 10 x)) 10))


;;; As a picture.

(define left 40)
(define long 640)                       ; of a bar
(define thick 22)
(define apart 50)
(define first-bar 58)

(define (opacity i) (if (< i 8) "0.85" "0.4")) ; colours come round

(define (draw-piece port x y length row i)
  (simple-format port "<rect x='~a' y='~a' width='~a' height='~a' fill='~a' fill-opacity='~a'><title>~a</title></rect>~%"
                 (tenth x) (tenth y) (tenth length) thick (color-of i) (opacity i)
                 (as-xml (simple-format #f "~a: ~a % +- ~a" (row-model row) (to-a-tenth (share row))
                                        (to-a-tenth (or (counter-of row "give_or_take") 0)))))
  (when (> length 60)
    (draw-text port (+ x 4) (+ y 15) (row-model row) "font-size='11'" "fill='white'")))

(define (draw-bar port rows parts y)
  (draw-text port left (- y 5) (simple-format #f "~a: ~a s of CPU" (row-case (car rows)) (to-a-tenth (seconds rows))))
  (fold (lambda (row x)
          (let ((length (* long (/ (share row) 100))))
            (when (positive? length)
              (draw-piece port x y length row (list-index (lambda (part) (string=? part (row-model row))) parts)))
            (+ x length)))
        left rows))

(define (draw-legend port parts)
  (for-each (lambda (part i)
              (let ((y (+ first-bar (* 18 i))))
                (simple-format port "<rect x='~a' y='~a' width='9' height='9' fill='~a' fill-opacity='~a'/>~%"
                               (+ left long 8) y (color-of i) (opacity i))
                (draw-text port (+ left long 20) (+ y 9) part "font-size='10'")))
            parts (iota (length parts))))

(define (bars-svg rows)
  "Return the picture, SVG in a string, of the ROWS of the bench where."
  (let ((parts (delete-duplicates (map row-model rows))) (all (dives rows)))
    (call-with-svg "Where the time goes"
      (lambda (port)
        (draw-legend port parts)
        (for-each (lambda (rows i) (draw-bar port rows parts (+ first-bar (* apart i))))
                  all (iota (length all)))))))


;;; As words.

(define (share-words rows)
  ;; The parts of a dive from the largest on, down to a percent.
  (string-join (map (lambda (row) (simple-format #f "~a ~a" (row-model row) (to-a-tenth (share row))))
                    (sort (filter (lambda (row) (>= (share row) 1)) rows) (lambda (a b) (> (share a) (share b)))))
               ", "))

(define (worst-error rows)
  (to-a-tenth (apply max (map (lambda (row) (or (counter-of row "give_or_take") 0)) rows))))

(define (print-where port rows)
  "Print to PORT the shares in the ROWS of the bench where, a line for each dive."
  (for-each (lambda (rows)
              (simple-format port "~a, ~a s of CPU, in percent, give or take ~a: ~a~%" (row-case (car rows))
                             (to-a-tenth (seconds rows)) (worst-error rows) (share-words rows)))
            (dives rows)))

(define (write-cells port tag cells)
  (simple-format port "<tr>~a</tr>~%"
                 (string-concatenate (map (lambda (cell) (string-append "<" tag ">" (as-xml cell) "</" tag ">")) cells))))

(define (times row)
  (let ((x (counter-of row "times_bare"))) (if x (number->string x) "")))

(define (write-skip port rows)
  ;; The table of the bench skip.
  (display "<h3>What a part of a scene adds</h3><p>A vehicle on 100 intervals of moving line in still water, flown by \
turns with the same and one part more: what a step takes beside the bare one's. The work of absent parts is what was \
counted for parts that a scene lacks.</p><table>" port)
  (write-cells port "th" '("scene" "run by" "times the bare step" "work of absent parts"))
  (for-each (lambda (row)
              (write-cells port "td" (list (row-setting row) (row-model row) (times row)
                                           (if (row-error row) (number->string (row-error row)) ""))))
            (remove row-calibration? rows))
  (display "</table>\n" port))

(define (write-where port where skip)
  "Write to PORT, as HTML, the bars of WHERE, rows of the bench of that name, and the table of SKIP, likewise; either
may be empty."
  (unless (null? where)
    (simple-format port "<figure id='bars'>~a<figcaption>Each bar is the CPU time of a dive, shared out as a clock \
found it: it looked some hundred times a second which code was running, and who had called it. Rest on a piece for its \
share and the share's standard error.</figcaption></figure>~%<pre>~a</pre>~%"
                   (bars-svg where)
                   (as-xml (call-with-output-string (lambda (port) (print-where port where))))))
  (unless (null? skip) (write-skip port skip)))
