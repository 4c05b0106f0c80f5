;;; (bight dive tour) --- tours: places visited in an order and by ways that bring the tether home unwound.
;;;
;;; Between any two places the vehicle flies the leg that takes the tether from the free way of the one to the
;;; free way of the other (bt_tether_leg in C), so that the tether is wound about nothing at any place, in
;;; whatever order the places come.  What is left is to choose the order: that of the shortest tour, exactly by
;;; dynamic programming over subsets for few places (Held and Karp 1962), by cheapest insertion and exchanges
;;; of two legs (Croes 1958) for many.
;;;
;;; The legs see a tether drawn tight.  Whether a slack one in a current comes home is tried by flying the tour on a
;;; fork, (bight dive tour-flight), or on the tethers of a belief, which (bight belief tour) does where `plan-tour' is
;;; asked to.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive tour)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (members-of))
  #:use-module ((bight dive figures) #:select (held-vehicle))
  #:use-module (bight dive command)
  #:use-module ((bight dive homing) #:select (untold-fork))
  #:use-module (bight dive plain-words)
  #:use-module (bight dive query)
  #:use-module (bight dive tour-order)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (tour? tour-names tour-places tour-way tour-length tour-line-needed tour-left-out tour-risk
            ;; For (bight dive tour-flight).
            type:tour (%tether-of . tour-tether) (%vehicle-of . tour-vehicle) (%legs . tour-legs) (%line . tour-line)
            ;; For (bight belief tour).
            type:places tour-found tour-at-risk
            ;; For (bight bench tours).
            tour-along))

(define-record <tour>
  (make-tour tether vehicle stops legs length needed line left-out risk)
  is-tour?
  (tether %tether-of)                   ; its name
  (vehicle %vehicle-of)                 ; the name of the one at its far end
  (stops %stops)                        ; (NAME . POINT) in the order in which they are visited
  (legs %legs)                          ; the ways to each stop and then home, lists of points
  (length %length)                      ; m, of all legs
  (needed %needed)                      ; m of tether, drawn tight, at most
  (line %line)                          ; m of tether there are
  (left-out %left-out)                  ; (NAME . WHY), WHY a string
  (risk %risk))                         ; (PROBABILITY LOW HIGH) of trouble where it is greatest, or #f: nobody asked

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

(define-verb (tour-risk (tour tour))
  "Return the list (PROBABILITY LOW HIGH): how probably the tether is fouled, or the vehicle does not come there, at that
place of the tour, or at home, where it is likeliest, and Wilson's interval of that; #f where `plan-tour' was given no
#:risk."
  (%risk tour))

(define (tour-at-risk tour risk)
  "Return TOUR, with RISK, a list as `tour-risk' returns it."
  (make-tour (%tether-of tour) (%vehicle-of tour) (%stops tour) (%legs tour) (%length tour) (%needed tour) (%line tour)
             (%left-out tour) risk))


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
             (fold max 0 (map second legs)) line left-out #f))

(define (tour-along tether vehicle stops legs length line)
  "Return the tour of VEHICLE on TETHER, names, to STOPS, lists of three numbers, by LEGS, each a list of points: the last
is the leg home, which a flight follows to its end.  LENGTH is that of all of them, m, and LINE how much tether there is."
  (make-tour tether vehicle (map (lambda (p) (let ((p (list->f64vector p))) (cons p p))) stops)
             (append legs (list (last legs))) length line line '() #f))

(define (in-best-order asker stops)
  ;; STOPS in the order of the shortest tour.
  (let* ((all (list->vector stops)) (n (vector-length all)))
    (define (stop k) (and (< -1 k n) (vector-ref all k)))
    (define (cost i j)
      (let ((leg (asker (stop i) (stop j))))
        (if (leg? leg) (first leg) too-long)))
    (map stop (best-order n cost))))

(define (tours-near asker tether vehicle order line left-out)
  ;; The tour of the stops in ORDER, and those with a stretch of it turned round that can be flown, the shorter first.
  (let ((tours (filter-map (lambda (order)
                             (let ((legs (legs-in-order asker order)))
                               (and (every leg? legs) (tour-of tether vehicle order legs line left-out))))
                           (near-orders order))))
    (stable-sort tours (lambda (a b) (< (%length a) (%length b))))))

(define (tour-among asker tether vehicle stops line left-out choose)
  ;; The tour of STOPS that CHOOSE takes; a stop that no leg leads to, or away from, is left out.
  (let* ((order (in-best-order asker stops))
         (legs (legs-in-order asker order))
         (bad (list-index (negate leg?) legs)))
    (define (without k why)
      (let ((lost (list-ref order k)))
        (tour-among asker tether vehicle (delq lost stops) line (acons (car lost) why left-out) choose)))
    (cond
     ((not bad)
      (let ((chosen (choose (lambda () (tours-near asker tether vehicle order line left-out))
                            (tour-of tether vehicle order legs line left-out))))
        (if (is-tour? chosen) chosen (without (car chosen) (cdr chosen)))))
     ((null? order)
      (bight-raise 'unsupported 'plan-tour "no way leads home from where `~a' is: ~a" vehicle (car legs)))
     (else
      (without (min bad (- (length order) 1)) (list-ref legs bad))))))

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

(define* (tour-found t places stay line #:optional (choose (lambda (others shortest) shortest)))
  "Return the tour of the vehicle of tether number T to PLACES, seen from STAY m off, with LINE m of tether, or what is on
the drum if that is #f.  CHOOSE is called with a thunk that returns tours like the shortest, the shorter first, and with
that; it returns the tour that is taken, or a pair of the number of a stop of the shortest that is to be left out, and why."
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
           (tour-among (leg-asker engine t line) tether vehicle stops line left-out choose)))))))


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

(define (risk-said tour)
  (apply simple-format #f "P(fouled) ~a (~a to ~a)." (map percent-said (%risk tour))))

(define (tour-said tour)
  (string-join (append (list (stops-said tour))
                       (if (%risk tour) (list (risk-said tour)) '())
                       (map (lambda (left) (simple-format #f "~a is left out: ~a." (place-said (car left)) (cdr left)))
                            (%left-out tour)))
               "  "))

(set-record-type-printer!
 <tour> (lambda (tour port) (simple-format port "#<tour: ~a>" (tour-said tour))))
