;; Nothing to be seen: let the tether lead.  It pulls toward where it goes, and the tender keeps it talking.
(define-lesson home-by-feel "Lost visibility: home by feel"
  (grade 3)
  (trains blind route)
  (needs blind slack)
  (setting set 0.05 0.1 0.15)
  (gauge "pulls toward" (if (> (rov-tension) 0.5) (pull-bearing) "nowhere"))
  (hides look status tether-points point-at tangent-at contacts clearance rov-clearance contact-length turns
         winding windings wrap-angle foresee what-if fouled? in-view? sonar tether-in-view way-home unwind-plan
         segments free-length taut-length haul-prospect)
  (in (with debris (current (setting 'set) (+ 90 (jitter 15)))
            (minnow (type bluerov2-heavy)) (line (winch-pull 25))))
  (say "Somebody has stirred the bed up, and you see your own bow and no more.  Between you and home lies what a
platform dropped; you went out round it, west of this and east of that, and cannot say in what order.  Your
tether can.  The tender keeps a light hand on it and takes in what you give: it pulls you the way it goes.")
  (say "You read that pull, and where it goes.  Go where it points, a metre at a time, and a
little up-current of it, to the west.  The bearing of the ship is where the ship is; it is not the way there.")
  (say "The ship bears ~a." (ship-bearing))
  (probe "Is that the way home?" 'no #:choices (yes no))
  (task "Home by feel: to within 2 m of the tender, 14 m deep, and the tender with less than 8 m out."
        (done-when (and (< (range-to '(-1 -17 -14)) 2) (< (tether-length) 8)))
        (fault-after 45 "The compass drifts: do not trust it." (fault! 'compass 2))
        (hint-after 15 "Ahead where it pulls, a metre and a half; then wait until it pulls
again, and keep a little west of it.")
        (hint-after 80 "No pull?  Wait: the tender takes in the slack, and then it tells you again.")
        (fail-when (> (max-tension) 300) "You hung in your tether with more than 300 N.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 260))
  (probe "How many turns has your compass made you believe, or really put into the tether?  To the half."
         (net-turns) #:within 0.6)
  (tender "A light hand: takes in what comes back, and never pulls with more than 25 N."
    (let take-in ()
      (if (> (tether-length) 6) (haul-in! 0.5 #:rate 0.5))
      (run 1)
      (take-in)))
  (score (rov-tension 0 40 #:share 0.95 #:over 150 #:weight 3
          #:as "pull at the vehicle, N"
          #:why "A pull is a message, not a rope to climb: never haul yourself along.")
         ((excess) 0 2.5 #:by end #:over 3 #:weight 4
          #:as "tether round something, m"
          #:why "Who goes home by the bearing leaves his tether where it lay.")
         ((abs (net-turns)) 0 1 #:by most #:over 1 #:weight 2
          #:as "turns" #:why "Turning about to look for it only twists it.")
         ((now) 0 200 #:by end #:over 120 #:weight 2
          #:as "time, s" #:why "Three minutes: along the tether without stopping, slowly."))
  (pilot expert "Lets the tether lead, a step at a time."
    (answers (truth choices) truth)
    (flies (let on () (fly-by-pull 1.6 1) (on))))
  (pilot ordinary "The same, in long steps."
    (answers (truth choices) (if choices truth (+ truth 1)))
    (flies (run 10) (let on () (fly-by-pull (+ 3.2 (jitter 0.3)) 0.7) (on))))
  (pilot careless "Turns about to find it, and then steers for the ship."
    (answers (truth choices) (if choices 'yes 0))
    (flies (drive! #:yaw 0.6) (run (+ 18 (jitter 2))) (release!)
           (fly-legs '((2 0 -15) (0 -12 -14.5) (-1 -17 -14)) 0.6))))

(define (fly-by-pull step west)
  ;; STEP metres where the tether pulls, and WEST metres aside, up-current of it.
  (let* ((f (tether-force)) (n (norm f)) (p (rov-position)))
    (if (> n 0.5)
        (fly-to! (list (- (+ (x p) (* step (/ (x f) n))) (* 0.4 west)) (+ (y p) (* step (/ (y f) n))) (z p))
                 #:speed 0.4)
        (release!))
    (run 2)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))

(define (pull-bearing)
  ;; The compass bearing, degrees, toward which the tether pulls the vehicle.
  (let ((f (tether-force)))
    (bearing-to (vec+ (rov-position) f))))
