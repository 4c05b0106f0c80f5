;;; (bight test property) --- scenarios over random worlds and pilots, and the smallest one that fails.
;;;
;;; A property is a scenario whose variables are drawn anew for each case.  When a case fails, everything
;;; in it that can be left out is left out and every number is brought toward a simple one, as long as it
;;; goes on failing; what is left is told as a scenario to be pasted.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test property)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core told)
  #:use-module (bight core verb)
  #:use-module (bight test expect)
  #:use-module (bight test generator)
  #:use-module (bight test reproducer)
  #:use-module (bight test scenario)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-11) #:select (let*-values))
  #:export (define-property
            assume
            call-with-cases
            show-case
            property?
            register-property!))

(define-record <property>
  (make-property name sentence names generators body forms location)
  property?
  (name property-name)
  (sentence property-sentence)
  (names property-names)                ; of the variables
  (generators property-generators)      ; one for each
  (body property-body)                  ; a procedure of their values
  (forms property-forms)                ; what it was written as
  (location property-location))

;; Which cases are run, how the runner hears of each, and where reproducers are written.
(define first-case (make-parameter 0))
(define end-case (make-parameter #f))
(define hear-of-case (make-parameter (const #f)))
(define reproducer-folder (make-parameter #f))

(define (call-with-cases from end hear folder thunk)
  "Call THUNK, in which properties run the cases from FROM to before END, all there are if it is #f, call
HEAR with the number of each as it begins, and write reproducers to FOLDER unless that is #f."
  (parameterize ((first-case from) (end-case end) (hear-of-case hear) (reproducer-folder folder))
    (thunk)))


;;; A case: a datum for each variable.

(define (draw-case property n attempt)
  (let ((state (random-state-of (property-name property) n attempt)))
    (map-in-order (lambda (generator) (draw generator state)) (property-generators property))))

(define (expressions property data)
  (map expression (property-generators property) data))

(define (try-case property data)
  ;; #f if all is well, the first failure, or why this is no case, a string.
  (call-with-values
      (lambda ()
        (run-trial (lambda ()
                     (parameterize ((world-refused give-up-case))
                       (apply (property-body property) (map value-of (expressions property data)))))
                   (property-location property)))
    (lambda (status reason claims failures)
      (case status
        ((fail) (car failures))
        ((pass) #f)
        (else reason)))))               ; a string: not a case

(define (give-up-case exception)
  (if (bight-error? exception)
      ((trial-stop (current-trial)) 'skip (exception->line exception))
      (raise-exception exception)))

(define-verb (assume (claim any))
  "Give up this case of a property unless CLAIM is true: another is drawn in its place.  Return CLAIM."
  (unless claim
    (unless (current-trial)
      (bight-raise 'def 'assume "only a case of a property that is running can be given up"))
    ((trial-stop (current-trial)) 'skip "it assumed otherwise"))
  claim)


;;; Shrinking.

(define most-tries 1000)
(define most-seconds 60)                ; of processor time

(define (processor-seconds)
  (/ (tms:utime (times)) internal-time-units-per-second))

(define (replace-nth list i value)
  (append (take list i) (cons value (drop list (+ i 1)))))

(define (cases-by simpler property data)
  ;; All cases in which one variable of DATA is made SIMPLER.
  (append-map (lambda (i generator datum)
                (map (lambda (d) (replace-nth data i d)) (simpler generator datum)))
              (iota (length data)) (property-generators property) data))

(define (shrink-by simpler property data failure)
  ;; The last of a chain of cases that fail as DATA does, each SIMPLER than the one before; its failure, and
  ;; how many steps led there.
  (define end (+ most-seconds (processor-seconds)))
  (let loop ((candidates (cases-by simpler property data)) (data data) (failure failure) (steps 0)
             (tries 0))
    (if (or (null? candidates) (= tries most-tries) (> (processor-seconds) end))
        (values data failure steps)
        (let ((result (try-case property (car candidates))))
          (if (failure? result)
              (loop (cases-by simpler property (car candidates)) (car candidates) result (+ steps 1)
                    (+ tries 1))
              (loop (cdr candidates) data failure steps (+ tries 1)))))))

(define (shrink property data failure)
  (let*-values (((data failure steps) (shrink-by simpler property data failure))
                ((data failure more) (shrink-by rounder property data failure)))
    (values data failure (+ steps more))))


;;; Running it.

(define (reproducer property n data)
  (reproducer-text (property-name property) (property-sentence property) (test-seed) n
                   (map cons (property-names property) (expressions property data))
                   (property-forms property)))

(define (reproducer-lines property n data)
  (string-split (string-trim-right (reproducer property n data)) #\newline))

(define (keep-reproducer property n data)
  ;; Lines that tell where it was written.
  (if (reproducer-folder)
      (list (string-append "written to "
                           (write-reproducer (reproducer-folder) (property-name property)
                                             (test-seed) n (property-location property)
                                             (reproducer property n data))))
      '()))

(define (note-case! property n data failure)
  (call-with-values (lambda () (shrink property data failure))
    (lambda (data failure steps)
      (note-failure!
       (with-remarks failure
         (append (list (simple-format #f "case ~a with seed ~a, made simpler in ~a steps:" n (test-seed)
                                      steps))
                 (reproducer-lines property n data)
                 (keep-reproducer property n data)
                 (or (failure-remarks failure) '())))
       #:stop? #t))))

(define most-attempts 100)

(define (run-case property n)
  (let loop ((attempt 0))
    (let* ((data (draw-case property n attempt))
           (result (try-case property data)))
      (cond ((not result) (note-success!))
            ((failure? result) (note-case! property n data result))
            ((< attempt most-attempts) (loop (+ attempt 1)))
            (else
             (note-failure!
              (make-failure '... "a case in which what it assumes is true"
                            (simple-format #f "none among ~a; of the last one: ~a" (+ attempt 1) result)
                            (property-location property) '())
              #:stop? #t))))))

(define (run-property property cases)
  (do ((n (first-case) (+ n 1)))
      ((>= n (or (end-case) cases)))
    ((hear-of-case) n)
    (run-case property n)))

;; The property of each scenario that is one.
(define properties (make-weak-key-hash-table))

(define (register-property! name sentence names generators cases body forms location)
  "Keep as a scenario the property NAME whose BODY, written as FORMS, is tried on CASES cases of values for
NAMES drawn from GENERATORS."
  (let* ((check (lambda (variable generator)
                  (check-argument 'define-property variable type:generator generator)))
         (property (make-property name sentence names (map check names generators) body forms location))
         (cases (check-argument 'define-property 'cases type:count cases))
         (scenario (make-scenario name sentence '() (lambda () (run-property property cases))
                                  location cases)))
    (hashq-set! properties scenario property)
    (shelve-scenarios! name location (list scenario))
    scenario))

(define (show-case scenario n)
  "Return the lines of a scenario that is the case N of the property SCENARIO."
  (let ((property (hashq-ref properties scenario)))
    (if property
        (reproducer-lines property n (draw-case property n 0))
        '())))

(define-syntax define-property
  (lambda (stx)
    "(define-property NAME \"sentence\" #:for ((VARIABLE GENERATOR) ...) FORM ...): a scenario that is tried on
100 cases, or on N with #:cases N before the FORMs, each with values of the VARIABLEs drawn from their
GENERATORs.  A case that fails is made as simple as can be and told as a scenario of its own."
    (define (expand name sentence variables generators cases forms)
      #`(register-property! '#,name #,sentence '#,variables (list #,@generators) #,cases
                            (lambda #,variables #,@(expand-steps forms) *unspecified*)
                            '#,forms (source-location #,stx)))
    (syntax-case stx ()
      ((_ name sentence #:for ((variable generator) ...) #:cases cases form ...)
       (and (identifier? #'name) (string? (syntax->datum #'sentence)))
       (expand #'name #'sentence #'(variable ...) #'(generator ...) #'cases #'(form ...)))
      ((_ name sentence #:for ((variable generator) ...) form ...)
       (and (identifier? #'name) (string? (syntax->datum #'sentence)))
       (expand #'name #'sentence #'(variable ...) #'(generator ...) #'100 #'(form ...)))
      (_ (syntax-violation
          #f "say (define-property NAME \"sentence\" #:for ((VARIABLE GENERATOR) ...) FORM ...), not"
          stx)))))
