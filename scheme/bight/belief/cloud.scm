;;; (bight belief cloud) --- a cloud of tethers: many forks of one dive, each with values of its own for what is
;;; uncertain.
;;;
;;; A belief belongs to one dive and follows it: when it is asked, it does to all its members what the journal of
;;; the dive tells that was done to the dive, at the same steps.  So the verbs that drive the dive drive all
;;; members, autopilots, pilots and live dives included, and a dive with a belief costs nothing until it is asked.
;;;
;;; What was observed stays beside the journal, each reading in its place among the operations, so that the
;;; members can be flown again from where the belief began, with other values of what is uncertain, and every
;;; reading be predicted anew: (bight belief condition).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief cloud)
  #:use-module (bight belief unknowns)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive past)
  #:use-module ((bight dive aware) #:select (fouled?))
  #:use-module (bight engine)
  #:use-module ((ice-9 threads) #:select (current-processor-count))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (new-belief member? reading?
            fork-of-belief
            make-member bare-fork belief-processors member-origin member-origin-error member-engine
            make-belief-record belief-clauses belief-origin-journal belief-origin-current belief-current
            is-belief?
            belief-host belief-unknowns belief-seed belief-kind
            belief-members belief-step belief-origin-step
            belief-readings set-belief-readings!
            belief-doubted set-belief-doubted!
            belief-rounds set-belief-rounds!
            belief-threads-of set-belief-threads-of! belief-applied
            member-dive member-latent set-member-latent!
            member-event-weight set-member-event-weight!
            member-weight set-member-weight!
            member-lost? living
            make-reading reading-step reading-serial reading-kind reading-value reading-noise reading-part
            reading-scalars set-reading-scalars! reading-predictions set-reading-predictions!
            reading-done? set-reading-done!
            catch-up! entries-since fly-again! forget-past! copy-member! way-back in-member unless-refused
            weights effective-number
            current-belief this-belief type:belief))


;;; Records.

(define-record <member>
  (make-member dive latent weight event-weight lost? origin origin-error)
  member?
  (dive member-dive)
  (latent member-latent set-member-latent!)
  (weight member-weight set-member-weight!) ; logarithm, of what numbers were read since the last mending
  (event-weight member-event-weight set-member-event-weight!) ; the same of what was seen to happen
  (lost? member-lost? set-member-lost!) ; true if its dive failed, or refused what was done
  (origin member-origin set-member-origin!) ; its state where the belief is flown again from
  (origin-error member-origin-error set-member-origin-error!)) ; of its winch's counter then, m

(define-record <reading>
  (make-reading step serial kind value noise part scalars predictions done?)
  reading?
  (step reading-step)
  (serial reading-serial)               ; of the last operation before it
  (kind reading-kind)
  (value reading-value)
  (noise reading-noise)
  (part reading-part)                   ; what it was given beside, a list
  (scalars reading-scalars set-reading-scalars!) ; the numbers read, an f64vector; #f: it is an event
  (predictions reading-predictions set-reading-predictions!) ; an f64vector of each member
  (done? reading-done? set-reading-done!)) ; true if the values of what is uncertain go by it already

(define-record <belief>
  (make-belief-record host clauses unknowns seed kind members step origin-step origin-journal origin-current applied
                      current readings doubted rounds threads)
  is-belief?
  (host belief-host)                    ; the dive
  (clauses belief-clauses)              ; that say what is uncertain
  (unknowns belief-unknowns)
  (seed belief-seed)
  (kind belief-kind)                    ; smoother or particles
  (members belief-members)              ; a list
  (step belief-step set-belief-step!)   ; to which the members were flown
  (origin-step belief-origin-step set-belief-origin-step!)
  (origin-journal belief-origin-journal set-belief-origin-journal!) ; the dive's then
  (origin-current belief-origin-current set-belief-origin-current!) ; the dive's then, numbers
  (applied belief-applied set-belief-applied!) ; of the dive's journal: what was done to all members; #f: nobody knows
  (current belief-current set-belief-current!) ; the dive's, as far as the members were told
  (readings belief-readings set-belief-readings!) ; since the origin, the newest first
  (doubted belief-doubted set-belief-doubted!) ; readings that were impossible, the newest first
  (rounds belief-rounds set-belief-rounds!) ; how often it was mended, and what that was
  (threads belief-threads-of set-belief-threads-of!))

