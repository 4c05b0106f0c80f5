;;; (bight lesson ability) --- how well a pupil has each skill, and how hard each lesson is, from the marks of lessons.
;;;
;;; The graded response model of Samejima (1969): a lesson comes out in one of four grades, and the chance to
;;; reach at least the kth is logistic in how far the ability lies above the difficulty and a threshold.  The
;;; ability that counts is the mean of those that the lesson trains (a compensatory model of several
;;; dimensions, Reckase 2009).  Ability goes on a random walk with a rise at each lesson, for one learns by it
;;; (Wang, Berger and Burdick 2013).  Beliefs are normal and independent; after each lesson they are matched to
;;; the mean and variance of the posterior (assumed density filtering, as in TrueSkill, Herbrich et al. 2007).
;;; Unit: logits; 0 is a beginner.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson ability)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (make-belief belief? belief-mean belief-variance belief-deviation belief-interval
            skill-prior lesson-prior
            grade-reached grade-chance chance
            learn))

(define-record <belief>
  (make-belief mean variance)
  belief?
  (mean belief-mean)
  (variance belief-variance))

(define (belief-deviation belief)
  "Return the standard deviation of BELIEF."
  (sqrt (belief-variance belief)))

(define z-90 1.6448536269514722)        ; the 95 % quantile of the standard normal distribution

(define (belief-interval belief)
  "Return the list (LOW HIGH) in which BELIEF holds the truth with 90 %."
  (let ((half (* z-90 (belief-deviation belief))))
    (list (- (belief-mean belief) half) (+ (belief-mean belief) half))))


;;; The model's numbers.  Choices, not measurements: nobody has been measured yet.

(define skill-prior (make-belief 0.0 1.0))

(define sharpness 1.5)                  ; what a logit of ability changes of the logit of a chance
(define thresholds '(-1.2 0.0 1.2))     ; of the second, third and fourth grade of outcome
(define rise 0.1)                       ; of an ability by a lesson that trains it
(define walk 0.02)                      ; variance of that rise
(define doubt 0.0005)                   ; variance added to a difficulty: beliefs are not quite independent
(define half-marks 50)                  ; of 100: not passed, but much was right
(define full-marks 90)                  ; passed, and hardly anything was wrong

(define (lesson-prior grade level)
  "Return what is believed of a lesson of GRADE, from 1 to 4, at LEVEL before anybody took it."
  (make-belief (+ (* 0.7 (- grade 2)) (case level ((easy) -0.7) ((hard) 0.7) (else 0.0))) 0.25))

(define (grade-reached total passed?)
  "Return the outcome, 0 to 3, of a lesson with TOTAL marks of 100."
  (cond ((and passed? (>= total full-marks)) 3)
        (passed? 2)
        ((>= total half-marks) 1)
        (else 0)))

(define (logistic x)
  (/ 1 (+ 1 (exp (- x)))))

(define (at-least k distance)
  ;; The chance of the outcome K or better when ability is DISTANCE above the difficulty.
  (cond ((<= k 0) 1)
        ((> k (length thresholds)) 0)
        (else (logistic (* sharpness (- distance (list-ref thresholds (- k 1))))))))

(define (grade-chance k distance)
  "Return the chance of the outcome K, 0 to 3, of an ability that lies DISTANCE above the difficulty."
  (- (at-least k distance) (at-least (+ k 1) distance)))


;;; Moments of a normal belief under a likelihood, by the trapezoidal rule over five deviations to either
;;; side: for an analytic integrand that has died away at the ends its error is far below the model's.

(define nodes (map (lambda (i) (* 0.25 (- i 20))) (iota 41)))

(define (moments mean variance likelihood)
  ;; Probability, mean and variance of the product of the normal density and LIKELIHOOD.
  (let* ((s (sqrt variance))
         (xs (map (lambda (u) (+ mean (* s u))) nodes))
         (ws (map (lambda (u x) (* (exp (* -1/2 u u)) (likelihood x))) nodes xs))
         (total (apply + ws))
         (m (/ (apply + (map * ws xs)) total))
         (v (/ (apply + (map (lambda (w x) (* w (- x m) (- x m))) ws xs)) total)))
    (values (/ total (apply + (map (lambda (u) (exp (* -1/2 u u))) nodes))) m v)))

(define (distance-belief skills lesson)
  ;; Mean and variance of the mean of SKILLS less LESSON, all beliefs.
  (let ((k (length skills)))
    (values (- (/ (apply + (map belief-mean skills)) k) (belief-mean lesson))
            (+ (/ (apply + (map belief-variance skills)) (* k k)) (belief-variance lesson)))))

(define (chance k skills lesson)
  "Return the chance that a pupil of whose SKILLS, those that a lesson trains, these beliefs are held comes
out of LESSON, a belief too, with the outcome K or better."
  (call-with-values (lambda () (distance-belief skills lesson))
    (lambda (m v)
      (call-with-values (lambda () (moments m v (lambda (d) (at-least k d))))
        (lambda (p m v) p)))))

(define (shifted belief share from to fallen)
  ;; BELIEF, of which SHARE went into a sum of variance FROM, when the sum's mean moved by TO and its variance
  ;; fell by FALLEN.
  (let ((gain (/ (* share (belief-variance belief)) from)))
    (make-belief (+ (belief-mean belief) (* gain to))
                 (- (belief-variance belief) (* gain gain fallen)))))

(define (taught belief)
  (make-belief (+ (belief-mean belief) rise) (+ (belief-variance belief) walk)))

(define (doubted belief)
  (make-belief (belief-mean belief) (+ (belief-variance belief) doubt)))

(define (learn outcome skills lesson)
  "Return two values, the beliefs of SKILLS and of LESSON after a pupil with these SKILLS, those that LESSON
trains, took it with OUTCOME, 0 to 3, and learnt by it."
  (call-with-values (lambda () (distance-belief skills lesson))
    (lambda (m v)
      (call-with-values (lambda () (moments m v (lambda (d) (grade-chance outcome d))))
        (lambda (p m* v*)
          (let ((share (/ 1 (length skills))))
            (values (map (lambda (b) (taught (shifted b share v (- m* m) (- v v*)))) skills)
                    (doubted (shifted lesson -1 v (- m* m) (- v v*))))))))))
