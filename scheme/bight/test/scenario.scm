;;; (bight test scenario) --- given, when, then: tests of a dive that read like a story.
;;;
;;; `define-scenario' records a scenario; `run-scenario' runs one in a dive of its own and returns its
;;; outcome.  `always', `never' and `eventually' watch a claim while time passes.  The runner that
;;; prints TAP is (bight test tap); `expect' and its kin come from (bight test expect).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test scenario)
  #:use-module ((bight core clause) #:select (global-value))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core shelf)
  #:use-module (bight core told)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight test expect)
  #:use-module (bight test trial)
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:use-module ((system syntax) #:select (syntax-local-binding))
  #:re-export (expect require about between above below
               reached! run-trial test-seed call-with-seed random-state-of stop-whole-trial! epilogue)
  #:export (define-scenario
            always
            never
            eventually
            skip
            run-scenario
            scenarios
            ;; For the runner.
            collect-scenarios
            scenario?
            scenario-name
            scenario-sentence
            scenario-location
            scenario-label
            outcome?
            outcome-scenario
            outcome-status
            outcome-reason
            outcome-claims
            outcome-failures
            outcome-seconds
            ;; What the macros expand to.
            register-scenario!
            shelve-scenarios!
            make-scenario
            enter-world!
            world-of
            world-named
            watch-always
            watch-eventually
            negate
            ;; For properties, and for the processes that run scenarios.
            expand-steps
            scenario-cases
            world-refused))


;;; Scenarios, and where they are kept.

(define-record <scenario>
  (make-scenario name sentence bindings body location cases)
  scenario?
  (name scenario-name)                  ; a symbol
  (sentence scenario-sentence)          ; a string
  (bindings scenario-bindings)          ; an alist of variables and values, from #:for
  (body scenario-body)                  ; a procedure of the values
  (location scenario-location)          ; (FILE . LINE) or #f
  (cases scenario-cases))               ; of a property: how many, else #f

(define (binding->string binding)
  (simple-format #f "~a=~a" (car binding)
                 (if (string? (cdr binding)) (cdr binding) (brief (cdr binding)))))

(define (scenario-label scenario)
  "Return what SCENARIO is called in a report: its name, and the values of its variables if any."
  (let ((bindings (scenario-bindings scenario)))
    (if (null? bindings)
        (symbol->string (scenario-name scenario))
        (simple-format #f "~a (~a)" (scenario-name scenario)
                       (string-join (map binding->string bindings) ", ")))))

(set-record-type-printer! <scenario>
  (lambda (scenario port)
    (simple-format port "#<scenario ~a: ~a>" (scenario-label scenario)
                   (scenario-sentence scenario))))

(define shelf (make-shelf))

(define-verb (scenarios)
  "Return the list of the scenarios defined so far, in order."
  (on-shelf shelf))

(define (collect-scenarios thunk)
  "Call THUNK and return the list of the scenarios it defined, in order."
  (call-with-empty-shelf shelf thunk))

(define (combinations lists)
  ;; All ways to take one item of each of LISTS, the last varying fastest.
  (if (null? lists)
      '(())
      (let ((rest (combinations (cdr lists))))
        (append-map (lambda (item) (map (lambda (tail) (cons item tail)) rest))
                    (car lists)))))

(define (check-new-name name location)
  ;; Within one file a second scenario of the same name would silently hide the first.
  (let ((old (find (lambda (s) (eq? (scenario-name s) name)) (scenarios))))
    (when (and old location (scenario-location old)
               (not (equal? location (scenario-location old)))
               (equal? (car location) (car (scenario-location old))))
      (bight-raise 'def 'define-scenario "there is a scenario `~a' already, at ~a" name
                   (location->string (scenario-location old))))))

