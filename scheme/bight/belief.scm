;;; (bight belief) --- a tether as it may be: beliefs, what they answer, and what they learn.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief)
  #:use-module (bight belief answer)
  #:use-module (bight belief cloud)
  #:use-module (bight belief condition)
  #:use-module (bight belief readings)
  #:use-module (bight belief tube)
  #:use-module (bight belief unknowns)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive past) #:select (entry-serial))
  #:use-module ((bight dive query) #:select (point-at tether-length tether-points type:arc-lengths))
  #:use-module (bight engine)
  #:use-module ((bight study sweep-design) #:select (draw-names))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (believe! define-belief make-belief
            belief ask-belief belief? with-belief
            observe! mend-belief! belief-doubts effective-size
            belief-values belief-about belief-hash fork-belief belief-threads!
            tether-tube tube-holds?
            ;; For (bight belief tour).
            (ready . ready-belief)
            ;; For (bight bench belief-tank).
            answer-of
            ;; What the macros expand to.
            clauses->belief! ask-picture nothing-asked)
  #:re-export (current-belief))

(define-verb (belief? (object any))
  "Return #t if OBJECT is a belief."
  (is-belief? object))

(define-argument-type (dive value)
  "a dive, as (enter! WORLD) returns"
  (if (dive? value) value refused))

(define-argument-type (member-count value)
  "a whole number of tethers from 8 to 4096"
  (if (and (exact-integer? value) (<= 8 value 4096)) value refused))

(define-argument-type (maybe-belief value)
  "a belief, as `believe!' returns, or #f for the current one"
  (if (or (not value) (is-belief? value)) value refused))


;;; A belief begins.

