;; Each turn of the vehicle is a turn in its tether.  Take off what you put on.
(define-lesson count-your-turns "Count your turns"
  (grade 1)
  (trains turns)
  (in (with open-water (current 0.05 90) (minnow (at 0 10 -6)) (line (length 20) (model catenary))))
  (say "Every time your heading goes once round, your tether has one turn more in it.  Twist makes loops,
and loops hang on things.  Count, take the shorter way only when it is the way back, and come home with none.")
  (task "Inspect the four sides: fly to within 1 m of each of them, in any order, then to the dock in their
middle."
        (target "side 1" '(6 14 -6)) (target "side 2" '(-6 14 -6))
        (target "side 3" '(-6 6 -6)) (target "side 4" '(6 6 -6)) (target "dock" '(0 10 -6))
        (done-when (and (all-sides-seen?) (< (range-to '(0 10 -6)) 1)))
        (hint-after 60 "The figure called turns counts for you, clockwise +."
                    "(net-turns)")
        (hint-after 120 "If you go round by the right three times, go round by the left three times too.")
        (at-most 300))
  (probe "How many turns have you made, to the nearest quarter, clockwise +?" (net-turns) #:within 0.3)
  (task "Take all turns off: face north again with no turn left."
        (done-when (< (abs (net-turns)) 0.06))
        (held-for 2)
        (hint-after 30 "Turn against the turns you made: to the left takes off clockwise ones."
                    "(drive! #:yaw -0.5) turns to the left.")
        (at-most 120))
  (count north-east (< (range-to '(6 14 -6)) 1))
  (count north-west (< (range-to '(-6 14 -6)) 1))
  (count south-west (< (range-to '(-6 6 -6)) 1))
  (count south-east (< (range-to '(6 6 -6)) 1))
  (score ((abs (net-turns)) 0 1 #:by most #:over 1.5 #:weight 3
          #:as "turns in the tether" #:why "Take the shorter way round only where it is the way back.")
         ((abs (net-turns)) 0 0.06 #:by end #:over 1 #:weight 2
          #:as "turns left at the end" #:why "What you put on you take off before you come home."))
  (pilot expert "Goes there and back, never all the way round."
    (answers (truth choices) truth)
    (flies (fly-legs '((6 14 -6) (-6 14 -6) (-6 6 -6)) 0.4)
           (take-off 0.5)
           (fly-legs '((6 6 -6) (0 10 -6)) 0.4))
    (flies (take-off 0.5)))
  (pilot ordinary "Goes round once, and counts nearly right."
    (answers (truth choices) (+ truth (jitter 0.5)))
    (flies (fly-legs '((6 14 -6) (-6 14 -6) (-6 6 -6) (6 6 -6) (0 10 -6)) 0.35))
    (flies (run 5) (take-off 0.3)))
  (pilot careless "Looks round at every corner, always the same way."
    (answers (truth choices) (+ 1 (jitter 1)))
    (flies (for-each (lambda (p)
                       (fly-legs (list p) 0.4)
                       (look-round (+ 0.8 (jitter 0.2))))
                     '((6 14 -6) (6 6 -6) (-6 6 -6) (-6 14 -6)))
           (fly-legs '((0 10 -6)) 0.4))
    (flies (run 10) (take-off 0.2))))

(define (all-sides-seen?)
  (= 4 (length (filter (lambda (name) (> (counter name) 0)) '(north-east north-west south-west south-east)))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))

(define (look-round turns)
  ;; Turn clockwise by TURNS.
  (let ((end (+ (net-turns) turns)))
    (drive! #:yaw 0.6)
    (run-until (lambda () (>= (net-turns) end)) #:at-most 60)
    (release!)))

(define (take-off stick)
  ;; Turn back until no turn is left.
  (release!)
  (drive! #:yaw (if (> (net-turns) 0) (- stick) stick))
  (let ((sign (if (> (net-turns) 0) 1 -1)))
    (run-until (lambda () (< (* sign (net-turns)) 0.02)) #:at-most 120))
  (release!)
  (run 1))
