;;; Numbers with so many decimals, against exact arithmetic.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core decimal)
             (bight core json)
             ((bight core programs) #:select (temporary-file))
             (bight identify measured)
             (ice-9 exceptions)
             (srfi srfi-1))

(define-scenario decimals-are-those-of-the-number
  "What is read back lies within half a unit of the last place, has so many places, and no sign where it is 0."
  (in open-water)
  (for-each
   (lambda (x)
     (for-each
      (lambda (places)
        (let* ((text (fixed x places)) (back (string->number (string-append "#e" text))))
          (expect (<= (abs (- back (inexact->exact x))) (/ 1 2 (expt 10 places))) => #t)
          (expect (- (string-length text) (or (string-index text #\.) (- (string-length text) 1)) 1) => places)
          (expect (and (zero? back) (string-prefix? "-" text)) => #f)
          (expect (string->number (string-append "#e" (fixed-with-sign x places))) => back)
          (expect (string-ref (fixed-with-sign x places) 0) => (if (negative? back) #\- #\+))))
      '(0 1 2 5)))
   '(0 0.0 -0.0 7 -7 1/3 -2/3 0.05 -0.05 0.125 -0.004 9.995 -99.999 1.005 123456789.987 1e15 -1e-9))
  (expect (map (lambda (x) (fixed x 1)) '(-0.04 -0.06 0.96 12)) => '("0.0" "-0.1" "1.0" "12.0")))

(define-scenario what-spells-no-number
  "Text that spells none, or one beyond all size, is no number; it raises nothing."
  (expect (map text->number '("1e9999" "-2.5E+99999999" "1e-9999" "" "." "-" "1/0" "1e" "0x10" "\x00;" "#e1e99999" "(1)" "nan"))
          => '(#f #f #f #f #f #f #f #f #f #f #f #f #f))
  (expect (map text->number '("12" "-0.5" "1e3" "+inf.0")) => '(12 -0.5 1000.0 +inf.0))
  (expect (text->number "ff" 16) => 255)
  (expect (text->number "-1" 16) => -1))

(define header "t,x,y,z,anchor_x,anchor_y,anchor_z,end_x,end_y,end_z,m1_x,m1_y,m1_z\n")

(define (row number)
  (string-append (string-join (make-list 13 number) ",") "\n"))

(define-scenario (a-file-with-a-number-beyond-all-size proc text)
  "It is refused as other junk is, by whoever reads files of numbers."
  #:for ((proc 'table 'run 'json) (text "1e9999" "-3E+88888" "2e999999999999"))
  (enter! 'open-water)
  (let ((file (temporary-file)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (call-with-output-file file
          (lambda (port)
            (display (if (eq? proc 'json) text (string-append header (row "0") (row text) (row "2"))) port)))
        (expect (guard (e ((bight-error? e) 'refused))
                  (case proc
                    ((table) (follow! file))
                    ((run) (read-run 'identify file))
                    (else (call-with-input-file file read-json))))
                => 'refused))
      (lambda () (delete-file file)))))
