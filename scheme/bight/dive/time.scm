;;; (bight dive time) --- time passes.
;;;
;;; Only the verbs of this module let time pass.  In the body of a pilot they wait instead, while whoever
;;; flies with him lets it pass.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive time)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive past)
  #:use-module (bight dive pilot)
  #:use-module (bight dive task)
  #:use-module (bight engine)
  #:use-module (bight shell progress)
  #:use-module ((srfi srfi-1) #:select (fold))
  #:export (now time-step run run-until step! settle!))

(define stretch 60)                     ; steps between looks at the clock

(define (note-tasks! dive step)
  ;; How the tasks stand after those of STEP have run.
  (let ((past (dive-past dive)))
    (when past
      (set-dive-past! dive (past-with-tasks past (engine-of dive) step (tasks-state dive))))))

(define (keep-moment! dive)
  (let ((past (dive-past dive)))
    (when past
      (set-dive-past! dive (past-with-moment past (engine-of dive) (lambda () (tasks-state dive)))))))

(define (take-and-tell! dive n)
  (let ((recorder (dive-recorder dive)))
    (if recorder
        (recorder n)
        (%step-dive! (engine-of dive) n))))

(define (only-watched? dive)
  (and (null? (dive-tasks dive)) (not (dive-recorder dive))))

(define (step-watched! dive n)
  ;; Up to N steps of a dive of which nothing but watchers is to be told, to the first after which a watcher
  ;; has done anything to the dive.  Return how many steps are left.
  (let* ((engine (engine-of dive)) (serial (%serial engine)))
    (let loop ((left n))
      (cond ((and (> left 0) (only-watched? dive) (= serial (%serial engine)))
             (%step-dive! engine 1)
             (run-watchers! dive)
             (loop (- left 1)))
            (else
             (note-tasks! dive (%dive-steps engine))
             left)))))

(define (step-stretch! dive n)
  ;; N steps; what runs between them runs when it is due.
  (note-tasks! dive (+ 1 (%dive-steps (engine-of dive))))
  (let loop ((left (if (idle? dive) n (step-watched! dive n))))
    (when (> left 0)
      (let ((k (if (idle? dive) left (steps-until-due dive left))))
        (take-and-tell! dive k)
        (unless (idle? dive)
          (run-tasks! dive)
          (note-tasks! dive (%dive-steps (engine-of dive))))
        (loop (- left k)))))
  (keep-moment! dive)
  (when (dive-recorder dive) ((dive-recorder dive) 'pause)))

(define (next-stretch dive left)
  ;; How many of the LEFT steps to take before the next look: to the end of a second.
  (min left (- stretch (modulo (%dive-steps (engine-of dive)) stretch))))

(define (live-along! dive n)
  ;; Of a live dive the steps come by themselves, and its tasks run as fast as they can.
  (let* ((engine (engine-of dive)) (last (+ n (%dive-steps engine))))
    (let loop ()
      (when (< (%dive-steps engine) last)
        (%step-dive! engine (if (idle? dive) (min stretch (- last (%dive-steps engine))) 1))
        (run-tasks! dive)
        (loop)))))

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
      (if (%live? (engine-of dive))
          (live-along! dive n)
          (with-progress n
            (lambda (report)
              (let loop ((done 0))
                (when (< done n)
                  (let ((k (next-stretch dive (- n done))))
                    (step-stretch! dive k)
                    (report (+ done k))
                    (loop (+ done k)))))))))))

(define (told proc work)
  ;; What WORK, which lets time pass for the verb PROC, returns; at a prompt what happened is told, in a fork
  ;; as what would happen.
  (let* ((dive (this-dive proc)) (engine (engine-of dive)))
    (if (piloting?)
        (work)
        (with-telling (if (dive-fork? dive) "what if: " "")
                      (lambda (before)
                        (if before (%events engine before) (%event-count engine)))
                      work))))

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
  "Let SECONDS pass, in whole steps; the remainder is carried to the next `run'.  Return the time.  At a
prompt it tells what happened meanwhile, in a fork as what would happen; so do the others."
  (let ((engine (this-engine 'run)))
    (if (piloting?)
        (wait-steps 'run (/ seconds (%dive-time-step engine)))
        (begin
          (check-not-running 'run (this-dive 'run))
          (told 'run (lambda () (advance! 'run (%whole-steps! engine seconds))))))
    (now)))

(define-verb (step!)
  "Let one step pass.  Return the time."
  (told 'step! (lambda () (advance! 'step! 1)))
  (now))

(define (steps-in engine seconds)
  (inexact->exact (floor (+ 1e-6 (/ seconds (%dive-time-step engine))))))

(define-verb (run-until (condition thunk) #:key (at-most duration 3600.0))
  "Let time pass until CONDITION, a procedure of no arguments, returns true, at most AT-MOST seconds.  It
is asked before the first step and after each.  Return its value, or #f when it never came true."
  (let ((n (steps-in (this-engine 'run-until) at-most)))
    (told 'run-until
          (lambda ()
            (let loop ((i 0))
              (or (condition)
                  (and (< i n)
                       (begin
                         (advance! 'run-until 1)
                         (loop (+ i 1))))))))))


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
         (second (steps-in engine 1))
         (most (steps-in engine at-most)))
    (told 'settle! (lambda () (settle second most within)))))

(define (settle second most within)
  ;; SECOND and MOST are numbers of steps.
  (let ((engine (this-engine 'settle!)))
    (with-progress most
      (lambda (report)
        (let loop ((left most) (before (shapes engine)))
          (report (- most left))
          (if (< left second)
              #f
              (begin
                (advance! 'settle! second)
                (let* ((engine (this-engine 'settle!)) ; a pilot may wake up in a fork
                       (after (shapes engine)))
                  (if (and (all-settled? engine) (<= (largest-move before after) within))
                      #t
                      (loop (- left second) after))))))))))
