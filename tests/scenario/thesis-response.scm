;;; The collision response of the thesis (D. Manowitz, chapter 3), in dives: figures 1-2 and 3-2 to 3-8
;;; as worlds, and what its rules promise.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((srfi srfi-1) #:select (first second last fold map)))

(define core (* 1/4 0.0076))

(define (fly . places)
  (for-each (lambda (p)
              (move! p #:speed 1)
              (run-until arrived? #:at-most 20))
            places))

(define (clear?)
  (> (clearance) (- core)))

(define (objects)
  (map contact-object (contacts)))

(define (count-of kind)
  (length (filter (lambda (e) (eq? kind (car e))) (events))))

(define (profile-of what)
  (assq-ref (profile) what))

(define* (boxed #:key (model 'catenary) (length 20) (slides 'yes) (stick 36000) (count 'none)
                (by 'angle) (current 0.25) (toward 0) (rejoin 185))
  ;; A container with its edges upright and level; the line passes south of it, and the vehicle goes
  ;; round its south-east edge.
  (world (sea (depth 60) (current current toward))
         (box (named container) (at 0 3 -10) (size 6 6 6))
         (rov (named minnow) (at 9 -2 -10))
         (tether (named line) (type fathom) (wet-weight 0) (model ,model) (response thesis)
                 (from -9 -2 -10) (to minnow) (length length) (nodes 32) (sliding ,slides)
                 (stick-angle stick) (stick-count count) (stick-by ,by) (rejoin-angle rejoin))))


;;; Figures 3-2 to 3-4: where it collides, and where it is split.

(define-scenario (collision-point-and-split model)
  "A line drawn over an edge is split there: the right obstacle, outside it, and nothing goes deeper."
  #:for ((model 'rubber-band 'v-shape 'catenary))
  (in (boxed #:model model))
  (always (clear?) (fly '(9 4 -10) '(6 7 -10)))
  (require (pair? (contacts)))
  (expect (and-map (lambda (o) (eq? o 'container)) (objects)))
  (expect (and-map (lambda (c) (> (norm (contact-normal c)) 0.999)) (contacts)))
  (expect (length (segments)) => (+ 1 (length (contacts))))
  (expect (fold + 0 (map segment-length (segments))) is (about (tether-length) #:within 1e-6))
  (let ((before (length (contacts))))
    (always (clear?) (run 5))
    (expect (length (contacts)) => before)))


(define radius (* 1/2 0.0076))

(define (from-the-corner p)
  ;; How far P is from the container's upright south-east edge, east and south of it.
  (f64vector (- (x p) 3) (- (y p)) 0))

(define (planes-apart p)
  ;; The larger of the distances of P to the planes of the two faces at that edge.
  (let ((d (from-the-corner p)))
    (max (abs (x d)) (abs (y d)))))

(define (outside d)
  ;; How far a point D from that edge, by `from-the-corner', is from the container.
  (norm (vec (max 0 (x d)) (max 0 (y d)) 0)))

(define-scenario (break-point-at-an-edge model)
  "A link through both faces at an edge collides at their mean, within a radius of the edge; the mean normal
halves the edge's angle; along it the break point is moved out by the larger distance to the faces and sqrt 2
radii, a radius clear; and the next step splits nothing."
  #:for ((model 'rubber-band 'v-shape 'catenary 'catenary-simplex))
  (in (boxed #:model model #:toward 180))
  (move! '(9 4 -10) #:speed 1)
  (run-until arrived? #:at-most 20)
  (move! '(6 7 -10) #:speed 1)
  (run-until (lambda () (pair? (contacts))) #:at-most 10)
  (require (= 1 (length (contacts))))
  (let* ((c (first (contacts)))
         (mean (contact-position c))
         (normal (contact-normal c))
         (break (point-at (contact-arc-length c))))
    (expect (contact-object c) => 'container)
    (expect (norm (from-the-corner mean)) is (below radius))
    (expect normal is (about (vec* (sqrt 1/2) '(1 -1 0)) #:within (* 2 (sin (* 2.5 (/ (acos -1) 180))))))
    (expect (vec- break mean)
            is (about (vec* (+ (planes-apart mean) (* (sqrt 2) radius)) normal) #:within 1e-9))
    (expect (outside (from-the-corner break)) is (above radius))
    (step!)
    (expect (length (contacts)) => 1)))


;;; Figure 1-2: what is stuck does not move.

(define-scenario only-the-near-side-moves
  "Stuck, the anchor's side stays as it is while the vehicle goes on; and pay-out has no effect on it."
  (in (boxed #:slides 'no))
  (fly '(9 4 -10) '(7 6 -10))
  (run 2)
  (require (pair? (contacts)))
  (expect (stuck?))
  (let* ((contact (contact-position (first (contacts))))
         (s (contact-arc-length (first (contacts))))
         (point (point-at (* 1/2 s))))
    (fly '(5 9 -10))
    (expect (contact-position (first (contacts))) is (about contact #:within 1e-6))
    (expect (point-at (* 1/2 (contact-arc-length (first (contacts))))) is (about point #:within 1e-6))))


;;; When it sticks: by how far the normals turn, by how many contacts, by either, by both.

(define (contacts-until-stuck by)
  ;; Round three edges of the container; the number of contacts it first sticks with, and how far their
  ;; normals have turned, degrees.
  (with-dive (enter! (boxed #:model 'rubber-band #:length 40 #:stick 120 #:count 2 #:by by #:toward 180))
    (for-each (lambda (p)
                (move! p #:speed 1)
                (run-until (lambda () (or (stuck?) (arrived?))) #:at-most 20))
              '((9 4 -10) (6 7 -10) (3 9 -10) (-2 9 -10) (-6 8 -10) (-7 3 -10)))
    (require (stuck?))
    (list (length (contacts)) (turn-of-normals))))

(define (turn-of-normals)
  (let ((normals (map contact-normal (contacts))))
    (* (/ 180 (acos -1))
       (fold (lambda (a b sum)
               (let ((dot (+ (* (x a) (x b)) (* (y a) (y b)) (* (z a) (z b)))))
                 (+ sum (acos (max -1 (min 1 dot))))))
             0 normals (append (cdr normals) (list (last normals)))))))

(define-scenario sticking
  "A line that may have two contacts, or 120 degrees of turn, sticks by the one that was asked for, by the
first of them, or when both have come."
  (let ((angle (contacts-until-stuck 'angle))
        (count (contacts-until-stuck 'count))
        (either (contacts-until-stuck 'either))
        (both (contacts-until-stuck 'both)))
    (expect (first count) => 2)
    (expect (second count) is (below 120))
    (expect (first angle) is (above 2))
    (expect (second angle) is (above 120))
    (expect either => count)
    (expect both => angle)))

(define-scenario (both-wait-for-each-other case)
  "Where the normals have turned but the contacts are too few, it sticks by the angle and by either, not by the
count nor by both."
  #:for ((case '(angle #t) '(count #f) '(either #t) '(both #f)))
  (in (boxed #:model 'rubber-band #:length 40 #:stick 40 #:count 4 #:by (first case) #:toward 180))
  (fly '(9 4 -10) '(6 7 -10) '(3 9 -10))
  (require (< 1 (length (contacts)) 4))
  (expect (turn-of-normals) is (above 40))
  (expect (stuck?) => (second case)))


;;; Rejoining.

(define-scenario (the-way-back-undoes-it model)
  "Driven back, the contact is left, once, and the line is whole again."
  #:for ((model 'rubber-band 'catenary))
  (in (boxed #:model model #:toward 180))
  (fly '(9 4 -10) '(6 7 -10))
  (require (pair? (contacts)))
  (fly '(9 4 -10) '(9 -2 -10))
  (run 3)
  (expect (contacts) => '())
  (expect (length (segments)) => 1)
  (expect (count-of 'left) => 1)
  (expect (tether-length) => 20))


(define (dither degrees)
  ;; Swing the vehicle to and fro by DEGREES about where the line would be straight over the edge; return
  ;; every count of contacts that was seen, in order.
  (let ((straight (atan 2 12)) (seen (list (length (contacts)))))
    (define (note!)
      (unless (= (car seen) (length (contacts)))
        (set! seen (cons (length (contacts)) seen))))
    (for-each (lambda (d)
                (let ((a (+ straight (* d (/ (acos -1) 180)))))
                  (move! (list (+ 3 (* 7 (cos a))) (* 7 (sin a)) -10) #:speed 1)
                  (run-until (lambda () (note!) (arrived?)) #:at-most 30)))
              (append degrees (list (- (car degrees))) degrees degrees degrees))
    (reverse seen)))

(define-scenario (no-flapping model)
  "Swinging by 4.9 degrees about 180 leaves the contact as it is, or takes it off once; at 190 it is off. With
180 as the angle to rejoin at, the thesis' failure, it comes and goes."
  #:for ((model 'rubber-band 'v-shape 'catenary))
  (in (boxed #:model model #:toward 180))
  (fly '(9 4 -10) '(6 7 -10))
  (require (= 1 (length (contacts))))
  (expect (length (dither '(4.9 -4.9))) is (below 3))
  (dither '(-10))
  (expect (contacts) => '())
  (in (boxed #:model 'rubber-band #:toward 180 #:rejoin 180))
  (fly '(9 4 -10) '(6 7 -10))
  (expect (length (dither '(4.9 -4.9))) is (above 5)))


;;; Figure 3-5: the back side.

(define-scenario (lee-side model)
  "A contact on the lee face persists, its span a rubber band, and nothing goes deeper."
  #:for ((model 'catenary 'v-shape))
  (in (boxed #:model model #:current 0.5 #:toward 180))
  (fly '(9 4 -10) '(6 7 -10) '(0 9 -10))
  (require (pair? (contacts)))
  (run 5)
  (let ((n (length (contacts))))
    (always (and (clear?) (pair? (contacts))) (run 60))
    (expect (length (contacts)) => n)))


;;; Figure 3-6: a new bow that would hit another face.

(define-scenario immediate-collision
  "Toward the obstacle and back to the side again: the line is never through it."
  (in (boxed #:current 0.5))
  (always (clear?)
    (fly '(9 4 -10) '(3.5 7 -10) '(-2 7 -10) '(3.5 7 -10) '(-4 8 -10) '(6 7 -10))))


;;; Figure 3-7: sliding at constant length.

(define-scenario sliding
  "What the vehicle takes the bent span gives: the whole keeps its length."
  (in (boxed #:length 28))
  (fly '(9 4 -10) '(6 7 -10))
  (require (pair? (contacts)))
  (always (< (abs (- (fold + 0 (map segment-length (segments))) 28)) 0.028)
    (fly '(6 11 -10) '(6 7 -10))))

(define-scenario taut-stop
  "When nothing is left to give, the vehicle stops, without a jerk and not through anything."
  (in (boxed))
  (fly '(9 4 -10) '(6 7 -10))
  (move! '(0 40 -10) #:speed 1)
  (always (clear?) (run 30))
  (expect (count-of 'taut) is (above 0))
  (expect (fold + 0 (map (lambda (s) (apply distance (segment-ends s))) (segments)))
          is (about 20 #:within 0.001))
  (let ((p (rov-position)))
    (always (< (distance p (rov-position)) 0.01) (run 5))))


;;; Work is done where something changed.

(define-scenario only-what-changed-is-solved
  "Nothing is solved while nothing moves."
  (in (boxed #:slides 'no #:length 24))
  (fly '(9 4 -10) '(6 7 -10))
  (require (arrived?))
  (run 2)
  (let ((solves (profile-of 'span-solves)))
    (run 2)
    (expect (profile-of 'span-solves) => solves)))


;;; Figure 3-8: the platform.

(define-scenario platform
  "Round two legs of a jacket: several contacts, stuck, and pay-out changes nothing."
  (in (world (sea (depth 40) (current 0.25 90))
             (splice (make-jacket #:depth 36 #:bays 2 #:top 2))
             (rov (named minnow) (at -10 -14 -8))
             (tether (named line) (type fathom) (wet-weight 0) (model catenary) (response thesis)
                     (stick-angle 90) (from 0 -22 -6) (to minnow) (length 60))))
  (always (clear?)
    (fly '(-10 -2 -8) '(0 -2 -8) '(10 -2 -8) '(10 -12 -8)))
  (expect (length (contacts)) is (above 1))
  (expect (stuck?))
  (let ((p (rov-position)) (t (rov-tension)))
    (pay-out! 10 #:rate 2)
    (run 8)
    (expect (rov-position) is (about p #:within 0.01))
    (expect (rov-tension) is (about t #:within (+ 0.01 (* 0.02 t))))))
