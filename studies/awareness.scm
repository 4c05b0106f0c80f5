;; What bight says of a tether, held against what then happens, as `bight sweep awareness' flies it: among
;; six piles, inside and about a jacket, through rings, over boxes and balls, about a wreck, each drawn by
;; its seed.  A pilot flies eight random points, the winch following; obstacles and tether stop him where
;; they do.  From where he ends, each on a fork of its own:
;;
;;   haul      the vehicle is dead and is hauled, as one would in the dive; beside it what `free-to-haul?' and
;;             `haul-prospect' had said
;;   home      `fly-home!', which tries on forks before it flies; beside it, `retraced', the `way-home' of
;;             the string alone, the winch taking in what gets slack
;;   unwound   he flies `unwind-plan', if its preview says that it frees; `unwound-quick' by the preview of
;;             the string alone
;;   touch, bump, taut   he carries on with his sticks as they are; beside it what `foresee' had said, with
;;             #:quick, of the first that the tether touches, that he meets, and of when it is taut; `sure'
;;             is whether `foresee' without it told all three
;;
;; Seeds up to 100 have been used to mend bight; those of the study have not.
;;
;;   bight sweep awareness -o awareness.db                (200 dives; --shard 1/4 flies 50 of them)
;;   bight sweep --table awareness.db --by scene

(use-modules ((srfi srfi-1) #:select (append-map filter find first second third fourth iota))
             ((bight assembly) #:select (data->part)))

;;; Scenes, in 24 m by 24 m of water 14 m deep.

(define depth 14)

(define (from-to low high)
  (+ low (* (random 1.0) (- high low))))

(define (named kind i)
  `(named ,(string->symbol (simple-format #f "~a-~a" kind i))))

(define (somewhere)
  (list (from-to -8 8) (from-to -8 8) (from-to -11 -3)))

(define (a-pile i)
  (let ((x (from-to -7 7)) (y (from-to -7 7)))
    `(cylinder ,(named 'pile i) (from ,x ,y 1) (to ,x ,y ,(- depth)) (radius ,(from-to 0.2 0.6)))))

(define (a-ring i)
  ;; Twelve bars about any axis.
  (let* ((centre (somewhere))
         (radius (from-to 1.5 2.5))
         (turn (from-to 0 6.28)) (lean (from-to 0 3.14))
         (u (list (cos turn) (sin turn) 0))
         (v (list (- (* (sin turn) (cos lean))) (* (cos turn) (cos lean)) (sin lean)))
         (at (lambda (k)
               (let ((c (* radius (cos (* k 0.5236)))) (s (* radius (sin (* k 0.5236)))))
                 (map (lambda (o a b) (+ o (* c a) (* s b))) centre u v)))))
    (map (lambda (k)
           `(capsule ,(named (simple-format #f "ring-~a" i) k) (from ,@(at k)) (to ,@(at (+ k 1)))
                     (radius 0.12)))
         (iota 12))))

(define (a-box i)
  (let ((height (from-to 1 7)))
    `(box ,(named 'box i) (at ,(from-to -7 7) ,(from-to -7 7) ,(- (/ height 2) depth))
          (size ,(from-to 1 4) ,(from-to 1 4) ,height) (heading ,(from-to 0 90)))))

(define (a-ball i)
  `(sphere ,(named 'ball i) (at ,@(somewhere)) (radius ,(from-to 0.5 1.5))))

(define (things scene)
  (case scene
    ((piles) (map data->part (map a-pile (iota 6 1))))
    ((rings) (map data->part (append-map a-ring (iota 4 1))))
    ((boxes) (map data->part (append (map a-box (iota 6 1)) (map a-ball (iota 3 1)))))
    ((jacket) (make-jacket #:depth depth #:spacing 9 #:bays 2 #:top 1 #:heading (random 90)
                           #:leg-radius (from-to 0.3 0.5) #:brace-radius (from-to 0.15 0.3)))
    ((wreck) (make-wreck #:at (list 0 0 (- depth)) #:heading (random 180) #:length 18 #:beam 5))))

(define (a-world scene)
  (world (sea (depth depth))
         (seabed)
         (splice (things scene))
         (rov (named minnow) (type bluerov2-heavy) (at -11 -10.5 -3))
         (tether (named line) (type fathom) (wet-weight 0) (from -11.5 -11.5 -1) (to minnow) (length 4)
                 (drum 80) (breaking-load 1e5) (nodes 10) (model dynamic))))

;;; The pilot.

(define (tend)
  ;; The winch follows the vehicle: a tenth more out than the tether needs.
  (let ((more (- (* 1.1 (taut-length)) -1 (tether-length))))
    (when (> more 0.1)
      (pay-out! more #:rate 1))))

(define (wander points)
  (let ((winch (every 0.5 (tend))))
    (for-each (lambda (k)
                (let ((there (somewhere)))
                  (unless (> (tether-length) 60)
                    (fly-to! there #:speed 0.6)
                    (run-until arrived? #:at-most (+ 5 (/ (range-to there) 0.5))))))
              (iota points))
    (cancel! winch)))

(define pull 150)
(define rate 0.4)

;;; Hauling.

(define (haul-in-the-dive)
  ;; Does the dead vehicle come home?
  (release!)
  (let loop ((out (tether-length)) (since (now)))
    (cond ((< (straight-distance) 1.9) #t)
          ((> (- (now) since) 30) #f)
          (else
           (haul-in! (if (> (tension-at 0) pull) 0 (max 0 (- (tether-length) 0.5))) #:rate rate)
           (step!)
           (if (< (tether-length) (- out 0.1))
               (loop (tether-length) (now))
               (loop out since))))))

(define (warned? prospect)
  (not (eq? 'clear (second prospect))))

(define (outcome said? true?)
  ;; A word for what was said beside what was true.
  (cond ((and said? true?) 'told)
        (true? 'missed)
        (said? 'false-alarm)
        (else 'quiet)))

;;; Ways.

(define (fly-for seconds)
  ;; Until he is at the anchor, SECONDS at most.
  (let ((start (now)))
    (let loop ()
      (cond ((< (straight-distance) 1) 'arrived)
            ((> (- (now) start) seconds) 'failed)
            (else (run 0.5) (loop))))))

(define (fly-home)
  ;; The way that a fork found to arrive.
  (if (fly-home! #:pull pull)
      (fly-for 900)
      'refused))

(define (take-in)
  ;; The winch takes in what is slack, and leaves the vehicle some for its way round things.
  (let ((spare (- (tether-length) (* 1.05 (taut-length)) 1)) (tension (tension-at 0)))
    (cond ((> tension 30) (pay-out! 0.5 #:rate 1))
          ((and (> spare 0.1) (< tension 15)) (haul-in! spare #:rate 0.4))
          (else (haul-in! 0)))))

(define (retrace)
  ;; The way of the string alone, untried.
  (if (not (assq-ref (way-home-preview) 'feasible?))
      'refused
      (begin
        (every 0.1 (take-in))
        (fly-for (+ 60 (/ (fly-along! (way-home) #:speed 0.35) 0.15))))))

(define (unwind preview)
  (cond ((not (assq-ref preview 'needed?)) 'not-needed)
        ((not (assq-ref preview 'feasible?)) 'refused)
        (else
         (run-until arrived? #:at-most (+ 60 (/ (fly-along! (unwind-plan) #:speed 0.35) 0.15)))
         (if (< (excess) (max 0.5 (* 0.02 (free-length)))) 'freed 'failed))))


;;; What is to come.

(define ahead 40)                       ; s

(define (first-of kind said old)
  ;; (OBJECT SECONDS) of the first foresight of KIND among SAID, not of the objects OLD, or #f.
  (let ((f (find (lambda (f) (and (eq? kind (foresight-kind f)) (not (memq (foresight-object f) old))))
                 said)))
    (and f (list (foresight-object f) (foresight-seconds f)))))

(define (first-event kind subject start old)
  ;; The same of what happened since START, not to the objects OLD.
  (let ((e (find (lambda (e)
                   (and (eq? kind (first e)) (eq? subject (third e))
                        (not (and (pair? (cdddr e)) (memq (fourth e) old)))))
                 (events #:since start))))
    (and e (list (and (pair? (cdddr e)) (fourth e)) (- (second e) start)))))

(define (near? a b)
  ;; Within a factor of two, or two seconds.
  (or (< (abs (- a b)) 2) (< 1/2 (/ a b) 2)))

(define (compare said true)
  (cond ((not (and said true)) (outcome said true))
        ((not (eq? (first said) (first true))) 'other-object)
        ((not (near? (second said) (second true))) 'other-time)
        (else 'told)))

(define (same? a b)
  (or (not (or a b))
      (and a b (eq? (first a) (first b)) (< (abs (- (second a) (second b))) 0.02))))

(define (run-until-taut)
  ;; Carry on; return in how many seconds the tether is taut, or #f.
  (let loop ((k 1) (taut #f))
    (cond ((> (* k 0.5) ahead) taut)
          (else
           (run 0.5)
           (loop (+ k 1) (or taut (and (taut?) (list #f (* k 0.5)))))))))

(define (look-ahead)
  ;; What is said and what then is, of each kind: an alist of words.
  (pay-out! 6 #:rate 6)
  (drive! #:surge (from-to 0.15 0.4) #:sway (from-to -0.2 0.2) #:heave (from-to -0.1 0.1)
          #:yaw (from-to -0.05 0.05))
  (run 4)
  (let* ((start (now))
         (old (cons 'line (map contact-object (contacts)))) ; what it touches of itself is no obstacle
         (string (foresee ahead #:quick #t))
         (sure (filter (lambda (f) (= 1 (foresight-confidence f))) (foresee ahead)))
         (taut (run-until-taut))
         (touch (first-event 'touched 'line start old))
         (bump (first-event 'touched 'minnow start '())))
    (list (cons 'touch (compare (first-of 'touch string old) touch))
          (cons 'bump (compare (first-of 'bump string '()) bump))
          (cons 'taut (compare (first-of 'taut string '()) taut))
          (cons 'sure (and (same? touch (first-of 'touch sure old))
                           (same? bump (first-of 'bump sure '()))
                           (same? taut (first-of 'taut sure '())))))))

(define-study awareness
  "Does what bight says of a tether come true?"
  #:for ((scene (grid 'piles 'jacket 'rings 'boxes 'wreck))
         (seed (range 101 140 1)))
  (at-most 900)
  (in (a-world scene))
  (fly (wander 4))
  (define future (what-if (look-ahead)))
  (fly (wander 4)
       (drive!)
       (release!)
       (run 3))
  (define prospect (haul-prospect #:pull pull))
  (define trial (haul-trial #:pull pull #:rate rate))
  (define forked (assq-ref trial 'home?))
  (define held (what-if (not (haul-in-the-dive))))
  (define home (what-if (fly-home)))
  (define by-string (what-if (retrace)))
  (define plan (what-if (unwind (unwind-preview))))
  (define quick-plan (what-if (unwind (unwind-preview #:quick #t))))
  (measure (haul (if (eq? forked (not held)) 'agrees 'differs))
           (held held)
           (rule (outcome (warned? prospect) held))
           (reason (second prospect))
           (by (cond (forked 'nothing) ((assq-ref trial 'hull?) 'hull) (else 'tether)))
           (home home)
           (retraced by-string)
           (unwound plan)
           (unwound-quick quick-plan)
           (touch (assq-ref future 'touch))
           (bump (assq-ref future 'bump))
           (taut (assq-ref future 'taut))
           (sure (assq-ref future 'sure))
           (out (tether-length))
           (excess (excess))))
