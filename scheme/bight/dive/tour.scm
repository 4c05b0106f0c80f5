;;; (bight dive tour) --- tours: places visited in an order and by ways that bring the tether home unwound.
;;;
;;; Between any two places the vehicle flies the leg that takes the tether from the free way of the one to the
;;; free way of the other (bt_tether_leg in C), so that the tether is wound about nothing at any place, in
;;; whatever order the places come.  What is left is to choose the order: that of the shortest tour, exactly by
;;; dynamic programming over subsets for few places (Held and Karp 1962), by cheapest insertion and exchanges
;;; of two legs (Croes 1958) for many.
;;;
;;; The legs see a tether drawn tight.  Whether a slack one in a current comes home is tried by flying the tour on a
;;; fork, `tour-trial'.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive tour)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (fouled? members-of))
  #:use-module ((bight dive figures) #:select (held-vehicle))
  #:use-module (bight dive command)
  #:use-module ((bight dive homing) #:select (fly-home! home-of untold-fork))
  #:use-module (bight dive plain-words)
  #:use-module (bight dive query)
  #:use-module ((bight dive task) #:select (add-task! remove-task! task-state set-task-state!))
  #:use-module (bight dive time)
  #:use-module (bight dive tour-order)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (plan-tour fly-tour! tour-trial
            tour? tour-names tour-places tour-way tour-length tour-line-needed tour-left-out
            ;; For (bight bench tours).
            tour-along begin-flight! places-reached (is-home? . at-home?)))

(define-record <tour>
  (make-tour tether vehicle stops legs length needed line left-out)
  is-tour?
  (tether %tether-of)                   ; its name
  (vehicle %vehicle-of)                 ; the name of the one at its far end
  (stops %stops)                        ; (NAME . POINT) in the order in which they are visited
  (legs %legs)                          ; the ways to each stop and then home, lists of points
  (length %length)                      ; m, of all legs
  (needed %needed)                      ; m of tether, drawn tight, at most
  (line %line)                          ; m of tether there are
  (left-out %left-out))                 ; (NAME . WHY), WHY a string

(define-argument-type (tour value)
  "a tour, as `plan-tour' returns one"
  (if (is-tour? value) value refused))

(define-verb (tour? (value any))
  "Return #t if VALUE is a tour."
  (is-tour? value))

(define-verb (tour-names (tour tour))
  "Return what is visited, in order: names, and points where a point was asked for."
  (map car (%stops tour)))

(define-verb (tour-places (tour tour))
  "Return the points at which the vehicle stops, in order."
  (map cdr (%stops tour)))

