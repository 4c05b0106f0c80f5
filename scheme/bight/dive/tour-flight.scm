;;; (bight dive tour-flight) --- a tour is flown: the vehicle goes its legs, the winch keeps a little more out than a taut
;;; tether takes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive tour-flight)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (fouled?))
  #:use-module (bight dive command)
  #:use-module ((bight dive figures) #:select (held-vehicle))
  #:use-module ((bight dive homing) #:select (come-home! fly-home! home-of untold-fork))
  #:use-module (bight dive query)
  #:use-module ((bight dive task) #:select (add-task! remove-task! task-state set-task-state!))
  #:use-module (bight dive time)
  #:use-module (bight dive tour)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (fly-tour! tour-trial
            ;; For (bight belief tour).
            tour-troubles
            ;; For (bight bench tours).
            begin-flight! places-reached (is-home? . at-home?)))

(define tick 0.5)                       ; s between looks at winch and vehicle
(define stuck-way 0.3)                  ; m: no more of the way ...
(define stuck-time 30)                  ; s: ... in so long is stuck
(define ahead 4)                        ; s of flight for which line is out
(define spare 1.5)                      ; m beyond what a taut line takes, and 5 % of it
(define near-enough 0.3)                ; m of a place is there
(define slack-pull 15)                  ; N: no more is a line that can be taken in

