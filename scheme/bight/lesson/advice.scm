;;; (bight lesson advice) --- what `bight lesson' alone and `bight lessons --skills' say, from the logbook.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson advice)
  #:use-module (bight lesson log)
  #:use-module (bight lesson order)
  #:use-module (bight lesson path)
  #:export (advise
            list-skills))

(define (print lines)
  (for-each (lambda (line) (display line) (newline)) lines))

(define (print-without-record why)
  (print (list (simple-format #f "There is no record of you to go by: ~a." why)
               "Begin with the first lesson, and take them in order; `bight lessons' lists them."
               "bight lesson read-the-bow")))

(define (own results who)
  (filter (lambda (r) (equal? who (assq-ref r 'who))) results))

(define (advise given)
  "Print which lesson the pupil takes next, and why.  Return the exit status."
  (let ((why (why-no-record)))
    (if why
        (print-without-record why)
        (let* ((who (who-of given)) (places (catalogue)) (all (logged-results #f))
               (beliefs (beliefs-from all places)) (mine (own all who)))
          (print (proposal-lines (proposal beliefs who mine places) mine places))))
    0))

(define (list-skills given)
  "Print how well the pupil has each skill, and which lessons train and need it."
  (let ((why (why-no-record)) (places (catalogue)))
    (if why
        (print-without-record why)
        (print (skill-lines (beliefs-from (logged-results #f) places) (who-of given))))
    (print (cons "" (training-lines places)))))
