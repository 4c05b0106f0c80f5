;; Pilot and tender each see only their own: what the other must know has to be said, and in few words.
(define-lesson blind-tender "Blind tender"
  (grade 3)
  (trains crew blind slack)
  (needs slack route)
  (setting most-slack 0.35 0.3 0.25)
  (message-limit 10)
  (hides look status tether-length tether-points point-at slack excess taut? taut-length free-length
         contacts clearance contact-length stuck? turns winding windings wrap-angle max-tension rov-tension
         anchor-tension tension-at tensions payout-counter load-cell foresee what-if fouled?)
  (in (with jacket (current 0.15 (+ 0 (jitter 15))) (line (length 12))))
  (gauge "ship, m" (ship-range))
  (gauge "bears" (ship-bearing))
  (say "You see your camera and your instruments: compass, depth, and range and bearing to the ship.  Your
tender sees the counter and the load cell of the winch, 12 m out now, and nothing of you.  It does what you
tell it: \"give 5\", \"take 5\"; to \"out?\" it answers; \"range 20\" lets it know how far away you are.  You may
send ten messages.  Too little holds you back; too much lies on the legs, down-current.")
  (task "Between the two southern legs to the work inside the jacket: within a metre of it."
        (target "work" '(3.5 2 -8))
        (done-when (< (range-to '(3.5 2 -8)) 1))
        (held-for 3)
        (hint-after 20 "You will be 25 m from the ship: 13 or 14 m more than are out, a tenth of it to spare.")
        (hint-after 60 "t, and then give 14, asks for it.  The way in is straight from the south, 8 m deep."
                    "(tell! 'tender \"give 14\"); (3.5 -9 -8) is the way in.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 180))
  (probe "Pilot: how many metres of tether are out?" (tether-length) #:ratio 0.1)
  (probe "Tender: how many metres away is the vehicle?" (ship-range) #:ratio 0.1 #:answer (tender-thinks))
  (task "Home by the same way, to within 1.5 m of where you began, and no more than 14 m left out."
        (target "home" '(-2 -14 -8))
        (done-when (and (< (range-to '(-2 -14 -8)) 1.5) (< (tether-length) 14)
                        (= 0 (winding 'jacket/leg-b2)) (= 0 (winding 'jacket/leg-b1))))
        (hint-after 40 "Have it taken in as you come: t, and then take 6, twice, and not at once.")
        (hint-after 100 "t, and then out?, tells you what the counter shows; less than 14 m at the end.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 180))
  (tender "Does what it is told, and reads out its counter and its load cell."
    (let listen ()
      (run-until (lambda () (heed (told 'tender))))
      (listen)))
  (score ((* 100 (slack)) 2 (* 100 (setting 'most-slack)) #:share 0.9 #:weight 4
          #:as "slack, %" #:why "Your range and a tenth to spare: ask for that much, and in time.")
         ((null? (contacts)) 1 1 #:share 0.75 #:weight 3
          #:as "tether on nothing" #:why "What is too much lies on the legs, down-current.")
         (max-tension 0 60 #:by most #:over 60 #:weight 2
          #:why "Held back?  Ask before you push.")
         (messages-left 0 10 #:by end
          #:as "messages left" #:why "Ten messages, and one that was not understood is one gone.")
         (rov-clearance 1 +inf.0 #:by least #:over 1
          #:why "Straight in from the south, between the legs, and out the same way."))
  (pilot expert "Asks for what he needs, says where he is, and has it taken in as he comes."
    (answers (truth choices) (+ 26 (jitter 0.4)))
    (flies (tell! 'tender "give 3") (fly-legs '((3.5 -10 -8)) 0.4)
           (tell! 'tender "give 4") (fly-legs '((3.5 -5 -8)) 0.4)
           (tell! 'tender "give 4") (fly-legs '((3.5 -1 -8)) 0.4)
           (tell! 'tender "give 3") (fly-legs '((3.5 2 -8)) 0.4)
           (tell! 'tender "range 25"))
    (flies (fly-legs '((3.5 -2 -8)) 0.4) (tell! 'tender "take 4")
           (fly-legs '((3.5 -7 -8)) 0.4) (tell! 'tender "take 5")
           (fly-legs '((3.5 -11 -8)) 0.4) (tell! 'tender "take 3")
           (fly-legs '((-2 -14 -8)) 0.4) (tell! 'tender "take 2")))
  (pilot ordinary "Asks for plenty at once, and does not say where he is."
    (answers (truth choices) 40)
    (flies (tell! 'tender "give 24") (run 20) (fly-legs (list (list (+ 3.5 (jitter 0.2)) -10 -8) '(3.5 2 -8)) 0.4))
    (flies (fly-legs '((3.5 -10 -8)) 0.4) (tell! 'tender "take 10") (fly-legs '((-2 -14 -8)) 0.4)
           (tell! 'tender "take 10") (run 30) (tell! 'tender "take 4.5")))
  (pilot careless "Chats, gets nothing by it, asks for everything, and goes home outside the leg."
    (answers (truth choices) 20)
    (flies (tell! 'tender "hello") (run (+ 5 (jitter 2))) (tell! 'tender "more please")
           (fly-to! '(3.5 -10 -8) #:speed 0.8) (run 30)
           (for-each (lambda (i) (tell! 'tender "more") (run 3)) (iota 5))
           (tell! 'tender "give 45") (run 20) (fly-legs '((3.5 -10 -8) (3.5 2 -8)) 0.8))
    (flies (fly-legs '((9 0 -8) (9 -9 -8) (-2 -14 -8)) 0.8) (tell! 'tender "take 50"))))

(define (heed message)
  ;; What the tender does about MESSAGE, or nothing; true when there was one.
  (if message
      (let ((n (number-in message)) (is? (lambda (word) (string-prefix? word message))))
        (cond ((and n (is? "give")) (pay-out! n #:rate 1) (answer "Giving."))
              ((and n (is? "take")) (haul-in! n #:rate 1) (answer "Taking."))
              ((and n (is? "range")) (count! 'range (- n (counter 'range))) (answer "Noted."))
              ((is? "out?") (answer (whole (payout-counter)) " m out, " (whole (load-cell)) " N."))
              (else (answer "Say again?")))))
  message)

(define (answer . words) (tell! 'pilot (apply string-append words)))

(define (whole x) (number->string (inexact->exact (round x))))

(define (tender-thinks)
  ;; What it was told last, or else what the counter shows.
  (if (> (counter 'range) 0) (counter 'range) (payout-counter)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
