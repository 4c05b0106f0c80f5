;;; What a tether is caught on, in worlds made at random: nothing where the class is the free way's, whole turns
;;; with their sign where it is not, the other sign in a mirror, and nothing else for what stands far away.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1) ((bight assembly) #:select (data->part)))

(define (numbered name i) (string->symbol (string-append name "-" (number->string i))))

;;; Worlds at random, and the same in a mirror.

(define (random-piles dice mirror)
  ;; Eight piles; every third ends in the water, above or below.
  (map (lambda (i)
         (let ((x (* mirror (- (random 20.0 dice) 10))) (y (- (random 20.0 dice) 10)))
           (data->part `(cylinder (named ,(numbered "pile" i))
                                  (from ,x ,y ,(if (= 1 (modulo i 6)) -7 1))
                                  (to ,x ,y ,(if (= 4 (modulo i 6)) -7 -30))
                                  (radius ,(+ 0.1 (random 0.5 dice)))))))
       (iota 8)))

(define (random-frame dice mirror)
  ;; Piles with beams between them, some of which dangle, a box on the bed, and a ball.
  (define (at) (list (* mirror (- (random 16.0 dice) 8)) (- (random 16.0 dice) 8)))
  (define places (map (lambda (i) (at)) (iota 5)))
  (append
   (map (lambda (p i)
          (data->part `(cylinder (named ,(numbered "frame/leg" i)) (from ,@p 1) (to ,@p -30) (radius 0.3))))
        places (iota 5))
   (map (lambda (p q i)
          (data->part `(capsule (named ,(numbered "frame/beam" i)) (from ,@p ,(- -3 (random 6.0 dice)))
                                (to ,@(if (= i 2) (at) q) ,(- -3 (random 6.0 dice))) (radius 0.15))))
        places (cdr places) (iota 4))
   (list (data->part `(box (named rock) (at ,@(at) -19) (size 3 2 3)))
         (data->part `(sphere (named buoy) (at ,@(at) -5) (radius 0.6))))))

(define (flight dice mirror)
  (map (lambda (i) (list (* mirror (- (random 24.0 dice) 12)) (- (random 24.0 dice) 12) (- -3 (random 5.0 dice))))
       (iota 6)))

(define (world-of parts mirror)
  (world (sea (depth 20)) (seabed)
         (splice parts)
         (rov (named minnow) (at (* mirror 14) -13 -5))
         (tether (named line) (type fathom) (wet-weight 0) (from (* mirror 15) -15 -4) (to minnow) (length 150)
                 (model rubber-band))))

(define (fly places visit)
  ;; Call VISIT at every place that he comes to; what stands in the way he goes round or not at all.
  (for-each (lambda (p)
              (move! p #:speed 2)
              (run-until arrived? #:at-most 30)
              (visit))
            places))

(define kinds (list random-piles random-frame))

(define (drawn draw seed mirror)
  ;; The world and the flight of a SEED, or #f where something stands in the way of the lay.
  (let* ((dice (seed->random-state seed)) (parts (draw dice mirror)) (places (flight dice mirror)))
    (and (false-if-exception (enter! (world-of parts mirror))) places)))

(define caught 0)
(define visits 0)

(define (look-at-windings)
  (let ((all (windings)) (class (homotopy-class)))
    (set! visits (+ 1 visits))
    (unless (null? all) (set! caught (+ 1 caught)))
    (expect (what-if (taut-length) (windings)) => all) ; with a string, without what was told before
    (expect (and-map (lambda (entry) (and (exact-integer? (cdr entry)) (not (zero? (cdr entry))))) all))
    (when (class-free? class) (expect all => '()))
    (unless (null? all) (expect (class-free? class) => #f))))

(define-scenario free-is-unwound
  "Flown among piles and frames at random: where the class is the free way's nothing is wound, and where something
is, whole turns, the class is another."
  (for-each (lambda (draw)
              (for-each (lambda (seed) (and=> (drawn draw seed 1) (lambda (places) (fly places look-at-windings))))
                        (iota 12)))
            kinds)
  (expect visits is (above 80))
  (expect caught is (above 12)))

(define (windings-of draw seed mirror)
  (and=> (drawn draw seed mirror)
         (lambda (places)
           (let ((all '()))
             (fly places (lambda () (set! all (cons (windings) all))))
             all))))

(define (negated all)
  (map (lambda (entries) (map (lambda (e) (cons (car e) (- (cdr e)))) entries)) all))

(define (by-object all)
  ;; The entries of windings that are of obstacles, not of structures.
  (filter (lambda (entry) (memq (car entry) (parts))) all))

(define-scenario events-tell-what-watchers-see
  "Flown among piles and frames at random, looked at twice a second: whenever the turns about something become more
the dive holds `wrapped', when they become none `freed', and nothing else."
  (let ((seen 0))
    (define (watch)
      ;; Look at every step at which the dive does; what it must tell.
      (let ((before (by-object (windings))) (told '()))
        (every 0.5
          (let ((after (by-object (windings))))
            (for-each (lambda (name)
                        (let ((was (abs (or (assq-ref before name) 0))) (is (abs (or (assq-ref after name) 0))))
                          (cond ((> is was) (set! told (cons (list 'wrapped name) told)))
                                ((and (zero? is) (> was 0)) (set! told (cons (list 'freed name) told))))))
                      (filter (lambda (n) (or (assq n before) (assq n after))) (parts)))
            (set! before after)))
        (lambda () (reverse told))))
    (for-each (lambda (draw)
                (for-each (lambda (seed)
                            (let ((places (drawn draw seed 1)))
                              (when places
                                (run 0.5)
                                (let ((told (watch)))
                                  (fly places (const #t))
                                  (run 0.5)
                                  (set! seen (+ seen (length (told))))
                                  (expect (map (lambda (e) (list (car e) (cadddr e)))
                                               (filter (lambda (e) (memq (car e) '(wrapped freed))) (events)))
                                          => (told))))))
                          (iota 5)))
              kinds)
    (expect seen is (above 8))))

(define-scenario mirrored
  "In a mirror, the same with the other sign: piles at random, and a flight among them."
  (let ((any 0))
    (for-each (lambda (seed)
                (let ((here (windings-of random-piles seed 1)) (there (windings-of random-piles seed -1)))
                  (when (and here there)
                    (set! any (+ any (count pair? here)))
                    (expect there => (negated here)))))
              (iota 8))
    (expect any is (above 5))))

;;; Known answers.

(define (go . places)
  (for-each (lambda (p) (fly-to! p #:speed 0.5) (run-until arrived? #:at-most 90)) places))

(define-scenario a-stub-far-below
  "The guide posts of a wellhead, and stubs 192 m below the line, are turned about by its angle and hold nothing;
a net pen, a jacket and a pier begin without a winding."
  (for-each (lambda (w) (enter! w) (expect (windings) => '())) '(garage jacket pier rigging wreck under-ice))
  (in (world (sea (depth 200)) (seabed)
             (cylinder (named stub) (from 0 0 -192) (to 0 0 -200) (radius 0.3))
             (cylinder (named hanger) (from 0 6 1) (to 0 6 -2) (radius 0.3))
             (rov (named minnow) (at 6 -2 -5))
             (tether (named line) (type fathom) (wet-weight 0) (from -6 -2 -5) (to minnow) (length 90)
                     (model dynamic))))
  (go '(6 12 -5) '(-6 12 -5) '(-6 -3 -5) '(5 -3 -5))
  (expect (abs (turns 'stub)) is (above 0.7))
  (expect (abs (turns 'hanger)) is (above 0.7))
  (expect (windings) => '())
  (expect (class-free? (homotopy-class))))

(define-scenario told-by-structure
  "In a jacket, through its face and round a leg: the structure is told first, then the leg; it can be asked for
alone; what is no part is refused."
  (in 'jacket)
  (move! '(3 -10 -8) #:speed 1) (run-until arrived? #:at-most 60)
  (for-each (lambda (p) (move! p #:speed 1) (run-until arrived? #:at-most 60))
            '((3 -3 -8) (9 -3 -8) (9 -9 -8) (3 -10 -8)))
  (expect (windings) => '((jacket . 1) (jacket/leg-b2 . 1)))
  (expect (winding 'jacket) => 1)
  (expect (winding 'jacket/leg-b2) => 1)
  (expect (winding 'jacket/leg-a1) => 0)
  (expect (string-contains (call-with-output-string (lambda (port) (display (status) port)))
                           "jacket: leg-b2 +1"))
  (expect (winding 'jackets) raises name))

(define-scenario under-a-span
  "Under the span of a pipeline: the line is wound about the pipe; back under it is not."
  (in (world (sea (depth 30)) (seabed)
             (splice (make-pipeline #:name 'pipe #:at '(0 0 -30) #:heading 0 #:length 40 #:span 2 #:supports 3))
             (rov (named minnow) (at -8 -4 -27))
             (tether (named line) (type fathom) (wet-weight 0) (from -14 -6 -20) (to minnow) (length 30)
                     (model dynamic))))
  (go '(-4 -5 -29) '(4 -5 -29))
  (expect (abs (winding 'pipe/pipe)) => 1)
  (go '(-4 -5 -29) '(-8 -4 -27))
  (expect (windings) => '()))

(define-scenario far-away
  "A pile 100 m off, and a stub below, change nothing of what is wound about a pile."
  (define (beside . parts)
    (enter! (world (sea (depth 40))
               (cylinder (named p1) (from 0 0 1) (to 0 0 -40) (radius 0.4))
               (splice parts)
               (rov (named minnow) (at 6 -6 -5))
               (tether (named line) (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 45)
                       (model dynamic))))
    (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5) '(3 3 -5) '(3 -3 -5))
    (windings))
  (expect (beside) => '((p1 . 1)))
  (expect (beside (part cylinder (named p2) (from 100 0 1) (to 100 0 -40) (radius 0.4))
                  (part cylinder (named stub) (from 1 1 -36) (to 1 1 -40) (radius 0.4)))
          => '((p1 . 1))))

(define-scenario a-pillar
  "A square pillar from the bed to the air is gone round like a pile; a container is lifted off."
  (define (about top)
    (enter! (world (sea (depth 20)) (seabed)
               (box (named block) (at 0 0 (/ (- top 20) 2)) (size 2 2 (+ top 20)))
               (rov (named minnow) (at 6 -6 -5))
               (tether (named line) (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 45)
                       (model dynamic))))
    (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5) '(3 3 -5) '(3 -3 -5))
    (winding 'block))
  (expect (about 1) => 1)
  (expect (about -3) => 0))

(define-scenario wound-as-before
  "Of a line that stays wound as it was, the windings are asked without a string; asked of one, they are the same."
  (enter! (world (sea (depth 20)) (seabed)
                 (cylinder (named pile) (from 0 0 1) (to 0 0 -20) (radius 0.6))
                 (rov (named minnow) (at 6 -6 -5))
                 (tether (named line) (type fathom) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 45)
                         (model dynamic))))
  (go '(3 -3 -5) '(-3 -3 -5) '(-3 3 -5) '(3 3 -5) '(3 -3 -5))
  (let ((strings (assq-ref (profile) 'strings)))
    (drive! #:surge 0.1 #:yaw 0.2)
    (do ((i 0 (+ i 1))) ((= i 40))
      (run 0.2)
      (expect (winding 'pile) => 1)
      (when (zero? (modulo i 8))
        (expect (what-if (taut-length) (winding 'pile)) => 1)))
    (expect (- (assq-ref (profile) 'strings) strings) is (below 8)))
  (cut-tether! #:at 10)
  (expect (winding 'pile) => (what-if (taut-length) (winding 'pile))))

(define-scenario merely-passing
  "A line that passes beside a pile which stands in the way of its chord is looked at twice a second, and neither a
string nor a chart is made for that."
  (enter! (world (sea (depth 60) (current 0.3 0))
                 (cylinder (named pile) (from 0 0 -60) (to 0 0 0) (radius 2))
                 (rov (named minnow) (at 12 -0.5 -10))
                 (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from -12 -0.5 -10) (to minnow)
                         (via (0 -4 -10)) (length 28))))
  (drive! #:surge 0 #:yaw 0.05 #:heave 0.02)
  (run 10)
  (let ((counted (profile)))
    (expect (assq-ref counted 'strings) => 0)
    (expect (assq-ref counted 'charts) => 0))
  (expect (windings) => '()))
