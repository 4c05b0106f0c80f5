;;; (bight bench report) --- a report of benchmarks: where it was made, as text, CSV, JSON and one page.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench report)
  #:use-module (bight core json)
  #:use-module ((bight bench bars) #:select (print-where write-where))
  #:use-module ((bight bench growth) #:select (print-growth write-growth))
  #:use-module (bight bench plot)
  #:use-module (bight bench row)
  #:use-module (bight core errors)
  #:use-module ((bight core markup) #:select (as-xml csv-line))
  #:use-module (bight core record)
  #:use-module ((bight engine) #:select (%version))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module ((ice-9 threads) #:select (total-processor-count))
  #:use-module (srfi srfi-1)
  #:export (make-report report? report-form report-rounds report-rows report-benches
            report-environment
            environment
            calibration-spread
            noise-words
            rows-of
            print-bench
            print-head
            print-fronts
            short-number
            write-report
            read-report))

(define format-name "bight-bench 1")
(define noisy 0.1)                      ; a calibration that strays further is said to be noisy

(define-record <report>
  (make-report form rounds environment rows)
  report?
  (form report-form)                    ; quick or whole, a string
  (rounds report-rounds)
  (environment report-environment)      ; an alist of strings
  (rows report-rows))

(define (rows-of report bench)
  "Return the rows of REPORT that are of BENCH."
  (filter (lambda (row) (string=? bench (row-bench row))) (report-rows report)))

(define (report-benches report)
  "Return the names of the benches in REPORT."
  (delete-duplicates (map row-bench (report-rows report))))


;;; Where it was made.

(define (first-line file)
  (or (false-if-exception
       (call-with-input-file file
         (lambda (port) (let ((line (read-line port))) (and (string? line) line)))))
      ""))

