;; Under a ledge a line that floats rises and rubs: hang something on it.
(define-world quay
  "A quay with a ledge that juts out over the water, and a line that floats a little."
  (sea    (depth 14) (current 0.1 0))
  (seabed (friction 0.6))
  (box    (named wall) (at 0 5 -10) (size 40 1.5 8))
  (box    (named ledge) (at 0 1.25 -6.25) (size 40 6 0.5))
  (rov    (named minnow) (at 0 -5 -9) (heading 0))
  (tether (named line) (type fathom) (wet-weight -0.3) (model dynamic)
          (from 0 -14 -5) (to minnow) (length 22)))

(define-lesson clump-and-float "Clump or float: under the ledge"
  (grade 2)
  (trains trim)
  (needs bow)
  (setting set 0.05 0.1 0.15)
  (in (with quay (current (setting 'set) (+ 0 (jitter 15)))))
  (say "You are to look at the wall under a ledge.  This line is neutral in fresh water and floats in the
sea: loose, it rises.")
  (show)
  (fork-and-show "Watch what it does under the ledge as it is."
    (fly-to! '(0 2.5 -8.5) #:speed 0.4) (run 60))
  (probe "What do you hang on it before you go under: a clump, a float, or nothing?" 'clump
         #:choices (clump float nothing))
  (branch ((eq? 'clump (last-answer))
           (in (with quay (current (setting 'set) (+ 0 (jitter 15)))
                     (line (clump (at 13) (mass 0.3)) (clump (at 17) (mass 0.3)))))
           (say "A clump at 13 m and one at 17 m hold the line down, below the ledge."))
          ((eq? 'float (last-answer))
           (in (with quay (current (setting 'set) (+ 0 (jitter 15))) (line (float (at 15) (buoyancy 4)))))
           (say "A float is on: mind where it goes."))
          (else
           (in (with quay (current (setting 'set) (+ 0 (jitter 15)))))
           (say "As it is, then.")))
  (show)
  (task "Fly to within 0.7 m of the place under the ledge, and stay for ten seconds."
        (target "ledge" '(0 2.5 -8.5))
        (done-when (< (range-to '(0 2.5 -8.5)) 0.7))
        (held-for 10)
        (hint-after 40 "Stay below 8 m, under the edge of the ledge, and go slowly."
                    "(fly-to! '(0 2.5 -8.5) #:speed 0.3)")
        (fail-when (parted?) "The tether has parted.")
        (at-most 150))
  (task "And back to within a metre of home, in front of the wall."
        (target "home" '(0 -5 -9))
        (done-when (< (range-to '(0 -5 -9)) 1))
        (hint-after 40 "Straight back, beside your tether.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 150))
  (score ((null? (contacts)) 1 1 #:share 0.95 #:weight 5
          #:as "tether on nothing" #:why "A line that floats rises under the ledge: a clump holds it below.")
         (rov-clearance 1 +inf.0 #:by least #:over 0.6 #:weight 4
          #:why "Stay below 8 m under the edge, and go slowly.")
         (max-tension 0 40 #:by most #:over 80
          #:why "A hard pull under a ledge is a tether that rubs along its edge."))
  (pilot expert "A clump, and well below the edge."
    (flies (fly-legs '((0 -2 -9) (0 2.5 -8.5)) 0.4))
    (flies (fly-legs '((0 -2 -9) (0 -5 -9)) 0.4)))
  (pilot ordinary "A clump, but he shaves the ledge."
    (flies (run 10) (fly-legs (list (list (jitter 0.3) 0 -7.05) '(0 2.2 -7.9)) 0.3) (fly-legs '((0 2.5 -8.5)) 0.2))
    (flies (run 10) (fly-legs (list (list (jitter 0.3) 0 -7.05) '(0 -5 -9)) 0.3)))
  (pilot careless "Thinks that what floats wants a float, and hurries."
    (answers (truth choices) 'float)
    (flies (fly-legs (list (list (jitter 0.3) 0 -7) '(0 2.5 -8.5)) 0.8) (run 20))
    (flies (run 40) (fly-legs (list (list (jitter 0.3) 0 -7) '(0 -5 -9)) 0.8))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
