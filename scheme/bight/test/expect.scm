;;; (bight test expect) --- saying what should be true, and hearing clearly when it is not.
;;;
;;; `expect' and `require' judge one claim.  Inside a scenario the verdict goes to the trial that is
;;; running (see (bight test scenario)); anywhere else a claim that fails raises &failed-expectation.
;;; `about', `between', `above' and `below' make predicates that can say what they wanted.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test expect)
  #:use-module (bight core errors)
  #:use-module ((bight core here) #:select (chain-of note-place!))
  #:use-module (bight core record)
  #:use-module (bight core told)
  #:use-module (bight core verb)
  #:use-module (ice-9 exceptions)
  #:use-module (srfi srfi-1)
  #:export (expect
            require
            about
            between
            above
            below
            same?
            ;; For (bight test scenario) and the runner.
            current-trial
            make-trial
            trial-stop
            failure?
            failure-form
            failure-expected
            failure-actual
            failure-location
            failure-remarks
            make-failure
            with-remarks
            note-failure!
            note-success!
            claim
            judge-of
            &failed-expectation
            trial?
            ;; What the macros expand to.
            judge-truth
            judge-comparison
            judge-same
            judge-is
            judge-raise
            report-verdict))


;;; Failures and the trial that collects them.

(define-record <failure>
  (%make-failure form expected actual location remarks)
  failure?
  (form failure-form)                   ; a datum
  (expected failure-expected)           ; a string
  (actual failure-actual)               ; a string
  (location failure-location)           ; (FILE . LINE) or #f
  (remarks failure-remarks))            ; lines that show the dive, or what led there; or #f

(define* (make-failure form expected actual location #:optional remarks)
  "Return the failure of FORM, a datum, at LOCATION: what was EXPECTED and what was ACTUAL, strings.
REMARKS are lines that show more of it; #f leaves them to the trial that is told of it."
  (%make-failure form expected actual location remarks))

(define (with-remarks failure lines)
  "Return FAILURE with LINES for its remarks."
  (make-failure (failure-form failure) (failure-expected failure) (failure-actual failure)
                (failure-location failure) lines))

(define-record <trial>
  (make-trial note stop)
  trial?
  (note trial-note)                     ; called with a failure, or #f for a claim that held
  (stop trial-stop))                    ; called with a status and a reason, does not return

(define current-trial (make-parameter #f))

(define &failed-expectation
  (make-exception-type '&failed-expectation &error '(failure)))

(define make-failed-expectation (record-constructor &failed-expectation))

(define (failure->line failure)
  (simple-format #f "~a: expected ~a, got ~a"
                 (code->string (failure-form failure))
                 (failure-expected failure)
                 (failure-actual failure)))

(define (raise-failure failure)
  (let ((line (failure->line failure)))
    (raise-exception
     (make-exception (make-failed-expectation failure)
                     (make-exception-with-message line)
                     (make-exception-with-irritants '())
                     (make-exception-from-throw 'failed-expectation
                                                (list line (failure-location failure)))))))

(set-exception-printer! 'failed-expectation
                        (lambda (port key args default-printer)
                          (display (car args) port)))

(define (note-success!)
  "Tell the running trial, if any, that a claim held.  Return #t."
  (when (current-trial)
    ((trial-note (current-trial)) #f))
  #t)

(define* (note-failure! failure #:key stop?)
  "Tell the running trial of FAILURE and return #f, ending the trial if STOP?.  Outside a trial raise
&failed-expectation."
  (let ((trial (current-trial)))
    (unless trial
      (raise-failure failure))
    ((trial-note trial) failure)
    (when stop?
      ((trial-stop trial) 'fail #f))
    #f))


;;; Judges.  Each is a thunk, made once for a claim and called for each verdict on it: #f if all is well,
;;; else a pair of strings (EXPECTED . ACTUAL).

(define (not-an-error? exception)
  (memq (exception-kind exception) '(quit signal)))

(define raised-tag (make-prompt-tag 'raised))

(define-record <raised>
  (make-raised exception)
  raised?
  (exception raised-exception))

(define (note-raised exception)
  (if (not-an-error? exception)
      (raise-exception exception)
      (abort-to-prompt raised-tag (note-place! exception))))

(define (attempt thunk succeed fail)
  ;; SUCCEED with the value of THUNK, or FAIL with the exception it raised.  A prompt costs a sixth of an
  ;; escape procedure, and claims are judged after each step.
  (let ((value (call-with-prompt raised-tag
                 (lambda () (with-exception-handler note-raised thunk))
                 (lambda (continuation exception) (make-raised exception)))))
    (if (raised? value)
        (fail (raised-exception value))
        (succeed value))))

(define (procedures-on-the-way exception)
  ;; Where EXCEPTION was raised and what led there, in parentheses, if that is in a procedure of the file.
  (let ((frames (chain-of exception)))
    (if (any cdr frames)
        (simple-format #f " (at ~a ~a)" (location->string (car (car frames))) (chain->string frames))
        "")))

(define (describe-raise exception)
  (simple-format #f "~a error: ~a~a" (raised-kind exception) (exception->line exception)
                 (procedures-on-the-way exception)))

(define (judge ask good? expected)
  ;; EXPECTED is a thunk that gives the text.
  (define (try)
    (let ((value (ask)))
      (and (not (good? value)) (list value))))
  (define (tell wrong)
    (and wrong (cons (expected) (brief (car wrong)))))
  (define (tell-raise exception)
    (cons (expected) (describe-raise exception)))
  (lambda () (attempt try tell tell-raise)))

(define (judge-truth ask)
  (judge ask identity (const "true")))

(define (judge-comparison name compare ask)
  ;; ASK calls what it is given with the values compared.
  (define differ
    (case-lambda
      ((a b) (and (not (compare a b)) (list a b)))
      (values (and (not (apply compare values)) values))))
  (define (try)
    (ask differ))
  (define (tell unlike)
    (and unlike
         (cons "true" (simple-format #f "(~a ~a)" name (string-join (map brief unlike) " ")))))
  (define (tell-raise exception)
    (cons "true" (describe-raise exception)))
  (lambda () (attempt try tell tell-raise)))

(define (same-as value code)
  ;; What is expected by a claim that something is VALUE, which CODE gives.
  (if (procedure? value)
      (simple-format #f "a procedure; that it holds is said by `is': (expect E is ~a)" (code->string code))
      (brief value)))

