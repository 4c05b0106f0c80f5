;; Out round a pile and back by the same side: what goes round must come back round.
(define-lesson one-pile "One pile, out and back"
  (setting set 0.05 0.15 0.25)
  (in (with pile (current (setting 'set) (+ 90 (jitter 20)))))
  (say "There is one pile here, and there is work on the far side of it.  Every time you go round a pile
your tether goes round it too, and what is wound does not come off by pulling.")
  (show)
  (task "Fly to the far side: 5 m north of the pile, within a metre of (0 5 -5)."
        (done-when (< (range-to '(0 5 -5)) 1))
        (hint-after 60 "Choose a side and keep it: (fly-to! '(4 0 -5)), then (fly-to! '(0 5 -5)).")
        (at-most 180))
  (probe "On which side of the pile, seen from above, does your tether pass it?"
         (if (> (x (point-nearest-pile)) 0) 'east 'west) #:choices (east west))
  (task "Come home to (6 -6 -5), with no turn round the pile."
        (done-when (and (< (range-to '(6 -6 -5)) 1) (= 0 (winding 'p1)) (< (wrap-angle 'p1) 60)))
        (hint-after 60 "Go back the way you came: the same side, along your tether.")
        (hint-after 120 "(winding 'p1) tells how often the tether goes round the pile: + is clockwise.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (score ((wrap-angle 'p1) 0 60 #:by end #:over 180))
  (pilot expert "Out and back on the east."
    (flies (fly-to! '(5 0 -5) #:speed 0.4) (run-until arrived?) (fly-to! '(0 5 -5) #:speed 0.4) (run-until arrived?))
    (flies (fly-to! '(5 0 -5) #:speed 0.4) (run-until arrived?) (fly-to! '(6 -6 -5) #:speed 0.4) (run-until arrived?))))
