;;; The lessons that come with bight: the careless, the ordinary and the expert pilot of each come out in
;;; that order, with a clear distance, whatever the seed; and each lesson is proved.  Unless BIGHT_LONG=1, the lessons
;;; that take longest are flown with one seed instead of two, and of those of real work only the experts and those who
;;; fail soon, once.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight lesson)
             (bight lesson check)
             (bight lesson file)
             (bight lesson path)
             ((srfi srfi-1) #:select (any append-map)))

(define long? (equal? "1" (getenv "BIGHT_LONG")))

;; Two thirds of the time of three pilots and a seed is theirs.
(define longest '(wrong-side follow-your-tether blind-tender under-ice tms-day the-tide-makes))

(define (seeds-for name)
  (if (and (memq name longest) (not long?)) '(1) '(1 2)))

(define (flown lesson pilot seed)
  (take-lesson lesson (scripted-guide (pilot-named lesson pilot)) #:who pilot #:seed seed))

(define (named name)
  (load-lesson (lesson-file (symbol->string name))))

(define (expect-order lesson seed)
  (let ((careless (flown lesson 'careless seed))
        (ordinary (flown lesson 'ordinary seed))
        (expert (flown lesson 'expert seed)))
    (expect (report-passed? careless) => #f)
    (expect (report-passed? expert))
    (expect (+ 5 (report-total careless)) is (below (report-total ordinary)))
    (expect (+ 2 (report-total ordinary)) is (below (report-total expert)))))

(define-scenario (three-pilots name)
  "The careless pilot fails; the ordinary one is well above him, and the expert above both."
  #:for ((name 'read-the-bow 'just-enough-slack 'count-your-turns 'turn-into-the-current 'one-pile
               'wrong-side 'which-side-of-the-leg 'follow-your-tether 'snag-drill 'clump-and-float
               'blind-tender 'wreck-with-rigging 'under-ice 'tms-day 'the-tide-makes))
  (for-each (lambda (seed) (expect-order (named name) seed)) (seeds-for name)))

(define soon-failed '(between-the-moorings caught-on-a-wire home-by-feel the-parted-end))

(define-scenario (real-work name)
  "The expert passes and, where it does not last long, the careless pilot fails; in the long form as above."
  #:for ((name 'free-span 'leg-cleaning 'between-the-moorings 'under-the-keel 'where-the-clump-hangs
               'two-at-a-jacket 'caught-on-a-wire 'home-by-feel 'the-parted-end 'unknown-wreck))
  (if long?
      (for-each (lambda (seed) (expect-order (named name) seed)) '(1 2))
      (begin
        (when (memq name soon-failed)
          (expect (report-passed? (flown (named name) 'careless 1)) => #f))
        (expect (report-passed? (flown (named name) 'expert 1))))))

(define-scenario every-lesson-is-tested
  "No lesson is left out above."
  (expect (length (lessons)) => 25))

(define (trained-by? skill grade place)
  (and (memq skill (place-trains place)) (<= (place-grade place) grade)))

(define (untrained place places)
  ;; The skills that PLACE needs and that no other of PLACES trains in its grade or below.
  (filter (lambda (skill)
            (not (any (lambda (other)
                        (and (not (eq? other place)) (trained-by? skill (place-grade place) other)))
                      places)))
          (place-needs place)))

(define-scenario the-path-has-no-gap
  "Each of the four grades has lessons, each lesson trains something, and what it needs another trains."
  (let ((places (catalogue)))
    (expect (map (lambda (grade) (> (length (filter (lambda (p) (= grade (place-grade p))) places)) 3))
                 '(1 2 3 4))
            => '(#t #t #t #t))
    (expect (filter (lambda (p) (null? (place-trains p))) places) => '())
    (expect (append-map (lambda (p) (map (lambda (skill) (list (place-name p) skill)) (untrained p places)))
                        places)
            => '())))

(define-scenario (a-lesson-is-proved name)
  "What bight lesson --check says of some, and of the template."
  #:for ((name 'read-the-bow 'turn-into-the-current))
  (expect (check-lesson (load-lesson (lesson-file (symbol->string name)))) => '()))

(define-scenario the-template-is-proved
  "The file that people copy."
  (expect (check-lesson (load-lesson (string-append (dirname (car (lesson-files))) "/template.scm"))) => '()))
