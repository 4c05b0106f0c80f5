;;; (bight view plot) --- numbers as lines: over time, along the tether, run time against error.
;;;
;;; What is plotted becomes a chart: named curves of (x y) rows, with words for the axes.  gnuplot draws
;;; it, as SVG or PNG in a file, or in characters for the terminal.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view plot)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module ((bight core errors) #:select (bight-raise bight-error?))
  #:use-module (bight core programs)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module ((bight dive task) #:select (every-seconds))
  #:use-module ((bight dive time) #:select (now))
  #:use-module ((bight engine) #:select (%events))
  #:use-module (bight view chart)
  #:use-module ((bight view looks) #:select (prompt-table))
  #:use-module ((bight world) #:select (world-name))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (plot
            sample!
            sample-every
            samples?
            samples-rows
            samples-names
            chart?)
  #:re-export (gnuplot-output gnuplot-quoted gnuplot-terminal picture-kind))


;;; Over time: numbers are gathered while the dive runs.

(define-record <samples>
  (make-samples names dive rows count)
  samples-record?
  (names samples-names)
  (dive samples-dive)                   ; whose they are
  (rows %samples-rows set-samples-rows!) ; (TIME NUMBER ...), the newest first
  (count samples-count set-samples-count!))

(set-record-type-printer!
 <samples>
 (lambda (s port)
   (simple-format port "#<samples of ~a: ~a rows>" (string-join (samples-names s) ", ")
                  (samples-count s))))

(define-argument-type (samples value)
  "samples, as `sample!' returns"
  (if (samples-record? value) value refused))

(define-verb (samples? (object any))
  "Return #t if OBJECT is what `sample!' gathers."
  (samples-record? object))

(define-verb (samples-rows (s samples))
  "Return the rows (TIME NUMBER ...) of the samples S, the oldest first."
  (reverse (%samples-rows s)))

(define most-rows 200000)

