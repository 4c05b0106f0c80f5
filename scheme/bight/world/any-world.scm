;;; (bight world any-world) --- random worlds of any parts the schema knows.
;;;
;;; Each kind of part is drawn from its fields in the schema: what it cannot do without always, everything
;;; else now and then.  So a kind of part, or a field, that is added to the schema is drawn, too.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world any-world)
  #:use-module (bight core schema)
  #:use-module (bight test generator)
  #:use-module (bight world field-values)
  #:use-module (srfi srfi-1)
  #:export (any-world
            any-part))

;; The share of parts that give a field they could leave out; in a calm world it is smaller.
(define calm-share 1/10)
(define wild-share 1/4)

;; Fields without which most worlds would be alike: water that stands, a line that weighs nothing.
(define often '((sea . current) (tether . wet-weight) (tether . drum)))
(define often-share 1/2)

;; The vehicles of one world, its tethers and its obstacles, at most.
(define most-vehicles 3)
(define most-tethers 4)
(define most-obstacles 6)

(define (needed? head field)
  ;; A vehicle begins somewhere; whoever is the only one at the origin is no case worth drawing often.
  (or (memq (field-name field) (required-fields head))
      (and (eq? 'at (field-name field)) (not (eq? head 'seabed)))
      (and (eq? head 'tether) (memq (field-name field) '(to model)))))

(define (drawn-fields head)
  ;; The world gives names; the files of scene-files are in local metres, and so without an origin.  Clamps are
  ;; refused by most models and stiffnesses, and would leave few worlds: see `clamped'.
  (remove (lambda (field)
            (or (eq? 'name (field-kind field)) (map-field? field) (memq (field-name field) '(from-along to-along))))
          (head-fields head)))

(define (clauses head field wild?)
  ;; A generator of no clause or one.
  (let ((clause (field-clause head field wild?)))
    (if (needed? head field)
        (made-of list clause)
        (sometimes (cond ((member (cons head (field-name field)) often) often-share)
                         (wild? wild-share)
                         (else calm-share))
                   clause))))

(define (inner-part head wild?)
  (apply made-of (lambda clauses (cons head (concatenate clauses)))
         (map (lambda (field) (clauses head field wild?)) (head-fields head))))

(define (inner-parts head wild?)
  ;; In one part of five one or two things of a kind that goes inside it.
  (map (lambda (inner)
         (made-of concatenate
                  (sometimes 1/5 (list-of (inner-part inner wild?) #:least 1 #:most 2
                                          #:make (if (eq? inner 'thruster) with-three-axes identity)))))
       (inner-heads head)))

(define (with-three-axes thrusters)
  ;; Thrusters that can push every way, as those of a vehicle must, and THRUSTERS.
  (append (map (lambda (along) `(thruster (at 0 0 0) (along ,@along) (ahead 20)))
               '((1 0 0) (0 1 0) (0 0 1)))
          thrusters))

