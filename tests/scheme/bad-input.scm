;;; Mistakes that people make, verb by verb: each is refused with its kind, and the dive stays as it was.
;;;
;;; What nobody would think of is in ../fuzz/fuzz.scm.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight core told) #:select (exception->line))
             (ice-9 exceptions)
             (srfi srfi-4))

(define-syntax-rule (refused form kind)
  ;; FORM raises an error of KIND, and changes nothing.
  (let ((before (state-hash)))
    (expect form raises kind)
    (expect (state-hash) => before)))

(define-syntax-rule (all-refused kind form ...)
  (begin (refused form kind) ...))

(define-syntax-rule (message expression)
  ;; The sentence of the error that EXPRESSION raises.
  (guard (e ((bight-error? e) (bight-error-message e)))
    expression
    "no error"))

(define-syntax-rule (culprit expression)
  ;; The procedure that the error of EXPRESSION names.
  (guard (e ((bight-error? e) (bight-error-procedure e)))
    expression
    "no error"))

(define pair
  ;; Two vehicles, each on its tether.
  (extend 'open-water
    (rov (named second) (at 3 3 -3))
    (tether (named leash) (from 1 1 0) (to second) (length 30))))

(define-syntax-rule (refuses-bad-points (verb argument ...))
  ;; (VERB ARGUMENT ... POINT) takes no POINT that is none.
  (all-refused 'domain
    (verb argument ... '(1 2))
    (verb argument ... '(1 2 3 4))
    (verb argument ... '(1 2 . 3))
    (verb argument ... '(1 2 +nan.0))
    (verb argument ... '(1 +inf.0 3))
    (verb argument ... '(1 2 1e8))
    (verb argument ... '(1 2 "3"))
    (verb argument ... (f64vector 1 2 +nan.0))
    (verb argument ... 5)
    (verb argument ... "minnow")
    (verb argument ... #f)
    (verb argument ...)))

(define-syntax-rule (refuses-bad-numbers (verb argument ...))
  (all-refused 'domain
    (verb argument ... +nan.0)
    (verb argument ... +inf.0)
    (verb argument ... -inf.0)
    (verb argument ... (expt 10 400))
    (verb argument ... 1+2i)
    (verb argument ... "5")
    (verb argument ... '(5))
    (verb argument ... #f)))


;;; Before there is a dive.

(define-scenario guile-s-own-refusals
  "What Guile itself refuses is told in a line; Guile 3.0.8 raises some of it with a value that is none."
  (for-each (lambda (wrong)
              (expect (guard (e (#t (exception->line e))) (wrong) #f)
                      is (lambda (line) (string-contains line "out of range: -"))))
            (list (lambda () (list-ref '(1 2) -1)) (lambda () (make-string -1)) (lambda () (make-hash-table -2))
                  (lambda () (string-pad "a" -1)) (lambda () (list-set! (list 1) -3 0))
                  (lambda () (logbit? -1 3)) (lambda () (string-ref "abc" -1)))))

(define-scenario no-dive
  "Without a dive every verb says how to start one."
  (expect (now) raises def)
  (expect (run 1) raises def)
  (expect (step!) raises def)
  (expect (drive! #:surge 1) raises def)
  (expect (rov-position) raises def)
  (expect (tether-length) raises def)
  (expect (current-at '(0 0 0)) raises def)
  (expect (checkpoint) raises def)
  (expect (state-hash) raises def)
  (expect (what-if (run 1)) raises def)
  (expect (every 1 #t) raises def)
  (expect (on 'taut list) raises def)
  (expect (look) raises def)
  (expect (status) raises def)
  (expect (parts) raises def)
  (expect (message (now)) => "there is no dive yet; start one, as in (enter! 'open-water)"))

(define-scenario entering
  "What is no world cannot be entered, and the dive that was stays current."
  (in open-water)
  (define dive (current-dive))
  (all-refused 'domain (enter!) (enter! 5) (enter! #f) (enter! '(world)) (enter! 'tank 'tank))
  (refused (enter! 'opne-water) 'name)
  (all-refused 'io (enter! "no/such/file.scm") (enter! "") (enter! "/") (enter! "/dev/zero"))
  (all-refused 'domain (current-dive 5) (current-dive 'open-water) (with-dive 5 (now)))
  (expect (eq? dive (current-dive))))


;;; Vehicles.

(define-scenario sticks-and-autopilots
  "Sticks go from -1 to 1; what is held is a number."
  (in open-water)
  (drive! #:surge 0.5)
  (all-refused 'domain
    (drive! #:surge 1.01) (drive! #:yaw -2) (drive! #:surge +nan.0) (drive! #:heave +inf.0)
    (drive! #:surge "1") (drive! #:surge) (drive! #:surge #:yaw) (drive! #:surge 1 #:surge 0)
    (drive! #:surge 0.1 #:yaw 7) (drive! 0.5))
  (all-refused 'name (drive! #:serge 1) (drive! 'minow #:surge 1) (drive! 'line #:surge 1))
  (refuses-bad-numbers (hold-heading!))
  (refuses-bad-numbers (hold-depth!))
  (refuses-bad-numbers (hold-altitude!))
  (all-refused 'domain (hold-heading!) (hold-depth!) (hold-altitude! -1) (release! 1) (arrived? 1))
  (all-refused 'name (release! 'minow) (hold-position! 'no-such) (hold-depth! 'minow 3))
  (expect (sticks) => '(0.5 0 0 0)))

(define-scenario going-places
  "A place is three finite numbers, a speed is above zero."
  (in open-water)
  (refuses-bad-points (fly-to!))
  (refuses-bad-points (move!))
  (refuses-bad-points (place!))
  (all-refused 'domain
    (fly-to! '(1 2 -3) #:speed 0) (fly-to! '(1 2 -3) #:speed -1) (fly-to! '(1 2 -3) #:speed +nan.0)
    (move! '(1 2 -3) #:speed "fast") (move! '(1 2 -3) #:speed) (place! '(1 2 -3) #:fresh 1)
    (place! 1 2 -3))
  (all-refused 'name
    (fly-to! '(1 2 -3) #:sped 1) (place! '(1 2 -3) #:frehs #t) (place! 'minow '(1 2 -3))))

(define-scenario following
  "A track is a file or rows of four finite numbers in the order of time."
  (in open-water)
  (all-refused 'io (follow! "no/such.csv") (follow! "") (follow! "/") (follow! "/dev/zero"))
  (all-refused 'format
    (follow! '((0 0 0 -5))) (follow! '((0 0 0 -5) (1 1 1)))
    (follow! '((0 0 0 -5) (1 1 +nan.0 -5))) (follow! '((0 0 0 -5) . 3))
    (follow! '((1 0 0 -5) (0 1 1 -5))) (follow! '((0 0 0 -5) (0 1 1 -5))))
  (all-refused 'domain (follow!) (follow! 5) (follow! #f)))


;;; The winch, the tether and the sea.

(define-scenario winch
  "The winch takes lengths from zero up and rates above zero."
  (in open-water)
  (refuses-bad-numbers (pay-out!))
  (refuses-bad-numbers (haul-in!))
  (all-refused 'domain
    (pay-out!) (pay-out! -1) (haul-in! -1) (pay-out! 1 #:rate 0) (haul-in! 1 #:rate -1)
    (pay-out! 1 #:rate +nan.0) (pay-out! 1 2))
  (all-refused 'name (pay-out! 1 #:rat 1) (pay-out! 'lin 1) (haul-in! 'minnow 1) (spooling? 'lien)))

(define-scenario models
  "Only models there are can be chosen."
  (in open-water)
  (all-refused 'name (tether-model! 'catenry) (tether-model! 'lin 'catenary))
  (all-refused 'domain (tether-model!) (tether-model! 5) (tether-model! "catenary") (tether-model! #f))
  (expect (model-of 'lin) raises name))

(define-scenario altering
  "All fields are altered or, when one is refused, none."
  (in open-water)
  (all-refused 'domain
    (alter!) (alter! 5) (alter! 'line 5) (alter! 'line #:cdn) (alter! 'line #:cdn -1)
    (alter! 'line #:cdn +nan.0) (alter! 'line #:cdn "1") (alter! 'line #:cdn 1.4 #:cdt -1)
    (alter! 'line #:cdn 1.4 #:diameter 0))
  (all-refused 'name
    (alter! 'lin #:cdn 1.4) (alter! 'line #:cnd 1.4) (alter! 'line #:model 'stedy)
    (alter! 'line #:cdn 1.4 #:no-such 1)))

(define-scenario currents
  "A current is checked before it flows."
  (in open-water)
  (all-refused 'domain
    (current!) (current! 0.5) (current! 0.5 +nan.0) (current! -1 90) (current! 21 90) (current! "fast" 90)
    (current! 0.5 90 1) (current! '(profile)) (current! '(profile (0 0.5)))
    (current! '(profile (0 0.5 90) (0 0.2 90))) (current! '(tide (speed 0.5) (toward 90) (period 0)))
    (current! '(power 0.5 90 (exponent -1))))
  (all-refused 'name (current! 'stil) (current! '(profil (0 0.5 90))) (current! '(tide (sped 1) (toward 9))))
  (refused (current! '(turning (speed 0.5))) 'def))

(define-scenario current-procedures
  "The procedure of a current takes a position and a time and returns a velocity."
  (in open-water)
  (all-refused 'domain
    (current! (lambda () '(0 0 0))) (current! car) (current! (lambda (p t) 5))
    (current! (lambda (p t) '(1 2)))
    (current! (lambda (p t) '(1 2 x))) (current! (lambda (p t) '(+nan.0 0 0)))
    (current! (lambda (p t) '(1e300 0 0))) (current! (lambda (p t) (values 1 2))))
  (refused (current! (lambda (p t) (throw 'mine))) 'mine)
  (current! (case-lambda ((p) 'never) ((p t) '(0.3 0 0))))
  (expect (current-at '(0 0 -5)) => '(0.3 0 0)))

(define-scenario current-procedures-that-fail-later
  "A procedure that goes wrong while time passes stops the run at a whole step."
  (in (with open-water (line (model steady))))
  (current! (lambda (p t) (if (> t 0.099) (throw 'mine) '(0.3 0 0))))
  (drive! #:surge 1)
  (expect (run 1) raises mine)
  (define stopped (now))
  (expect stopped is (between 0.05 0.1))
  (define before (state-hash))
  (expect (step!) raises mine)
  (expect (state-hash) => before)
  (current! 0.1 90)
  (run 0.5)
  (expect (now) is (above stopped)))


;;; Asking.

(define-scenario questions
  "A question about what is not there is refused."
  (in open-water)
  (all-refused 'name
    (rov-position 'minow) (rov-depth 'line) (sticks 'no-such) (tether-length 'minnow) (slack 'lien)
    (taut? 'no-such) (max-tension 'minow))
  (all-refused 'domain (rov-position 5) (rov-heading "minnow") (tether-length 1) (sea-depth 1) (parts 'line))
  (refuses-bad-points (range-to))
  (refuses-bad-points (bearing-to))
  (refuses-bad-points (current-at)))

(define-scenario along-the-tether
  "Arc lengths lie on the tether; counts of points are whole and at least two."
  (in open-water)
  (refuses-bad-numbers (point-at))
  (refuses-bad-numbers (tangent-at))
  (refuses-bad-numbers (tension-at))
  (all-refused 'domain
    (point-at) (point-at -1) (point-at 25.5) (tangent-at 26) (tension-at -0.1) (point-at 'line)
    (tether-points 1) (tether-points 0) (tether-points -3) (tether-points 2.5) (tether-points 1e6)
    (tether-points +nan.0) (tensions 1) (tensions "5") (tether-points 5 5))
  (refused (point-at 'lien 3) 'name))

(define-scenario measurements
  "A measured polyline is compared point by point, and has some length."
  (in open-water)
  (all-refused 'domain
    (deviation) (deviation '()) (deviation 5) (deviation '((0 0 0) (1 2))) (deviation '((0 0 0) (1 2 +nan.0)))
    (deviation '((0 0 0) (0 0 0))) (deviation '((0 0 0) (1 2 -3)) #:at '(0))
    (deviation '((0 0 0) (1 2 -3)) #:at '(0 +nan.0)) (deviation '((0 0 0) (1 2 -3)) #:at '(0 99))
    (deviation-rms 5) (deviation-max '(1 2)))
  (refused (deviation '((0 0 0) (1 2 -3)) #:ta '(0 1)) 'name))

(define-scenario two-of-each
  "With two candidates the verb asks which, and names them."
  (in pair)
  (all-refused 'name
    (rov-position) (drive! #:surge 1) (tether-length) (pay-out! 1) (fly-to! '(1 2 -3)) (hold-depth! 3))
  (expect (message (rov-position))
          => "this dive has 2 vehicles, minnow, second; say which: (rov-position 'minnow ...)")
  (expect (rov-position 'second) => '(3 3 -3)))


;;; Time.

(define-scenario passing-time
  "Time runs forward, by finite seconds."
  (in open-water)
  (refuses-bad-numbers (run))
  (all-refused 'domain
    (run) (run -1) (run 1e10) (run 1 2) (step! 1) (run-until) (run-until 5) (run-until (lambda (x) #t))
    (run-until (const #t) #:at-most -1) (settle! 5) (settle! #:within 0) (settle! #:within +nan.0)
    (settle! #:at-most +inf.0))
  (all-refused 'name (run-until (const #t) #:at-mots 1) (settle! #:witin 1)))

(define-scenario between-steps
  "What runs between steps takes a time above zero, a kind of event there is, a procedure that fits."
  (in open-water)
  (all-refused 'domain
    (every 0 #t) (every -1 #t) (every +nan.0 #t) (every 1e-9 #t) (every "1" #t)
    (on 'taut 5) (on 'taut) (on "taut" list) (on 'taut (lambda () #t)) (cancel! 5) (cancel!))
  (refused (on 'tuat list) 'name))

(define-scenario values-of-time
  "A checkpoint belongs to its dive."
  (in open-water)
  (define elsewhere (with-dive (parameterize ((current-dive #f)) (enter! 'tank)) (checkpoint)))
  (all-refused 'domain (restore!) (restore! 5) (restore! #f) (restore! (state-hash)) (checkpoint 1))
  (refused (restore! elsewhere) 'stale))


;;; Worlds.

(define-scenario worlds-that-cannot-be
  "A world with a mistake in it is refused when it is made or entered."
  (expect (world (rvo (at 0 0 -5))) raises name)
  (expect (world (rov (att 0 0 -5))) raises name)
  (expect (world (rov (at 0 0))) raises def)
  (expect (world (rov (at 0 0 +nan.0))) raises domain)
  (expect (world (rov (at 0 0 -5) (at 0 0 -6))) raises def)
  (expect (world (rov (type bluerov9) (at 0 0 -5))) raises name)
  (expect (world (sea (depth -5))) raises domain)
  (expect (world (sea (depth +inf.0))) raises domain)
  (expect (world (sea (depth "60"))) raises domain)
  (expect (world (sea (density 0))) raises domain)
  (expect (world (sea) (sea)) raises def)
  (expect (world (rov (named a)) (rov (named a))) raises def)
  (expect (world (rov) (tether (from 0 0 0) (to minow) (length 9))) raises name)
  (expect (world (rov) (tether (from 0 0 0) (length -9))) raises domain)
  (expect (world (rov) (tether (from 0 0 0) (length 9) (diameter 0))) raises domain)
  (expect (world (rov) (tether (from 0 0 0) (length 9) (lenght 9))) raises name)
  (expect (world (rov) (tether (from 0 0 0) (length 9) (model catenry))) raises name)
  (expect (world 5) raises def)
  (expect (world (splice 5)) raises domain)
  (expect (extend 5 (rov)) raises domain)
  (expect (with 'open-water (no-such (length 5))) raises name)
  (expect (with 'open-water (depth -5)) raises domain)
  (expect (without 'open-water 'lien) raises name)
  (expect (without 'open-water "line") raises domain)
  (expect (world-part 'open-water 'lien) raises name)
  (expect (world-parts 5) raises domain)
  (expect (part-name 'line) raises domain)
  (expect (world (box)) raises def)
  (expect (world (box (size 1 1))) raises def)
  (expect (world (box (size 1 1 0))) raises domain)
  (expect (world (box (size 1 1 2e7))) raises domain)
  (expect (world (box (size 1 1 1) (at 0 0 +inf.0))) raises domain)
  (expect (world (box (size 1 1 1) (friction -1))) raises domain)
  (expect (world (box (size 1 1 1) (friction tehter))) raises unbound-variable)
  (expect (world (sphere (radius 0))) raises domain)
  (expect (world (sphere (radius +nan.0))) raises domain)
  (expect (world (sphere (radius 1) (size 1 1 1))) raises name)
  (expect (world (cylinder (from 0 0 0) (radius 1))) raises def)
  (expect (world (capsule (from 0 0 0) (to 0 0 "1") (radius 1))) raises domain)
  (expect (world (convex (points))) raises def)
  (expect (world (convex (points (0 0 0) (1 0)))) raises domain)
  (expect (world (mesh)) raises def)
  (expect (world (mesh (file wreck.obj))) raises unbound-variable)
  (expect (world (mesh (file ""))) raises domain)
  (expect (world (mesh (file "a.obj") (up x))) raises name)
  (expect (world (seabed) (seabed))  raises def)
  (expect (world (seabed (grid))) raises def)
  (expect (world (seabed (grid 5))) raises def)
  (expect (world (seabed (grid (lambda (x) 0) (from 0 0) (to 1 1) (spacing 1)))) raises domain)
  (expect (world (seabed (grid (lambda (x y) 0) (from 0 0) (to 1 1)))) raises def)
  (expect (world (seabed (grid (lambda (x y) 0) (from 0 0) (to 1 1) (spaicng 1)))) raises name)
  (expect (world (seabed (grid (lambda (x y) 0) (from 0 0) (to 0 1) (spacing 1)))) raises domain)
  (expect (world (seabed (grid (lambda (x y) 0) (from 0 0) (to 1 1) (spacing 0)))) raises domain)
  (expect (world (seabed (grid (lambda (x y) 0) (from 0 0) (to 1e6 1e6) (spacing 1)))) raises limit)
  (expect (world (seabed (grid (lambda (x y) "deep") (from 0 0) (to 1 1) (spacing 1)))) raises domain)
  (expect (world (sphere (radius 1) (track))) raises def)
  (expect (world (sphere (radius 1) (track (0 0 0)))) raises domain)
  (expect (world (sphere (radius 1) (track (0 0 0 0) (0 1 1 1)))) raises domain)
  (expect (world (sphere (radius 1) (track (-1 0 0 0)))) raises domain)
  (expect (world (group)) raises def)
  (expect (world (group (named tower))) raises def)
  (expect (world (group (sea))) raises def)
  (expect (world (group (seabed))) raises def)
  (expect (world (group (boxx (size 1 1 1)))) raises name)
  (expect (world (group (at 0 0) (box (size 1 1 1)))) raises def)
  (expect (world (group (named 5) (box (size 1 1 1)))) raises domain)
  (expect (world (group 5)) raises domain)
  (expect (world (rov) (tether (from 0 0 0) (length 9) (via))) raises def)
  (expect (world (rov) (tether (from 0 0 0) (length 9) (via (1 2)))) raises domain)
  (expect (define-tether-type odd "Odd." (diameter -1)) raises domain)
  (expect (define-tether-type odd "Odd." (like fathon)) raises name)
  (expect (define-vehicle odd "Odd." (no-such 1)) raises name))


;;; Numbers and points, errors, claims, pictures.

(define-scenario numbers-and-points
  "Conversions take finite numbers, vectors take points."
  (expect (knots +nan.0) raises domain)
  (expect (inches "1") raises domain)
  (expect (hours) raises domain)
  (expect (vec 1 2) raises domain)
  (expect (vec 1 2 +inf.0) raises domain)
  (expect (vec+ '(1 2 3) 5) raises domain)
  (expect (vec-) raises domain)
  (expect (vec* 2 3) raises domain)
  (expect (vec* '(1 2 3) '(1 2 3)) raises domain)
  (expect (norm '(1 2)) raises domain)
  (expect (distance '(1 2 3)) raises domain)
  (expect (x 5) raises domain))

(define-scenario questions-about-errors
  "What asks of an error takes one."
  (expect (bight-error-kind 5) raises domain)
  (expect (bight-error-message (make-exception-with-message "not ours")) raises domain)
  (expect (bight-error-given) raises domain)
  (expect (bight-error? (make-record-type 'r '())) => #f))

(define-scenario claims-about-claims
  "What makes or runs a claim says what it takes."
  (expect (about) raises domain)
  (expect (about 'north) raises domain)
  (expect (about '(1 2 x)) raises domain)
  (expect (about 1 #:within -1) raises domain)
  (expect (about 1 #:withn 1) raises domain)
  (expect (between 2 1) raises domain)
  (expect (above "1") raises domain)
  (expect (run-scenario 5) raises domain)
  (expect (run-scenario 'no-such-scenario) raises name))

(define-scenario pictures
  "A drawing has a sensible width; a word to describe has a meaning."
  (in open-water)
  (all-refused 'domain (look #:columns 5) (look #:columns +nan.0) (look #:columns "80") (look 80) (status 1))
  (refused (look #:colums 80) 'name)
  (all-refused 'domain (describe) (describe 5) (describe "tether"))
  (refused (describe 'tehter) 'name))


;;; What is said.

(define-scenario sentences
  "An error tells what was given, what is allowed, and the nearest thing meant."
  (in open-water)
  (expect (message (drive! #:surge 2)) => "#:surge must be a number from -1 to 1, not 2")
  (expect (message (drive! #:serge 1))
          => "drive! has no keyword `#:serge'; it has #:surge, #:sway, #:heave, #:yaw; did you mean `#:surge'?")
  (expect (message (drive! #:surge)) => "#:surge needs a value after it")
  (expect (message (rov-depth 'minow))
          => "this dive has no vehicle `minow'; it has minnow; did you mean `minnow'?")
  (expect (message (run +nan.0)) => "seconds must be a time in seconds from 0 to 1e9, not +nan.0")
  (expect (message (run)) => "it is used as (run SECONDS); nothing was given")
  (expect (message (hours 1 2)) => "it is used as (hours TIME); 2 arguments were given"))

(define-scenario culprits
  "An error names the procedure that was called."
  (in open-water)
  (expect (culprit (drive! #:surge 2)) => 'drive!)
  (expect (culprit (run -1)) => 'run)
  (expect (culprit (place! 5)) => 'place!)
  (expect (culprit (rov-depth 'minow)) => 'rov-depth)
  (expect (culprit (point-at 99)) => 'point-at)
  (expect (culprit (current! -1 90)) => 'current!)
  (expect (culprit (alter! 'line #:cdn -1)) => 'alter!)
  (expect (culprit (bight-error-kind 5)) => 'bight-error-kind))

(define-scenario long-stories
  "However long, deep or circular what was given, the sentence is short."
  (in open-water)
  (define circle (list 1 2 3))
  (set-cdr! (cddr circle) circle)
  (define (short? text) (< 20 (string-length text) 400))
  (expect (short? (message (place! circle))))
  (expect (short? (message (place! (make-list 100000 1)))))
  (expect (short? (message (run (expt 10 5000)))))
  (expect (short? (message (run (make-string 100000 #\a)))))
  (expect (short? (message (enter! (string->symbol (make-string 100000 #\a))))))
  (expect (short? (message (run (look)))))
  (expect (short? (message (run (make-array 1 '(5 9)))))))
