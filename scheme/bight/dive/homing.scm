;;; (bight dive homing) --- coming home along the tether, tried on forks before it is flown.
;;;
;;; The way that retraces the string is right where the line lies like its string; a slack line hooks by
;;; friction on what the string slips off, or hitches about itself.  So there are several manners of going
;;; home, and a vehicle that gets stuck in one goes on in the next.  Forks of the dive try them in turn;
;;; the first that arrives is flown.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive homing)
  #:use-module (bight core errors)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (way-home unwind-plan unwind-said))
  #:use-module ((bight dive figures) #:select (held-vehicle))
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive command)
  #:use-module (bight dive query)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module ((bight shell progress) #:select (without-telling))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-11)
  #:export (fly-home! home-trial unwind-preview
            ;; For (bight dive tour) and (bight dive tour-flight).
            home-of untold-fork come-home!))

(define tick 0.1)                       ; s between looks at winch and vehicle
(define near-home 0.8)                  ; m of the anchor is home
(define usual-speed 0.35)               ; m/s
(define usual-pull 150.0)               ; N
(define last-leg 2.5)                   ; m: so near what drifted flies
(define stuck-way 0.3)                  ; m: no more of the way ...
(define stuck-time 20)                  ; s: ... in so long is stuck
(define tightening 20)                  ; s at most
(define slack-line 5)                   ; N: more is a line that holds him
(define ease 1)                         ; m

