;;; A vehicle without mass holds what it can: no creep below its pull, no more than its pull at its end.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1))

(define* (line-to x #:key (pull 100) (long 20) (ea 2e5) (model 'dynamic) (near? #f) (flow 0) (others '()))
  "A world with a line of LONG metres from the origin to a vehicle at X east; NEAR?: beside a ball."
  (world (sea (depth 60) (current flow 180))
         (splice (if near? (list (part sphere (named ball) (at (/ x 2) 0.1039 -10) (radius 0.1))) '()))
         (rov (named v) (type kinematic) (at x 0 -10) (pull pull) (surge-speed 2))
         (tether (named l) (type fathom) (wet-weight 0) (nodes 32) (breaking-load 1e9) (from 0 0 -10) (to v)
                 (length long) (ea ea) (model ,model))
         (splice others)))

(define (most-pull seconds . lines)
  "The largest tension at the vehicle's end of LINES while so many SECONDS pass, N."
  (let ((most 0))
    (run-until (lambda () (set! most (fold max most (map rov-tension lines))) #f) #:at-most seconds)
    most))

(define-scenario (it-does-not-creep near? line)
  "Below its pull a vehicle stands, whatever is near: to the last bit."
  #:for ((near? #f #t) (line '(18.2 2e5) '(19.98 2e7) '(19.9998 2e9) '(18.2 2e3) '(18.2 2e7)))
  (define long (car line))
  (define ea (cadr line))
  (define held (* ea (- (/ 20 long) 1)))
  (enter! (line-to 20 #:pull (* 1.01 held) #:long long #:ea ea #:near? near?))
  (run 10)
  (expect (x (rov-position)) => 20.0)
  (expect (rov-tension) is (about held #:within (* 1e-3 held))))

(define-scenario (it-pulls-with-no-more-than-its-pull model near? flow)
  "A vehicle that flies on where its tether ends is pulled by its pull, whatever the model that stretches."
  #:for ((model 'elastic 'steady 'dynamic) (near? #f #t) (flow 0 0.6))
  (enter! (line-to 19 #:model model #:near? near? #:flow flow))
  (fly-to! 'v '(14 60 -10) #:speed 1.5)
  (expect (most-pull 14 'l) is (below 103))
  (unless near?                         ; a model without contact forces is held by the ball
    (expect (rov-tension) is (about 100 #:within 2))))

(define-scenario (auto-comes-to-its-pull near? flow)
  "So does the model `auto', whose nodes come and go meanwhile, once the line is drawn taut."
  #:for ((near? #f #t) (flow 0 0.6))
  (enter! (line-to 19 #:model 'auto #:near? near? #:flow flow))
  (fly-to! 'v '(14 60 -10) #:speed 1.5)
  (run 4)
  (expect (most-pull 10 'l) is (below 103))
  (unless near?
    (expect (rov-tension) is (about 100 #:within 2))))

(define-scenario (straight-at-its-pull model)
  "The thesis' models do not stretch: straight, they pull with it by definition."
  #:for ((model 'rubber-band 'v-shape 'catenary))
  (enter! (line-to 19 #:model model))
  (fly-to! 'v '(14 60 -10) #:speed 1.5)
  (run 14)
  (expect (taut?))
  (expect (rov-tension) is (about 100 #:within 1e-9)))

(define-scenario (what-slips-is-not-solved-in-vain near? flow)
  "A step in which an end slips as in the step before is not first solved as if the vehicle held it."
  #:for ((near? #f #t) (flow 0 0.6))
  (enter! (line-to 19 #:near? near? #:flow flow))
  (fly-to! 'v '(14 60 -10) #:speed 1.5)
  (run 10)
  (define before (profile))
  (run 4)
  (define (since key) (- (assq-ref (profile) key) (assq-ref before key)))
  (expect (since 'chain-vain) is (below (* 1/4 (since 'chain-solves)))))

(define-scenario (whatever-the-line near? long ea)
  "The same of short and long lines, soft and stiff."
  #:for ((near? #f #t) (long 2 20 100) (ea 2e3 2e5 2e7))
  (enter! (line-to (* 0.95 long) #:long long #:ea ea #:near? near?))
  (fly-to! 'v (vec (* 0.7 long) (* 3 long) -10) #:speed 1.5)
  (expect (most-pull (min 8 (* long 1/2)) 'l) is (below 107)))

(define-scenario (the-current-takes-it-along model)
  "A vehicle that stands is taken along by a current that its tether feels more than the vehicle can pull."
  #:for ((model 'steady 'dynamic 'auto))
  (enter! (line-to 19.9 #:model model))
  (run 1)
  (current! 1 0)                        ; takes no time, and so takes nothing along
  (step!)
  (expect (most-pull 10 'l) is (below 101))
  (expect (x (rov-position)) is (below 19.6)))

(define-scenario (a-track-is-where-it-was model)
  "A vehicle that follows a measured track is where the track says, whatever the tether pulls: by its bow in a current."
  #:for ((model 'dynamic 'auto))
  (enter! (world (sea (depth 200) (current 0.5 0))
                 (rov (named led) (at 70 0 -100))
                 (tether (named l) (type fathom) (wet-weight 0) (nodes 40) (from 0 0 -100) (to led) (length 100)
                         (model ,model))))
  (follow! '((0 70 0 -100) (12 82 0 -91) (60 82 0 -91)))
  (expect (most-pull 12 'l) is (above 120))
  (expect (distance (rov-position) '(82 0 -91)) is (below 1e-9)))

(define-scenario (slowly-taut-ahead speed)
  "Of a line that is solved ahead of the present it is the pull, and what one step stretches."
  #:for ((speed 0.02 0.1))
  (enter! (line-to 19 #:model 'auto #:long 19.8))
  (fly-to! 'v '(25 0 -10) #:speed speed)
  (expect (most-pull (/ 1.5 speed) 'l) is (below (+ 101 (* speed 1/60 (/ 2e5 19.8)))))
  (expect (rov-tension) is (about 100 #:within 1))
  (expect (assq-ref (profile) 'chain-stretched) is (above 20)))

(define-scenario at-the-winch-that-it-carries
  "The same of a vehicle that carries the winch."
  (enter! (world (sea)
                 (rov (named v) (type kinematic) (at 9 0 -10) (pull 60))
                 (tether (named l) (type fathom) (from v) (to 0 0 -10) (length 10) (model dynamic))))
  (fly-to! 'v '(30 0 -10) #:speed 1)
  (always (<= (anchor-tension) 62) (run 5))
  (expect (x (rov-position)) is (about 10.0 #:within 0.1)))

(define (beside)
  "A second line to the vehicle."
  (list (part tether (named l2) (type fathom) (nodes 32) (from -1 2 -8) (to v) (length 22) (model dynamic))))

(define-scenario (two-lines near?)
  "Of two lines that hold a vehicle back neither pulls harder than it can."
  #:for ((near? #f #t))
  (enter! (line-to 19 #:near? near? #:others (beside)))
  (fly-to! 'v '(14 60 -10) #:speed 1.5)
  (expect (most-pull 12 'l 'l2) is (between 99 103)))

(define-scenario (one-line-against-another near?)
  "Between two lines a vehicle bears what they do not bear of each other: it neither slips nor creeps."
  #:for ((near? #f #t))
  (enter! (world (sea)
                 (splice (if near? (list (part sphere (named ball) (at 5 0.1039 -10) (radius 0.1))) '()))
                 (rov (named v) (type kinematic) (at 10 0 -10) (pull 50))
                 (tether (named l) (type fathom) (nodes 32) (from 0 0 -10) (to v) (length 9.9) (model dynamic))
                 (tether (named l2) (type fathom) (nodes 32) (from 20 0 -10) (to v) (length 9.902) (model dynamic))))
  (run 10)
  (expect (rov-position 'v) is (about '(10 0 -10) #:within 1e-9))
  (expect (rov-tension 'l) is (above 1000)))

(define-scenario what-slips-is-of-the-dive
  "A dive whose vehicle slips is the same when it is taken back and flown again, and on a fork."
  (enter! (line-to 19))
  (fly-to! 'v '(14 60 -10) #:speed 1.5)
  (run 2)
  (define before (checkpoint))
  (run 3)
  (define after (state-hash))
  (restore! before)
  (expect (what-if (run 3) (state-hash)) => after)
  (run 3)
  (expect (state-hash) => after)
  (cut-tether! #:at 10)
  (run 1)
  (expect (rov-tension) is (below 60)))

(define (gives-way nodes accuracy)
  "Where a vehicle is, in steps of .1 s, that flies past the end of its line, and then turns back."
  (enter! (world (sea (depth 60) (current 0.2 60))
                 (rov (named v) (type kinematic) (at 17 0 -10) (pull 100) (surge-speed 2))
                 (tether (named l) (type fathom) (wet-weight 0.3) (nodes nodes) (from 0 0 -5) (to v) (length 20)
                         (ea 1.3e4) (tension-accuracy accuracy) (model dynamic))))
  (fly-to! 'v '(24 8 -12) #:speed 0.9)
  (map (lambda (k) (run 0.1) (rov-position)) (iota 60)))

(define-scenario (where-it-gives-way nodes accuracy)
  "The way on which it gives way hangs neither on the nodes nor on the parts in which steps are taken."
  #:for ((nodes 24 48 100) (accuracy 0.02 0.005))
  (define ways (gives-way 200 0.02))
  (expect (fold max 0 (map distance ways (gives-way nodes accuracy))) is (below 0.004)))

(define-scenario (it-turns-back-at-once ea)
  "Turned back, it goes as fast as it is told from the first step on: the line does not hold it there."
  #:for ((ea 1e4 1e5 1e6))
  (enter! (line-to 19 #:ea ea))
  (fly-to! 'v '(40 10 -10) #:speed 1)
  (run 6)
  (define from (rov-position))
  (fly-to! 'v '(0 0 -10) #:speed 1)
  (step!)
  (expect (distance (rov-position) from) is (about (/ 60) #:within 1e-4)))
