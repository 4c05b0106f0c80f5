;;; (bight dive contact) --- what touches what, and how near things are.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive contact)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive query) #:select (find-part))
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-11)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (contacts
            contact? contact-object contact-triangle contact-position contact-normal
            contact-arc-length contact-force contact-state contact-tail?
            segments
            segment? segment-model segment-from segment-to segment-length segment-ends segment-tail?
            clearance rov-clearance
            collide! collided? stuck?
            wear wear-profile
            obstacle-index))


;;; Contacts.

(define-record <contact>
  (make-contact object triangle position normal arc-length force slides? tail?)
  contact-record?
  (object %object)
  (triangle %triangle)
  (position %position)
  (normal %normal)
  (arc-length %arc-length)
  (force %force)
  (slides? %slides?)
  (tail? %tail?))

(define (rounded x)
  (/ (round (* 100 x)) 100))

(set-record-type-printer!
 <contact>
 (lambda (c port)
   (format port "#<contact with ~a at ~a m, ~a, ~a N>" (%object c) (rounded (%arc-length c))
           (if (%slides? c) "slides" "sticks") (rounded (norm (%force c))))))

(define-argument-type (contact value)
  "a contact, as (contacts) lists them"
  (if (contact-record? value) value refused))

(define-verb (contact? (object any))
  "Return #t if OBJECT is a contact."
  (contact-record? object))
(define-verb (contact-object (c contact))
  "Return the name of what is touched in the contact C: an obstacle, or a tether."
  (%object c))
(define-verb (contact-triangle (c contact))
  "Return the id of the triangle of the contact C with a mesh, else #f."
  (%triangle c))
(define-verb (contact-position (c contact))
  "Return where on the obstacle the contact C is, a point."
  (%position c))
(define-verb (contact-normal (c contact))
  "Return the unit vector from the obstacle to the tether at the contact C."
  (%normal c))
(define-verb (contact-arc-length (c contact))
  "Return where on the tether the contact C is, metres of arc length from the anchor; of the far part of a tether that
has parted it is counted on beyond the part at the anchor, with the piece that drifted off between them."
  (%arc-length c))
(define-verb (contact-force (c contact))
  "Return the force on the tether at the contact C, N, a vector; zero with a static model."
  (%force c))
(define-verb (contact-state (c contact))
  "Return `stick' or `slide', what the tether does at the contact C."
  (if (%slides? c) 'slide 'stick))
(define-verb (contact-tail? (c contact))
  "Return #t if the contact C is that of the far part of a tether that has parted."
  (%tail? c))

