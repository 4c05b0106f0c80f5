;;; Every number that the schema allows is answered: each field of each part at its ends, alone and
;;; together, flown for a moment.  What is refused is refused with a reason.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core errors) (bight core schema) ((bight dive query) #:select (tether-properties))
             (rnrs exceptions) (srfi srfi-1))

(define random-numbers (seed->random-state (or (and=> (getenv "BIGHT_SEED") string->number) 3)))

(define (one-of list)
  (list-ref list (random (length list) random-numbers)))

;;; A world as a list of parts, each a head and its clauses.

(define parts
  '((sea (depth 60) (current 0.3 90))
    (seabed)
    (box (named block) (at 20 20 -50) (size 4 4 4))
    (sphere (named ball) (at -20 20 -40) (radius 1))
    (cylinder (named pile) (from -20 -20 -60) (to -20 -20 -30) (radius 1))
    (rov (named minnow) (at 10 0 -20))
    (tether (named line) (type fathom) (from 0 0 -10) (to minnow) (length 30) (model dynamic))))

(define (with-clause parts head name value)
  (map (lambda (part)
         (if (eq? head (car part))
             (append (remove (lambda (clause) (and (pair? clause) (eq? name (car clause)))) part)
                     (list (list name value)))
             part))
       parts))

(define (ends field)
  ;; The least and the greatest number FIELD allows, and two between.
  (let ((low (field-min field)) (high (field-max field)))
    (delete-duplicates
     (list (if (field-above-min? field) (+ low (* 1e-12 (- high low))) low)
           (if (eq? 'count (field-kind field)) (+ low 1) (+ low (* 1e-6 (- high low))))
           (if (eq? 'count (field-kind field)) (quotient (inexact->exact (+ low high)) 2)
               (/ (+ low high) 1000.0))
           high))))

(define cases
  ;; All of them: (head field value).
  (append-map
   (lambda (head)
     (append-map (lambda (field)
                   (if (and (memq (field-kind field) '(number count)) (field-min field) (field-max field))
                       (map (lambda (value) (list head (field-name field) value)) (ends field))
                       '()))
                 (head-fields head)))
   (delete-duplicates (map car parts))))

(define (changed cases parts)
  (fold (lambda (c parts) (apply with-clause parts c)) parts cases))


;;; Flying.

(define language
  (let ((module (make-fresh-user-module)))
    (module-use! module (resolve-interface '(bight)))
    module))

(define (finite-number? x)
  (and (real? x) (not (nan? x)) (not (inf? x))))

(define (small? x)
  (and (finite-number? x) (< (abs x) 1e14)))

(define (cpu-seconds)
  (let ((all (times)))
    (/ (+ (tms:utime all) (tms:stime all)) 1.0 internal-time-units-per-second)))

(define (megabytes)
  ;; That this process has, 0 where nobody tells.
  (if (file-exists? "/proc/self/statm")
      (/ (* 4096 (call-with-input-file "/proc/self/statm" (lambda (port) (read port) (read port)))) 1e6)
      0))

(define most-seconds 20)
(define most-megabytes 1500)

(define (asked thunk)
  ;; What THUNK returns, #f where it is refused.
  (guard (e ((bight-error? e) #f)) (thunk)))

(define (answers)
  ;; The numbers of the present dive that must be finite and of a size that means something.
  (append (append-map (lambda (p) (list (x p) (y p) (z p))) (array->list (tether-points)))
          (list (anchor-tension) (rov-tension) (max-tension) (slack) (rov-altitude) (rov-speed))
          (map cdr (or (asked energy) '()))))

(define (fly parts)
  ;; #t if the world of PARTS answers, #f if it is refused; else what is wrong.
  (let ((begun (cpu-seconds)))
    (guard (e ((bight-error? e) #f))
      (enter! (eval (cons 'world parts) language))
      (asked (lambda () (drive! #:surge 0.5 #:yaw 0.1) (run 0.5)))
      (asked (lambda () (pay-out! 2 #:rate 1) (run 0.5)))
      (asked (lambda () (place! '(13 3 -17))))
      (let ((odd (remove small? (answers))) (bend (tightest-bend)))
        (cond ((pair? odd) (list 'answers odd))
              ((or (nan? bend) (and (not (inf? bend)) (> bend 1e12))) (list 'bend bend))
              ((> (- (cpu-seconds) begun) most-seconds) (list 'took (- (cpu-seconds) begun)))
              ((> (megabytes) most-megabytes) (list 'memory (megabytes)))
              (else #t))))))

(define (fly-all lists parts most-refused)
  ;; Fly the worlds of PARTS changed by each of LISTS of cases.
  (let ((said (map (lambda (cases) (cons (fly (changed cases parts)) cases)) lists)))
    (expect (remove (lambda (entry) (boolean? (car entry))) said) => '())
    (expect (/ (count not (map car said)) (length said)) is (below most-refused))))

(define-scenario (each-alone vehicle)
  "Each field of each part at each of its ends."
  #:for ((vehicle 'kinematic 'bluerov2-heavy))
  (expect (> (length cases) 150))
  (fly-all (map list cases) (with-clause parts 'rov 'type vehicle) 1/5))

(define-scenario (some-together model)
  "Three or more of them at once, under every model that moves or hangs."
  #:for ((model 'dynamic 'auto 'steady 'elastic 'catenary 'v-shape))
  (fly-all (map (lambda (k) (map (lambda (j) (one-of cases)) (iota (+ 3 (random 3 random-numbers)))))
                (iota 25))
           (with-clause parts 'tether 'model model)
           3/4))


;;; What would not fit into a machine.

(define (many-tethers n nodes)
  (map (lambda (k)
         (part tether (named ,(string->symbol (simple-format #f "t~a" k))) (from 0 k -10) (to 10 k -10) (length 100) (nodes nodes) (model dynamic)))
       (iota n)))

(define-scenario too-much-for-memory
  "The sum of nodes, the posts of a grid and how finely a line is divided have ends, which are told."
  (define (says? what thunk)
    (let ((said (guard (e ((bight-error? e) (bight-error-message e))) (thunk) "")))
      (->bool (string-contains said what))))
  (define-syntax-rule (told what world) (expect (says? what (lambda () (enter! world)))))
  (told "nodes' together" (world (sea (depth 60)) (splice (many-tethers 20 10000)) (rov (at 0 0 -5))))
  (told "more finely than it is thick"
        (world (rov (named minnow) (at 5 0 -5))
               (tether (type fathom) (from 0 0 -5) (to minnow) (length 8) (nodes 2000))))
  (told "posts"
        (world (seabed (grid (lambda (x y) -50) (from 0 0) (to 4000 4000) (spacing 1))) (rov (at 0 0 -5))))
  (told "stretches"
        (world (rov (named minnow) (at 5 0 -5))
               (tether (from 0 0 -5) (to minnow) (length 1e5) (diameter 0.5) (mass 3000) (ea 1e5)))))


;;; What no line can be.

(define (a-line . clauses)
  (eval `(world (sea (depth 60))
                (rov (named minnow) (at -6 0 -10))
                (tether (named line) (from 0 0 -10) (to minnow) (length 17) (model dynamic) ,@clauses))
        language))

(define-scenario (no-line-is-stiffer-than-a-rod name)
  "A line of 7.6 mm has at most the stiffness of a solid rod ten thousand times as stiff as diamond, 1.64e6 N m2, and
damps no more than a hundredth of that, in N m2 s; a thicker line may, until it is made thinner."
  #:for ((name 'ei 'ei-stuck 'gj 'bending-damping))
  (define most (if (eq? name 'bending-damping) 1.64e4 1.64e6))
  (define (with value . more)
    (apply a-line `(,@(case name ((ei-stuck) '((ei 1))) ((bending-damping) '((ei 1e5))) (else '())) (,name ,value) ,@more)))
  (expect (enter! (with (* 1.01 most))) raises domain)
  (expect (enter! (with 1e9)) raises domain)
  (enter! (with (* 0.99 most)))
  (expect (alter! 'line #:diameter 0.007) raises domain)
  (enter! (with (* 1.01 most) '(diameter 0.008)))
  (run 1/10)
  (expect (all-finite?)))

(define-scenario no-vehicle-is-lighter-than-air
  "A vehicle of 12 kg displaces 9.4 m3 of sea at most: a million drove it to thousands of kilometres a second."
  (define (of volume)
    (eval `(world (sea (depth 60))
                  (rov (named minnow) (type bluerov2-heavy) (mass 12) (volume ,volume) (at 10 0 -20))
                  (tether (from 0 0 -10) (to minnow) (length 30) (model dynamic)))
          language))
  (expect (enter! (of 9.5)) raises domain)
  (expect (enter! (of 1e6)) raises domain)
  (enter! (of 9.3))
  (run 1)
  (expect (rov-speed) is (below 200))
  (expect (all-finite?)))

(define-scenario no-line-is-lighter-than-foam
  "Of 7.6 mm a line has 1.2 g a metre at least, a fortieth of the sea that it displaces; one that lifts 30 kN/m has 76 kg a
metre.  Lighter ones whipped without end: a cut tail of 1/840 of its water, a line of next to nothing under such lift."
  (define (says-least? thunk)
    (guard (e ((bight-error? e) (string-contains (bight-error-message e) "the least there is is")))
      (thunk)
      #f))
  (define displaced (* 1025 (acos -1) 1/4 0.0076 0.0076))
  (expect (enter! (a-line '(mass 0.00116))) raises domain)
  (expect (says-least? (lambda () (enter! (a-line '(mass 0.00116))))))
  (enter! (a-line '(mass 0.00117)))
  (expect (enter! (a-line '(mass 76) '(wet-weight -30000))) raises domain)
  (enter! (a-line '(mass 77) '(wet-weight -30000)))
  (enter! (a-line '(mass 0.5) '(wet-weight 30)))
  ;; What is not given follows.
  (enter! (a-line '(wet-weight -30000)))
  (expect (assq-ref (tether-properties 0) 'mass) is (about (/ 30000 9.80665 40) #:within 1e-6))
  (enter! (a-line '(wet-weight -0.45)))
  (expect (assq-ref (tether-properties 0) 'mass) is (about (/ displaced 40) #:within 1e-9))
  (enter! (a-line '(type fathom)))
  (expect (alter! 'line #:mass 0.001) raises domain)
  (expect (alter! 'line #:diameter 0.05) raises domain)
  (expect (assq-ref (tether-properties 0) 'diameter) => 0.0076)
  (alter! 'line #:diameter 0.04)
  (expect (alter! 'sea #:density 1500) raises domain)
  (expect (assq-ref (tether-properties 0) 'mass) => 0.043)
  (alter! 'line #:wet-weight -30000)
  (run 1)
  (expect (all-finite?)))

(define-scenario as-little-does-one-stretch-less
  "Nor does a line stretch less than such a rod, 7.9 GN for a line of a millimetre, unless it is said to be inextensible."
  (expect (enter! (a-line '(diameter 0.001) '(ea 8e9))) raises domain)
  (enter! (a-line '(diameter 0.001) '(ea 7.8e9)))
  (enter! (a-line '(ea inextensible) '(ba 1e9))))

(define-scenario (what-follows-from-another-field-is-held number)
  "Each bound that the schema tells is kept by the engine, when a world is made and when a field is altered."
  #:for ((number 0 1 2 3 4 5 6))
  (expect (length tether-bounds) => 7)
  (define bound (list-ref tether-bounds number))
  (define name (bound-field bound))
  (define of-thin (if (eq? 'diameter (bound-of bound)) 0.001 (field-default (head-field 'tether (bound-of bound)))))
  (define most (bound-most bound of-thin))
  (define others                        ; so that no other bound counts
    (cond ((eq? name 'ei-stuck) '((ei 1)))
          ((and (eq? name 'bending-damping) (eq? 'diameter (bound-of bound))) '((ei 100)))
          (else '())))
  (define (with share)
    (apply a-line `((diameter 0.001) ,@others (,name ,(* share most)))))
  (expect (enter! (with 1.01)) raises domain)
  (enter! (with 0.99))
  (expect (alter! 'line (symbol->keyword name) (* 1.01 most)) raises domain))

(define-scenario a-line-keeps-no-strain-in-one-place
  "What a moving line damps of its bends follows from its `ei': with 1000 N m2 s and hardly any stiffness one interval of a line
that a ton drags along was strained to 75 times its length, beside others that were not, and bore 13 MN."
  (define (most-borne damping)
    (define most 0)
    (enter! (a-line '(ei 0.0012) `(bending-damping ,damping) '(clump (at 8) (mass 50))))
    (do ((i 0 (+ i 1))) ((= i 240) most)
      (step!)
      (set! most (max most (max-tension)))))
  (expect (enter! (a-line '(ei 0.0012) '(bending-damping 1000) '(clump (at 8) (mass 50)))) raises domain)
  (let ((undamped (most-borne 0)))
    (expect (most-borne 1) is (about undamped #:within (* 1/4 undamped)))))

(define-scenario (as-damped-as-can-be-a-line-snaps-as-others ea)
  "A line that damps as much as can be and falls taut with a clump bears what others bear, a few hundred newtons."
  #:for ((ea 3000 1e5 1e6))
  (enter! (eval `(world (sea (current 0.3 90)) (rov (named minnow) (at 12 0 -8))
                        (tether (named line) (from 0 0 -2) (to minnow) (length 13.5) (model dynamic) (wet-weight 0.2)
                                (ea ,ea) (ba ,(* 0.99 (max ea 1e5))) (clump (at 5) (mass 5))))
                language))
  (always (< (max-tension) 1000)
    (run 1)
    (haul-in! 2 #:rate 1)
    (run 3)))

(define-scenario (the-stiffest-gains-nothing clauses)
  "Laid slack, as stiff as can be, a line springs straight with no more than its bend had; damped as much as can be, it
holds what falls with it as others do."
  #:for ((clauses '((ei 1.63e6)) '((ei 1) (ei-stuck 1.63e6) (slip-curvature 0.9)) '((ei 40) (ei-stuck 1.63e6) (slip-curvature 1000))
                  '((ei 1.63e4) (bending-damping 1.63e4) (clump (at 7) (mass 100000)))))
  (enter! (apply a-line clauses))
  (let* ((part (lambda (name) (assq-ref (energy) name)))
         (most (+ 100 (part 'bending) (if (assq 'clump clauses) (* 1e6 17) 0))))
    (always (and (all-finite?) (<= (+ (part 'kinetic) (part 'strain)) most)) (run 3))))

(define-scenario the-heaviest-hangs
  "Five hundred metres of the heaviest line bear thirteen million newtons, and no invariant calls that odd."
  (enter! (eval '(world (sea (depth 600)) (rov (named minnow) (at 50 0 -480))
                        (tether (from 0 0 -1) (to minnow) (length 500) (wet-weight 27000) (ea 1e10) (diameter 0.5) (model elastic)))
                language))
  (expect (max-tension) is (above 1.2e7))
  (expect (all-finite?)))
