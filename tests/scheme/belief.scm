;;; A belief: a cloud of tethers, what it answers, and what it learns.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1)
             (srfi srfi-4)
             (bight belief cloud)
             (bight belief tube)
             (bight belief unknowns)
             (bight engine)
             ((bight view picture) #:select (picture-pixels))
             (bight view tube))

(define slack-water
  (with (find-world (string-append (dirname (dirname (dirname (current-filename)))) "/testbed/worlds/beside-a-post.scm")
              #:trust #t)
    (line (nodes 10))))

(define-belief doubtful
  "The current, and the drag of the line."
  (current (error 0.1) (levels 0 -20) (correlation 20))
  (line (cdn (uniform 1 1.6))))

(define (hashes belief)
  (map (lambda (m) (in-member m state-hash)) (belief-members belief)))

(define (values-of belief name)
  (answer-values (assq-ref (belief-values belief) name)))

(define-scenario every-question-is-answered
  "What is true or false is a probability, a number has quantiles, a point a mean, anything else shares."
  (in slack-water)
  (believe! doubtful #:members 16)
  (run 4)
  (let ((answers (belief fouled? (slack) (point-at 8) (homotopy-class) (tether-length))))
    (expect (map answer? answers) => '(#t #t #t #t #t))
    (expect (answer-probability (first answers)) => 0.0)
    (expect (second (answer-interval (first answers))) is (between 0.1 0.3))
    (expect (answer-quantile (second answers) 0.5) is (between 0 1))
    (expect (<= (answer-quantile (second answers) 0.1) (answer-quantile (second answers) 0.9)) => #t)
    (expect (distance (answer-mean (third answers)) (point-at 8)) is (below 0.5))
    (expect (map cdr (answer-shares (fourth answers))) => '(1.0))
    (expect (answer-interval (fifth answers)) => '(16.0 16.0))
    (expect (answer-quantile (first answers) 0.5) raises unsupported)
    (expect (belief (rov-position 'line)) raises name)    ; what every member raises
    (expect (belief (point-at)) raises domain)
    ;; Some have an answer, and some have none.
    (let ((asked -1))
      (expect (length (answer-values (belief (begin (set! asked (+ asked 1)) (if (even? asked) (slack) (rov-position 'line))))))
              => 8))))

(define-scenario an-answer-in-words
  "What does not spread is said without rounding errors; of many different values the likeliest are said, and how many
more there are."
  (in slack-water)
  (believe! doubtful #:members 16)
  (expect (object->string (belief (point-at 8))) is (lambda (said) (string-contains said "+- (0 0 0) m")))
  (let ((k 0))
    (expect (object->string (belief (begin (set! k (+ k 1)) (list k)))) is (lambda (said) (string-contains said ", 10 more, 16 tethers"))))
  (expect (observe! #f 'winch-tension 3000) => 'impossible)
  (expect (third (first (belief-doubts))) => 3000.0))

(define-scenario a-belief-of-another-dive
  "Asked in a dive that it is not of, the current belief refuses; in a fork a fork of it answers for what was done there."
  (in slack-water)
  (let ((b (believe! doubtful #:members 8)))
    (what-if
     (cut-tether! 'line #:at 5)
     (run 1)
     (expect (belief parted?) raises domain)
     (expect (observe! #f 'winch-tension 1) raises domain)
     (expect (tether-tube) raises domain)
     (expect (look #:belief #t) raises domain)
     (expect (answer-probability (ask-belief b parted?)) => 0.0)
     (with-belief (fork-belief)
       (expect (answer-probability (belief parted?)) => 1.0)))
    (expect (answer-probability (belief parted?)) => 0.0)
    (enter! slack-water)
    (expect (belief fouled?) raises domain)
    (current-belief #f)))

(define-scenario nothing-uncertain-nothing-spread
  "A belief of one value alone is the dive itself to the last bit of the line, through all that is done to it."
  (in slack-water)
  (believe! (line (gj (one-of 0))) #:members 8)
  (move! '(5 9 -8) #:speed 0.5) (run 2)
  (pay-out! 4 #:rate 1) (current! 0.1 0) (run 2)
  (alter! 'line #:cdn 1.5) (haul-in! 1) (run 2)
  (expect (delete-duplicates (answer-values (belief (point-at 8)))) => (list (point-at 8)))
  (expect (delete-duplicates (answer-values (belief (tether-length)))) => (list (tether-length))))

(define-scenario threads-never-show
  "The same bits for any number of threads, and whether the dive is asked often or once."
  (in slack-water)
  (let* ((one (believe! doubtful #:members 8))
         (two (believe! doubtful #:members 8)))
    (belief-threads! 1 one)
    (belief-threads! 3 two)
    (move! '(5 9 -8) #:speed 0.5)
    (run 1)
    (ask-belief one slack)
    (run 2)
    (ask-belief one slack)
    (ask-belief two slack)
    (expect (hashes one) => (hashes two))
    (expect (length (delete-duplicates (hashes one))) => 8)))

(define-scenario values-stay-in-range
  "Each member has its own values; those that are altered by hand keep them."
  (in slack-water)
  (let ((b (believe! (line (cdn (uniform 1 1.6)) (friction (normal 0.05 0.5))) (payout (normal 0 0.1)) #:members 16)))
    (alter! 'line #:cdn 5 #:ei 0.01)
    (expect (apply max (values-of b 'line.cdn)) is (below 1.6))
    (expect (apply min (values-of b 'line.friction)) => 0.0)
    (run 1)
    (expect (answer-interval (belief (tether-length)) 0.5) is (lambda (i) (< 15.8 (first i) 16 (second i) 16.2)))
    (expect (delete-duplicates
             (answer-values (belief (assq-ref ((@@ (bight dive query) tether-properties) 0) 'ei))))
            => '(0.01))))

(define (two-lines)
  ;; A tether of the user's vehicle and another's, both in the uncertain current, one of them pulled twice as far away.
  (world (sea    (depth 20) (current 0.2 90))
         (rov    (named minnow) (type kinematic) (at 0 12 -8) (heading 0))
         (rov    (named other) (type kinematic) (at 20 12 -4) (heading 90))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 10) (from 0 0 -2) (to minnow)
                 (length 16))
         (tether (named second) (type fathom) (wet-weight 0) (model dynamic) (nodes 10) (from 20 0 -2) (to other)
                 (length 13))))

(define-scenario readings-name-their-tether
  "Of two tethers a reading is of the one that is named, whatever it is of; unnamed it is refused, and nothing changes."
  (in (two-lines))
  (let ((b (believe! (current (error 0.1)) (line (cdn (uniform 1 1.6))) (payout (normal 0 0.3)) #:members 16)))
    (run 3)
    (let ((size (effective-size b)))
      (for-each (lambda (kind value)
                  (expect (observe! b kind value) raises name)
                  (expect (observe! b kind value #:tether 'lime) raises name))
                '(payout rov-tension winch-tension seen) '(16 1 1 (0 0 -2)))
      (expect (observe! b 'depth 8) raises name)
      (expect (tether-tube #:n 5) raises name)
      (expect (effective-size b) => size))
    ;; What is true of one line no member has for the other.
    (expect (observe! b 'seen (point-at 'second 6) #:tether 'second) => 'taken)
    (expect (observe! b 'seen (point-at 'second 6) #:tether 'line) => 'impossible)
    (expect (observe! b 'rov-tension (answer-quantile (belief (rov-tension 'second)) 0.5) #:tether 'second) => 'taken)
    (expect (observe! b 'payout 13 #:tether 'second #:noise 0.01) => 'taken)
    (expect (observe! b 'payout 13 #:tether 'line #:noise 0.01) => 'impossible)
    (expect (observe! b 'transponder (answer-mean (belief (point-at 'line 8))) #:on 8 #:tether 'line) => 'taken)
    (expect (observe! b 'depth 4 #:subject 'other) => 'taken)
    (expect (observe! b 'depth 4 #:subject 'minnow) => 'impossible)
    (mend-belief! b)
    (expect (map (lambda (line) (tube-holds? (tether-points line 5) #:tether line)) '(line second))
            => '((#t #t #t #t #t) (#t #t #t #t #t)))))

(define (twin-learns by)
  ;; A member of another belief is the truth; return the belief that observed it, and the truth.
  (let* ((truth (car (belief-members (make-belief (current-dive) doubtful #:members 8 #:seed 9))))
         (all (make-belief (current-dive) doubtful #:members 8 #:seed 9))
         (b (believe! doubtful #:members 32 #:by by)))
    (move! '(6 10 -8) #:speed 0.5)
    (for-each (lambda (k)
                (run 1)
                (catch-up! 'test all)
                (let ((member (car (belief-members all))))
                  (observe! b 'transponder (in-member member (lambda () (point-at 8))) #:on 8 #:noise 0.05)
                  (observe! b 'winch-tension (in-member member anchor-tension) #:noise 0.2)))
              (iota 8))
    (values b (unknown-values (belief-unknowns b) (member-latent truth)))))

(define-scenario readings-teach
  "Readings of a truth draw the belief to it, and narrow it."
  (in slack-water)
  (let ((before (belief-values (believe! doubtful #:members 32))))
    (call-with-values (lambda () (twin-learns 'smoother))
      (lambda (b truth)
        (let* ((after (belief-values b))
               (east (lambda (values) (third (find (lambda (v) (eq? 'current (car v))) values))))
               (width (lambda (a) (apply - (reverse (answer-interval a))))))
          (expect (width (east after)) is (below (* 0.5 (width (east before)))))
          (expect (answer-mean (east after)) is (about (second (car (assq-ref truth 'current))) #:within 0.05))
          (expect (null? (assq-ref (belief-about b) 'mended)) => #f)
          (expect (effective-size b) is (between 8 32)))))))

(define-scenario particles-teach
  "So do they with particles, which are mended at once and never flown again."
  (in slack-water)
  (call-with-values (lambda () (twin-learns 'particles))
    (lambda (b truth)
      (expect (null? (assq-ref (belief-about b) 'mended)) => #f)
      (expect (answer-interval (cdr (assq 'line.cdn (belief-values b))))
              is (lambda (i) (<= 1 (first i) (second i) 1.6))))))

(define-scenario what-cannot-be
  "Evidence that no member explains is an answer, told of, and changes nothing; what comes too late is late."
  (in (with slack-water (sea (current 0.4 90)))) ; in which every line presses on the post
  (let ((b (believe! doubtful #:members 16)))
    (run 2)
    (expect (observe! b 'winch-tension 1e6) => 'impossible)
    (expect (observe! b 'touched '(not post)) => 'impossible)
    (expect (observe! b 'seen '(100 100 -5)) => 'impossible)
    (expect (map second (belief-doubts b)) => '(seen touched winch-tension))
    (expect (effective-size b) is (about 16 #:within 1e-9))
    (expect (observe! b 'touched 'post) => 'taken)
    (expect (observe! b 'depth 8 #:at 1) => 'late)
    (expect (observe! b 'depth 8 #:at 3) raises domain)
    (expect (observe! b 'dept 8) raises name)
    (expect (observe! b 'position 8) raises domain)
    (expect (observe! b 'transponder '(0 0 0)) raises def)))

(define-scenario going-back
  "A belief goes back with its dive, and says so where it cannot; a fork of one goes its own way."
  (in slack-water)
  (let ((early (checkpoint)))
    (run 1)
    (let ((b (believe! doubtful #:members 8)) (start (checkpoint)))
      (move! '(4 10 -8) #:speed 0.5)
      (run 2)
      (ask-belief b slack)
      (let ((there (hashes b)))
        (what-if (let ((fork (fork-belief b)))
                   (run 1)
                   (ask-belief fork slack)
                   (expect (equal? (hashes fork) there) => #f)))
        (ask-belief b slack)
        (expect (hashes b) => there)
        (restore! start)
        (ask-belief b slack)
        (move! '(4 10 -8) #:speed 0.5)
        (run 2)
        (ask-belief b slack)
        (expect (hashes b) => there))
      (restore! early)
      (expect (ask-belief b slack) raises stale))))

(define-scenario clauses-are-checked
  "What cannot be uncertain is refused, and nothing is believed then."
  (in slack-water)
  (expect (belief slack) raises def)
  (expect (believe!) raises def)
  (expect (believe! (line (cdm (uniform 1 2)))) raises name)
  (expect (believe! (lien (cdn (uniform 1 2)))) raises name)
  (expect (believe! (line (cdn (uniform 2 1)))) raises domain)
  (expect (make-belief (current-dive) '((line (cdn (gauss 2 1))))) raises name)
  (expect (make-belief (current-dive) '((line (cdn (grid 2 1))))) raises def)
  (expect (believe! (line (length (uniform 1 2)))) raises unsupported)
  (expect (believe! (line (cdn (uniform 1 2))) (line (cdn (uniform 1 2)))) raises def)
  (expect (believe! (current (errors 0.1))) raises name)
  (expect (believe! (current (levels 0 -5))) raises def)
  (expect (believe! (currant (error 0.1))) raises name)
  (expect (belief) raises def)
  (expect (believe! (current (error 0.1)) #:members 3) raises domain)
  (current! (lambda (p t) (vec 0.1 0 0)))
  (expect (believe! (line (cdn (uniform 1 2)))) raises unsupported)
  (expect (current-belief) => #f))

(define-scenario two-tethers
  "A belief in a dive of two tethers asks each, and knows how surely each is fouled."
  (enter! (world (sea (depth 20))
                 (cylinder (named post) (from 3 6 0) (to 3 6 -20) (radius 0.3))
                 (rov (named minnow) (type kinematic) (at 0 12 -8))
                 (rov (named shiner) (type kinematic) (at 12 0 -8))
                 (tether (named line) (model dynamic) (nodes 10) (from 0 0 -2) (to minnow) (length 16))
                 (tether (named other) (model dynamic) (nodes 10) (from 1 0 -2) (to shiner) (length 16))))
  (believe! doubtful #:members 8)
  (run 2)
  (let ((answers (belief (fouled? 'line) (fouled? 'other) (tether-length 'other))))
    (expect (map answer-probability (list-head answers 2)) => '(0.0 0.0))
    (expect (answer-interval (third answers)) => '(16.0 16.0)))
  (current-belief #f))

(define-scenario the-tube
  "The tube holds its share of the members, and its axes are those of its ellipsoid."
  (in slack-water)
  (let ((b (believe! doubtful #:members 32)))
    (run 4)
    (let* ((lines (answer-values (belief (list (tether-points 5)))))
           (held (append-map (lambda (line) (tube-holds? (car line) #:belief b)) lines)))
      (expect (/ (count identity held) (length held)) is (between 0.85 1))
      (let* ((points (map (lambda (p) (car p)) (answer-values (belief (list (point-at 8))))))
             (e (ellipsoid (belief (point-at 8)) 0.9)))
        (for-each (lambda (axis)
                    (expect (ellipsoid-holds? e (vec+ (ellipsoid-mean e) (vec* 0.99 axis))) => #t)
                    (expect (ellipsoid-holds? e (vec+ (ellipsoid-mean e) (vec* 1.01 axis))) => #f))
                  (ellipsoid-axes e))
        (expect (count (lambda (p) (ellipsoid-holds? e p)) points) is (between 28 31))))))

(define-scenario the-tube-of-what-is-seen
  "At arc lengths the tube is that of points seen there; seen with an error, it is wider by what the error asks, and holds as
much of the members as they are seen: 2.5 deviations for 90 % of a point of which all else is known."
  (in slack-water)
  (run 2)
  (with-belief (believe! (line (cdn (one-of 1.2))) #:members 8)
    (let ((sure (tether-tube #:at '(4 8) #:share 0.8)) (seen (tether-tube #:at '(4 8) #:noise 0.1 #:share 0.8)))
      (expect (map distance (map car sure) (list (point-at 4) (point-at 8))) is (lambda (off) (< (apply max off) 1e-9)))
      ;; 0.9 of the 64 points that eight tethers are seen at, the errors' squares in a chi square of three degrees of freedom.
      (for-each (lambda (e) (for-each (lambda (axis) (expect (norm axis) is (about 0.25 #:within 0.05))) (cdr e))) seen)
      (for-each (lambda (e) (for-each (lambda (axis) (expect (norm axis) is (below 0.002))) (cdr e))) sure)
      (let ((off (list->typed-array 'f64 2 (map (lambda (s) (f64vector->list (vec+ (point-at s) (vec 0.15 0 0)))) '(4 8)))))
        (expect (tube-holds? off #:at '(4 8) #:share 0.8) => '(#f #f))
        (expect (tube-holds? off #:at '(4 8) #:noise 0.1 #:share 0.8) => '(#t #t))
        (expect (tube-holds? off #:at '(4) #:noise 0.1) raises domain)
        (expect (tether-tube #:noise -1) raises domain)))))

(define-scenario an-ellipsoid-is-drawn-as-an-ellipse
  "Of one place of a tube the cells are those whose middles lie in its outline; between two places no cell is left out."
  (let* ((half (list (vec 3 0 0) (vec 0 2 0) (vec 0 0 1)))
         (drawn (lambda (stations)
                  (let ((cells '()))
                    (for-each-inside (lambda (column row) (set! cells (cons (list row column) cells)))
                                     stations (lambda (p) (cons (x p) (y p))) -10 5 0.5 -1 40 10)
                    (delete-duplicates cells))))
         (middle (lambda (cell) (list (+ -10 (* 0.5 (+ 0.5 (second cell)))) (- 5 (+ 0.5 (first cell))))))
         (in? (lambda (cell) (<= (+ (expt (/ (first (middle cell)) 3) 2) (expt (/ (second (middle cell)) 2) 2)) 1)))
         (all (append-map (lambda (row) (map (lambda (column) (list row column)) (iota 40))) (iota 10)))
         (sorted (lambda (cells) (sort cells (lambda (a b) (< (+ (* 100 (first a)) (second a)) (+ (* 100 (first b)) (second b))))))))
    (expect (sorted (drawn (list (cons (vec 0 0 -5) half)))) => (filter in? all))
    (let ((cells (drawn (list (cons (vec -6 0 -5) half) (cons (vec 6 0 -5) half)))))
      (for-each (lambda (cell)
                  (when (and (< (abs (second (middle cell))) 1.9) (< (abs (first (middle cell))) 6))
                    (expect (and (member cell cells) #t) => #t)))
                all))))

(define-scenario a-belief-is-drawn
  "Where a tether may be is in a look and in a picture that are asked for it, and in no other."
  (in slack-water)
  (expect (look #:belief #t) raises def)
  (believe! doubtful #:members 8)
  (move! '(4 11 -8) #:speed 1) (run 4)
  (let* ((told (object->string (look #:columns 80 #:belief #t)))
         (bare (object->string (look #:columns 80)))
         (added (filter-map (lambda (a b) (and (not (char=? a b)) b)) (string->list bare) (string->list told))))
    (expect (lset-difference char=? added '(#\. #\:)) => '())
    (expect (count (lambda (c) (char=? c #\.)) added) is (above 3))
    (expect (string-length told) => (string-length bare))
    (expect (object->string (belief (look #:columns 80))) => told)
    (expect (object->string (belief (look #:columns 80 #:belief #f))) => bare)
    (expect (object->string (belief look)) => (object->string (look #:belief #t))))
  (when (false-if-exception (resolve-interface '(bight view render)))
    (let* ((size '(160 . 120))
           (bare (picture-pixels 'test '(top) size 'plain '()))
           (told (picture-pixels 'test '(top) size 'plain '(belief)))
           (changed (count (lambda (k) (not (= (array-ref bare k) (array-ref told k)))) (iota (* 4 160 120)))))
      (expect changed is (between 200 30000))
      (expect (equal? bare (picture-pixels 'test '(top) size 'plain '())) => #t)))
  (current-belief #f))


;;; ^C.

(define (press-at k thunk)
  ;; Call THUNK and press ^C at the K-th look whether somebody does, of which there is one every 20 ms: `ended' or `left'.
  (let ((looks 0))
    (usleep 25000)                      ; so that the first look comes at once, on any machine
    (%set-reporter! (lambda (share)
                      (when share
                        (set! looks (+ looks 1))
                        (when (= looks k) (throw 'pressed)))))
    (let ((end (catch 'pressed (lambda () (thunk) 'ended) (lambda _ 'left))))
      (%set-reporter! (const #f))
      end)))

(define looks '(0 1 3 9 27))            ; 0 is none

(define (same-in-the-end? beliefs thunk)
  ;; THUNK is called with each of BELIEFS, left at one of `looks', and called again.
  (let ((ends (map (lambda (k b) (press-at k (lambda () (thunk b)))) looks beliefs)))
    (for-each thunk beliefs)
    (and (equal? '(ended left) (list-head ends 2))
         (= 1 (length (delete-duplicates (map belief-hash beliefs)))))))

(define-scenario (whoever-leaves-finds-it-as-it-was by)
  "A belief that is left by ^C while it is flown on, or while it is mended, comes to the same in the end, to the last bit, as
one that was never left: nothing is done to a tether twice, and nothing is learnt twice."
  #:for ((by 'smoother 'particles))
  (in slack-water)
  (let ((beliefs (map (lambda (k) (make-belief (current-dive) doubtful #:members 8 #:by by)) looks)))
    (move! '(6 10 -8) #:speed 0.5)
    (run 1) (pay-out! 1 #:rate 0.5)
    (run 2) (haul-in! 2 #:rate 0.5)
    (run 2)
    (expect (same-in-the-end? beliefs effective-size))
    (when (eq? by 'smoother)
      (for-each (lambda (b)
                  (observe! b 'winch-tension 0.2 #:noise 0.05)
                  (observe! b 'rov-tension 1.2 #:noise 0.05))
                beliefs)
      (expect (same-in-the-end? beliefs (lambda (b) (when (null? (assq-ref (belief-about b) 'mended)) (mend-belief! b))))))))
