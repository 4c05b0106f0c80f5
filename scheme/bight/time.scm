;;; (bight time) --- time passes.
;;;
;;; Only the verbs of this module let time pass.  In the body of a pilot they wait instead, while whoever
;;; flies with him lets it pass.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight time)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight pilot)
  #:use-module (bight progress)
  #:use-module (bight task)
  #:use-module (bight verb)
  #:use-module ((srfi srfi-1) #:select (fold))
  #:export (now time-step run run-until step! settle!))

(define stretch 60)                     ; steps between looks at the clock

(define (step-stretch! dive n)
  (if (idle? dive)
      (%step-dive! (engine-of dive) n)
      (do ((i 0 (+ i 1)))
          ((= i n))
        (%step-dive! (engine-of dive) 1)
        (run-tasks! dive))))

(define (wait-steps proc n)
  ;; In a pilot's body: wait until N more steps are done, of the dive that is then his: maybe a fork.
  (let ((due (+ n (%dive-steps (this-engine proc)))))
    (wait-until (lambda () (>= (%dive-steps (this-engine proc)) due)))))

(define (advance! proc n)
  ;; Let N steps pass; a pilot waits for them.
  (if (piloting?)
      (when (> n 0) (wait-steps proc n))
      (take-steps! proc n)))

(define (take-steps! proc n)
  (let ((dive (this-dive proc)))
    (check-not-running proc dive)
    (parameterize ((running-dive dive))
      (with-progress n
        (lambda (report)
          (let loop ((done 0))
            (when (< done n)
              (let ((k (min stretch (- n done))))
                (step-stretch! dive k)
                (report (+ done k))
                (loop (+ done k))))))))))

(define-verb (now)
  "Return the time of the dive, s."
  (%dive-time (this-engine 'now)))

(define-verb (time-step)
  "Return the time step of the dive, s."
  (%dive-time-step (this-engine 'time-step)))

(define-argument-type (duration value)
  "a time in seconds from 0 to 1e9"
  (if (and (real? value) (<= 0 value 1e9)) (exact->inexact value) refused))

(define-verb (run (seconds duration))
  "Let SECONDS pass, in whole steps; the remainder is carried to the next `run'.  Return the time."
  (let ((engine (this-engine 'run)))
    (if (piloting?)
        (wait-steps 'run (/ seconds (%dive-time-step engine)))
        (begin
          (check-not-running 'run (this-dive 'run))
          (advance! 'run (%whole-steps! engine seconds))))
    (now)))

(define-verb (step!)
  "Let one step pass.  Return the time."
  (advance! 'step! 1)
  (now))

(define (steps-in engine seconds)
  (inexact->exact (floor (+ 1e-6 (/ seconds (%dive-time-step engine))))))

(define-verb (run-until (condition thunk) #:key (at-most duration 3600.0))
  "Let time pass until CONDITION, a procedure of no arguments, returns true, at most AT-MOST seconds.  It
is asked before the first step and after each.  Return its value, or #f when it never came true."
  (let ((n (steps-in (this-engine 'run-until) at-most)))
    (let loop ((i 0))
      (or (condition)
          (and (< i n)
               (begin
                 (advance! 'run-until 1)
                 (loop (+ i 1))))))))


;;; Settling.

(define (shapes engine)
  (map (lambda (i) (%tether-points engine i 16)) (iota (length (%names engine 'tether)))))

(define (largest-move before after)
  (fold (lambda (old new most)
          (let ((moved 0.0))
            (array-for-each (lambda (a b) (set! moved (max moved (abs (- a b))))) old new)
            (max most moved)))
        0.0 before after))

(define (all-settled? engine)
  (and-map (lambda (i) (assq-ref (%tether engine i) 'settled?))
              (iota (length (%names engine 'tether)))))

(define-verb (settle! #:key (within positive 0.001) (at-most duration 600.0))
  "Let time pass until no tether moves more than WITHIN metres in a second, at most AT-MOST seconds.
Return #t when it came to rest."
  (let* ((engine (this-engine 'settle!))
         (second (steps-in engine 1)))
    (let loop ((left (steps-in engine at-most)) (before (shapes engine)))
      (if (< left second)
          #f
          (begin
            (advance! 'settle! second)
            (let* ((engine (this-engine 'settle!)) ; a pilot may wake up in a fork
                   (after (shapes engine)))
              (if (and (all-settled? engine) (<= (largest-move before after) within))
                  #t
                  (loop (- left second) after))))))))
