;;; The language itself: verbs and their arguments, units and points, worlds as values, types, currents.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core allowance)
             ((ice-9 regex) #:select (string-match))
             (bight assembly)
             (bight language)
             (bight world current)
             (bight world describe)
             (bight core errors)
             (bight core schema)
             (bight world types)
             (bight core units)
             (bight core verb)
             (bight world)
             (ice-9 exceptions)
             (srfi srfi-1)
             (srfi srfi-4))

(define (message-of thunk)
  "Return the sentence of the &bight-error that THUNK raises, or #f."
  (guard (e ((bight-error? e) (bight-error-message e)))
    (thunk)
    #f))

(define-syntax-rule (message expression)
  (message-of (lambda () expression)))

(define (endless)
  "Return a circular list."
  (let ((items (list 1 2 3)))
    (set-cdr! (cddr items) items)
    items))

(define (field-of world part name)
  "Return the value that the engine is told for the field NAME of PART of WORLD, or #f."
  (let ((told (find (lambda (entry) (eq? part (second entry))) (world->parts world))))
    (assq-ref (third told) name)))


;;; Verbs.

(define-verb (sweep! #:subject (v vehicle) (p point)
                     #:key (speed positive 1.0) (fresh flag #f) (paint (one-of plain tension) 'plain))
  "Sweep the vehicle V to P."
  (list v speed fresh paint))

(define-verb (turns-about #:subject (t tether) (object name))
  "Turns of the tether T about OBJECT."
  (list t object))

(define-verb (sampled #:subject (t tether) #:optional (n (or-false (at-least 2))))
  "N points of the tether T."
  (list t n))

(define-verb (noted (part name) #:rest (fields any))
  "PART and FIELDS."
  (cons part fields))

(define-syntax-rule (among vehicles tethers body ...)
  ;; Evaluate BODY as if the dive had these.
  (parameterize ((current-subject-lister
                  (lambda (proc kind) (if (eq? kind 'vehicle) 'vehicles 'tethers))))
    body ...))

(define-scenario verb-arguments
  "Positional and keyword arguments arrive checked and canonical, defaults where they are left out."
  (among (minnow) (line)
    (expect (sweep! '(1 2 3)) => '(0 1.0 #f plain))
    (expect (sweep! #(1 2 3) #:speed 2) => '(0 2.0 #f plain))
    (expect (sweep! (vec 1 2 3) #:fresh #t #:paint 'tension #:speed 1/2) => '(0 0.5 #t tension))
    (expect (sampled) => '(0 #f))
    (expect (sampled 5.0) => '(0 5))
    (expect (noted 'line #:length 3) => '(line #:length 3))))

(define-scenario verb-mistakes
  "Whatever is wrong with a call is said."
  (among (minnow) (line)
    (expect (sweep!) raises domain)
    (expect (sweep! '(1 2 3) '(4 5 6)) raises domain)
    (expect (sweep! '(1 2)) raises domain)
    (expect (sweep! '(1 2 . 3)) raises domain)
    (expect (sweep! (endless)) raises domain)
    (expect (sweep! (iota 100000)) raises domain)
    (expect (sweep! '(1 2 +nan.0)) raises domain)
    (expect (sweep! '(1 2 +inf.0)) raises domain)
    (expect (sweep! '(1 2 1e8)) raises domain)
    (expect (sweep! '(1 2 3) #:speed -1) raises domain)
    (expect (sweep! '(1 2 3) #:speed +nan.0) raises domain)
    (expect (sweep! '(1 2 3) #:speed (expt 10 400)) raises domain)
    (expect (sweep! '(1 2 3) #:speed "fast") raises domain)
    (expect (sweep! '(1 2 3) #:speed) raises domain)
    (expect (sweep! '(1 2 3) #:speed #:fresh) raises domain)
    (expect (sweep! '(1 2 3) #:speed 1 #:speed 2) raises domain)
    (expect (sweep! '(1 2 3) #:sped 1) raises name)
    (expect (sweep! '(1 2 3) #:paint 'tensoin) raises name)
    (expect (sampled 1) raises domain)
    (expect (sampled 2.5) raises domain)
    (expect (message (sweep! '(1 2 3) #:sped 1))
            => "sweep! has no keyword `#:sped'; it has #:speed, #:fresh, #:paint; did you mean `#:speed'?")))

(define-scenario verb-subjects
  "A leading symbol that names a vehicle or a tether is the subject; left out, it is the only one."
  (among (minnow) (line spare)
    (expect (sweep! 'minnow '(1 2 3)) => '(0 1.0 #f plain))
    (expect (sweep! 'minow '(1 2 3)) raises name)
    (expect (sweep! 'minnow) raises domain)
    (expect (turns-about 'spare 'p1) => '(1 p1))
    (expect (turns-about 'p1) raises name)
    (expect (turns-about 'spair 'p1) raises name)
    (expect (sampled 'spare 7) => '(1 7))
    (expect (sampled) raises name))
  (among (minnow) (line)
    (expect (turns-about 'p1) => '(0 p1)))
  (among () ()
    (expect (sweep! '(1 2 3)) raises name)))

(define-scenario verb-documents
  "A verb knows its name, its docstring and how it is called."
  (expect (procedure-name sweep!) => 'sweep!)
  (expect (procedure-documentation sweep!) => "Sweep the vehicle V to P.")
  (expect (verb-usage sweep!)
          => "(sweep! ['VEHICLE] P [#:speed SPEED] [#:fresh FRESH] [#:paint PAINT])")
  (expect (verb? sweep!) => #t)
  (expect (verb? car) => #f))


;;; Errors.

(define-scenario errors-carry
  "An error says its kind, its procedure, one sentence and what was given; Guile's own ways see it too."
  (expect (guard (e ((bight-error? e)
                     (list (bight-error-kind e) (bight-error-procedure e) (bight-error-given e)
                           (exception-message e))))
            (bight-raise 'limit 'weigh "~s is too much" 7))
          => '(limit weigh (7) "7 is too much"))
  (expect (catch 'bight-error
            (lambda () (raise-engine-error 'diverged 'run "no answer"))
            (lambda (key proc text kind given) (list proc text kind)))
          => '(run "no answer" diverged))
  (expect (nearest 'lenght '(from to length)) => 'length)
  (expect (nearest 'zebra '(from to length)) => #f)
  (expect (brief (endless)) => "(1 2 3 1 2 3 1 2 …)"))

(define (slips word)
  "Return the ways to write WORD with one character lost, doubled, changed, or swapped with the next."
  (append-map (lambda (i)
                (let ((head (substring word 0 i))
                      (char (string (string-ref word i)))
                      (tail (substring word (+ i 1))))
                  (append (map (lambda (wrong) (string-append head wrong tail))
                               (list "" (string-append char char) "?"))
                          (if (string-null? tail)
                              '()
                              (list (string-append head (substring tail 0 1) char (substring tail 1)))))))
              (iota (string-length word))))

(define-scenario slips-are-understood
  "Whatever one slip is made in a name of the language, the name is what was meant; with two, too, if it is long."
  (define (lost? name slip)
    (not (eq? name (nearest slip (list name)))))
  (let ((names (language-names)))
    (expect (> (length names) 200) => #t)
    (expect (filter (lambda (name) (any (lambda (slip) (lost? name slip)) (slips (symbol->string name))))
                    names)
            => '())
    (expect (any (lambda (slip) (lost? 'heave-compensation slip)) (append-map slips (slips "heave-compensation")))
            => #f)))


;;; Units and points.

(define-scenario units
  "Units convert to SI."
  (expect (knots 1.5) is (about 0.7717 #:within 1e-4))
  (expect (inches 0.5) is (about 0.0127 #:within 1e-12))
  (expect (feet 10) is (about 3.048 #:within 1e-12))
  (expect (hours 6) => 21600)
  (expect (minutes 2) => 120)
  (expect (knots 'fast) raises domain)
  (expect (hours +inf.0) raises domain))

(define-scenario points
  "Points go in as lists, vectors or f64vectors and come out as f64vectors."
  (expect (vec 1 2 3) => #f64(1 2 3))
  (expect (map (lambda (part) (part '(1 2 3))) (list x y z)) => '(1.0 2.0 3.0))
  (expect (distance '(0 0 0) #(3 4 0)) => 5)
  (expect (norm #f64(3 4 0)) => 5)
  (expect (vec+ '(1 2 3) #(1 1 1) #f64(1 0 0)) => #f64(3 3 4))
  (expect (vec- '(1 2 3) '(1 1 1)) => #f64(0 1 2))
  (expect (vec- '(1 2 3)) => #f64(-1 -2 -3))
  (expect (vec* 2 '(1 2 3)) => #f64(2 4 6))
  (expect (vec* '(1 2 3) 2) => #f64(2 4 6))
  (expect (vec* 2 3) raises domain)
  (expect (vec 1 2) raises domain)
  (expect (vec 1 2 +nan.0) raises domain)
  (expect (distance '(0 0 0) "here") raises domain))


;;; Worlds.

(define east 5)
(define anchor (vec 3 -6 -2))

(define-world trial
  "A world to try things on."
  (sea (depth 60) (current (profile (0 0.6 90) (-30 (/ 0.6 2) 80) (-60 0.1 70))))
  (rov (named minnow) (type kinematic) (at east 0 -12) (heading (* 2 45)))
  (tether (named line) (type fathom) (from 3 -6 -2) (to minnow) (length (* 2 9)) (model catenary)
          (ea inextensible)))

(define (line-of start metres which)
  (world (rov (at 1 2 -3))
         (tether (from start) (length metres) (model ,which))))

(define-scenario world-fields
  "Words stand for themselves and numbers are expressions, also inside points and rows."
  (expect (world-name trial) => 'trial)
  (expect (world-documentation trial) => "A world to try things on.")
  (expect (world-part-names trial) => '(sea minnow line))
  (expect (field-of trial 'minnow 'at) => #f64(5 0 -12))
  (expect (field-of trial 'minnow 'heading) => 90)
  (expect (field-of trial 'line 'from) => #f64(3 -6 -2))
  (expect (field-of trial 'line 'to) => 'minnow)
  (expect (field-of trial 'line 'model) => 'catenary)
  (expect (field-of trial 'line 'ea) => +inf.0)
  (expect (field-of trial 'line 'diameter) => 0.0076)
  (expect (field-of trial 'sea 'current)
          => '(profile (0.0 0.6 90.0) (-30.0 0.3 80.0) (-60.0 0.1 70.0)))
  (expect (call-with-output-string (lambda (port) (write trial port)))
          => "#<world trial: 1 rov, 1 tether>"))

(define-scenario world-points
  "A point is three expressions or one value; a bare name at an end is a part, or else a variable."
  (expect (field-of (world (rov (at '(1 2 -3)))) 'rov 'at) => #f64(1 2 -3))
  (expect (field-of (world (rov (at anchor))) 'rov 'at) => anchor)
  (expect (field-of (line-of #(1 2 3) 5 'steady) 'tether 'from) => #f64(1 2 3))
  (expect (field-of (world (rov) (tether (from anchor) (length 3))) 'tether 'from) => anchor)
  (expect (field-of (line-of '(0 0 0) 5 'v-shape) 'tether 'model) => 'v-shape)
  (expect (line-of '(0 0 0) 5 'v-shpae) raises name)
  (expect (line-of '(0 0 0) +nan.0 'steady) raises domain))

(define-scenario world-defaults
  "A world without a sea has the default one; the only vehicle is where a tether leads."
  (expect (map second (world->parts (world))) => '(sea))
  (expect (field-of (line-of '(0 0 0) 5 'steady) 'tether 'to) => 'rov))

(define-scenario world-derived-weight
  "Given one of mass and wet-weight, the type's value of the other is dropped."
  (expect (field-of (with trial (line (wet-weight 0))) 'line 'mass) => #f)
  (expect (field-of (with trial (line (type leaded-rope) (mass 0.06))) 'line 'wet-weight) => #f)
  (expect (field-of (with trial (line (type leaded-rope))) 'line 'wet-weight) => 0.4))

(define-scenario worlds-are-values
  "extend, without and with make new worlds and leave the old one alone."
  (expect (world-part-names (extend trial (rov (named perch)) (splice (list (part rov (named eel))))))
          => '(sea minnow line perch eel))
  (expect (world-part-names (without trial 'line)) => '(sea minnow))
  (expect (field-of (with trial (current 0.5 90)) 'sea 'current) => '(uniform 0.5 90.0))
  (expect (field-of (with trial (depth 70) (line (length 30))) 'line 'length) => 30)
  (expect (world-part-names trial) => '(sea minnow line))
  (expect (field-of trial 'sea 'depth) => 60)
  (expect (without trial 'lin) raises name)
  (expect (without trial 'minnow) raises name)
  (expect (with trial (dept 3)) raises name)
  (expect (with trial (line (lenght 3))) raises name)
  (expect (with trial 5) raises def)
  (expect (with 5 (depth 3)) raises domain)
  (expect (extend trial (rov (named minnow))) raises def))

(define-scenario world-mistakes
  "A world that does not hold together is refused with a sentence that teaches."
  (expect (world 5) raises def)
  (expect (world east) raises def)
  (expect (world ()) raises def)
  (expect (world . 5) raises def)
  (expect (world (tether (length))) raises def)
  (expect (world (tether length)) raises def)
  (expect (world (tether (length . 4))) raises def)
  (expect (world (tehter (length 3))) raises name)
  (expect (world (rov (at 1 2))) raises def)
  (expect (world (rov (at () 1 2))) raises domain)
  (expect (world (rov (heading +inf.0))) raises domain)
  (expect (world (rov (heading "north"))) raises domain)
  (expect (world (rov (heading 1) (heading 2))) raises def)
  (expect (world (rov (type submarine))) raises name)
  (expect (world (sea) (sea)) raises def)
  (expect (world (rov) (rov)) raises def)
  (expect (world (rov (named a)) (tether (named a) (from 0 0 0) (length 3))) raises def)
  (expect (world (rov) (tether (from 0 0 0))) raises def)
  (expect (world (rov) (tether (length 3))) raises def)
  (expect (world (tether (from 0 0 0) (length 3))) raises def)
  (expect (world (rov) (tether (from 0 0 0) (to nobody) (length 3))) raises name)
  (expect (world (rov) (tether (from 0 0 0) (to sea) (length 3))) raises def)
  (expect (world (rov) (tether (from 0 0 0) (length 0))) raises domain)
  (expect (world (rov) (tether (from 0 0 0) (length -3))) raises domain)
  (expect (world (rov) (tether (from 0 0 0) (length 3) (diameter 0))) raises domain)
  (expect (world (splice 5)) raises domain)
  (expect (define-world 5) raises def)
  (expect (string-prefix? "a tether has no `lenght'; it has length, "
                          (message (world (tether (lenght 3)))))
          => #t)
  (expect (string-prefix? "a world has no part `tehter'; it has tether, "
                          (message (world (tehter (length 3)))))
          => #t))



;;; Things inside a part.

(define (half-of metres)
  (/ metres 2))

(define-world ballasted
  "A line that sags and rises."
  (rov (named minnow) (at 0 15 -5))
  (tether (named line) (type fathom) (from 0 0 -5) (to minnow) (length 18) (model dynamic)
          (clump (at (half-of 12)) (mass 2)) (float (at 12) (buoyancy 8))
          (clump (mass (* 1/2 2)) (at 7)) (float (at 10) (span 4) (buoyancy 20))))

(define (things-in world)
  ;; The clumps and floats on the line of WORLD, in order.
  (filter (lambda (entry) (memq (car entry) '(clump float)))
          (part-fields (world-part world 'line))))

(define two-clumps-two-floats
  '((clump (at . 6.0) (mass . 2.0)) (float (at . 12.0) (buoyancy . 8.0))
    (clump (mass . 1.0) (at . 7.0)) (float (at . 10.0) (span . 4.0) (buoyancy . 20.0))))

(define-syntax-rule (line-with clause ...)
  (world (rov) (tether (named line) (from 0 0 0) (length 9) clause ...)))

(define-scenario inner-things
  "Any number of clumps and floats inside a tether, their fields expressions; they reach the engine."
  (expect (inner-heads 'tether) => '(clump float set))
  (expect (inner-heads 'rov) => '(thruster))
  (expect (inner-heads 'sea) => '())
  (expect (part-head? 'clump) => #f)
  (expect (things-in ballasted) => two-clumps-two-floats)
  (expect (filter (lambda (entry) (memq (car entry) '(clump float)))
                  (third (third (world->parts ballasted))))
          => two-clumps-two-floats)
  (expect (call-with-output-string (lambda (port) (write (world-part ballasted 'line) port)))
          => "#<tether line>")
  (enter! ballasted)
  (expect (tether-length) => 18))

(define-scenario inner-things-stay
  "They survive extend, without and with, and a type; those given in `with' replace all of their kind."
  (expect (things-in (extend ballasted (rov (named perch)))) => two-clumps-two-floats)
  (expect (things-in (without (extend ballasted (rov (named perch))) 'perch)) => two-clumps-two-floats)
  (expect (things-in (with ballasted (depth 70) (line (length 20) (type falcon))))
          => two-clumps-two-floats)
  (let ((place 3))
    (expect (things-in (with ballasted (line (clump (at place) (mass 3)) (clump (at 4) (mass 5)))))
            => '((clump (at . 3.0) (mass . 3.0)) (clump (at . 4.0) (mass . 5.0))
                 (float (at . 12.0) (buoyancy . 8.0))
                 (float (at . 10.0) (span . 4.0) (buoyancy . 20.0)))))
  (expect (things-in ballasted) => two-clumps-two-floats)
  (expect (field-of (with ballasted (line (clump (at 1) (mass 3)))) 'line 'mass) => 0.043))

(define-scenario inner-mistakes
  "What is wrong inside a part is said as it is of a part."
  (expect (line-with (clump (at 3))) raises def)
  (expect (line-with (clump)) raises def)
  (expect (line-with (clump 3 4)) raises def)
  (expect (line-with (clump . 3)) raises def)
  (expect (line-with clump) raises def)
  (expect (line-with (clump ())) raises def)
  (expect (line-with (clump (at 3) (at 4) (mass 1))) raises def)
  (expect (line-with (clump (at 3 4) (mass 1))) raises def)
  (expect (line-with (clump (at) (mass 1))) raises def)
  (expect (line-with (clump (att 3) (mass 1))) raises name)
  (expect (line-with (clump (at 3) (buoyancy 1))) raises name)
  (expect (line-with (clump (at 3) (mass 1) (clump (at 3) (mass 1)))) raises name)
  (expect (line-with (clmup (at 3) (mass 1))) raises name)
  (expect (line-with (clump (at 3) (mass 0))) raises domain)
  (expect (line-with (clump (at -1) (mass 1))) raises domain)
  (expect (line-with (float (at 3) (buoyancy +nan.0))) raises domain)
  (expect (line-with (float (at 'middle) (buoyancy 1))) raises domain)
  (expect (world (clump (at 3) (mass 1))) raises def)
  (expect (part clump (at 3) (mass 1)) raises def)
  (expect (world (rov (clump (at 3) (mass 1)))) raises name)
  (expect (with ballasted (line (clump (at 3)))) raises def)
  (expect (with ballasted (minnow (clump (at 3) (mass 3)))) raises name)
  (expect (with ballasted (clump (at 3) (mass 3))) raises def)
  (expect (define-tether-type heavy "Wrong." (clump (at 3) (mass 1))) raises def)
  (expect (check-field 'alter! 'tether 'clump 3) raises name)
  (expect (message (line-with (clump (at 3))))
          => "a clump needs (mass ...), a number above 0, up to 100000 (kg): in air, of steel")
  (expect (message (line-with (clump (att 3))))
          => "a clump has no `att'; it has at, span, mass; did you mean `at'?")
  (expect (string-prefix? "a tether has no `flaot'; it has float, "
                          (message (line-with (flaot (at 3) (buoyancy 1)))))
          => #t)
  (expect (message (world (clump (at 3) (mass 1))))
          => "a clump is written inside a tether, as in (tether ... (clump (at ...) ...)), not beside it"))

(define-scenario inner-things-in-a-dive
  "A dive refuses what does not lie on the line, and a static model; nothing of them changes under way."
  (expect (enter! (with ballasted (line (clump (at 20) (mass 3))))) raises def)
  (expect (enter! (with ballasted (line (float (at 17) (span 4) (buoyancy 3))))) raises def)
  (expect (enter! (with ballasted (line (model steady)))) raises unsupported)
  (expect (message (enter! (with ballasted (line (model steady)))))
          => "tether `line' has clumps or floats: its model must be `dynamic' or `auto'")
  (enter! ballasted)
  (expect (alter! 'line #:clump 3) raises unsupported)
  (expect (list-head (assoc "clump" (description-rows (describe 'line))) 2)
          => '("clump" "at 6 m, mass 2 kg")))

(define-scenario world-files
  "Worlds are found by name or file; what cannot be read is refused."
  (expect (world-name (find-world 'trial)) => 'trial)
  (expect (memq 'trial (worlds)) is pair?)
  (expect (find-world 'trail) raises name)
  (expect (find-world "no/such/file.scm") raises io)
  (expect (find-world 5) raises domain)
  (expect (eq? (find-world 'tank) (find-world 'tank)) => #t) ; read once
  (let ((file (scratch-file "mine.scm")))
    (define (depth-of-file depth)
      (call-with-output-file file
        (lambda (port) (write `(define-world mine "Mine." (sea (depth ,depth)) (rov (at 0 0 -1))) port)))
      (field-of (find-world file #:trust #t) 'sea 'depth))
    (expect (map depth-of-file '(20 30)) => '(20 30)))
  (expect (guard (e (#t (bight-error-procedure e))) (enter! 'trail)) => 'enter!))


;;; Currents.

(define-scenario currents
  "Every form of current has one canonical form, from a world or quoted."
  (expect (parse-current #f '(0.5 90)) => '(uniform 0.5 90.0))
  (expect (parse-current #f 'still) => '(still))
  (expect (parse-current #f '(profile (-60 .1 70) (0 (knots 1) 90)))
          => `(profile (0.0 ,(knots 1) 90.0) (-60.0 0.1 70.0)))
  (expect (parse-current #f '(turning (speed .5) (toward 90) (degrees-per-metre -0.9)))
          => '(turning 0.5 90.0 -0.9))
  (expect (parse-current #f '(power 0.5 90 (exponent 1/4))) => '(power 0.5 90.0 0.25))
  (expect (parse-current #f '(tide (speed .6) (toward 90) (period (hours 12))))
          => '(tide 0.6 90.0 43200.0))
  (expect (car (parse-current #f (lambda (p t) '(0 0 0)))) => 'function)
  (expect (field-of (with trial (current (tide (speed .6) (toward 90) (period (hours 12)))))
                    'sea 'current)
          => '(tide 0.6 90.0 43200.0)))

(define-scenario current-mistakes
  "A current that is none is refused."
  (expect (parse-current #f '(-1 90)) raises domain)
  (expect (parse-current #f '(25 90)) raises domain)
  (expect (parse-current #f '(1 +nan.0)) raises domain)
  (expect (parse-current #f '(1 2 3)) raises domain)
  (expect (parse-current #f '(profile)) raises domain)
  (expect (parse-current #f '(profile (0 1))) raises domain)
  (expect (parse-current #f '(profile (0 1 2) (0 1 3))) raises domain)
  (expect (parse-current #f `(profile ,@(map (lambda (i) (list i 1 1)) (iota 65)))) raises limit)
  (expect (parse-current #f '(turning (sped .5))) raises name)
  (expect (parse-current #f '(turning (speed .5) (toward 90))) raises def)
  (expect (parse-current #f '(tied 3)) raises name)
  (expect (parse-current #f '(grid "c.csv")) => '(grid "c.csv"))
  (expect (parse-current #f '(grid 3)) raises domain)
  (expect (parse-current #f '(wake #t)) raises name)
  (expect (parse-current #f (endless)) raises domain)
  (expect (parse-current #f "east") raises domain))


;;; Types, fields, descriptions.

(define-scenario types
  "A new type fills in what is not given; one like another takes its fields."
  (expect (define-tether-type trial-line "For trials." (like fathom) (wet-weight 0)) => 'trial-line)
  (expect (field-of (with trial (line (type trial-line))) 'line 'wet-weight) => 0)
  (expect (field-of (with trial (line (type trial-line))) 'line 'mass) => #f)
  (expect (field-of (with trial (line (type trial-line))) 'line 'diameter) => 0.0076)
  (expect (map (lambda (name) (fourth (assoc name (description-rows (describe 'trial-line)))))
               '("wet-weight" "diameter" "ea"))
          => '("" "published" "assumed"))
  (for-each (lambda (name) ; of those that come with bight; of `falcon' the vehicle's figures are told before
              (let ((rows (description-rows (describe name))))
                (for-each (lambda (field)
                            (expect (member (fourth (assoc field rows)) '("published" "measured" "fitted" "assumed"))
                                    is identity))
                          '("diameter" "ea" "cdn" "friction" "breaking-load"))))
            '(fathom fathom-slim falcon cat5e work-umbilical leaded-rope flexible-jumper))
  (expect (define-tether-type trial-line "Wrong." (like fatom)) raises name)
  (expect (define-tether-type trial-line "Wrong." (lenght 3)) raises name)
  (expect (define-tether-type trial-line "Wrong." (to minnow)) raises def)
  (expect (define-tether-type trial-line) raises def))

(define-scenario fields
  "One place checks a value for a field."
  (expect (check-field 'alter! 'tether 'ea 'inextensible) => +inf.0)
  (expect (check-field 'alter! 'tether 'sag-buoyancy 'auto) => 2)
  (expect (check-field 'alter! 'tether 'depth-rule 'linear) => 'linear)
  (expect (check-field 'alter! 'tether 'nodes 32.0) => 32)
  (expect (check-field 'alter! 'sea 'current '(0.5 90)) => '(uniform 0.5 90.0))
  (expect (check-field 'alter! 'tether 'ea +inf.0) raises domain)
  (expect (check-field 'alter! 'tether 'ea 'rigid) raises name)
  (expect (check-field 'alter! 'tether 'nodes 2.5) raises domain)
  (expect (check-field 'alter! 'tether 'size 3) raises name))

(define-scenario (where-the-figures-of-a-tether-come-from type)
  "Each type of tether that is built in says which of its figures are measured, published or assumed, bending
included."
  #:for ((type 'fathom 'fathom-slim 'cat5e 'work-umbilical 'leaded-rope 'flexible-jumper))
  (define sentence (description-sentence (describe type)))
  (define origins (map fourth (description-rows (describe type))))
  (expect (remove (lambda (word) (member word '("published" "measured" "fitted" "assumed"))) origins) => '())
  (expect (and (member "published" origins) #t) => (->bool (string-contains sentence "Published")))
  (expect (and (member "measured" origins) #t) => (->bool (string-contains sentence "Measured")))
  (expect (and (member "fitted" origins) #t) => (->bool (string-contains sentence "Fitted")))
  (expect (any (lambda (word) (string-contains sentence word)) '("Published" "Measured" "all of it")))
  (expect (string-contains sentence "bending-damping"))
  (expect (string-contains sentence "Assumed")))

(define-scenario descriptions
  "Kinds of parts, types, worlds and their parts describe themselves from the same table."
  (expect (length (description-rows (describe 'tether))) => (length (head-names 'tether)))
  (expect (map car (description-rows (describe 'clump))) => '("at" "span" "mass"))
  (expect (description-sentence (describe 'float)) => "a float or a buoyant section on a tether")
  (expect (filter-map (lambda (row) (and (member (car row) '("clump" "float")) (cadr row)))
                      (description-rows (describe (world-part ballasted 'line))))
          => '("at 6 m, mass 2 kg" "at 12 m, buoyancy 8 N" "mass 1 kg, at 7 m"
               "at 10 m, span 4 m, buoyancy 20 N"))
  (expect (description-title (describe 'fathom)) => "fathom, a type of tether")
  (expect (map car (description-rows (describe trial))) => '("sea" "minnow" "line"))
  (expect (assoc "diameter" (description-rows (describe (world-part trial 'line))))
          => '("diameter" "0.0076" "m" "from fathom"))
  (expect (describe 'tehter) raises name)
  (expect (describe 5) raises domain))

(define-scenario what-follows-has-sensible-digits
  "A field that follows from others is described with five digits."
  (in pile)
  (let ((text (object->string (describe 'line) display)))
    (expect (string-contains text "follows"))
    (expect (string-match "[0-9][.][0-9]{9}" text) => #f)))

(define (said form)
  "Return the value of FORM as a script has it, or the sentence of its error."
  (guard (e ((bight-error? e) (bight-error-message e)))
    (eval form (language-module))))

(define-scenario format-is-whole
  "A script rounds and makes columns by `format' without loading a module; what is wrong is told in a line."
  (expect (said '(format #f "~,2f m ~5d" 2.8549 7)) => "2.85 m     7")
  (expect (said '(with-output-to-string (lambda () (format #t "~a|~s" 'a "b")))) => "a|\"b\"")
  (expect (said '(format #f "~a")) => "missing argument(s) in (format #f \"~a<===\" ===>)")
  (expect (said '(format #f "~,1f" 'a))
          => "argument is not a number or a number string in (format #f \"~,1f<===\" ===>a )"))
