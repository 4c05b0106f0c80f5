;; Home along the tether when nothing else can be seen: it knows the way that you have forgotten.
(define-lesson follow-your-tether "Follow your tether home"
  (grade 2)
  (trains blind route)
  (needs route)
  (setting sight 4 3 2)
  (in (with debris (current 0.1 (+ 90 (jitter 15)))))
  (say "You worked here among what a platform dropped, and now the silt is up: you see ~a m, and nothing
tells you which way you came but your tether.  It leads round what lies between you and home, and the
current sets it east against that.  Go home beside it, up-current of it: the tender takes in what you give
him.  Never run ahead of it, never lose sight of it, and do not turn about looking for it."
       (setting 'sight))
  (probe "Which way does your tether leave you?  Its bearing." (bearing-to (tether-ahead 3)) #:within 25)
  (task "Follow your tether home, to within 2 m of where it is paid out, 14 m deep, and keep it in view."
        (done-when (< (range-to '(-1 -17 -14)) 2))
        (hint-after 20 "Turn until the camera sees your tether, go three metres beside it, a metre west of it, and
again."
                    "(point-at (- (tether-length) 3)) is on it, 3 m from you.")
        (hint-after 60 "The camera does not see it any more?  Stop, and turn back."
                    "(in-view? #:sight 3) tells whether it does.")
        (hint-after 120 "What it lies against it lies against on your side: keep a metre off, west.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (probe "You have come home beside your tether.  Is there anything between you and the tender that holds
it: yes or no?" (if (fouled?) 'yes 'no) #:choices (yes no))
  (tender "Takes in what comes back, and does not pull."
    (let take-in ()
      (if (and (> (slack) 0.1) (> (tether-length) 6)) (haul-in! 0.5))
      (run 1)
      (take-in)))
  (score ((in-view? #:sight (setting 'sight)) 1 1 #:share 0.7 #:weight 4
          #:as "tether in the camera"
          #:why "Three metres along it at a time: who looks further ahead loses it in the silt.")
         ((abs (net-turns)) 0 1 #:by most #:over 0.5 #:weight 3
          #:as "turns of the vehicle" #:why "Turning about to look for it only twists it.")
         ((abs (turns 'stub)) 0 0.5 #:by end #:over 0.5 #:weight 3
          #:as "turns about the stub" #:why "Beside your tether you come round what it goes round.")
         (rov-clearance 0.5 +inf.0 #:by least #:over 0.5 #:weight 2
          #:why "What your tether lies against stands beside your way: keep a metre west of it."))
  (pilot expert "Three metres of tether at a time, up-current of it."
    (answers (truth choices) truth)
    (flies (follow-tether 3 1.2 0.35)))
  (pilot ordinary "Looks too far ahead, and cuts the corners."
    (answers (truth choices) (if choices truth (+ truth 35)))
    (flies (follow-tether (+ 8 (jitter 1)) 1.2 0.3)))
  (pilot careless "Turns about looking for it, and goes home by the course he thinks he came."
    (answers (truth choices) (if choices 'no 180))
    (flies (drive! #:yaw 0.5) (run (+ 20 (jitter 2))) (release!)
           (fly-legs '((5 4 -15) (6 -6 -15) (5 -12 -15) (-1 -17 -14)) 0.5))))

(define (tether-ahead metres)
  ;; The point of the tether METRES before its end.
  (point-at (max 0 (- (tether-length) metres))))

(define (follow-tether ahead west speed)
  ;; Toward the point AHEAD metres along the tether, WEST of it, again and again.
  (let ((p (tether-ahead ahead)))
    (fly-to! (list (- (x p) west) (y p) (z p)) #:speed speed)
    (run 1)
    (follow-tether ahead west speed)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
