;;; (bight test metamorphosis) --- the same dive elsewhere: moved, turned, mirrored, scaled.
;;;
;;; Physics does not know where east is, nor how long a metre is if gravity goes along.  A world and orders
;;; are changed here as data, field by field by the kind and the unit that the schema gives; what the changed
;;; dive answers must be the changed answers.  A field of a unit that is unknown here is refused, so that one
;;; that is added to the schema is not forgotten.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test metamorphosis)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core schema)
  #:use-module (bight core units)
  #:use-module (bight world)
  #:use-module (bight world data)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (moved turned mirrored scaled
            change?
            changed-world
            changed-order
            changed-point
            changed-number))

(define-record <change>
  (make-change name point bearing hand scale)
  change?
  (name change-name)
  (point change-point)                  ; where a point goes
  (bearing change-bearing)              ; where a compass bearing goes
  (hand change-hand)                    ; -1 if left and right are exchanged, else 1
  (scale change-scale))                 ; how many metres a metre becomes

(define (moved by)
  "Return the change that moves everything BY a vector, which is level."
  (make-change 'moved (lambda (p) (vec+ p by)) identity 1 1))

(define (turned quarters)
  "Return the change that turns everything clockwise about the origin by so many QUARTERS of a turn."
  (make-change 'turned
               (lambda (p)
                 (let loop ((p p) (n (modulo quarters 4)))
                   (if (zero? n) p (loop (vec (y p) (- (x p)) (z p)) (- n 1)))))
               (lambda (b) (+ b (* 90 quarters))) 1 1))

(define mirrored
  ;; East and west are exchanged.
  (make-change 'mirrored (lambda (p) (vec (- (x p)) (y p) (z p))) - -1 1))

(define (scaled by)
  "Return the change by Froude's law: lengths BY so many times, times and speeds by its root, and forces by
its cube; water and gravity stay."
  (make-change 'scaled (lambda (p) (vec* by p)) identity 1 by))


;;; Numbers, by their units.

;; By which power of the scale of lengths what is measured so changes: forces go with weights.
(define powers
  '(("" . 0) ("m" . 1) ("m/s" . 1/2) ("m/s2" . 0) ("m3" . 3) ("s" . 1/2) ("deg" . 0) ("deg/s" . -1/2)
    ("kg" . 3) ("kg/m" . 2) ("kg/m3" . 0) ("kg m2" . 5) ("N" . 3) ("N/m" . 2) ("N m2" . 5) ("N m2 s" . 11/2) ("N s" . 7/2)
    ("J/m" . 3) ("V" . 0) ("1/m" . -1)))

(define (changed-number change unit value)
  "Return what VALUE, measured in UNIT, is after CHANGE."
  (let ((power (assoc-ref powers unit)))
    (unless power
      (bight-raise 'unsupported 'changed-number "how what is measured in ~a scales is not known" unit))
    (* value (expt (change-scale change) power))))

(define (changed-point change point)
  "Return where POINT is after CHANGE."
  ((change-point change) point))

(define (changed-direction change direction)
  (vec- (changed-point change direction) (changed-point change (vec 0 0 0))))

(define (row->vec row)
  (apply vec row))

(define (changed-rows change rows)
  ;; Points as an n x 3 array.
  (list->typed-array 'f64 2 (map (lambda (row) (f64vector->list (changed-point change (row->vec row))))
                                 (array->list rows))))

(define (own-vector change point)
  ;; Of a body's own axes: these turn with it, but left and right may be exchanged, and all of it scaled.
  (vec* (change-scale change) (vec (* (change-hand change) (x point)) (y point) (z point))))

(define (own-rows change rows)
  (list->typed-array 'f64 2 (map (lambda (row) (f64vector->list (own-vector change (row->vec row))))
                                 (array->list rows))))


;;; Fields.

(define (unchangeable change what)
  (bight-raise 'unsupported 'changed-world "~a cannot be ~a" what (change-name change)))

(define (changed-current change current)
  (let ((speed (lambda (s) (changed-number change "m/s" s)))
        (length (lambda (l) (changed-number change "m" l)))
        (bearing (change-bearing change)))
    (case (car current)
      ((still) current)
      ((uniform) (list 'uniform (speed (second current)) (bearing (third current))))
      ((profile) (cons 'profile (map (lambda (row)
                                       (list (length (first row)) (speed (second row)) (bearing (third row))))
                                     (cdr current))))
      ((turning) (list 'turning (speed (second current)) (bearing (third current))
                       (* (change-hand change) (/ (fourth current) (change-scale change)))))
      ((power) (list 'power (speed (second current)) (bearing (third current)) (fourth current)))
      ((tide) (list 'tide (speed (second current)) (bearing (third current))
                    (changed-number change "s" (fourth current))))
      (else (unchangeable change "a measured current, or one that a procedure tells,")))))

(define (changed-waves change waves)
  ;; (none), (airy HEIGHT PERIOD TOWARD PHASE) or (jonswap HEIGHT PERIOD TOWARD ...); crests at the origin stay there.
  (cond ((equal? waves '(none)) waves)
        ((or (eq? 'moved (change-name change)) (not (= 1 (change-hand change))))
         (unchangeable change "what has waves"))
        (else (cons* (first waves) (changed-number change "m" (second waves))
                     (changed-number change "s" (third waves)) ((change-bearing change) (fourth waves))
                     (list-tail waves 4)))))

(define (changed-track change head rows)
  ;; A place without a heading is turned only if the body is round.
  (unless (or (memq (change-name change) '(moved scaled)) (eq? head 'sphere))
    (unchangeable change (simple-format #f "~a that moves" (head-title head))))
  (define headings? (not (any (lambda (row) (any nan? row)) (array->list rows))))
  (list->typed-array
   'f64 2
   (map (lambda (row)
          (append (list (changed-number change "s" (first row)))
                  (f64vector->list (changed-point change (row->vec (take (cdr row) 3))))
                  (if headings? (list-tail row 4) '()))) ; a ball turns unseen; rows without a heading have NaN
        (array->list rows))))

(define (changed-file change head value)
  ;; What a file holds stays: it may be put elsewhere, but neither mirrored nor, without a heading, turned.
  (if (or (eq? 'moved (change-name change)) (and (eq? head 'mesh) (= 1 (change-hand change))))
      value
      (unchangeable change (simple-format #f "~a from a file" (head-title head)))))

(define level-places '(at from to via))

(define (changed-place change value)
  (if (f64vector? value) (changed-point change value) (changed-rows change value)))

(define (changed-of-itself change head field value)
  ;; VALUE of a FIELD that tells of the body itself, not of where it is.
  (case (field-name field)
    ((heading) ((change-bearing change) value))
    ((roll) (* (change-hand change) value))
    ((tether-point buoyancy-centre) (own-vector change value))
    ((points) (own-rows change value))
    ((size) (vec* (change-scale change) value))
    (else
     (cond ((and (eq? head 'mesh) (eq? 'scale (field-name field))) (* (change-scale change) value))
           ((not (number? value)) value) ; shares, and what only a vehicle with mass has
           (else (changed-number change (field-unit field) value))))))

(define (special field value)
  ;; The symbol that VALUE stands for in FIELD, or #f.
  (and (number? value)
       (and=> (find (lambda (entry) (eqv? value (cdr entry))) (field-specials field)) car)))

(define (changed-value change head field value)
  (cond ((symbol? value) value)         ; an end, a word
        ((special field value))
        ((eq? 'current (field-kind field)) (changed-current change value))
        ((eq? 'waves (field-kind field)) (changed-waves change value))
        ((eq? 'track (field-kind field)) (changed-track change head value))
        ((memq (field-kind field) '(mesh grid)) (changed-file change head value))
        ((and (memq (field-name field) level-places) (not (inner-head? head))) (changed-place change value))
        (else (changed-of-itself change head field value))))

(define (placed? head fields)
  ;; Is there a place that is the origin if none is given?  A level bed has none, nor what moves.
  (and (not (assq 'track fields))
       (or (not (eq? head 'seabed)) (assq 'grid fields) (assq 'mesh fields))))

(define (with-defaults head fields)
  ;; FIELDS, and what a part with HEAD is by default: that, too, has a size and a place.
  (append fields
          (filter-map (lambda (field)
                        (let ((name (field-name field)))
                          (cond ((assq name fields) #f)
                                ((number? (field-default field)) (cons name (field-default field)))
                                ((and (eq? name 'at) (placed? head fields)) (cons 'at (vec 0 0 0)))
                                (else #f))))
                      (head-fields head))))

;; Clamps, and the planes of sets.  A clamp at a vehicle is along the vehicle's own axes.

(define (changed-along change which fields)
  (let ((along (or (assq-ref fields which) (vec 0 0 0))) (end (assq-ref fields (if (eq? which 'from-along) 'from 'to))))
    (if (symbol? end) (own-vector change along) (changed-direction change along))))

(define (dot a b) (+ (* (x a) (x b)) (* (y a) (y b)) (* (z a) (z b))))

(define (cross a b)
  (vec (- (* (y a) (z b)) (* (z a) (y b))) (- (* (z a) (x b)) (* (x a) (z b))) (- (* (x a) (y b)) (* (y a) (x b)))))

(define (unit a) (vec* (/ (norm a)) a))

(define (directors along)
  ;; Toward planes of 0 and of 90 degrees of a line that a clamp lets out ALONG: north, where that is down, turned with
  ;; it the shortest way.
  (let* ((t (unit along)) (down (vec 0 0 -1)) (north (vec 0 1 0)) (c (+ 1 (dot t down)))
         (side (if (> c 1e-6) (vec- north (vec* (/ (dot north t) c) (vec+ t down))) north)))
    (list side (cross t side))))

(define degree (/ (atan 1) 45))

(define (changed-plane change fields plane)
  ;; Without a clamp at the anchor the planes of sets count against other sets alone.
  (let ((along (assq-ref fields 'from-along)))
    (if (and along (> (norm along) 0))
        (let* ((here (directors along)) (there (directors (changed-along change 'from-along fields)))
               (toward (vec+ (vec* (cos (* degree plane)) (first here)) (vec* (sin (* degree plane)) (second here))))
               (goes (if (symbol? (assq-ref fields 'from)) (own-vector change toward) (changed-direction change toward))))
          (/ (atan (dot goes (second there)) (dot goes (first there))) degree))
        (* (change-hand change) plane))))

(define (with-plane change fields head before after)
  ;; AFTER, the changed entries BEFORE of a thing with HEAD: of a set, with the plane that it then has.
  (if (eq? head 'set)
      (cons (cons 'plane (changed-plane change fields (or (assq-ref before 'plane) 0)))
            (remove (lambda (entry) (eq? 'plane (car entry))) after))
      after))

(define (changed-entry change head fields)
  ;; A procedure of an entry of a part with HEAD and FIELDS.
  (lambda (entry)
    (let ((field (head-field head (car entry))))
      (cond ((not field)                ; a thing inside: its fields are entries
             (cons (car entry)
                   (with-plane change fields (car entry) (cdr entry)
                               (map (changed-entry change (car entry) fields) (cdr entry)))))
            ((memq (car entry) '(from-along to-along))
             (cons (car entry) (changed-along change (car entry) fields)))
            ((eq? 'type (car entry)) #f)
            (else (cons (car entry) (changed-value change head field (cdr entry))))))))

(define (written entry)
  ;; An entry as a clause.
  (if (and (pair? (cdr entry)) (pair? (cadr entry)) (symbol? (caadr entry)) (not (eq? 'current (car entry))))
      (cons (car entry) (map written (cdr entry)))
      (list (car entry) (cdr entry))))

(define (massive? part)
  (positive? (or (assq-ref (part-all-fields part) 'mass) 0)))

(define (changed-part change part)
  (let ((head (part-head part)))
    (when (and (eq? head 'rov) (massive? part) (not (= 1 (change-scale change) (change-hand change))))
      (unchangeable change "a vehicle with mass"))
    (cons* 'part head
           (append (if (eq? head 'sea) '() `((named ,(part-name part))))
                   (map written
                        (filter identity
                                (map (changed-entry change head (part-all-fields part))
                                     (with-defaults head (part-all-fields part)))))))))

(define (changed-world change world)
  "Return WORLD after CHANGE.  Raise unsupported when a part of it cannot be changed so, as a mesh in a file
cannot be mirrored."
  (data->world (world-name world) #f (world-file world)
               (map (lambda (part) (changed-part change part)) (world-parts world))))


;;; Orders.

(define (changed-order change order)
  "Return ORDER, an expression of the kinds that (bight dive any-flight) draws, after CHANGE."
  (define (again order)
    (if (list? order)
        (case (and (pair? order) (car order))
          ((vec) `(vec ,@(f64vector->list (changed-point change (row->vec (cdr order))))))
          ((current!) `(current! ,(changed-number change "m/s" (second order))
                                 ,(modulo ((change-bearing change) (third order)) 360)))
          ((hold-heading!) `(hold-heading! ,(second order) ,(modulo ((change-bearing change) (third order)) 360)))
          ((drive!) (changed-sticks change order))
          (else (map again order)))
        order))
  (again order))

(define (changed-sticks change order)
  ;; Sway and yaw are those of the other hand.
  (let loop ((rest order) (found '()))
    (cond ((null? rest) (reverse found))
          ((memq (car rest) '(#:sway #:yaw))
           (loop (cddr rest) (cons* (* (change-hand change) (cadr rest)) (car rest) found)))
          (else (loop (cdr rest) (cons (car rest) found))))))
