;; Where does the tether lie?  In a current it bows down-current, whatever the way between its ends.
(define-lesson read-the-bow "Read the bow: where is your tether?"
  (grade 1)
  (trains bow)
  (setting within 40 25 15)

  (in (with open-water (current 'still) (minnow (at 0 20 -8))))
  (say "You are the pilot of a small vehicle.  From here its tether is out of sight, and yet where it lies
decides what you can do next.  Six times you will be asked to point at its middle: the compass bearing, in
degrees, from the vehicle (north is 0, east 90).")
  (say "First a look.  The water is still; the anchor A lies south of you.")
  (set-up (settle! #:at-most 120))
  (show)
  (say "The middle of the tether bears ~a from you." (bearing-to (point-at (/ (tether-length) 2))))

  (say "Now a current sets to the east, a quarter of a metre a second.  Watch what it does.")
  (set-up (current! 0.25 90) (settle! #:at-most 200))
  (show)
  (say "The bow lies down-current: the middle bears ~a now.  It is the water alone that chose the side."
       (bearing-to (point-at (/ (tether-length) 2))))

  (in (with open-water (current 0.25 (+ 270 (jitter 10))) (minnow (at 0 20 -8))))
  (set-up (settle! #:at-most 200))
  (say "No more pictures.  Anchor to the south of you, ~a m away; ~a m out; the current sets to ~a."
       (straight-distance) (tether-length) (bearing-of-set))
  (probe "Bearing to the middle of your tether?" (bearing-to (point-at (/ (tether-length) 2)))
         #:within (setting 'within))
  (probe "On which side of the straight line to the anchor is it, as you look at the anchor?"
         (side-of-the-bow) #:choices (left right))

  (in (with open-water (current 0.5 (+ 45 (jitter 10))) (minnow (at 14 14 -8) (heading 45))))
  (set-up (settle! #:at-most 200))
  (say "Anchor to the south-west, ~a m away; ~a m out; the current sets to ~a." (straight-distance)
       (tether-length) (bearing-of-set))
  (probe "Bearing to the middle of your tether?" (bearing-to (point-at (/ (tether-length) 2)))
         #:within (setting 'within))

  (in (with open-water (current 0.25 (+ 315 (jitter 10))) (minnow (at 15 0 -8) (heading 90))))
  (set-up (settle! #:at-most 200))
  (say "Anchor to the west, ~a m away; ~a m out; the current sets to ~a." (straight-distance)
       (tether-length) (bearing-of-set))
  (probe "Bearing to the middle of your tether?" (bearing-to (point-at (/ (tether-length) 2)))
         #:within (setting 'within))
  (probe "On which side of the straight line to the anchor is it, as you look at the anchor?"
         (side-of-the-bow) #:choices (left right))
  (say "So it was, with the anchor A and you:")
  (show)

  (in (with open-water (current 0.5 (+ 180 (jitter 10))) (minnow (at -14 -10 -8) (heading 180))))
  (set-up (settle! #:at-most 200))
  (say "Anchor to the north-east, ~a m away; ~a m out; the current sets to ~a." (straight-distance)
       (tether-length) (bearing-of-set))
  (probe "Bearing to the middle of your tether?" (bearing-to (point-at (/ (tether-length) 2)))
         #:within (setting 'within))

  (say "Last, use it.  Where the bow is, a tether leads sideways from you, and pulls so.")
  (task "Fly to within a metre of the middle of your own tether, and see it."
        (done-when (< (range-to (point-at (/ (tether-length) 2))) 1))
        (hint-after 30 "Turn toward the bow, down-current of the line to the anchor, and go ahead: it lies
about half way, to that side.")
        (hint-after 60 "The map shows your tether where there is room for it: z.  Its middle is where the bow is widest."
                    "(bearing-to (point-at (/ (tether-length) 2))) is the bearing; (fly-to! P) flies there.")
        (at-most 180))

  (pilot expert "Knows that the water chooses the side."
    (answers (truth choices) (if choices truth (+ truth (jitter 8))))
    (flies (let follow () (fly-to! (point-at (/ (tether-length) 2)) #:speed 0.5) (run 1) (follow))))
  (pilot ordinary "Right about the side, vague about how far."
    (answers (truth choices) (if choices truth (+ truth (jitter 45))))
    (flies (run 20) (let follow () (fly-to! (point-at (/ (tether-length) 2)) #:speed 0.3) (run 4) (follow))))
  (pilot careless "Thinks that a tether is a straight line."
    (answers (truth choices) (if choices (if (> (jitter 1) 0) 'left 'right) (bearing-to (point-at 0))))
    (flies (fly-to! (point-at 0) #:speed 0.3))))

(define (bearing-of-set)
  ;; Where the current at the vehicle goes, compass degrees.
  (let ((c (current-at (rov-position))))
    (bearing-to (vec+ (rov-position) (vec (x c) (y c) 0)))))

(define (side-of-the-bow)
  ;; The side of the line from the vehicle to the anchor on which the middle of the tether lies.
  (let* ((here (rov-position))
         (way (vec- (point-at 0) here))
         (off (vec- (point-at (/ (tether-length) 2)) here)))
    (if (> (- (* (x way) (y off)) (* (y way) (x off))) 0) 'left 'right)))
