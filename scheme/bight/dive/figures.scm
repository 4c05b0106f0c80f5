;;; (bight dive figures) --- what a tether's state comes to in a number: how much lies on what, how sharply it
;;; bends, how often it snapped taut, how hard it pulls its vehicle.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive figures)
  #:use-module (bight core errors)
  #:use-module ((bight core schema) #:select (field-default head-field reference? reference-name))
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive contact)
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module ((bight world) #:select (part-all-fields part-head world-part))
  #:use-module (srfi srfi-1)
  #:export (contact-length seabed-length bend-ratio snap-count thrust-share
            ;; For (bight dive homing) and (bight dive tour).
            held-vehicle
            ;; For (bight dive aware).
            refuse-parted))

(define-argument-type (maybe-object value)
  "the name of an obstacle"
  (if (or (not value) (symbol? value)) value refused))

(define-verb (contact-length #:subject (t tether) #:optional (object maybe-object #f))
  "Return how much of the tether lies on OBJECT, or on anything, m; of one that has parted, of both parts."
  (%contact-length (this-engine 'contact-length) t
                   (if object (obstacle-index 'contact-length object) -1) #f))

(define-verb (seabed-length #:subject (t tether) #:key (dragged flag #f))
  "Return how much of the tether lies on the sea bed, m; with DRAGGED only what slides over it; of a tether that has parted,
of both parts."
  (let* ((engine (this-engine 'seabed-length))
         (world (dive-world (this-dive 'seabed-length)))
         (bed (list-index (lambda (name) (eq? 'seabed (part-head (world-part world name))))
                          (%names engine 'obstacle))))
    (if bed (%contact-length engine t bed dragged) 0.0)))

(define-verb (bend-ratio #:subject (t tether))
  "Return the radius of the tether's tightest bend over the tightest allowed: below 1 it suffers; infinite
when it has no least radius."
  (let ((least (assq-ref (tether-properties t) 'min-bend-radius))
        (radius (%tightest-bend (this-engine 'bend-ratio) t)))
    (if (zero? least) +inf.0 (/ radius least))))

(define-verb (snap-count #:subject (t tether))
  "Return how often the slack tether came taut with a jerk, among the events that are kept."
  (let* ((engine (this-engine 'snap-count))
         (name (list-ref (%names engine 'tether) t)))
    (count (lambda (event) (and (eq? (car event) 'snapped) (eq? (caddr event) name)))
           (%events engine 0))))

(define (own-fields name)
  (part-all-fields (world-part (dive-world (this-dive 'thrust-share)) name)))

(define (vehicle-of t)
  ;; The name of the vehicle at the far end of tether number T, or #f.
  (let* ((engine (this-engine 'thrust-share))
         (end (assq-ref (own-fields (list-ref (%names engine 'tether) t)) 'to)))
    (find (lambda (name) (eq? name (if (reference? end) (reference-name end) end)))
          (%names engine 'rov))))

(define (refuse-parted who t)
  "Raise unsupported in WHO when tether number T has parted: the rest of it leads its vehicle nowhere."
  (when (assq-ref (%tether (this-engine who) t) 'parted?)
    (bight-raise 'unsupported who "`~a' has parted: the rest of it leads its vehicle nowhere"
                 (list-ref (%names (this-engine who) 'tether) t))))

(define (held-vehicle who t)
  "Return the name of the vehicle that tether number T holds; raise unsupported in WHO when there is none, or when the
tether has parted."
  (refuse-parted who t)
  (or (vehicle-of t)
      (bight-raise 'unsupported who "no vehicle is at the far end of `~a'"
                   (list-ref (%names (this-engine who) 'tether) t))))

(define (full-pull vehicle)
  ;; What VEHICLE, a name, can hold a tether with, N.
  (or (assq-ref (own-fields vehicle) 'pull) (field-default (head-field 'rov 'pull))))

(define-verb (thrust-share #:subject (t tether))
  "Return the force of the tether on its vehicle over the pull that the world gives the vehicle."
  (let ((vehicle (vehicle-of t)))
    (if (and vehicle (positive? (full-pull vehicle)))
        (/ (norm (assq-ref (%tether (this-engine 'thrust-share) t) 'force)) (full-pull vehicle))
        (bight-raise 'unsupported 'thrust-share "no vehicle that pulls is at the tether's far end"))))
