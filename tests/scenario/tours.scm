;;; Tours: the order against all orders, what every leg keeps, and tours flown, in worlds of the catalogue and crossed
;;; with what they were not built for.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight belief cloud) #:select (belief-members in-member)) ((bight bench tours) #:select (run-tours)) ((bight dive tour-order) #:select (best-order)) ((srfi srfi-1) #:renamer (lambda (name) (if (eq? name (quote every)) (quote every1) name)))
             (srfi srfi-11))

(define (structures)
  ;; What stands in the water of the present dive, structures in the place of their members.
  (delete-duplicates
   (filter-map (lambda (part)
                 (let* ((name (symbol->string part)) (slash (string-index name #\/)))
                   (cond (slash (string->symbol (substring name 0 slash)))
                         ((memq part '(seabed minnow line)) #f)
                         (else part))))
               (parts))))


;;; Orders.

(define (all-orders places)
  (if (null? places)
      '(())
      (append-map (lambda (k) (map (lambda (order) (cons k order)) (all-orders (delv k places)))) places)))

(define (costs-at-random n dice)
  ;; Lengths between points in a square; the costs of -1, 0 to n.
  (let ((at (map (lambda (k) (make-rectangular (random 10.0 dice) (random 10.0 dice))) (iota (+ n 2)))))
    (lambda (i j) (magnitude (- (list-ref at (+ i 1)) (list-ref at (+ j 1)))))))

(define (length-by cost order n)
  (fold + 0 (map cost (cons -1 order) (append order (list n)))))

(define-scenario the-shortest-of-all-orders
  "Of up to six places the order is the shortest of all; of thirteen none with a stretch turned round is shorter."
  (let ((dice (seed->random-state 4)))
    (do ((k 0 (+ k 1))) ((= k 30))
      (let* ((n (random 7 dice)) (cost (costs-at-random n dice)) (order (best-order n cost)))
        (expect (sort order <) => (iota n))
        (expect (length-by cost order n)
                is (about (apply min (map (lambda (o) (length-by cost o n)) (all-orders (iota n)))) #:within 1e-9))))
    (do ((k 0 (+ k 1))) ((= k 10))
      (let* ((cost (costs-at-random 13 dice)) (order (best-order 13 cost)) (length (length-by cost order 13)))
        (expect (sort order <) => (iota 13))
        (for-each
         (lambda (i)
           (for-each (lambda (j)
                       (let-values (((head tail) (split-at order i)))
                         (expect (length-by cost (append head (reverse (take tail j)) (drop tail j)) 13)
                                 is (above (- length 1e-6)))))
                     (iota (- 14 i))))
         (iota 13))))))


;;; What every tour keeps.

(define (legs-join? tour)
  ;; The way begins at the vehicle, passes every place, and ends at the anchor.
  (let ((way (map (lambda (p) (apply vec p)) (array->list (tour-way tour)))))
    (every1 (lambda (p) (any (lambda (q) (< (distance p q) 1e-6)) way))
           (cons* (rov-position) (point-at 0) (tour-places tour)))))

(define-scenario (every-structure-of-a-world place)
  "All that stands there is visited on one tour, and flown on a fork the vehicle comes home, its tether free."
  #:for ((place 'jacket 'wreck 'cage))
  (in place)
  (let ((hash (state-hash)) (tour (plan-tour (structures) #:line 80)))
    (expect (length (tour-names tour)) is (above 12))
    (expect (tour-left-out tour) => '())
    (expect (legs-join? tour) => #t)
    (expect (tour-line-needed tour) is (between 10 80))
    (expect (state-hash) => hash)
    (when (eq? 'cage place)
      (let ((came (tour-trial tour)))
        (expect (assq-ref came 'home?) => #t)
        (expect (assq-ref came 'fouled?) => #f)
        (expect (assq-ref came 'reached) => (length (tour-names tour)))
        (expect (state-hash) => hash)))))

(define-scenario what-a-short-line-reaches
  "No more line than there is: what lies beyond is left out and said; with the line it takes it is visited."
  (in pile)
  (let* ((places '((3 4 -5) (0 30 -6) (4 -3 -8)))
         (short (plan-tour places #:line 20)) (long (plan-tour places #:line 60)))
    (expect (length (tour-names short)) => 2)
    (expect (map car (tour-left-out short)) => (list (vec 0 30 -6)))
    (expect (string-contains (cdar (tour-left-out short)) "m of tether") is number?)
    (expect (tour-line-needed short) is (below 20))
    (expect (tour-left-out long) => '())
    (expect (length (tour-names long)) => 3)))

(define-scenario where-nothing-stands
  "In open water the tour is the shortest polygon; at a stop of it there is as much line as the place is off."
  (in open-water)
  (let* ((places '((5 5 -5) (8 -4 -6) (12 3 -4)))
         (tour (plan-tour places)) (home (point-at 0)) (start (rov-position)))
    (define (polygon order)
      (let ((stops (append (list start) (map (lambda (p) (apply vec p)) order) (list home))))
        (fold + 0 (map distance stops (cdr stops)))))
    (expect (tour-length tour) is (about (apply min (map polygon (all-orders places))) #:within 1e-9))))


;;; Flown.

(define-scenario a-tour-is-flown
  "The vehicle stops at each place, holds to its line, and comes home free; a fork had told so."
  (in pile)
  (let* ((tour (plan-tour (list 'p1 '(3 4 -5) '(4 -3 -8)))) (told (tour-trial tour)) (left (tour-places tour)) (begun (now)))
    (expect (assq-ref told 'home?) => #t)
    (fly-tour! tour)
    (do ((k 0 (+ k 1))) ((or (= k 600) (arrived?)))
      (run 0.5)
      (expect (taut-length) is (below (+ 0.1 (tether-length))))
      (set! left (remove (lambda (p) (< (distance p (rov-position)) 0.6)) left)))
    (expect left => '())
    (expect (- (now) begun) is (about (assq-ref told 'seconds) #:within 2))
    (expect (distance (rov-position) (point-at 0)) is (below 1.5))
    (expect (fouled?) => #f)))

(define-scenario a-way-that-is-barred
  "A vehicle that something which moves, and so is no part of the plan, stops short of a place comes home, as a fork told."
  (enter! (world (sea (depth 15)) (box (named barge) (track (0 0 20 -6)) (size 12 2 12)) (rov (named minnow) (at 0 8 -5))
                 (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 12) (from 0 0 -3) (to minnow)
                         (length 12))))
  (let* ((tour (plan-tour '((0 30 -5)) #:line 40)) (told (tour-trial tour)))
    (expect (assq-ref told 'reached) => 0)
    (expect (assq-ref told 'home?) => #t)
    (fly-tour! tour)
    (run-until arrived? #:at-most 300)
    (expect (distance (rov-position) (point-at 0)) is (below 1.5))))

(define-scenario a-tour-begins-by-unwinding
  "A tether that is wound about the pile when the tour begins is unwound on the first leg."
  (enter! (world (sea (depth 15))
                 (cylinder (named p1) (from 0 0 1) (to 0 0 -15) (radius 0.45))
                 (rov (named minnow) (at 6 -6 -5))
                 (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from -6 -8 -3) (to minnow)
                         (via (3 0 -4) (0 3 -4) (-3 0 -5) (0 -3 -5)) (length 45))))
  (expect (winding 'p1) is (lambda (n) (not (zero? n))))
  (let ((tour (plan-tour '((3 4 -5) (8 1 -6)))))
    (expect (assq-ref (tour-trial tour) 'fouled?) => #f)))

(define-scenario (with-any-model model)
  "A static tether is planned for and flown as a moving one."
  #:for ((model 'rubber-band 'catenary 'steady 'auto))
  (enter! (world (sea (depth 15) (current 0.25 90))
                 (cylinder (named p1) (from 0 0 1) (to 0 0 -15) (radius 0.45))
                 (rov (named minnow) (at 6 -6 -5))
                 (tether (named line) (type fathom) (from -6 -8 -3) (to minnow) (length 40) (model ,model))))
  (let ((tour (plan-tour '((3 4 -5) (4 -3 -8)))))
    (expect (length (tour-names tour)) => 2)
    (expect (assq-ref (tour-trial tour) 'reached) => 2)))

(define-scenario crossed-with-what-it-was-not-built-for
  "An obstacle that moves is no part of the plan; a fork plans as its dive; a plan is a value that a checkpoint does
not change; a cut tether, no place, and a place that is none are refused with the dive untouched."
  (in pile)
  (let* ((places '((3 4 -5) (4 -3 -8))) (tour (plan-tour places)) (mark (checkpoint)))
    (expect (what-if (tour-length (plan-tour places))) => (tour-length tour))
    (run 5)
    (restore! mark)
    (expect (tour-length (plan-tour places)) => (tour-length tour))
    (expect (plan-tour '()) raises domain)
    (expect (plan-tour '(1 2)) raises domain)
    (expect (plan-tour '(nowhere)) raises name)
    (expect (plan-tour '((0 +nan.0 0))) raises domain)
    (expect (tour-names (plan-tour '((30 40 -5)))) => '())
    (cut-tether! 'line #:at 5)
    (expect (plan-tour places) raises unsupported)))

(define-scenario a-parted-tether-leads-nowhere
  "What would fly its vehicle home, or plan or measure a way for it, refuses a parted tether; a tour during which the
tether parts ends with the vehicle not home."
  (in pile)
  (let ((tour (plan-tour '((3 4 -5) (4 -3 -8)))))
    (what-if (cut-tether! 'line #:at 5)
             (let ((hash (state-hash)))
               (expect (home-trial) raises unsupported)
               (expect (fly-home!) raises unsupported)
               (expect (tour-trial tour) raises unsupported)
               (expect (fly-tour! tour) raises unsupported)
               (expect (slack-to-reach '(3 4 -5)) raises unsupported)
               (expect (state-hash) => hash)))
    (what-if (every 3 (unless (parted?) (cut-tether! 'line #:at 5)))
             (expect (assq-ref (tour-trial tour) 'home?) => #f))
    (fly-tour! tour)
    (run 3)
    (cut-tether! 'line #:at 5)
    (expect (arrived?) => #f)
    (run 1)
    (expect (arrived?) => #t)))

(define-scenario inside-an-obstacle
  "A place within an obstacle, and one above the water, are left out."
  (in pile)
  (let ((tour (plan-tour '((0 0 -6) (3 4 -5)))))
    (expect (length (tour-names tour)) => 1)
    (expect (length (tour-left-out tour)) => 1)))


;;; By a belief.

(define-scenario a-tour-within-a-risk
  "In a cage, with the current known to 0.4 m/s, six tethers of eight are fouled on the shortest tour of two places.  Within a
risk of 5 % they are visited the other way round, on a longer tour that fouled none; dive and belief stay as they are."
  (enter! ((@@ (bight bench tours) flown-world) (find-world 'cage) 10))
  (with-belief (make-belief (current-dive) '((current (error 0.4)) (line (cdn (uniform 1 1.6)))) #:members 8)
    (let* ((places '(cage/back-1 cage/roof-3)) (hash (state-hash)) (belief-before (belief-hash)) (shortest (plan-tour places))
           (held (plan-tour places #:risk 0.05 #:speed 0.5)))
      (expect (tour-names shortest) => places)
      (expect (tour-risk shortest) => #f)
      (expect (first (tour-risk (plan-tour places #:risk 1 #:speed 0.5))) is (above 0.4))
      (expect (tour-names held) => (reverse places))
      (expect (first (tour-risk held)) => 0.0)
      (expect (third (tour-risk held)) is (between 0.3 0.4)) ; none of eight
      (expect (tour-length held) is (above (tour-length shortest)))
      (expect (list (state-hash) (belief-hash)) => (list hash belief-before)))))

(define (pile-and-short-line)
  (world (sea (depth 15) (current 0.1 90))
         (cylinder (named p1) (from 0 0 1) (to 0 0 -15) (radius 0.45))
         (rov (named minnow) (at 6 -6 -5))
         (tether (named line) (type fathom) (wet-weight 0) (from -6 -8 -3) (to minnow) (length 22) (model dynamic) (nodes 8))))

(define-scenario a-risk-crossed
  "A limit of risk asks for a belief of the present dive.  Where six of its eight tethers have parted, all places are left
out, and it is said why; a limit of one takes what there is, and tells the risk of it."
  (enter! (pile-and-short-line))
  (let ((places '((3 4 -5) (8 1 -6))))
    (current-belief #f)
    (expect (plan-tour places #:risk 0.1) raises def)
    (expect (plan-tour places #:risk 2) raises domain)
    (with-belief (make-belief (current-dive) '((current (error 0.05))) #:members 8)
      (expect (what-if (plan-tour places #:risk 0.1)) raises domain)
      (expect (tour-names (plan-tour places #:risk 0.1)) => (tour-names (plan-tour places)))
      (let ((tethers (belief-members (current-belief))))
        ;; Six of eight tethers part on the way.
        (for-each (lambda (m) (in-member m (lambda () (cut-tether! 'line #:at 5)))) (list-head tethers 6))
        (let ((held (plan-tour places #:risk 0.5)) (taken (plan-tour places #:risk 1)))
          (expect (tour-names held) => '())
          (expect (map cdr (tour-left-out held)) => '("with it P(fouled) is above 50 %" "with it P(fouled) is above 50 %"))
          (expect (first (tour-risk held)) => 0.75)
          (expect (length (tour-names taken)) => 2)
          (expect (first (tour-risk taken)) => 0.75))))
    (cut-tether! 'line #:at 5)
    (with-belief (make-belief (current-dive) '((current (error 0.05))) #:members 8)
      (expect (plan-tour places #:risk 0.1) raises unsupported))))


;;; Against other tours.

(define (rows-printed . options)
  ;; What `bight bench tours' prints with OPTIONS, an alist from a tour's name to its cells.
  (map (lambda (line) (let ((cells (string-split line #\,))) (cons (second cells) (cddr cells))))
       (cdr (string-tokenize (with-output-to-string (lambda () (run-tours options)))
                             (char-set-complement (char-set #\newline))))))

(define-scenario a-planned-tour-comes-home-where-a-blind-one-does-not
  "Among piles the planned tour is flown home in every truth drawn, at most a quarter longer than the shortest tour of a
vehicle without a tether, which comes home wound in each."
  (let ((rows (rows-printed "--world" "piles" "--truths" "2" "--nodes" "10" "--tethers" "8")))
    (define (cell tour k) (string->number (list-ref (assoc-ref rows tour) k)))
    (expect (map car rows) => '("plan" "held" "greedy" "blind" "bounded"))
    (expect (cell "held" 2) => 2)
    (expect (cell "held" 7) is (between 0 0.05))
    (expect (cell "plan" 2) => 2)
    (expect (cell "blind" 2) => 0)
    (expect (cell "plan" 4) is (between 1 1.25))
    (expect (cell "bounded" 4) is (between 1 1.25))
    (expect (cell "greedy" 3) is (above (- (cell "plan" 3) 0.1)))
    (expect (map car (rows-printed "--world" "piles" "--truths" "1" "--nodes" "10" "--tours" "greedy,plan")) => '("greedy" "plan"))
    (expect (run-tours '("--tours" "plan,longest")) raises name)
    (expect (run-tours '("--world" "moon")) raises name)
    (expect (run-tours '("--truths" "0")) raises domain)))
