;;; (bight view chart) --- curves and how gnuplot draws them.
;;;
;;; A chart has named curves of (x y) rows, words for its axes, and events, which are marked along x.  Curves of
;;; one unit share a panel with one axis; panels stand one below the other on a common axis of x.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view chart)
  #:use-module ((bight core errors) #:select (bight-raise))
  #:use-module (bight core programs)
  #:use-module (bight core record)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (make-chart
            chart?
            chart-title
            chart-x
            chart-y
            chart-log
            chart-curves
            chart-events
            unit-of-words
            draw-chart
            kind-of
            ;; For those who draw other things with gnuplot.
            gnuplot-output gnuplot-quoted gnuplot-terminal picture-kind))

(define-record <chart>
  (make-chart title x y log curves events)
  chart?
  (title chart-title)                   ; or #f
  (x chart-x)                           ; words
  (y chart-y)                           ; words, or "": by the units of the curves
  (log chart-log)                       ; "", "x", "y" or "xy"
  (curves chart-curves)                 ; an alist of names, strings, and rows (x y)
  (events chart-events))                ; an alist of places along x and words


;;; Units.

(define words-of-units
  ;; A word that is part of a name, and the unit of what is called so; "" is a bare number.
  '(("tension" . "N") ("tensions" . "N") ("force" . "N") ("thrust" . "N") ("thrusts" . "N") ("curvature" . "1/m")
    ("depth" . "m") ("altitude" . "m") ("length" . "m") ("distance" . "m") ("excess" . "m") ("clearance" . "m")
    ("sag" . "m") ("position" . "m") ("estimate" . "m") ("speed" . "m/s") ("velocity" . "m/s") ("current" . "m/s")
    ("heading" . "degrees") ("bearing" . "degrees") ("pitch" . "degrees") ("roll" . "degrees")
    ("turns" . "turns") ("winding" . "turns") ("slack" . "") ("wear" . "")))

(define (unit-of-words name)
  "Return the unit, a string, of what NAME, an expression as text, tells: of the words in it that have one, if
they agree, else the empty string."
  (let ((units (delete-duplicates
                (filter-map (lambda (word) (assoc-ref words-of-units word))
                            (string-tokenize name char-set:letter)))))
    (if (and (pair? units) (null? (cdr units))) (car units) "")))

