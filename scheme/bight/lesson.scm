;;; (bight lesson) --- lessons: what to read, to answer and to fly, as plain files anybody can write.
;;;
;;; `define-lesson' turns clauses, whose heads are matched by datum, into steps that run in order; what is
;;; to happen is in (bight lesson-play), how it is marked in (bight lesson-score).  A lesson runs three
;;; ways, by who stands behind its guide: a person, (bight lesson-terminal); a scripted pilot of the
;;; lesson's own, here; a test, which is a scripted pilot whose report is looked at.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson)
  #:use-module (bight checkpoint)
  #:use-module (bight coach)
  #:use-module (bight dive)
  #:use-module (bight errors)
  #:use-module (bight lesson-play)
  #:use-module (bight lesson-score)
  #:use-module (bight lesson-tally)
  #:use-module (bight pilot)
  #:use-module (bight record)
  #:use-module (bight time)
  #:use-module (bight verb)
  #:use-module ((bight expect) #:select (code->string source-location location->string))
  #:use-module ((bight scenario) #:select (world-of))
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:re-export (last-answer counter count! setting jitter tell! told messages)
  #:export (define-lesson
            run-lesson
            lesson-list
            lesson? lesson-name lesson-title lesson-code lesson-pilots lesson-location
            report? report-who report-seed report-level report-total report-passed? report-marks
            report-said report-text report-hash report-coached report-hints report-rewinds report-seconds
            ;; For those who run lessons.
            collect-lessons take-lesson scripted-guide pilot-named
            ;; What the macro expands to.
            register-lesson! unknown-clause malformed-clause malformed-lesson))


;;; Lessons, and where they are kept.

(define-record <lesson>
  (make-lesson name title code location declarations steps)
  lesson?
  (name lesson-name)
  (title lesson-title)
  (code lesson-code)                    ; its clauses, as data
  (location lesson-location)            ; (FILE . LINE) or #f
  (declarations lesson-declarations)    ; lists (KIND VALUE ...)
  (steps lesson-steps))                 ; a thunk

(set-record-type-printer! <lesson>
  (lambda (lesson port)
    (simple-format port "#<lesson ~a: ~a>" (lesson-name lesson) (lesson-title lesson))))

(define current-shelf (make-parameter (make-variable '())))

(define-verb (lesson-list)
  "Return the lessons defined so far, in order."
  (reverse (variable-ref (current-shelf))))

(define (collect-lessons thunk)
  "Call THUNK and return the lessons it defines, in order."
  (parameterize ((current-shelf (make-variable '())))
    (thunk)
    (lesson-list)))

(define (register-lesson! name title code location declarations steps)
  (let ((lesson (make-lesson name title code location declarations steps)))
    (check-settings lesson)
    (variable-set! (current-shelf)
                   (cons lesson (remove (lambda (l) (eq? name (lesson-name l)))
                                        (variable-ref (current-shelf)))))
    lesson))

(define (declared kind lesson)
  (filter-map (lambda (d) (and (eq? kind (car d)) (cdr d))) (lesson-declarations lesson)))

(define (check-settings lesson)
  (for-each (lambda (s)
              (unless (= 3 (length (cdr s)))
                (bight-raise 'def 'define-lesson "(setting ~a EASY NORMAL HARD) needs three values, not ~a"
                             (car s) (length (cdr s)))))
            (declared 'setting lesson)))


;;; Errors that teach.

(define lesson-clauses
  '((in "(in WORLD)")
    (say "(say \"text\" VALUE ...)")
    (show "(show) or (show EXPRESSION)")
    (probe "(probe \"question\" TRUTH #:within N) or (probe \"question\" TRUTH #:choices (A B ...))")
    (task "(task \"text\" (done-when E) ...)")
    (branch "(branch (E CLAUSE ...) ... (else CLAUSE ...))")
    (when "(when E CLAUSE ...)")
    (repeat "(repeat N CLAUSE ...)")
    (fork-and-show "(fork-and-show \"text\" FORM ...)")
    (set-up "(set-up FORM ...)")
    (score "(score (MEASURE LOW HIGH #:by WAY #:share S #:over W #:weight W) ...)")
    (count "(count NAME E)")
    (setting "(setting NAME EASY NORMAL HARD)")
    (pilot "(pilot NAME \"sentence\" (answers (TRUTH CHOICES) E) (flies FORM ...) ...)")
    (tender "(tender \"sentence\" FORM ...)")))

(define task-clauses
  '((done-when "(done-when E)")
    (hint-after "(hint-after SECONDS \"text\")")
    (fail-when "(fail-when E \"text\")")
    (at-most "(at-most SECONDS)")
    (held-for "(held-for SECONDS)")
    (first "(first FORM ...)")
    (fault-after "(fault-after SECONDS \"text\" FORM ...)")
    (fault-when "(fault-when E \"text\" FORM ...)")))

(define pilot-clauses
  '((answers "(answers (TRUTH CHOICES) E)")
    (flies "(flies FORM ...)")))

(define (place location)
  (if location (string-append (location->string location) ": ") ""))

(define (known-clauses where)
  (case where
    ((task) task-clauses)
    ((pilot) pilot-clauses)
    (else lesson-clauses)))

(define (unknown-clause where head location)
  "Raise the error about the clause HEAD, which WHERE (lesson, task, pilot) does not have."
  (let* ((all (map car (known-clauses where)))
         (near (nearest head all)))
    (bight-raise 'name 'define-lesson "~aa ~a has no clause `~a'; it has ~a~a" (place location) where head
                 (words->string all)
                 (if near
                     (string-append "; did you mean " (car (assq-ref (known-clauses where) near)) "?")
                     ""))))