(define (tend-line! tour speed)
  ;; Have as much out as the taut line takes, and a little more.
  (let* ((tether (tour-tether tour))
         (out (tether-length tether))
         (want (min (tour-line tour) (+ (* 1.05 (taut-length tether)) spare (* ahead speed)))))
    (cond ((< out want) (pay-out! tether (- want out) #:rate 1))
          ((and (> out (+ want 0.5)) (< (tension-at tether 0) slack-pull))
           (haul-in! tether (- out want) #:rate 0.4))
          (else (haul-in! tether 0)))))

;; The state of a flight, a list: the step of the next tick; legs that are left, the first of which is flown, #f
;; before it is begun; how many stops were reached; where the vehicle was when it had last moved on, and when.
(define make-flight list)
(define flight-due first)
(define flight-legs second)
(define flight-begun? third)
(define flight-reached fourth)
(define flight-place fifth)
(define flight-since sixth)

(define (moved-on flight due place)
  (let ((moved? (> (distance place (flight-place flight)) stuck-way)))
    (make-flight due (flight-legs flight) #t (flight-reached flight)
                 (if moved? place (flight-place flight)) (if moved? (now) (flight-since flight)))))

(define (end-flight! task tour watched?)
  ;; The last leg, or what is left of one that could not be flown, is flown home as `fly-home!' finds it.
  (let ((tether (tour-tether tour)) (vehicle (tour-vehicle tour)))
    (release! vehicle)
    (remove-task! (this-dive 'fly-tour!) task)
    (unless (and (not (parted? tether)) (if watched? (fly-home! tether) (come-home! tether vehicle)))
      (hold-position! vehicle))))

(define (next-leg task flight due place)
  (set-task-state! task (make-flight due (cdr (flight-legs flight)) #f (+ 1 (flight-reached flight)) place (now))))

(define (at-end? leg place)
  (< (distance place (last leg)) near-enough))

(define (give-up! task tour)
  ;; Nobody asks how a vehicle comes home that has not come to all places.
  (remove-task! (this-dive 'fly-tour!) task)
  (hold-position! (tour-vehicle tour)))

(define (fly-on task tour speed whole? watched?)
  (let* ((flight (task-state task)) (vehicle (tour-vehicle tour)) (step (%dive-steps (this-engine 'fly-tour!))))
    (when (>= step (flight-due flight))
      (let ((due (+ step (round (/ tick (time-step))))) (place (rov-position vehicle)))
        (tend-line! tour speed)
        (cond ((null? (cdr (flight-legs flight))) (end-flight! task tour watched?))
              ((or (> (- (now) (flight-since flight)) stuck-time) (parted? (tour-tether tour)))
               (if whole? (give-up! task tour) (end-flight! task tour watched?)))
              ((not (flight-begun? flight))
               (fly-along! vehicle (car (flight-legs flight)) #:speed speed)
               (set-task-state! task (moved-on flight due place)))
              ((at-end? (car (flight-legs flight)) place) (next-leg task flight due place))
              (else (set-task-state! task (moved-on flight due place))))))))

(define* (set-out! who tour speed #:key whole? watched?)
  ;; For the verb WHO; return the task.  With WHOLE? a vehicle that gets stuck does not fly home; WATCHED?, or is it on a fork
  ;; of the verb's own?
  (held-vehicle who (list-index (lambda (name) (eq? name (tour-tether tour))) (%names (this-engine who) 'tether)))
  (release! (tour-vehicle tour))
  (add-task! 'fly-tour! "fly a tour" (lambda (task) (fly-on task tour speed whole? watched?))
             (make-flight 0 (tour-legs tour) #f 0 (rov-position (tour-vehicle tour)) (now))
             (tour-vehicle tour)))

(define (begin-flight! tour speed)
  "Let the present dive, a fork that nobody watches, fly the whole of TOUR at SPEED while time passes, or as far as it can;
return the flight."
  (set-out! 'fly-tour! tour speed #:whole? #t))

(define (places-reached flight)
  "Return how many places the FLIGHT has come to."
  (flight-reached (task-state flight)))

(define-verb (fly-tour! (tour tour) #:key (speed positive 0.35))
  "Fly TOUR at SPEED m/s while time passes in `run': the winch keeps a little more out than a taut tether takes, and
from the last place, or where the vehicle gets stuck, it comes home as `fly-home!' does.  Return the length of
the tour, m."
  (set-out! 'fly-tour! tour speed #:watched? #t)
  (tour-length tour))

(define* (flown tour speed #:optional whole? (go-on? (const #t)))
  ;; Fly TOUR in the present dive to its end, and return how many places were come to.  GO-ON? is called with the number of
  ;; each place that is come to, and returns whether the flight goes on.  WHOLE? is as `set-out!' takes it; places are looked at
  ;; then, so that nothing may be taken over before the last is.
  (let* ((task (set-out! 'tour-trial tour speed #:whole? whole? #:watched? whole?)) (dive (this-dive 'tour-trial))
         (most (+ 120 (/ (* 3 (+ (tour-length tour) (tour-line-needed tour))) speed))) (start (now)))
    (let loop ((reached 0))
      (let ((n (places-reached task)))
        (if (and (every go-on? (iota (- n reached) reached)) (pair? (dive-tasks dive)) (< (- (now) start) most))
            (begin (run 1) (loop n))
            n)))))

(define home-within 1.5)                ; m of the anchor, or of the surface below it

(define (is-home? tour)
  (and (not (parted? (tour-tether tour)))
       (< (distance (rov-position (tour-vehicle tour)) (home-of (tour-tether tour))) home-within)))

(define-verb (tour-trial (tour tour) #:key (speed positive 0.35))
  "Fly TOUR at SPEED m/s on a fork, where the tether has its slack and the water its current, and return an alist:
home? (whether the vehicle came home), reached (how many places), fouled?, seconds, tension (N, the most at the
vehicle or the winch since the dive began)."
  (untold-fork
   (lambda ()
     (let ((start (now)) (tether (tour-tether tour)))
       (let ((reached (flown tour speed)))
         `((home? . ,(is-home? tour)) (reached . ,reached) (fouled? . ,(fouled? tether))
           (seconds . ,(- (now) start)) (tension . ,(max-tension tether))))))))

(define (tour-troubles tour speed enough?)
  "Fly TOUR at SPEED on a fork of the present dive.  Return a list that has true for each place, and then for home, where
the tether was fouled or the vehicle did not come.  It does not come farther than a place where the tether is fouled and
ENOUGH?, a procedure of the number of that place, returns true."
  (untold-fork
   (lambda ()
     (let* ((tether (tour-tether tour)) (n (length (tour-places tour))) (troubles (make-vector (+ n 1) #t))
            (reached (flown tour speed #t (lambda (k)
                                            (let ((trouble? (fouled? tether)))
                                              (vector-set! troubles k trouble?)
                                              (not (and trouble? (enough? k))))))))
       (vector-set! troubles n (not (and (= reached n) (is-home? tour) (not (fouled? tether)))))
       (vector->list troubles)))))
