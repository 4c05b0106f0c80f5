;;; (bight study risk-map) --- where a mission plan fouls the tether: the probability per leg and current.
;;;
;;; The columns are the legs of the study in the order in which they are flown, each measured at its end;
;;; the rows are the currents, or whatever the dives are grouped by.  As a table, or as a picture: the
;;; same as a chart in colours, and beside it the plan, each waypoint in the colour of its mean risk.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study risk-map)
  #:use-module (bight core errors)
  #:use-module ((bight core programs) #:select (check-writable write-bytes))
  #:use-module (bight core record)
  #:use-module (bight study risk)
  #:use-module (bight study sweep-plan)
  #:use-module (bight study sweep-result)
  #:use-module (bight view plot)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-11)
  #:export (risk-map
            risk-map?
            risk-map-cells
            draw-risk-map))

(define-record <risk-map>
  (make-risk-map title measure by legs rows places)
  risk-map?
  (title risk-map-title)
  (measure risk-map-measure)            ; a symbol
  (by risk-map-by)                      ; symbols
  (legs risk-map-legs)                  ; symbols
  (rows risk-map-rows)                  ; (VALUES . SHARES), a share as `share-of' has it for each leg
  (places risk-map-places))             ; for each leg the mean (X Y) of where it ended, or #f

(define head-columns 6)                 ; number, leg, name, x, y, z

(define (place-of plan name) (column-place plan name head-columns))

(define (of-leg leg rows)
  (filter (lambda (row) (string=? (symbol->string leg) (third row))) rows))

(define (measure-to-map plan rows wanted)
  ;; The measure WANTED, or the first that is true or false.
  (let ((measures (plan-fact plan 'measures)))
    (define (fits? name)
      (eq? 'probability (measure-kind plan name (column-of rows (place-of plan name)))))
    (cond ((not wanted)
           (or (find fits? measures)
               (bight-raise 'domain 'sweep "no measure of ~a is true or false, so there is no probability \
to map" (plan-name plan))))
          ((not (memq wanted measures))
           (unknown-name 'sweep "the study" wanted measures "measure"))
          ((fits? wanted) wanted)
          (else
           (bight-raise 'domain 'sweep "~a is not true or false, so there is no probability to map"
                        wanted)))))

(define (mean-place rows)
  (let ((known (filter fourth rows)))
    (and (pair? known)
         (map (lambda (get) (/ (apply + (map get known)) (length known))) (list fourth fifth)))))

(define (risk-map database wanted by)
  "Return the risk map of the result DATABASE: of the measure WANTED, a symbol or #f for the first that is
true or false, grouped BY variables, a string or #f."
  (let* ((plan (found-plan database))
         (rows (leg-rows database plan))
         (legs (plan-fact plan 'legs))
         (variables (group-variables plan by)))
    (when (null? legs)
      (bight-raise 'unsupported 'sweep "~a has no legs; a map needs a study with (leg NAME FORM ...)"
                   (plan-name plan)))
    (when (null? rows)
      (bight-raise 'unsupported 'sweep "no case of ~a is done yet" (plan-name plan)))
    (let ((place (place-of plan (measure-to-map plan rows wanted))))
      (make-risk-map
       (plan-fact plan 'sentence)
       (list-ref (plan-fact plan 'measures)
                 (- place head-columns (length (plan-fact plan 'variables))))
       variables legs
       (map (lambda (group)
              (cons (car group)
                    (map (lambda (leg) (share-of (column-of (of-leg leg (cdr group)) place))) legs)))
            (group-rows rows (map (lambda (name) (place-of plan name)) variables)))
       (map (lambda (leg) (mean-place (of-leg leg rows))) legs)))))


;;; As a table.

(define (csv-shares share)
  (map (lambda (x) (if x (number->string x) "")) (take share 3)))

(define (risk-map-cells map-of csv?)
  "Return MAP-OF as rows of strings, the first their heads."
  (cons (append (map symbol->string (risk-map-by map-of)) '("dives")
                (append-map (lambda (leg)
                              (let ((name (symbol->string leg)))
                                (if csv?
                                    (list name (string-append name "_low") (string-append name "_high"))
                                    (list name))))
                            (risk-map-legs map-of)))
        (map (lambda (row)
               (append (map short (car row))
                       (list (number->string (apply max (map fifth (cdr row)))))
                       (if csv?
                           (append-map csv-shares (cdr row))
                           (map interval->string (cdr row)))))
             (risk-map-rows map-of))))


;;; As a picture.

(define most-labels 600)                ; cells beyond which figures would run into one another

(define (row-label map-of row)
  (string-join (map (lambda (name value) (simple-format #f "~a ~a" name (short value)))
                    (risk-map-by map-of) (car row))
               ", "))

(define (tics labels)
  (string-append "(" (string-join (map (lambda (label i) (simple-format #f "~a ~a" (gnuplot-quoted label) i))
                                       labels (iota (length labels)))
                                  ", ")
                 ")"))

(define (print-data rows port)
  (for-each (lambda (row)
              (display (string-join (map (lambda (v) (object->string v display)) row) " ") port)
              (newline port))
            rows)
  (display "e\n" port))

(define (chart-rows map-of label?)
  ;; (X Y SHARE), or (X Y "35 %"), of each cell that is known.
  (append-map
   (lambda (row y)
     (filter-map (lambda (share x)
                   (and (first share)
                        (list x y (if label?
                                      (simple-format #f "\"~a %\"" (inexact->exact
                                                                    (round (* 100 (first share)))))
                                      (first share)))))
                 (cdr row) (iota (length (cdr row)))))
   (risk-map-rows map-of) (iota (length (risk-map-rows map-of)))))

(define (print-chart map-of port)
  (let* ((rows (risk-map-rows map-of)) (legs (risk-map-legs map-of))
         (labels? (<= (* (length rows) (length legs)) most-labels)))
    (simple-format port "set xtics ~a rotate by -30 noenhanced\nset ytics ~a noenhanced\n"
                   (tics (map symbol->string legs))
                   (tics (map (lambda (row) (row-label map-of row)) rows)))
    (simple-format port "set xrange [-0.5:~a]\nset yrange [~a:-0.5]\n" (- (length legs) 0.5)
                   (- (length rows) 0.5))
    (simple-format port "plot '-' using 1:2:(0.48):(0.48):3 with boxxyerror fs solid 1 lc palette notitle~a\n"
                   (if labels? ", '-' using 1:2:3 with labels noenhanced notitle" ""))
    (print-data (chart-rows map-of #f) port)
    (when labels? (print-data (chart-rows map-of #t) port))))

(define (near? a b)
  (and (< (abs (- (first a) (first b))) 1) (< (abs (- (second a) (second b))) 1)))

(define (label-rows rows)
  ;; (X Y NAMES) of ROWS, as `plan-rows' has them; those that lie within a metre share a label.
  (let loop ((rows rows) (labels '()))
    (if (null? rows)
        (reverse labels)
        (let-values (((here elsewhere) (partition (lambda (row) (near? row (car rows))) rows)))
          (loop elsewhere
                (cons (list (first (car rows)) (second (car rows))
                            (simple-format #f "\"~a\"" (string-join (map fourth here) ", ")))
                      labels))))))

(define (plan-rows map-of)
  ;; (X Y SHARE NAME) of each leg whose end is known.
  (filter-map
   (lambda (leg place i)
     (let* ((shares (map (lambda (row) (list-ref (cdr row) i)) (risk-map-rows map-of)))
            (hits (apply + (map fourth shares))) (n (apply + (map fifth shares))))
       (and place (positive? n)
            (list (first place) (second place) (exact->inexact (/ hits n))
                  (symbol->string leg)))))
   (risk-map-legs map-of) (risk-map-places map-of) (iota (length (risk-map-legs map-of)))))

(define (print-plan map-of port)
  ;; The way from waypoint to waypoint, seen from above, and the mean risk at each.
  (let ((rows (plan-rows map-of)))
    (display "unset xtics\nunset ytics\nset xtics norotate autofreq\nset ytics autofreq
set autoscale x\nset autoscale y
set offsets graph 0.15, graph 0.15, graph 0.15, graph 0.15
set xlabel 'east, m'\nset ylabel 'north, m'\nset size ratio -1
plot '-' using 1:2 with lines lc rgb '#888888' notitle, \
'-' using 1:2:3 with points pt 7 ps 2.5 lc palette notitle, \
'-' using 1:2:3 with labels offset 0,1.2 noenhanced notitle\n" port)
    (print-data rows port)
    (print-data rows port)
    (print-data (label-rows rows) port)))

(define (picture-size map-of)
  (cons (min 4000 (+ 760 (* 90 (length (risk-map-legs map-of)))))
        (min 4000 (max 420 (+ 180 (* 28 (length (risk-map-rows map-of))))))))

(define (print-picture map-of kind port)
  (simple-format port "set term ~a\nset encoding utf8\n" (gnuplot-terminal kind (picture-size map-of)))
  (simple-format port "set multiplot layout 1,2 title ~a noenhanced\n"
                 (gnuplot-quoted (simple-format #f "~a Probability of `~a' after each leg"
                                                (risk-map-title map-of) (risk-map-measure map-of))))
  (display "set cbrange [0:1]\nset palette defined (0 '#f7fbff', 0.25 '#fee391', 0.6 '#fe9929', 1 '#cc2a1e')
unset colorbox\n" port)
  (print-chart map-of port)
  (display "set colorbox\n" port)
  (print-plan map-of port)
  (display "unset multiplot\n" port))

(define (draw-risk-map map-of file)
  "Write MAP-OF to FILE, an SVG or PNG by its name.  Return how many bytes it took."
  (let ((kind (picture-kind file)))
    (check-writable 'sweep file)
    (write-bytes 'sweep (gnuplot-output 'sweep (lambda (port) (print-picture map-of kind port))) file)
    (stat:size (stat file))))
