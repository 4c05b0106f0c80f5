;;; (bight belief readings) --- what instruments and people tell, and how well each member of a belief foretold it.
;;;
;;; A reading of numbers has Gaussian noise, each number by itself.  An event was seen or not seen to happen, and
;;; whoever told it may be wrong.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief readings)
  #:use-module (bight belief cloud)
  #:use-module (bight belief unknowns)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core units)
  #:use-module ((bight dive contact) #:select (contacts contact-object))
  #:use-module ((bight dive) #:select (engine-of))
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (reading-kinds
            event?
            of-vehicle?
            check-reading
            one-or-all
            usual-noise
            predicted
            log-chance))

;; KIND, the noise where none is given, the unit.
(define kinds
  '((payout 0.05 "m") (winch-tension 1.0 "N") (rov-tension 1.0 "N") (position 0.3 "m") (heading 2.0 "degrees")
    (depth 0.1 "m") (transponder 0.1 "m") (touched 0.05 "") (seen 0.3 "m")))

(define reading-kinds (map car kinds))

(define (usual-noise kind)
  "Return the noise of readings of KIND where none is told."
  (second (assq kind kinds)))

(define (event? kind)
  "Return true if a reading of KIND is not of numbers with noise."
  (memq kind '(touched seen)))

(define (of-vehicle? kind)
  "Return true if a reading of KIND is of a vehicle; others are of a tether."
  (memq kind '(position heading depth)))

(define (touched-name value)
  ;; (NAME . TRUE) from NAME or (not NAME).
  (cond ((symbol? value) (cons value #t))
        ((and (list? value) (= 2 (length value)) (eq? 'not (car value)) (symbol? (cadr value)))
         (cons (cadr value) #f))
        (else (bight-raise 'domain 'observe! "touched takes the name of an obstacle, or (not NAME), not ~s" value))))

(define (check-reading kind value)
  "Return VALUE, of a reading of KIND, in its canonical form: an f64vector of numbers, a point, or for `touched'
a pair of a name and what was told.  Raise a &bight-error where a value is of another kind."
  (case kind
    ((position transponder seen) (check-argument 'observe! kind type:point value))
    ((touched)
     (let ((told (touched-name value)))
       (find-part 'observe! (car told))
       told))
    ((payout winch-tension rov-tension heading depth)
     (f64vector (check-argument 'observe! kind type:number value)))
    (else (unknown-name 'observe! "a belief" kind reading-kinds "reading"))))

(define (one-or-all value)
  "Return VALUE, of a reading in its canonical form, as `observe!' takes it: a number where one is read, else as it is."
  (if (and (f64vector? value) (= 1 (f64vector-length value))) (f64vector-ref value 0) value))

(define (nearest-turn degrees value)
  ;; DEGREES, by whole turns as near to VALUE as may be.
  (+ degrees (* 360 (round (/ (- value degrees) 360)))))

(define (predicted reading member unknowns)
  "Return what READING would have been, without noise, were MEMBER, one with UNKNOWNS, the truth: an f64vector;
of an event its chance."
  (let ((subject (car (reading-part reading))) (value (reading-value reading)))
    (in-member
     member
     (lambda ()
       (case (reading-kind reading)
         ((payout) (f64vector (+ (tether-length subject) (error-counted member unknowns subject))))
         ((winch-tension) (f64vector (anchor-tension subject)))
         ((rov-tension) (f64vector (rov-tension subject)))
         ((position) (rov-position subject))
         ((heading) (f64vector (nearest-turn (rov-heading subject) (f64vector-ref value 0))))
         ((depth) (f64vector (rov-depth subject)))
         ((transponder) (point-at subject (min (cadr (reading-part reading)) (tether-length subject))))
         ((seen) (f64vector (chance-seen reading)))
         ((touched) (f64vector (chance-touched reading))))))))

(define (error-counted member unknowns tether)
  ;; How much more the counter of the winch of TETHER shows in MEMBER: the clause payout is about the first one's.
  (if (eq? tether (car (%names (engine-of (member-dive member)) 'tether)))
      (counter-error unknowns (member-latent member))
      0.0))

(define (chance-touched reading)
  ;; Of what was told, the noise being how often such a report is false.
  (let* ((told (reading-value reading))
         (touches? (and (member (car told) (map contact-object (contacts (car (reading-part reading))))) #t)))
    (if (eq? touches? (cdr told)) (- 1 (reading-noise reading)) (reading-noise reading))))

(define (row polyline i)
  (f64vector (array-ref polyline i 0) (array-ref polyline i 1) (array-ref polyline i 2)))

(define (dot a b)
  (+ (* (x a) (x b)) (* (y a) (y b)) (* (z a) (z b))))

(define (distance-to-segment p a b)
  (let* ((along (vec- b a))
         (square (dot along along))
         (share (if (zero? square) 0 (max 0 (min 1 (/ (dot (vec- p a) along) square))))))
    (distance p (vec+ a (vec* share along)))))

(define (distance-to-tether p tether)
  (let ((line (tether-points tether)))
    (fold (lambda (i least) (min least (distance-to-segment p (row line i) (row line (+ i 1)))))
          +inf.0 (iota (- (array-length line) 1)))))

(define (chance-seen reading)
  (let ((off (/ (distance-to-tether (reading-value reading) (car (reading-part reading))) (reading-noise reading))))
    (exp (* -0.5 off off))))

(define (log-chance reading prediction)
  "Return the logarithm of the likelihood of READING, but for a constant, where PREDICTION is what it would have
been."
  (if (reading-scalars reading)
      (fold (lambda (value expected sum)
              (let ((off (/ (- value expected) (reading-noise reading))))
                (- sum (* 0.5 off off))))
            0.0 (f64vector->list (reading-scalars reading)) (f64vector->list prediction))
      (log (max 1e-300 (f64vector-ref prediction 0)))))
