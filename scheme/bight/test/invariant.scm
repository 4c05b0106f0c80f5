;;; (bight test invariant) --- what is true of every dive, whatever the world and whoever flies.
;;;
;;; Each is a claim to be watched, as in (always (all-finite?) (run 60)); `always-sound' watches all.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test invariant)
  #:use-module (bight core record)
  #:use-module ((bight core units) #:select (norm))
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (turns))
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive contact)
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module (bight test scenario)
  #:use-module ((bight world)
                #:select (part-all-fields part-fields part-head part-name world-part world-parts))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (post? all-finite? nothing-crossed? most-energy energy-bounded? strain-told? strain-watcher turns-watcher
            same-again? always-sound))

(define (tethers)
  (iota (length (%names (this-engine 'tethers) 'tether))))

(define (vehicles)
  (iota (length (%names (this-engine 'vehicles) 'rov))))

(define (name-of kind i)
  (list-ref (%names (this-engine 'parts) kind) i))

(define far 1e4)                        ; m beyond what is out: nothing is farther off, nor as fast in m/s

(define (far-in engine)
  ;; Of the dive of ENGINE, m.
  (apply + far (map (lambda (i) (assq-ref (%tether engine i) 'length)) (tethers))))

(define (all-sane? array most)
  ;; Are all numbers of ARRAY below MOST?  NaN is not.
  (let ((good #t))
    (array-for-each (lambda (x) (unless (and (real? x) (< (abs x) most)) (set! good #f))) array)
    good))

(define-verb (all-finite?)
  "Return #t if every place, velocity and tension of the dive is a number of a sane size."
  (let* ((engine (this-engine 'all-finite?)) (most (far-in engine)))
    (and (every (lambda (i)
                  (let ((vehicle (%vehicle engine i)))
                    (and (all-sane? (assq-ref vehicle 'position) most)
                         (all-sane? (assq-ref vehicle 'velocity) far))))
                (vehicles))
         (every (lambda (i) (all-sane? (tether-points (name-of 'tether i)) most)) (tethers))
         (every (lambda (t)
                  (let ((most (max-tension (name-of 'tether t))))
                    (and (real? most) (< -1 most (+ 1e7 (own-weight t))))))
                (tethers)))))

(define rounding 1e-9)                  ; m

(define (core t)
  ;; How far an obstacle may stand into the jacket of a tether: to half its radius.
  (/ (assq-ref (tether-properties t) 'diameter) 4))

(define-verb (nothing-crossed?)
  "Return #t if no obstacle is nearer to a tether's middle than half its radius, and no vehicle's hull is in
one."
  (and (every (lambda (i) (> (clearance (name-of 'tether i)) (- (+ (core i) rounding)))) (tethers))
       (every (lambda (i) (> (rov-clearance (name-of 'rov i)) (- rounding))) (vehicles))))


;;; Energy.  What a line can hold: strain up to its breaking load, twice that since it parts only after the step
;;; that passed it, or up to its own weight in water, under which it is laid whatever it bears; the motion of
;;; all of it at three times the speed of whoever drags it and of the water, or at 3 m/s if that is more; and
;;; what its clumps and floats gain as they fall or rise by as much as it is long, up and down.  When it parts,
;;; strain becomes motion: the bound is on the sum.

(define water 1025)                     ; kg/m3, for the water that moves with the line

(define (line-mass t)
  ;; kg/m, with the water it moves.
  (let* ((fields (tether-properties t)) (d (assq-ref fields 'diameter)))
    (+ (max (assq-ref fields 'mass) 0) (* 2 water (/ (acos -1) 4) d d))))

(define (whole-length t)
  ;; What is out now, or was in the beginning, should the line have parted since.
  (let ((name (name-of 'tether t)))
    (max (tether-length name)
         (assq-ref (part-all-fields (world-part (dive-world (this-dive 'energy-bounded?)) name))
                   'length))))

(define (vehicle-speed i)
  (let ((view (%vehicle (this-engine 'energy-bounded?) i)))
    (max (assq-ref view 'surge-speed) (norm (assq-ref view 'velocity)))))

(define (most-strain load ea)
  ;; J/m of a line that parts at LOAD; of one that does not, when it is twice as long.
  (cond ((not (real? ea)) 0)            ; inextensible
        ((real? load) (/ (expt load 2) ea))
        (else ea)))

(define (max-load breaking-load weight)
  (if (real? breaking-load) (max breaking-load weight) breaking-load))

(define (lump-weight lump)
  ;; N: no more than the weight in air of a clump; the buoyancy of a float.
  (case (car lump)
    ((clump) (* 10 (assq-ref (cdr lump) 'mass)))
    ((float) (assq-ref (cdr lump) 'buoyancy))
    (else 0)))

(define (most-fall t)
  (let ((fields (part-all-fields (world-part (dive-world (this-dive 'energy-bounded?)) (name-of 'tether t)))))
    (* 2 (whole-length t) (fold + 0 (map lump-weight fields)))))

(define (own-weight t)
  ;; N, in water.
  (* (abs (assq-ref (tether-properties t) 'wet-weight)) (whole-length t)))

(define (most-energy t)
  "Return the most energy of motion and strain, J, that whoever drags the T-th tether, and the water, could give it before
it breaks."
  (let ((speed (fold max 1 (cons (norm (current-at '(0 0 -1))) (map vehicle-speed (vehicles)))))
        (fields (tether-properties t)))
    (+ (apply + (map most-fall (tethers)))
       (* (whole-length t)
          (+ (* 1/2 (line-mass t) (expt (* 3 speed) 2))
             (most-strain (max-load (assq-ref fields 'breaking-load) (own-weight t)) (assq-ref fields 'ea)))))))

(define (moving? t)
  (memq (model-of (name-of 'tether t)) '(dynamic auto)))

(define (energy-sound? t)
  (or (not (moving? t))
      (let* ((energy (energy (name-of 'tether t)))
             (kinetic (assq-ref energy 'kinetic)) (strain (assq-ref energy 'strain)))
        (and (>= kinetic 0) (>= strain 0) (<= (+ kinetic strain) (most-energy t))))))

(define-verb (energy-bounded?)
  "Return #t unless a moving line has more energy of motion and strain than whoever drags it and the water
could give it before it breaks."
  (every energy-sound? (tethers)))


;;; Strain.  A line at its largest tension all along has the most strain energy that tensions can tell.  A step
;;; that no solution was found for may leave an interval longer than that for a moment.

(define at-a-loss 3)                    ; looks on end
(define little 10)                      ; N: a tension this much larger tells what reading and damping leave out

(define (strain-told? strain tension length ea)
  "Return #t if TENSION, N, tells that LENGTH metres of a line of stiffness EA may hold STRAIN, J."
  (<= strain (* 1/2 length (/ (expt (+ (* 2 tension) little) 2) ea))))

(define (largest-tension name)
  ;; N; a line with bending stiffness is pushed too.
  (fold max 0 (cons (max-tension name) (map abs (f64vector->list (tensions name))))))

(define (strain-of-tether-told? t)
  (let ((name (name-of 'tether t)) (ea (assq-ref (tether-properties t) 'ea)))
    (or (not (moving? t))
        (not (real? ea))
        (strain-told? (assq-ref (energy name) 'strain) (largest-tension name) (whole-length t) ea))))

(define-verb (strain-watcher)
  "Return a procedure that returns #f if a moving line has held, when it was called the last four times, more
strain than its largest tension tells."
  (let ((misses 0))
    (lambda ()
      (set! misses (if (every strain-of-tether-told? (tethers)) 0 (+ misses 1)))
      (<= misses at-a-loss))))


;;; Turns.  As long as a tether lies between the upper and the lower end of what stands upright, it cannot get
;;; past its ends, and its turns about it change little by little; a jump by one is a line that went through.

(define most-turn 0.4)                  ; in one step

(define-record <post>
  (make-post name low high)
  post?
  (name post-name)
  (low post-low)
  (high post-high))

(define (post-of part)
  ;; PART as a post, or #f if it does not stand upright.
  (let ((fields (part-fields part)))
    (and (memq (part-head part) '(cylinder capsule))
         (let ((from (assq-ref fields 'from)) (to (assq-ref fields 'to)))
           (and (f64vector? from) (f64vector? to)
                (= (f64vector-ref from 0) (f64vector-ref to 0))
                (= (f64vector-ref from 1) (f64vector-ref to 1))
                (make-post (part-name part)
                           (min (f64vector-ref from 2) (f64vector-ref to 2))
                           (max (f64vector-ref from 2) (f64vector-ref to 2))))))))

(define (posts)
  (filter-map post-of (world-parts (dive-world (this-dive 'turns-watcher)))))

(define (beside? points post)
  ;; Whether all of the polyline POINTS is between the ends of POST.
  (let loop ((i 0))
    (or (= i (array-length points))
        (and (< (post-low post) (array-ref points i 2) (post-high post))
             (loop (+ i 1))))))

(define (all-turns posts)
  ;; Of each tether about each of POSTS its turns, or #f where it is not beside it, or in two.
  (append-map (lambda (t)
                (let* ((name (name-of 'tether t)) (points (tether-points name)))
                  (map (lambda (post)
                         (and (not (parted? name)) (beside? points post) (turns name (post-name post))))
                       posts)))
              (tethers)))

(define (little-turned? before after)
  (or (not before) (not after) (<= (abs (- after before)) most-turn)))

(define-verb (turns-watcher)
  "Return a procedure that returns #t if no tether has turned by more than 0.4 turns, since it was called last,
about anything upright that it lies beside, above its foot and below its top."
  (let* ((posts (posts)) (last (all-turns posts)))
    (lambda ()
      (let* ((now (all-turns posts)) (steady? (every little-turned? last now)))
        (set! last now)
        steady?))))


;;; The same again.

(define-verb (same-again? (flight thunk))
  "Call FLIGHT on a fork of the dive, in the dive, and in the dive as it was before: return #t if all three
end in the same state, bit for bit.  When FLIGHT raises, the dive is as it was."
  (let ((before (checkpoint)))
    (with-exception-handler
        (lambda (e) (restore! before) (raise-exception e))
      (lambda ()
        (let* ((on-a-fork (what-if (flight) (state-hash)))
               (here (begin (flight) (state-hash))))
          (restore! before)
          (flight)
          (and (equal? on-a-fork here) (equal? here (state-hash)))))
      #:unwind? #t)))

(define-syntax-rule (always-sound form ...)
  "(always-sound FORM ...): after every step that the FORMs let pass, and when they have ended, all is finite,
nothing is crossed, energy is bounded, strain is told and turns are steady.  What is not is reported."
  (let ((strain-is-told? (strain-watcher)) (turns-are-steady? (turns-watcher)))
    (always (all-finite?)
      (always (nothing-crossed?)
        (always (energy-bounded?)
          (always (strain-is-told?)
            (always (turns-are-steady?) form ...)))))))
