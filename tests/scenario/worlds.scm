;;; Random dives in random worlds of any parts, judged by laws that know no solver.  `bight bench stability
;;; --family worlds' flies more.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight test any-dive)
             (bight dive any-flight)
             (bight world any-world)
             ((bight test generator) #:select (draw expression))
             (bight core schema)
             (bight test invariant)
             (bight test soundness)
             (bight watched)
             ((srfi srfi-1) #:hide (every)))

(define (told findings)
  ;; The scripts of FINDINGS, to be read in a report.
  (map third findings))

(define-scenario (any-dive-is-sound wild?)
  "Whatever the world and the orders, no law is broken, no process dies and none hangs."
  #:for ((wild? #f #t))
  (expect (told (unsound-dives (iota (if wild? 12 24)) #:wild? wild?)) => '()))

(define-scenario (cut-twice-and-reeled-in-every-world model)
  "In each shipped world each tether is cut, cut again, hauled in and paid out: no law is broken at any time."
  #:for ((model 'dynamic 'auto))
  (define dice (seed->random-state 1))
  (define (wrong)
    (filter-map (lambda (name) (judge-tether (tether-answers name))) (tether-names)))
  (define (with-each order)
    (for-each order (tether-names)))
  (define (cut! name)
    (cut-tether! name #:at (* (random 1.0 dice) (tether-length name))))
  (for-each
   (lambda (world)
     (enter! world)
     (with-each (lambda (name) (tether-model! name model)))
     (run 1.5)
     (for-each (lambda (order seconds)
                 (with-each order)
                 (expect (wrong) => '())
                 (run seconds)
                 (expect (wrong) => '()))
               (list cut! cut! (lambda (name) (haul-in! name 3 #:rate 1)) (lambda (name) (pay-out! name 2 #:rate 1)))
               '(2 1 3 3)))
   (worlds)))


;;; The grammar knows all that the schema knows.

(define (words-in datum)
  ;; The symbols of DATUM that lead a list, each in the list that holds it: (HEAD . FIELD), too.
  (define (look datum outer found)
    (cond ((not (pair? datum)) found)
          ((and (list? datum) (symbol? (car datum)))
           (fold (lambda (item found) (look item (car datum) found))
                 (cons* (car datum) (cons outer (car datum)) found) (cdr datum)))
          (else found)))
  (delete-duplicates (look datum #f '())))

(define-scenario every-part-and-field-is-drawn
  "Each kind of part, each thing inside one and each field of the schema is drawn sooner or later."
  (define drawn (make-hash-table))
  (define dice (seed->random-state 3))
  (define worlds (any-world #:wild? #t))
  (do ((i 0 (+ i 1))) ((= i 250))
    (for-each (lambda (word) (hash-set! drawn word #t))
              (words-in (expression worlds (draw worlds dice)))))
  (define heads (append (part-heads) (append-map inner-heads (part-heads))))
  (expect (remove (lambda (head) (hash-ref drawn head)) heads) => '())
  (expect (append-map (lambda (head)
                        (filter (lambda (name) (not (hash-ref drawn (cons head name))))
                                (map field-name (remove (lambda (f) (or (eq? 'named (field-name f)) (map-field? f)))
                                                        (head-fields head)))))
                      heads)
          => '()))

(define-scenario what-is-drawn-keeps-to-the-bounds
  "No random line is refused for what another of its fields lets it be: the bounds are those of the schema."
  (define dice (seed->random-state 5))
  (define worlds (any-world #:wild? #t #:obstacles 0 #:vehicles 1))
  (define (bound-broken world)
    (let ((outcome (fly-in-child (list world))))
      (and (eq? 'refused (car outcome))
           (string-contains (second outcome) "the most there is"))))
  (expect (filter-map (lambda (i) (bound-broken (expression worlds (draw worlds dice)))) (iota 60)) => '()))

;; A line of which the mass is given, or that of its type: whether it is as light as it can be.
(define (as-light-as-can-be? world)
  (let* ((fields (lambda (name) (part-all-fields (world-part world name))))
         (line (fields 't1)) (sea (fields 'sea)) (mass (assq-ref line 'mass)))
    (and mass
         (<= mass (* (+ 1 1e-9)
                     (least-mass (or (assq-ref line 'diameter) (field-default (head-field 'tether 'diameter)))
                                 (assq-ref line 'wet-weight)
                                 (or (assq-ref sea 'density) 1025) (or (assq-ref sea 'gravity) 9.80665)))))))

(define-scenario what-is-drawn-is-no-lighter-than-foam
  "No random line is refused for its mass; now and then one is as light as a line can be."
  (define dice (seed->random-state 6))
  (define worlds (any-world #:wild? #t #:obstacles 0 #:vehicles 1 #:tethers 1))
  (define drawn (map (lambda (i) (expression worlds (draw worlds dice))) (iota 200)))
  (define (too-light world)
    (let ((outcome (fly-in-child (list world))))
      (and (eq? 'refused (car outcome))
           (string-contains (second outcome) "the least there is"))))
  (expect (filter-map too-light (take drawn 40)) => '())
  (define worlds-drawn (filter-map (lambda (world) (false-if-exception (evaluated world))) drawn)) ; not refused
  (expect (count as-light-as-can-be? worlds-drawn) is (above 3)))

(define-scenario every-kind-of-order-is-given
  "Each verb that changes a dive is ordered sooner or later, and nothing but what the language has."
  (define dice (seed->random-state 4))
  (define flights (any-flight #:wild? #t))
  (define given
    (delete-duplicates
     (append-map (lambda (i) (filter symbol? (words-in (cons 'flight (expression flights (draw flights dice))))))
                 (iota 300))))
  (for-each (lambda (verb) (expect (memq verb given)))
            '(drive! fly-to! move! place! hold-depth! release! follow! pay-out! haul-in! cut-tether!
              tether-model! accuracy! current! alter! fault! mend! threads! what-if restore! rewind!
              same-when-loaded!)))

(define-scenario most-worlds-can-be-entered
  "At least half of the random worlds are not refused, so that there is something to fly in."
  (define dives (any-dive))
  (define (entered? n)                  ; no order is given: what a flight finds is for the dives above
    (not (eq? 'refused (car (fly-in-child (list (car (expression dives (draw-dive dives 5 n)))))))))
  (define entered (count entered? (iota 30)))
  (expect entered is (above 14)))


;;; The laws notice.

(define (changing key change)
  ;; A hook that changes what a tether answers to KEY.
  (lambda (answers)
    (map (lambda (entry) (if (eq? key (car entry)) (cons key (change (cdr entry))) entry)) answers)))

(define (stretch-third points)
  (append (take points 3) (list (vec+ (fourth points) '(0 0 5))) (drop points 4)))

(define-scenario each-law-is-noticed
  "A dive is sound; with one of its answers falsified it is not, and the law that is broken says so."
  (in open-water)
  (tether-model! 'dynamic)
  (define (noticed? key change words)
    (let ((wrong (parameterize ((as-told (changing key change))) (watched (run 1/30)))))
      (and (pair? wrong) (string-contains (car wrong) words) #t)))
  (expect (watched (run 1/30)) => '())
  (expect (noticed? 'points stretch-third "do not explain"))
  (expect (noticed? 'anchor (lambda (held) (cons (vec+ (car held) '(0 0.01 0)) (cdr held))) "not at its anchor"))
  (expect (noticed? 'far-end (lambda (held) (cons (vec+ (car held) '(0 0.01 0)) (cdr held))) "made fast"))
  (expect (noticed? 'max-tension (lambda (t) (- t 1)) "largest tension"))
  (expect (noticed? 'tensions (lambda (t) (cons +nan.0 (cdr t))) "a tension is"))
  (expect (noticed? 'length (lambda (l) 0) "of it are out"))
  (expect (noticed? 'drum (lambda (l) 20) "on the drum"))
  (expect (noticed? 'contacts (lambda (none) '((3 5 seabed))) "it touches seabed at 3 m along it, 5 m from")))

(define-scenario orders-are-judged
  "An error that is none of bight's, and a refusal after which the state is another, are noticed."
  (in open-water)
  (expect (watched (pay-out! -1)) => '())
  (expect (watched (car '())) is pair?)
  (expect (watched (begin (drive! #:surge 1) (pay-out! -1))) is pair?))

(define (at-once form)
  ;; FORM in which no time passes.
  (cond ((not (pair? form)) form)
        ((eq? 'run (car form)) '(run 0))
        (else (cons (at-once (car form)) (at-once (cdr form))))))

(define-scenario what-is-refused-halfway-is-gone-back-from
  "Orders between a checkpoint and the way back to it change nothing, though one in the middle is refused."
  (enter! (world (sea) (rov (named r1) (at -6 0 -1))
                 (tether (named t1) (from -6 0 -1) (to r1) (length 17) (model rubber-band))))
  (define dice (seed->random-state 1004))
  (define flights (any-flight #:most 1 #:kinds '(restore)))
  (define refused (list 0))
  (do ((i 0 (+ i 1))) ((= i 60))
    (let ((orders (at-once (expression flights (draw flights dice)))))
      (parameterize ((refusals refused))
        (expect (evaluated `(watched ,@orders)) => '()))))
  (expect (car refused) is (above 10)))

