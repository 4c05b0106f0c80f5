;; A lesson to copy: change the names, the words and the numbers, and prove it with
;;   bight lesson --check template.scm
;;
;; One sentence here says what the lesson teaches, and which rule it comes from.
(define-lesson template "What the list of lessons calls it"
  ;; Where it stands on the path of lessons: from 1 for beginners to 4, and what it trains and needs.
  (grade 1)
  (trains slack)
  (needs bow)

  ;; A number that depends on the difficulty: easy, normal, hard.  (setting 'set) is its value.
  (setting set 0.1 0.2 0.3)

  ;; Where it takes place: a world of bight's, or one defined in this file.  (jitter 10) is a number from
  ;; -10 to 10 that depends on the seed alone.
  (in (with open-water (current (setting 'set) (+ 90 (jitter 10)))))

  ;; What the pupil reads; ~a stands for the values that follow.
  (say "The anchor is ~a m away." (straight-distance))
  (show)

  ;; What may not happen to him, shown on a copy of the dive.
  (fork-and-show "Watch what happens to one who forgets his tether."
    (fly-to! '(0 40 -8) #:speed 0.8) (run 60))

  ;; A question, its truth, and how near is near enough; or #:choices (left right).
  (probe "Bearing to the middle of your tether?" (bearing-to (point-at (/ (tether-length) 2))) #:within 25)

  ;; What to do: targets are shown with distance, bearing and depth.  Hints come by themselves, or when e is pressed;
  ;; their forms are for who types.  at-most is in seconds of the dive.
  (task "Fly to within a metre of the work."
        (target "work" '(8 18 -8))
        (done-when (< (range-to '(8 18 -8)) 1))
        (hint-after 20 "Turn toward it, go ahead, and sink as you come."
                    "(fly-to! '(8 18 -8) #:speed 0.4) flies there.")
        (fail-when (taut?) "Your tether came taut.")
        (at-most 120))

  ;; A clause can depend on how it went.
  (branch ((> (counter 'loose) 0) (say "Your tether was very loose on the way."))
          (else (say "You kept your tether in hand.")))

  ;; A counter goes up each time its expression becomes true.
  (count loose (> (slack) 0.6))

  ;; Marks: a measure, and the band it should be in; by the share of the time (as here), or by its value
  ;; at the end, or the most, least or mean.
  ;; #:as names the mark, and #:why tells who lost it what he should have known.
  (score (slack 0.05 0.5 #:share 0.8 #:as "share that is slack" #:why "Too little holds you, too much drifts.")
         (max-tension 0 50 #:by most))

  ;; Who shows it.  `answers' are to probes, each `flies' is for one task.
  (pilot expert "Knows where his tether is."
    (answers (truth choices) truth)
    (flies (fly-to! '(8 18 -8) #:speed 0.4)))
  (pilot ordinary "Nearly."
    (answers (truth choices) (+ truth 40))
    (flies (run 10) (fly-to! '(8 18 -8) #:speed 0.3)))
  (pilot careless "Flies off without a thought."
    (answers (truth choices) 0)
    (flies (drive! #:surge 1) (run 30))))
