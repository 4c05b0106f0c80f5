;;; (bight dive foresight) --- what is to come if nobody touches the sticks.
;;;
;;; First the line is led on without forces, which takes milliseconds: as it lies, it trails behind the
;;; vehicle and touches; its taut string turns and holds.  Then a fork of the dive is run, which is what
;;; will happen.  What both tell is told once, by the fork.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive foresight)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive plain-words)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (foresee
            foresight? foresight-kind foresight-object foresight-seconds foresight-confidence
            foresight-turns))

(define-record <foresight>
  (make-foresight kind object seconds confidence turns)
  is-foresight?
  (kind %kind)
  (object %object)
  (seconds %seconds)
  (confidence %confidence)
  (turns %turns-then))

(define (foresight->string f)
  (foresight-said (%kind f) (%object f) (%seconds f) (%turns-then f) (= 1 (%confidence f))))

(set-record-type-printer!
 <foresight>
 (lambda (f port)
   (simple-format port "#<foresight: ~a>" (foresight->string f))))

(define-argument-type (foresight value)
  "what `foresee' lists"
  (if (is-foresight? value) value refused))

(define-verb (foresight? (object any))
  "Return #t if OBJECT is one of what `foresee' lists."
  (is-foresight? object))
(define-verb (foresight-kind (f foresight))
  "Return what will happen: touch, turn, taut, bump, stuck, snapped or parted."
  (%kind f))
(define-verb (foresight-object (f foresight))
  "Return the name of the object that it happens to, or #f."
  (%object f))
(define-verb (foresight-seconds (f foresight))
  "Return in how many seconds it will happen."
  (%seconds f))
(define-verb (foresight-confidence (f foresight))
  "Return how sure that is: 1 when the fork did it, less when the string alone says so."
  (%confidence f))
(define-verb (foresight-turns (f foresight))
  "Return the turns of the tether about the object then, or #f."
  (%turns-then f))


;;; The string.

(define string-alone 0.5)               ; how sure

(define (by-string engine t seconds)
  (map (lambda (f)
         (make-foresight (first f) (second f) (third f) string-alone
                         (and (eq? (first f) 'turn) (fourth f))))
       (%foresee engine t seconds)))


;;; The fork.

(define look 0.5)                       ; s between looks at the turns

(define (kind-of event vehicles)
  ;; What EVENT is called here, or #f.
  (case (car event)
    ((touched) (if (memq (caddr event) vehicles) 'bump 'touch))
    ((taut stuck snapped parted) (car event))
    (else #f)))

(define (object-of event)
  (and (pair? (cdddr event)) (cadddr event)))

(define (halves turns)
  (inexact->exact (floor (* 2 (abs turns)))))

(define (half-turns engine t names)
  ;; The half turns about each of NAMES, level ground left out.
  (map (lambda (name i)
         (let ((turns (false-if-exception (%turns engine t i))))
           (list name (if turns (halves turns) 0) (or turns 0))))
       names (iota (length names))))

(define (new-turns before after seconds)
  (filter-map (lambda (a b)
                (and (> (second b) (second a))
                     (make-foresight 'turn (first b) seconds 1.0 (third b))))
              before after))

(define (new-events engine seen start subjects vehicles)
  (filter-map (lambda (event)
                (let ((kind (kind-of event vehicles)))
                  (and kind (memq (caddr event) subjects)
                       (make-foresight kind (object-of event) (- (cadr event) start) 1.0 #f))))
              (%events engine seen)))

(define (new-taut before? now? events seconds)
  ;; Among obstacles a tether is taut round what it touches, which is no event.
  (if (and now? (not before?) (not (any (lambda (f) (eq? 'taut (%kind f))) events)))
      (list (make-foresight 'taut #f seconds 1.0 #f))
      '()))

(define (by-fork engine t seconds)
  (let* ((fork (%fork-dive engine))
         (names (%names fork 'obstacle))
         (vehicles (%names fork 'rov))
         (subjects (cons (list-ref (%names fork 'tether) t) vehicles))
         (start (%dive-time fork))
         (steps (inexact->exact (round (/ look (%dive-time-step fork))))))
    (let loop ((turns (half-turns fork t names)) (taut? (%taut? fork t))
               (seen (%event-count fork)) (all '()))
      (let ((now (- (%dive-time fork) start)))
        (if (>= (+ now 1e-6) seconds)
            (reverse! all)
            (begin
              (%step-dive! fork steps)
              (let* ((now (- (%dive-time fork) start))
                     (after (half-turns fork t names))
                     (taut-after? (%taut? fork t))
                     (events (new-events fork seen start subjects vehicles)))
                (loop after taut-after? (%event-count fork)
                      (append-reverse (append events (new-taut taut? taut-after? events now)
                                              (new-turns turns after now))
                                      all)))))))))

(define (told-by? all f)
  (any (lambda (g)
         (and (eq? (%kind f) (%kind g)) (eq? (%object f) (%object g))
              (< (abs (- (%seconds f) (%seconds g))) (max 3 (* 1/3 (%seconds g))))))
       all))

(define-verb (foresee #:subject (t tether) (seconds (between 0 3600)) #:key (quick flag #f))
  "Return what will happen within SECONDS if the sticks stay as they are, soonest first: a list of
foresights, each with kind, object, seconds and confidence.  The line and its string are led on first,
without forces; then a fork of the dive is run; what the fork does is sure.  With QUICK there is no fork:
that takes milliseconds.  A tether is taut by the rule of `taut?'.  The prompt says it in words."
  (let* ((engine (this-engine 'foresee))
         (guess (by-string engine t seconds))
         (sure (if quick '() (by-fork engine t seconds))))
    (let ((all (sort (append sure (remove (lambda (f) (told-by? sure f)) guess))
                     (lambda (a b) (< (%seconds a) (%seconds b))))))
      (with-words 'foresee all
                  (lambda () (foresights-said (map foresight->string all) seconds))))))
