;;; (bight lesson syntax) --- how a lesson is written: `define-lesson' and the errors that teach it.
;;;
;;; The heads of clauses are matched by datum.  A clause that is unknown or written wrong is told of when
;;; the lesson is defined, not when it is reached.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson syntax)
  #:use-module (bight core errors)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson probe)
  #:use-module (bight lesson score)
  #:use-module (bight lesson shelf)
  #:use-module ((bight core told) #:select (code->string source-location location->string))
  #:use-module (bight lesson task)
  #:use-module ((bight test scenario) #:select (world-of))
  #:use-module (srfi srfi-1)
  #:export (define-lesson
            ;; What the macro expands to.
            unknown-clause malformed-clause malformed-lesson))


;;; Errors that teach.

(define lesson-clauses
  '((in "(in WORLD)")
    (say "(say \"text\" VALUE ...)")
    (show "(show) or (show EXPRESSION)")
    (probe "(probe \"question\" TRUTH #:within N), N above 0, or \
(probe \"question\" TRUTH #:choices (A B ...))")
    (task "(task \"text\" (done-when E) ...)")
    (branch "(branch (E CLAUSE ...) ... (else CLAUSE ...))")
    (when "(when E CLAUSE ...)")
    (repeat "(repeat N CLAUSE ...)")
    (fork-and-show "(fork-and-show \"text\" FORM ...)")
    (set-up "(set-up FORM ...)")
    (score "(score (MEASURE LOW HIGH #:by WAY #:share S #:over W #:weight W #:as \"words\" #:why \"words\") ...)")
    (count "(count NAME E)")
    (gauge "(gauge \"name\" E)")
    (setting "(setting NAME EASY NORMAL HARD)")
    (pilot "(pilot NAME \"sentence\" (answers (TRUTH CHOICES) E) (flies FORM ...) ...)")
    (tender "(tender \"sentence\" FORM ...)")
    (message-limit "(message-limit N)")
    (grade "(grade N), N from 1 to 4")
    (trains "(trains SKILL ...)")
    (needs "(needs SKILL ...)")
    (yours "(yours VEHICLE TETHER)")
    (hides "(hides VERB ...)")))

(define task-clauses
  '((done-when "(done-when E)")
    (hint-after "(hint-after SECONDS \"text\") or (hint-after SECONDS \"text\" \"forms to be typed\")")
    (fail-when "(fail-when E \"text\")")
    (at-most "(at-most SECONDS)")
    (held-for "(held-for SECONDS)")
    (target "(target \"name\" POINT)")
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
    (bight-raise 'name 'define-lesson "~aa ~a has no clause `~a'; ~ait has ~a" (place location) where head
                 (if near
                     (simple-format #f "did you mean ~a?  " (car (assq-ref (known-clauses where) near)))
                     "")
                 (words->string all))))

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

  (define declaring
    '(score count gauge setting pilot tender message-limit hides grade trains needs yours))

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
      ((_ s text forms) (and (eq? 'hint-after (head-of clause)) (text? #'forms)) #'(list 'hint s text forms))
      ((_ e text) (eq? 'fail-when (head-of clause)) #'(list 'fail (lambda () e) text))
      ((_ s) (eq? 'at-most (head-of clause)) #'(list 'at-most s))
      ((_ s) (eq? 'held-for (head-of clause)) #'(list 'held s))
      ((_ name p) (and (eq? 'target (head-of clause)) (text? #'name)) #'(list 'target name (lambda () p)))
      ((_ form ...) (eq? 'first (head-of clause)) #'(list 'first (lambda () form ... #t)))
      ((_ s text form ...) (eq? 'fault-after (head-of clause))
       #'(list 'fault-after s text (lambda () form ... #t)))
      ((_ e text form ...) (eq? 'fault-when (head-of clause))
       #'(list 'fault-when (lambda () e) text (lambda () form ... #t)))
      (_ (if (memq (head-of clause)
                   '(done-when hint-after fail-when at-most held-for target first fault-after fault-when))
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
      ((_ name e) (and (eq? 'gauge (head-of clause)) (text? #'name))
       #'(list 'gauge name (lambda () e)))
      ((_ name value ...) (and (eq? 'setting (head-of clause)) (identifier? #'name))
       #'(list 'setting 'name value ...))
      ((_ name sentence part ...)
       (and (eq? 'pilot (head-of clause)) (identifier? #'name) (text? #'sentence))
       (expand-pilot clause #'name #'sentence #'(part ...)))
      ((_ sentence form ...) (and (eq? 'tender (head-of clause)) (text? #'sentence))
       #'(list 'tender sentence (lambda () form ... #t)))
      ((_ n) (eq? 'message-limit (head-of clause)) #'(list 'message-limit n))
      ((_ n) (eq? 'grade (head-of clause)) #'(list 'grade n))
      ((_ vehicle tether)
       (and (eq? 'yours (head-of clause)) (identifier? #'vehicle) (identifier? #'tether))
       #'(list 'yours 'vehicle 'tether))
      ((_ skill skill* ...)
       (and (memq (head-of clause) '(trains needs)) (every identifier? #'(skill skill* ...)))
       #`(list '#,(datum->syntax #'here (head-of clause)) 'skill 'skill* ...))
      ((_ verb verb* ...)
       (and (eq? 'hides (head-of clause)) (every identifier? #'(verb verb* ...)))
       #'(list 'hides 'verb 'verb* ...))
      (_ (wrong 'lesson clause)))))

(define-syntax define-lesson
  (lambda (stx)
    "(define-lesson NAME \"title\" CLAUSE ...): a lesson, taken with `bight lesson NAME' or flown by one of
its own pilots with (run-lesson 'NAME #:pilot 'expert).  The CLAUSEs, in the order they are taken, are
(in WORLD), (say TEXT VALUE ...), (show), (probe QUESTION TRUTH ...), (task TEXT CONDITION ...),
(branch (E CLAUSE ...) ...), (when E CLAUSE ...), (repeat N CLAUSE ...), (fork-and-show TEXT FORM ...) and
(set-up FORM ...); those about the whole are (score ROW ...), (count NAME E), (gauge NAME E), (setting NAME EASY NORMAL
HARD), (pilot NAME TEXT ...), (tender TEXT FORM ...), (message-limit N), (hides VERB ...), (grade N),
(trains SKILL ...), (needs SKILL ...) and, where there are several vehicles, (yours VEHICLE TETHER)."
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
             ((_ question truth . options) (eq? 'probe (head-of clause))
              (expand-option-faults clause #'options))
             ((_ text condition ...) (eq? 'task (head-of clause))
              #`(begin #t #,@(map expand-condition-fault #'(condition ...))))
             ((_ (test inner ...) ...) (eq? 'branch (head-of clause))
              #`(begin #t #,@(map expand-fault #'(inner ... ...))))
             ((_ test inner ...) (memq (head-of clause) '(when repeat))
              #`(begin #t #,@(map expand-fault #'(inner ...))))
             (_ #'#t))))))

  (define (expand-option-faults clause options)
    ;; Within nothing no answer could be right.
    (syntax-case options ()
      ((key value . rest)
       (if (and (memq (syntax->datum #'key) '(#:within #:ratio))
                (real? (syntax->datum #'value))
                (not (positive? (syntax->datum #'value))))
           (wrong 'lesson clause)
           (expand-option-faults clause #'rest)))
      (_ #'#t)))

  (define (expand-condition-fault clause)
    (let ((condition (expand-condition clause)))
      (syntax-case condition (malformed-clause unknown-clause)
        ((malformed-clause . _) condition)
        ((unknown-clause . _) condition)
        (_ #'#t)))))

(define (malformed-lesson form)
  (bight-raise 'def 'define-lesson "say (define-lesson NAME \"title\" CLAUSE ...), not ~s" form))
