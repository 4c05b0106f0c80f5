;;; Time, tasks, pilots, forks: what runs between steps, and time as a value.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-pilot square
  "Flies the sides of a square, five seconds each."
  (for-each (lambda (surge sway)
              (drive! #:surge surge #:sway sway)
              (run 5))
            '(0.5 0 -0.5 0) '(0 0.5 0 -0.5))
  (release!))

(define-scenario a-pilot-flies-while-time-passes
  "The pilot waits where he says (run 5); whoever flies with him goes on."
  (in open-water)
  (let ((home (rov-position)))
    (with-pilot square
      (run 5)
      (expect (distance (rov-position) home) is (about 2.5 #:within 0.02))
      (run 5)
      (expect (x (rov-position)) is (about 1.75 #:within 0.02))
      (run 15))
    (expect (now) is (about 25 #:within 1e-9))
    (expect (distance (rov-position) home) is (below 0.03))))

(define-pilot tender
  "Keeps a little slack on the tether, and never hurries."
  (let watch ()
    (run-until (lambda () (< (slack) 0.1)) #:at-most 1000)
    (pay-out! 2)
    (run-until (lambda () (not (spooling?))))
    (watch)))

(define-scenario a-tender-keeps-slack
  "A scripted tender pays out while the vehicle leaves, so that the tether never comes taut."
  (in open-water)
  (drive! #:surge 0.3)
  (with-pilot tender
    (never (taut?) (run 120)))
  (expect (slack) is (between 0.05 0.2))
  (expect (tether-length) is (above 50)))

(define-scenario tasks-run-in-time-and-order
  "`every' runs on time, in order of registration, until cancelled; a callback cannot let time pass."
  (in open-water)
  (let* ((seen '())
         (note (lambda (what) (set! seen (cons (cons what (now)) seen))))
         (first (every 1 (note 'first))))
    (every 2.5 (note 'second))
    (run 5)
    (expect (length seen) => 7)
    (expect (map car (reverse seen)) => '(first first second first first first second))
    (expect (cdr (list-ref (reverse seen) 2)) is (about 2.5 #:within 0.01))
    (expect (cancel! first))
    (expect (cancel! first) => #f)
    (run 5)
    (expect (length seen) => 9)
    (every 1 (run 1))
    (expect (run 1) raises def)))

(define-scenario a-pilot-looks-ahead
  "In a pilot's body a fork runs at once, without him; where others fork a dive, he flies on in the fork."
  (in open-water)
  (let* ((seen '())
         (note! (lambda (what) (set! seen (cons what seen))))
         (scout (make-pilot 'scout "Looks ahead."
                            (lambda ()
                              (run 1)
                              (note! (what-if (run 5) (now)))
                              (run 2)
                              (note! (now))))))
    (with-pilot scout
      (run 2)
      (what-if (run 5))
      (run 5))
    (expect (reverse seen) is (about '(6 3 3) #:within 1e-9))))

(define-scenario events-are-told-once
  "`on' hears of each event once; asking for events never drains them."
  (in open-water)
  (let ((heard '()))
    (on 'taut (lambda (event) (set! heard (cons event heard))))
    (drive! #:surge 1)
    (run 30)
    (expect (length heard) => 1)
    (expect (caddar heard) => 'line)
    (expect (length (events)) => 1)
    (expect (length (events)) => 1)
    (expect (events #:since (now)) => '())
    (expect (on 'tout (lambda (event) #f)) raises name)))

(define-scenario what-if-leaves-the-present-alone
  "A fork goes its own way, with its own copies of what runs between steps."
  (in open-water)
  (let ((ticks 0) (before #f))
    (every 1 (set! ticks (+ ticks 1)))
    (run 2.5)
    (set! before (state-hash))
    (expect (what-if (drive! #:surge 1) (run 5) (now)) is (about 7.5 #:within 1e-9))
    (expect ticks => 7)
    (expect (state-hash) => before)
    (expect (now) is (about 2.5 #:within 1e-9))
    (run 0.5)
    (expect ticks => 8)))

(define-scenario a-fork-has-tasks-of-its-own
  "What a fork cancels or restores does not touch the dive; a handle stands for the task in both."
  (in open-water)
  (let* ((ticks 0)
         (begun (checkpoint))
         (clock (every 1 (set! ticks (+ ticks 1))))
         (early (checkpoint)))
    (expect (what-if (cancel! clock)) => #t)
    (run 2.5)
    (what-if (restore! early) (run 0.5))
    (expect ticks => 2)
    (run 1)
    (expect ticks => 3)
    (restore! early)
    (run 1)
    (expect ticks => 4)
    (expect (cancel! clock) => #t)
    (restore! begun)
    (expect (cancel! clock) => #f)))

(define-scenario a-checkpoint-is-a-value
  "Restored, a dive goes on to the very same state; another dive's checkpoint is refused."
  (in open-water)
  (drive! #:surge 0.5 #:yaw 0.3)
  (run 3)
  (let ((c (checkpoint)))
    (run 4)
    (let ((later (state-hash)))
      (restore! c)
      (expect (now) is (about 3 #:within 1e-9))
      (run 4)
      (expect (state-hash) => later)))
  (let ((other (current-dive)))
    (enter! 'tank)
    (let ((c (with-dive other (checkpoint))))
      (expect (restore! c) raises stale))))

(define-scenario the-winch-stalls-and-the-tether-holds
  "A taut tether holds the vehicle; hauling in stalls; paying out sets it free."
  (in open-water)
  (drive! #:surge 1)
  (run 30)
  (expect (taut?))
  (expect (held?))
  (expect (straight-distance) is (about 25 #:within 0.03)) ; it stretches a little
  (haul-in! 5)
  (run 5)
  (expect (tether-length) is (about 25 #:within 1e-2))
  (pay-out! 5 #:rate 1)
  (run 1)
  (expect (spooling?))
  (run 5)
  (expect (tether-length) is (about 30 #:within 1e-2))
  (expect (pay-out! -1) raises domain)
  (expect (haul-in! 1000) raises domain))

(define-scenario autopilots
  "Fly to a place, hold heading and depth; hands on the sticks end a flight."
  (in open-water)
  (pay-out! 40 #:rate 100)
  (run 1)
  (fly-to! '(20 20 -12) #:speed 2)
  (expect (arrived?) => #f)
  (expect (run-until arrived? #:at-most 60))
  (expect (rov-position) is (about '(20 20 -12) #:within 1e-6))
  (hold-heading! 270)
  (hold-depth! 5)
  (run 20)
  (expect (rov-heading) is (about 270 #:within 0.01 #:degrees))
  (expect (rov-depth) is (about 5 #:within 0.01))
  (hold-altitude! 30)
  (run 20)
  (expect (rov-altitude) is (about 30 #:within 0.01))
  (move! '(0 0 -10))
  (drive! #:surge 0.1)
  (expect (arrived?)))

(define-scenario (the-current-changes setting east)
  "`current!' takes every form in which a world writes a current."
  #:for ((setting '(0.5 90)
                  '((0.5 90))
                  '((profile (0 0.5 90) (-30 0.3 80)))
                  '((turning (speed 0.5) (toward 90) (degrees-per-metre -0.9)))
                  '((power 0.5 90 (exponent 1/7)))
                  '((tide (speed 0.5) (toward 90) (period (hours 12.42)))))
         (east 0.5))
  (in open-water)
  (expect (apply current! setting) is (about (vec east 0 0) #:within 1e-12))
  (expect (current-at '(1 2 0)) is (about (vec east 0 0) #:within 1e-12)))

(define-scenario a-procedure-for-a-current
  "A procedure of position and time is a current too; one that fails leaves the dive as it was."
  (in open-water)
  (current! (lambda (place time) (list (* 0.1 time) 0 0)))
  (run 2)
  (expect (current-at '(0 0 0)) is (about '(0.2 0 0) #:within 1e-9))
  (expect (current! 'still) => '(0 0 0))
  (let ((before (state-hash)))
    (expect (current! (lambda (place) '(0 0 0))) raises)
    (expect (current! '(profle (0 1 2))) raises name)
    (expect (state-hash) => before)))

(define-scenario the-sea-can-be-altered
  "`alter!' knows the sea: current, density and gravity, which the line feels; not its depth."
  (in open-water)
  (expect (alter! 'sea #:current '(0.5 90)) => 'sea)
  (expect (x (current-at '(0 0 0))) => 0.5)
  (expect (alter! 'sea #:densty 1000) raises name)
  (let ((before (state-hash)))
    (expect (alter! 'sea #:current 'still #:depth 1000) raises domain)
    (expect (state-hash) => before))
  (tether-model! 'elastic)
  (expect (max-tension) => 0)                     ; neutral in this water
  (alter! 'sea #:density 1000)
  (expect (max-tension) is (above 0))             ; and not in fresher
  (expect (z (point-at 12)) is (below -6)))

(define-scenario a-current-cannot-meddle
  "The procedure of a current may not change the dive that asks it, nor a task leave its own dive."
  (in open-water)
  (let ((before (state-hash)))
    (expect (current! (lambda (p t) (run 1) '(0.1 0 0))) raises def)
    (expect (current! (lambda (p t) (pay-out! 1) '(0.1 0 0))) raises def)
    (expect (state-hash) => before))
  (current! (lambda (p t) (vec 0.2 0 0)))
  (run 1)
  (expect (x (current-at '(0 0 -3))) => 0.2)
  (expect (what-if (run 1) (now)) is (about 2 #:within 1e-9))
  (every 1 (enter! 'tank))
  (expect (run 2) raises def))

(define-scenario turns-are-counted
  "Two turns clockwise and one back are one."
  (in open-water)
  (drive! #:yaw 1)
  (run 16)
  (expect (net-turns) is (about 2 #:within 1e-6))
  (drive! #:yaw -1)
  (run 8)
  (expect (net-turns) is (about 1 #:within 1e-6))
  (expect (rov-heading) is (about 0 #:within 1e-4 #:degrees)))