(define (malformed-clause where form location)
  "Raise the error about FORM, a clause with a known head that is written wrong."
  (let ((usage (and (pair? form) (assq-ref (known-clauses where) (car form)))))
    (bight-raise 'def 'define-lesson "~a~a, not ~s" (place location)
                 (if usage
                     (string-append "say " (car usage))
                     (simple-format #f "a clause of a ~a is written (NAME ...)" where))
                 form)))


;;; The macro.

(eval-when (expand load eval)
  (define (head-of clause)
    (syntax-case clause ()
      ((head . _) (identifier? #'head) (syntax->datum #'head))
      (_ #f)))

  (define (text? stx) (string? (syntax->datum stx)))

  (define (wrong where clause)
    #`(malformed-clause '#,(datum->syntax #'here where) '#,(datum->syntax #'here (syntax->datum clause))
                        (source-location #,clause)))

  (define (unknown where clause)
    (if (head-of clause)
        #`(unknown-clause '#,(datum->syntax #'here where)
                          '#,(datum->syntax #'here (head-of clause))
                          (source-location #,clause))
        (wrong where clause)))

  (define declaring '(score count setting pilot tender))

  (define (declaring? clause) (memq (head-of clause) declaring))

  (define (quoted-choices options)
    ;; OPTIONS of a probe, what follows #:choices quoted.
    (syntax-case options ()
      ((key (choice ...) . rest) (eq? #:choices (syntax->datum #'key))
       #`(key '(choice ...) . #,(quoted-choices #'rest)))
      ((key value . rest) #`(key value . #,(quoted-choices #'rest)))
      (rest #'rest)))

  (define (bearing-form? stx)
    (syntax-case stx ()
      ((head . _) (and (identifier? #'head) (memq (syntax->datum #'head) '(bearing-to rov-heading))) #t)
      (_ #f)))

  (define (expand-step clause)
    (syntax-case clause ()
      ((_ world) (eq? 'in (head-of clause)) #'(begin-dive! (world-of world)))
      ((_ text value ...) (and (eq? 'say (head-of clause)) (text? #'text))
       #'(say-text text (list value ...)))
      ((_) (eq? 'show (head-of clause)) #'(show-picture #f))
      ((_ picture) (eq? 'show (head-of clause)) #'(show-picture (lambda () picture)))
      ((_ question truth . options) (and (eq? 'probe (head-of clause)) (text? #'question))
       #`(put-probe question (lambda () truth) #,(bearing-form? #'truth) . #,(quoted-choices #'options)))
      ((_ text condition ...) (and (eq? 'task (head-of clause)) (text? #'text))
       #`(run-task text #,@(map expand-condition #'(condition ...))))
      ((_ (test step ...) ...) (eq? 'branch (head-of clause))
       #`(cond #,@(map expand-arm #'((test step ...) ...))))
      ((_ test step ...) (eq? 'when (head-of clause))
       #`(if test (begin #,@(map expand-step #'(step ...)) #t) #f))
      ((_ n step ...) (eq? 'repeat (head-of clause))
       #`(repeat-steps n (lambda () #,@(map expand-step #'(step ...)) #t)))
      ((_ text form ...) (and (eq? 'fork-and-show (head-of clause)) (text? #'text))
       #'(watch-fork text (lambda () form ... #t)))
      ((_ form ...) (eq? 'set-up (head-of clause)) #'(let () form ... #t))
      (_ (if (memq (head-of clause)
                   '(in say show probe task branch when repeat fork-and-show set-up))
             (wrong 'lesson clause)
             (if (declaring? clause)
                 (wrong 'lesson clause)
                 (unknown 'lesson clause))))))

  (define (expand-arm arm)
    (syntax-case arm ()
      ((test step ...)
       (if (eq? 'else (syntax->datum #'test))
           #`(else #t #,@(map expand-step #'(step ...)))
           #`(test #t #,@(map expand-step #'(step ...)))))))

  (define (expand-condition clause)
    (syntax-case clause ()
      ((_ e) (eq? 'done-when (head-of clause)) #'(list 'done (lambda () e)))
      ((_ s text) (eq? 'hint-after (head-of clause)) #'(list 'hint s text))
      ((_ e text) (eq? 'fail-when (head-of clause)) #'(list 'fail (lambda () e) text))
      ((_ s) (eq? 'at-most (head-of clause)) #'(list 'at-most s))
      ((_ s) (eq? 'held-for (head-of clause)) #'(list 'held s))
      ((_ form ...) (eq? 'first (head-of clause)) #'(list 'first (lambda () form ... #t)))
      ((_ s text form ...) (eq? 'fault-after (head-of clause))
       #'(list 'fault-after s text (lambda () form ... #t)))
      ((_ e text form ...) (eq? 'fault-when (head-of clause))
       #'(list 'fault-when (lambda () e) text (lambda () form ... #t)))
      (_ (if (memq (head-of clause)
                   '(done-when hint-after fail-when at-most held-for first fault-after fault-when))
             (wrong 'task clause)
             (unknown 'task clause)))))

  (define (expand-row clause row)
    (syntax-case row ()
      ((measure low high . options) (identifier? #'measure)
       #`(make-row #,(symbol->string (syntax->datum #'measure)) (lambda () (measure)) low high
                   . #,(quoted-way #'options)))
      ((measure low high . options)
       #`(make-row (code->string 'measure) (lambda () measure) low high
                   . #,(quoted-way #'options)))
      (_ (wrong 'lesson clause))))

  (define (quoted-way options)
    (syntax-case options ()
      ((key way . rest) (and (eq? #:by (syntax->datum #'key)) (identifier? #'way))
       #`(key 'way . #,(quoted-way #'rest)))
      ((key value . rest) #`(key value . #,(quoted-way #'rest)))
      (rest #'rest)))

  (define (expand-pilot clause name sentence parts)
    (let ((answers (filter (lambda (p) (eq? 'answers (head-of p))) parts))
          (flies (filter (lambda (p) (eq? 'flies (head-of p))) parts))
          (odd (filter (lambda (p) (not (memq (head-of p) '(answers flies)))) parts)))
      (if (pair? odd)
          (unknown 'pilot (car odd))
          #`(list 'pilot '#,name #,sentence
                  #,(if (null? answers) #'#f (expand-answers (car answers)))
                  (list #,@(map expand-flight flies))))))

  (define (expand-flight part)
    (syntax-case part () ((_ form ...) #'(lambda () form ... #t))))

  (define (expand-answers part)
    (syntax-case part ()
      ((_ (truth choices) form form* ...) #'(lambda (truth choices) form form* ...))
      (_ (wrong 'pilot part))))

  (define (expand-declaration clause)
    (syntax-case clause ()
      ((_ row ...) (eq? 'score (head-of clause))
       #`(list 'score (lambda () (list #,@(map (lambda (r) (expand-row clause r)) #'(row ...))))))
      ((_ name e) (and (eq? 'count (head-of clause)) (identifier? #'name))
       #'(list 'count 'name (lambda () e)))
      ((_ name value ...) (and (eq? 'setting (head-of clause)) (identifier? #'name))
       #'(list 'setting 'name value ...))
      ((_ name sentence part ...)
       (and (eq? 'pilot (head-of clause)) (identifier? #'name) (text? #'sentence))
       (expand-pilot clause #'name #'sentence #'(part ...)))
      ((_ sentence form ...) (and (eq? 'tender (head-of clause)) (text? #'sentence))
       #'(list 'tender sentence (lambda () form ... #t)))
      (_ (wrong 'lesson clause)))))

(define-syntax define-lesson
  (lambda (stx)
    "(define-lesson NAME \"title\" CLAUSE ...): a lesson, taken with `bight lesson NAME' or flown by one of
its own pilots with (run-lesson 'NAME #:pilot 'expert).  The CLAUSEs, in the order they are taken, are
(in WORLD), (say TEXT VALUE ...), (show), (probe QUESTION TRUTH ...), (task TEXT CONDITION ...),
(branch (E CLAUSE ...) ...), (when E CLAUSE ...), (repeat N CLAUSE ...), (fork-and-show TEXT FORM ...) and
(set-up FORM ...); those about the whole are (score ROW ...), (count NAME E), (setting NAME EASY NORMAL
HARD), (pilot NAME TEXT ...) and (tender TEXT FORM ...)."
    (syntax-case stx ()
      ((_ name title clause ...) (and (identifier? #'name) (text? #'title))
       (let ((declarations (filter declaring? #'(clause ...)))
             (steps (filter (lambda (c) (not (declaring? c))) #'(clause ...))))
         ;; A misspelt clause is told of when the lesson is defined, not when it is reached.
         #`(register-lesson! 'name title '(clause ...) (source-location #,stx)
                             (begin #,@(map expand-fault steps)
                                    (list #,@(map expand-declaration declarations)))
                             (lambda () #,@(map expand-step steps) #t))))
      (_ #`(malformed-lesson '#,stx)))))

(eval-when (expand load eval)
  (define (expand-fault clause)
    ;; What is wrong with CLAUSE or a clause inside it, or nothing.
    (let ((step (expand-step clause)))
      (syntax-case step (malformed-clause unknown-clause)
        ((malformed-clause . _) step)
        ((unknown-clause . _) step)
        (_ (syntax-case clause ()
             ((_ text condition ...) (eq? 'task (head-of clause))
              #`(begin #t #,@(map expand-condition-fault #'(condition ...))))
             ((_ (test inner ...) ...) (eq? 'branch (head-of clause))
              #`(begin #t #,@(map expand-fault #'(inner ... ...))))
             ((_ test inner ...) (memq (head-of clause) '(when repeat))
              #`(begin #t #,@(map expand-fault #'(inner ...))))
             (_ #'#t))))))

  (define (expand-condition-fault clause)
    (let ((condition (expand-condition clause)))
      (syntax-case condition (malformed-clause unknown-clause)
        ((malformed-clause . _) condition)
        ((unknown-clause . _) condition)
        (_ #'#t)))))

(define (malformed-lesson form)
  (bight-raise 'def 'define-lesson "say (define-lesson NAME \"title\" CLAUSE ...), not ~s" form))


;;; Reports.

(define-record <report>
  (make-report lesson who seed level marks total passed? seconds hints rewinds said charts coached hash)
  report-record?
  (lesson report-lesson)
  (who report-who)                      ; the name of the pilot or the pupil
  (seed report-seed)
  (level report-level)
  (marks report-mark-list)
  (total %report-total)
  (passed? %report-passed?)
  (seconds %report-seconds)             ; of the dive
  (hints %report-hints)
  (rewinds %report-rewinds)
  (said %report-said)                   ; (TIME KIND TEXT), in order
  (charts report-charts)                ; lines
  (coached %report-coached)
  (hash %report-hash))

(define-argument-type (report value)
  "a report, as `run-lesson' returns"
  (if (report-record? value) value refused))

(define-verb (report? (object any))
  "Return #t if OBJECT is the report of a lesson."
  (report-record? object))

(define-verb (report-total (r report)) "Return the marks of the report R out of 100." (%report-total r))
(define-verb (report-passed? (r report))
  "Return #t if all tasks of the report R were done and its total is at least 70."
  (%report-passed? r))
(define-verb (report-marks (r report))
  "Return the marks of the report R: lists of label, credit from 0 to 1, whether it is what was asked, and
how it came about."
  (map (lambda (m) (list (mark-label m) (mark-credit m) (mark-passed? m) (mark-detail m)))
       (report-mark-list r)))
(define-verb (report-said (r report))
  "Return what was said in the lesson of the report R, in order: lists of time, kind and text."
  (%report-said r))
(define-verb (report-hash (r report)) "Return the hash of the dive as the lesson left it, or #f."
  (%report-hash r))
(define-verb (report-coached (r report))
  "Return what the coach said in the lesson of the report R: lists of time, rule and words."
  (%report-coached r))
(define-verb (report-hints (r report)) "Return how many hints were given." (%report-hints r))
(define-verb (report-rewinds (r report)) "Return how often the pupil went back." (%report-rewinds r))
(define-verb (report-seconds (r report)) "Return how long the lesson's dives lasted, s."
  (%report-seconds r))

(define (mark-line m)
  (string-append (if (mark-passed? m) "  [x] " "  [ ] ")
                 (string-pad-right (mark-label m) 24) " "
                 (string-pad (number->string (inexact->exact (round (* 100 (mark-credit m))))) 4)
                 "  " (mark-detail m)))

(define (report-lines r)
  (append
   (list (simple-format #f "~a: ~a out of 100, ~a" (lesson-name (report-lesson r)) (%report-total r)
                        (if (%report-passed? r) "passed" "not passed yet")))
   (map mark-line (report-mark-list r))
   (list (simple-format #f "  ~a s under water, ~a hints, ~a steps back" (figure (%report-seconds r))
                        (%report-hints r) (%report-rewinds r)))
   (report-charts r)))

(define-verb (report-text (r report))
  "Return the report R as a person reads it: the marks, and each measure over time."
  (string-join (report-lines r) "\n"))

(set-record-type-printer! <report>
  (lambda (r port) (display (report-text r) port)))


;;; Running.

(define pass-total 70)

(define (make-rows lesson)
  (append-map (lambda (d) ((car d))) (declared 'score lesson)))

(define (counts-of lesson)
  (map (lambda (d) (cons (first d) (second d))) (declared 'count lesson)))

(define (tender-of lesson)
  (let ((all (declared 'tender lesson)))
    (and (pair? all)
         (make-pilot 'tender (first (last all)) (second (last all))))))

(define (tasks-in code)
  ;; How many tasks CODE, the data of clauses, sets.
  (count (lambda (c) (and (pair? c) (eq? 'task (car c)))) code))

(define (unfinished-marks lesson marks)
  ;; A task that was never begun is a mark of nothing.
  (let ((done (count (lambda (m) (string-prefix? "task" (mark-label m))) marks)))
    (map (lambda (i) (make-mark (simple-format #f "task ~a" (+ i 1)) 0 2 #f "not begun"))
         (iota (max 0 (- (tasks-in (lesson-code lesson)) done)) done))))

(define (passed? marks total ended)
  (and (not ended)
       (>= total pass-total)
       (every (lambda (m) (or (not (string-prefix? "task" (mark-label m))) (mark-passed? m))) marks)))

(define (charts rows)
  (append-map (lambda (row) (strip-chart row (row-samples rows row))) rows))

(define (report-on lesson who seed level rows ended)
  (let* ((marks (append (session-marks)
                        (unfinished-marks lesson (session-marks))
                        (map (lambda (row) (judge-row rows row)) rows)))
         (total (total-of marks))
         (s (this-session 'lesson)))
    (make-report lesson who seed level marks total (passed? marks total ended)
                 (time-or-0) (tally-ref 'hints-given 0) (tally-ref 'rewinds 0)
                 (reverse (session-log s)) (charts rows)
                 (if (session-coach s) (coach-log (session-coach s)) '())
                 (and (current-dive) (state-hash)))))

(define* (take-lesson lesson guide #:key (who 'pupil) (seed 0) (level 'normal) (coach #f))
  "Take LESSON with GUIDE, a dive of its own for each (in WORLD), and return the report."
  (call-with-values
      (lambda ()
        (call/ec
         (lambda (return)
           (parameterize
               ((current-session
                 (make-session (declared 'setting lesson) level guide coach
                               (lambda (why) (return (current-session) (current-dive) why)) seed))
                (current-dive #f))
             (let ((rows (make-rows lesson)))
               (call-with-plan rows (counts-of lesson) (tender-of lesson) (lesson-steps lesson))
               (values (current-session) (current-dive) #f))))))
    (lambda (session dive ended)
      (parameterize ((current-session session) (current-dive dive))
        (report-on lesson who seed level (make-rows lesson) ended)))))


;;; Scripted pilots.

(define (lesson-pilots lesson)
  "Return the names of the pilots of LESSON."
  (map first (declared 'pilot lesson)))

(define (pilot-named lesson name)
  "Return the pilot NAME of LESSON: a list of name, sentence, how he answers and what he flies."
  (or (assq name (declared 'pilot lesson))
      (unknown-name 'run-lesson (simple-format #f "the lesson ~a" (lesson-name lesson)) name
                    (lesson-pilots lesson) "pilot")))

(define (flight pilot n)
  ;; What PILOT does in the Nth task, a thunk.
  (let ((flights (fourth pilot)))
    (if (<= n (length flights)) (list-ref flights (- n 1)) (const #t))))

(define* (scripted-guide pilot #:key (idle-in #f) (say (const #t)))
  "Return a guide for PILOT, as `pilot-named' gives him, who does nothing in task number IDLE-IN."
  (define (fly n seconds)
    (if (eqv? n idle-in)
        (run seconds)
        (call-with-pilot (make-pilot (first pilot) (second pilot) (flight pilot n))
                         (lambda () (run seconds)))))
  (define (answer question truth choices)
    (if (third pilot) ((third pilot) truth choices) truth))
  (make-guide say (lambda (thunk) (thunk)) answer fly (const 'end) #f))

(define-argument-type (a-lesson value)
  "a lesson or the name of one that was defined"
  (cond ((lesson? value) value)
        ((not (symbol? value)) refused)
        ((find (lambda (l) (eq? value (lesson-name l))) (lesson-list)))
        (else (unknown-name 'run-lesson "the list of lessons" value (map lesson-name (lesson-list))))))

(define-argument-type (level value)
  "easy, normal or hard"
  (if (memq value levels) value refused))

(define-argument-type (seed value)
  "a whole number"
  (if (exact-integer? value) value refused))

(define-verb (run-lesson (lesson a-lesson) #:key (pilot name 'expert) (seed seed 0) (level level 'normal)
                         (coached flag #f))
  "Let the LESSON's own PILOT fly it, and return the report.  SEED is where its random numbers come from;
LEVEL is easy, normal or hard; the coach is silent unless COACHED."
  (take-lesson lesson (scripted-guide (pilot-named lesson pilot))
               #:who pilot #:seed seed #:level level #:coach (and coached (make-coach))))
