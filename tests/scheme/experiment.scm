;;; The experiment of section 4.2.1 of the thesis, from the words of consent to the table, with simulated pupils in
;;; the place of people.  No person was measured.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight lesson experiment)
             (bight lesson experiment-command)
             (bight lesson)
             ((bight lesson guide) #:select (make-guide))
             ((bight lesson log) #:select (logged-results))
             (bight lesson logbook)
             ((bight core sqlite) #:select (there?))
             (srfi srfi-1))
(primitive-load (string-append (dirname (dirname (current-filename))) "/other-logbook.scm"))

(define-scenario groups-are-drawn-in-blocks
  "After any multiple of three the groups are of one size, and what comes next in a block is not always the same."
  (let* ((drawn (map group-drawn (iota 90)))
         (blocks (map (lambda (i) (list-head (list-tail drawn (* 3 i)) 3)) (iota 30))))
    (for-each (lambda (block) (expect (sort block string<?) => '("none" "plan" "three"))) blocks)
    (expect (length (delete-duplicates blocks)) => 6)
    (expect (map group-drawn (iota 90)) => drawn)))

(define-scenario all-fly-the-same-test
  "Test and training are the same lessons in every group; in the test nobody sees a display."
  (let ((steps (map steps-of-experiment groups-of-experiment)))
    (expect (length (delete-duplicates (map (lambda (s) (map (lambda (step) (list-head step 2)) s)) steps))) => 1)
    (expect (delete-duplicates (append-map (lambda (s) (list (step-display (first s)) (step-display (last s)))) steps))
            => '(none))
    (expect (map (lambda (s) (step-display (second s))) steps) => '(none plan three))
    (expect (filter (lambda (step) (not (memq (step-lesson step) (lessons)))) (first steps)) => '())))

(define-scenario who-has-flown-a-step-flies-the-next
  "A result of another seed is another step; after the last there is none."
  (let* ((steps (steps-of-experiment "plan"))
         (result (lambda (step) `((who . "a") (lesson . ,(step-lesson step)) (seed . ,(step-seed step)) (total . 50)))))
    (expect (first (next-step "plan" '())) => 1)
    (expect (first (next-step "plan" (map result (list-head steps 4)))) => 5)
    (expect (first (next-step "plan" (list (result (last steps))))) => 1)
    (expect (next-step "plan" (map result steps)) => #f)))


;;; Simulated pupils.

(define truths '(("none" . 5) ("plan" . 13) ("three" . 20))) ; what training gains, of 100 marks

(define (simulate! who group dice)
  ;; Enter who takes part, and results of every step, into the logbook.
  (log-lesson! 'enrolment #:trainee who #:data (list (cons (string->symbol experiment-tag) group) '(consent . "yes")))
  (let ((before (+ 45 (* 10 (random:normal dice)))))
    (for-each
     (lambda (step)
       (let ((total (+ before (* 6 (random:normal dice)) (if (= 12 (step-seed step)) (assoc-ref truths group) 0))))
         (log-lesson! (step-lesson step) #:trainee who #:score total
                      #:data `((lesson . ,(step-lesson step)) (who . ,who) (group . ,group) (seed . ,(step-seed step))
                               (total . ,total) (passed? . ,(>= total 70)) (simulated . #t)))))
     (steps-of-experiment group))))

(define (numbers-in line)
  (filter-map (lambda (word) (string->number (string-trim-both word (char-set #\( #\)))))
              (string-tokenize line)))

(define-scenario the-table-tells-what-the-simulation-put-in
  "Ninety simulated pupils, thirty a group: the differences of gains lie in their intervals, and the table says that
nobody was measured."
  (unless there? (skip "built without SQLite"))
  (with-logbook (scratch-file "experiment.db")
    (let ((dice (seed->random-state 5)))
      (for-each (lambda (i) (simulate! (simple-format #f "p~a" i) (group-drawn i) dice)) (iota 90)))
    (let* ((lines (experiment-lines (enrolled) (logged-results #f)))
           (gains (member "Marks gained from the test before it:" lines))
           (line (lambda (start) (find (lambda (l) (string-prefix? start l)) gains)))
           (holds? (lambda (start truth)
                     (let ((n (numbers-in (line start)))) (<= (second n) truth (third n))))))
      (expect (first lines) => "90 took part, of whom 90 were simulated: of those nobody was measured.")
      (expect (length (filter (lambda (l) (number? (string-contains l "n  30"))) gains)) => 3)
      (expect (holds? "  none - plan" -8))
      (expect (holds? "  none - three" -15))
      (expect (holds? "  plan - three" -7))
      (expect (third (numbers-in (line "  none - three"))) is (below 0)))))

(define-scenario without-tests-there-is-no-table
  "Who has flown only one test is counted, and in no mean."
  (expect (experiment-lines '(("a" . "plan")) '(((who . "a") (lesson . which-side-of-the-leg) (seed . 11) (total . 40))))
          => '("1 took part." "Nobody has flown both tests yet.")))


;;; What the groups see.

(define showing (define-lesson showing "What is shown" (in pile) (show) (pilot expert "Looks.")))

(define (pictures display)
  ;; What a guide is given to show in the lesson.
  (let ((shown '()))
    (take-lesson showing
                 (make-guide (const #t) (lambda (thunk) (set! shown (cons (object->string (thunk)) shown)))
                             (const #t) (const #t) (const 'end) #f)
                 #:display display)
    shown))

(define-scenario a-group-sees-what-it-may
  "Both panels, the view from above alone, nothing."
  (let ((has? (lambda (display words) (number? (string-contains (string-join (pictures display)) words)))))
    (expect (map (lambda (d) (has? d "from above")) '(three plan none)) => '(#t #t #f))
    (expect (map (lambda (d) (has? d "from the side")) '(three plan none)) => '(#t #f #f))))