(define (judge-same ask wanted code)
  (define (judge-by value)
    ((judge ask (lambda (given) (same? value given)) (lambda () (same-as value code)))))
  (define (tell-raise exception)
    (cons "a value to compare with" (describe-raise exception)))
  (lambda () (attempt wanted judge-by tell-raise)))

(define (judge-is ask predicate code)
  (define (judge-by accept?)
    (if (procedure? accept?)
        ((judge ask accept? (lambda () (describe-predicate accept? code))))
        (cons "a predicate after `is'" (brief accept?))))
  (define (tell-raise exception)
    (cons (code->string code) (describe-raise exception)))
  (lambda () (attempt predicate judge-by tell-raise)))

(define (judge-raise ask kind)
  (define (expected)
    (if kind
        (simple-format #f "a ~a error~a" kind
                       (if (memq kind bight-error-kinds) "" (did-you-mean kind bight-error-kinds)))
        "an error"))
  (define (tell value)
    (cons (expected) (brief value)))
  (define (tell-raise exception)
    (and kind
         (not (eq? kind (raised-kind exception)))
         (cons (expected) (describe-raise exception))))
  (lambda () (attempt ask tell tell-raise)))

(define* (report-verdict form location verdict #:key stop?)
  (if verdict
      (note-failure! (make-failure form (car verdict) (cdr verdict) location) #:stop? stop?)
      (note-success!)))

(eval-when (expand load eval)
  (define comparators '(= < > <= >= eq? eqv? equal?))

  (define (marker? stx word)
    (eq? (syntax->datum stx) word))

  (define (comparator? stx)
    (and (identifier? stx)
         (memq (syntax->datum stx) comparators)
         (free-identifier=? stx (datum->syntax #'here (syntax->datum stx)))))

  (define (expand-claim stx clause)
    ;; The judge of CLAUSE, what stands after the head of STX.
    (syntax-case clause ()
      ((e arrow v) (marker? #'arrow '=>)
       #'(judge-same (lambda () e) (lambda () v) 'v))
      ((e is p) (marker? #'is 'is)
       #'(judge-is (lambda () e) (lambda () p) 'p))
      ((e raises (quot kind)) (and (marker? #'raises 'raises) (marker? #'quot 'quote))
       #'(judge-raise (lambda () e) 'kind))
      ((e raises kind) (and (marker? #'raises 'raises) (identifier? #'kind))
       #'(judge-raise (lambda () e) 'kind))
      ((e raises) (marker? #'raises 'raises)
       #'(judge-raise (lambda () e) #f))
      (((compare a b ...)) (comparator? #'compare)
       #'(judge-comparison 'compare compare (lambda (differ) (differ a b ...))))
      ((e)
       #'(judge-truth (lambda () e)))
      (_ (syntax-violation
          #f (string-append "say (expect E), (expect E => V), (expect E is P) or (expect E raises KIND)"
                            (marker-meant clause) ", not")
          stx))))

  (define (marker-meant clause)
    ;; Which marker a misspelt one is near to.
    (syntax-case clause ()
      ((e word . _)
       (identifier? #'word)
       (did-you-mean (syntax->datum #'word) '(=> is raises)))
      (_ ""))))

(define-syntax judge-of
  (lambda (stx)
    "(judge-of CLAUSE ...): a thunk that judges CLAUSE as `expect' does, and returns #f, or (EXPECTED . ACTUAL)."
    (syntax-case stx ()
      ((_ . clause) (expand-claim stx #'clause)))))

(define-syntax-rule (claim . clause)
  "(claim CLAUSE ...): judge CLAUSE as `expect' does.  Return #f, or (EXPECTED . ACTUAL)."
  ((judge-of . clause)))

(define-syntax expect
  (lambda (stx)
    "(expect E): E should be true.
(expect E => V): E should be V: numbers by `=', points and polylines number by number, else `equal?'.
(expect E is P): E should satisfy P, a predicate, such as (about 3 #:within 0.1), (between 1 2),
(above 0), (below 9) or exact-integer?.
(expect E raises KIND): E should raise an error of KIND, such as domain, name or unsupported.
In a scenario a failure is collected and the scenario goes on; elsewhere it raises.  Return #t or #f."
    (syntax-case stx ()
      ((_ . clause)
       #`(report-verdict '#,stx (source-location #,stx) (#,(expand-claim stx #'clause)))))))

(define-syntax require
  (lambda (stx)
    "(require E), (require E => V), (require E is P), (require E raises KIND): as `expect', but a
failure ends the scenario at once."
    (syntax-case stx ()
      ((_ . clause)
       #`(report-verdict '#,stx (source-location #,stx) (#,(expand-claim stx #'clause)) #:stop? #t)))))


;;; Comparing numbers, points and polylines.

(define (items value)
  ;; The list of items of a list, vector or array VALUE, or #f.
  (cond ((list? value) value)
        ((or (string? value) (bitvector? value)) #f)
        ((and (array? value) (positive? (array-rank value))) (array->list value))
        (else #f)))

(define (same? a b)
  "Return true if A and B are the same: numbers by `=', lists, vectors and arrays item by item and
whatever their kind, anything else by `equal?'."
  (if (and (number? a) (number? b))
      (= a b)
      (let ((as (items a)) (bs (items b)))
        (if (and as bs)
            (and (= (length as) (length bs)) (every same? as bs))
            (equal? a b)))))

(define (turn-between a b)
  ;; Degrees from A to B the short way, without sign.
  (let ((d (abs (- a b))))
    (abs (- d (* 360 (round (/ d 360)))))))

(define (hypotenuse numbers)
  (sqrt (apply + (map (lambda (x) (* x x)) numbers))))

(define* (discrepancy a b #:optional (distance (lambda (a b) (abs (- a b)))))
  ;; How far B is from A: of numbers the DISTANCE, of points the length of the difference, of
  ;; polylines that of the worst point; #f if they are of different shapes.
  (if (and (real? a) (real? b))
      (distance a b)
      (let ((as (items a)) (bs (items b)))
        (and as bs
             (= (length as) (length bs))
             (let ((each (map (lambda (a b) (discrepancy a b distance)) as bs)))
               (and (every identity each)
                    (if (every real? as) (hypotenuse each) (apply max 0 each))))))))

(define (size value)
  (cond ((real? value) (abs value))
        ((items value) => (lambda (all)
                            (if (every real? all) (hypotenuse all) (apply max 0 (map size all)))))
        (else 0)))

(define (measured? value levels)
  ;; Whether VALUE is a number, or consists of such LEVELS deep at most.
  (or (real? value)
      (and (positive? levels)
           (let ((all (items value)))
             (and all (every (lambda (item) (measured? item (- levels 1))) all))))))

(define (default-tolerance value)
  (let ((hundredth (* 0.01 (size value))))
    (if (zero? hundredth) 0.01 hundredth)))


;;; Predicates that can say what they wanted.

(define (named-predicate accept? text . values)
  (set-procedure-property! accept? 'wanted (apply simple-format #f text (map brief values)))
  accept?)

(define (describe-predicate accept? code)
  (or (procedure-property accept? 'wanted)
      (code->string code)))

(define (about-options options)
  ;; Read the tail of a call of `about': two values, the tolerance or #f and whether in degrees.
  (let loop ((rest options) (within #f) (degrees? #f))
    (cond ((null? rest) (values within degrees?))
          ((and (eq? (car rest) #:within) (pair? (cdr rest)) (real? (cadr rest)) (>= (cadr rest) 0))
           (loop (cddr rest) (cadr rest) degrees?))
          ((and (eq? (car rest) #:degrees) (pair? (cdr rest)) (real? (cadr rest)))
           (loop (cddr rest) (cadr rest) #t))
          ((and (eq? (car rest) #:degrees) (pair? (cdr rest)) (boolean? (cadr rest)))
           (loop (cddr rest) within (cadr rest)))
          ((eq? (car rest) #:degrees)
           (loop (cdr rest) within #t))
          (else
           (bight-raise 'domain 'about
                        "after the value come #:within TOLERANCE and #:degrees, not ~s" (car rest))))))

(define-verb (about (value any) #:rest (options any))
  "Return a predicate that accepts what is about VALUE: a number, a point or a polyline.
#:within TOLERANCE is the largest difference (for points the distance), by default a hundredth of
VALUE's size, or 0.01 if VALUE is zero.  With #:degrees the difference is taken round the compass, by
default within 1: (about 359 #:within 3 #:degrees), or (about 359 #:degrees 3)."
  (unless (measured? value 2)
    (bight-raise 'domain 'about "the value is a number, a point or a polyline, not ~s" value))
  (call-with-values (lambda () (about-options options))
    (lambda (within degrees?)
      (let ((tolerance (or within (if degrees? 1 (default-tolerance value)))))
        (named-predicate
         (lambda (given)
           (let ((off (if degrees?
                          (discrepancy value given turn-between)
                          (discrepancy value given))))
             (and off (<= off tolerance))))
         (if degrees? "about ~a degrees within ~a" "about ~a within ~a")
         value tolerance)))))

(define-verb (between (low number) (high number))
  "Return a predicate that accepts a number from LOW to HIGH, both included."
  (unless (<= low high)
    (bight-raise 'domain 'between "the lower bound comes first, not ~a ~a" low high))
  (named-predicate (lambda (given) (and (real? given) (<= low given high)))
                   "between ~a and ~a" low high))

(define-verb (above (low number))
  "Return a predicate that accepts a number greater than LOW."
  (named-predicate (lambda (given) (and (real? given) (> given low))) "above ~a" low))

(define-verb (below (high number))
  "Return a predicate that accepts a number less than HIGH."
  (named-predicate (lambda (given) (and (real? given) (< given high))) "below ~a" high))
