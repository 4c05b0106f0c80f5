;;; (bight bench) --- run time against error: the programs that measure, their tables and plots.
;;;
;;; Each bench is a program bight-bench-NAME that prints rows of CSV with a header; what it prints is
;;; kept as it is, shown as a table, and plotted by gnuplot where there is one.  Cases called
;;; map-... are drawn as a map of the error over the two numbers of their settings, "X=1;Y=2".
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench)
  #:use-module ((bight engine) #:select (%programs-folder))
  #:use-module (bight errors)
  #:use-module ((ice-9 ftw) #:select (scandir))
  #:use-module (ice-9 popen)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (benches run-benches))

(define prefix "bight-bench-")

(define (bench-program name)
  (string-append (%programs-folder) "/" prefix name))

(define (bench-file? file)
  (and (string-prefix? prefix file)
       (not (string-index file #\.))
       (access? (string-append (%programs-folder) "/" file) X_OK)))

(define (benches)
  "Return the names of the benches there are."
  (map (lambda (file) (substring file (string-length prefix)))
       (or (scandir (%programs-folder) bench-file?) '())))

(define (read-lines port)
  (let ((line (read-line port)))
    (if (eof-object? line) '() (cons line (read-lines port)))))

(define (measure name)
  ;; The lines of CSV that the bench NAME prints.
  (let* ((port (open-pipe* OPEN_READ (bench-program name)))
         (lines (read-lines port))
         (status (close-pipe port)))
    (unless (eqv? 0 (status:exit-val status))
      (bight-raise 'io 'bench "bight-bench-~a failed" name))
    (when (or (null? lines) (null? (cdr lines)))
      (bight-raise 'format 'bench "bight-bench-~a measured nothing" name))
    lines))

(define (columns-of rows names)
  ;; The cells of ROWS, the first of which has the names of the columns, in the order of NAMES.
  (let ((header (car rows)))
    (map (lambda (row)
           (map (lambda (name)
                  (let ((i (list-index (lambda (cell) (string=? cell name)) header)))
                    (if (and i (< i (length row))) (list-ref row i) "")))
                names))
         (cdr rows))))

(define (split-row line)
  (map string-trim-both (string-split line #\,)))

(define (print-table titles rows)
  (let ((widths (apply map (lambda cells (apply max (map string-length cells))) titles rows)))
    (for-each (lambda (row)
                (display (string-trim-right
                          (string-join (map string-pad-right row widths) "  ")))
                (newline))
              (cons* titles (map (lambda (w) (make-string w #\-)) widths) rows))))

(define (write-lines file lines)
  (call-with-output-file file
    (lambda (port) (for-each (lambda (line) (display line port) (newline port)) lines))))

(define (series-of rows)
  ;; The rows (MODEL ERROR CPU) as an alist of models and their rows.
  (map (lambda (model) (cons model (filter (lambda (row) (string=? model (car row))) rows)))
       (delete-duplicates (map car rows))))

(define (plottable row)
  ;; (MODEL ERROR CPU-NS) with numbers, or #f where a logarithm would fail.
  (let ((error (string->number (second row))) (cpu (string->number (third row))))
    (and (real? error) (real? cpu) (positive? cpu)
         (list (first row) (max (abs error) 1e-17) (* 1e-9 cpu)))))

(define (print-plot port title file series)
  (simple-format port "set term svg size 800,600~%set output ~s~%set title ~s noenhanced~%" file title)
  (display "set logscale xy\nset format '%.0e'\nset xlabel 'CPU, s'\nset ylabel 'error'\n" port)
  (display "set grid\nset key outside noenhanced\n" port)
  (simple-format port "plot ~a~%"
                 (string-join (map (lambda (s) (simple-format #f "'-' title ~s with linespoints" (car s)))
                                   series)
                              ", "))
  (for-each (lambda (s)
              (for-each (lambda (row) (simple-format port "~a ~a~%" (third row) (second row)))
                        (sort (cdr s) (lambda (a b) (< (third a) (third b)))))
              (display "e\n" port))
            series))

(define (map-case? name)
  (string-prefix? "map-" name))

(define (setting-pairs setting)
  ;; "X=1;Y=2" as (("X" . "1") ("Y" . "2")).
  (map (lambda (word)
         (let ((parts (string-split word #\=)))
           (cons (car parts) (string-join (cdr parts) "="))))
       (string-split setting #\;)))

(define (places cells)
  ;; The different numbers that CELLS spell, in order, as an alist of spellings and places.
  (let ((spellings (sort (delete-duplicates cells)
                         (lambda (a b) (< (string->number a) (string->number b))))))
    (map cons spellings (iota (length spellings)))))

(define (print-map port title file cells)
  ;; CELLS are (X Y VALUE), where X and Y are pairs (NAME . NUMBER), all spelt out.
  (let ((xs (places (map cdar cells)))
        (ys (places (map cdadr cells)))
        (tics (lambda (places)
                (string-join (map (lambda (place) (simple-format #f "~s ~a" (car place) (cdr place)))
                                  places)
                             ", "))))
    (simple-format port "set term svg size 800,600~%set output ~s~%set title ~s noenhanced~%" file title)
    (simple-format port "set xlabel ~s noenhanced~%set ylabel ~s noenhanced~%"
                   (caaar cells) (caadar cells))
    (simple-format port "set xtics (~a)~%set ytics (~a)~%" (tics xs) (tics ys))
    (when (every (lambda (cell) (positive? (string->number (third cell)))) cells)
      (display "set logscale cb\n" port))
    (display "set palette defined (0 'white', 1 'gold', 2 'red', 3 'black')\n" port)
    (display "set style fill solid noborder\n" port)
    (display "plot '-' using 1:2:(.5):(.5):3 with boxxyerror palette notitle\n" port)
    (for-each (lambda (cell)
                (simple-format port "~a ~a ~a~%" (assoc-ref xs (cdar cell))
                               (assoc-ref ys (cdadr cell)) (third cell)))
              cells)
    (display "e\n" port)))

(define (gnuplot?)
  (any (lambda (folder) (access? (string-append folder "/gnuplot") X_OK))
       (string-split (or (getenv "PATH") "") #\:)))

(define (file-name . words)
  ;; WORDS joined to a name without blanks or slashes.
  (string-map (lambda (c) (if (memv c '(#\space #\/)) #\- c))
              (string-join words "-")))

(define (call-with-gnuplot proc)
  (let ((port (open-output-pipe "gnuplot 2>/dev/null")))
    (proc port)
    (close-pipe port)))

(define (plot title file rows)
  ;; Plot ROWS, lists (SERIES ERROR CPU), as the SVG FILE, if there is a front to see.
  (let ((points (filter-map plottable rows)))
    (when (> (length points) 1)
      (call-with-gnuplot (lambda (port) (print-plot port title file (series-of points)))))))

(define (first-word text)
  (car (string-split text #\space)))

(define (series-row cells)
  ;; (CASE METRIC SERIES ERROR CPU): a model's cold and warm runs are two series.
  (list (first cells) (second cells)
        (string-append (third cells) " " (first-word (fourth cells)))
        (fifth cells) (sixth cells)))

(define (plot-fronts name folder rows)
  ;; One plot for each case and metric but the maps; shares of failures are read in the table.
  (let ((cells (map series-row
                    (columns-of rows '("case" "metric" "model" "setting" "error" "cpu_ns")))))
    (for-each (lambda (front)
                (plot (string-join (cons name front) ", ")
                      (string-append folder "/" (apply file-name name front) ".svg")
                      (filter-map (lambda (row)
                                    (and (equal? front (list (first row) (second row)))
                                         (cddr row)))
                                  cells)))
              (delete-duplicates
               (filter-map (lambda (row)
                             (and (not (map-case? (first row)))
                                  (not (string-contains (second row) "share"))
                                  (list (first row) (second row))))
                           cells)))))

(define (plot-maps name folder rows)
  ;; One picture for each case whose name begins with map-: its errors over the two numbers of its
  ;; settings, "X=1;Y=2".
  (let ((cells (columns-of rows '("case" "metric" "setting" "error"))))
    (for-each (lambda (case)
                (let ((mine (filter (lambda (row) (string=? case (first row))) cells)))
                  (call-with-gnuplot
                   (lambda (port)
                     (print-map port (string-join (list name case (second (car mine))) ", ")
                                (string-append folder "/" (file-name name case) ".svg")
                                (map (lambda (row)
                                       (append (setting-pairs (third row)) (list (fourth row))))
                                     mine))))))
              (delete-duplicates (filter map-case? (map first cells))))))

(define (run-bench name folder)
  (let* ((lines (measure name))
         (rows (map split-row lines))
         (titles '("case" "model" "setting" "metric" "error" "cpu_ns")))
    (write-lines (string-append folder "/" name ".csv") lines)
    (print-table titles (columns-of rows titles))
    (when (gnuplot?)
      (plot-fronts name folder rows)
      (plot-maps name folder rows))))

(define (ensure-folder! folder)
  (unless (file-exists? folder)
    (ensure-folder! (dirname folder))
    (mkdir folder)))

(define (run-benches names folder)
  "Run the benches called NAMES, all there are when it is empty: print their tables, and write CSV files
and plots to FOLDER, which is made if need be."
  (let ((known (benches)))
    (for-each (lambda (name)
                (unless (member name known)
                  (unknown-name 'bench "the list of benches" name known)))
              names)
    (ensure-folder! folder)
    (for-each (lambda (name) (run-bench name folder))
              (if (null? names) known names))))