(define (register-scenario! name sentence variables rows body location)
  ;; Make a scenario of each combination of ROWS, the lists of values of VARIABLES.
  (check-new-name name location)
  (let ((new (map (lambda (row)
                    (make-scenario name sentence (map cons variables row) body location #f))
                  (combinations rows))))
    (shelve! shelf scenario-name name new)
    (if (= 1 (length new)) (car new) new)))

(define (shelve-scenarios! name location new)
  "Keep NEW, a list of scenarios called NAME that were written at LOCATION."
  (check-new-name name location)
  (shelve! shelf scenario-name name new))


;;; Writing one.

;; What is done with the exception that refuses a world; properties draw another.
(define world-refused (make-parameter raise-exception))

(define (enter-world! world)
  (if world
      ((call/ec
        (lambda (return)
          (with-exception-handler
              (lambda (exception)
                (return (lambda () ((world-refused) exception))))
            (lambda () (enter! world) (lambda () (current-dive)))))))
      (bight-raise 'domain 'in "a scenario takes place in a world, not in #f")))

(define (world-named name module-name)
  ;; The world that NAME, as seen from the module named MODULE-NAME, stands for.
  (or (global-value module-name name) name))

(define-syntax world-of
  (lambda (stx)
    "(world-of WORLD): the value of WORLD, an expression in which a name that is not bound stands for the
world of that name, alone or in (with NAME ...), (extend NAME ...) and (without NAME ...)."
    (define (global-name id)
      ;; The name of the module in which ID is looked up, or #f if ID is bound locally.
      (call-with-values (lambda () (syntax-local-binding id))
        (lambda (type value)
          (and (eq? type 'global) (cdr value)))))
    (syntax-case stx ()
      ((_ name)
       (and (identifier? #'name) (global-name #'name))
       #`(world-named 'name '#,(datum->syntax #'name (global-name #'name))))
      ((_ (head inner . rest))
       (and (identifier? #'head) (memq (syntax->datum #'head) '(with extend without)))
       #'(head (world-of inner) . rest))
      ((_ expression) #'expression))))

(eval-when (expand load eval)
  (define (expand-step stx)
    ;; A form of a scenario's body, noted as it is reached.
    #`(begin
        (reached! (source-location #,stx))
        #,(syntax-case stx ()
            ((in world) (eq? (syntax->datum #'in) 'in)
             #'(enter-world! (world-of world)))
            ((in . _) (eq? (syntax->datum #'in) 'in)
             (syntax-violation #f "say (in WORLD), not" stx))
            (_ stx))))

  (define (expand-steps forms)
    "Return FORMS, those of a scenario's body, each noted as it is reached."
    (map expand-step forms))

  (define (split-head stx head)
    ;; The name and the variables of HEAD: NAME or (NAME VARIABLE ...).
    (syntax-case head ()
      (name (identifier? #'name) (values #'name '()))
      ((name variable ...) (and (identifier? #'name) (and-map identifier? #'(variable ...)))
       (values #'name #'(variable ...)))
      (_ (syntax-violation #f "a scenario is called NAME or (NAME VARIABLE ...), not" stx head))))

  (define (row-of stx variable rows)
    ;; The values given to VARIABLE in the ROWS after #:for.
    (or (or-map (lambda (row)
                  (syntax-case row ()
                    ((name value ...)
                     (and (identifier? #'name) (bound-identifier=? #'name variable))
                     #'(list value ...))
                    (_ #f)))
                rows)
        (syntax-violation #f "there are no values for this variable after #:for" stx variable)))

  (define (check-rows stx variables rows)
    (for-each (lambda (row)
                (syntax-case row ()
                  ((name value more ...)
                   (and (identifier? #'name)
                        (or-map (lambda (v) (bound-identifier=? #'name v)) variables))
                   #t)
                  (_ (syntax-violation
                      #f "a row after #:for is (VARIABLE VALUE ...), the variable being in the head, not"
                      stx row))))
              rows))

  (define (expand-scenario stx head sentence rows body)
    (call-with-values (lambda () (split-head stx head))
      (lambda (name variables)
        (check-rows stx variables rows)
        #`(register-scenario!
           '#,name #,sentence '#,variables
           (list #,@(map (lambda (v) (row-of stx v rows)) variables))
           (lambda #,variables #,@(expand-steps body) *unspecified*)
           (source-location #,stx))))))

(define-syntax define-scenario
  (lambda (stx)
    "(define-scenario NAME \"sentence\" FORM ...): a scenario, run by `bight test' or (run-scenario 'NAME).
(in WORLD) among the FORMs enters a dive in WORLD: a name or an expression.  The other FORMs are
ordinary code, with `expect', `require', `always', `never', `eventually' and `skip'.
(define-scenario (NAME U ...) \"sentence\" #:for ((U VALUE ...) ...) FORM ...): one scenario for each
combination of the values, the last variable varying fastest."
    (syntax-case stx ()
      ((_ head sentence #:for (row ...) form ...) (string? (syntax->datum #'sentence))
       (expand-scenario stx #'head #'sentence #'(row ...) #'(form ...)))
      ((_ head sentence word . _) (and (string? (syntax->datum #'sentence)) (keyword? (syntax->datum #'word)))
       (syntax-violation #f "after the sentence come #:for ((VARIABLE VALUE ...) ...) or forms, not" stx #'word))
      ((_ head sentence form ...) (string? (syntax->datum #'sentence))
       (expand-scenario stx #'head #'sentence '() #'(form ...)))
      (_ (syntax-violation #f "say (define-scenario NAME \"sentence\" FORM ...), not" stx)))))

(define-verb (skip (reason string))
  "Give up the running scenario because of REASON: it counts as skipped, not as failed."
  (unless (current-trial)
    (bight-raise 'def 'skip "only a scenario that is running can be skipped"))
  ((trial-stop (current-trial)) 'skip reason))


;;; Watching a claim while time passes.

(define (call-while-watching look body)
  ;; Call BODY, and LOOK after every step and once at the end.
  (let ((handle #f))
    (dynamic-wind
      (lambda () (set! handle (add-step-watcher! look)))
      body
      (lambda () (remove-step-watcher! handle)))
    (look)))

(define (when->string time)
  (if time (simple-format #f " at ~a s" (to-the-millisecond time)) ""))

(define (time-or-false)
  (and (current-dive) (now)))

(define (note-watched! form wanted verdict time location remarks)
  (note-failure! (make-failure form
                               (string-append (car verdict) " " wanted)
                               (string-append (cdr verdict) (when->string time))
                               location remarks)))

(define (watch-always form location judge body wanted)
  ;; JUDGE returns #f while all is well; the first verdict is the one reported.
  (let ((first #f) (time #f) (remarks #f))
    (call-while-watching
     (lambda ()
       (unless first
         (set! first (judge))
         (when first
           (set! time (time-or-false))
           (set! remarks (scene)))))
     body)
    (if first
        (note-watched! form wanted first time location remarks)
        (note-success!))))

(define (watch-eventually form location judge body)
  (let ((last #t))
    (call-while-watching (lambda () (when last (set! last (judge)))) body)
    (if last
        (note-watched! form "at some step" last (time-or-false) location (scene))
        (note-success!))))

(define (negate judge)
  ;; The judge of NOT E, of which JUDGE is the judge of E.
  (lambda ()
    (let ((verdict (judge)))
      (cond ((not verdict) '("false" . "true"))
            ((string-contains (cdr verdict) " error: ") verdict)
            (else #f)))))

(define-syntax always
  (lambda (stx)
    "(always P FORM ...): P is true after every step that the FORMs let pass, and when they have ended.
The first step at which it is not is reported.  Return #t or #f."
    (syntax-case stx ()
      ((_ p form ...)
       #`(watch-always '#,stx (source-location #,stx) (judge-of p)
                       (lambda () form ... *unspecified*) "after every step")))))

(define-syntax never
  (lambda (stx)
    "(never P FORM ...): P is false after every step that the FORMs let pass, and when they have ended.
The first step at which it is true is reported.  Return #t or #f."
    (syntax-case stx ()
      ((_ p form ...)
       #`(watch-always '#,stx (source-location #,stx) (negate (judge-of p))
                       (lambda () form ... *unspecified*) "after every step")))))

(define-syntax eventually
  (lambda (stx)
    "(eventually P FORM ...): P is true after at least one of the steps that the FORMs let pass, or
when they have ended.  Return #t or #f."
    (syntax-case stx ()
      ((_ p form ...)
       #`(watch-eventually '#,stx (source-location #,stx) (judge-of p)
                           (lambda () form ... *unspecified*))))))


;;; Running one.

(define-record <outcome>
  (make-outcome scenario status reason claims failures seconds)
  outcome?
  (scenario outcome-scenario)
  (status outcome-status)               ; pass, fail or skip
  (reason outcome-reason)               ; why it was skipped, a string, or #f
  (claims outcome-claims)               ; how many claims were judged
  (failures outcome-failures)           ; in order
  (seconds outcome-seconds))            ; of real time

(define (print-failure failure port)
  (simple-format port "~%  ~a: ~a~%    expected: ~a~%    actual:   ~a"
                 (location->string (failure-location failure))
                 (code->string (failure-form failure))
                 (failure-expected failure)
                 (failure-actual failure))
  (for-each (lambda (line) (simple-format port "~%    ~a" line))
            (or (failure-remarks failure) '())))

(set-record-type-printer! <outcome>
  (lambda (outcome port)
    (simple-format port "~a ~a: ~a" (outcome-status outcome)
                   (scenario-label (outcome-scenario outcome))
                   (scenario-sentence (outcome-scenario outcome)))
    (when (outcome-reason outcome)
      (simple-format port " (~a)" (outcome-reason outcome)))
    (for-each (lambda (failure) (print-failure failure port)) (outcome-failures outcome))))

(define (try scenario)
  (reseed! (scenario-label scenario))
  (run-trial (lambda () (apply (scenario-body scenario) (map cdr (scenario-bindings scenario))))
             (scenario-location scenario)))

(define (run-one scenario)
  (let ((start (get-internal-real-time)))
    (call-with-values (lambda () (try scenario))
      (lambda (status reason claims failures)
        (make-outcome scenario status reason claims failures
                      (/ (- (get-internal-real-time) start)
                         (exact->inexact internal-time-units-per-second)))))))

(define (named-scenarios name)
  (let ((found (filter (lambda (s) (eq? (scenario-name s) name)) (scenarios))))
    (when (null? found)
      (unknown-name 'run-scenario "the list of scenarios" name
                    (delete-duplicates (map scenario-name (scenarios)))))
    found))

(define-argument-type (scenario value)
  "a scenario or the name of one"
  (if (or (scenario? value) (symbol? value)) value refused))

(define-verb (run-scenario (which scenario))
  "Run WHICH, a scenario or the name of one, in a dive of its own and return its outcome, which prints
as a report.  The present dive stays as it is.  A name that stands for several scenarios, by #:for,
gives the list of their outcomes."
  (if (scenario? which)
      (run-one which)
      (let ((outcomes (map run-one (named-scenarios which))))
        (if (= 1 (length outcomes)) (car outcomes) outcomes))))
