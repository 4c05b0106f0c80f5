;;; (bight identify measured) --- files of what was measured of a line: ends, markers, forces, line out, over time.
;;;
;;; A file is a table with named columns.  The name of a column is words: `t'; `anchor_x', `end_z' or `rov_z' for
;;; the ends; `m3_x' or `m03x' for the third marker; `end_tension' or `anchor_fx' for forces; `out' for the line
;;; that is paid out.  A unit may stand behind a name.  An empty cell or `nan' is what was not seen.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify measured)
  #:use-module (bight core columns)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core table)
  #:use-module (ice-9 regex)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module (srfi srfi-11)
  #:export (read-run run?
            run-file run-times run-ends run-directions run-out run-marker-names run-seen run-forces
            run-sigma run-rows run-markers run-place run-chords run-skipped
            distance-between))

(define-record <run>
  (make-run file times ends directions out marker-names seen forces sigma skipped)
  run?
  (file run-file)
  (times run-times)                     ; f64vector, s from the first row on
  (ends run-ends)                       ; (WINCH-END FAR-END), f64vectors of places, one after the other
  (directions run-directions)           ; likewise, from the winch end to the far end, or #f
  (out run-out)                         ; f64vector, m, or #f
  (marker-names run-marker-names)       ; strings, from the winch end on
  (seen run-seen)                       ; f64vector: x y z of each marker, row by row; NaN: not seen
  (forces run-forces)                   ; (END WIDTH F64VECTOR) ...: a tension of width 1, a force of width 3
  (sigma run-sigma)                     ; f64vector: how sure each row's places are, m, or #f
  (skipped run-skipped))                ; rows without both ends

(document
 (run? "Return true if OBJECT is what was measured in a file.")
 (run-file "Return the name of the file of RUN.")
 (run-times "Return the times of RUN, s from its first row on, an f64vector.")
 (run-ends "Return the places of both ends of RUN, two f64vectors.")
 (run-directions "Return the directions of both ends of RUN, two f64vectors, or #f.")
 (run-out "Return the line that is out in RUN, m, an f64vector, or #f.")
 (run-marker-names "Return the names of the markers of RUN, from the winch end on.")
 (run-seen "Return the places of the markers of RUN, row by row, an f64vector with NaN for what was not seen.")
 (run-forces "Return the forces of RUN, a list of (END WIDTH F64VECTOR).")
 (run-sigma "Return how sure the places of each row of RUN are, m, an f64vector, or #f.")
 (run-skipped "Return how many rows of the file of RUN were left out because an end was not seen."))

(define (run-rows run)
  "Return how many rows RUN has."
  (f64vector-length (run-times run)))

(define (run-markers run)
  "Return how many markers RUN has."
  (length (run-marker-names run)))

(define (run-place run row marker)
  "Return the place, a list, at which MARKER, counted from 0, was seen in ROW of RUN."
  (let ((i (* 3 (+ marker (* row (run-markers run))))))
    (list (f64vector-ref (run-seen run) i) (f64vector-ref (run-seen run) (+ i 1)) (f64vector-ref (run-seen run) (+ i 2)))))

(define (distance-between a b)
  "Return the distance of the points A and B, lists."
  (sqrt (apply + (map (lambda (x y) (* (- x y) (- x y))) a b))))


;;; What the names of columns mean.

(define ends '(("anchor" . 0) ("winch" . 0) ("start" . 0) ("fixed" . 0)
               ("end" . 1) ("far" . 1) ("rov" . 1) ("vehicle" . 1)))

(define axes '(("x" 0 1) ("east" 0 1) ("y" 1 1) ("north" 1 1) ("z" 2 1) ("up" 2 1) ("depth" 2 -1)))

(define marker-name (make-regexp "^(m|marker)_?0*([0-9]+)_?([xyz])(_(m|cm|mm))?$"))

(define (marker-meaning name)
  ;; (marker NUMBER AXIS FACTOR), or #f.
  (let ((found (regexp-exec marker-name (string-downcase name))))
    (and found
         (list 'marker (text->number (match:substring found 2))
               (second (assoc (match:substring found 3) axes))
               (cond ((match:substring found 5)
                      => (lambda (unit) (assoc-ref '(("m" . 1) ("cm" . 1/100) ("mm" . 1/1000)) unit)))
                     (else 1))))))


(define (without-force-unit words)
  ;; WORDS without N or kN at their end, and the factor.
  (cond ((equal? (last words) "n") (values (drop-right words 1) 1))
        ((equal? (last words) "kn") (values (drop-right words 1) 1000))
        (else (values words 1))))

(define (force-meaning name)
  ;; (force END AXIS FACTOR), AXIS #f for a tension, or #f.
  (let*-values (((all factor) (name-words name 'none))
                ((words factor) (if (null? all) (values '("") 1) (without-force-unit all)))
                ((end) (and (= 2 (length words)) (assoc-ref ends (first words))))
                ((what) (and end (second words))))
    (cond ((not end) #f)
          ((member what '("tension" "force" "pull")) (list 'force end #f factor))
          ((assoc-ref '(("fx" . 0) ("fy" . 1) ("fz" . 2)) what) => (lambda (axis) (list 'force end axis factor)))
          (else #f))))

(define (place-meaning name)
  ;; (end END AXIS FACTOR), (out #f #f FACTOR), (sigma ...) or #f.
  (let*-values (((words factor) (name-words name 'length)))
    (cond ((member words '(("out") ("payout") ("paid" "out") ("line" "out"))) (list 'out #f #f factor))
          ((equal? words '("sigma")) (list 'sigma #f #f factor))
          ((and (= 2 (length words)) (assoc (first words) ends) (assoc (second words) axes))
           (let ((axis (assoc (second words) axes)))
             (list 'end (assoc-ref ends (first words)) (second axis) (* factor (third axis)))))
          (else #f))))

(define (meaning name)
  (or (marker-meaning name) (force-meaning name) (place-meaning name)))

(define teaching
  "a run has columns t; anchor_x, anchor_y, anchor_z and end_x, end_y, end_z (or rov_x ...) for the ends; m1_x, m1_y, \
m1_z ... for markers from the anchor on; end_tension, anchor_tension or end_fx ... in newtons; out for the line that \
is paid out; sigma for how sure the places of a row are; a unit may stand behind a name, as in m1_x_mm")


;;; Cells.

(define (cell-value text factor)
  (let ((number (text->number text 10)))
    (if (real? number) (exact->inexact (* factor number)) +nan.0)))


(define (column-of columns . wanted)
  ;; The index and factor of the column whose meaning begins with WANTED, or #f.
  (find (lambda (entry) (equal? wanted (list-head (car entry) (length wanted)))) columns))

(define (values-of table columns kind which axis)
  ;; A procedure from a row of cells to the number there, or #f where there is no such column.
  (let ((entry (column-of columns kind which axis)))
    (and entry
         (let ((index (cdr entry)) (factor (fourth (car entry))))
           (lambda (row)
             (let ((cells (vector-ref table row)))
               (if (< index (vector-length cells)) (cell-value (vector-ref cells index) factor) +nan.0)))))))

(define (all-three proc file names getters what)
  ;; GETTERS if there are three of them, #f if there is none.
  (cond ((every ->bool getters) getters)
        ((any ->bool getters)
         (bight-raise 'format proc "~a has not all of x, y and z of ~a; ~a" file what teaching))
        (else #f)))



(define (point-getters proc file names table columns kind which what)
  (all-three proc file names
             (map (lambda (axis) (values-of table columns kind which axis)) '(0 1 2)) what))

(define (place-in row getters)
  (map (lambda (get) (get row)) getters))

(define (known? place)
  (every (lambda (x) (< -inf.0 x +inf.0)) place))


;;; The ends: columns of their own, or the outermost markers.

(define (marker-numbers columns)
  (sort (delete-duplicates (filter-map (lambda (entry) (and (eq? 'marker (caar entry)) (second (car entry)))) columns)) <))

(define (need proc file thing teaching)
  (bight-raise 'format proc "~a has ~a; ~a" file thing teaching))

(define (end-getters proc file names table columns markers clamped?)
  ;; Two values: what gives the places of both ends, and the numbers of the markers that are no ends.
  (let* ((own (map (lambda (e what) (point-getters proc file names table columns 'end e what))
                   '(0 1) '("the anchor" "the far end")))
         (want (if clamped? 2 1))
         (few (+ (if (first own) 0 want) (if (second own) 0 want))))
    (when (< (length markers) few)
      (need proc file (if (null? markers)
                          (if (first own) "no place of the far end" "no place of the anchor")
                          "fewer markers than stand for its ends") teaching))
    (when (and clamped? (or (first own) (second own)))
      (need proc file "columns for its ends, and clamped ends are told by the first two and last two markers" teaching))
    (let ((marker (lambda (k) (point-getters proc file names table columns 'marker k (simple-format #f "marker ~a" k)))))
      (values (list (or (first own) (marker (list-ref markers (- want 1))))
                    (or (second own) (marker (list-ref (reverse markers) (- want 1)))))
              (and clamped? (list (marker (first markers)) (marker (last markers))))
              (drop-right (drop markers (if (first own) 0 want)) (if (second own) 0 want))))))

(define (flat places)
  (list->f64vector (concatenate places)))

(define (directions-of rows at outer)
  ;; At the winch end from the outer marker to the inner one, at the far end from the inner to the outer.
  (and outer
       (list (flat (map (lambda (row) (map - (place-in row (first at)) (place-in row (first outer)))) rows))
             (flat (map (lambda (row) (map - (place-in row (second outer)) (place-in row (second at)))) rows)))))

(define (forces-of table columns rows)
  (append-map
   (lambda (end)
     (let ((tension (values-of table columns 'force end #f))
           (three (map (lambda (axis) (values-of table columns 'force end axis)) '(0 1 2))))
       (append (if tension (list (list end 1 (list->f64vector (map tension rows)))) '())
               (if (every ->bool three)
                   (list (list end 3 (flat (map (lambda (row) (place-in row three)) rows))))
                   '()))))
   '(0 1)))

(define (check-times proc file times)
  (unless (every (lambda (t) (< -inf.0 t +inf.0)) times)
    (bight-raise 'format proc "~a has a row without a time" file))
  (unless (every < times (append (cdr times) (list +inf.0)))
    (bight-raise 'format proc "the times of ~a do not rise from row to row" file)))

(define least-rows 8)

(define (check-enough proc file rows markers forces)
  (when (< (length rows) least-rows)
    (bight-raise 'format proc "~a has ~a rows in which both ends were seen; ~a are the fewest, and some hundred are \
better" file (length rows) least-rows))
  (when (and (null? markers) (null? forces))
    (need proc file "nothing that was measured of its line: no marker but its ends, and no force" teaching)))

(define* (read-run proc file #:key clamped? sigma)
  "Return what was measured in FILE, a run.  CLAMPED?: its first two and last two markers are held.  SIGMA is the
name of the column that tells how sure a row is, or #f: `sigma', if there is one.  Raise a &bight-error from PROC
of kind io or format."
  (let*-values (((names lines) (read-table proc file))
                ((names) (or names (need proc file "no names of columns" teaching)))
                ((columns) (filter car (map (lambda (name i) (cons (column-meaning name sigma) i))
                                            names (iota (length names)))))
                ((time) (first (named-columns proc file names '(t) teaching)))
                ((table) (list->vector (map (lambda (entry) (list->vector (split-cells (cdr entry)))) lines)))
                ((markers) (marker-numbers columns))
                ((at outer inner) (end-getters proc file names table columns markers clamped?)))
    (when (and sigma (not (column-of columns 'sigma)))
      (bight-raise 'format proc "~a has no column ~s~a" file sigma (did-you-mean sigma names)))
    (let* ((all (iota (vector-length table)))
           (rows (filter (lambda (row) (every (lambda (end) (known? (place-in row end))) at)) all))
           (times (map (lambda (row) (* (column-factor time)
                                        (cell-value (vector-ref (vector-ref table row) (column-index time)) 1)))
                       rows))
           (forces (forces-of table columns rows)))
      (check-enough proc file rows inner forces)
      (check-times proc file times)
      (make-run file (list->f64vector (map (lambda (t) (- t (car times))) times))
                (map (lambda (end) (flat (map (lambda (row) (place-in row end)) rows))) at)
                (directions-of rows at outer)
                (out-of proc file table columns rows)
                (map (lambda (k) (simple-format #f "m~a" k)) inner)
                (seen-of proc file names table columns rows inner)
                forces
                (and=> (values-of table columns 'sigma #f #f) (lambda (get) (list->f64vector (map get rows))))
                (- (length all) (length rows))))))

(define (column-meaning name sigma)
  (if (and sigma (string=? name sigma))
      (call-with-values (lambda () (name-words name 'length)) (lambda (words factor) (list 'sigma #f #f factor)))
      (meaning name)))

(define (out-of proc file table columns rows)
  (let ((get (values-of table columns 'out #f #f)))
    (and get
         (let ((out (map get rows)))
           (unless (every (lambda (x) (and (> x 0) (< x +inf.0))) out)
             (bight-raise 'format proc "~a has a row in which no line is out" file))
           (list->f64vector out)))))

(define (seen-of proc file names table columns rows markers)
  (let ((getters (append-map (lambda (k)
                               (point-getters proc file names table columns 'marker k (simple-format #f "marker ~a" k)))
                             markers)))
    (flat (map (lambda (row) (place-in row getters)) rows))))


;;; Chords.

(define (row-points run row)
  (define (end which)
    (let ((v (list-ref (run-ends run) which)))
      (map (lambda (k) (f64vector-ref v (+ k (* 3 row)))) '(0 1 2))))
  (append (list (end 0)) (map (lambda (m) (run-place run row m)) (iota (run-markers run))) (list (end 1))))

(define (run-chords run)
  "Return the longest chords there ever are in RUN from the winch end to the first marker, from marker to marker, and
from the last to the far end: a line is no shorter between them."
  (let loop ((row 0) (most (make-list (+ 1 (run-markers run)) 0.0)))
    (if (= row (run-rows run))
        most
        (let ((points (row-points run row)))
          (loop (+ row 1)
                (map (lambda (a b most)
                       (let ((d (distance-between a b))) (if (> d most) d most)))
                     (drop-right points 1) (cdr points) most))))))
