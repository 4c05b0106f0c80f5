;; Wrap the tether on purpose, feel it, say it, and take it off again without pulling.
(define-lesson wrong-side "The wrong side, on purpose"
  (grade 2)
  (trains unwrapping crew)
  (needs route)
  (setting set 0.15 0.25 0.3)
  (in (with pile (current (setting 'set) (+ 90 (jitter 15)))))
  (say "Sooner or later you will be on the wrong side of something.  Today on purpose: go once round the
pile, and notice when your tether begins to bend round it.")
  (show)
  (task "Go all the way round the pile, clockwise as seen from above, and back to the start.  As soon as the
tether bends round it by a quarter turn, tell the tender so: t, and then wrapped."
        (target "start" '(6 -6 -5))
        (done-when (and (note-bend!) (= 1 (winding 'p1)) (pair? (messages)) (< (range-to '(6 -6 -5)) 2)))
        (hint-after 60 "From the south go west of the pile, then north, east, and home.")
        (hint-after 120 "Have you told the tender that it is wrapped?  t, and then the word."
                    "(tell! 'tender \"wrapped\")")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (fork-and-show "Watch what happens if you pull now."
    (fly-to! '(14 -12 -5)) (run 40))
  (say "The pull ends at the pile: what is wound locks, the harder the more you pull.  ~a N."
       (what-if (fly-to! '(14 -12 -5)) (run 40) (max-tension)))
  (probe "Which way must you go round the pile to take the turn off, as seen from above?"
         (if (> (winding 'p1) 0) 'anticlockwise 'clockwise) #:choices (clockwise anticlockwise))
  (task "Take the turn off and come home to within 2 m, without ever pulling hard."
        (target "home" '(6 -6 -5))
        (done-when (and (= 0 (winding 'p1)) (< (abs (turns 'p1)) 0.4) (< (range-to '(6 -6 -5)) 2)))
        (hint-after 60 "Retrace your way: east, north, west, south of the pile, and slack behind you.")
        (hint-after 120 "What is wound must go to no: watch it."
                    "(turns 'p1) must go to 0.")
        (fail-when (> (max-tension) 400) "You pulled with more than 400 N: the tether is damaged.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 300))
  (tender "Does not haul, whatever happens, while there is a turn round the pile."
    (run 1))
  (score ((seconds-till-told) 0 20 #:by end #:over 60 #:weight 3
          #:as "from bent to told, s" #:why "The tender must know before he hauls, not after.")
         (max-tension 0 100 #:by most #:over 200 #:weight 3
          #:why "What is wound locks, the harder the more you pull.")
         ((abs (winding 'p1)) 0 0 #:by end #:over 1
          #:as "turns left on the pile" #:why "Retrace your way: the turn comes off as it went on."))
  (pilot expert "Goes round well clear, calls at once, retraces."
    (flies (round-calling 4 0.5 3))
    (flies (fly-legs '((4 -3 -5) (5 4 -5) (-5 4 -5) (-5 -5 -5) (6 -6 -5)) 0.4)))
  (pilot ordinary "Calls late, and goes near."
    (flies (round-calling 2 0.5 (+ 45 (jitter 10))))
    (flies (run 20) (fly-legs '((2 -2 -5) (2 2 -5) (-2 2 -5) (-2 -3 -5) (6 -6 -5)) 0.4)))
  (pilot careless "Calls when he is home, goes on the same way round, and then pulls."
    (answers (truth choices) 'clockwise)
    (flies (round-calling 2 0.6 (+ 90 (jitter 5))))
    (flies (fly-legs '((-3 -4 -5) (-3 3 -5) (3 3 -5) (14 -12 -5)) 0.8))))

(define (note-bend!)
  ;; Remember when the tether first bent round the pile, and when that was told.
  (if (and (= 0 (counter 'bent)) (> (turns 'p1) 0.25))
      (begin (count! 'bent) (count! 'bent-at (now))))
  (if (and (= 0 (counter 'told)) (pair? (messages)))
      (begin (count! 'told) (count! 'told-at (now))))
  #t)

(define (seconds-till-told)
  (if (= 0 (counter 'bent))
      (if (= 0 (counter 'told)) 0 100)  ; told before it was so
      (- (if (= 0 (counter 'told)) (now) (counter 'told-at)) (counter 'bent-at))))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))

(define (round-calling r speed delay)
  ;; Once round the pile R metres away, telling the tender DELAY seconds after the tether has bent.
  (every 1 (call-after delay))
  (fly-legs (list (list (- r) -5 -5) (list (- r) r -5) (list r r -5) (list r -3 -5) '(6 -6 -5)) speed))

(define (call-after delay)
  (if (and (= 1 (counter 'bent)) (= 0 (counter 'told)) (null? (messages))
           (> (- (now) (counter 'bent-at)) delay))
      (tell! 'tender "wrapped")))
