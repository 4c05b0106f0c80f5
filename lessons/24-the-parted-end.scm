;; A vehicle has lost its tether: find the loose end from down-current, and make nothing worse.
(define-world lost-vehicle
  "A vehicle without power among debris, what is left of its tether streaming from it; another is sent for it."
  (sea      (depth 18) (current 0.2 90))
  (seabed   (friction 0.6))
  (box      (named containers) (at 0 6 -15.4) (size 6 2.4 5.2) (heading 10))
  (cylinder (named stub) (from 13 -3 -11) (to 13 -3 -18) (radius 0.5))
  (rov      (named finder) (at 2 -14 -9) (heading 0))
  (rov      (named lost) (at 0 0 -12) (heading 250) (surge-speed 0) (sway-speed 0) (heave-speed 0))
  (tether   (named line) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
            (from 0 -22 -3) (to finder) (length 12) (drum 120))
  (tether   (named parted) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
            (from 20 -1 -11.5) (to lost) (length 21)))

(define-lesson the-parted-end "The parted end: recovering what was lost"
  (grade 4)
  (trains route unwrapping)
  (needs bow route)
  (yours finder line)
  (setting set 0.15 0.2 0.25)
  (in (with lost-vehicle (current (setting 'set) (+ 90 (jitter 8)))))
  (say "The other vehicle's tether has parted.  It sits dead, 12 m deep, among containers, and some fourteen
metres of its tether stream from it, neutral, down-current: to the east.  You are to take hold of the loose end,
so that a new line can be shackled to it.")
  (say "It is a line in the water without a pilot.  Run over it, and it is in your thrusters; cross up-current
of it, and the water lays your own tether on it, and there are two vehicles to recover.  Come at the end from
down-current.")
  (set-up (cut-tether! 'parted #:at 7) (run 40))
  (show)
  (probe "From which side do you come to the loose end?" 'east #:choices (west east over))
  (probe "Bearing from you to the loose end, by the chart and the set of the water?" (bearing-to (loose-end))
         #:within 30)
  (task "Take hold: within 0.8 m of the loose end for five seconds."
        (done-when (< (range-to (loose-end)) 0.8))
        (held-for 5)
        (hint-after 20 "South of it all, then east, past where the end must be; then turn west, up-current.")
        (hint-after 60 "It hangs at about 12 m, twelve metres or so east of the wreck of the vehicle.")
        (fail-when (< (near-the-line) 0.4) "The loose line is in your thrusters: now there are two of you down here.")
        (fail-when (parted?) "Your own tether has parted.")
        (at-most 300))
  (task "With the position noted, home: within 1.5 m of where you began, your tether free of everything."
        (target "home" '(2 -14 -9))
        (done-when (and (< (range-to '(2 -14 -9)) 1.5) (< (excess) 0.4)))
        (hint-after 40 "East first, away from it, then south, then home.")
        (fail-when (parted?) "Your own tether has parted.")
        (at-most 300))
  (tender "Gives and takes a metre at a time."
    (let tend ()
      (let ((loose (* (slack) (tether-length))))
        (cond ((or (< loose 1.5) (taut?)) (pay-out! 'line 1 #:rate 0.9))
              ((and (> loose 3.5) (> (tether-length) 11)) (haul-in! 'line 1 #:rate 0.8))))
      (run 1)
      (tend)))
  (score ((null? (contacts)) 1 1 #:share 0.95 #:weight 3
          #:as "your tether on nothing"
          #:why "The water carries it onto what lies down-current of it: be down-current yourself.")
         ((near-the-line) 1 +inf.0 #:share 0.98 #:weight 4
          #:as "off the loose line, m"
          #:why "A loose line is drawn into thrusters from a metre away: come to its end, and only that.")
         (rov-clearance 1 +inf.0 #:by least #:over 1 #:weight 2
          #:why "A metre off everything: you cannot see the loose line and the steel at once.")
         ((now) 0 240 #:by end #:over 150 #:as "time, s" #:why "Four minutes: the loose end drifts on while you look."))
  (pilot expert "South about, and up-current to the end."
    (answers (truth choices) truth)
    (flies (fly-legs '((17 -10 -11)) 0.6) (seek 0.35))
    (flies (fly-legs '((17 -8 -11) (14 -12 -10) (2 -14 -9)) 0.5)))
  (pilot ordinary "Nearly abreast of it, from the south."
    (answers (truth choices) (if choices truth (+ truth 40)))
    (flies (run 15) (fly-legs (list (list 9 (+ -6 (jitter 0.5)) -11)) 0.4) (seek 0.3))
    (flies (run 15) (fly-legs '((9 -8 -11) (2 -14 -9)) 0.35)))
  (pilot careless "To the vehicle, and along its line from there."
    (answers (truth choices) (if choices 'west 0))
    (flies (fly-legs (list (list -4 (+ -4 (jitter 0.5)) -12) '(-2 3 -12) '(2 2 -12) '(6 0.3 -11.9)) 0.6) (seek 0.4))
    (flies (fly-legs '((6 0 -12) (-4 1 -12) (2 -14 -9)) 0.6))))

(define (lost-line) (tether-tail 'parted))

(define (loose-end)
  ;; The point of the parted line that is farthest along it from its vehicle.
  (let ((points (array->list (lost-line))))
    (car points)))

(define (near-the-line)
  ;; How far the vehicle is from the loose line, its last three metres left out.
  (let ((end (loose-end)) (p (rov-position)))
    (apply min 99 (map (lambda (q) (if (< (distance q end) 3) 99 (distance q p))) (array->list (lost-line))))))

(define (seek speed)
  (fly-to! (loose-end) #:speed speed)
  (run 1)
  (seek speed))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
