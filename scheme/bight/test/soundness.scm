;;; (bight test soundness) --- what every dive must be, whatever its world, its models and its orders.
;;;
;;; What the dive answers about each of its tethers is gathered as plain data, and judged by laws that know
;;; no solver: a line is no longer than it is, its ends are where they are held, what pulls at a line at
;;; rest is in balance.  Margins come from what the dive itself states (tension over stiffness,
;;; `error-estimate'), or from the rounding of numbers.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test soundness)
  #:use-module (bight core errors)
  #:use-module ((bight core schema) #:select (least-mass))
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive aware)
  #:use-module (bight dive contact)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module ((bight world) #:select (part-all-fields world-part))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (tether-answers
            tether-laws
            judge-tether
            tether-names
            free-class-unwound
            wound-though-free
            at-rest?
            imbalance))

(define (tether-names)
  "Return the names of the tethers of the dive."
  (%names (this-engine 'tether-names) 'tether))


;;; What a dive answers about one of its tethers, an alist.

(define pieces 24)                      ; of equal arc length, of which a tether is judged

(define-syntax-rule (if-supported expression)
  ;; The value of EXPRESSION, or #f where the model has no answer.
  (with-exception-handler
      (lambda (e)
        (if (and (bight-error? e) (eq? 'unsupported (bight-error-kind e))) #f (raise-exception e)))
    (lambda () expression)
    #:unwind? #t))

(define (rows array)
  (map (lambda (i) (f64vector (array-ref array i 0) (array-ref array i 1) (array-ref array i 2)))
       (iota (array-length array))))

(define (given name)
  ;; The fields that the world gives to the part NAME.
  (part-all-fields (world-part (dive-world (this-dive 'tether-answers)) name)))

(define (holder name key)
  ;; Where the end KEY of the tether NAME is held, (POINT . OFF): OFF metres from POINT.
  (let ((end (assq-ref (given name) key)))
    (if (symbol? end)
        (cons (rov-position end) (tether-point-off (given end)))
        (cons end 0))))

(define (tether-point-off vehicle)
  ;; How far from its place a vehicle with mass carries its tether.
  (if (positive? (or (assq-ref vehicle 'mass) 0))
      (norm (or (assq-ref vehicle 'tether-point) '(0 0 0)))
      0))

(define (ride name)
  ;; How far waves may carry the anchor of NAME, m: at most twice their height, by the share that it takes.
  (let ((shares (assq-ref (given name) 'ride))
        (height (list-ref (f64vector->list (assq-ref (%sea (this-engine 'tether-answers)) 'waves)) 1)))
    (if shares (* 2 height (norm shares)) 0)))

(define (off-tail tail place)
  ;; How far PLACE is from the nearest of the nodes TAIL, m, beyond half of the longest interval.
  (max 0 (- (apply min (map (lambda (node) (distance node place)) tail))
            (* 1/2 (apply max (map distance tail (cdr tail)))))))

(define (place-on-line name tail contact)
  ;; (METRES-FROM-ANCHOR METRES-OFF OBJECT) of CONTACT of the tether NAME, whose other part has the nodes TAIL.
  (let ((s (contact-arc-length contact)) (place (contact-position contact)))
    (list s
          (if (contact-tail? contact) (off-tail tail place) (distance (point-at name s) place))
          (contact-object contact))))

(define (tether-answers name)
  "Return what the present dive answers about the tether NAME, an alist."
  (let* ((t (list-index (lambda (n) (eq? n name)) (tether-names)))
         (tail (and=> (tether-tail name) rows)))
    `((name . ,name)
      (fields . ,(tether-properties t))
      (sea . ,(%sea (this-engine 'tether-answers)))
      (drum . ,(or (assq-ref (given name) 'drum) +inf.0))
      (length . ,(tether-length name))
      (points . ,(rows (tether-points name (+ pieces 1))))
      (tensions . ,(f64vector->list (tensions name (+ pieces 1))))
      (ends . ,(list (anchor-tension name) (rov-tension name)))
      (max-tension . ,(max-tension name))
      (force . ,(tether-force name))
      (anchor . ,(holder name 'from))
      (far-end . ,(holder name 'to))
      (ride . ,(ride name))
      (error . ,(if-supported (error-estimate name)))
      (contacts . ,(map (lambda (c) (place-on-line name tail c)) (contacts name)))
      (parted? . ,(parted? name))
      (tail . ,tail)
      (strain-energy . ,(or (assq-ref (or (if-supported (energy name)) '()) 'strain) 0)))))


;;; The laws: each takes the answers, and returns #f or what is wrong, a sentence.

(define rounding 1e-5)                  ; m; a kinematic end is held to a micrometre

(define (field answers key)
  (assq-ref (assq-ref answers 'fields) key))

(define (say text . values)
  (apply simple-format #f text
         (map (lambda (v) (if (and (real? v) (inexact? v) (finite? v)) (/ (round (* 1e4 v)) 1e4) v)) values)))

(define (thesis-linear-stretch answers)
  ;; The depth rule `thesis-linear' adds the depth to a line that is as long without it, as the thesis has it.
  (if (eq? 'thesis-linear (field answers 'depth-rule))
      (let* ((points (assq-ref answers 'points))
             (drop (/ (- (z (last points)) (z (first points))) (assq-ref answers 'length))))
        (sqrt (+ 1 (* drop drop))))
      1))

(define (stretched ds tension answers)
  ;; How long a piece of DS metres may be: at TENSION, or if all of the line's strain energy were in it.
  (let* ((ea (field answers 'ea)) (ea (if (real? ea) ea +inf.0)))
    (+ (* ds (thesis-linear-stretch answers) (+ 1 (/ (max 0 tension) ea)))
       (sqrt (/ (* 2 ds (max 0 (assq-ref answers 'strain-energy))) ea)))))

;; Of a length: what is read between the nodes of a line follows a smooth curve, which a fold lengthens; the
;; thesis' search ends when height and length are right to half as much.
(define most-of-interpolation 1/50)
(define most-of-search 1/100)

(define (unsure ds answers)
  ;; How far the ends of a piece of DS metres may be off, m, by what the line says of its own error.
  (case (field answers 'model)
    ((dynamic auto)
     (let ((error (or (assq-ref answers 'error) 0)))
       (min (* 2 error) (* ds (+ most-of-interpolation (/ error (assq-ref answers 'length)))))))
    ((steady) (* most-of-interpolation ds))
    ;; In closed form, unless it floats.
    ((elastic) (if (negative? (field answers 'wet-weight)) (* most-of-interpolation ds) 0))
    ((catenary-simplex) (* most-of-search ds))
    (else 0)))

(define (no-longer-than-it-is answers)
  (let* ((points (assq-ref answers 'points)) (all (assq-ref answers 'tensions))
         (ds (/ (assq-ref answers 'length) (- (length points) 1))))
    (any (lambda (a b ta tb i)
           (let ((apart (distance a b)) (most (stretched ds (max ta tb) answers)))
             (and (not (<= apart (+ rounding (unsure ds answers) (* most (+ 1 1e-6)))))
                  (say "~a m to ~a m along it are ~a m apart, which ~a N do not explain"
                       (* i ds) (* (+ i 1) ds) apart (max ta tb)))))
         points (cdr points) all (cdr all) (iota (- (length points) 1)))))

(define (missed answers)
  ;; How far a line may end from where it is made fast, m: the thesis' search finds the way there or nearly so.
  (if (eq? 'catenary-simplex (field answers 'model))
      (* most-of-search (assq-ref answers 'length))
      0))

(define (held? point holder slack)
  (<= (abs (- (distance point (car holder)) (cdr holder)))
      (+ slack rounding (* 1e-9 (norm point)))))

(define (ends-held answers)
  (let ((points (assq-ref answers 'points))
        (far (if (assq-ref answers 'parted?) (assq-ref answers 'tail) (assq-ref answers 'points))))
    (cond ((not (held? (first points) (assq-ref answers 'anchor) (assq-ref answers 'ride)))
           (say "it begins at ~a, not at its anchor ~a" (first points) (car (assq-ref answers 'anchor))))
          ((and far (not (held? (last far) (assq-ref answers 'far-end) (missed answers))))
           (say "it ends at ~a, not where it is made fast, ~a" (last far)
                (car (assq-ref answers 'far-end))))
          (else #f))))

(define (tensions-sane answers)
  (let ((all (append (assq-ref answers 'tensions) (assq-ref answers 'ends)))
        (most (assq-ref answers 'max-tension)))
    (cond ((find (lambda (t) (not (and (real? t) (finite? t)))) all)
           => (lambda (t) (say "a tension is ~a" t)))
          ((any (lambda (t) (> t (+ 1e-9 (* most (+ 1 1e-9))))) (assq-ref answers 'ends))
           (say "its largest tension is ~a N, at its ends it is ~a" most (assq-ref answers 'ends)))
          (else #f))))

(define (length-sane answers)
  (let ((length (assq-ref answers 'length)) (drum (assq-ref answers 'drum)))
    (and (not (and (real? length) (> length 0) (<= length (* drum (+ 1 1e-12)))))
         (say "~a m of it are out, with ~a m on the drum" length drum))))

(define (no-lighter-than-foam answers)
  (let* ((sea (assq-ref answers 'sea)) (mass (field answers 'mass))
         (least (least-mass (field answers 'diameter) (field answers 'wet-weight)
                            (assq-ref sea 'density) (assq-ref sea 'gravity))))
    (and (not (>= mass (* least (- 1 1e-9))))
         (say "it has ~a kg/m, but ~a is the least" mass least))))

;; A contact is told at the end of a step, of a place that the line slides along, and in no case a piece away.
(define (touches-where-it-lies answers)
  (let ((near (+ (field answers 'diameter) (/ (assq-ref answers 'length) pieces))))
    (any (lambda (contact)
           (and (not (<= (second contact) near))
                (say "it touches ~a at ~a m along it, ~a m from the contact's place"
                     (third contact) (first contact) (second contact))))
         (assq-ref answers 'contacts))))

(define tether-laws
  ;; alist, name -> law
  `((length-sane . ,length-sane)
    (no-lighter-than-foam . ,no-lighter-than-foam)
    (tensions-sane . ,tensions-sane)
    (ends-held . ,ends-held)
    (no-longer-than-it-is . ,no-longer-than-it-is)
    (touches-where-it-lies . ,touches-where-it-lies)))

(define (judge-tether answers)
  "Return #f, or what is wrong with a tether of which the ANSWERS are these, a sentence."
  (any (lambda (law)
         (let ((wrong ((cdr law) answers)))
           (and wrong (simple-format #f "~a, ~a: ~a" (assq-ref answers 'name) (field answers 'model) wrong))))
       tether-laws))


;;; Balance.  What pulls at a line that rests: its ends, its weight, what flows past it, what it lies on.

(define (at-rest? name)
  "Return #t if the tether NAME is known to rest: a moving line that sleeps, or a model of rest."
  (if (memq (model-of name) '(dynamic auto)) (asleep? name) (memq (model-of name) '(elastic steady))))

(define (piece-drag a b ds fields density)
  (let* ((way (vec- b a)) (t (if (zero? (norm way)) way (vec* (/ 1 (norm way)) way)))
         (u (current-at (vec* 1/2 (vec+ a b))))
         (along (fold + 0 (map * (f64vector->list u) (f64vector->list t))))
         (across (vec- u (vec* along t)))
         (d (assq-ref fields 'diameter)) (pi (acos -1)))
    (vec* (* 1/2 density d ds)
          (vec+ (vec* (* (assq-ref fields 'cdn) (norm across)) across)
                (vec* (* pi (assq-ref fields 'cdt) (abs along) along) t)))))

(define (loads name)
  ;; The forces on the line NAME, vectors in N: at its anchor, at its far end, weight, drag, contacts.
  (let* ((answers (tether-answers name)) (fields (assq-ref answers 'fields))
         (points (rows (tether-points name (+ 1 (* 4 pieces)))))
         (density (assq-ref (%sea (this-engine 'imbalance)) 'density))
         (out (assq-ref answers 'length))
         (ds (/ out (- (length points) 1))))
    (append
     (list (vec* (- (first (assq-ref answers 'ends))) (tangent-at name 0))
           (vec* -1 (assq-ref answers 'force))
           (vec 0 0 (- (* out (assq-ref fields 'wet-weight)))))
     (map (lambda (a b) (piece-drag a b ds fields density)) points (cdr points))
     (map contact-force (contacts name)))))

(define (imbalance name)
  "Return the sum of all forces on the tether NAME over the sum of their sizes: 0 for one in balance."
  (let* ((forces (loads name)) (sizes (fold + 0 (map norm forces))))
    (if (zero? sizes) 0 (/ (norm (fold vec+ (vec 0 0 0) forces)) sizes))))


;;; Awareness.

(define (wound-though-free name free? windings)
  "Return #f, or the sentence that says about which object of the alist WINDINGS the tether NAME winds although
it is FREE?."
  (let ((wound (and free? (find (lambda (entry) (not (eqv? 0 (cdr entry)))) windings))))
    (and wound
         (simple-format #f "~a: it winds ~a times about ~a, but its class is the free one"
                        name (cdr wound) (car wound)))))

(define (free-class-unwound name)
  "Return #f, or the sentence that says about what the tether NAME winds although its class is that of the
free way."
  (let ((class (homotopy-class name)))
    (wound-though-free name (and (class-free? class) (class-decided? class))
                       (map (lambda (object)
                              ;; Level ground has no axis.
                              (cons object (or (if-supported (winding name object)) 0)))
                            (%names (this-engine 'free-class-unwound) 'obstacle)))))
