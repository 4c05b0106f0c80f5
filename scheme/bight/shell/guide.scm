;;; (bight shell guide) --- what help shows besides a verb's own words: the units of its arguments, and examples.
;;;
;;; An argument's name says its unit: the same word means the same unit in all verbs but those that are named
;;; here.  Each example is evaluated, by itself, in a dive in the world `pile' one second after its beginning;
;;; a question without arguments is its own example.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell guide)
  #:use-module ((bight core verb) #:select (verb? verb-parameters))
  #:use-module (srfi srfi-1)
  #:export (unit-of
            examples-of
            in-a-lesson))


;;; Units.

(define units
  '((metres . "m") (length . "m") (depth . "m") (altitude . "m") (at . "m") (within . "m") (s . "m") (range . "m")
    (sight . "m") (noise . "m") (east . "m") (north . "m") (up . "m") (beam . "m") (draught . "m") (hole . "m")
    (thickness . "m") (extent . "m") (spacing . "m") (leg-radius . "m") (brace-radius . "m") (radius . "m")
    (stay . "m") (line . "m") (top . "m") (mesh . "m") (span . "m") (height . "m") (wire . "m") (width . "m") (riser . "m")
    (places . "m") (step . "s") (density . "kg/m3") (gravity . "m/s2") (floor . "m") (hold-out . "share of a run")
    (rate . "m/s") (speed . "m/s") (pull . "N")
    (seconds . "s") (at-most . "s") (since . "s") (for . "s") (limit . "s of processor time")
    (heading . "degrees") (tilt . "degrees") (sector . "degrees") (bend . "degrees") (list-angle . "degrees")
    (pace . "seconds of the dive in a second") (batter . "m of lean in a metre of height")))

(define units-elsewhere
  ;; Of a verb and an argument.
  '(((film rate) . "pictures in a second") ((film speed) . "seconds of the dive in a second")
    ((feet length) . "feet") ((inches length) . "inches") ((knots speed) . "knots")
    ((hours time) . "hours") ((minutes time) . "minutes")
    ((in-view? width) . "degrees") ((in-view? height) . "degrees")
    ((tether-in-view width) . "degrees") ((tether-in-view height) . "degrees")
    ((wear-profile n) . #f)))

(define (unit-of verb argument)
  "Return the unit of ARGUMENT, a symbol or keyword, of the verb called VERB, a string, or #f for a bare number."
  (let* ((name (if (keyword? argument) (keyword->symbol argument) argument))
         (here (assoc (list verb name) units-elsewhere)))
    (if here (cdr here) (assq-ref units name))))


;;; Examples.

(define examples
  '((about (expect (rov-depth) is (about 5 #:within 0.1)))
    (above (expect (tether-length) is (above 39)))
    (accuracy! (accuracy! 0.02))
    (alter! (alter! 'line #:cdn 1.4 #:friction 0.4) (alter! 'sea #:density 1000))
    (bearing-to (bearing-to '(0 0 -5)))
    (below (expect (slack) is (below 1)))
    (between (expect (rov-heading) is (between 0 360)))
    (cancel! (let ((handle (every 5 (pay-out! 0.1)))) (run 10) (cancel! handle)))
    (checkpoint (let ((before (checkpoint))) (run 20) (restore! before)))
    (collide! (collide! 'line 'p1 #f) (collide! #:all #t))
    (collided? (collided? 'line 'p1))
    (current! (current! 0.5 90) (current! '(profile (0 0.6 90) (-10 0.2 80))))
    (current-at (current-at '(0 0 -2)))
    (cut-tether! (cut-tether! #:at 20))
    (describe (describe 'line) (describe 'fathom) (describe 'tether))
    (deviation (deviation (transponders 10 #:noise 0.02)))
    (distance (distance '(0 0 0) '(3 4 0)))
    (drive! (begin (drive! #:surge 0.5 #:yaw 0.1) (run 10)))
    (enter! (enter! 'pier) (enter! (with 'pier (current 0.3 45))))
    (events (begin (move! '(6 -6 -6)) (run 10) (events #:since 0)))
    (every (begin (every 2 (pay-out! 0.1)) (run 10)))
    (fault! (fault! 'compass 5))
    (feet (feet 10))
    (find-world (world-documentation (find-world 'jacket)))
    (fly-along! (begin (fly-along! '((6 0 -5) (0 6 -5)) #:speed 0.5) (run-until arrived? #:at-most 60)))
    (fly-home! (begin (fly-home! #:speed 0.4) (run-until arrived? #:at-most 200)))
    (fly-tour! (begin (fly-tour! (plan-tour '((3 4 -5) (4 -3 -8)))) (run-until arrived? #:at-most 300)))
    (fly-to! (begin (fly-to! '(3 4 -5) #:speed 0.5) (run-until arrived? #:at-most 60)))
    (follow! (begin (follow! '((0 6 -6 -5) (10 6 0 -5))) (run 10)))
    (foresee (begin (drive! #:surge 0.5) (foresee 60)))
    (free-to-haul? (free-to-haul? #:pull 200))
    (haul-in! (begin (haul-in! 5 #:rate 0.2) (run 25) (tether-length)))
    (help (help "tension"))
    (hold-altitude! (hold-altitude! 3))
    (hold-depth! (begin (hold-depth! 8) (run 20) (rov-depth)))
    (hold-heading! (begin (hold-heading! 90) (run 20) (rov-heading)))
    (hold-position! (hold-position!))
    (hours (hours 6))
    (in-words (in-words (way-home)) (in-words 'free-to-haul?))
    (inches (inches 0.5))
    (knots (knots 1.5))
    (list-of (list-of (uniform 0 1) #:least 2 #:most 5))
    (made-of (made-of (lambda (r) `(part sphere (at 0 0 -5) (radius ,r))) (uniform 0.1 1)))
    (make-pilot (with-pilot (make-pilot 'ahead "Goes ahead." (lambda () (drive! #:surge 0.5))) (run 5)))
    (mend! (begin (fault! 'compass 5) (mend! 'compass)))
    (minutes (run (minutes 1/2)))
    (move! (begin (move! '(6 0 -5) #:speed 0.3) (run 20)))
    (norm (norm (rov-velocity)))
    (on (begin (on 'arrived (lambda (event) (release!))) (move! '(6 -6 -6)) (run 10)))
    (part-head (part-head (part sphere (at 0 0 -3) (radius 1))))
    (pay-out! (begin (pay-out! 5 #:rate 0.2) (run 25) (tether-length)))
    (place! (place! '(3 4 -5)) (place! '(5 -6 -4) #:fresh #t))
    (plan-tour (plan-tour '(p1 (3 4 -5) (4 -3 -8))) (plan-tour '(p1) #:stay 2 #:line 30))
    (point-at (point-at (/ (tether-length) 2)))
    (point-in (point-in '(0 0 -5) '(5 5 -1)))
    (range-to (range-to '(0 0 -5)))
    (release! (begin (drive! #:surge 0.5) (run 5) (release!)))
    (restore! (let ((before (checkpoint))) (run 20) (restore! before)))
    (rewind! (begin (run 20) (rewind! 10)))
    (run (run 20))
    (run-until (begin (drive! #:surge 0.5) (run-until (lambda () (> (rov-speed) 0.3)) #:at-most 30)))
    (samples-rows (let ((s (sample! 1 (slack)))) (run 5) (samples-rows s)))
    (settle! (settle! #:within 0.01 #:at-most 60))
    (slack-to-reach (slack-to-reach '(10 4 -6)))
    (stabilise! (stabilise! #t))
    (step! (step!))
    (tangent-at (tangent-at 10))
    (tension-at (tension-at 10))
    (tether-model! (begin (tether-model! 'steady) (run 1)))
    (tether-points (tether-points) (tether-points 5))
    (tensions (tensions 5))
    (threads! (threads! 2))
    (tour-left-out (tour-left-out (plan-tour '((3 4 -5) (0 90 -5)))))
    (tour-length (tour-length (plan-tour '((3 4 -5) (4 -3 -8)))))
    (tour-line-needed (tour-line-needed (plan-tour '((3 4 -5) (4 -3 -8)))))
    (tour-names (tour-names (plan-tour '(p1 (4 -3 -8)))))
    (tour-places (tour-places (plan-tour '(p1 (4 -3 -8)))))
    (tour-trial (tour-trial (plan-tour '((3 4 -5)))))
    (tour-way (fly-along! (tour-way (plan-tour '((3 4 -5)))) #:speed 0.4))
    (transponders (transponders 5 #:noise 0.02))
    (turns (turns 'p1))
    (uniform (uniform 0 1))
    (vec (vec 3 4 -5))
    (vec* (vec* 2 '(1 2 3)))
    (vec+ (vec+ (rov-position) '(0 0 1)))
    (vec- (vec- '(1 2 3) '(1 1 1)))
    (waves! (waves! '(airy (height 1) (period 6) (toward 90))))
    (wilson-interval (wilson-interval 3 20))
    (winding (winding 'p1))
    (without (world-part-names (without 'pile 'p1)))
    (world-part (world-part (find-world 'pile) 'line))
    (world-part-names (world-part-names (find-world 'pile)))
    (wrap-angle (wrap-angle 'p1))
    (x (x (rov-position)))
    (y (y (rov-position)))
    (z (z (rov-position)))
    (any-of (any-of (uniform 0 1) (integer 3 5)))
    (integer (integer 1 6))
    (one-of (one-of 'steady 'dynamic))
    (generator? (generator? (uniform 0 1)))
    (random-parts (random-parts #:most 3))
    (assume (define-property rate-is-kept
              "A winch pays out at no more than its rate." #:for ((r (uniform 0.1 1)))
              (in pile) (assume (< r 0.5)) (pay-out! 5 #:rate r) (run 1) (expect (tether-length) is (below 41))))
    (skip (define-scenario later "Not yet." (skip "the wreck has no model yet")))
    (same-again? (same-again? (lambda () (drive! #:surge 0.5) (run 5))))
    (scratch-file (define-scenario kept "A dive can be kept." (in pile) (save! (scratch-file "dive.bt"))))
    (run-scenario (begin (define-scenario still "Nothing moves." (in tank) (expect (slack) is (below 1)))
                         (run-scenario 'still)))
    (run-tests (run-tests "tests/scenario" #:match "bow and not slow"))
    (checkpoint? (checkpoint? (checkpoint)))
    (what-if-thunk (what-if-thunk (lambda () (run 60) (slack))))
    (class-decided? (class-decided? (homotopy-class)))
    (class-free? (class-free? (homotopy-class)))
    (homotopy-class? (homotopy-class? (homotopy-class)))
    (coach-log (let ((coach (make-coach))) (coach-looks! coach) (coach-log coach)))
    (coach-looks! (let ((coach (make-coach))) (coach-looks! coach)))
    (dive? (dive? (current-dive)))
    (deviation? (deviation? (deviation (transponders 5))))
    (foresight? (begin (drive! #:surge 0.5) (map foresight? (foresee 60))))
    (world? (world? (find-world 'pile)))
    (part? (part? (part sphere (at 0 0 -3) (radius 1))))
    (contact? (map contact? (contacts)))
    (segment? (map segment? (segments)))
    (samples? (samples? (sample! 1 (slack))))
    (difference? (begin (record! "dive.rec") (run 1) (stop-recording!) (difference? (replay "dive.rec"))))
    (record! (begin (record! "dive.rec") (run 5) (stop-recording!)))
    (stop-recording! (begin (record! "dive.rec") (run 5) (stop-recording!)))
    (keep-flight! (begin (drive! #:surge 1) (run 5) (keep-flight! "dive.rec") (replay "dive.rec")))
    (replay (begin (record! "dive.rec") (run 5) (stop-recording!) (replay "dive.rec")))
    (save! (save! "dive.bt"))
    (load-dive (begin (save! "dive.bt") (run 20) (load-dive "dive.bt")))
    (live! (begin (live!) (run 0.1) (freeze!)))
    (freeze! (begin (live!) (freeze!)))
    (plot (plot 'tension #:to "tension.svg"))
    (snapshot (snapshot "pile.png" #:view 'top))
    (film (film "pile.mp4" #:for 10 #:speed 5))
    (pilot! (pilot! #:view 'chase))
    (study-cases (begin (define-study bows "How the bow grows." #:for ((u 0.1 0.2))
                          (in pile) (fly (current! u 90) (run 1)) (measure (s (slack))))
                        (study-cases bows)))
    (study? (study? 3))
    (run-case (begin (define-study bows "How the bow grows." #:for ((u 0.1 0.2))
                       (in pile) (fly (current! u 90) (run 1)) (measure (s (slack))))
                     (run-case bows 1)))
    (probe-stable? (probe-stable? (car (awareness-probes))))
    (probe-error (probe-error 'tether-middle 80 90))
    (probe-score (probe-score 'tether-middle 80 90))
    (wear-profile (wear-profile 10))
    (run-lesson (run-lesson 'one-pile #:pilot 'expert))
    (report? (report? 3))
    (log-entry? (map log-entry? (logbook)))
    (log-dive! (log-dive! #:trainee "Ada" #:world "pile"))
    (log-lesson! (log-lesson! 'one-pile #:trainee "Ada" #:score 80))
    (log-probe! (log-probe! "Where is its middle?" #:trainee "Ada" #:score 80))
    (merge-logbook! (begin (log-dive! #:trainee "Ada" #:world "pile") (merge-logbook! (logbook-file))))
    (export-csv (begin (record! "dive.rec" #:frames "dive.db") (run 5) (stop-recording!)
                       (export-csv "dive.db" "dive.csv")))
    (export-npz (begin (record! "dive.rec" #:frames "dive.db") (run 5) (stop-recording!)
                       (export-npz "dive.db" "dive.npz")))
    (export-vtk (begin (record! "dive.rec" #:frames "dive.db") (run 5) (stop-recording!)
                       (export-vtk "dive.db" "dive.pvd")))
    (measure! (begin (measure! "swim.csv" #:at '(10 20 30) #:noise 0.002) (run 5)))
    (identification? (identification? 3))
    (identify (begin (measure! "swim.csv" #:at '(10 20 30)) (drive! #:surge 0.5) (run 5)
                     (identify "swim.csv" #:unknown '(cdn) #:type 'fathom #:places '(10 20 30) #:step 0.05)))
    (export-moordyn (export-moordyn (find-world 'pile) "pile.txt"))
    (import-moordyn (begin (export-moordyn (find-world 'pile) "pile.txt") (import-moordyn "pile.txt")))
    (import-orcaflex
     (begin
       (call-with-output-file "riser.yml"
         (lambda (port)
           (display "Environment:
  WaterDepth: 50
LineTypes:
  - Name: Wire
    OD: 0.02
    MassPerUnitLength: 0.001
    EA: 900
    Cd: [1.2, ~, 0.01]
    Ca: [1, ~, 0]
Lines:
  - Name: Riser
    Connection, ConnectionX, ConnectionY, ConnectionZ:
      - [Fixed, 0, 0, -5]
      - [Anchored, 20, 0, 0]
    LineType, Length, TargetSegmentLength:
      - [Wire, 60, 2]
" port)))
       (import-orcaflex "riser.yml")))
    (number-in (number-in "about 12 m"))))

;; Those that ask something of what another returns.
(define families
  '(((map NAME (contacts))
     contact-arc-length contact-force contact-normal contact-object contact-position contact-state contact-triangle)
    ((map NAME (segments)) segment-ends segment-from segment-length segment-model segment-to)
    ((NAME (deviation (transponders 5 #:noise 0.02))) deviation-max deviation-mean deviation-rms deviation-worst)
    ((map NAME (begin (drive! #:surge 0.5) (foresee 60)))
     foresight-confidence foresight-kind foresight-object foresight-seconds foresight-turns)
    ((begin (measure! "swim.csv" #:at '(10 20 30)) (drive! #:surge 0.5) (run 2)
            (NAME (identify "swim.csv" #:unknown '(cdn) #:type 'fathom #:places '(10 20 30) #:step 0.05 #:intervals 10)))
     identified identified-correlations identified-covariance identified-score identified-type identified-warnings
     residuals-along residuals-in-time)
    ((NAME (find-world 'pile)) world-documentation world-file world-name world-parts)
    ((NAME (part sphere (at 0 0 -3) (radius 1))) part-name part-fields part-all-fields)
    ((NAME (car (awareness-probes))) probe-level probe-question probe-truth)
    ((map NAME (logbook))
     log-entry-data log-entry-kind log-entry-score log-entry-trainee log-entry-what log-entry-when)
    ((let ((outcome (begin (record! "dive.rec") (run 1) (stop-recording!) (replay "dive.rec"))))
       (and (difference? outcome) (NAME outcome)))
     difference-step difference-time difference-quantities)
    ((NAME (run-lesson 'one-pile #:pilot 'expert))
     report-coached report-hash report-hints report-instructed report-marks report-passed? report-rewinds report-said
     report-seconds report-text report-total)))
(define (put name datum)
  ;; DATUM with NAME in place of NAME.
  (cond ((eq? 'NAME datum) name)
        ((pair? datum) (cons (put name (car datum)) (put name (cdr datum))))
        (else datum)))

(define (family-example name)
  (let ((family (find (lambda (family) (memq name (cdr family))) families)))
    (if family (list (put name (car family))) '())))

;; They mean something only while a lesson is taken.
(define in-a-lesson '(count! counter setting jitter tell! told messages messages-left last-answer off-the-way way-flown))

(define (own-example name verb)
  ;; A question that needs no argument.
  (if (and (verb? verb)
           (not (memq name in-a-lesson))
           (not (string-suffix? "!" (symbol->string name)))
           (not (find (lambda (row) (eq? 'required (first row))) (verb-parameters verb))))
      (list (list name))
      '()))

(define (examples-of name verb)
  "Return examples of the VERB called NAME: forms that can be evaluated, or the empty list."
  (or (assq-ref examples name)
      (let ((shared (family-example name)))
        (if (pair? shared) shared (own-example name verb)))))