(define-verb (contacts #:subject (t tether))
  "Return where the tether touches obstacles, other tethers, hulls of vehicles that it is not made fast to
and, at either place, itself, from the anchor on: a list of contacts; of a tether that has parted those of both parts."
  (map (lambda (v) (apply make-contact (vector->list v)))
       (%contacts (this-engine 'contacts) t)))


;;; Segments.

(define-record <segment>
  (make-segment model from to a b tail?)
  segment-record?
  (model %model) (from %from) (to %to) (a %a) (b %b) (tail? %of-tail?))

(set-record-type-printer!
 <segment>
 (lambda (s port)
   (format port "#<segment ~a m, ~a>" (rounded (- (%to s) (%from s))) (%model s))))

(define-argument-type (segment value)
  "a segment, as (segments) lists them"
  (if (segment-record? value) value refused))

(define-verb (segment? (object any))
  "Return #t if OBJECT is a segment."
  (segment-record? object))
(define-verb (segment-model (s segment))
  "Return the model of the segment S, a symbol."
  (%model s))
(define-verb (segment-from (s segment))
  "Return where the segment S begins, metres of arc length from the anchor, counted as `contact-arc-length' counts."
  (%from s))
(define-verb (segment-to (s segment))
  "Return where the segment S ends, metres of arc length from the anchor."
  (%to s))
(define-verb (segment-length (s segment))
  "Return the length of the segment S, m."
  (- (%to s) (%from s)))
(define-verb (segment-ends (s segment))
  "Return the two ends of the segment S, a list of points."
  (list (%a s) (%b s)))
(define-verb (segment-tail? (s segment))
  "Return #t if the segment S is that of the far part of a tether that has parted."
  (%of-tail? s))

(define-verb (segments #:subject (t tether))
  "Return the spans of the tether between its contacts, from the anchor on: a list of segments, one when
it touches nothing; of a tether that has parted those of both parts."
  (map (lambda (v) (apply make-segment (vector->list v)))
       (%segments (this-engine 'segments) t)))


;;; How near.

(define (obstacle-index proc name)
  "Return the number of the obstacle called NAME, or raise a &bight-error from PROC."
  (let ((names (%names (this-engine proc) 'obstacle)))
    (or (list-index (lambda (other) (eq? name other)) names)
        (unknown-name proc "this dive" name names "obstacle"))))

(define (hull-index proc name)
  "Return the number of the hull of the vehicle called NAME as what a tether touches, or #f."
  (let ((v (list-index (lambda (other) (eq? name other)) (%names (this-engine proc) 'rov))))
    (and v (hull-number proc v))))

(define (nearest proc part index object)
  (let ((hull (and object (eq? part 'tether) (hull-index proc object))))
    (%clearance (this-engine proc) part index (cond (hull hull) (object (obstacle-index proc object)) (else -1)))))

(define-argument-type (maybe-name value)
  "the name of an obstacle, or of a vehicle"
  (if (or (not value) (symbol? value)) value refused))

(define (clearance-of proc part index object)
  (let ((near (nearest proc part index object)))
    (if near (car near) +inf.0)))

(define-verb (clearance #:subject (t tether) #:optional (object maybe-name #f))
  "Return the distance between the tether's surface and OBJECT, an obstacle or the hull of another's
vehicle, or the nearest obstacle, m; infinite when none is within 1000 m."
  (clearance-of 'clearance 'tether t object))

(define-verb (rov-clearance #:subject (v vehicle) #:optional (object maybe-name #f))
  "Return the distance between the vehicle's hull and OBJECT, or the nearest obstacle, m; infinite when
none is within 1000 m."
  (clearance-of 'rov-clearance 'rov v object))


;;; Pairs.

(define (pair-of proc a b)
  ;; Head and index of the vehicle or tether, and the number of the obstacle or other tether, of A and B.
  (let-values (((kind-a a*) (find-part proc a))
               ((kind-b b*) (find-part proc b)))
    (cond ((and (eq? kind-b 'obstacle) (memq kind-a '(vehicle tether))) (values kind-a a* b*))
          ((and (eq? kind-a 'tether) (eq? kind-b 'tether))
           (values kind-a a* (+ b* (length (%names (this-engine proc) 'obstacle)))))
          ((and (eq? kind-a 'obstacle) (memq kind-b '(vehicle tether))) (values kind-b b* a*))
          ((and (eq? kind-a 'tether) (eq? kind-b 'vehicle)) (values kind-a a* (hull-number proc b*)))
          ((and (eq? kind-a 'vehicle) (eq? kind-b 'tether)) (values kind-b b* (hull-number proc a*)))
          (else
           (bight-raise 'name proc
                        "a pair is a vehicle or a tether and an obstacle, two tethers, or a tether and a \
vehicle, not ~a and ~a"
                        a b)))))

(define (hull-number proc v)
  ;; As what a tether touches, the hull of vehicle number V stands behind the obstacles and the tethers.
  (+ v (length (%names (this-engine proc) 'obstacle)) (length (%names (this-engine proc) 'tether))))

(define (part-number kind)
  (case kind ((vehicle) 1) ((tether) 2) (else 0)))

(define (switch! kind index obstacle on?)
  (%operate! (this-engine 'collide!) 'collide! 'collide! index
             (f64vector (part-number kind) obstacle (if on? 1 0))))

(define-argument-type (setting value)
  "two names and #t or #f, or #:all and #t or #f"
  value)

(define-verb (collide! #:rest (setting setting))
  "Switch the pair of a vehicle or a tether A and an obstacle B on or off, as in (collide! 'line 'leg-a1
#f); likewise two tethers, a tether and itself, as in (collide! 'line 'line #f), or a tether and the hull
of a vehicle that it is not made fast to; all pairs with (collide! #:all #f).  A pair that is off passes through each other; at first all are on, a moving line and
itself in open water too.  Return whether it is on."
  (let ((on? (and (pair? setting) (last setting))))
    (cond ((and (= 2 (length setting)) (eq? #:all (car setting)) (boolean? on?))
           (switch! #f 0 -1 on?))
          ((and (= 3 (length setting)) (every symbol? (take setting 2)) (boolean? on?))
           (let-values (((kind index obstacle)
                         (pair-of 'collide! (first setting) (second setting))))
             (switch! kind index obstacle on?)))
          (else
           (bight-raise 'domain 'collide!
                        "say (collide! A B #f), names and on or off, or (collide! #:all #f), not ~a"
                        (brief setting))))
    on?))

(define-verb (collided? (a name) (b name))
  "Return #t if the vehicle or tether A and the obstacle B met in the last step; or two tethers, a tether
and itself, or a tether and the hull of another's vehicle."
  (let-values (((kind index obstacle) (pair-of 'collided? a b)))
    (%collided? (this-engine 'collided?) (if (eq? kind 'vehicle) 'rov 'tether) index obstacle)))

(define-verb (stuck? #:subject (t tether))
  "Return #t if the tether is pulled, by its vehicle or its winch, and its end has moved less than 2 cm/s for 5
s, on the mean, whatever holds it; in the response of the thesis, if its rules say so."
  (assq-ref (%tether (this-engine 'stuck?) t) 'stuck?))


;;; Wear.

(define-verb (wear #:subject (t tether) #:key (at (or-false number) #f))
  "Return the share of the tether's jacket that is worn where it is worn most, 0 to 1 (worn through) and
beyond, or at arc length AT metres from the anchor.  The moving line wears where it slides on something:
by the work of friction, times the `abrasiveness' of the obstacle, over the `wear-energy' of the tether.
At its `wear-limit' the event `worn' comes.  Models at rest wear nothing."
  (%wear (this-engine 'wear) t at))

(define-argument-type (places-wanted value)
  "how many places, a whole number from 2 to 100000"
  (if (and (exact-integer? value) (<= 2 value 100000)) value refused))

(define-verb (wear-profile #:subject (t tether) (n places-wanted))
  "Return the shares of the jacket worn at N places equally spaced in arc length, both ends included, an
f64vector; see `wear'."
  (let* ((engine (this-engine 'wear-profile))
         (length (assq-ref (%tether engine t) 'length))
         (place (lambda (k) (* length (/ k (- n 1))))))
    (list->f64vector (map (lambda (k) (%wear engine t (place k))) (iota n)))))