(define (names who t)
  ;; Of tether number T and of the vehicle that it holds, for the verb WHO.
  (values (list-ref (%names (this-engine who) 'tether) t) (held-vehicle who t)))


;;; Where home is.

(define shallowest -0.5)                ; m: z of a vehicle at the surface

(define (to-the-water p)
  (vec (x p) (y p) (min (z p) shallowest)))

(define (home-of tether)
  "Return where the vehicle of TETHER is home: at the anchor, or at the surface below one in the air; nobody is lifted
by his tether."
  (to-the-water (point-at tether 0)))

(define (last-line tether)
  ;; What stays out between the anchor and home, m.
  (distance (point-at tether 0) (home-of tether)))

(define (from-home tether vehicle)
  (distance (rov-position vehicle) (home-of tether)))

(define (in-the-water way)
  ;; The polyline WAY, kept below the surface.
  (map (lambda (p) (to-the-water (list->f64vector p))) (array->list way)))


;;; What the winch does.  Each is told at every tick.

(define (take-in-slack! tether)
  ;; What the string does not need, but some for the way round things.
  (let ((spare (- (tether-length tether) (* 1.05 (taut-length tether)) 1))
        (tension (tension-at tether 0)))
    (cond ((> tension 30) (pay-out! tether 0.5 #:rate 1))
          ((and (> spare 0.1) (< tension 15)) (haul-in! tether spare #:rate 0.4))
          (else (haul-in! tether 0)))))

(define (keep-tight! tether)
  (let ((tension (tension-at tether 0)))
    (cond ((> tension 25) (pay-out! tether 0.5 #:rate 1))
          ((and (< tension 5) (> (tether-length tether) 1)) (haul-in! tether 0.5 #:rate 0.4))
          (else (haul-in! tether 0)))))

(define (haul! tether pull)
  (haul-in! tether
            (if (> (tension-at tether 0) pull) 0 (max 0 (- (tether-length tether) (last-line tether) 0.5)))
            #:rate 0.4))


;;; Manners: what to begin with, and what to do at every tick, K ticks on.

(define (retrace! tether vehicle speed)
  (fly-along! vehicle (in-the-water (way-home tether)) #:speed speed))

(define (follow! tether vehicle speed)
  ;; Fly to where the line is a little farther on.
  (move! vehicle (to-the-water (point-at tether (max 0 (- (tether-length tether) 1.5)))) #:speed speed))

(define (drift! tether vehicle speed pull)
  (haul! tether pull)
  (when (< (from-home tether vehicle) last-leg)
    (move! vehicle (home-of tether) #:speed speed)))

(define (act! manner k tether vehicle speed pull)
  (case manner
    ((retrace)
     (when (zero? k) (retrace! tether vehicle speed))
     (take-in-slack! tether))
    ((tighten)
     (when (= k (/ tightening tick)) (retrace! tether vehicle speed))
     (keep-tight! tether))
    ((loose)
     (when (zero? k)
       (haul-in! tether 0)
       (retrace! tether vehicle speed)))
    ((follow)
     (when (zero? (modulo k 5)) (follow! tether vehicle speed))
     (keep-tight! tether))
    ((drift)
     (drift! tether vehicle speed pull))))

(define manners '(retrace drift tighten loose follow))

(define most-stages 3)

(define (plans)
  ;; Each manner first, then the others, as many as there are stages.
  (map (lambda (first) (cons first (take (delq first manners) (- most-stages 1)))) manners))


;;; The trip, a task.

;; Its state, a list: the step of the next tick; the manners that are left, the first of which is flown;
;; ticks in it, -1 when the last was given up and its way is let go; where he was when he had last moved
;; on, and when.
(define make-trip list)
(define trip-due first)
(define trip-plan second)
(define trip-k third)
(define trip-place fourth)
(define trip-since fifth)

(define (home? tether vehicle)
  (and (not (parted? tether)) (< (from-home tether vehicle) near-home)))

(define (end-trip! task tether vehicle)
  ;; He holds his place himself, on a line with a little slack.
  (pay-out! tether (if (> (tension-at tether 0) slack-line) ease 0) #:rate 1)
  (release! vehicle)
  (hold-position! vehicle)
  (remove-task! (this-dive 'fly-home!) task))

(define (next-stage trip due place)
  (make-trip due (cdr (trip-plan trip)) -1 place (now)))

(define (moved-on trip due place)
  (let ((moved? (> (distance place (trip-place trip)) stuck-way)))
    (make-trip due (trip-plan trip) (+ 1 (trip-k trip))
               (if moved? place (trip-place trip)) (if moved? (now) (trip-since trip)))))

(define (patience trip)
  (+ stuck-time (if (eq? 'tighten (car (trip-plan trip))) tightening 0)))

(define (go-on task tether vehicle speed pull)
  (let* ((trip (task-state task)) (step (%dive-steps (this-engine 'fly-home!))))
    (when (>= step (trip-due trip))
      (let ((due (+ step (round (/ tick (time-step))))) (place (rov-position vehicle)))
        (cond ((or (parted? tether) (home? tether vehicle)) (end-trip! task tether vehicle))
              ((< (- (now) (trip-since trip)) (patience trip))
               (unless (negative? (trip-k trip))
                 (act! (car (trip-plan trip)) (inexact->exact (trip-k trip)) tether vehicle speed pull))
               (set-task-state! task (moved-on trip due place)))
              ((null? (cdr (trip-plan trip))) (end-trip! task tether vehicle))
              (else
               (release! vehicle)
               (set-task-state! task (next-stage trip due place))))))))

(define (set-out! plan tether vehicle speed pull)
  (release! vehicle)
  (add-task! 'fly-home! "fly home" (lambda (task) (go-on task tether vehicle speed pull))
             (make-trip 0 plan 0 (rov-position vehicle) (now))
             vehicle))

(define (try plan tether vehicle speed pull)
  ;; What PLAN comes to on a fork: (HOME? SECONDS LEFT AT STATE), STATE that of the fork where it came home.
  (untold-fork
   (lambda ()
     (let ((start (now)) (task (set-out! plan tether vehicle speed pull))
           (most (+ 120 (/ (* 3 (tether-length tether)) speed))))
       (let loop ()
         (when (and (< (- (now) start) most) (memq task (dive-tasks (this-dive 'home-trial))))
           (run 1)
           (loop)))
       (let ((home? (home? tether vehicle)))
         (list home? (- (now) start) (tether-length tether) (rov-position vehicle)
               (and home? (%save-dive (this-engine 'home-trial)))))))))

(define (untold-fork thunk)
  ;; What THUNK returns on a fork of the verb's own: what happens there is no news.
  (without-telling (lambda () (what-if-thunk thunk))))

(define (first-home tether vehicle speed pull)
  ;; (PLAN HOME? SECONDS LEFT AT STATE) of the first plan that arrives, or of the one that came nearest.
  (let loop ((left (plans)) (best #f))
    (if (null? left)
        best
        (let ((outcome (cons (car left) (try (car left) tether vehicle speed pull))))
          (cond ((second outcome) outcome)
                ((or (not best) (< (fourth outcome) (fourth best))) (loop (cdr left) outcome))
                (else (loop (cdr left) best)))))))

(define-verb (home-trial #:subject (t tether) #:key (speed positive usual-speed) (pull positive usual-pull))
  "Look on forks for a way to come home to the anchor that arrives, the winch taking in and pulling no more
than PULL newtons, the vehicle flying at SPEED m/s.  Return an alist: home?, plan (the manners that are flown
in turn when one gets stuck: retrace, flying back along the string; drift, hauled by the winch; tighten,
retracing with the line kept tight; loose, retracing with the winch at rest; follow, along the line itself),
seconds, left (m still out), at.  It takes some tenths of a second for each plan that is tried; five are."
  (let-values (((tether vehicle) (names 'home-trial t)))
    (map cons '(plan home? seconds left at) (first-home tether vehicle speed pull))))

(define-verb (fly-home! #:subject (t tether) #:key (speed positive usual-speed) (pull positive usual-pull))
  "Bring the vehicle home to the anchor in the way that `home-trial' found to arrive; it flies, and works the
winch, while time passes in `run', and is not `arrived?' before it ends: the vehicle then holds its place at the
anchor, or at the surface below one in the air, on a slack line.  Return the plan, or #f, and do nothing,
when none arrives."
  (let*-values (((tether vehicle) (names 'fly-home! t))
                ((found) (first-home tether vehicle speed pull)))
    (and (second found)
         (begin
           (set-out! (first found) tether vehicle speed pull)
           (first found)))))

(define (come-home! tether vehicle)
  "Like `fly-home!', on a fork that nobody watches: what a trial saw come home is not flown a second time, the present
dive is as the trial ended.  Return true if one came home; else do nothing."
  (let ((found (first-home tether vehicle usual-speed usual-pull)))
    (when (second found)
      (%restore-dive! (this-engine 'fly-home!) (sixth found)))
    (second found)))


;;; Unwinding.

(define (patient-flight! vehicle)
  ;; Let time pass until he has arrived or is stuck; #t if he has arrived.
  (let loop ((place (rov-position vehicle)) (since (now)))
    (let ((here (rov-position vehicle)))
      (cond ((arrived? vehicle) #t)
            ((> (distance here place) stuck-way) (run 1) (loop here (now)))
            ((> (- (now) since) stuck-time) #f)
            (else (run 1) (loop place since))))))

(define (is-freed? tether)
  (< (excess tether) (max 0.5 (* 0.02 (free-length tether)))))

(define (unwind-flight tether vehicle speed)
  ;; Why the loop, flown on a fork, does not free TETHER: a sentence, or #f.
  (untold-fork
   (lambda ()
     (fly-along! vehicle (unwind-plan tether) #:speed speed)
     (let ((arrived (patient-flight! vehicle)))
       (cond ((is-freed? tether) #f)
             (arrived "flown on a fork, it does not free the tether")
             (else "flown on a fork, the vehicle gets stuck"))))))

(define (with-outcome said why-not)
  (map (lambda (entry)
         (case (car entry)
           ((feasible?) (cons 'feasible? (not why-not)))
           ((why-not) (cons 'why-not why-not))
           (else entry)))
       said))

(define-verb (unwind-preview #:subject (t tether) #:key (quick flag #f) (speed positive 0.35))
  "Return what is known of the unwinding loop before it is flown, an alist: needed?, feasible?, why-not,
length, clearance, nearest, longest (m that the string becomes on the way), left (m of it at the end).  A
loop that the string calls feasible is flown on a fork at SPEED m/s, which takes some tenths of a second;
with QUICK it is not."
  (let ((said (unwind-said t)))
    (if (or quick (not (assq-ref said 'needed?)) (not (assq-ref said 'feasible?)))
        said
        (let-values (((tether vehicle) (names 'unwind-preview t)))
          (with-outcome said (unwind-flight tether vehicle speed))))))
