;;; (bight bench tours) --- `bight bench tours': do tours bring the vehicle home, of which length, and how soon are they planned?
;;;
;;; In each world some obstacles are looked at.  Five tours visit the same points about them:
;;; `plan', as `plan-tour' finds it; `held', as it finds it within a limit of risk by a belief, which may leave places out;
;;; `greedy', the same legs, always to the nearest place left; `blind', the shortest tour
;;; of a vehicle that drags nothing; and `bounded', the shortest of the blind ones on which the tether drawn tight is never
;;; longer than a tenth more than `plan' takes of it, the idea of REACT (Amer et al., arXiv 2507.10204, 2025), by search
;;; over all orders.  Each is
;;; flown to its end, the leg home with it, in every truth that is drawn from a belief: it counts as home where all
;;; places were reached, the vehicle is at its anchor, and the tether is not fouled.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench tours)
  #:use-module ((bight assembly) #:select (data->part))
  #:use-module (bight belief)
  #:use-module (bight belief cloud)
  #:use-module (bight belief tour)
  #:use-module (bight bench in-time)
  #:use-module (bight bench options)
  #:use-module (bight core errors)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (fouled?))
  #:use-module ((bight dive homing) #:select (home-of untold-fork))
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight dive tour)
  #:use-module (bight dive tour-flight)
  #:use-module (bight dive tour-order)
  #:use-module (bight engine)
  #:use-module (bight world)
  #:use-module ((bight world build) #:select (make-pipeline))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (run-tours))

