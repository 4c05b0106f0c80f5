;;; The lessons that come with bight: the careless, the ordinary and the expert pilot of each come out in
;;; that order, with a clear distance, whatever the seed; and each lesson is proved.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight lesson)
             (bight lesson-check)
             (bight lesson-file)
             (srfi srfi-1))

(define (flown lesson pilot seed)
  (take-lesson lesson (scripted-guide (pilot-named lesson pilot)) #:who pilot #:seed seed))

(define-scenario (three-pilots name)
  "The careless pilot fails; the ordinary one is well above him, and the expert above both."
  #:for ((name 'read-the-bow 'just-enough-slack 'count-your-turns 'turn-into-the-current 'one-pile
               'wrong-side 'which-side-of-the-leg 'follow-your-tether 'snag-drill 'clump-and-float
               'blind-tender 'wreck-with-rigging 'under-ice 'tms-day 'the-tide-makes))
  (let ((lesson (load-lesson (lesson-file (symbol->string name)))))
    (for-each
     (lambda (seed)
       (let* ((careless (flown lesson 'careless seed))
              (ordinary (flown lesson 'ordinary seed))
              (expert (flown lesson 'expert seed)))
         (expect (report-passed? careless) => #f)
         (expect (report-passed? expert))
         (expect (+ 5 (report-total careless)) is (below (report-total ordinary)))
         (expect (+ 2 (report-total ordinary)) is (below (report-total expert)))))
     '(1 2))))

(define-scenario every-lesson-is-tested
  "No lesson is left out above."
  (expect (length (lessons)) => 15))

(define-scenario (a-lesson-is-proved name)
  "What bight lesson --check says of some, and of the template."
  #:for ((name 'read-the-bow 'turn-into-the-current))
  (expect (check-lesson (load-lesson (lesson-file (symbol->string name)))) => '()))

(define-scenario the-template-is-proved
  "The file that people copy."
  (expect (check-lesson (load-lesson (string-append (dirname (car (lesson-files))) "/template.scm"))) => '()))