(define-scenario what-a-file-forgets-is-noticed
  "What runs between the steps is in no file: a dive that depends on it goes on otherwise when it is loaded."
  (in open-water)
  (expect (watched (same-when-loaded! 10)) => '())
  (every 1/60 (drive! #:surge 1))
  (expect (watched (same-when-loaded! 10)) is pair?))

(define-scenario other-laws-are-noticed
  "A line that is swept along is not in balance; one that is wound is not free."
  (in open-water)
  (tether-model! 'dynamic)
  (current! 1 0)
  (expect (imbalance 'line) is (above 0.2))
  (expect (wound-though-free 'line #t '((p1 . 0) (p2 . -1))) is string?)
  (expect (wound-though-free 'line #f '((p2 . -1))) => #f))

(define-scenario what-falls-drags-other-lines-along
  "A line that lies across another has what the other's clump gains as it falls: the bound on its energy has it, too."
  (define (bound mass)
    (enter! (world (sea)
                   (rov (named a) (at 0 8 -8))
                   (rov (named b) (at 8 0 -5))
                   (tether (named under) (from 0 -8 -8) (to a) (length 17) (model dynamic))
                   (tether (named over) (from -8 0 -5) (to b) (length 20) (clump (at 8) (mass mass)) (model dynamic))))
    (most-energy 0))
  (expect (- (bound 1001) (bound 1)) is (about (* 1000 10 2 20) #:within 1e-3)))

(define-scenario a-crash-is-told
  "A dive whose process dies is a finding, and is made simpler."
  (define world '(world (sea) (rov (at 0 5 -5)) (tether (from 0 0 -5) (length 9) (model catenary))))
  (expect (finding? (fly-in-child (list world '(run 1)))) => #f)
  (expect (fly-in-child (list world '(kill (getpid) SIGSEGV))) => (list 'died SIGSEGV))
  (expect (car (fly-in-child (list world '(let loop () (loop))) #:seconds 1)) => 'died))

(define-scenario what-is-tried-says-nothing
  "What the worlds of random dives warn of is not shown: one that is made simpler is flown by the hundred."
  (define file (tmpfile))
  (setvbuf file 'none)
  (parameterize ((current-warning-port file))
    (expect (car (fly-in-child '((world (seabed (grid (lambda (x y) -30) (from 100 100) (to 110 110) (spacing 5)))
                                        (rov (named r1) (at 0 0 -5)))
                                 (run 1/60))))
            => 'flown))
  (expect (ftell file) => 0))

(define-scenario (laid-under-more-than-it-bears weight)
  "A line is laid whole whatever its own weight, or lift, and parts in the first step that finds it too much."
  #:for ((weight 30000.0 -30000.0))
  (enter! (world (sea)
                 (rov (named r1) (at -6 0 -1))
                 (tether (named t1) (from 0 0 -1) (to r1) (length 17) (mass (if (positive? weight) 1 80))
                         (wet-weight weight)
                         (breaking-load 50) (model dynamic))))
  (expect (watched (step!)) => '())
  (expect (parted?)))

(define-scenario (two-lines-from-one-place case)
  "Where their holders take two lines through each other, the force between them is bounded; where they are held
at one place, they do not press each other there."
  #:for ((case (list (vec 0.33 0.28 0.22) 0 100) (list (vec 1 0 0) 0.1 1e7)))
  (enter! (world (sea (waves (airy (height 2) (period 5) (toward 30))))
                 (rov (named r1) (at 0 0 -1))
                 (tether (named t1) (from -9 0 -5) (to r1) (length 17) (wet-weight 0) (model dynamic) (nodes 16))
                 (tether (named t2) (from -9 0 (- -5 (second case))) (to r1) (length 31) (wet-weight 0.14)
                         (nodes 7) (ride (first case)) (ea inextensible) (model dynamic))))
  (define greatest 0)
  (define (note!)
    (set! greatest (max greatest (max-tension 't1) (max-tension 't2)))
    #t)
  (always (note!) (expect (watched (run 4)) => '()))
  (expect greatest is (below (third case))))

(define-scenario (what-cannot-stretch-stores-nothing stiffness)
  "A line that is inextensible has no energy of strain, whatever a step leaves undone, stiff or not."
  #:for ((stiffness 0 1))
  (enter! (world (sea (current 0.5 0))
                 (rov (named r1) (at -6 2 -5))
                 (tether (named t1) (from -9 -4 -5) (to r1) (length 29) (wet-weight -2.8) (ea inextensible)
                         (ei stiffness) (model dynamic))))
  (always (zero? (assq-ref (energy 't1) 'strain))
    (move! 'r1 '(2 6 -7) #:speed 1)
    (run 3)))