(define help "bight bench tours: how often tours come home, how long they are, how soon they are planned
  --truths N    drawn from a belief, in which each tour is flown, 200 when left out, 2 with --quick
  --world W     one alone of jacket, piles, pier, wreck, cage and pipeline; cage alone with --quick
  --tours NAMES which of plan, held, greedy, blind and bounded are flown, with commas between; all when left out
  --places N    how many obstacles are looked at, 2 to 8; 5 when left out, 2 with --quick
  --nodes N     of the tether that is flown, 16 when left out
  --tethers N   of the belief that `held' is planned by, 8 to 256; 16 when left out, 8 with --quick
  --risk P      that `held' is planned within, 0.05 when left out
  --error E     of the current, m/s, 0.1 when left out
  --pull F      N, the most that the vehicle pulls with, 100 when left out
  --minutes M   M minutes by the clock for all worlds: in each as many truths as fit
")

(define valued '("--truths" "--world" "--tours" "--places" "--nodes" "--tethers" "--risk" "--error" "--pull" "--minutes"))
(define flags '("--quick" "--help"))



;;; The worlds: those of the catalogue with a kinematic vehicle and a line of few nodes, and two more.

(define piles
  (world (sea (depth 15) (current 0.25 90))
         (seabed (friction 0.6))
         (splice (map (lambda (x y i)
                        (data->part `(cylinder (named ,(string->symbol (simple-format #f "pile-~a" i)))
                                               (from ,x ,y 1) (to ,x ,y -15) (radius 0.4))))
                      '(-5 0 5 -3 3 8) '(0 2 -1 7 8 5) (iota 6 1)))
         (rov (named minnow) (at -6 -8 -5) (heading 0))
         (tether (named line) (from -8 -12 -2) (to minnow) (length 45))))

(define pipeline
  (world (sea (depth 30) (current 0.25 90))
         (seabed (friction 0.6))
         (splice (make-pipeline #:at '(0 0 -30) #:length 40 #:radius 0.3 #:span 1.2 #:supports 5))
         (rov (named minnow) (at -6 -5 -24) (heading 0))
         (tether (named line) (from -8 -5 -16) (to minnow) (length 45))))

(define (world-of name)
  (case name
    ((piles) piles)
    ((pipeline) pipeline)
    (else (find-world name))))

(define world-names '(jacket piles pier wreck cage pipeline))

(define (field-of world head name)
  (assq-ref (part-all-fields (find (lambda (part) (eq? head (part-head part))) (world-parts world))) name))

(define (bare world) (without (without world 'line) 'minnow))

(define (with-line world at line pull)
  ;; WORLD with a vehicle AT a place, which pulls with PULL N at most, and the tether that the clauses LINE make.
  (extend (bare world)
          (splice (list (data->part `(rov (named minnow) (type kinematic) (at ,@at) (heading 0) (pull ,pull)))
                        (data->part `(tether (named line) (type fathom) (wet-weight 0) (to minnow) ,@line))))))

(define usual-pull 100)                 ; N, as of a vehicle of which nobody says it

(define* (flown-world world nodes #:optional (pull usual-pull))
  (with-line world (f64vector->list (field-of world 'rov 'at))
             `((friction 0.5) (model dynamic) (nodes ,nodes) (from ,@(f64vector->list (field-of world 'tether 'from)))
               (length ,(field-of world 'tether 'length)))
             pull))

(define (anchored-world world from at via length)
  ;; The same with an anchor at FROM and a line of LENGTH by VIA to the vehicle, which is AT.
  (with-line world at
             `((model rubber-band) (from ,@from) (length ,length) ,@(if (null? via) '() `((via ,@via))))
             usual-pull))

(define (doubts error)
  `((current (error ,error))
    (line (cdn (uniform 1 1.6)) (wet-weight (normal 0 0.03)))
    (payout (normal 0 0.2))))

(define planning-seed 11)
(define truths-seed 7)


;;; What is looked at: obstacles evenly out of all, and of a pipeline places on either side of it.

(define (beside-the-pipe n)
  (map (lambda (i) (list (if (even? i) 1.5 -1.5) (- (* 24 (/ (+ i 1/2) n)) 12) -28.5)) (iota n)))

(define (looked-at name n)
  (if (eq? 'pipeline name) (beside-the-pipe n) (some-obstacles n)))

(define (some-obstacles n)
  (let* ((all (remove (lambda (name) (memq name '(seabed bed))) (%names (engine-of (current-dive)) 'obstacle)))
         (k (length all)))
    (delete-duplicates (map (lambda (i) (list-ref all (quotient (* k (+ 1 (* 2 i))) (* 2 n)))) (iota (min n k))))))


;;; Ways of a vehicle that drags nothing.

(define (asker-without-tether world places)
  ;; A procedure of two of PLACES, lists, that returns (LENGTH . POINTS) of the shortest way between them.
  (let ((known (make-hash-table)))
    (lambda (from to)
      (or (hash-ref known (cons from to))
          (let ((way (way-between world from to)))
            (hash-set! known (cons from to) way)
            way)))))

(define (way-between world from to)
  (parameterize ((current-dive #f))
    (enter! (anchored-world world from (map + from '(0 0 0.01)) '() 200))
    (let* ((v (%leg (engine-of (current-dive)) 0 #f (list->f64vector to))) (points (vector-ref v 0)))
      (unless points
        (bight-raise 'unsupported 'bench "no way is known from ~a to ~a" from to))
      (cons (vector-ref v 3) (map list->f64vector (array->list points))))))


;;; The five tours, each (NAME SECONDS TOUR).

(define (clock) (/ (get-internal-run-time) (exact->inexact internal-time-units-per-second)))

(define speed 0.5)                      ; m/s, of all flights

(define (timed name thunk)
  (let* ((begun (clock)) (tour (thunk)))
    (list name (- (clock) begun) tour)))

(define (along stops legs line)
  ;; LEGS are (LENGTH . POINTS), the last home.
  (tour-along 'line 'minnow stops (map cdr legs) (apply + (map car legs)) line))

(define (legs-of ask start stops home)
  (map ask (cons start stops) (append stops (list home))))

(define (greedy-order cost start stops)
  (if (null? stops)
      '()
      (let ((next (fold (lambda (s best) (if (< (cost start s) (cost start best)) s best)) (car stops) (cdr stops))))
        (cons next (greedy-order cost next (delete next stops))))))

(define (shortest-order cost start stops home)
  (let* ((all (list->vector stops)) (n (vector-length all))
         (at (lambda (i) (cond ((= i -1) start) ((= i n) home) (else (vector-ref all i))))))
    (map at (best-order n (lambda (i j) (cost (at i) (at j)))))))

(define (all-orders stops)
  (if (null? stops)
      '(())
      (append-map (lambda (s) (map (lambda (rest) (cons s rest)) (all-orders (delete s stops)))) stops)))

;; Legs keep farther than this from what stands there, m.
(define tolerance 0.1)

(define (off-line p a b)
  ;; How far P is from the segment from A to B, m.
  (let* ((dot (lambda (u v) (apply + (map * u v)))) (along (map - b a)) (off (map - p a)) (square (dot along along))
         (k (if (zero? square) 0 (max 0 (min 1 (/ (dot off along) square)))))
         (left (map (lambda (o d) (- o (* k d))) off along)))
    (sqrt (dot left left))))

(define (thinned path)
  ;; PATH, at most `tolerance' off, with fewer points (U. Ramer, Computer Graphics and Image Processing 1, 1972).
  (if (< (length path) 3)
      path
      (let* ((off (map (lambda (p) (off-line p (first path) (last path))) path)) (most (apply max off))
             (k (list-index (lambda (d) (= d most)) off)))
        (if (< most tolerance)
            (list (first path) (last path))
            (append (drop-right (thinned (list-head path (+ k 1))) 1) (thinned (list-tail path k)))))))

(define (taut-along world home start legs)
  ;; The length of the tether drawn tight after it was led from its beginning along LEGS, m.
  (parameterize ((current-dive #f))
    (let* ((path (append-map (lambda (leg) (map f64vector->list (cdr leg))) legs))
           (end (last path)))
      (enter! (anchored-world world home end (drop-right (cdr (thinned (cons* home start path))) 1) 1000))
      (taut-length 'line))))

(define (within-bound? world home start legs line)
  ;; Looked at after each leg but the last, at whose end the vehicle is where its tether begins.
  (every (lambda (k) (<= (taut-along world home start (list-head legs k)) line))
         (iota (- (length legs) 1) 1)))

(define (bounded-order world ask start stops home line)
  ;; The shortest of all orders that keeps within LINE metres, or the shortest of all where none does.
  (let* ((tours (map (lambda (order) (cons order (legs-of ask start order home))) (all-orders stops)))
         (long (lambda (tour) (apply + (map car (cdr tour)))))
         (sorted (sort tours (lambda (a b) (< (long a) (long b)))))
         (fits (find (lambda (tour) (within-bound? world home start (cdr tour) line)) sorted)))
    (or fits (car sorted))))

(define (tours world name n clauses tethers risk wanted)
  ;; The WANTED ones, names, of the present dive, in WORLD called NAME, and `blind'.  CLAUSES say what is uncertain to the
  ;; belief of TETHERS tethers by which the tour within RISK is planned.
  (let* ((line (tether-length)) (start (f64vector->list (rov-position))) (home (f64vector->list (point-at 0)))
         (plan (timed 'plan (lambda () (plan-tour (looked-at name n) #:line line))))
         (stops (map f64vector->list (tour-places (third plan))))
         (ask (asker-without-tether world (cons* start home stops)))
         (cost (lambda (a b) (car (ask a b)))))
    (define (make which)
      (case which
        ((plan) plan)
        ((held) (timed 'held (lambda ()
                               (with-belief (make-belief (current-dive) clauses #:members tethers #:seed planning-seed)
                                 (plan-tour (looked-at name n) #:line line #:risk risk #:speed speed)))))
        ((greedy) (timed 'greedy (lambda () (tour-in-order (third plan) (greedy-order (leg-cost (third plan)) start stops)))))
        ((blind) (timed 'blind (lambda ()
                                 (let ((order (shortest-order cost start stops home)))
                                   (along order (legs-of ask start order home) line)))))
        ((bounded) (timed 'bounded (lambda ()
                                     (let ((found (bounded-order world ask start stops home
                                                                 (* 1.1 (tour-line-needed (third plan))))))
                                       (along (car found) (cdr found) line)))))))
    (map make (lset-union eq? wanted '(blind)))))

(define (leg-cost tour)
  ;; The length of the leg of a tether between two places, or from where the vehicle is.
  (let ((start (f64vector->list (rov-position))))
    (lambda (from to)
      (let ((v (%leg (this-engine 'bench) 0 (and (not (equal? from start)) (list->f64vector from)) (list->f64vector to))))
        (if (vector-ref v 0) (vector-ref v 3) 1e6)))))

(define (tour-in-order tour order)
  ;; TOUR with its places in ORDER.
  (let* ((points (map list->f64vector order))
         (engine (this-engine 'bench))
         (legs (map (lambda (from to)
                      (let ((v (%leg engine 0 from to)))
                        (cons (vector-ref v 3) (map list->f64vector (array->list (vector-ref v 0))))))
                    (cons #f points) (append points (list #f)))))
    (along order legs (tether-length))))


;;; Flights.

(define (comes-home? tour)
  ;; Flown in the present dive, a fork, to its end.
  (let* ((flight (begin-flight! tour speed)) (n (length (tour-places tour)))
         (most (+ (now) 120 (/ (* 2.5 (tour-length tour)) speed))))
    (let loop ()
      (in-time?)
      (run 1)
      (cond ((and (>= (places-reached flight) n) (at-home? tour)) (not (fouled? 'line)))
            ((or (null? (dive-tasks (current-dive))) (> (now) most)) #f)
            (else (loop))))))

(define (home-in-truth? tour member)
  ;; A flight that fails for any reason has not come home.
  (unless-refused (lambda () (in-member member (lambda () (untold-fork (lambda () (comes-home? tour))))))
                  (const #f)))

(define (flights-in member all)
  ;; Of ALL, tours as `tours' returns them, each flown in the truth of MEMBER: a list (HOME? SECONDS) for each.  Those with
  ;; the same legs are flown once.
  (let loop ((rest (map third all)) (known '()) (found '()))
    (if (null? rest)
        (reverse! found)
        (let* ((legs (tour-legs (car rest)))
               (flown (or (assoc-ref known legs)
                          (let* ((begun (clock)) (home? (home-in-truth? (car rest) member)))
                            (list home? (- (clock) begun))))))
          (loop (cdr rest) (acons legs flown known) (cons flown found))))))

(define (tenths x) (/ (round (* 10.0 x)) 10))
(define (hundredths x) (/ (round (* 100.0 x)) 100))

(define (say-tour name flights blind-length row)
  (let ((tour (third row)))
    (simple-format #t "~a,~a,~a,~a,~a,~a,~a,~a,~a,~a~%" name (first row) (length (tour-places tour)) (length flights)
                   (count first flights)
                   (tenths (tour-length tour)) (hundredths (/ (tour-length tour) blind-length)) (hundredths (second row))
                   (tenths (apply + (map second flights)))
                   (if (tour-risk tour) (hundredths (first (tour-risk tour))) ""))
    (force-output)))

(define (say-world name settings end)
  ;; END is when the flights in it are to end.
  (let ((world (world-of name)) (n (assq-ref settings 'places)) (truths (assq-ref settings 'truths))
        (clauses (doubts (assq-ref settings 'error))))
    (enter! (flown-world world (assq-ref settings 'nodes) (assq-ref settings 'pull)))
    (let* ((wanted (assq-ref settings 'tours))
           (made (tours world name n clauses (assq-ref settings 'tethers) (assq-ref settings 'risk) wanted))
           (all (filter (lambda (row) (memq (first row) wanted)) made))
           (blind (tour-length (third (find (lambda (row) (eq? 'blind (first row))) made))))
           (members (list->vector
                     (belief-members
                      (make-belief (current-dive) clauses #:members (max 8 truths) #:seed truths-seed))))
           (flights (as-many-as-fit (simple-format #f "~a, truths" name) truths end
                                    (lambda (k) (flights-in (vector-ref members k) all)))))
      (for-each (lambda (row k)
                  (say-tour name (map (lambda (of-a-truth) (list-ref of-a-truth k)) flights) blind row))
                all (iota (length all))))))

(define tour-kinds '(plan held greedy blind bounded))

(define (tours-asked text)
  (let ((names (if text (map string->symbol (string-split text #\,)) tour-kinds)))
    (for-each (lambda (name)
                (unless (memq name tour-kinds) (unknown-name 'bench "the bench tours" name tour-kinds "tour")))
              names)
    names))

(define (read-settings options)
  (let ((quick? (assoc-ref options "--quick")))
    `((tours . ,(tours-asked (assoc-ref options "--tours")))
      (truths . ,(whole options "--truths" (if quick? 2 200) 1 4096))
      (places . ,(whole options "--places" (if quick? 2 5) 2 8))
      (nodes . ,(whole options "--nodes" 16 4 400))
      (tethers . ,(whole options "--tethers" (if quick? 8 16) 8 256))
      (risk . ,(decimal options "--risk" 0.05 0.001 1))
      (error . ,(decimal options "--error" 0.1 0.001 2))
      (pull . ,(decimal options "--pull" usual-pull 1 1e6)))))

(define (say-worlds names settings minutes)
  (let ((end (minutes-from-now minutes)))
    (display "world,tour,places,truths,home,length m,of the blind one's length,planned in s of CPU,flown in s of CPU,\
P(fouled) told\n")
    (force-output)
    (let loop ((rest names))
      (unless (null? rest)
        (say-world (car rest) settings (share-of-time end (length rest)))
        (loop (cdr rest))))))

(define (run-tours arguments)
  "Do what ARGUMENTS of the bench tours ask for, print what came of it and return the exit status."
  (let* ((options (bench-options "tours" valued flags arguments))
         (world (assoc-ref options "--world"))
         (names (cond (world (list (string->symbol world)))
                      ((assoc-ref options "--quick") '(cage))
                      (else world-names))))
    (for-each (lambda (name)
                (unless (memq name world-names) (unknown-name 'bench "the bench tours" name world-names "world")))
              names)
    (if (assoc-ref options "--help")
        (display help)
        (say-worlds names (read-settings options) (decimal options "--minutes" #f 0.01 1e5)))
    0))
