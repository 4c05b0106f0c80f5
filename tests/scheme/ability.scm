;;; What is believed of pupils and lessons, against pupils made by the model, whose truth is known; what is
;;; proposed to them; records merged.  No person was measured.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight lesson ability)
             (bight lesson path)
             (bight lesson logbook)
             ((bight lesson log) #:select (logged-results why-no-record))
             ((bight core sqlite) #:select (there?))
             (ice-9 format)
             (srfi srfi-1)
             ((srfi srfi-19) #:select (make-time time-utc)))
(primitive-load (string-append (dirname (dirname (current-filename))) "/other-logbook.scm"))

(define skills-of-lesson '((a) (a) (b) (a b) (c) (b c) (a) (c) (a c) (b) (a b c) (c)))

(define (normal dice) (random:normal dice))

(define (outcome-of distance dice)
  ;; An outcome by the model's own chances.
  (let loop ((k 0) (left (random 1.0 dice)))
    (let ((p (grade-chance k distance)))
      (if (or (= k 3) (< left p)) k (loop (+ k 1) (- left p))))))

(define (priors)
  (map (lambda (i) (lesson-prior (+ 1 (modulo i 4)) 'normal)) (iota (length skills-of-lesson))))

(define (drawn belief dice)
  (+ (belief-mean belief) (* (belief-deviation belief) (normal dice))))

(define (mean values) (/ (apply + values) (length values)))

(define (take-all truths difficulties beliefs lessons dice)
  ;; A pupil of abilities TRUTHS takes every lesson: his abilities, and the beliefs of him and of LESSONS.
  (let loop ((i 0) (truths truths) (beliefs beliefs) (lessons lessons))
    (if (= i (length skills-of-lesson))
        (values truths beliefs lessons)
        (let* ((trained (list-ref skills-of-lesson i))
               (distance (- (mean (map (lambda (s) (assq-ref truths s)) trained)) (list-ref difficulties i)))
               (outcome (outcome-of distance dice)))
          (call-with-values
              (lambda ()
                (learn outcome (map (lambda (s) (assq-ref beliefs s)) trained) (list-ref lessons i)))
            (lambda (new lesson)
              (define (with-new old values)
                (fold (lambda (s v all) (acons s v (alist-delete s all))) old trained values))
              (loop (+ i 1)
                    (with-new truths
                              (map (lambda (s) (+ (assq-ref truths s) 0.1 (* (sqrt 0.02) (normal dice)))) trained))
                    (with-new beliefs new)
                    (append (take lessons i) (list lesson) (drop lessons (+ i 1))))))))))

(define (simulate pupils seed)
  ;; Pairs of what was true and what was believed in the end: of abilities, and of difficulties.
  (let* ((dice (seed->random-state seed))
         (difficulties (map (lambda (b) (drawn b dice)) (priors))))
    (let loop ((n pupils) (lessons (priors)) (known '()))
      (if (zero? n)
          (values known (map cons difficulties lessons))
          (let ((truths (map (lambda (s) (cons s (drawn skill-prior dice))) '(a b c))))
            (call-with-values
                (lambda ()
                  (take-all truths difficulties (map (lambda (s) (cons s skill-prior)) '(a b c)) lessons dice))
              (lambda (truths beliefs lessons)
                (loop (- n 1) lessons
                      (append (map (lambda (t) (cons (cdr t) (assq-ref beliefs (car t)))) truths) known)))))))))

(define (within? pair)
  (let ((interval (belief-interval (cdr pair))))
    (<= (first interval) (car pair) (second interval))))

(define (share pairs) (exact->inexact (/ (count within? pairs) (length pairs))))

(define (miss pairs)
  ;; Root mean square of what was believed less what was true.
  (sqrt (mean (map (lambda (p) (expt (- (belief-mean (cdr p)) (car p)) 2)) pairs))))

(define (deviation pairs) (sqrt (mean (map (lambda (p) (belief-variance (cdr p))) pairs))))

(define-scenario beliefs-hold-the-truth
  "Nine of ten intervals of 90 % hold the true ability and the true difficulty, and are much narrower than
before; how far off beliefs are is what they say."
  (let ((abilities '()) (difficulties '()))
    (for-each (lambda (seed)
                (call-with-values (lambda () (simulate 60 seed))
                  (lambda (a d)
                    (set! abilities (append a abilities))
                    (set! difficulties (append d difficulties)))))
              (iota 8 1))
    (format #t "~a abilities: ~,3f inside, off ~,3f, said ~,3f; ~a difficulties: ~,3f inside, off ~,3f, said ~,3f\n"
            (length abilities) (share abilities) (miss abilities) (deviation abilities)
            (length difficulties) (share difficulties) (miss difficulties) (deviation difficulties))
    (expect (share abilities) is (between 0.87 0.93))
    (expect (share difficulties) is (between 0.83 0.97))
    (expect (miss abilities) is (below 0.72))
    (expect (miss difficulties) is (below 0.3))
    (expect (/ (miss abilities) (deviation abilities)) is (between 0.9 1.1))))


;;; The path.

(define places
  (list (make-place 'bows "Bows" 1 '(bow) '())
        (make-place 'ways "Ways" 1 '(route) '(bow))
        (make-place 'piles "Piles" 2 '(route) '(route))
        (make-place 'tides "Tides" 3 '(tide) '(route))))

(define (result name total . level)
  `((when . "2026-01-01T00:00:00Z") (who . "ann") (lesson . ,name) (total . ,total) (passed? . ,(>= total 70))
    (level . ,(if (null? level) 'normal (car level)))))

(define (proposed . results)
  (let ((chosen (proposal (beliefs-from results places) "ann" results places)))
    (list (place-name (first chosen)) (second chosen) (fourth chosen))))

(define-scenario what-comes-next
  "The lowest grade whose needs were shown; what was failed badly comes again, easier; in the end all over."
  (expect (proposed) => '(bows normal new))
  (expect (proposed (result 'bows 80)) => '(ways normal new))
  (expect (proposed (result 'bows 80 'easy)) => '(bows normal new))
  (expect (proposed (result 'bows 80) (result 'ways 80)) => '(piles normal new))
  (expect (proposed (result 'bows 80) (result 'ways 20) (result 'ways 20) (result 'ways 20)) => '(ways easy new))
  (expect (proposed (result 'tides 80) (result 'bows 80) (result 'ways 80) (result 'piles 80))
          is (lambda (p) (equal? '(hard again) (cdr p)))))

(define-scenario what-is-believed-depends-on-results-alone
  "Not on the order in which they were written; others' results move a lesson's difficulty, not one's skill."
  (let* ((results (map (lambda (r minute)
                         (acons 'when (simple-format #f "2026-01-01T00:0~a:00Z" minute) (cdr r)))
                       (list (result 'bows 40) (result 'bows 90) (result 'ways 75)) '(1 2 3)))
         (mean (lambda (results who) (belief-mean (skill-belief (beliefs-from results places) who 'bow)))))
    (expect (mean results "ann") => (mean (reverse results) "ann"))
    (expect (mean (list (result 'bows 90)) "ann") is (above 0))
    (expect (mean results "bob") => 0.0)
    (expect (mean (list (result 'bows 20)) "ann") is (below 0))))

(define-scenario a-reason-is-given
  "What it trains and needs, in which lesson that was shown, the chance, and the command."
  (let* ((results (list (result 'bows 80)))
         (text (string-join (proposal-lines (proposal (beliefs-from results places) "ann" results places)
                                            results places)
                            "\n")))
    (for-each (lambda (words) (expect (number? (string-contains text words))))
              '("trains route" "needs bow, which you showed in bows" "not taken it yet" "chance of passing"
                "bight lesson ways"))))


;;; Records from several machines.

(define (all-that-is-said)
  (sort (map (lambda (e) (simple-format #f "~s" (list (log-entry-kind e) (log-entry-when e) (log-entry-trainee e)
                                                      (log-entry-what e) (log-entry-score e) (log-entry-data e))))
             (logbook))
        string<?))

(define-scenario records-are-merged
  "In either order, and again: the same entries; an entry that both have is there once."
  (unless there? (skip "built without SQLite"))
  (let ((file (lambda (name) (scratch-file (string-append name ".db")))))
    (for-each (lambda (name who)
                (with-logbook (file name)
                  (log-lesson! 'one-pile #:trainee who #:score 80)
                  (log-lesson! 'wrong-side #:trainee who #:data '((lesson . wrong-side)))))
              '("a" "b") '("ann" "bob"))
    (let* ((merge (lambda (into . from)
                    (with-logbook (file into)
                      (let ((n (map (lambda (name) (merge-logbook! (file name))) from)))
                        (list n (all-that-is-said))))))
           (ab (merge "ab" "a" "b" "a"))
           (ba (merge "ba" "b" "a")))
      (expect (first ab) => '(2 2 0))
      (expect (first ba) => '(2 2))
      (expect (second ab) => (second ba))
      (expect (second (merge "ab" "ba")) => (second ab))
      (expect (with-logbook (file "ab") (merge-logbook! (file "nobody"))) raises io)
      (expect (with-logbook (file "ab") (entries-ahead)) => 0)
      (expect (with-logbook (file "ab") (entries-ahead (make-time time-utc 0 1000000000))) => 4))))

(define-scenario no-record-is-told
  "Where no logbook can be written there are no results, and a sentence says why."
  (with-logbook "/dev/null/logbook.db"
    (expect (string? (why-no-record)))
    (expect (logged-results #f) => '())))
