;;; (bight lesson experiment) --- does a display of the tether teach? the experiment of section 4.2.1 of the thesis.
;;;
;;; The thesis proposes to let a group that trained with the real vehicle, one that trained in simulation and one
;;; that did not train take the same test.  Here the groups differ by what they see of their tether while they
;;; train: nothing, a plan view, three dimensions; the test is flown by all without a display, before and after.
;;; Who takes part has read and accepted the words of consent; groups are drawn in blocks of three, so that they
;;; stay of like size whenever it ends.  All is kept in the logbook.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson experiment)
  #:use-module (bight lesson groups)
  #:use-module (srfi srfi-1)
  #:export (consent-text
            groups-of-experiment
            steps-of-experiment step-lesson step-seed step-display
            group-drawn next-step
            experiment-lines
            experiment-tag))

(define experiment-tag "tether-display")

(define consent-text
  "This is an experiment on training.  You will fly a simulated underwater vehicle: a test, three lessons, and
the test again, about an hour in all.  A draw decides what you see of the vehicle's tether during the lessons.

Kept are the name that you gave, which may be a number, your group, and of each lesson the marks, the times and
the hints that you took; nothing else, and nothing leaves this computer unless its owner copies the logbook.
Taking part is voluntary.  You may stop at any time, without giving a reason, by q or by closing the window, and
have your entries deleted.  There is no risk beyond that of looking at a screen for an hour; pause as you like.

Whoever runs this with people needs the approval of the board that answers for research at his place: this text
does not replace it.")

;; Groups, and what each sees of its tether in training.
(define displays '(("none" . none) ("plan" . plan) ("three" . three)))

(define groups-of-experiment (map car displays))

;; Lessons with their seeds.  Test and training are different lessons of the same skill; both tests are the same
;; lesson with another current.
(define test-lesson 'which-side-of-the-leg)

(define (steps-of-experiment group)
  "Return the steps of one in GROUP, in order: lists of lesson, seed and display."
  (let ((display (assoc-ref displays group)))
    (list (list test-lesson 11 'none)
          (list 'one-pile 1 display)
          (list 'wrong-side 1 display)
          (list 'follow-your-tether 1 display)
          (list test-lesson 12 'none))))

(define step-lesson first)
(define step-seed second)
(define step-display third)


;;; Drawing groups.

(define (shuffled items dice)
  (map cdr (sort (map (lambda (item) (cons (random 1.0 dice) item)) items)
                 (lambda (a b) (< (car a) (car b))))))

(define (group-drawn n)
  "Return the group of who is enrolled after N others: of each three, one in each group, in an order that
depends on nothing but N."
  (let* ((size (length groups-of-experiment)) (dice (seed->random-state 421)))
    (let next ((block (quotient n size)))
      (let ((order (shuffled groups-of-experiment dice)))
        (if (zero? block)
            (list-ref order (remainder n size))
            (next (- block 1)))))))


;;; Where one is.

(define (of key) (lambda (result) (assq-ref result key)))

(define (done? results step)
  (any (lambda (r) (and (eq? (step-lesson step) ((of 'lesson) r)) (eqv? (step-seed step) ((of 'seed) r))))
       results))

(define (next-step group results)
  "Return the number, from 1, and the step that comes next for one in GROUP with RESULTS, or #f when all are done."
  (let* ((steps (steps-of-experiment group)) (i (list-index (lambda (s) (not (done? results s))) steps)))
    (and i (list (+ i 1) (list-ref steps i)))))


;;; The table.

(define (total results who seed)
  ;; Of WHO, in the test with SEED, the first time; or #f.
  (let ((all (first-results (filter (lambda (r) (and (equal? who ((of 'who) r)) (eq? test-lesson ((of 'lesson) r))
                                                     (eqv? seed ((of 'seed) r))))
                                    results))))
    (and (pair? all) ((of 'total) (car all)))))

(define (per-group enrolled results number)
  ;; An alist from groups to NUMBER of the marks before and after of all who have both.
  (filter-map
   (lambda (group)
     (let ((numbers (filter-map (lambda (entry)
                                  (let ((before (total results (car entry) 11)) (after (total results (car entry) 12)))
                                    (and (equal? group (cdr entry)) before after (number before after))))
                                enrolled)))
       (and (pair? numbers) (cons group numbers))))
   groups-of-experiment))

(define (people n simulated)
  (if (zero? simulated)
      (simple-format #f "~a took part." n)
      (simple-format #f "~a took part, of whom ~a were simulated: of those nobody was measured." n simulated)))

(define (table title groups)
  (if (null? groups) '() (cons title (compare-lines groups))))

(define (experiment-lines enrolled results)
  "Return the table of the experiment, lines: ENROLLED is an alist from who to his group, RESULTS are those of the
logbook."
  (let* ((after (per-group enrolled results (lambda (before after) after)))
         (gained (per-group enrolled results (lambda (before after) (- after before))))
         (simulated (count (lambda (entry)
                             (any (lambda (r) (and (equal? (car entry) ((of 'who) r)) ((of 'simulated) r))) results))
                           enrolled)))
    (append
     (list (people (length enrolled) simulated))
     (if (null? gained)
         '("Nobody has flown both tests yet.")
         (append (table "Marks in the test after training, of 100:" after)
                 (table "Marks gained from the test before it:" gained)
                 '("Means with intervals of 95 %; differences with intervals that hold all together with 95 %."))))))
