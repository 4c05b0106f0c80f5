;;; Properties, tested by themselves: what is known to be false is found, and told as the simplest case of it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight test expect) #:select (failure-remarks))
             ((bight test generator) #:select (draw simpler rounder expression value-of))
             ((bight test invariant) #:select (strain-told?))
             (bight test scenario)
             ((bight test property) #:select (call-with-cases show-case))
             (ice-9 textual-ports)
             ((srfi srfi-1) #:hide (every)))

(define language
  (let ((module (make-fresh-user-module)))
    (module-use! module (resolve-interface '(bight)))
    module))

(define-syntax-rule (property-of form ...)
  ;; The scenario that a property makes, kept nowhere.
  (car (collect-scenarios (lambda () (define-property p "A claim." form ...)))))

(define (remarks-on property)
  (failure-remarks (car (outcome-failures (run-scenario property)))))

(define (simplest property)
  ;; The scenario that is told of PROPERTY, as data.
  (let ((lines (drop (remarks-on property) 1)))
    (call-with-input-string (string-join lines "\n") read)))

(define (definition name scenario)
  ;; What SCENARIO defines NAME, or (NAME), to be.
  (or-map (lambda (form)
            (and (pair? form) (eq? 'define (car form))
                 (if (pair? (cadr form))
                     (and (eq? name (caadr form)) (cddr form))
                     (and (eq? name (cadr form)) (caddr form)))))
          scenario))


;;; Shrinking.

(define-scenario what-is-true-passes
  "A property that holds passes; every case is a claim."
  (define outcome (run-scenario (property-of #:for ((x (uniform 0 1))) #:cases 30 (expect (<= 0 x 1)))))
  (expect (outcome-status outcome) => 'pass)
  (expect (outcome-claims outcome) => 30))

(define-scenario numbers-shrink
  "A number comes down to the least that fails, a sum of two to one of them alone."
  (define one (simplest (property-of #:for ((x (uniform 0 9))) (expect (not (< 2.45 x 2.9))))))
  (expect (definition 'x one) => 2.5)
  (define whole (simplest (property-of #:for ((n (integer -50 50))) (expect (> n -7)))))
  (expect (definition 'n whole) => -7)
  (define rounded (simplest (property-of #:for ((x (uniform 0 100))) (expect (< x 2.4567)))))
  (expect (definition 'x rounded) => 3)
  (define two (simplest (property-of #:for ((x (uniform 0 10)) (y (uniform 0 10))) (expect (< (+ x y) 4)))))
  (expect (+ (definition 'x two) (definition 'y two)) => 4))

(define-scenario lists-shrink
  "What does not matter is dropped from a list; what does is made simple."
  (define found
    (simplest (property-of #:for ((l (list-of (integer 0 100) #:most 20)))
                           (expect (not (any (lambda (n) (> n 60)) l))))))
  (expect (definition 'l found) => '(list 61)))

(define-scenario choices-shrink
  "An earlier choice is simpler."
  (define found (simplest (property-of #:for ((c (one-of 'red 'green 'blue))) (expect (eq? c 'red)))))
  (expect (definition 'c found) => ''green))

(define-scenario a-planted-fault-in-a-dive
  "\"No vehicle gets deeper than 8 m\" is false: one act, a flight to just below it, and an empty sea remain."
  (define found
    (simplest
     (property-of #:for ((scene (random-world #:models '(rubber-band)))
                         (pilot (random-pilot #:most 8 #:seconds 20 #:does '(fly fly pay-out))))
                  (in scene)
                  (always (< (rov-depth) 8) (pilot)))))
  (define scene (definition 'scene found))
  (expect (map car (cdr scene)) => '(sea rov tether))
  (expect (assq 'sea (cdr scene)) => '(sea (depth 12) (current 0 0)))
  (define acts (definition 'pilot found))
  (expect (length acts) => 3)           ; what he does, how long, and no value
  (expect (caar acts) is (lambda (act) (memq act '(drive! fly-to!))))
  (expect (car (cadr acts)) => 'run))

(define-scenario the-same-case-again
  "The scenario that is told fails as the case did; the same seed gives the same case, another one another."
  (define property
    (property-of #:for ((x (uniform 0 100)) (l (list-of (uniform 0 9)))) (expect (< (+ x (length l)) 20))))
  (define told (simplest property))
  (expect (simplest property) => told)
  (define scenario
    (car (collect-scenarios
          (lambda () (eval told language)))))
  (expect (outcome-status (run-scenario scenario)) => 'fail)
  (define (first-case seed) (call-with-seed seed (lambda () (show-case property 0))))
  (expect (first-case 2) => (first-case 2))
  (expect (not (equal? (first-case 2) (first-case 1)))))

(define-scenario parts-of-the-cases
  "Cases are drawn one by one: those from 10 on are the same whether those before were run or not."
  (define seen '())
  (define property
    (property-of #:for ((x (uniform 0 1))) #:cases 12 (set! seen (cons x seen)) (expect #t)))
  (run-scenario property)
  (define all (reverse seen))
  (set! seen '())
  (call-with-cases 10 12 (const #t) #f (lambda () (run-scenario property)))
  (expect (reverse seen) => (list-tail all 10)))


;;; Cases that are none.

(define-scenario assuming
  "A case that assumes otherwise is drawn again; if none can be found, that is a failure."
  (expect (outcome-status (run-scenario (property-of #:for ((x (uniform 0 1))) (assume (> x 0.5))
                                                     (expect (> x 0.5)))))
          => 'pass)
  (expect (outcome-status (run-scenario (property-of #:for ((x (uniform 0 1))) (assume (> x 2)))))
          => 'fail))

(define-scenario refused-worlds-are-no-cases
  "A world that is refused, since something stands in the way, is drawn again."
  (define outcome
    (run-scenario
     (property-of #:for ((x (uniform -5 5))) #:cases 20
       (in (world (sea (depth 20)) (cylinder (named post) (from x 0 1) (to x 0 -20) (radius 1))
                  (rov (named minnow) (at 0 5 -5))
                  (tether (named line) (type fathom) (from 0 -5 -5) (to minnow) (length 12) (model catenary))))
       (expect (> (abs x) 1)))))
  (expect (outcome-status outcome) => 'pass))

(define-scenario malformed-properties
  "What is no generator is refused when the file is loaded."
  (expect (property-of #:for ((x 3)) (expect x)) raises domain)
  (expect (uniform 2 1) raises domain)
  (expect (list-of 3) raises domain)
  (expect (made-of (lambda () 1) (uniform 0 1)) raises domain)
  (expect (random-pilot #:does '(dance)) raises domain)
  (expect (random-world #:models '(warp)) raises domain))


;;; Generators.

(define-scenario (generators-draw-what-they-say g)
  "Whatever is drawn, or is simpler, is in range, and its expression has the value that it prints."
  #:for ((g 0 1 2))
  (define generator (list-ref (list (uniform -2 3) (integer 5 9) (uniform 1.5 1.5)) g))
  (define low (list-ref '(-2 5 1.5) g))
  (define high (list-ref '(3 9 1.5) g))
  (define dice (seed->random-state 7))
  (do ((i 0 (+ i 1))) ((= i 200))
    (let ((datum (draw generator dice)))
      (for-each (lambda (d) (expect (value-of (expression generator d)) is (between low high)))
                (cons datum (append (simpler generator datum) (rounder generator datum)))))))

(define-scenario worlds-and-pilots
  "Random worlds can be entered and random pilots fly; things are touched in a good part of the dives."
  (define world-generator (random-world))
  (define pilot-generator (random-pilot #:most 8 #:seconds 5))
  (define dice (seed->random-state 11))
  (define touched 0)
  (do ((i 0 (+ i 1))) ((= i 20))
    (enter! (value-of (expression world-generator (draw world-generator dice))))
    ((value-of (expression pilot-generator (draw pilot-generator dice))))
    (when (assq 'touched (events)) (set! touched (+ touched 1))))
  (expect touched is (above 4)))


;;; The invariants cry out when they should.

(define-scenario invariants-notice
  "With all pairs switched off, a vehicle flown through a pile crosses it, and its line turns all at once."
  (in pile)
  (define steady? (turns-watcher))
  (expect (nothing-crossed?))
  (expect (all-finite?))
  (expect (energy-bounded?))
  (expect (steady?))
  (collide! #:all #f)
  (tether-model! 'rubber-band)
  (place! '(8 -8 -5))
  (steady?)
  (place! '(0 0 -5))
  (expect (not (nothing-crossed?)))
  (place! '(0 8 -5))
  (expect (not (steady?))))

(define-scenario strain-that-is-not-told-is-noticed
  "14 kJ in 17 m of line are more than 119 N tell, 1.2 mJ no more than 7 N do; a line at rest tells what it holds."
  (expect (not (strain-told? 14005 119 17 1e5)))
  (expect (strain-told? 1.2e-3 7 17 1e5))
  (in jacket)
  (define told? (strain-watcher))
  (drive! #:surge 1)
  (always (told?) (run 5)))

(define-scenario determinism-notices
  "A flight that is not the same every time is told from one that is."
  (in open-water)
  (expect (same-again? (lambda () (drive! #:surge 0.5) (run 1))))
  (expect (not (same-again? (lambda () (drive! #:surge (random 1.0)) (run 1))))))