(set-record-type-printer!
 <belief>
 (lambda (belief port)
   (simple-format port "#<belief of ~a tethers in ~a>" (length (belief-members belief)) (belief-host belief))))

(define-argument-type (belief value)
  "a belief, as `believe!' returns"
  (if (is-belief? value) value refused))

(define current-belief
  ;; The belief that `belief' asks, or #f.
  (make-parameter #f (lambda (value)
                       (check-argument 'current-belief 'belief (type:or-false belief) value))))

(set-object-property! current-belief 'documentation
                      "Return the belief that is asked where none is named, or #f.  A parameter.")

(define (this-belief proc)
  "Return the current belief, or raise a &bight-error from PROC when there is none."
  (or (current-belief)
      (bight-raise 'def proc "nothing is believed yet; say what is uncertain, as in \
(believe! (current (error 0.1)))")))


;;; Members.

(define (living belief)
  "Return the members of BELIEF whose dives did not fail."
  (remove member-lost? (belief-members belief)))

(define (in-member member thunk)
  "Call THUNK with the dive of MEMBER as the current one."
  (parameterize ((current-dive (member-dive member)))
    (thunk)))

(define (member-engine member)
  (engine-of (member-dive member)))

(define (unless-refused thunk otherwise)
  "Return what THUNK does, or what the thunk OTHERWISE does where a dive refuses."
  (with-exception-handler
   (lambda (e) (if (bight-error? e) (otherwise) (raise-exception e)))
   thunk
   #:unwind? #t))

(define (or-lost member thunk)
  ;; Call THUNK; MEMBER is lost if its dive refuses.
  (unless-refused thunk (lambda () (set-member-lost! member #t))))

(define (set-current! engine numbers)
  (%redo! engine 'current 0 numbers))

(define (spool! engine metres)
  ;; Let the winch of the first tether correct what is out by METRES; how fast is up to the winch.
  (unless (< (abs metres) 1e-9)
    (%redo! engine (if (> metres 0) 'pay-out 'haul-in) 0 (f64vector (abs metres) 1000.0))))

(define (begin-member! belief member)
  ;; Back to where the belief is flown from, with the member's present values.
  (let* ((engine (member-engine member))
         (unknowns (belief-unknowns belief))
         (latent (member-latent member)))
    (%restore-dive! engine (member-origin member))
    (set-member-lost! member #f)
    (or-lost member
             (lambda ()
               (in-member member (lambda () (settle-unknowns! unknowns latent)))
               (set-current! engine (moved-current unknowns latent (belief-origin-current belief)))
               (spool! engine (- (member-origin-error member) (counter-error unknowns latent)))))))

(define (copy-member! belief to from)
  "Let the member TO of BELIEF be as the member FROM is: its state and its values."
  (unless (eq? to from)
    (be-as! to from (%save-dive (member-engine from)))))


;;; A belief begins.

(define (new-belief dive clauses members seed kind)
  "Return a belief of MEMBERS tethers in DIVE, where what CLAUSES say is uncertain, drawn from SEED and
conditioned as KIND says."
  (parameterize ((current-dive dive))
    (let* ((engine (engine-of dive))
           (unknowns (read-unknowns clauses)))
      (when (null? (%names engine 'tether))
        (bight-raise 'def 'believe! "this dive has no tether to believe anything of"))
      (when (%asks? engine)
        (bight-raise 'unsupported 'believe! "the current of this dive is a procedure, which many dives cannot ask \
at once"))
      (for-each fouled? (%names engine 'tether)) ; forks share the charts that the dive has made
      (let* ((state (%save-dive engine))
             (belief (make-belief-record
                      dive clauses unknowns seed kind
                      (map (lambda (latent) (make-member (bare-fork dive) latent 0.0 0.0 #f state 0.0))
                           (latent-draws unknowns members seed))
                      (%dive-steps engine) (%dive-steps engine) (%journal engine)
                      (%current-numbers engine) (%journal engine) (%current-numbers engine)
                      '() '() '() (belief-processors))))
        (for-each (lambda (member) (begin-member! belief member)) (belief-members belief))
        belief))))

(define (belief-processors)
  "Return how many threads step a belief where nobody says."
  (current-processor-count))

(define (bare-fork dive)
  "Return a fork of DIVE for a member: what runs between the steps of DIVE shows in its journal."
  (let ((fork (fork-dive dive)))
    (set-dive-tasks! fork '())
    (set-dive-past! fork #f)
    fork))

(define (fork-of-belief belief dive)
  "Return a copy of BELIEF that follows DIVE, a fork of the dive it belongs to, from now on."
  (make-belief-record
   dive (belief-clauses belief) (belief-unknowns belief) (belief-seed belief) (belief-kind belief)
   (map (lambda (m)
          (make-member (bare-fork (member-dive m)) (member-latent m) (member-weight m) (member-event-weight m)
                       (member-lost? m) (member-origin m) (member-origin-error m)))
        (belief-members belief))
   (belief-step belief) (belief-origin-step belief) (belief-origin-journal belief)
   (belief-origin-current belief) (belief-applied belief) (belief-current belief)
   (map copy-reading (belief-readings belief))
   (belief-doubted belief) (belief-rounds belief) (belief-threads-of belief)))

(define (way-back belief)
  "Return a thunk that lets BELIEF be as it is now."
  (let ((members (map member-way-back (belief-members belief))) (readings (map copy-reading (belief-readings belief)))
        (fields (map (lambda (field) (cons (cdr field) ((car field) belief)))
                     (list (cons belief-step set-belief-step!) (cons belief-origin-step set-belief-origin-step!)
                           (cons belief-origin-journal set-belief-origin-journal!)
                           (cons belief-origin-current set-belief-origin-current!)
                           (cons belief-applied set-belief-applied!) (cons belief-current set-belief-current!)
                           (cons belief-doubted set-belief-doubted!) (cons belief-rounds set-belief-rounds!)))))
    (lambda ()
      (for-each (lambda (back!) (back!)) members)
      (set-belief-readings! belief readings)
      (for-each (lambda (field) ((car field) belief (cdr field))) fields))))

(define (member-way-back m)
  ;; The same of the member M.
  (let ((now (make-member #f (member-latent m) (member-weight m) (member-event-weight m) (member-lost? m)
                          (member-origin m) (member-origin-error m)))
        (state (%save-dive (member-engine m))))
    (lambda () (be-as! m now state))))

(define (be-as! to from state)
  (%restore-dive! (member-engine to) state)
  (set-member-latent! to (member-latent from))
  (set-member-weight! to (member-weight from))
  (set-member-event-weight! to (member-event-weight from))
  (set-member-lost! to (member-lost? from))
  (set-member-origin! to (member-origin from))
  (set-member-origin-error! to (member-origin-error from)))

(define (copy-reading r)
  (make-reading (reading-step r) (reading-serial r) (reading-kind r) (reading-value r) (reading-noise r)
                (reading-part r) (reading-scalars r) (reading-predictions r) (reading-done? r)))


;;; Following the dive.

(define (entries-since journal old)
  "Return the entries of JOURNAL that OLD, an earlier one, lacks, the oldest first; #f if OLD is none."
  (let loop ((rest journal) (new '()))
    (cond ((eq? rest old) new)
          ((null? rest) #f)
          (else (loop (cdr rest) (cons (car rest) new))))))

(define (journal-until journal step)
  ;; JOURNAL without what was done after STEP.
  (if (and (pair? journal) (> (entry-step (car journal)) step))
      (journal-until (cdr journal) step)
      journal))

(define (step-members! belief step)
  (let* ((members (living belief))
         (failed (%step-dives! (engine-of (belief-host belief)) (map member-engine members) step
                               (min (belief-threads-of belief) (max 1 (length members))))))
    (for-each (lambda (place) (set-member-lost! (list-ref members place) #t)) failed)
    (set-belief-step! belief (max step (belief-step belief)))))

(define (do-to-member! belief member entry)
  ;; After an alteration what is uncertain has the member's own values again.
  (let ((unknowns (belief-unknowns belief)) (latent (member-latent member)) (numbers (entry-numbers entry)))
    (or-lost member
             (lambda ()
               (case (entry-operation entry)
                 ((current) (set-current! (member-engine member) (moved-current unknowns latent numbers)))
                 (else (%redo! (member-engine member) (entry-operation entry) (entry-subject entry) numbers)))
               (when (eq? 'alter (entry-operation entry))
                 (in-member member (lambda () (settle-unknowns! unknowns latent))))))))

(define (do-to-members! belief entry)
  (when (eq? 'current (entry-operation entry))
    (set-belief-current! belief (entry-numbers entry)))
  (for-each (lambda (member) (do-to-member! belief member entry)) (living belief)))

(define (follow! belief entries step)
  ;; Do ENTRIES to the members, each at its step, and fly them on to STEP.  Who leaves in between, as by ^C, leaves nobody
  ;; who knows what was done to which member.
  (set-belief-applied! belief #f)
  (for-each (lambda (entry)
              (step-members! belief (entry-step entry))
              (do-to-members! belief entry))
            entries)
  (step-members! belief step))

(define (went-back proc)
  (bight-raise 'stale proc "the dive went back to before its belief began; believe anew"))

(define* (catch-up! proc belief #:optional (step (%dive-steps (engine-of (belief-host belief)))))
  "Fly the members of BELIEF on to STEP, where its dive is now or was, doing what was done to the dive.  If the
dive has gone back, or nobody knows what was done to which member, they are flown again.  Raise stale from PROC if it went
back too far."
  (let* ((engine (engine-of (belief-host belief)))
         (journal (journal-until (%journal engine) step))
         (new (entries-since journal (belief-applied belief))))
    (if (and new
             (>= step (belief-step belief))
             (or (null? new) (>= (entry-step (car new)) (belief-step belief))))
        (begin
          (follow! belief new step)
          (set-belief-applied! belief journal))
        (begin
          (when (or (< step (belief-origin-step belief))
                    (not (entries-since journal (belief-origin-journal belief))))
            (went-back proc))
          (set-belief-readings! belief
                                (remove (lambda (r) (> (reading-step r) step)) (belief-readings belief)))
          (fly-again! belief #:journal journal #:step step)))))

(define* (fly-again! belief #:key (journal (belief-applied belief)) (step (belief-step belief))
                     (look! (const #f)))
  "Fly the members of BELIEF again from its origin to STEP by JOURNAL, with their present values, and call LOOK!
with each reading when they are where it was read."
  (set-belief-applied! belief #f)
  (for-each (lambda (member) (begin-member! belief member)) (belief-members belief))
  (set-belief-step! belief (belief-origin-step belief))
  (set-belief-current! belief (belief-origin-current belief))
  (let loop ((entries (entries-since journal (belief-origin-journal belief)))
             (readings (reverse (belief-readings belief))))
    (cond ((and (pair? readings) (or (null? entries) (before? (car readings) (car entries))))
           (step-members! belief (reading-step (car readings)))
           (look! (car readings))
           (loop entries (cdr readings)))
          ((pair? entries)
           (follow! belief (list (car entries)) (entry-step (car entries)))
           (loop (cdr entries) readings))))
  (step-members! belief step)
  (set-belief-applied! belief journal))

(define (before? reading entry)
  (or (< (reading-step reading) (entry-step entry))
      (and (= (reading-step reading) (entry-step entry))
           (< (reading-serial reading) (entry-serial entry)))))

(define (forget-past! belief)
  "Let the members of BELIEF be flown again, when they are, from where they are now."
  (for-each (lambda (member)
              (unless (member-lost? member)
                (set-member-origin! member (%save-dive (member-engine member)))
                (set-member-origin-error! member
                                          (counter-error (belief-unknowns belief) (member-latent member)))))
            (belief-members belief))
  (set-belief-origin-step! belief (belief-step belief))
  (set-belief-origin-journal! belief (belief-applied belief))
  (set-belief-origin-current! belief (belief-current belief))
  (set-belief-readings! belief '()))


;;; Weights.

(define (normalised logarithms)
  ;; Shares, f64vector, that the logarithms of weights stand for.
  (let* ((most (fold max -inf.0 logarithms))
         (raw (map (lambda (l) (exp (- l most))) logarithms))
         (sum (apply + raw)))
    (list->f64vector (map (lambda (w) (/ w sum)) raw))))

(define (weights belief)
  "Return the shares of the living members of BELIEF, an f64vector."
  (normalised (map (lambda (m) (+ (member-weight m) (member-event-weight m))) (living belief))))

(define (effective-number shares)
  "Return how many equal members would be as good as those with SHARES (Kong, Liu and Wong, Journal of the
American Statistical Association 89, 1994)."
  (/ 1 (fold (lambda (w sum) (+ sum (* w w))) 0.0 (f64vector->list shares))))