(define (number-or-false thunk)
  ;; What THUNK returns if it is a number to plot: a dive may have no answer now and then.
  (let ((value (with-exception-handler
                   (lambda (e) (if (bight-error? e) #f (raise-exception e)))
                 thunk
                 #:unwind? #t)))
    (and (real? value) (< -inf.0 value +inf.0) (exact->inexact value))))

(define (take-sample! samples thunks)
  (when (< (samples-count samples) most-rows)
    (set-samples-count! samples (+ 1 (samples-count samples)))
    (set-samples-rows! samples
                       (cons (cons (now) (map number-or-false thunks)) (%samples-rows samples)))))

(define (sample-every seconds names thunks)
  "Call THUNKS every SECONDS of the dive from now on and keep the numbers they return, under NAMES.  Return
samples, for `plot'."
  (let ((samples (make-samples names (this-dive 'sample!) '() 0)))
    (set! (prompt-table samples) (lambda () (cons (cons "time, s" names) (samples-rows samples))))
    (take-sample! samples thunks)
    (every-seconds seconds (lambda () (take-sample! samples thunks)))
    samples))

(define-syntax-rule (sample! seconds expression expression* ...)
  "Keep what the EXPRESSIONs are, numbers, every SECONDS of the dive from now on; return samples for `plot'."
  (sample-every seconds
                (map (lambda (datum) (object->string datum display)) '(expression expression* ...))
                (list (lambda () expression) (lambda () expression*) ...)))

(define (curves-of samples prefix)
  ;; The curves of SAMPLES, PREFIX before their names.
  (let ((rows (samples-rows samples)))
    (map (lambda (name i)
           (cons (string-append prefix name)
                 (filter-map (lambda (row)
                               (let ((y (list-ref row i))) (and y (list (car row) y))))
                             rows)))
         (samples-names samples) (iota (length (samples-names samples)) 1))))

(define (world-words samples)
  (let ((name (world-name (dive-world (samples-dive samples)))))
    (if name (symbol->string name) "a dive")))

(define (events-of samples)
  ;; What happened in the dive of SAMPLES while they were gathered: (TIME . WORDS).
  (let ((times (map car (samples-rows samples))))
    (filter-map (lambda (event)
                  (and (<= (first times) (second event) (last times))
                       (cons (second event) (symbol->string (first event)))))
                (%events (engine-of (samples-dive samples)) 0))))

(define (chart-of-samples samples)
  (make-chart (world-words samples) "time, s" "" "" (curves-of samples "") (events-of samples)))

(define (named-events dive)
  ;; What happened in DIVE, a name and its samples, with the name before it.
  (map (lambda (event) (cons (car event) (simple-format #f "~a: ~a" (car dive) (cdr event))))
       (events-of (cdr dive))))

(define (chart-of-dives dives)
  ;; DIVES is an alist of names and samples.
  (make-chart (string-join (delete-duplicates (map (lambda (dive) (world-words (cdr dive))) dives)) ", ")
              "time, s" "" ""
              (append-map (lambda (dive)
                            (curves-of (cdr dive) (simple-format #f "~a " (car dive))))
                          dives)
              (sort (append-map named-events dives) (lambda (a b) (< (car a) (car b))))))


;;; Along a tether.

(define profile-points 201)

(define profiles '(tension depth curvature))

(define profile-units '((tension . "tension, N") (depth . "depth, m") (curvature . "curvature, 1/m")))

(define (rows-along length values)
  (let ((n (vector-length values)))
    (map (lambda (i) (list (/ (* length i) (max 1 (- n 1))) (vector-ref values i))) (iota n))))

(define (depths points)
  (list->vector (map (lambda (p) (- (third p))) (array->list points))))

(define (distance a b)
  (sqrt (apply + (map (lambda (x y) (expt (- x y) 2)) a b))))

(define (bend a b c)
  ;; One over the radius of the circle through three points.
  (let* ((ab (distance a b)) (bc (distance b c)) (ca (distance c a))
         (s (/ (+ ab bc ca) 2))
         (area (sqrt (max 0 (* s (- s ab) (- s bc) (- s ca))))))
    (if (< (* ab bc ca) 1e-18) 0.0 (/ (* 4 area) (* ab bc ca)))))

(define (curvatures points)
  (let ((p (list->vector (array->list points))))
    (list->vector
     (map (lambda (i)
            (let ((k (min (max i 1) (- (vector-length p) 2))))
              (bend (vector-ref p (- k 1)) (vector-ref p k) (vector-ref p (+ k 1)))))
          (iota (vector-length p))))))

(define (chart-along what tether)
  (let ((name (or tether (first-tether))))
    (make-chart (simple-format #f "~a, ~a s" name (/ (round (* 100 (now))) 100))
                "arc length from the anchor, m" (assq-ref profile-units what) ""
                (list (cons (symbol->string what)
                            (rows-along (tether-length name)
                                        (case what
                                          ((tension) (list->vector (array->list (tensions name profile-points))))
                                          ((depth) (depths (tether-points name profile-points)))
                                          ((curvature) (curvatures (tether-points name profile-points)))))))
                '())))

(define (first-tether)
  (let ((tethers (filter (lambda (name) (false-if-exception (tether-length name))) (parts))))
    (if (null? tethers)
        (bight-raise 'def 'plot "this dive has no tether to look along")
        (car tethers))))


;;; Run time against error: what `bight bench' wrote.

(define (read-lines file)
  (call-with-input-file file
    (lambda (port)
      (let loop ((lines '()))
        (let ((line (read-line port)))
          (if (eof-object? line) (reverse lines) (loop (cons line lines))))))))

(define (column header name file)
  (or (list-index (lambda (cell) (string=? cell name)) header)
      (bight-raise 'format 'plot "~s has no column ~s: it is no table of a bench" file name)))

(define (bench-rows file)
  ;; (CASE-METRIC-MODEL CPU ERROR) of each row that has both.
  (unless (file-exists? file)
    (bight-raise 'io 'plot "there is no file ~s~a" file (file-meant file)))
  (let* ((rows (map (lambda (line) (map string-trim-both (string-split line #\,))) (read-lines file)))
         (header (if (null? rows) '() (car rows)))
         (places (map (lambda (name) (column header name file))
                      '("case" "model" "metric" "cpu_ns" "error"))))
    (filter-map
     (lambda (row)
       (and (= (length row) (length header))
            (let* ((cells (map (lambda (i) (list-ref row i)) places))
                   (cpu (text->number (fourth cells))) (error (text->number (fifth cells))))
              (and (real? cpu) (real? error)
                   (list (string-join (list (first cells) (third cells) (second cells)) " ")
                         (* 1e-9 cpu) (abs error))))))
     (cdr rows))))

(define (without-zeros rows log)
  ;; The ROWS of a bench that axes with logarithms have a place for.
  (remove (lambda (row)
            (or (and (string-contains log "x") (<= (second row) 0)) (and (string-contains log "y") (zero? (third row)))))
          rows))

(define (title-of-bench file all kept)
  ;; What is left out is told: an exact model's error of 0 would not be missed.
  (let ((n (- (length all) (length kept))))
    (if (zero? n)
        (basename file)
        (simple-format #f "~a (without ~a ~a of 0, for which a logarithm has no place)" (basename file) n
                       (if (= n 1) "row" "rows")))))

(define (chart-of-bench file log)
  (let* ((all (bench-rows file)) (rows (without-zeros all log)))
    (make-chart (title-of-bench file all rows) "CPU, s" "error" "xy"
                (map (lambda (name)
                       (cons name (sort (filter-map (lambda (row) (and (string=? name (car row)) (cdr row)))
                                                    rows)
                                        (lambda (a b) (< (car a) (car b))))))
                     (delete-duplicates (map car rows)))
                '())))


;;; Numbers of one's own.

(define (row? value)
  (and (list? value) (= 2 (length value)) (every real? value)))

(define (curve? value)
  (and (pair? value) (or (string? (car value)) (symbol? (car value)))
       (list? (cdr value)) (every row? (cdr value))))

(define (chart-of-numbers value)
  (make-chart #f "" "" ""
              (if (every row? value)
                  (list (cons "" value))
                  (map (lambda (curve) (cons (object->string (car curve) display) (cdr curve))) value))
              '()))

(define (dive? value)
  ;; Is VALUE a name and the samples of one of several dives?
  (and (pair? value) (or (string? (car value)) (symbol? (car value))) (samples-record? (cdr value))))

(define type:plotted
  (make-argument-type
   'plotted
   (lambda (value)
     (cond ((samples-record? value) value)
           ((memq value profiles) value)
           ((and (string? value) (string-suffix? ".csv" value)) value)
           ((and (list? value) (pair? value) (or (every row? value) (every curve? value) (every dive? value)))
            value)
           (else refused)))
   "what `sample!' returned, or a list of (NAME . SAMPLES) of several dives, tension, depth or curvature (along the tether), the CSV file of a bench, or rows
(X Y), or a list of (NAME ROW ...)"
   profiles))

;; The axes with a logarithm, of what WORD, a keyword's value, says instead of USUAL.
(define (logarithms word usual)
  (case word ((#f) usual) ((none) "") (else (symbol->string word))))

(define (chart-of value tether log)
  (cond ((samples-record? value) (chart-of-samples value))
        ((symbol? value) (chart-along value tether))
        ((string? value) (chart-of-bench value (logarithms log "xy")))
        ((dive? (car value)) (chart-of-dives value))
        (else (chart-of-numbers value))))


(define (check-curves chart)
  (when (every (lambda (curve) (null? (cdr curve))) (chart-curves chart))
    (bight-raise 'def 'plot "there is nothing to plot yet"))
  (make-chart (chart-title chart) (chart-x chart) (chart-y chart) (chart-log chart)
              (remove (lambda (curve) (null? (cdr curve))) (chart-curves chart))
              (chart-events chart)))

(define (with-words chart title x y log)
  (make-chart (or title (chart-title chart)) (or x (chart-x chart)) (or y (chart-y chart))
              (logarithms log (chart-log chart))
              (chart-curves chart) (chart-events chart)))

(define (check-axis chart axis part)
  ;; A logarithm has no place for 0 and below; were such a row left out in silence, nobody would miss it.
  (when (string-contains (chart-log chart) axis)
    (for-each (lambda (curve)
                (let ((row (find (lambda (row) (<= (part row) 0)) (cdr curve))))
                  (when row
                    (bight-raise 'domain 'plot "a logarithmic axis ~a has no place for the row ~s of ~s: leave such rows out, \
or choose others by #:log: none, x or y" axis row (car curve)))))
              (chart-curves chart))))

(define (check-logarithms chart)
  (check-axis chart "x" first)
  (check-axis chart "y" second)
  chart)

(define-argument-type (plot-size value)
  "(WIDTH HEIGHT): pixels in a file, characters in the terminal, from 10 to 8192"
  (if (and (list? value) (= 2 (length value))
           (every (lambda (n) (and (real? n) (integer? n) (<= 10 n 8192))) value))
      (cons (inexact->exact (first value)) (inexact->exact (second value)))
      refused))

(define (terminal-size)
  (let ((columns ((module-ref (resolve-interface '(bight view text)) 'terminal-columns))))
    (cons (max 40 (min 120 columns)) 24)))

(define-verb (plot (what plotted)
                   #:key (to (or-false string)) (of (or-false name)) (title (or-false string))
                   (x (or-false string)) (y (or-false string)) (log (or-false (one-of none x y xy)))
                   (size (or-false plot-size)))
  "Draw WHAT as lines: samples (see `sample!') over time, with what happened as marks, an axis for each
unit; those of several dives, a list of (NAME . SAMPLES), a colour for each; tension, depth or curvature along the tether OF
that name, the only one when left out; run time against error of the CSV file that a bench wrote; or rows
of numbers.  It goes to the file TO, an SVG or PNG by its name, or as characters to the terminal.  TITLE, X
and Y are words to put there, LOG the axes with a logarithmic scale, for numbers above 0, SIZE (WIDTH HEIGHT).  Return what was
written, or the text."
  (let* ((kind (kind-of to))
         (chart (check-logarithms (with-words (check-curves (chart-of what of log)) title x y log)))
         (size (or size (if (eq? kind 'text) (terminal-size) '(800 . 600)))))
    (when to (check-writable 'plot to))
    (let ((bytes (draw-chart chart kind size)))
      (if to
          (begin
            (write-bytes 'plot bytes to)
            (written-note to ", " (number->string (bytevector-length bytes)) " bytes"))
          (written-note (string-trim-both (string-delete #\page (utf8->string bytes)) #\newline))))))
