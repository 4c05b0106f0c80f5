;; A vehicle that is held at its stern cannot bring its bow into the current: back up first.
(define-lesson turn-into-the-current "Turn into the current from a taut tether"
  (grade 1)
  (trains handling)
  (needs slack)
  (setting speed 0.3 0.4 0.45)
  (in (with open-water (current (setting 'speed) (+ 0 (jitter 5))) (minnow (at 0 21 -6) (heading 0))
            (line (length 22))))
  (say "The current has carried you out to the end of your tether: it sets north, and the anchor is south,
up-current of you.  You want to look back into the current, to the south.")
  (set-up (drive! #:surge 0.5) (run-until taut? #:at-most 60) (run 5) (drive! #:surge 0.3))
  (show)
  (say "You are held: ~a N at the vehicle, ~a percent slack.  A tether that is taut holds your stern, and
turning against it you are thrown about." (rov-tension) (* 100 (slack)))
  (task "Get slack, then turn to south (180 within 15 degrees), and hold that for five seconds."
        (done-when (and (< (abs (- (rov-heading) 180)) 15) (> (slack) 0.02) (not (taut?))))
        (held-for 5)
        (hint-after 15 "At the end of its tether a vehicle cannot turn: first make slack.")
        (hint-after 30 "Back up, until a tenth of the tether is slack; then turn."
                    "(drive! #:surge -0.6), until (slack) is above 0.1; then (hold-heading! 180).")
        (at-most 60))
  (count yaws-held (and (taut?) (yawing?)))
  (score ((if (and (taut?) (yawing?)) 100 0) 0 0 #:by mean #:over 35 #:weight 4
          #:as "turning while held, %" #:why "Held at its stern a vehicle cannot turn: back up for slack first.")
         ((not (taut?)) 1 1 #:share 0.8 #:weight 2
          #:as "tether not taut" #:why "Keep a little slack behind you in a current, a tenth of what is out.")
         (max-tension 0 60 #:by most #:over 60
          #:why "Thrust against a taut tether pulls at it, and moves nothing."))
  (pilot expert "Backs off, then turns."
    (flies (drive! #:surge -0.8) (run-until (lambda () (> (slack) 0.12)) #:at-most 30)
           (release!) (hold-heading! 180) (run 3) (keep-off 0.1)))
  (pilot ordinary "Begins to turn, then remembers."
    (flies (hold-heading! (+ 120 (jitter 10))) (drive! #:yaw 0.5) (run (+ 5 (jitter 1)))
           (drive! #:yaw 0) (drive! #:surge 0.8) (run 8)
           (hold-heading! 180) (keep-off 0.06)))
  (pilot careless "Turns against the tether, full ahead."
    (flies (drive! #:surge 0.6) (run (+ 15 (jitter 5))) (drive! #:yaw 0.4) (run 60))))

(define (yawing?) (> (abs (array-ref (sticks) 3)) 0.2))

(define (keep-off aim)
  ;; Ahead against the current while there is less slack than AIM, heading south.
  (let hold ()
    (drive! #:surge (if (< (slack) aim) 0.7 0.3))
    (run 0.5)
    (hold)))