(define (any-part head wild?)
  "Return a generator of parts with HEAD as they are written in a world, without a name; with WILD? their
numbers come from all that is allowed."
  (if (eq? head 'group)
      (any-group wild?)
      (apply made-of (lambda clauses (cons head (concatenate clauses)))
             (append (map (lambda (field) (clauses head field wild?)) (drawn-fields head))
                     (inner-parts head wild?)))))

(define single-obstacles
  ;; Kinds of obstacles of which a world may have many.
  (filter (lambda (head) (and (obstacle-head? head) (not (memq head '(seabed group))))) (part-heads)))

(define (any-group wild?)
  (apply made-of (lambda (members . clauses) `(group ,@(concatenate clauses) ,@members))
         (list-of (apply any-of (map (lambda (head) (any-part head wild?)) single-obstacles))
                  #:least 1 #:most 3 #:make identity)
         (map (lambda (field) (clauses 'group field wild?)) (drawn-fields 'group))))


;;; Worlds.

(define (numbered letter i)
  (string->symbol (string-append letter (number->string (+ i 1)))))

(define (name-part part letter i)
  `(,(car part) (named ,(numbered letter i)) ,@(cdr part)))

(define (end-number tether name)
  ;; The number at the end NAME of TETHER, #f if a point is there.
  (let ((values (assq-ref (cdr tether) name)))
    (and (null? (cdr values)) (car values))))

(define (name-ends tether vehicles)
  ;; Numbers at the ends of TETHER stand for VEHICLES, counted round; no tether goes from one to itself.
  (let* ((vehicle (lambda (n) (numbered "r" (modulo (- n 1) vehicles))))
         (to (vehicle (end-number tether 'to)))
         (from (and=> (end-number tether 'from) vehicle)))
    (map (lambda (clause)
           (cond ((not (pair? clause)) clause)
                 ((eq? 'to (car clause)) (list 'to to))
                 ((and from (eq? 'from (car clause))) (if (eq? from to) '(from -9 0 -5) (list 'from from)))
                 (else clause)))
         tether)))

(define (as-a-moving-line tether)
  (map (lambda (clause)
         (if (and (pair? clause) (eq? 'model (car clause)) (not (memq (cadr clause) '(dynamic auto))))
             '(model dynamic)
             clause))
       tether))

(define (clamped tether)
  ;; TETHER, stiff, clamped at its anchor; at its far end too if it was drawn with its own torsion.
  `(,@tether (from-along 1 0 0) ,@(if (assq 'gj (cdr tether)) '((to-along 0 -1 0)) '())))

(define (without-field tether name)
  `(,(car tether) ,@(remove (lambda (clause) (and (pair? clause) (eq? name (car clause)))) (cdr tether))))

(define (number-of tether name)
  (let ((clause (assq name (cdr tether))))
    (if clause (cadr clause) 0)))

(define (stiff tether)
  (if (> (number-of tether 'ei) 0)
      tether
      `(,@(without-field tether 'ei) (ei 0.05))))

(define (value-of tether name)
  ;; The number that NAME of TETHER is, given, by its type or by default; a word as the number it stands for.
  (let* ((type (and=> (assq 'type (cdr tether)) cadr)) (field (head-field 'tether name))
         (value (cond ((assq name (cdr tether)) => cadr)
                      ((and type (assq-ref (part-type-fields (find-part-type 'any-world 'tether type)) name)))
                      (else (field-default field)))))
    (or (assq-ref (field-specials field) value) value)))

(define (at-most tether name most)
  ;; TETHER, of which the number NAME is no more than MOST.
  (let ((value (value-of tether name)))
    (if (and (real? value) (finite? value) (> value most))
        `(,@(without-field tether name) (,name ,most))
        tether)))

(define (within-bounds tether)
  ;; TETHER; what follows from its other fields is no more than it can be.
  (fold (lambda (bound tether)
          (at-most tether (bound-field bound) (bound-most bound (value-of tether (bound-of bound)))))
        tether
        tether-bounds))

(define (value-in sea name)
  (let ((clause (assq name (cdr sea))))
    (if clause (cadr clause) (field-default (head-field 'sea name)))))

(define (heavy-enough tether sea)
  ;; TETHER; if it was drawn lighter than a line can be in SEA, as light as can be.  A mass that is not given follows
  ;; from a wet weight that is.
  (let* ((given (lambda (name) (and (assq name (cdr tether)) (value-of tether name))))
         (mass (if (given 'wet-weight) (given 'mass) (value-of tether 'mass)))
         (least (least-mass (value-of tether 'diameter)
                            (if (given 'mass) (given 'wet-weight) (value-of tether 'wet-weight))
                            (value-in sea 'density) (value-in sea 'gravity))))
    (if (and (real? mass) (< mass least))
        `(,@(without-field tether 'mass) (mass ,least))
        tether)))

(define (armoured tether)
  ;; TETHER; if its layers stick, softer while they slip.
  (let ((stuck (number-of tether 'ei-stuck)))
    (if (or (zero? stuck) (< 0 (number-of tether 'ei) stuck))
        tether
        `(,@(without-field tether 'ei) (ei ,(/ stuck 4))))))

(define (with-what-things-need tether)
  ;; Only a moving line carries clumps and floats, and only one with a bending stiffness has a set or a clamp; layers
  ;; that slip have no set.
  (cond ((assq 'set (cdr tether)) (clamped (stiff (without-field (as-a-moving-line tether) 'ei-stuck))))
        ((or (assq 'clump (cdr tether)) (assq 'float (cdr tether))) (armoured (as-a-moving-line tether)))
        (else (armoured tether))))

(define (name-all parts letter)
  (map (lambda (part i) (name-part part letter i)) parts (iota (length parts))))

(define (world-form sea bed obstacles vehicles tethers)
  `(world ,sea ,@bed
          ,@(name-all obstacles "o")
          ,@(name-all vehicles "r")
          ,@(map (lambda (tether)
                   (heavy-enough (within-bounds (with-what-things-need (name-ends tether (length vehicles)))) sea))
                 (name-all tethers "t"))))

(define (some-parts heads least most wild?)
  (list-of (apply any-of (map (lambda (head) (any-part head wild?)) heads))
           #:least least #:most most #:make identity))

(define* (any-world #:key wild? (obstacles most-obstacles) (vehicles most-vehicles)
                    (tethers most-tethers))
  "Return a generator of expressions for worlds of any parts: at most so many OBSTACLES, whose names are o1,
o2, ..., VEHICLES r1, r2, ... and TETHERS t1, t2, ...; with WILD? their numbers come from all that the schema
allows.  Many are refused, as when a tether would begin inside an obstacle."
  (made-of world-form
           (any-part 'sea wild?)
           (sometimes 1/3 (any-part 'seabed wild?))
           (some-parts (append single-obstacles '(group)) 0 obstacles wild?)
           (some-parts '(rov) 1 vehicles wild?)
           (some-parts '(tether) 1 tethers wild?)))
