;; Two vehicles at one structure: ask before you cross the other's tether, and uncross as you crossed.
(define-world two-at-a-jacket
  "A jacket with two vehicles from one ship: bravo works on its east side, alfa is to pass beyond."
  (sea     (depth 36) (current 0.1 0))
  (seabed  (friction 0.6))
  (splice  (make-jacket #:depth 36 #:bays 2 #:top 2))
  (rov     (named alfa) (at -3 -15 -8) (heading 90))
  (rov     (named bravo) (at 9.5 0 -8) (heading 270))
  (tether  (named line-alfa) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
           (from -3 -24 -3) (to alfa) (length 12) (drum 120))
  (tether  (named line-bravo) (type fathom) (wet-weight 0) (friction 0.4) (model dynamic)
           (from 9 -24 -3) (to bravo) (length 27) (drum 120)))

(define-lesson two-at-a-jacket "Two vehicles at one jacket"
  (grade 4)
  (trains crew route)
  (needs route crew)
  (yours alfa line-alfa)
  (setting set 0.05 0.1 0.15)
  (in (with two-at-a-jacket (current (setting 'set) (jitter 10))))
  (say "You fly alfa.  Bravo, from the same ship, cleans a node on the east side of the jacket, and its tether
runs from the ship to it, at the depth you see.  Your work is a marker east of that, and bravo's tether lies
between you and it.")
  (say "Two tethers that have crossed twice the same way, over going and under coming, are one rope.  Ask bravo
to hold before you cross: t, and then crossing.  Cross under, well clear, near the ship; come home under again; then tell
him: t, and then clear.")
  (show)
  (probe "You have crossed under bravo's tether.  How do you come home?" 'under #:choices (under over either))
  (task "To the marker: within 1.2 m of it, and look at it for five seconds."
        (target "marker" '(16 -8 -12))
        (done-when (and (note-crossing!) (< (range-to '(16 -8 -12)) 1.2)))
        (held-for 5)
        (hint-after 20 "Tell bravo first: t, and then crossing.  Then down to 13 m, and east under its tether.")
        (fail-when (parted?) "Your tether has parted.")
        (at-most 300))
  (task "Home: within 1.5 m of where you began, uncrossed, and bravo told that you are clear."
        (target "home" '(-3 -15 -8))
        (done-when (and (note-crossing!) (< (range-to '(-3 -15 -8)) 1.5) (= 0 (counter 'twist))
                        (told-of-both?)))
        (hint-after 40 "Under again, where you crossed, and up only when you are west of it.")
        (hint-after 100 "t, and then clear, tells bravo that it may move.")
        (fail-when (parted?) "Your tether has parted.")
        (at-most 260))
  (tender "Bravo's pilot, and the hands at alfa's winch: bravo holds while you cross, if you ask."
    (every 1 (tend-alfa))
    (let work ()
      (let ((message (told 'tender)))
        (cond ((and message (string-prefix? "crossing" message))
               (count! 'holds) (hold-position! 'bravo) (tell! 'pilot "Bravo holds."))
              ((and message (string-prefix? "clear" message))
               (count! 'holds -1) (tell! 'pilot "Bravo goes on."))
              (message (tell! 'pilot "Bravo: say again?"))))
      (if (< (counter 'holds) 1)
          (fly-to! 'bravo (if (odd? (quotient (inexact->exact (floor (now))) 20)) '(9.5 -12 -9) '(9.5 0 -8))
                   #:speed 0.3))
      (run 1)
      (work)))
  (score ((null? (contacts)) 1 1 #:share 0.95 #:weight 3
          #:as "tether on nothing"
          #:why "Neither steel nor the other's tether: pass under with metres to spare.")
         ((counter 'unasked) 0 0 #:by end #:over 1 #:weight 3
          #:as "crossings unasked"
          #:why "He cannot see you.  A pilot who does not know that you are below him moves.")
         ((abs (counter 'twist)) 0 0 #:by end #:over 1 #:weight 3
          #:as "tethers crossed" #:why "Under going, under coming.")
         ((distance (rov-position) (rov-position 'bravo)) 4 +inf.0 #:by least #:over 4 #:weight 2
          #:as "room between vehicles, m"
          #:why "Four metres: thrusters throw a tether farther than one thinks."))
  (pilot expert "Asks, crosses under near the ship, comes home the same way, and says so."
    (answers (truth choices) truth)
    (flies (tell! 'tender "crossing") (run 2) (fly-legs '((2 -17 -13) (14 -16 -13) (16 -8 -12)) 0.5))
    (flies (fly-legs '((14 -16 -13) (2 -17 -13) (-3 -15 -8)) 0.5) (tell! 'tender "clear") (run 5)))
  (pilot ordinary "Asks late, and passes close."
    (answers (truth choices) truth)
    (flies (fly-legs (list (list 12 -10 (+ -10.5 (jitter 0.2)))) 0.4) (tell! 'tender "crossing")
           (fly-legs '((16 -8 -12)) 0.35))
    (flies (run 10) (fly-legs (list (list 12 -10 (+ -10.5 (jitter 0.2))) '(2 -15 -10) '(-3 -15 -8)) 0.35)
           (run 10) (tell! 'tender "clear")))
  (pilot careless "Says nothing, goes under, and comes home over."
    (answers (truth choices) 'either)
    (flies (fly-legs (list (list 9 (+ -13 (jitter 0.5)) -11) '(16 -8 -12)) 0.6))
    (flies (fly-legs '((14 -10 -4) (4 -13 -3) (-3 -15 -8)) 0.6) (tell! 'tender "clear"))))

(define (tend-alfa)
  (let ((loose (* (slack) (tether-length))))
    (cond ((or (< loose 1.5) (taut?)) (pay-out! 'line-alfa 1 #:rate 0.9))
          ((and (> loose 3.5) (> (tether-length) 11)) (haul-in! 'line-alfa 1 #:rate 0.8)))))

(define (east-of-bravo?)
  ;; On which side of bravo's tether alfa is, seen from above.
  (let* ((a (point-at 'line-bravo 0)) (b (rov-position 'bravo)) (p (rov-position)))
    (< (- (* (- (x b) (x a)) (- (y p) (y a))) (* (- (y b) (y a)) (- (x p) (x a)))) 0)))

(define (below-bravo?)
  ;; Below the line from bravo's winch to bravo, abreast of alfa.
  (let* ((a (point-at 'line-bravo 0)) (b (rov-position 'bravo)) (p (rov-position))
         (s (max 0 (min 1 (/ (- (y p) (y a)) (- (y b) (y a)))))))
    (< (z p) (+ (z a) (* s (- (z b) (z a)))))))

(define (note-crossing!)
  ;; Under to the east adds one, under to the west takes one off; over does neither the one nor the other, but
  ;; its opposite.
  (if (not (eq? (east-of-bravo?) (= 1 (counter 'east))))
      (let ((way (if (east-of-bravo?) 1 -1)))
        (count! 'east way)
        (if (< (counter 'holds) 1) (count! 'unasked))
        (count! 'twist (if (below-bravo?) way 0))))
  #t)

(define (told-of-both?)
  (and (>= (length (filter (lambda (m) (eq? 'tender (car m))) (messages))) 2) (< (counter 'holds) 1)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
