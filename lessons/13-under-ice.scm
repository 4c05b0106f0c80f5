;; Under ice there is one hole: go out beside the tether by which you came in.
(define-lesson under-ice "Under ice: out beside your tether"
  (grade 3)
  (trains route trim)
  (needs route trim)
  (setting set 0.03 0.06 0.1)
  (say "Two metres of ice, keels four metres deep, and one hole.  You go 45 m in, under two keels, to a
mooring, and come out by the same way.  A line that floats lies against the ice and behind the
keels; one that sinks drags over the bottom and what lies there.")
  (probe "How is your line trimmed for this: light, neutral or heavy?" 'neutral
         #:choices (light neutral heavy))
  (branch ((eq? 'light (last-answer))
           (in (with under-ice (current (setting 'set) (+ 60 (jitter 15))) (line (wet-weight -0.3))))
           (say "It floats, then."))
          ((eq? 'heavy (last-answer))
           (in (with under-ice (current (setting 'set) (+ 60 (jitter 15))) (line (wet-weight 0.5))))
           (say "It sinks, then."))
          (else
           (in (with under-ice (current (setting 'set) (+ 60 (jitter 15)))))
           (say "Small floats along it take its weight in the sea: it does neither.")))
  (show)
  (task "In to the mooring: to within 1.5 m of (4 45 -8), and look at it for five seconds."
        (target "mooring" '(4 45 -8))
        (done-when (< (range-to '(4 45 -8)) 1.5))
        (held-for 5)
        (hint-after 30 "Under the keels, 7 to 8 m deep, and straight."
                    "(fly-to! '(4 45 -8) #:speed 0.4)")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (probe "Which way does your tether leave you?  Its bearing." (bearing-to (point-at (- (tether-length) 5)))
         #:within 25)
  (task "Out again by the way you came, to within 1.5 m of the place below the hole."
        (target "hole" '(0 1 -6))
        (done-when (< (range-to '(0 1 -6)) 1.5))
        (hint-after 60 "Beside your tether, four metres at a time: where it lies, there you came."
                    "(point-at (- (tether-length) 4)) is on it, and again from there.")
        (hint-after 120 "The current has set the bow of it aside: the way in was straight from the hole."
                     "(off-the-way 1) is how far you are from the way you came in.")
        (fail-when (parted?) "The tether has parted.")
        (at-most 240))
  (tender "Gives and takes a metre at a time, so that little is loose."
    (let tend ()
      (cond ((or (< (loose) (+ 1 (* 0.06 (tether-length)))) (taut?)) (pay-out! 1 #:rate 1))
            ((and (> (loose) (+ 2 (* 0.1 (tether-length)))) (> (tether-length) 5)) (haul-in! 1 #:rate 1)))
      (run 1)
      (tend)))
  (score ((off-the-way 1) 0 2 #:by rms #:over 4 #:weight 4
          #:as "off the way in, m" #:why "Where your tether lies, there you came: out beside it.")
         ((null? (contacts)) 1 1 #:share 0.95 #:weight 4
          #:as "tether on nothing"
          #:why "A line that floats lies against the ice, one that sinks on the bottom: trim it neutral.")
         ((* 100 (/ (contact-length) (tether-length))) 0 5 #:by most #:over 20
          #:as "tether on something, %" #:why "What lies along ice or bed is held by it.")
         (rov-clearance 1 +inf.0 #:by least #:over 1 #:weight 2
          #:why "Keels reach 4 m down: pass under them at 7 to 8 m.")
         (max-tension 0 60 #:by most #:over 60
          #:why "Never pull: there is one hole, and your tether leads to it."))
  (pilot expert "Neutral, straight in, and out beside it."
    (answers (truth choices) truth)
    (flies (fly-legs '((2 20 -8) (4 45 -8)) 0.5))
    (flies (fly-legs '((2 20 -8) (0 1 -6)) 0.5)))
  (pilot ordinary "Neutral, but he takes another way out, and near the keels."
    (answers (truth choices) (if choices truth (+ truth 40)))
    (flies (fly-legs '((1 20 -6) (4 45 -8)) 0.5))
    (flies (run 10) (fly-legs (list (list (+ 9 (jitter 1)) 30 -5.1) (list (+ 6 (jitter 1)) 10 -5) '(0 1 -6)) 0.4)))
  (pilot careless "Light, because it is easy to pull, up to the ice to look at it, and home at large."
    (answers (truth choices) (if choices 'light 90))
    (flies (fly-legs '((0 18 -6) (4 45 -8)) 0.6))
    (flies (fly-legs (list (list (+ 16 (jitter 2)) 30 -3.2) '(18 20 -6) '(14 4 -3) '(0 1 -6)) 0.7))))

(define (loose) (* (slack) (tether-length)))

(define (fly-legs points speed)
  (for-each (lambda (p) (fly-to! p #:speed speed) (run-until arrived? #:at-most 90)) points))
