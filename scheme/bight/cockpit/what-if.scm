;;; (bight cockpit what-if) --- what is to come if nobody moves the sticks: a fork that runs ahead, a little in every frame.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit what-if)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit state)
  #:use-module (bight dive)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:export (look-ahead! toggle-ghost! drop-ghost!))

(define ghost-horizon 5)                ; s
(define ghost-budget 0.006)             ; s of a frame

(define (advance-ghost! c)
  (let ((fork (or (cockpit-ghost-fork c)
                  (cons (fork-dive (cockpit-dive c))
                        (inexact->exact (round (/ ghost-horizon (time-step))))))))
    (let loop ((left (cdr fork)) (until (+ (clock) ghost-budget)))
      (cond ((zero? left)
             (set-ghost! c (car fork))
             (set-ghost-fork! c #f))
            ((> (clock) until) (set-ghost-fork! c (cons (car fork) left)))
            (else
             (%step-dive! (engine-of (car fork)) 1)
             (loop (- left 1) until))))))

(define (drop-ghost! c)
  "Let C look ahead no more."
  (set-ghost! c #f)
  (set-ghost-fork! c #f))

(define (look-ahead! c)
  "Bring what C looks ahead to a little further, if it does."
  (when (cockpit-ghost c)
    (unless (trying c (advance-ghost! c) #t)
      (drop-ghost! c))))

(define (toggle-ghost! c)
  "Let C look ahead, or no more."
  (let ((wanted? (not (cockpit-ghost c))))
    (drop-ghost! c)
    (cond ((not wanted?))
          ((cockpit-plain? c) (announce! c "plain characters show no what-if"))
          (((unseen?) 'what-if) (announce! c "in this lesson nobody sees what will be"))
          (else (set-ghost! c #t)))))
