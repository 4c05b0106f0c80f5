;;; (bight lesson) --- lessons: what to read, to answer and to fly, as plain files anybody can write.
;;;
;;; A lesson is written with `define-lesson', (bight lesson syntax); what happens in it is in (bight lesson guide),
;;; (bight lesson probe) and (bight lesson task), how it is marked in (bight lesson score).  It runs three ways, by who stands behind
;;; its guide: a person, (bight lesson terminal); a scripted pilot of the lesson's own, here; a test, which
;;; is a scripted pilot whose report is looked at.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson)
  #:use-module (bight cockpit coach)
  #:use-module (bight core errors)
  #:use-module ((bight core signature) #:select (own-subjects))
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive pilot)
  #:use-module (bight dive time)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson lost)
  #:use-module (bight lesson message)
  #:use-module (bight lesson probe)
  #:use-module (bight lesson report)
  #:use-module (bight lesson score)
  #:use-module (bight lesson shelf)
  #:use-module (bight lesson syntax)
  #:use-module (bight lesson tally)
  #:use-module (bight lesson way)
  #:use-module ((bight view) #:select (side-shown?))
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (srfi srfi-1)
  #:re-export (define-lesson lesson-list
               last-answer counter count! setting jitter
               tell! told messages messages-left number-in way-flown off-the-way
               report? report-who report-seed report-level report-total report-passed? report-marks
               report-said report-text report-hash report-coached report-hints report-rewinds
               report-seconds report-instructed
               lesson? lesson-name lesson-title lesson-code lesson-location collect-lessons
               ;; What the macro expands to.
               register-lesson! unknown-clause malformed-clause malformed-lesson)
  #:export (run-lesson
            ;; For those who run lessons.
            lesson-pilots take-lesson scripted-guide pilot-named call-in-session))


;;; Running.

(define pass-total 70)

(define (make-rows lesson)
  (append-map (lambda (d) ((car d))) (declared 'score lesson)))

(define (counts-of lesson)
  (map (lambda (d) (cons (first d) (second d))) (declared 'count lesson)))

(define (gauges-of lesson)
  (map (lambda (d) (cons (first d) (second d))) (declared 'gauge lesson)))

(define (tender-of lesson)
  (let ((all (declared 'tender lesson)))
    (and (pair? all)
         (make-pilot 'tender (first (last all)) (second (last all))))))

;; What shows or tells where the tether lies.
(define views '(look tether-points point-at way-home segments))

(define (limits-of lesson display)
  (append (map (lambda (d) (cons 'messages (car d))) (reverse (declared 'message-limit lesson)))
          (list (cons 'display display)
                (cons 'hidden (append (if (eq? 'none display) views '())
                                      (concatenate (declared 'hides lesson)))))))

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
  (let* ((row-marks (map (lambda (row) (judge-row rows row)) rows))
         (marks (append (session-marks)
                        (unfinished-marks lesson (session-marks))
                        row-marks))
         (total (total-of marks))
         (s (this-session 'lesson)))
    (make-report lesson who seed level marks total (passed? marks total ended)
                 (time-or-0) (tally-ref 'hints-given 0) (tally-ref 'rewinds 0)
                 (reverse (session-log s)) (charts rows)
                 (if (session-coach s) (coach-log (session-coach s)) '())
                 (and (current-dive) (state-hash))
                 (lost-marks (session-marks) rows row-marks)
                 (tally-ref 'set '()))))

(define (hides? lesson verb display)
  (memq verb (assq-ref (limits-of lesson display) 'hidden)))

(define (call-in-session lesson guide seed level thunk)
  "Call THUNK in a session of LESSON that has only begun, without a coach, taken by GUIDE."
  (parameterize ((current-session (make-session (declared 'setting lesson) level guide #f (const #f) seed
                                                (limits-of lesson 'three))))
    (call-with-plan (make-rows lesson) (counts-of lesson) (gauges-of lesson) (tender-of lesson) thunk)))

(define* (take-lesson lesson guide #:key (who 'pupil) (seed 0) (level 'normal) (coach #f) (display 'three))
  "Take LESSON with GUIDE, a dive of its own for each (in WORLD), and return the report.  DISPLAY says which
views are shown: three, plan or none."
  (call-with-values
      (lambda ()
        (call/ec
         (lambda (return)
           (parameterize
               ((current-session
                 (make-session (declared 'setting lesson) level guide
                              ;; A coach who sees more than the pupil would tell him what the lesson hides.
                              (and coach (not (hides? lesson 'look display)) coach)
                               (lambda (why) (return (current-session) (current-dive) why)) seed
                               (limits-of lesson display)))
                (current-dive #f)
                (own-subjects (concatenate (declared 'yours lesson)))
                (side-shown? (not (eq? 'plan display))))
             (let ((rows (make-rows lesson)))
               (call-with-plan rows (counts-of lesson) (gauges-of lesson) (tender-of lesson) (lesson-steps lesson))
               (values (current-session) (current-dive) #f))))))
    (lambda (session dive ended)
      (parameterize ((current-session session) (current-dive dive)
                     (own-subjects (concatenate (declared 'yours lesson))))
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

(define-syntax-rule (of-files name)
  ;; What (bight lesson file), which knows this module, calls NAME.
  (module-ref (resolve-interface '(bight lesson file)) 'name))

(define (lesson-in-file name)
  ;; The lesson NAME of those that come with bight, or #f.
  (and (memq name ((of-files lessons)))
       ((of-files load-lesson) ((of-files lesson-file) (symbol->string name)))))

(define-argument-type (a-lesson value)
  "a lesson, or the name of one that was defined or comes with bight"
  (cond ((lesson? value) value)
        ((not (symbol? value)) refused)
        ((find (lambda (l) (eq? value (lesson-name l))) (lesson-list)))
        ((lesson-in-file value))
        (else (unknown-name 'run-lesson "the list of lessons" value
                            (append (map lesson-name (lesson-list)) ((of-files lessons)))))))

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