(define (panels-of chart)
  ;; A list of (LABEL CURVE ...), a unit each.
  (define curves (chart-curves chart))
  (define (label unit group)
    (let ((unit (if (string-null? unit) '() (list unit))))
      (string-join (if (null? (cdr group)) (cons (caar group) unit) unit) ", ")))
  (if (not (string-null? (chart-y chart)))
      (list (cons (chart-y chart) curves))
      (let ((units (delete-duplicates (map (lambda (curve) (unit-of-words (car curve))) curves))))
        (map (lambda (unit)
               (let ((group (filter (lambda (curve) (string=? unit (unit-of-words (car curve)))) curves)))
                 (cons (label unit group) group)))
             units))))


;;; gnuplot.

(define (gnuplot-quoted text)
  "Return TEXT as gnuplot reads it, between single quotes."
  (string-append "'" (string-join (string-split (string-delete #\newline text) #\') "''") "'"))

(define (gnuplot-terminal kind size)
  "Return the words with which gnuplot draws a picture of KIND (svg, png, text), SIZE (WIDTH . HEIGHT)."
  (case kind
    ((svg) (simple-format #f "svg size ~a,~a dynamic background rgb 'white'" (car size) (cdr size)))
    ((png) (simple-format #f "pngcairo size ~a,~a" (car size) (cdr size)))
    (else (simple-format #f "dumb size ~a,~a noenhanced" (car size) (cdr size)))))

;;; What gnuplot reads.

;; Told apart by the colour-blind (Okabe and Ito, 2008).
(define colors '("#0072b2" "#d55e00" "#009e73" "#cc79a7" "#e69f00" "#56b4e9" "#000000"))

(define most-words 12)                  ; of events that are written out

(define (print-events events kind words? port)
  ;; A line for each of EVENTS; their words too if WORDS?, those that would stand on others left out.
  (let* ((places (map car events))
         (gap (if (null? places) 0 (* 0.02 (max 1e-9 (- (apply max places) (apply min places)))))))
    (let loop ((rest events) (last -inf.0) (written 0))
      (unless (null? rest)
        (let ((at (caar rest)) (text? (eq? kind 'text)))
          (simple-format port "set arrow from first ~a, graph 0 to first ~a, graph 1 nohead back lc rgb '#999999' dt 2\n"
                         at at)
          (cond ((and words? (< written most-words) (>= (- at last) gap))
                 (if text?
                     (simple-format port "set label ~a at first ~a, graph ~a\n" (gnuplot-quoted (cdar rest)) at
                                    (- 0.95 (* 0.1 (modulo written 4))))
                     (simple-format port "set label ~a at first ~a, graph 0.98 right rotate by 90 offset 0.7,0 \
font ',9' tc rgb '#555555' noenhanced\n" (gnuplot-quoted (cdar rest)) at))
                 (loop (cdr rest) at (+ 1 written)))
                (else (loop (cdr rest) last written))))))))

(define (print-head chart kind size panels port)
  (simple-format port "set term ~a\nset encoding utf8\nset grid\n"
                 (gnuplot-terminal kind (if (eq? kind 'text)
                                            (cons (car size) (max 10 (quotient (cdr size) (length panels))))
                                            size)))
  (unless (string-null? (chart-log chart))
    (simple-format port "set logscale ~a\nset format ~a '%.0e'\n" (chart-log chart) (chart-log chart)))
  (let ((title (gnuplot-quoted (or (chart-title chart) ""))))
    (cond ((or (null? (cdr panels)) (eq? kind 'text))
           (when (chart-title chart) (simple-format port "set title ~a noenhanced\n" title)))
          (else
           ;; The panels' left and right sides are in line.
           (simple-format port "set tics font ',9'\nset lmargin 11\nset rmargin 3\nset multiplot layout ~a,1~a\n" (length panels)
                          (if (chart-title chart) (string-append " title " title " noenhanced") ""))))))

(define (dive-of name)
  ;; "calm" of "calm (max-tension)", and "" of "(max-tension)".
  (string-trim-both (substring name 0 (or (string-index name #\() 0))))

(define (look-of curves i)
  ;; The colour and dashes of the I-th of CURVES: a colour for each dive in all panels, else for each curve.
  (let* ((dives (map (lambda (curve) (dive-of (car curve))) curves))
         (dive (list-ref dives i))
         (number (lambda (n) (modulo n (length colors)))))
    (if (string-null? dive)
        (cons (list-ref colors (number i)) 1)
        (cons (list-ref colors (number (place-of-dive dive)))
              (+ 1 (count (lambda (other) (string=? other dive)) (take dives i)))))))

(define places-of-dives (make-parameter '())) ; their names, in order

(define (place-of-dive dive)
  (or (list-index (lambda (name) (string=? name dive)) (places-of-dives)) 0))

(define (print-curves curves style kind port)
  (simple-format port "plot ~a\n"
                 (string-join
                  (map (lambda (curve i)
                         (let ((look (look-of curves i)))
                           (simple-format #f "'-' ~a with ~a lc rgb '~a' dt ~a"
                                          (if (or (string-null? (car curve))
                                                  (and (null? (cdr curves)) (not (eq? kind 'text))))
                                              "notitle"
                                              (string-append "title " (gnuplot-quoted (car curve))))
                                          style (car look) (cdr look))))
                       curves (iota (length curves)))
                  ", "))
  (for-each (lambda (curve)
              (for-each (lambda (row)
                          (simple-format port "~a ~a\n" (exact->inexact (first row))
                                         (exact->inexact (second row))))
                        (cdr curve))
              (display "e\n" port))
            curves))

(define (x-range chart)
  ;; Where all curves lie, so that all panels have one time axis.
  (let ((xs (append-map (lambda (curve) (map first (cdr curve))) (chart-curves chart))))
    (values (apply min xs) (apply max xs))))

(define (print-script chart kind size port)
  (let ((panels (panels-of chart)))
    (places-of-dives (delete-duplicates (map (lambda (curve) (dive-of (car curve))) (chart-curves chart))))
    (print-head chart kind size panels port)
    (when (and (pair? (cdr panels)) (string-null? (chart-log chart)))
      (call-with-values (lambda () (x-range chart))
        (lambda (low high)
          (when (< low high)
            (simple-format port "set xrange [~a:~a]\n" (exact->inexact low) (exact->inexact high))))))
    (for-each
     (lambda (panel i)
       (let ((last? (= i (- (length panels) 1))))
         (simple-format port "unset arrow\nunset label\nset xlabel ~a noenhanced\nset ylabel ~a noenhanced\n"
                        (gnuplot-quoted (if (or last? (eq? kind 'text)) (chart-x chart) ""))
                        (gnuplot-quoted (car panel)))
         (print-events (chart-events chart) kind (zero? i) port)
         (simple-format port "set key ~a noenhanced\n"
                        (cond ((eq? kind 'text) "below")
                              ((null? (cdr panels)) "outside")
                              (else "above left horizontal font ',9' height 0.3")))
         (print-curves (cdr panel) (if (string-null? (chart-log chart)) "lines lw 2" "linespoints")
                       kind port)))
     panels (iota (length panels)))))

;;; Running it.

(define (gnuplot-output proc print)
  "Return the bytes that gnuplot makes of the script that PRINT, a procedure of a port, prints.  Raise a
&bight-error from PROC if it makes none."
  (unless (program? "gnuplot")
    (bight-raise 'unsupported proc "plots are drawn by gnuplot (Debian package: gnuplot-nox), which is missing"))
  (let ((script (temporary-file)) (log (temporary-file)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (call-with-output-file script print #:encoding "UTF-8")
        (or (program-output log "gnuplot" script)
            (bight-raise 'io proc "gnuplot failed: ~a" (or (last-line log) "it says nothing"))))
      (lambda ()
        (false-if-exception (delete-file script))
        (false-if-exception (delete-file log))))))

(define (draw-chart chart kind size)
  "Return the bytes that gnuplot makes of CHART, of KIND and SIZE as `gnuplot-terminal' has them."
  (gnuplot-output 'plot (lambda (port) (print-script chart kind size port))))

(define (kind-of file)
  "Return the kind of picture that the name FILE asks for; text for #f."
  (if file (picture-kind file) 'text))
(define (picture-kind file)
  "Return the kind of picture, svg or png, that the name FILE asks for."
  (cond ((string-suffix-ci? ".svg" file) 'svg)
        ((string-suffix-ci? ".png" file) 'png)
        (else (bight-raise 'domain 'plot "a plot is written as SVG or PNG, by the end of its name, not ~s"
                           file))))