(define-verb (tour-way (tour tour))
  "Return all legs of the tour in one, a polyline from the vehicle to its anchor."
  (list->typed-array 'f64 2 (map f64vector->list (concatenate (%legs tour)))))

(define-verb (tour-length (tour tour))
  "Return the length of the tour, with the leg home, m."
  (%length tour))

(define-verb (tour-line-needed (tour tour))
  "Return the most tether that the tour takes, drawn tight, m; a current and slack take more."
  (%needed tour))

(define-verb (tour-left-out (tour tour))
  "Return what cannot be visited, pairs of a name, or a point, and a sentence that says why."
  (%left-out tour))


;;; Where one stops: at a point, or at a distance from an object.

(define shallowest -0.5)                ; m: z of a vehicle at the surface

;; From where an object is looked at: eight directions level with its middle, above and below.
(define directions
  (cons* (vec 0 0 1) (vec 0 0 -1)
         (map (lambda (k) (let ((a (* (acos -1) (/ k 4)))) (vec (cos a) (sin a) 0))) (iota 8))))

(define places-most 1000)

(define-argument-type (places value)
  "a list of places: points, and names of obstacles or of structures"
  (let ((list (and (pair? value) (bounded-list value places-most))))
    (if (and list (every (lambda (p) (or (symbol? p) (accepts? type:point p))) list))
        (map (lambda (p) (if (symbol? p) p ((argument-type-coerce type:point) p))) list)
        refused)))

(define (middle-of obstacle depth)
  ;; Of the part of its axis, or of its box, that is in the water.
  (define (z-in-water z) (max (- depth) (min 0 z)))
  (let* ((axis (assq-ref obstacle 'axis))
         (low (if axis (first axis) (assq-ref obstacle 'low)))
         (high (if axis (second axis) (assq-ref obstacle 'high))))
    (vec (/ (+ (x low) (x high)) 2) (/ (+ (y low) (y high)) 2)
         (/ (+ (z-in-water (z low)) (z-in-water (z high))) 2))))

(define (half-size obstacle direction)
  ;; How far its surface is from its middle along DIRECTION, at most.
  (if (assq-ref obstacle 'axis)
      (assq-ref obstacle 'radius)
      (let ((size (vec- (assq-ref obstacle 'high) (assq-ref obstacle 'low))))
        (/ (if (zero? (z direction)) (max (x size) (y size)) (z size)) 2))))

(define (round-about obstacle stay depth)
  ;; Points in the water STAY m from the surface of OBSTACLE, or nearer where it reaches out of the water.
  (let ((middle (middle-of obstacle depth)))
    (map (lambda (d)
           (let ((p (vec+ middle (vec* (+ stay (half-size obstacle d)) d))))
             (vec (x p) (y p) (min shallowest (z p)))))
         directions)))

(define (clear? engine t stay p)
  (let ((near (%point-clearance engine t p)))
    (or (not near) (>= (first near) (* 0.9 stay)))))

(define (places-about engine t name i stay)
  ;; (NAME . POINT): where obstacle number I can be looked at from.
  (map (lambda (p) (cons name p))
       (filter (lambda (p) (clear? engine t stay p))
               (round-about (%obstacle engine i) stay (depth-of engine)))))

(define (depth-of engine)
  (let ((depth (assq-ref (%sea engine) 'depth)))
    (if (positive? depth) depth +inf.0)))

(define (choices engine t target stay)
  ;; Lists of (NAME . POINT), one of each list to be visited, for TARGET.
  (if (symbol? target)
      (map (lambda (i)
             (let ((name (list-ref (%names engine 'obstacle) i)))
               (cons name (places-about engine t name i stay))))
           (members-of target))
      (list (list target (cons target target)))))


;;; Legs.  A leg is (LENGTH NEEDED POINTS), or a sentence that says why there is none.

(define (ask-leg engine t from to line)
  (let ((v (%leg engine t from to)))
    (cond ((not (vector-ref v 0)) "no way is known there")
          ((> (vector-ref v 6) line)
           (simple-format #f "it takes ~a of tether" (metres (vector-ref v 6))))
          ((not (vector-ref v 2))
           (simple-format #f "the way is too narrow at `~a'" (vector-ref v 5)))
          (else (list (vector-ref v 3) (vector-ref v 6)
                      (map list->f64vector (array->list (vector-ref v 0))))))))

(define (leg-asker engine t line)
  ;; A procedure of two stops, (NAME . POINT), that asks each leg once; #f is where the vehicle is, or home.
  (let ((known (make-hash-table)))
    (lambda (from to)
      (let ((key (cons from to)))
        (or (hash-ref known key)
            (let ((leg (ask-leg engine t (and from (cdr from)) (and to (cdr to)) line)))
              (hash-set! known key leg)
              leg))))))

(define (leg? leg)
  (pair? leg))

(define (least-by key all)
  (and (pair? all)
       (fold (lambda (a best) (if (< (key a) (key best)) a best)) (car all) (cdr all))))

(define (nearest-choice engine t line choices)
  ;; The pair of CHOICES that is the shortest way from home, or a sentence.
  (let* ((legs (map (lambda (c) (cons c (ask-leg engine t (cdr c) #f line))) choices))
         (best (least-by (compose second cdr) (filter (compose leg? cdr) legs))))
    (cond (best (car best))
          ((null? legs) "nothing is clear of obstacles about it")
          (else (cdar legs)))))

(define (split-choices engine t line all)
  ;; Two values: the (NAME . POINT) to visit, and the (NAME . WHY) that cannot be.
  (let ((found (map (lambda (c) (cons (car c) (nearest-choice engine t line (cdr c)))) all)))
    (values (filter pair? (map cdr found))
            (filter (compose string? cdr) found))))


;;; The plan.

(define too-long 1e6)                   ; m: instead of a leg that cannot be flown

(define (legs-in-order asker stops)
  (map asker (cons #f stops) (append stops (list #f))))

(define (tour-of tether vehicle stops legs line left-out)
  (make-tour tether vehicle stops (map third legs) (fold + 0 (map first legs))
             (fold max 0 (map second legs)) line left-out))

(define (tour-along tether vehicle stops legs length line)
  "Return the tour of VEHICLE on TETHER, names, to STOPS, lists of three numbers, by LEGS, each a list of points: the last
is the leg home, which a flight follows to its end.  LENGTH is that of all of them, m, and LINE how much tether there is."
  (make-tour tether vehicle (map (lambda (p) (let ((p (list->f64vector p))) (cons p p))) stops)
             (append legs (list (last legs))) length line line '()))

(define (in-best-order asker stops)
  ;; STOPS in the order of the shortest tour.
  (let* ((all (list->vector stops)) (n (vector-length all)))
    (define (stop k) (and (< -1 k n) (vector-ref all k)))
    (define (cost i j)
      (let ((leg (asker (stop i) (stop j))))
        (if (leg? leg) (first leg) too-long)))
    (map stop (best-order n cost))))

(define (tour-among asker tether vehicle stops line left-out)
  ;; The tour of STOPS; one that no leg leads to, or away from, is left out.
  (let* ((order (in-best-order asker stops))
         (legs (legs-in-order asker order))
         (bad (list-index (negate leg?) legs)))
    (cond
     ((not bad)
      (tour-of tether vehicle order legs line left-out))
     ((null? order)
      (bight-raise 'unsupported 'plan-tour "no way leads home from where `~a' is: ~a" vehicle (car legs)))
     (else
      (let ((lost (list-ref order (min bad (- (length order) 1)))))
        (tour-among asker tether vehicle (delq lost stops) line
                    (acons (car lost) (list-ref legs bad) left-out)))))))

(define (on-a-line tether line thunk)
  ;; What THUNK returns of a fork whose winch has been told to give as much as LINE m: ways are charted so far.
  (untold-fork
   (lambda ()
     (let ((more (- line (tether-length tether))))
       (when (positive? more)
         (pay-out! tether more))
       (thunk (this-engine 'plan-tour))))))

(define (line-of t tether)
  ;; What is on the drum; what is out, where a drum has no end.
  (let ((drum (assq-ref (tether-properties t) 'drum)))
    (if (and (real? drum) (< drum +inf.0)) drum (tether-length tether))))

(define-verb (plan-tour #:subject (t tether) (places places) #:key (stay positive 1.0) (line (or-false positive) #f))
  "Return the tour on which the vehicle visits PLACES and comes home to the anchor with its tether wound about
nothing: the shortest that is found, its legs wide enough for the hull, its tether never longer than LINE m (left
out: what is on the drum, or what is out where the drum has no end).  A place is a point; or the name of an obstacle,
seen from STAY m off its surface; or that of a structure, whose members are all seen.  What cannot be reached is
left out, and said.  The prompt says the tour in words; `tour-trial' flies it on a fork, `fly-tour!' flies it."
  (let* ((engine (this-engine 'plan-tour))
         (tether (list-ref (%names engine 'tether) t))
         (vehicle (held-vehicle 'plan-tour t))
         (line (or line (line-of t tether))))
    (on-a-line
     tether line
     (lambda (engine)
       (call-with-values
           (lambda ()
             (split-choices engine t line
                            (append-map (lambda (target) (choices engine t target stay)) places)))
         (lambda (stops left-out)
           (tour-among (leg-asker engine t line) tether vehicle stops line left-out)))))))


;;; The flight.

(define tick 0.5)                       ; s between looks at winch and vehicle
(define stuck-way 0.3)                  ; m: no more of the way ...
(define stuck-time 30)                  ; s: ... in so long is stuck
(define ahead 4)                        ; s of flight for which line is out
(define spare 1.5)                      ; m beyond what a taut line takes, and 5 % of it
(define near-enough 0.3)                ; m of a place is there
(define slack-pull 15)                  ; N: no more is a line that can be taken in

(define (tend-line! tour speed)
  ;; Have as much out as the taut line takes, and a little more.
  (let* ((tether (%tether-of tour))
         (out (tether-length tether))
         (want (min (%line tour) (+ (* 1.05 (taut-length tether)) spare (* ahead speed)))))
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

(define (end-flight! task tour)
  ;; The last leg, or what is left of one that could not be flown, is flown home as `fly-home!' finds it.
  (release! (%vehicle-of tour))
  (remove-task! (this-dive 'fly-tour!) task)
  (unless (and (not (parted? (%tether-of tour))) (fly-home! (%tether-of tour)))
    (hold-position! (%vehicle-of tour))))

(define (next-leg task flight due place)
  (set-task-state! task (make-flight due (cdr (flight-legs flight)) #f (+ 1 (flight-reached flight)) place (now))))

(define (at-end? leg place)
  (< (distance place (last leg)) near-enough))

(define (fly-on task tour speed)
  (let* ((flight (task-state task)) (vehicle (%vehicle-of tour)) (step (%dive-steps (this-engine 'fly-tour!))))
    (when (>= step (flight-due flight))
      (let ((due (+ step (round (/ tick (time-step))))) (place (rov-position vehicle)))
        (tend-line! tour speed)
        (cond ((or (null? (cdr (flight-legs flight)))
                   (> (- (now) (flight-since flight)) stuck-time)
                   (parted? (%tether-of tour)))
               (end-flight! task tour))
              ((not (flight-begun? flight))
               (fly-along! vehicle (car (flight-legs flight)) #:speed speed)
               (set-task-state! task (moved-on flight due place)))
              ((at-end? (car (flight-legs flight)) place) (next-leg task flight due place))
              (else (set-task-state! task (moved-on flight due place))))))))

(define (set-out! who tour speed)
  ;; For the verb WHO; return the task.
  (held-vehicle who (list-index (lambda (name) (eq? name (%tether-of tour))) (%names (this-engine who) 'tether)))
  (release! (%vehicle-of tour))
  (add-task! 'fly-tour! "fly a tour" (lambda (task) (fly-on task tour speed))
             (make-flight 0 (%legs tour) #f 0 (rov-position (%vehicle-of tour)) (now))
             (%vehicle-of tour)))

(define (begin-flight! tour speed)
  "Let the present dive fly TOUR at SPEED while time passes; return the flight."
  (set-out! 'fly-tour! tour speed))

(define (places-reached flight)
  "Return how many places the FLIGHT has come to."
  (flight-reached (task-state flight)))

(define-verb (fly-tour! (tour tour) #:key (speed positive 0.35))
  "Fly TOUR at SPEED m/s while time passes in `run': the winch keeps a little more out than a taut tether takes, and
from the last place, or where the vehicle gets stuck, it comes home as `fly-home!' does.  Return the length of
the tour, m."
  (begin-flight! tour speed)
  (%length tour))

(define (flown tour speed)
  ;; Fly TOUR in the present dive to its end; how many places were reached.
  (let* ((task (set-out! 'tour-trial tour speed)) (dive (this-dive 'tour-trial))
         (most (+ 120 (/ (* 3 (+ (%length tour) (%needed tour))) speed))) (start (now)))
    (let loop ()
      (when (and (pair? (dive-tasks dive)) (< (- (now) start) most))
        (run 1)
        (loop)))
    (places-reached task)))

(define home-within 1.5)                ; m of the anchor, or of the surface below it

(define (is-home? tour)
  (and (not (parted? (%tether-of tour)))
       (< (distance (rov-position (%vehicle-of tour)) (home-of (%tether-of tour))) home-within)))

(define-verb (tour-trial (tour tour) #:key (speed positive 0.35))
  "Fly TOUR at SPEED m/s on a fork, where the tether has its slack and the water its current, and return an alist:
home? (whether the vehicle came home), reached (how many places), fouled?, seconds, tension (N, the most at the
vehicle or the winch since the dive began)."
  (untold-fork
   (lambda ()
     (let ((start (now)) (tether (%tether-of tour)))
       (let ((reached (flown tour speed)))
         `((home? . ,(is-home? tour)) (reached . ,reached) (fouled? . ,(fouled? tether))
           (seconds . ,(- (now) start)) (tension . ,(max-tension tether))))))))


;;; In words.

(define (place-said name)
  (if (symbol? name)
      (symbol->string name)
      (simple-format #f "(~a)" (string-join (map (lambda (c) (figure-said c)) (f64vector->list name)) " "))))

(define (stops-said tour)
  (if (null? (%stops tour))
      "Nothing can be visited."
      (simple-format #f "Visit ~a; home: ~a in all, and at most ~a of the ~a of tether."
                     (string-join (map place-said (tour-names tour)) ", ")
                     (metres (%length tour)) (metres (%needed tour)) (metres (%line tour)))))

(define (tour-said tour)
  (string-join (cons (stops-said tour)
                     (map (lambda (left) (simple-format #f "~a is left out: ~a." (place-said (car left)) (cdr left)))
                          (%left-out tour)))
               "  "))

(set-record-type-printer!
 <tour> (lambda (tour port) (simple-format port "#<tour: ~a>" (tour-said tour))))