(define-verb (make-belief (dive dive) (clauses any) #:key (members member-count 64) (seed count 1)
                          (by (one-of smoother particles) 'smoother))
  "Return a belief of MEMBERS tethers in DIVE as it is now, about what CLAUSES, a list as `believe!' takes them,
say is uncertain.  What is drawn comes of SEED.  BY says how it learns: by a smoother, which flies the members
again, or by particles, which is quicker and surer of itself than it should be."
  (unless (list? clauses)
    (bight-raise 'domain 'make-belief "clauses come in a list, not ~s" clauses))
  (new-belief dive clauses members seed by))

(define (clauses->belief! clauses . options)
  "Make the belief of CLAUSES, a list of lists of them, of the current dive, and make it the current belief."
  (let ((belief (apply make-belief (this-dive 'believe!) (concatenate clauses) options)))
    (current-belief belief)
    belief))

(eval-when (expand load eval)
  (define (clause->expression stx)
    ;; A list of clauses: of one that is written here, or of a name that `define-belief' gave to some.
    (syntax-case stx ()
      ((head item ...) (identifier? #'head) #`(list (list 'head #,@(map field->expression #'(item ...)))))
      (name #'name)))

  (define (field->expression stx)
    (syntax-case stx ()
      ((kind value ...)
       (and (identifier? #'kind) (memq (syntax->datum #'kind) draw-names))
       #'(list 'kind value ...))
      ((field item ...)
       (identifier? #'field)
       #`(list 'field #,@(map distribution->expression #'(item ...))))
      (_ stx)))

  (define (distribution->expression stx)
    (syntax-case stx ()
      ((kind value ...)
       (and (identifier? #'kind) (memq (syntax->datum #'kind) draw-names))
       #'(list 'kind value ...))
      (_ stx))))

(define-syntax believe!
  (lambda (form)
    "Make a belief of the current dive, which becomes the current belief, and return it.  Each CLAUSE says what is
uncertain: (PART (FIELD DISTRIBUTION) ...), (payout DISTRIBUTION) for what the counter of the winch shows beyond
what is out, or (current (error DEVIATION) (levels Z ...) (correlation METRES)); or it is the name of clauses that
`define-belief' made.  A DISTRIBUTION is (normal MEAN DEVIATION), (uniform LOW HIGH) or (one-of VALUE ...).
Keywords at the end are those of `make-belief'."
    (syntax-case form ()
      ((_ item ...)
       (call-with-values
           (lambda () (break (lambda (stx) (keyword? (syntax->datum stx))) #'(item ...)))
         (lambda (clauses options)
           #`(clauses->belief! (list #,@(map clause->expression clauses)) #,@options)))))))

(define-syntax define-belief
  (lambda (form)
    "Give CLAUSES, what is uncertain as `believe!' takes it, the name NAME, with a sentence."
    (syntax-case form ()
      ((_ name doc clause ...)
       (string? (syntax->datum #'doc))
       #`(define name (append #,@(map clause->expression #'(clause ...))))))))


;;; Asking.

(define (belief-here proc)
  ;; The current belief, which must be of the current dive.
  (let ((belief (this-belief proc)))
    (unless (eq? (belief-host belief) (this-dive proc))
      (bight-raise 'domain proc "the current belief is of another dive; believe! makes one of this dive, (fork-belief) one \
of a fork"))
    belief))

(define (flown proc belief)
  ;; BELIEF, or the current one, flown on to where its dive is.
  (let ((belief (or belief (belief-here proc))))
    (catch-up! proc belief)
    (when (null? (living belief))
      (bight-raise 'diverged proc "no tether of this belief is left: each one's dive failed"))
    belief))

(define (ready proc belief)
  ;; The same, mended if its weights ask for that.
  (let ((belief (flown proc belief)))
    (mend-if-due! belief)
    belief))

(define-verb (ask-belief (belief maybe-belief) (thunk thunk))
  "Call THUNK with each tether's dive as the current one, and return all answers as one: a probability with its
interval, quantiles, a mean with its ellipsoid, or shares.  With BELIEF #f the current belief is asked."
  (ask-members (ready 'belief belief) thunk))

(define-syntax-rule (with-belief b body body* ...)
  "Evaluate the body with B as the current belief."
  (parameterize ((current-belief b)) body body* ...))

(define (ask-picture belief thunk)
  "Return what THUNK does in the dive of BELIEF, or of the current one: a picture, which draws the belief itself."
  (let ((belief (flown 'belief belief)))
    (call-with-dive (belief-host belief) (lambda () (with-belief belief (thunk))))))

(define (nothing-asked)
  "Raise the &bight-error of a `belief' that asks nothing."
  (bight-raise 'def 'belief "say what is asked, as in (belief fouled?) or (belief (point-at 20))"))

(eval-when (expand load eval)
  (define drawn '((look #:belief #t) (show #:overlay 'belief) (snapshot #:overlay 'belief)))

  (define (drawn-with stx arguments)
    ;; What lets the picture that STX, an identifier, draws by ARGUMENTS show the belief, a list; #f: it draws none.
    (let ((more (and (identifier? stx) (assq-ref drawn (syntax->datum stx)))))
      (and more
           (if (memq (car more) (map syntax->datum arguments)) '() (datum->syntax stx more))))))

(define-syntax belief
  (lambda (form)
    "Ask each QUESTION, such as fouled? or (point-at 20), of the current belief, and return its answer; of several
questions, a list.  Of look, show and snapshot there is one picture, with the tubes that hold the tethers."
    (define (question stx)
      (syntax-case stx ()
        ((head argument ...)
         (drawn-with #'head #'(argument ...))
         #`(ask-picture #f (lambda () (head argument ... #,@(drawn-with #'head #'(argument ...))))))
        (head
         (drawn-with #'head '())
         #`(ask-picture #f (lambda () (head #,@(drawn-with #'head '())))))
        (name (identifier? #'name) #'(ask-belief #f name))
        (_ #`(ask-belief #f (lambda () #,stx)))))
    (syntax-case form ()
      ((_) #'(nothing-asked))
      ((_ asked) (question #'asked))
      ((_ asked ...) #`(list #,@(map question #'(asked ...)))))))

(define-verb (effective-size #:optional (belief maybe-belief #f))
  "Return how many equal tethers would be as good as those of BELIEF with their weights."
  (effective-number (weights (flown 'effective-size belief))))

(define-verb (belief-values #:optional (belief maybe-belief #f))
  "Return what is uncertain, with the answer of BELIEF for each: an alist.  The current's answers are its error
toward east and north at each level, m/s: (current HEIGHT EAST NORTH)."
  (let* ((belief (ready 'belief-values belief))
         (values (map (lambda (m) (unknown-values (belief-unknowns belief) (member-latent m))) (living belief))))
    (append-map (lambda (name) (named-answers belief name (map (lambda (v) (assq-ref v name)) values)))
                (unknown-names (belief-unknowns belief)))))

(define (answer-of belief values)
  ;; The answer of which the members of BELIEF told VALUES in their order.
  (let ((rest values))
    (ask-members belief (lambda () (let ((value (car rest))) (set! rest (cdr rest)) value)))))

(define (named-answers belief name values)
  (if (eq? name 'current)
      (map (lambda (level)
             (let ((rows (map (lambda (v) (list-ref v level)) values)))
               (list 'current (first (car rows))
                     (answer-of belief (map second rows)) (answer-of belief (map third rows)))))
           (iota (length (car values))))
      (list (cons name (answer-of belief values)))))


;;; Observing.

(define-argument-type (reading-kind value)
  "a kind of reading"
  (if (symbol? value) value refused))

(define (step-of belief at)
  ;; The step of the time AT of a reading, or of now.
  (let* ((engine (engine-of (belief-host belief)))
         (now (%dive-steps engine))
         (step (if at (inexact->exact (round (/ at (%dive-time-step engine)))) now)))
    (when (> step now)
      (bight-raise 'domain 'observe! "a reading at ~a s is not yet: it is ~a s" at (%dive-time engine)))
    step))

(define (serial-of belief)
  (let ((applied (belief-applied belief)))
    (if (pair? applied) (entry-serial (car applied)) 0)))

(define (named-subject proc kind name keyword)
  ;; The name of the vehicle or tether, as KIND says, called NAME; with #f of the only one.  KEYWORD is how one says which.
  (list-ref (%names (this-engine proc) (if (eq? kind 'vehicle) 'rov kind))
            (subject-index proc kind name (lambda (name) (string-append keyword " '" (symbol->string name))))))

(define (tether-of proc belief name)
  ;; The name of the tether called NAME, or with #f of the only one, of the dive of BELIEF.
  (call-with-dive (belief-host belief) (lambda () (named-subject proc 'tether name "#:tether"))))

(define (beside kind on vehicle tether)
  ;; What a reading of KIND is given beside its value: the name of what it was read of, and of a transponder the arc length.
  (when (and (eq? kind 'transponder) (not on))
    (bight-raise 'def 'observe! "where along the tether is the transponder?  Say #:on METRES"))
  (cons (if (of-vehicle? kind)
            (named-subject 'observe! 'vehicle vehicle "#:subject")
            (named-subject 'observe! 'tether tether "#:tether"))
        (if (eq? kind 'transponder) (list on) '())))

(define-verb (observe! (belief maybe-belief) (kind reading-kind) (value any) #:key (at non-negative #f)
                       (noise positive (and (memq kind reading-kinds) (usual-noise kind)))
                       (on non-negative #f) (subject name #f) (tether name #f))
  "Let BELIEF, or the current one if that is #f, go by a reading: KIND payout (m), winch-tension or rov-tension (N),
position (a point), heading (degrees), depth (m), transponder (a point, ON metres along the tether), seen (a point
of the tether) or touched (an obstacle, or (not OBSTACLE)).  Where there are several, SUBJECT names the vehicle of a
position, heading or depth, and TETHER the tether of all others.  NOISE is its standard deviation, of `touched' the
probability that it is false; AT the time when it was read, s.  Return `taken', `impossible' if no tether explains
it, which `belief-doubts' tells of, or `late' if the belief is past that time."
  (let ((belief (or belief (belief-here 'observe!))))
    (call-with-dive
     (belief-host belief)
     (lambda ()
       (let* ((value (check-reading kind value))
              (part (beside kind on subject tether))
              (step (step-of belief at)))
         (if (< step (belief-step belief))
             'late
             (begin
               (catch-up! 'observe! belief step)
               (take-reading! belief
                              (make-reading step (serial-of belief) kind value noise part
                                            (if (event? kind) #f value) '() #f)))))))))

(define-verb (mend-belief! #:optional (belief maybe-belief #f))
  "Let the tethers of BELIEF go by all that was observed, now; a belief does so by itself before it answers, when few
of its tethers bear the weight.  Return the belief."
  (let ((belief (ready 'mend-belief! belief)))
    (mend! belief)
    belief))

(define-verb (belief-doubts #:optional (belief maybe-belief #f))
  "Return the readings that no tether of BELIEF could explain, the last first: lists (TIME KIND VALUE EXPECTED
DEVIATION)."
  (let* ((belief (or belief (this-belief 'belief-doubts)))
         (time-step (%dive-time-step (engine-of (belief-host belief)))))
    (map (lambda (doubt)
           (let ((reading (first doubt)))
             (cons* (* time-step (reading-step reading)) (reading-kind reading) (one-or-all (reading-value reading))
                    (cdr doubt))))
         (belief-doubted belief))))

(define-verb (belief-about #:optional (belief maybe-belief #f))
  "Return how BELIEF stands, an alist: how many tethers; how many effective, before it is mended; how many lost; how it
was mended, lists of how, in how many stages and at which step; and how many readings it doubts."
  (let ((belief (flown 'belief-about belief)))
    `((tethers . ,(length (belief-members belief)))
      (effective . ,(effective-number (weights belief)))
      (lost . ,(- (length (belief-members belief)) (length (living belief))))
      (mended . ,(reverse (belief-rounds belief)))
      (doubts . ,(length (belief-doubted belief))))))

(define-verb (belief-hash #:optional (belief maybe-belief #f))
  "Return a number that tells BELIEF from any other: beliefs have the same one if all their tethers, the values of what
is uncertain and the weights are the same to the last bit."
  (let ((belief (flown 'belief-hash belief)))
    (fold (lambda (member sum)          ; homogeneous vectors are bytevectors, too
            (fold %checksum sum
                  (list (member-latent member) (f64vector (member-weight member) (member-event-weight member))
                        (u64vector (%hash-dive (engine-of (member-dive member)))))))
          0 (belief-members belief))))

(define-verb (fork-belief #:optional (belief maybe-belief #f))
  "Return a copy of BELIEF that belongs to the current dive: the dive of BELIEF itself, or a fork of it, as within
`what-if'."
  (let ((belief (ready 'fork-belief (or belief (this-belief 'fork-belief)))))
    (fork-of-belief belief (this-dive 'fork-belief))))

(define-verb (belief-threads! (n (between 1 64)) #:optional (belief maybe-belief #f))
  "Let up to N threads step the tethers of BELIEF; without this verb, as many as there are processors.  What comes
of it is the same to the last bit.  Return N."
  (set-belief-threads-of! (or belief (this-belief 'belief-threads!)) (inexact->exact (round n)))
  n)


;;; The tube.

(define-argument-type (station-count value)
  "a whole number of places from 2 to 400"
  (if (and (exact-integer? value) (<= 2 value 400)) value refused))

(define (row polyline i)
  (f64vector (array-ref polyline i 0) (array-ref polyline i 1) (array-ref polyline i 2)))

(define-verb (tether-tube #:key (belief maybe-belief #f) (share (between 0.01 0.99) 0.9) (n station-count 25)
                          (at arc-lengths #f) (noise non-negative 0.0) (tether name #f))
  "Return the tube that holds the TETHER, by its name where there are several, of BELIEF with probability SHARE at each
of N places, equally spaced in arc length from the anchor, or of the arc lengths AT: a list of ellipsoids, each a list of
its centre and its three half axes.  With NOISE, m, it holds what is seen of the tether with such an error in each
direction.  Of n tethers the tube holds n in n + 1 at most."
  (map (lambda (e) (cons (ellipsoid-mean e) (ellipsoid-axes e))) (tube-of 'tether-tube belief share (or at n) noise tether)))

(define (points-of tether places)
  ;; A list: at so many PLACES, equally spaced, or at each of a list of arc lengths.
  (if (list? places)
      (map (lambda (s) (point-at tether (min s (tether-length tether)))) places)
      (let ((line (tether-points tether places)))
        (map (lambda (i) (row line i)) (iota places)))))

(define (tube-of proc belief share places noise tether)
  (let* ((belief (ready proc belief)) (tether (tether-of proc belief tether))
         (lines (map car (answer-values (ask-members belief (lambda () (list (points-of tether places))))))))
    (apply map (lambda points (ellipsoid (answer-of belief points) share noise)) lines)))

(define-verb (tube-holds? (points points) #:key (belief maybe-belief #f) (share (between 0.01 0.99) 0.9)
                          (at arc-lengths #f) (noise non-negative 0.0) (tether name #f))
  "Return for each of POINTS, equally spaced along a tether from the anchor on, or at the arc lengths AT, whether the
tube of the TETHER of BELIEF for SHARE holds it, a list.  With NOISE the points were seen with such an error, m, in each
direction."
  (let ((n (array-length points)))
    (when (and at (not (= n (length at))))
      (bight-raise 'domain 'tube-holds? "~a arc lengths were given for ~a points" (length at) n))
    (map (lambda (e i) (ellipsoid-holds? e (row points i)))
         (tube-of 'tube-holds? belief share (or at n) noise tether)
         (iota n))))
