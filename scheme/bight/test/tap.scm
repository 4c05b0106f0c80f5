;;; (bight test tap) --- what became of scenarios: TAP for people and automake, JUnit XML for servers.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test tap)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core markup) #:select (as-xml))
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (make-point
            point?
            failed-point
            point-file
            point-label
            point-sentence
            point-status
            point-seconds
            point-location
            point-details
            point-view
            output-lines
            print-plan
            print-comments
            print-point
            print-summary
            count-of
            write-junit))


;;; A test point: one line of the report.

(define-record <point>
  (make-point file label sentence location status note details seconds view)
  point?
  (file point-file)
  (label point-label)                   ; the scenario's name and values, or #f
  (sentence point-sentence)
  (location point-location)             ; FILE:LINE, or #f
  (status point-status)                 ; pass, fail or skip
  (note point-note)                     ; why it was skipped
  (details point-details)               ; lines that explain
  (seconds point-seconds)
  (view point-view))                    ; (LINES PICTURE) of its dive, or #f

(document
 (make-point "Return what became of a scenario.")
 (point-file "Return the file that POINT is about.")
 (point-label "Return the name and the values of the scenario that POINT is about, or #f.")
 (point-sentence "Return the sentence of POINT.")
 (point-location "Return where the scenario of POINT stands, FILE:LINE, or #f.")
 (point-status "Return pass, fail or skip.")
 (point-seconds "Return how many seconds POINT took.")
 (point-details "Return the lines that explain POINT.")
 (point-view "Return the lines of a drawing and the name of a picture or #f, a list, or #f."))

(define (failed-point file sentence . details)
  "Return a failure that is about FILE as a whole: SENTENCE, and lines that explain."
  (make-point file #f sentence #f 'fail #f details 0. #f))

(define (output-lines text)
  "Return what was printed, TEXT, as lines of a report."
  (map (lambda (line) (string-append "output: " line))
       (remove string-null? (string-split text #\newline))))


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

(define (print-plan n)
  "Print that N points follow."
  (simple-format #t "TAP version 13~%1..~a~%" n)
  (force-output))

(define (print-comments lines)
  "Print LINES as comments of the report."
  ;; A line of a text that has several would be a result.
  (for-each (lambda (line) (simple-format #t "# ~a~%" line))
            (append-map (lambda (text) (string-split text #\newline)) lines)))

(define (print-point point number)
  "Print POINT, the one of that NUMBER."
  (simple-format #t "~a ~a - ~a~a~%"
                 (if (eq? 'fail (point-status point)) "not ok" "ok")
                 number
                 (escape (point-title point))
                 (if (eq? 'skip (point-status point))
                     (string-append " # SKIP " (one-line (or (point-note point) "")))
                     ""))
  (print-comments (map (lambda (line) (string-append "  " line)) (point-details point)))
  (force-output))

(define (count-of status points)
  "Return how many of POINTS have STATUS."
  (count (lambda (point) (eq? status (point-status point))) points))

(define (print-summary points)
  "Print how many of POINTS passed, failed and were skipped."
  (simple-format #t "# ~a passed, ~a failed, ~a skipped~%" (count-of 'pass points)
                 (count-of 'fail points) (count-of 'skip points))
  (force-output))


;;; JUnit XML.

(define (milliseconds seconds)
  ;; SECONDS to three decimals, never with an exponent.
  (/ (round (* 1000 seconds)) 1000.))

(define (line-of point)
  ;; The line of its file that POINT begins at, as text, or #f.
  (let* ((location (point-location point))
         (colon (and location (string-rindex location #\:)))
         (line (and colon (substring location (+ colon 1)))))
    (and line (text->number line 10) line)))

(define (print-case point port)
  (simple-format port "    <testcase classname=\"~a\" file=\"~a\"~a name=\"~a\" time=\"~a\">"
                 (as-xml (point-file point))
                 (as-xml (point-file point))
                 (if (line-of point) (simple-format #f " line=\"~a\"" (line-of point)) "")
                 (as-xml (string-append (if (point-label point)
                                         (string-append (point-label point) ": ")
                                         "")
                                     (one-line (point-sentence point))))
                 (milliseconds (point-seconds point)))
  (case (point-status point)
    ((fail)
     (simple-format port "<failure message=\"~a\">~a</failure>"
                    (as-xml (if (pair? (point-details point)) (car (point-details point)) "failed"))
                    (as-xml (string-join (point-details point) "\n"))))
    ((skip) (simple-format port "<skipped message=\"~a\"/>" (as-xml (or (point-note point) "")))))
  (display "</testcase>\n" port))

(define (print-suite file points port)
  (simple-format port "  <testsuite name=\"~a\" tests=\"~a\" failures=\"~a\" skipped=\"~a\" time=\"~a\">~%"
                 (as-xml file) (length points) (count-of 'fail points) (count-of 'skip points)
                 (milliseconds (apply + (map point-seconds points))))
  (for-each (lambda (point) (print-case point port)) points)
  (display "  </testsuite>\n" port))

(define (write-junit file points)
  "Write POINTS to FILE as JUnit XML."
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
