;;; (bight tap) --- the runner of scenario tests: TAP for people and automake, JUnit XML for servers.
;;;
;;; Every file is loaded in a fresh module that has the language; then its scenarios run in order, each
;;; in its own dive.  What goes wrong never passes in silence: a file that cannot be loaded or holds no
;;; scenario, and a choice that leaves nothing to run, are failures of their own.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight tap)
  #:use-module ((bight cli) #:select (evaluate-file program-error? program-error-text))
  #:use-module (bight errors)
  #:use-module (bight expect)
  #:use-module (bight record)
  #:use-module (bight scenario)
  #:use-module (bight verb)
  #:use-module (ice-9 ftw)
  #:use-module (srfi srfi-1)
  #:export (run-tests))


;;; A test point: one line of the report.

(define-record <point>
  (make-point file label sentence status note details seconds)
  point?
  (file point-file)
  (label point-label)                   ; the scenario's name and values, or #f
  (sentence point-sentence)
  (status point-status)                 ; pass, fail or skip
  (note point-note)                     ; why it was skipped
  (details point-details)               ; lines that explain
  (seconds point-seconds))

(define (failed-point file sentence . details)
  (make-point file #f sentence 'fail #f details 0.))

(define (failure-lines failure)
  (list (string-append (location->string (failure-location failure)) ": "
                       (if (eq? (failure-form failure) '...)
                           "an error that was not expected"
                           (code->string (failure-form failure))))
        (string-append "  expected: " (failure-expected failure))
        (string-append "  actual:   " (failure-actual failure))))

(define (output-lines text)
  (map (lambda (line) (string-append "output: " line))
       (remove string-null? (string-split text #\newline))))

(define (outcome->point file outcome output)
  (let ((scenario (outcome-scenario outcome)))
    (make-point file (scenario-label scenario) (scenario-sentence scenario)
                (outcome-status outcome) (outcome-reason outcome)
                (append (append-map failure-lines (outcome-failures outcome))
                        (if (and (eq? 'pass (outcome-status outcome))
                                 (zero? (outcome-claims outcome)))
                            '("nothing was expected here: only that no error is raised")
                            '())
                        (output-lines output))
                (outcome-seconds outcome))))


;;; Loading.

(define (fresh-module)
  (let ((module (make-fresh-user-module)))
    (module-use! module (resolve-interface '(bight)))
    module))

(define (load-scenarios file)
  ;; The list of the scenarios of FILE; raise &program-error.
  (collect-scenarios
   (lambda ()
     (save-module-excursion
      (lambda ()
        (set-current-module (fresh-module))
        (call-with-comments (lambda () (evaluate-file file))))))))

(define (call-with-comments thunk)
  ;; Call THUNK; what it prints becomes comments of the report.
  (let ((text (with-output-to-string thunk)))
    (for-each (lambda (line) (simple-format #t "# ~a~%" line)) (output-lines text))))

;; A batch is a file with its scenarios, or with the point that says why there are none.
(define (read-batch file)
  (with-exception-handler
      (lambda (exception)
        (if (program-error? exception)
            (list file (failed-point file "could not load" (program-error-text exception)))
            (raise-exception exception)))
    (lambda ()
      (let ((found (load-scenarios file)))
        (cons file
              (if (null? found)
                  (list (failed-point file "holds no scenario"))
                  found))))
    #:unwind? #t))


;;; Finding the files.

(define (scheme-file? name)
  (and (string-suffix? ".scm" name)
       (not (string-prefix? "." name))))

(define (files-at path)
  ;; The test files that PATH stands for: itself, or all *.scm of a folder, sorted.
  (cond ((not (file-exists? path))
         (bight-raise 'io 'run-tests "there is no file or folder ~s" path))
        ((file-is-directory? path)
         (map (lambda (name) (string-append (string-trim-right path #\/) "/" name))
              (or (scandir path scheme-file? string<?) '())))
        (else (list path))))

(define (batches-at path)
  (let ((files (files-at path)))
    (if (null? files)
        (list (list path (failed-point path "holds no *.scm file")))
        (map read-batch files))))


;;; Choosing.

(define (choose-by regexp batch)
  ;; BATCH with those scenarios alone whose name REGEXP matches; what failed to load stays.
  (cons (car batch)
        (filter (lambda (entry)
                  (or (point? entry)
                      (regexp-exec regexp (scenario-label entry))))
                (cdr batch))))

(define (choose only batches)
  (if only
      (let ((chosen (map (lambda (batch) (choose-by only batch)) batches)))
        (if (every null? (map cdr chosen))
            (list (list "tests" (failed-point "tests" "no scenario has a name that was asked for")))
            chosen))
      batches))


;;; TAP.

(define (one-line text)
  (string-join (remove string-null? (map string-trim-both (string-split text #\newline))) " "))

(define (escape text)
  ;; A # would begin a directive.
  (string-join (string-split (one-line text) #\#) "\\#"))

(define (point-title point)
  (string-append (basename (point-file point)) ": "
                 (if (point-label point) (string-append (point-label point) ": ") "")
                 (point-sentence point)))

(define (print-point point number)
  (simple-format #t "~a ~a - ~a~a~%"
                 (if (eq? 'fail (point-status point)) "not ok" "ok")
                 number
                 (escape (point-title point))
                 (if (eq? 'skip (point-status point))
                     (string-append " # SKIP " (one-line (or (point-note point) "")))
                     ""))
  (for-each (lambda (line) (simple-format #t "#   ~a~%" line)) (point-details point))
  (force-output))

(define (run-entry file entry)
  ;; The point of ENTRY, a scenario, which runs now, or a point already.
  (if (point? entry)
      entry
      (let* ((outcome #f)
             (output (with-output-to-string
                       (lambda () (set! outcome (run-scenario entry))))))
        (outcome->point file outcome output))))

(define (run-batches batches)
  ;; Run all, print each point as it comes, and return the list of points.
  (simple-format #t "TAP version 13~%1..~a~%" (apply + (map (lambda (b) (length (cdr b))) batches)))
  (force-output)
  (let ((number 0))
    (append-map (lambda (batch)
                  (map-in-order (lambda (entry)
                                  (let ((point (run-entry (car batch) entry)))
                                    (set! number (+ number 1))
                                    (print-point point number)
                                    point))
                                (cdr batch)))
                batches)))

(define (count-of status points)
  (count (lambda (point) (eq? status (point-status point))) points))

(define (print-summary points)
  (simple-format #t "# ~a passed, ~a failed, ~a skipped~%" (count-of 'pass points)
                 (count-of 'fail points) (count-of 'skip points))
  (force-output))


;;; JUnit XML.

(define (xml text)
  ;; TEXT fit to stand in XML, in an attribute too.
  (string-concatenate
   (map (lambda (c)
          (case c
            ((#\&) "&amp;") ((#\<) "&lt;") ((#\>) "&gt;") ((#\") "&quot;") ((#\newline) "&#10;")
            (else (if (or (char>=? c #\space) (char=? c #\tab)) (string c) "?"))))
        (string->list text))))

(define (milliseconds seconds)
  ;; SECONDS to three decimals, never with an exponent.
  (/ (round (* 1000 seconds)) 1000.))

(define (print-case point port)
  (simple-format port "    <testcase classname=\"~a\" name=\"~a\" time=\"~a\">"
                 (xml (point-file point))
                 (xml (string-append (if (point-label point)
                                         (string-append (point-label point) ": ")
                                         "")
                                     (one-line (point-sentence point))))
                 (milliseconds (point-seconds point)))
  (case (point-status point)
    ((fail)
     (simple-format port "<failure message=\"~a\">~a</failure>"
                    (xml (if (pair? (point-details point)) (car (point-details point)) "failed"))
                    (xml (string-join (point-details point) "\n"))))
    ((skip) (simple-format port "<skipped message=\"~a\"/>" (xml (or (point-note point) "")))))
  (display "</testcase>\n" port))

(define (print-suite file points port)
  (simple-format port "  <testsuite name=\"~a\" tests=\"~a\" failures=\"~a\" skipped=\"~a\" time=\"~a\">~%"
                 (xml file) (length points) (count-of 'fail points) (count-of 'skip points)
                 (milliseconds (apply + (map point-seconds points))))
  (for-each (lambda (point) (print-case point port)) points)
  (display "  </testsuite>\n" port))

(define (write-junit file points)
  (call-with-output-file file
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (display "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" port)
      (for-each (lambda (name)
                  (print-suite name
                               (filter (lambda (p) (string=? name (point-file p))) points)
                               port))
                (delete-duplicates (map point-file points)))
      (display "</testsuites>\n" port))))


;;; All together.

(define-argument-type (paths value)
  "a file, a folder or a list of them"
  (cond ((string? value) (list value))
        ((and (pair? value) (list? value) (every string? value)) value)
        (else refused)))

(define-argument-type (regexp value)
  "a regular expression, a string"
  (or (and (string? value)
           (false-if-exception (make-regexp value)))
      refused))

(define-verb (run-tests (paths paths) #:key (junit (or-false string)) (only (or-false regexp)))
  "Run the scenarios of PATHS, a file, a folder whose *.scm files are meant, or a list of such, and
print what became of them as TAP.  #:junit FILE writes JUnit XML too; #:only RE runs the scenarios
alone whose name matches the regular expression RE.  Return true if nothing failed."
  (let ((points (run-batches (choose only (append-map batches-at paths)))))
    (print-summary points)
    (when junit
      (write-junit junit points))
    (zero? (count-of 'fail points))))