(define (cpu-model)
  (or (false-if-exception
       (call-with-input-file "/proc/cpuinfo"
         (lambda (port)
           (let loop ()
             (let ((line (read-line port)))
               (cond ((eof-object? line) #f)
                     ((string-prefix? "model name" line)
                      (string-trim-both (substring line (+ 1 (string-index line #\:)))))
                     (else (loop))))))))
      "not known"))

(define (environment compiler flags)
  "Return what a report says of the machine as it is now, and of COMPILER and its FLAGS: an alist."
  `(("version" . ,(%version))
    ("compiler" . ,compiler)
    ("flags" . ,flags)
    ("cpu" . ,(cpu-model))
    ("cpus" . ,(number->string (total-processor-count)))
    ("system" . ,(string-join (list (utsname:sysname (uname)) (utsname:release (uname))
                                    (utsname:machine (uname)))))
    ("load" . ,(string-join (list-head (string-split (first-line "/proc/loadavg") #\space) 1)))
    ("date" . ,(strftime "%Y-%m-%d %H:%M UTC" (gmtime (current-time))))))

(define (calibrations report)
  ;; What the calibration kernel took in REPORT, in ns.
  (append-map row-cpus (filter row-calibration? (report-rows report))))

(define (calibration-spread report)
  "Return how far the calibration strayed over REPORT: within a program, or from one to another."
  (fold max (spread (calibrations report))
        (filter-map row-error (filter row-calibration? (report-rows report)))))

(define (repeat-spread report)
  ;; How far a cost strays over the rounds: the median over the rows; #f of a single round.
  (median (filter-map (lambda (row) (and (> (length (row-ratios row)) 1) (spread (row-ratios row))))
                      (report-rows report))))

(define (percent share)
  (simple-format #f "~a %" (short-number (* 100 share))))

(define (noise-words report)
  "Return a sentence on how quiet the machine was while REPORT was made."
  (let ((calibration (calibration-spread report)) (repeated (repeat-spread report)))
    (string-append
     (if (> calibration noisy) "The machine was noisy" "The machine was quiet")
     ": the calibration kernel strayed by " (percent calibration)
     (if repeated
         (string-append ", the multiples of it by " (percent repeated) " over the rounds, in the median.")
         "; a single round says nothing of the rest."))))


;;; Numbers and tables.

(define (short-number x)
  "Return X, a number or #f, in three digits or so."
  (cond ((not x) "")
        ((inf? x) "inf")
        ((zero? x) "0")
        (else
         (let* ((size (inexact->exact (floor (/ (log (abs x)) (log 10)))))
                (digits (lambda (x places)
                          (let ((unit (expt 10 places)))
                            (number->string (exact->inexact (/ (round (* unit (inexact->exact x)))
                                                               unit)))))))
           (cond ((<= 0 size 6) (tidy (digits x (max 0 (- 2 size)))))
                 ((<= -3 size -1) (tidy (digits x (- 2 size))))
                 (else (string-append (tidy (digits (* x (expt 10. (- size))) 2)) "e"
                                      (number->string size))))))))

(define (tidy text)
  ;; "12.0" is 12.
  (if (string-suffix? ".0" text) (string-drop-right text 2) text))

(define (duration ns)
  ;; With its unit.
  (cond ((not ns) "")
        ((< ns 1e3) (string-append (short-number ns) " ns"))
        ((< ns 1e6) (string-append (short-number (/ ns 1e3)) " us"))
        ((< ns 1e9) (string-append (short-number (/ ns 1e6)) " ms"))
        (else (string-append (short-number (/ ns 1e9)) " s"))))

(define titles '("" "case" "model" "setting" "metric" "error" "CPU" "multiple" "+-" "counters"))

(define (half-spread row)
  (let ((ratios (row-ratios row)))
    (if (> (length ratios) 1) (percent (/ (spread ratios) 2)) "")))

(define (row-cells row)
  (list (if (row-front? row) "*" "")
        (row-case row) (row-model row) (row-setting row) (row-metric row)
        (short-number (row-error row)) (duration (row-cpu row)) (short-number (row-ratio row))
        (half-spread row) (row-counters row)))

(define (print-table port rows)
  "Print ROWS to PORT as a table; those on a front are marked."
  (let* ((cells (cons titles (map row-cells rows)))
         (widths (apply map (lambda column (apply max (map string-length column))) cells)))
    (for-each (lambda (row)
                (display (string-trim-right (string-join (map string-pad-right row widths) "  ")) port)
                (newline port))
              (cons* (car cells) (map (lambda (w) (make-string w #\-)) widths) (cdr cells)))))

(define (print-head port report)
  "Print to PORT where REPORT was made and how to read it."
  (let ((e (report-environment report)))
    (define (of name) (or (assoc-ref e name) ""))
    (simple-format port "bight ~a, ~a form, ~a round~a, ~a~%" (of "version") (report-form report)
                   (report-rounds report) (if (= 1 (report-rounds report)) "" "s") (of "date"))
    (simple-format port "~a (~a processors, load ~a), ~a~%" (of "cpu") (of "cpus") (of "load")
                   (of "system"))
    (simple-format port "~a ~a~%" (of "compiler") (of "flags"))
    (let ((steps (calibrations report)))
      (unless (null? steps)
        (simple-format port "One calibration step, a Runge-Kutta step of a chain of 100 intervals: ~a.~%"
                       (duration (median steps)))))
    (simple-format port "~a~%" (noise-words report))
    (simple-format port "A multiple is CPU time in calibration steps; +- half its spread over the rounds; \
* on the front.~%")))

(define (print-bench port report bench)
  "Print to PORT what BENCH found in REPORT."
  ((if (string=? bench "where") print-where print-table) port (rows-of report bench))
  (print-growth port (rows-of report bench)))

(define (fronts-in rows)
  ;; The fronts among ROWS, one after another, each from its cheapest point on.
  (let ((front (filter row-front? rows)))
    (append-map (lambda (group)
                  (sort (filter (lambda (row) (equal? group (row-group row))) front)
                        (lambda (a b) (< (row-ratio a) (row-ratio b)))))
                (delete-duplicates (map row-group front)))))

(define (print-fronts port report)
  "Print to PORT what is on the fronts of REPORT."
  (for-each (lambda (bench)
              (let* ((rows (rows-of report bench)) (front (fronts-in rows)))
                (simple-format port "~%~a: ~a measurements, ~a on fronts~%" bench
                               (count (lambda (row) (not (row-calibration? row))) rows) (length front))
                (unless (null? front) (print-table port front))))
            (report-benches report)))


;;; Files.

(define columns '("bench" "case" "model" "setting" "metric" "error" "reference" "reference_uncertainty"
                  "cpu_ns" "calibration_ratio" "counters" "ratio_least" "ratio_most" "rounds" "front"))

(define (row->csv row)
  (let ((ratios (row-ratios row)))
    (csv-line (list (row-bench row) (row-case row) (row-model row) (row-setting row) (row-metric row)
                    (row-error row) (row-reference row) (row-uncertainty row)
                    (row-cpu row) (row-ratio row) (row-counters row)
                    (and (pair? ratios) (apply min ratios)) (and (pair? ratios) (apply max ratios))
                    (length ratios) (if (row-front? row) 1 0)))))

(define (write-csv port report)
  (for-each (lambda (line) (display line port) (newline port))
            (cons (csv-line columns) (map row->csv (report-rows report)))))

(define (report->json report)
  `(("format" . ,format-name)
    ("form" . ,(report-form report))
    ("rounds" . ,(report-rounds report))
    ("environment" . ,(report-environment report))
    ("noise" . ,(noise-words report))
    ("rows" . ,(list->vector (map row->json (report-rows report))))))

(define (read-report file)
  "Return the report in FILE, as `write-report' wrote it.  Raise io or format."
  (let ((object (catch 'system-error
                  (lambda () (call-with-input-file file read-json #:encoding "UTF-8"))
                  (lambda _ (bight-raise 'io 'bench "~s cannot be read" file)))))
    (unless (equal? format-name (json-ref object "format"))
      (bight-raise 'format 'bench "~s is no report of bight bench" file))
    (make-report (json-ref object "form") (json-ref object "rounds") (json-ref object "environment")
                 (map json->row (vector->list (json-ref object "rows"))))))

(define (print-text port report)
  (print-head port report)
  (for-each (lambda (bench)
              (simple-format port "~%~a~%~%" (string-upcase bench))
              (print-bench port report bench))
            (report-benches report)))

(define style "body{font:14px/1.4 sans-serif;margin:2em auto;max-width:1100px;padding:0 1em;color:#24292f}\
table{border-collapse:collapse;font-size:12px}td,th{padding:2px 8px;text-align:left;\
border-bottom:1px solid #d0d7de}tr.front{background:#fff8c5}pre{background:#f6f8fa;padding:1em;\
white-space:pre-wrap}figure{margin:1.5em 0}figcaption{max-width:760px;color:#57606a}\
table.glance td{font-size:14px}svg{max-width:100%;height:auto}summary{cursor:pointer;margin:1em 0}")

(define (write-html-table port rows)
  (define (cells tag row)
    (string-concatenate
     (map (lambda (cell) (string-append "<" tag ">" (as-xml cell) "</" tag ">")) row)))
  (simple-format port "<table><tr>~a</tr>~%" (cells "th" titles))
  (for-each (lambda (row)
              (simple-format port "<tr~a>~a</tr>~%" (if (row-front? row) " class='front'" "")
                             (cells "td" (row-cells row))))
            rows)
  (display "</table>\n" port))

(define (best-under rows share)
  ;; The fastest of ROWS whose error is at most SHARE of the greatest, or #f.
  (let* ((most (apply max 0 (map row-error rows)))
         (good (filter (lambda (row) (<= (row-error row) (* share most))) rows)))
    (and (pair? good) (positive? most)
         (car (sort good (lambda (a b) (< (row-ratio a) (row-ratio b))))))))

(define (summary-html report plots)
  ;; What one sees first: what was asked, and of each plot the fastest, and the fastest that is good.
  (define (cell row)
    (if row
        (string-append "<td>" (as-xml (row-model row)) "<br><small>" (as-xml (row-setting row)) "</small></td><td>"
                       (duration (row-cpu row)) "</td>")
        "<td></td><td></td>"))
  (define lines
    (filter-map
     (lambda (plot)
       (let ((rows (car plot)))
         (and (not (row-map? (car rows)))
              (simple-format #f "<tr><td><a href='#~a'>~a, ~a</a></td>~a~a</tr>" (plot-file rows)
                             (as-xml (row-bench (car rows))) (as-xml (row-case (car rows)))
                             (cell (car (sort rows (lambda (a b) (< (row-ratio a) (row-ratio b))))))
                             (cell (best-under rows 0.01))))))
     plots))
  (string-append
   "<p>bight computes how a tether moves. Every computation can be made faster and less exact, or slower and more \
exact: here each was run in many ways, its error was measured against a known answer, and its time on this machine. \
A model is a way to compute; a setting says how finely.</p>"
   (if (null? lines)
       ""
       (string-append
        "<h2>At a glance</h2><table class='glance'><tr><th>what was computed</th><th>fastest way</th><th>CPU</th>\
<th>fastest of those with at most a hundredth of the largest error</th><th>CPU</th></tr>"
        (string-concatenate lines) "</table>"))))

(define (title-of bench)
  (if (string=? bench "where") "Where the time goes" bench))

(define (write-html port report plots)
  (simple-format port "<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>bight bench\
</title><style>~a</style></head><body><h1>Run time against error</h1>~%~a<pre>~a</pre>~%<p>~a</p>~%"
                 style
                 (summary-html report plots)
                 (as-xml (call-with-output-string (lambda (port) (print-head port report))))
                 (string-join (map (lambda (bench) (simple-format #f "<a href='#~a'>~a</a>" bench bench))
                                   (report-benches report))
                              " &middot; "))
  (for-each (lambda (bench)
              (simple-format port "<h2 id='~a'>~a</h2>~%" bench (title-of bench))
              (when (string=? bench "where")
                (write-where port (rows-of report "where") (rows-of report "skip")))
              (for-each (lambda (plot)
                          (when (string=? bench (row-bench (caar plot)))
                            (simple-format port "<figure id='~a'>~a<figcaption>~a</figcaption></figure>~%"
                                           (plot-file (car plot)) (cdr plot) (as-xml (plot-sentence (car plot))))))
                        plots)
              (write-growth port (rows-of report bench))
              (simple-format port "<details><summary>~a rows</summary>~%" (length (rows-of report bench)))
              (write-html-table port (rows-of report bench))
              (display "</details>\n" port))
            (report-benches report))
  (display "</body></html>\n" port))

(define (call-with-file folder name write)
  (call-with-output-file (string-append folder "/" name) write #:encoding "UTF-8"))

(define (write-report folder report)
  "Write REPORT to FOLDER: report.txt, .csv, .json and .html, and its plots as SVG."
  (let ((plots (plots-of (report-rows report))))
    (call-with-file folder "report.txt" (lambda (port) (print-text port report)))
    (call-with-file folder "report.csv" (lambda (port) (write-csv port report)))
    (call-with-file folder "report.json"
                    (lambda (port) (write-json (report->json report) port) (newline port)))
    (for-each (lambda (plot)
                (call-with-file folder (plot-file (car plot)) (lambda (port) (display (cdr plot) port))))
              plots)
    (call-with-file folder "report.html" (lambda (port) (write-html port report plots)))))
