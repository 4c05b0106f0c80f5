;; The vehicle pulls its tether to the site; the tender gives just enough.
(define-lesson just-enough-slack "Just enough slack: forty metres out"
  (grade 1)
  (trains slack)
  (setting set 0.1 0.2 0.3)
  (in (with open-water (current (setting 'set) (+ 90 (jitter 20))) (minnow (at 0 8 -6)) (line (length 9))))
  (say "Today you are pilot and tender in one: you pay tether out and haul it in yourself.  Too little
tether and it stops you; too much and it drifts, drags and finds something to hang on.")
  (show)
  (fork-and-show "Watch what happens to one who leaves and pays nothing out."
    (fly-to! '(0 48 -8) #:speed 0.4) (run 60))
  (task "Fly forty metres north, to within 1.5 m of the target, keeping 5 to 20 % of the tether slack."
        (target "north" '(0 48 -8))
        (done-when (< (range-to '(0 48 -8)) 1.5))
        (hint-after 30 "Keep the share that is slack near 12 %: pay out as fast as you fly."
                    "(slack) is that share.")
        (hint-after 90 "A metre out for each metre you go, and then look at the slack."
                    "(fly-to! '(0 48 -8) #:speed 0.3) (pay-out! 45 #:rate 0.33)")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (task "Now home, to within 1.5 m of where you began: take in what comes loose."
        (target "home" '(0 8 -6))
        (done-when (< (range-to '(0 8 -6)) 1.5))
        (hint-after 60 "Haul in as fast as you come: a metre for each metre."
                    "(haul-in! 40 #:rate 0.28)")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (count snaps (taut?))
  (score ((* 100 (slack)) 5 20 #:share 0.8 #:weight 8
          #:as "slack, %" #:why "Pay out as fast as you fly, and look at the slack every few metres.")
         (rov-tension 0 20 #:share 0.95 #:over 60
          #:why "Who tows his tether has too much of it in the water, or too little of it out.")
         ((counter 'snaps) 0 0 #:by end #:over 3 #:weight 2
          #:as "times it came taut" #:why "Each time it comes taut the tether takes a jerk: pay out before.")
         ((not (taut?)) 1 1 #:share 0.98 #:weight 2
          #:as "tether not taut" #:why "A taut tether stops you, and hauls at whatever it lies on."))
  (pilot expert "Watches the slack, and tends as he flies."
    (flies (fly-to! '(0 48 -8) #:speed 0.4) (tend 0.12 0.4))
    (flies (fly-to! '(0 8 -6) #:speed 0.4) (tend 0.12 0.4)))
  (pilot ordinary "Looks at the slack now and then."
    (flies (fly-to! '(0 48 -8) #:speed 0.4) (tend-seldom))
    (flies (fly-to! '(0 8 -6) #:speed 0.4) (tend-seldom)))
  (pilot careless "Pays out when he is stopped, and then far too much."
    (flies (fly-to! '(0 48 -8) #:speed 0.6)
           (let again () (run-until taut?) (run (+ 4 (jitter 2))) (pay-out! 30 #:rate 1) (run 10)
                (fly-to! '(0 48 -8) #:speed 0.6) (again)))
    (flies (fly-to! '(0 8 -6) #:speed 0.6))))

(define (tend aim rate)
  ;; Look twice a second, and pay out or haul in toward the slack AIM.
  (let look ()
    (let* ((wanted (/ (straight-distance) (- 1 aim)))
           (off (- wanted (tether-length))))
      (cond ((> off 0.2) (pay-out! off #:rate (* 1.2 rate)))
            ((< off -0.2) (haul-in! (- off) #:rate (* 1.2 rate))))
      (run 0.5)
      (look))))

(define (tend-seldom)
  ;; A handful of metres every ten seconds or so.
  (let look ()
    (run (+ 10 (jitter 2)))
    (let ((off (- (/ (straight-distance) 0.82) (tether-length))))
      (cond ((> off 1) (pay-out! (+ off 2 (jitter 2)) #:rate 0.8))
            ((< off -3) (haul-in! (- (- off) 2) #:rate 0.8))))
    (look)))
