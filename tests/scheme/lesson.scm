;;; The lesson language: clauses, marks, hints, faults, counters, branches, rewinds, messages, ways, errors.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight lesson)
             (bight lesson check)
             ((bight lesson file) #:select (lesson-file lesson-files))
             (bight core errors)
             ((bight dive) #:select (engine-of))
             (bight dive reel)
             ((bight engine) #:select (%hash-dive %dive-steps))
             ((bight lesson guide) #:select (at-keys? make-guide))
             ((bight lesson task) #:select (task-gauges task-set-dive task-set-time))
             ((bight lesson expert) #:select (task-at expert-flight))
             ((bight lesson report) #:select (report-lost report-tasks))
             ((bight lesson review) #:select (review-lines))
             ((bight lesson score) #:select (mark-label))
             (ice-9 exceptions)
             (srfi srfi-1))

(define small
  (world (sea (depth 20))
         (rov (named m) (at 0 5 -5))
         (tether (named line) (wet-weight 0) (from 0 0 -2) (to m) (length 12))))

(define (texts kind report)
  (filter-map (lambda (line) (and (eq? kind (second line)) (third line))) (report-said report)))

(define (mark label report)
  (second (assoc label (report-marks report))))

(define-syntax-rule (message expression)
  (guard (e ((bight-error? e) (bight-error-message e))) expression "no error"))

(define-syntax-rule (says? text expression)
  (and (string-contains (message expression) text) #t))

(define-lesson everything "One of each"
  (setting far 6 7 8)
  (in small)
  (say "It is ~a m to the anchor." (range-to '(0 0 -2)))
  (show)
  (probe "Which way is north?" (bearing-to '(0 50 -5)) #:within 25)
  (probe "Which side?" 'left #:choices (left right))
  (branch ((eq? 'right (last-answer)) (say "right"))
          (else (say "left")))
  (repeat 2 (when #t (say "again")))
  (fork-and-show "Watch." (drive! #:surge 1) (run 3))
  (task "Go ahead."
        (first (count! 'begun))
        (done-when (> (y (rov-position)) (setting 'far)))
        (hint-after 1 "Ahead.")
        (hint-after 500 "Never heard.")
        (fault-after 0.5 "A gust." (current! 0.1 90))
        (at-most 30))
  (task "Stay." (done-when (< (rov-speed) 0.01)) (held-for 2) (at-most 30))
  (count fast (> (rov-speed) 0.05))
  (tender "Pays out when told." (run-until (lambda () (told 'tender))) (pay-out! 3) (run 1000))
  (score (slack 0.1 0.6)
         ((counter 'fast) 1 1 #:by end #:as "fast")
         (tether-length 15 15 #:by most #:over 3)
         (rov-depth 4.9 5.1 #:by mean))
  (pilot expert "Goes and stays."
    (answers (truth choices) truth)
    (flies (drive! #:surge 0.5) (tell! 'tender "three metres"))
    (flies (release!)))
  (pilot lost "Goes nowhere."
    (answers (truth choices) (if choices 'right 120))))

(define-scenario a-lesson-is-flown-by-its-pilot
  "Steps in order, marks, hints, faults, settings, counters, the tender and messages."
  (let ((report (run-lesson 'everything)))
    (expect (report-passed? report))
    (expect (report-total report) is (above 99))
    (expect (texts 'say report) => '("It is 5.83 m to the anchor." "left" "again" "again" "Watch."))
    (expect (texts 'hint report) => '("Ahead."))
    (expect (texts 'fault report) => '("A gust."))
    (expect (texts 'message report) => '("to the tender: three metres"))
    (expect (report-hints report) => 1)
    (expect (mark "tether out, m" report) is (above 0.99))
    (expect (mark "fast" report) => 1)))

(define (end-of flown)
  "Return the hash of the dive at the end of FLOWN, as `expert-flight' returns it."
  (wind! (car flown) (reel-length (car flown)))
  (%hash-dive (engine-of (reel-dive (car flown)))))

(define-scenario what-was-right-is-flown-again
  "The expert's flight of a task, from where a pupil began it: of his own flight it is the same to the last bit, faults,
hints, tender and counters among it; a pupil's dive stays as it was; who has no expert gets none."
  (for-each
   (lambda (seed)
     (let* ((report (run-lesson 'everything #:seed seed)) (again (map (lambda (set) (expert-flight report set)) (report-tasks report))))
       (expect (map cdr again) => '((done) (done)))
       (expect (end-of (first again)) => (report-hash report))
       (expect (+ (task-set-time (second (report-tasks report))) (* 1/60 (reel-length (car (second again)))))
               is (about (task-set-time (first (report-tasks report)))))))
   '(1 2))
  (let* ((report (run-lesson 'everything #:pilot 'lost)) (lost (find (lambda (l) (equal? "task 1" (mark-label (first l)))) (report-lost report)))
         (set (task-at report (second lost) (third lost))) (flown (expert-flight report set)))
    (expect (length (report-tasks report)) => 1)
    (expect (cdr flown) => '(done))
    (expect (%hash-dive (engine-of (task-set-dive set))) => (report-hash report))
    (expect (%dive-steps (engine-of (reel-dive (car flown)))) => 0)
    (expect (cdr (expert-flight report set #:limit (const #t))) => #f)
    (expect (reel-length (car (expert-flight report set #:limit (const #t)))) => 1)
    (expect (task-at report (second lost) -1) => #f))
  (let ((report (run-lesson (define-lesson alone "x" (in small) (task "t" (done-when #f) (at-most 1)) (pilot idle "x")) #:pilot 'idle)))
    (expect (expert-flight report (first (report-tasks report))) => #f)))

(define-lesson told "What is told, and to whom"
  (in small)
  (gauge "depth" (rov-depth))
  (gauge "side" (if (> (x (rov-position)) 100) "east" #f))
  (task "Wait."
        (hint-after 1 "Go on." "(run 5)")
        (done-when (begin (set! gauges (task-gauges)) #f)) (at-most 2))
  (pilot idle "Waits."))

(define gauges #f)

(define-scenario forms-are-told-to-who-types
  "A hint's forms are told to a pupil who types them, not to one at the keys; a gauge tells a number, or nothing."
  (expect (texts 'hint (run-lesson 'told #:pilot 'idle)) => '("Go on.  (run 5)"))
  (expect (map car gauges) => '("depth"))
  (expect (cdar gauges) is (about 5 #:within 0.5))
  (expect (parameterize ((at-keys? #t)) (texts 'hint (run-lesson 'told #:pilot 'idle))) => '("Go on.")))

(define-scenario one-who-does-nothing-fails
  "A task that is not done in time ends the flight; what was never begun is no mark."
  (let ((report (run-lesson 'everything #:pilot 'lost)))
    (expect (report-passed? report) => #f)
    (expect (mark "question 1" report) => 0)
    (expect (string-contains (report-text report) "Which way is north?"))
    (expect (mark "question 2" report) => 0)
    (expect (mark "task 1" report) => 0)
    (expect (mark "task 2" report) => 0)
    (expect (member "right" (texts 'say report)))
    (expect (texts 'failed report) => '("Time is up."))))

(define-scenario a-lesson-is-deterministic
  "The same seed gives the same bits; levels change the settings."
  (expect (report-hash (run-lesson 'everything #:seed 3)) => (report-hash (run-lesson 'everything #:seed 3)))
  (expect (texts 'done (run-lesson 'everything #:level 'hard)) => '("Done." "Done."))
  (expect (texts 'hint (run-lesson 'everything #:level 'hard)) => '())
  (expect (run-lesson 'everything #:level 'harder) raises)
  (expect (run-lesson 'everythng) raises name)
  (expect (report? (run-lesson 'one-pile #:pilot 'careless)))
  (expect (run-lesson 'everything #:pilot 'exprt) raises name))

(define-scenario jitter-is-seeded
  "Random numbers come from the seed, within what is asked, and spread."
  (let ((draw (lambda (seed)
                (let ((drawn '()))
                  (run-lesson
                   (define-lesson chance "x" (in small)
                     (set-up (set! drawn (map (lambda (i) (jitter 10)) (iota 200))))
                     (pilot expert "x"))
                   #:seed seed)
                  drawn))))
    (expect (draw 1) => (draw 1))
    (expect (not (equal? (draw 1) (draw 2))))
    (expect (and-map (lambda (x) (<= -10 x 10)) (draw 5)))
    (expect (abs (/ (apply + (draw 5)) 200)) is (below 1.5))
    (expect (count (lambda (x) (> x 5)) (draw 5)) is (between 30 70))
    (expect (jitter 10) => 0)))

(define-scenario lessons-have-numbers
  "A lesson is found by its name or its number; who gives one that is not there is told which are."
  (expect (lesson-file "7") => (lesson-file "which-side-of-the-leg"))
  (expect (says? (simple-format #f "from 1 to ~a, not 99" (length (lesson-files))) (lesson-file "99")))
  (expect (says? "did you mean" (lesson-file "one-pille"))))

(define-scenario mistakes-teach
  "An unknown clause lists those there are and the nearest; a wrong one is shown how it is written."
  (expect (says? "did you mean (say \"text\" VALUE ...)" (define-lesson a "x" (sya "hello"))))
  (expect (says? "fork-and-show" (define-lesson a "x" (sya "hello"))))
  (expect (says? "did you mean (done-when E)" (define-lesson a "x" (task "t" (done-wen #t)))))
  (expect (says? "hint-after" (define-lesson a "x" (task "t" (hint 3 "x")))))
  (expect (says? "did you mean (flies FORM ...)" (define-lesson a "x" (pilot p "x" (fles 1)))))
  (expect (says? "say (say \"text\" VALUE ...)" (define-lesson a "x" (say hello))))
  (expect (says? "say (in WORLD)" (define-lesson a "x" (in))))
  (expect (says? "inside" (define-lesson a "x" (when #t (insde small)))) => #f)
  (expect (says? "has no clause `insde'" (define-lesson a "x" (when #t (insde small)))))
  (expect (says? "has no clause `insde'" (define-lesson a "x" (branch (#t (insde small))))))
  (expect (says? "three values" (define-lesson a "x" (setting u 1 2))))
  (expect (says? "N above 0" (define-lesson a "x" (probe "How far?" 3 #:within 0))))
  (expect (says? "N above 0" (define-lesson a "x" (when #t (probe "How far?" 3 #:ratio -1)))))
  (expect (says? "above 0" (run-lesson (define-lesson a "x" (probe "How far?" 3 #:within (- 1 1))
                                         (pilot expert "x")))))
  (expect (says? "whole number" (define-lesson a "x" (message-limit 1.5))))
  (expect (says? "say (hides VERB ...)" (define-lesson a "x" (hides))))
  (expect (says? "from 1 to 4" (define-lesson a "x" (grade 5))))
  (expect (says? "did you mean `slack'" (define-lesson a "x" (trains slak))))
  (expect (says? "did you mean `route'" (define-lesson a "x" (needs bow roue))))
  (expect (says? "say (yours VEHICLE TETHER)" (define-lesson a "x" (yours m))))
  (expect (says? "#:why of slack is a text" (run-lesson (define-lesson a "x" (in small) (score (slack 0 1 #:why 3))
                                                         (pilot expert "x")))))
  (expect (says? "say (define-lesson" (define-lesson "x")))
  (expect (says? "has no way of judging" (run-lesson (define-lesson a "x" (in small) (score (slack 0 1 #:by alwys))
                                          (pilot expert "x")))))
  (expect (says? "say (in WORLD) before" (run-lesson (define-lesson a "x" (task "t" (done-when #t))
                                                       (pilot expert "x")))))
  (expect (says? "has no setting `v'" (run-lesson (define-lesson a "x" (setting u 1 2 3) (set-up (setting 'v))
                                                    (pilot expert "x"))))))

(define-scenario checking-finds-what-is-wrong
  "Each thing that --check proves has a lesson that it refuses."
  (let ((wrong? (lambda (text lesson)
                  (any (lambda (line) (string-contains line text)) (check-lesson lesson)))))
    (expect (check-lesson (find (lambda (l) (eq? 'everything (lesson-name l))) (lesson-list)))
            => '("nobody can hear the hint: Never heard."))
    (expect (wrong? "does not pass"
                    (define-lesson bad "x" (in small) (task "t" (done-when #f) (at-most 1)) (pilot expert "x"))))
    (expect (wrong? "its careless pilot passes it"
                    (define-lesson bad "x" (in small) (task "t" (done-when (> (now) 1)) (at-most 3))
                      (pilot expert "x") (pilot careless "x"))))
    (expect (wrong? "careless"
                    (define-lesson good "x" (in small)
                      (task "t" (done-when (> (abs (rov-speed)) 0.05)) (at-most 5))
                      (pilot expert "x" (flies (drive! #:surge 1))) (pilot careless "x")))
            => #f)
    (expect (wrong? "its pilot expert does not pass it"
                    (define-lesson bad "x" (in small)
                      (task "t" (done-when (> (abs (rov-speed)) 0.05)) (at-most 5))
                      (pilot demonstration "x" (flies (drive! #:surge 1))) (pilot expert "x"))))
    (expect (wrong? "its pilot hasty breaks down (seed 1): "
                    (define-lesson bad "x" (in small) (task "t" (done-when (> (now) 1)) (at-most 3))
                      (pilot expert "x") (pilot hasty "x" (flies (run -1))))))
    (expect (wrong? "doing nothing"
                    (define-lesson bad "x" (in small) (task "t" (done-when #t)) (task "u" (done-when #t))
                      (pilot expert "x"))))
    (expect (wrong? "see what it hides from the pupil: slack"
                    (define-lesson bad "x" (hides turns slack) (in small)
                      (task "t" (done-when (> (now) 1)) (at-most 5))
                      (pilot expert "x" (flies (if (> (slack) 0) (run 2)))))))
    (expect (wrong? "asks the machine: random"
                    (define-lesson bad "x" (in small) (set-up (random 3)) (pilot expert "x"))))
    (expect (wrong? "as many: \"Go ~a m.\""
                    (define-lesson bad "x" (in small) (task "Go ~a m." (done-when (> (now) 1)) (at-most 5))
                      (pilot expert "x"))))
    (expect (wrong? "as many: \"It is ~a of ~a.\""
                    (define-lesson bad "x" (in small) (when (< (now) 0) (say "It is ~a of ~a." 1)) (pilot expert "x"))))
    (expect (wrong? "as many: \"now ~s\""
                    (define-lesson bad "x" (in small) (tender "x" (tell! 'pilot (string-append "now " "~s")))
                      (task "t" (done-when (> (now) 1)) (at-most 5)) (pilot expert "x"))))
    (expect (wrong? "as many"
                    (define-lesson good "x" (in small) (say "It is ~a, about ~ab." 1 2) (say "About ~surface.")
                      (set-up (simple-format #f "~a" 1)) (pilot expert "x")))
            => #f)
    (expect (wrong? "is told in code; say #:as \"words\" of it: (abs (net-turns))"
                    (define-lesson bad "x" (in small) (score (max-tension 0 60) ((abs (net-turns)) 0 1)) (pilot expert "x"))))
    (expect (wrong? "told in code"
                    (define-lesson good "x" (in small) (score (max-tension 0 60) ((abs (net-turns)) 0 1 #:as "turns"))
                      (pilot expert "x")))
            => #f)
    (let ((n 0))
      (expect (wrong? "the same"
                      (define-lesson bad "x" (in small) (set-up (set! n (+ n 1)) (run n)) (pilot expert "x")))))))

(define-scenario a-lost-mark-is-explained
  "A row has a name that people read; who lost its mark is told what he should have known, and nobody else."
  (let ((told (lambda (high)
                (report-text
                 (run-lesson (define-lesson explained "x" (in small)
                               (task "t" (done-when (> (now) 1)) (at-most 5))
                               (score (tether-length 0 high #:by most #:as "tether out, m" #:why "Less is more."))
                               (pilot expert "x")))))))
    (expect (string-contains (told 20) "tether out, m"))
    (expect (string-contains (told 20) "Less is more.") => #f)
    (expect (string-contains (told 5) "Less is more."))
    ;; A small terminal shows the end.
    (expect (string-contains (last (string-split (told 20) #\newline)) "s under water, 0 hints, 0 steps back"))))

(define-syntax-rule (told-of row)
  ;; What a pupil reads of ROW, of a score over a second at a depth of 5 m: its name, and how it came about.
  (let ((mark (last (report-marks (run-lesson (define-lesson told "x" (in small)
                                                (task "t" (done-when (> (now) 1)) (at-most 5))
                                                (score row)
                                                (pilot expert "x")))))))
    (string-append (first mark) ": " (fourth mark))))

(define-scenario marks-are-told-in-words
  "Plain words for a measure that has no name of its own, and for each way of judging what was, and what was asked, as its
author wrote it; a value that just misses is told from what was asked."
  (expect (told-of (rov-depth 0 60 #:by most)) => "depth, m: up to 5.00; at most 60 was asked")
  (expect (told-of (rov-depth 4.5 +inf.0 #:by least)) => "depth, m: down to 5.00; at least 4.5 was asked")
  (expect (told-of (rov-depth 3 4 #:by end)) => "depth, m: 5.00 at the end; 3 to 4 was asked")
  (expect (told-of ((- (rov-depth)) 0 4 #:by mean #:as "height, m")) => "height, m: -5.00 on average; 0 to 4 was asked")
  (expect (told-of (rov-depth 2 2 #:by rms)) => "depth, m: 5.00 as root mean square; 2 was asked")
  (expect (told-of (rov-depth 0 4 #:share 0.8)) => "depth, m: at most 4 for 0 % of the time; 80 % was asked")
  (expect (told-of ((null? (contacts)) 1 1 #:share 0.9 #:as "tether on nothing"))
          => "tether on nothing: right for 100 % of the time; 90 % was asked")
  (expect (told-of (rov-depth 0 4.999 #:by most)) => "depth, m: up to 5.0000; at most 4.999 was asked"))

(define pair-at-work
  (extend small
          (rov (named other) (at 5 5 -5))
          (tether (named other-line) (wet-weight 0) (from 5 0 -2) (to other) (length 12))))

(define-scenario a-coach-does-not-tell-what-is-hidden
  "He who runs into the end of his tether is told so, unless the lesson hides where it lies."
  (let ((coached (lambda (lesson) (length (report-coached (run-lesson lesson #:pilot 'hasty #:coached #t))))))
    (expect (coached (define-lesson open "x" (in small)
                       (task "t" (done-when #f) (at-most 30))
                       (pilot hasty "x" (flies (drive! #:surge 1)))))
            is (above 0))
    (expect (coached (define-lesson closed "x" (hides look) (in small)
                       (task "t" (done-when #f) (at-most 30))
                       (pilot hasty "x" (flies (drive! #:surge 1)))))
            => 0)))

(define-scenario a-lesson-among-several-vehicles
  "The verbs of a lesson that says which are the pupil's own mean those; the others are flown by name."
  (let* ((flies (lambda (lesson) (texts 'say (run-lesson lesson))))
         (lesson (define-lesson several "x" (yours m line) (in pair-at-work)
                   (task "Ahead." (done-when (> (y (rov-position)) 6)) (at-most 20))
                   (say "~a ~a" (round (x (rov-position))) (round (x (rov-position 'other))))
                   (tender "Flies the other." (drive! 'other #:sway 0.5) (run 100))
                   (pilot expert "x" (flies (drive! #:surge 0.5))))))
    (expect (flies lesson) is (lambda (said) (string-prefix? "0" (car said))))
    (expect (report-passed? (run-lesson lesson)))
    (expect (begin (enter! pair-at-work) (rov-position)) raises name)))

(define-lesson few-words "Messages between pilot and tender"
  (message-limit 2)
  (hides slack)
  (in small)
  (task "Ask for tether."
        (first (count! 'read 0))
        (done-when (> (now) 4)))
  (probe "Tender: how many messages?" (- 2 (messages-left)) #:within 0.5 #:answer (counter 'read))
  (tender "Counts what it is told, and answers."
    (let listen ()
      (run-until (lambda () (told 'tender)))
      (count! 'read)
      (tell! 'pilot "Heard.")
      (listen)))
  (pilot expert "Says little."
    (flies (tell! 'tender "one") (run 1) (tell! 'tender "two")))
  (pilot chatty "Says much."
    (flies (every 0.5 (count! 'sent (if (tell! 'tender "more") 1 0))))))

(define-scenario messages-are-limited
  "A message beyond the limit is not sent; the tender's answers are free, and the pupil hears them."
  (let ((expert (run-lesson 'few-words)) (chatty (run-lesson 'few-words #:pilot 'chatty)))
    (expect (length (texts 'message expert)) => 4)
    (expect (length (texts 'message chatty)) => 4)
    (expect (member "Heard." (texts 'message expert)))
    (expect (texts 'fault expert) => '())
    (expect (length (texts 'fault chatty)) is (above 4))
    (expect (mark "question 1" chatty) => 1))
  (expect (messages-left) raises def)
  (expect (number-in "give 5.5 metres") => 5.5)
  (expect (number-in "give 1e300000 or 3") => 3)
  (expect (number-in "more") => #f))

(define-scenario the-way-in-is-known-on-the-way-out
  "How far the vehicle is from the way it took in an earlier task, and its root mean square."
  (let* ((lesson (define-lesson out-and-back "x" (in small)
                   (task "North." (done-when (> (y (rov-position)) 8)) (fail-when (> (off-here) 0) "No."))
                   (task "Home, two metres east." (done-when (< (y (rov-position)) 5.5)) (at-most 30))
                   (score ((off-the-way 1) 0 0 #:by rms #:over 4)
                          ((off-the-way 1) 2 2 #:by most #:over 4))
                   (pilot expert "x"
                     (flies (drive! #:surge 0.5))
                     (flies (place! '(2 8 -5)) (drive! #:surge -0.5)))))
         (report (take-lesson lesson (scripted-guide (pilot-named lesson 'expert)))))
    (expect (second (third (report-marks report))) is (about 0.5 #:within 0.01))
    (expect (second (fourth (report-marks report))) is (about 1 #:within 0.01))))

(define (off-here)
  ;; The way of a task that is going on is nobody's way back.
  (guard (e ((bight-error? e) 0)) (off-the-way 1)))

(define (stubborn answers)
  ;; A guide of one who flies ahead, and when he fails chooses what ANSWERS say in turn.
  (let ((left answers))
    (make-guide (const #t) (const #t) (lambda (question truth choices) truth)
                (lambda (n seconds) (drive! #:surge 1) (run seconds))
                (lambda (text)
                  (if (null? left)
                      'end
                      (let ((answer (car left)))
                        (set! left (cdr left))
                        answer)))
                #t)))

(define-scenario going-back-is-exact
  "After a failure the pupil may go back ten seconds or begin again; the dive and the marks go back too."
  (let* ((lesson (define-lesson taut "x" (in small)
                   (task "Do not come taut." (done-when #f) (fail-when (taut?) "Taut.") (at-most 100))
                   (score (slack 0 1 #:by least))
                   (pilot expert "x")))
         (none (take-lesson lesson (stubborn '())))
         (back (take-lesson lesson (stubborn '(back again))))
         (failures (lambda (r) (filter (lambda (line) (eq? 'failed (second line))) (report-said r)))))
    (expect (report-rewinds none) => 0)
    (expect (report-rewinds back) => 2)
    (expect (map car (failures back)) => (make-list 3 (car (first (failures none)))))
    (expect (report-hash back) => (report-hash none))
    (expect (mark "slack, of 1" back) => (mark "slack, of 1" none))))

(define-scenario the-coach-is-sparing
  "At most six utterances in fifteen minutes, ten seconds apart, none twice, fewer for the able, each with
its reason."
  (in small)
  (let* ((coach (make-coach)) (able (make-coach #:competence 0.9)))
    (current! 0.3 0)
    (every 1 (coach-looks! coach))
    (every 1 (coach-looks! able))
    (drive! #:surge 1)
    (run 40)
    (drive! #:yaw 0.5)
    (run 60)
    (drive! #:surge -0.2 #:yaw 0)
    (run 200)
    (let* ((said (coach-log coach)) (times (map first said)))
      (expect (length said) is (between 2 6))
      (expect (and-map (lambda (gap) (>= gap 10)) (map - (cdr times) times)))
      (expect (length (delete-duplicates (map second said))) => (length said))
      (expect (and-map (lambda (line) (assq (second line) (coach-rules))) said)))
    (expect (length (coach-log able)) is (below (length (coach-log coach))))
    (expect (and-map (lambda (line) (= 3 (second (assq (second line) (coach-rules))))) (coach-log able)))))

(define-scenario the-coach-is-off-in-tests
  "A lesson flown by a pilot is coached only when that is asked for."
  (expect (report-coached (run-lesson 'everything)) => '())
  (expect (texts 'coach (run-lesson 'everything)) => '()))

(define-lesson loses-marks "Marks lost in two dives"
  (in small)
  (set-up (drive! #:surge 0.2) (run 2))
  (probe "What is one and one?" 2 #:within 1)
  (task "Wait a little." (done-when (> (now) 7)))
  (in small)
  (task "And again." (at-most 3))
  (score (rov-depth 0 5.01 #:by most) (net-turns -1 1))
  (pilot careless "Answers wrong, dives and comes up."
         (answers (truth choices) 5)
         (flies (hold-depth! 6) (run 3) (hold-depth! 5) (run 9))
         (flies (run 3))))

(define-scenario lost-marks-lie-where-they-were-lost
  "A wrong answer where it was given, a task not done where it ended, a measure where it lay farthest outside, each in its own
dive; what was right is not among them; and the flight of each is watched up to there."
  (let* ((report (run-lesson 'loses-marks #:pilot 'careless))
         (lost (report-lost report)) (dives (map second lost)) (times (map third lost)))
    (expect (map (lambda (entry) (mark-label (first entry))) lost) => '("question 1" "task 2" "depth, m"))
    (expect (list-ref times 0) => 2.0)
    (expect (list-ref times 1) is (about 3 #:within 0.25))
    (expect (list-ref times 2) is (between 3 7))
    (expect (map (lambda (dive) (eq? dive (first dives))) dives) => '(#t #f #t))
    (let* ((reel (flight-reel (last dives))) (place (inexact->exact (round (* 60 (last times))))))
      (define (depth-at place)
        (wind! reel place)
        (with-dive (reel-dive reel) (rov-depth)))
      (let ((worst (depth-at place)))
        (expect worst is (above 5.01))
        (expect (apply max (map depth-at (iota 14 30 30))) is (about worst #:within 1e-9))))
    (expect (any (lambda (line) (string-contains line "2  3.00 s  task 2: not done in time")) (review-lines lost)))))
