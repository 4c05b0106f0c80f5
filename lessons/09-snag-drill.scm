;; A tether caught in a wedge: find out where, never pull, fly back along it, clear it.
(define-world frame
  "A post with a strut against it: between them a tether is caught."
  (sea      (depth 14) (current 0.1 90))
  (seabed   (friction 0.6))
  (cylinder (named post) (from 0 0 1) (to 0 0 -14) (radius 0.2) (friction 0.4))
  (capsule  (named strut) (from 0.3 0 -9) (to 3 0 -5) (radius 0.1))
  (rov      (named minnow) (at 5 -7 -6) (heading 150))
  (tether   (named line) (type fathom) (wet-weight 0) (model dynamic) (from 0 -14 -4) (to minnow)
            (via (-1.5 -1.5 -5) (-1.2 1.2 -5.5) (1 1.2 -5) (1.5 -1.5 -5)) (length 29)))

(define-lesson snag-drill "The snag drill"
  (grade 2)
  (trains unwrapping)
  (needs slack route)
  (setting set 0 0.1 0.2)
  (in (with frame (current (setting 'set) (+ 90 (jitter 20)))))
  (say "Your tether is held by something behind you.  The drill: thrust ahead until it is taut, so that you
know it is held and where; back off for slack; turn round; follow your tether to the snag; clear it.  Never
pull, and do not let anybody haul.")
  (task "Ahead, gently, to the south-east until the tether comes taut."
        (first (settle! #:at-most 5))
        (done-when (or (taut?) (> (rov-tension) 15)))
        (hint-after 30 "A third of the stick is enough: with shift the key puts it there."
                    "(drive! #:surge 0.3)")
        (fail-when (> (max-tension) 300) "You pulled with more than 300 N: never pull to clear a snag.")
        (at-most 120))
  (task "Back off for slack: the tether hangs loose, less than 5 N at the vehicle."
        (done-when (and (not (taut?)) (< (rov-tension) 5)))
        (held-for 2)
        (hint-after 20 "Astern a little, then let go of everything."
                    "(drive! #:surge -0.3), then (release!).")
        (fail-when (> (max-tension) 300) "You pulled with more than 300 N: never pull to clear a snag.")
        (at-most 90))
  (task "Turn round until you look along your tether, within 25 degrees, and hold still."
        (first (hold-heading! (+ 180 (along-the-tether))) (run 4) (release!))
        (done-when (< (off-the-tether) 25))
        (held-for 2)
        (hint-after 20 "The map shows where it leads; turn there, and hold the heading."
                    "(bearing-to (point-at (- (tether-length) 3))) is where it leads; (hold-heading! ...).")
        (at-most 90))
  (probe "What is it that holds your tether?" 'post #:choices (post strut seabed))
  (task "Follow it to the snag: to within 2 m of the post at the depth of your tether."
        (target "post" '(0.8 0.5 -5))
        (done-when (< (range-to '(0.8 0.5 -5)) 2))
        (hint-after 40 "It leads north-west to the post: fly slowly, with the slack behind you.")
        (fail-when (> (max-tension) 300) "You pulled with more than 300 N: never pull to clear a snag.")
        (at-most 120))
  (task "Clear it: go round the post by the way the tether came, until it holds no more."
        (done-when (and (= 0 (winding 'post)) (< (abs (turns 'post)) 0.3)))
        (hint-after 40 "Wound tells how far round the post it goes: clockwise +.  Go round against that."
                    "(turns 'post)")
        (hint-after 80 "North of the post to the west, and then south."
                    "(fly-to! '(0 3 -5)), (fly-to! '(-3 0 -5)).")
        (fail-when (> (max-tension) 300) "You pulled with more than 300 N: never pull to clear a snag.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 200))
  (score (max-tension 0 60 #:by most #:over 100 #:weight 4
          #:why "A third of the stick is enough to feel that you are held.")
         ((now) 0 100 #:by end #:over 120 #:weight 4
          #:as "time, s" #:why "Taut, slack, turn, follow, clear: the drill takes a minute and a half."))
  (pilot expert "Does the drill."
    (flies (drive! #:surge 0.25))
    (flies (drive! #:surge -0.3) (run 6) (release!))
    (flies (hold-heading! (along-the-tether)))
    (flies (fly-legs '((2.5 2 -5) (1 2 -5)) 0.4))
    (flies (fly-legs '((0 3 -5) (-3 1 -5) (-4 -4 -5) (-4 -9 -5)) 0.4)))
  (pilot ordinary "Does the drill, slowly, and pulls harder than he need."
    (flies (drive! #:surge 0.7))
    (flies (run 12) (drive! #:surge -0.3) (run 10) (release!))
    (flies (run 10) (hold-heading! (along-the-tether)))
    (flies (run 15) (fly-legs '((3 2 -5) (1 2 -5)) (+ 0.2 (jitter 0.02))))
    (flies (run 15) (fly-legs '((0 3 -5) (-3 1 -5) (-4 -4 -5) (-4 -9 -5)) (+ 0.2 (jitter 0.02)))))
  (pilot careless "Pulls, and pulls again."
    (answers (truth choices) 'strut)
    (flies (drive! #:surge 1) (run 60))
    (flies (let pull () (drive! #:surge 1) (run (+ 10 (jitter 3))) (drive! #:surge -1) (run 3) (pull)))))

(define (along-the-tether) (bearing-to (point-at (- (tether-length) 3))))

(define (off-the-tether)
  ;; Degrees between the heading and where the tether leads.
  (let ((d (- (rov-heading) (along-the-tether))))
    (abs (- d (* 360 (round (/ d 360)))))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
