;;; The validation page: what it needs, what it says, its verdicts; its program played by a script.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight bench)
             (bight bench report)
             (bight bench row)
             (bight bench validation)
             (ice-9 textual-ports)
             (srfi srfi-1))

(define scratch
  (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-validation-XXXXXX")))

(define (in-scratch . words)
  (string-append scratch "/" (string-concatenate words)))

(define (text-of file)
  (call-with-input-file file get-string-all #:encoding "UTF-8"))

(define header
  "case,model,setting,metric,error,reference,reference_uncertainty,cpu_ns,calibration_ratio,counters")

(define rows
  (list "tank,dynamic,moving,mean distance mm,37,motion capture,43,,,"
        "tank,dynamic,\"moving, otherwise\",mean distance mm,87,motion capture,,,,varied=1"
        "moordyn-c,dynamic,whole,rms distance m,7e-4,MoorDyn,1e-5,,,own=7e-4"
        "jumper-1,dynamic,after that,largest kN,0.5,Lowe,0.1,,,own=0.01"
        "orcaflex-a1,dynamic,all,rms kN,1,OrcaFlex,,,,own=9"
        "jumper-6,dynamic,published/away.csv,left out,,,,,,"
        "calibration,rk4 chain,100 intervals,spread in this run,0.01,,,13000,1,"))

(define curves
  '("case,axes,line,x,y" "tank,\"distance mm over time s\",\"bight\",0,1"
    "tank,\"distance mm over time s\",\"bight\",1,3" "tank,\"distance mm over time s\",\"theirs\",0,1.5"
    "tank,\"distance mm over time s\",\"theirs\",1,2"))

(define (write-lines file lines)
  (call-with-output-file file
    (lambda (port) (for-each (lambda (line) (display line port) (newline port)) lines))))

(define (write-program! . rows)
  ;; A bight-bench-validation that prints ROWS and writes the curves where it is told to.
  (let ((file (in-scratch "bight-bench-validation")))
    (write-lines (in-scratch "rows") (cons header rows))
    (write-lines (in-scratch "curves") curves)
    (write-lines file
                 (list "#!/bin/sh"
                       "while test $# -gt 0; do"
                       (string-append "test \"$1\" = --curves && cp " (in-scratch "curves") " \"$2\"; shift")
                       "done"
                       (string-append "cat " (in-scratch "rows"))))
    (chmod file #o755)))

(define (bench . arguments)
  ;; The status and the words of bight bench with the script for its program.
  (let ((before (getenv "BIGHT_LIBEXEC")) (status #f))
    (dynamic-wind
      (lambda () (setenv "BIGHT_LIBEXEC" scratch))
      (lambda ()
        (let ((words (with-output-to-string (lambda () (set! status (bench-command arguments))))))
          (cons status words)))
      (lambda () (if before (setenv "BIGHT_LIBEXEC" before) (unsetenv "BIGHT_LIBEXEC"))))))

(define (row-of line)
  (first (gather-rows (list (list (cons "validation" (read-csv (list header line))))))))

(define-scenario verdicts-are-honest
  "Within the uncertainty, within what our intervals cost as well, else it differs; never with what is not sure."
  (expect (map (lambda (line) (verdict-of (row-of line))) (list-head rows 6))
          => '("agrees within the reference's uncertainty"
               "if it were so"
               "agrees within that and what our own intervals cost"
               "differs by 0.5, 5 times the reference's uncertainty"
               "differs by 1; how sure the reference is, is not known"
               "left out: its file is not there"))
  (expect (verdict-of (row-of "tank,dynamic,all,m,inf,r,1,,,")) => "failed")
  (expect (verdict-of (row-of "tank,dynamic,all,m,1.5,r,1,,,own=0.2"))
          => "differs by 1.5, 1.5 times the reference's uncertainty"))

(define-scenario curves-are-read
  "Lines by case and axes, in their order."
  (write-lines (in-scratch "curves") curves)
  (expect (read-curves (in-scratch "curves"))
          => '((("tank" "distance mm over time s") ("bight" (0 . 1) (1 . 3)) ("theirs" (0 . 1.5) (1 . 2))))))

(define-scenario data-must-be-there
  "Without a folder of data nothing runs, and it is said which is missing."
  (apply write-program! rows)
  (expect (bench "validation") raises domain)
  (expect (bench "validation" "--data") raises domain)
  (expect (bench "validation" "--data" (in-scratch "nowhere")) raises io)
  (expect (bench "validation" "--data" (in-scratch "rows") "-o" (in-scratch "none")) raises io)
  (expect (file-exists? (in-scratch "none")) => #f))

(define-scenario a-page-is-written
  "Sentence, plot with its difference, rows and verdict of each case; what was left out is named."
  (apply write-program! rows)
  (let* ((said (bench "validation" "--data" scratch "-o" (in-scratch "out")))
         (page (text-of (in-scratch "out/validation.html")))
         (has? (lambda (words) (and (string-contains page words) #t)))
         (order (map (lambda (words) (string-contains page words))
                     '("id='tank'" "id='moordyn-c'" "id='jumper-1'" "id='orcaflex-a1'" "Left out"))))
    (expect (car said) => 0)
    (expect (string-contains (cdr said) "jumper-6         left out: published/away.csv is not there"))
    (expect (string-contains (cdr said) "tank             Agrees."))
    (expect (string-contains (cdr said) "jumper-1         Differs."))
    (expect (and-map number? order))
    (expect (apply < order))
    (expect (has? "4 cases, 4 comparisons: 2 agree, 2 differ"))
    (expect (has? "<svg"))
    (expect (has? ">difference</text>"))
    (expect (has? "http://www.w3.org/2000/svg"))
    (expect (length (report-rows (read-report (in-scratch "out/report.json")))) => (length rows)))
  (system* "rm" "-rf" scratch))
