;;; (bight dive recording) --- what was done to a dive, step by step, and the proof that it comes out the same.
;;;
;;; A recording is a story, see (bight dive story), that goes on with what was done and what came of it:
;;;
;;;   (do STEP OPERATION SUBJECT NUMBER ...)
;;;   (steps FIRST "HASHES")                    ; 32 bits of the state after each step from FIRST on
;;;   (second STEP "HASH" QUANTITY ... "CHECKSUM")
;;;   (state ...)                               ; after the dive was taken back
;;;   (end STEP "HASH" "CHECKSUM")
;;;
;;; A QUANTITY is (rov NAME x y z heading) or (tether NAME length tension-at-anchor tension-at-end
;;; "16 bits of each node").  What `every', `on' and pilots did is recorded like everything else, so that a
;;; replay needs none of their code.  Each second is handed to the system at once, and once a second of real
;;; time to the disk.  While the dive is live, a thread of Scheme's own writes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive recording)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive past)
  #:use-module (bight dive story)
  #:use-module (bight engine)
  #:use-module (bight world)
  #:use-module (ice-9 exceptions)
  #:use-module (ice-9 threads)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (record! stop-recording! recording? recorder? replay replay-file
            redo-line! after-beginning     ; for (bight dive reel)
            entry->line                    ; for (bight dive flight)
            difference? difference-step difference-time difference-quantities))

(define second-long 60)                 ; steps
(define frame-every 6)                  ; steps: ten frames a second

(define-syntax-rule (from module name)
  ;; The value of NAME in MODULE, loaded now.
  (module-ref (resolve-interface 'module) 'name))


;;; Operations as lines.

(define operations (%operations))

(define (part-names engine head)
  (if (eq? head 'sea) '(sea) (%names engine head)))

(define part-heads '(sea rov tether obstacle)) ; by the engine's numbers

(define (schema-head engine world head index)
  ;; The head that the fields of the INDEX-th part of kind HEAD belong to.
  (if (eq? head 'obstacle)
      (part-head (world-part world (list-ref (%names engine 'obstacle) index)))
      head))

(define (field-names head)
  (map (lambda (v) (vector-ref v 0)) (%part-fields head)))

(define (alter->words engine world subject numbers)
  ;; PART FIELD VALUE
  (let ((head (list-ref part-heads (inexact->exact (first numbers)))))
    (list (list-ref (part-names engine head) subject)
          (list-ref (field-names (schema-head engine world head subject))
                    (inexact->exact (second numbers)))
          (third numbers))))

(define (entry->line engine world entry)
  "Return the line of a recording for ENTRY of the journal of ENGINE, a dive in WORLD."
  (let* ((operation (entry-operation entry))
         (head (assq-ref operations operation))
         (subject (entry-subject entry))
         (numbers (f64vector->list (entry-numbers entry))))
    (cons* 'do (entry-step entry) operation
           (cond ((eq? operation 'alter) (alter->words engine world subject numbers))
                 (head (cons (list-ref (part-names engine head) subject) numbers))
                 (else (cons subject numbers))))))

(define (index-of name names)
  (or (list-index (lambda (other) (eq? name other)) names)
      (unknown-name 'replay "the recorded world" name names "part")))

(define (find-subject engine name)
  ;; Two values: the number of the kind of the part called NAME, and its index.
  (let ((kind (list-index (lambda (head) (memq name (part-names engine head))) part-heads)))
    (unless kind
      (unknown-name 'replay "the recorded world" name
                    (append-map (lambda (head) (part-names engine head)) part-heads) "part"))
    (values kind (index-of name (part-names engine (list-ref part-heads kind))))))

(define (redo-alter! engine world name field value)
  (call-with-values (lambda () (find-subject engine name))
    (lambda (kind index)
      (let ((fields (field-names (schema-head engine world (list-ref part-heads kind) index))))
        (%redo! engine 'alter index (f64vector kind (index-of field fields) value))))))

(define (redo-line! engine world line)
  ;; Do what LINE, (do STEP OPERATION SUBJECT NUMBER ...), says.
  (let* ((operation (third line)) (rest (cdddr line)) (head (assq-ref operations operation)))
    (if (eq? operation 'alter)
        (apply redo-alter! engine world rest)
        (%redo! engine operation
                (if head (index-of (car rest) (part-names engine head)) (car rest))
                (list->f64vector (cdr rest))))))


;;; What came of it.

(define (digits n width)
  (let ((text (number->string n 16)))
    (string-append (make-string (- width (string-length text)) #\0) text)))

(define (rov-quantities engine name i)
  (let ((v (%vehicle engine i)))
    `(rov ,name ,@(f64vector->list (assq-ref v 'position)) ,(assq-ref v 'heading))))

(define (tether-quantities engine name i)
  (let ((t (%tether engine i)))
    `(tether ,name ,(assq-ref t 'length) ,(assq-ref t 'tension-anchor) ,(assq-ref t 'tension-end)
             ,(%node-digits engine i))))

(define (of-each engine head quantities)
  (let ((names (%names engine head)))
    (map (lambda (name i) (quantities engine name i)) names (iota (length names)))))

(define (quantities engine)
  (append (of-each engine 'rov rov-quantities) (of-each engine 'tether tether-quantities)))

(define (short-hash engine)
  (logand #xffffffff (%hash-dive engine)))


;;; The recorder.

(define-record <recorder>
  (make-recorder dive teller mutex serial second first hashes synced frames pending thread scratch)
  recorder?
  (dive recorder-dive)
  (teller recorder-teller)
  (mutex recorder-mutex)
  (serial recorder-serial set-recorder-serial!) ; of the last operation written
  (second recorder-second set-recorder-second!) ; the step of the last `second' written
  (first recorder-first set-recorder-first!)    ; the step of the first of HASHES
  (hashes recorder-hashes set-recorder-hashes!) ; 8 digits of each, the last text first
  (synced recorder-synced set-recorder-synced!) ; when the file was last brought to the disk
  (frames recorder-frames)                      ; a database, or #f
  (pending recorder-pending set-recorder-pending!) ; frames not written yet, the last first
  (thread recorder-thread set-recorder-thread!)    ; that writes while the dive is live, or #f
  (scratch recorder-scratch set-recorder-scratch!)) ; a fork to look at what such a dive was

(define (recorder-engine r)
  (engine-of (recorder-dive r)))

(define (write-entries! r before)
  ;; Write what was done since, before the step BEFORE.
  (let* ((engine (recorder-engine r)) (world (dive-world (recorder-dive r)))
         (entries (filter (lambda (e) (< (entry-step e) before))
                          (take-while (lambda (e) (> (entry-serial e) (recorder-serial r)))
                                      (%journal engine)))))
    (for-each (lambda (e)
                (tell-datum! (recorder-teller r) (entry->line engine world e))
                (set-recorder-serial! r (entry-serial e)))
              (reverse entries))))

(define (write-hashes! r)
  (unless (null? (recorder-hashes r))
    (tell-datum! (recorder-teller r)
           (list 'steps (recorder-first r)
                 (string-concatenate (reverse (recorder-hashes r)))))
    (set-recorder-hashes! r '())))

(define (write-second! r step hash quantities)
  (apply tell-with-checksum! (recorder-teller r) 'second step (hex hash) quantities)
  (set-recorder-second! r step)
  (hand-on! r))

(define (hand-on! r)
  ;; Hand on what was written: to the disk if a second of real time has passed.
  (let ((now (get-internal-real-time)))
    (when (recorder-frames r)
      ((from (bight dive frames) write-frames!) (recorder-frames r) (reverse (recorder-pending r)))
      (set-recorder-pending! r '()))
    (if (< (- now (recorder-synced r)) internal-time-units-per-second)
        (teller-flush! (recorder-teller r))
        (begin
          (set-recorder-synced! r now)
          (teller-sync! (recorder-teller r))))))

(define (take-frame! r engine)
  (set-recorder-pending! r (cons ((from (bight dive frames) frame-of) engine) (recorder-pending r))))

(define (note-step! r)
  (let* ((engine (recorder-engine r)) (step (%dive-steps engine)))
    (when (null? (recorder-hashes r))
      (set-recorder-first! r step))
    (set-recorder-hashes! r (cons (digits (short-hash engine) 8) (recorder-hashes r)))
    (when (and (recorder-frames r) (zero? (modulo step frame-every)))
      (take-frame! r engine))))

(define (take-noted-steps! r n)
  ;; Take N steps with nothing of the language between them, and note each, also when the last is interrupted.
  (let* ((engine (recorder-engine r)) (before (%dive-steps engine)) (hashes (make-u32vector n)))
    (when (null? (recorder-hashes r))
      (set-recorder-first! r (+ before 1)))
    (dynamic-wind
      (const #f)
      (lambda () (%step-dive! engine n hashes))
      (lambda ()
        (set-recorder-hashes! r (cons (%eight-digits hashes (- (%dive-steps engine) before))
                                      (recorder-hashes r)))))))

(define (take-steps! r n)
  ;; Take N steps between which nothing runs.
  (if (recorder-frames r)
      (do ((i 0 (+ i 1)))
          ((= i n))
        (%step-dive! (recorder-engine r) 1)
        (note-step! r))
      (take-noted-steps! r n)))

(define (pause! r)
  ;; After some steps and what ran between them.
  (let* ((engine (recorder-engine r)) (step (%dive-steps engine)))
    (unless (%live? engine)
      (write-entries! r +inf.0)
      (when (and (zero? (modulo step second-long)) (> step (recorder-second r)))
        (write-hashes! r)
        (write-second! r step (%hash-dive engine) (quantities engine))))))

(define (jump! r)
  (let ((engine (recorder-engine r)))
    (write-hashes! r)
    (tell-datum! (recorder-teller r) (state-line engine))
    (set-recorder-serial! r (%serial engine))
    (set-recorder-second! r (%dive-steps engine))
    (write-second! r (%dive-steps engine) (%hash-dive engine) (quantities engine))))


;;; A live dive.

(define (look-at r bytes)
  ;; The quantities of the state BYTES; none when it follows a track that was given since.
  (catch 'bight-error
    (lambda ()
      (%restore-dive! (recorder-scratch r) bytes)
      (when (recorder-frames r)
        (take-frame! r (recorder-scratch r)))
      (quantities (recorder-scratch r)))
    (lambda args '())))

(define (write-moments! r)
  (with-mutex (recorder-mutex r)
    (for-each (lambda (m)
                (write-entries! r (vector-ref m 0))
                (write-second! r (vector-ref m 0) (vector-ref m 1) (look-at r (vector-ref m 2))))
              (%live-moments (recorder-engine r) (recorder-second r) #t))))

(define (go-along! r)
  ;; Write, in a thread, what becomes of a live dive.
  (define (go-on)
    (when (recorder-scratch r)
      (write-moments! r)
      (usleep 250000)
      (go-on)))
  (write-hashes! r)
  (set-recorder-scratch! r (%fork-dive (recorder-engine r)))
  (set-recorder-thread! r (call-with-new-thread go-on)))

(define (stop-along! r)
  (let ((thread (recorder-thread r)))
    (write-moments! r)
    (set-recorder-scratch! r #f)
    (when thread
      (join-thread thread)
      (set-recorder-thread! r #f))))

(define (handler r)
  (lambda (event)
    (case event
      ((step) (note-step! r))
      ((pause) (pause! r))
      ((jump) (jump! r))
      ((live) (go-along! r))
      ((freeze) (stop-along! r))
      ((stop) (finish! r))
      (else (take-steps! r event)))))       ; so many

(define (finish! r)
  (let* ((dive (recorder-dive r)) (engine (engine-of dive)) (live? (%live? engine)))
    (when live? (stop-along! r))
    (write-entries! r +inf.0)
    (write-hashes! r)
    (unless live?
      (tell-with-checksum! (recorder-teller r) 'end (%dive-steps engine) (hex (%hash-dive engine))))
    (hand-on! r)
    (teller-close! (recorder-teller r))
    (when (recorder-frames r)
      ((from (bight dive frames) close-frames!) (recorder-frames r)))
    (set-dive-recorder! dive #f)))


;;; The verbs.

(define (refuse-second-recording dive)
  (when (dive-recorder dive)
    (bight-raise 'def 'record! "this dive is being recorded already; say (stop-recording!) first")))

(define (new-recorder dive file frames)
  (let ((engine (engine-of dive)) (teller (make-teller 'record! file)))
    (tell-beginning! 'record! teller 'bight-recording dive)
    (make-recorder dive teller (make-mutex) (%serial engine) (%dive-steps engine) 0 '()
                   0 (and frames ((from (bight dive frames) open-frames) 'record! frames)) '() #f #f)))

(define-verb (record! (file string) #:key (frames (or-false string) #f))
  "Record what is done to the dive from now on in FILE, text that `replay' reads; with FRAMES, also what it
looks like, ten times a second (once, while it is live), in an SQLite file of that name.  Raise unsupported
when the world or the current is given by a procedure, io when a file cannot be written.  Return FILE."
  (let ((dive (this-dive 'record!)))
    (check-not-running 'record! dive)
    (refuse-second-recording dive)
    (when (%live? (engine-of dive))
      (bight-raise 'def 'record! "a live dive is not recorded from its middle; say (freeze!) first"))
    (check-dive 'record! dive)
    (catching-io 'record! file
      (let ((r (new-recorder dive file frames)))
        (when frames (take-frame! r (engine-of dive)))
        (hand-on! r)
        (set-dive-recorder! dive (handler r))))
    file))

(define-verb (stop-recording!)
  "Stop what `record!' started.  Return #t if there was a recording."
  (let* ((dive (this-dive 'stop-recording!)) (recorder (dive-recorder dive)))
    (check-not-running 'stop-recording! dive)
    (and recorder
         (begin (recorder 'stop) #t))))

(define-verb (recording?)
  "Return #t while the dive is being recorded."
  (and (dive-recorder (this-dive 'recording?)) #t))


;;; Replay.

(define-record <difference>
  (make-difference step time quantities)
  is-difference?
  (step the-step)
  (time the-time)
  (quantities the-quantities))

(set-record-type-printer!
 <difference>
 (lambda (d port)
   (simple-format port "#<difference from step ~a (~a s) on: ~a>" (the-step d) (the-time d)
                  (string-join (the-quantities d) "; "))))

(define-argument-type (difference value)
  "a difference, as `replay' returns"
  (if (is-difference? value) value refused))

(define-verb (difference? (object any))
  "Return #t if OBJECT is a difference that `replay' found."
  (is-difference? object))

(define-verb (difference-step (d difference))
  "Return the first step whose state differs from the recorded one."
  (the-step d))

(define-verb (difference-time (d difference))
  "Return the time of that step, s."
  (the-time d))

(define-verb (difference-quantities (d difference))
  "Return what differs, a list of strings, as it was recorded at the end of that second."
  (the-quantities d))

(define (differing-nodes name recorded found)
  (let ((count (quotient (string-length recorded) 4)))
    (if (not (= (string-length recorded) (string-length found)))
        (list (simple-format #f "~a has ~a nodes, not ~a" name (quotient (string-length found) 4) count))
        (let ((odd (filter (lambda (i)
                             (not (string=? (substring recorded (* 4 i) (* 4 (+ i 1)))
                                            (substring found (* 4 i) (* 4 (+ i 1))))))
                           (iota count))))
          (if (null? odd)
              '()
              (list (simple-format #f "~a of ~a nodes of ~a, node ~a the first" (length odd) count name
                                   (car odd))))))))

(define quantity-names
  '((rov "x" "y" "z" "heading")
    (tether "length" "tension at the anchor" "tension at the end" "")))

(define (differing recorded found)
  ;; What differs between two quantities of one part.
  (let ((name (cadr recorded)))
    (append-map (lambda (what a b)
                  (cond ((equal? a b) '())
                        ((and (string? a) (string? b)) (differing-nodes name a b))
                        (else (list (simple-format #f "~a of ~a: ~a, not ~a" what name b a)))))
                (assq-ref quantity-names (car recorded)) (cddr recorded) (cddr found))))

(define (differences recorded found)
  (let ((odd (if (= (length recorded) (length found))
                 (append-map differing recorded found)
                 '())))
    (if (null? odd) '("something that is not recorded by itself") odd)))

(define (first-odd-step steps hashes otherwise)
  ;; STEPS, the line (steps FIRST HASHES) or #f; HASHES, (STEP . HASH) as found.
  (define (recorded step)
    (let ((i (and steps (- step (second steps)))))
      (and i (<= 0 i) (<= (* 8 (+ i 1)) (string-length (third steps)))
           (substring (third steps) (* 8 i) (* 8 (+ i 1))))))
  (let ((odd (find (lambda (entry)
                     (let ((text (recorded (car entry))))
                       (and text (not (string=? text (digits (cdr entry) 8))))))
                   (reverse hashes))))
    (if odd (car odd) otherwise)))

(define most-steps 1000000)             ; that a recording takes without telling what came of them

(define (check-step n last)
  ;; Nothing vouches for N steps that follow LAST but the file: it could ask for more than a life has.
  (unless (and (exact-integer? n) (<= 0 n (+ last most-steps)))
    (bight-raise 'format 'replay "a line of the recording is at step ~s; from ~a it goes on to ~a at most"
                 n last (+ last most-steps))))

(define (replay-lines engine world lines)
  ;; Go through LINES; return #f, or the first difference.
  (let ((hashes '()) (steps #f) (told (%dive-steps engine)))
    (define (step-to! n)
      (check-step n told)
      (let loop ()
        (when (< (%dive-steps engine) n)
          (%step-dive! engine 1)
          (set! hashes (acons (%dive-steps engine) (short-hash engine) hashes))
          (loop))))
    (define (forget!)
      ;; What came of the steps so far was told.
      (set! hashes '())
      (set! steps #f)
      (set! told (%dive-steps engine)))
    (define (difference step what)
      (let ((step (first-odd-step steps hashes step)))
        (make-difference step (* step (%dive-time-step engine)) what)))
    (define (redo line)
      (check-step (second line) told)
      (guard (e ((bight-error? e)
                 (difference (second line)
                             (list (simple-format #f "~a was done then and is refused now: ~a"
                                                  (third line) (bight-error-message e))))))
        (step-to! (second line))
        (redo-line! engine world line)
        #f))
    (define (compare line)
      (step-to! (second line))
      (let ((same? (eqv? (unhex (third line)) (%hash-dive engine)))
            (odd-step (first-odd-step steps hashes #f)))
        (cond ((or odd-step (not same?))
               (difference (second line)
                           (differences (filter pair? (cdddr line))
                                        (if (eq? 'end (car line)) '() (quantities engine)))))
              (else
               (forget!)
               #f))))
    (define (take-line line)
      (case (car line)
        ((do) (redo line))
        ((second end) (compare line))
        ((steps) (set! steps line) #f)
        ((state)
         (restore-line! 'replay engine line)
         (forget!)
         #f)
        (else #f)))
    (or-map take-line lines)))

(define (after-beginning story)
  (cdr (find-tail (lambda (line) (eq? 'begin (car line))) (map cdr (story-lines story)))))

(define (replay-story file story)
  ;; Two values: the dive as it is at the end, and the first difference or #f.
  (let ((dive (begin-story 'replay file story)))
    (values dive
            (guard (e ((and (exception? e) (not (bight-error? e)) (not (quit-exception? e)))
                       (bight-raise 'format 'replay "~s holds what no recording holds" file)))
              (replay-lines (engine-of dive) (dive-world dive) (after-beginning story))))))

(define-verb (replay (file string) #:key (enter flag #f) (salvage flag #f))
  "Do again what was recorded in FILE, and return `identical' when all comes out the same to the last bit,
else the first difference.  A recording that was cut off is replayed as far as it goes.  With ENTER, the
dive as it is at the end becomes the current one; with SALVAGE, a recording that was altered is replayed up
to there.  Raise io when FILE cannot be read, format when it is no recording or was altered, version when
it is of another version."
  (let ((story (read-story 'replay file 'bight-recording #:salvage? salvage)))
    (when enter (check-not-running 'replay (current-dive)))
    (call-with-values (lambda () (replay-story file story))
      (lambda (dive difference)
        (when enter (current-dive dive))
        (or difference 'identical)))))

(define (replay-file file)
  "Replay FILE for the command line: print what came of it, and return #t if all came out the same."
  (let ((story (read-story 'replay file 'bight-recording)))
    (call-with-values (lambda () (replay-story file story))
      (lambda (dive difference)
        (simple-format #t "~a: ~a~a~%" file
                       (if difference
                           difference
                           (simple-format #f "identical, ~a s" (%dive-time (engine-of dive))))
                       (if (story-cut? story) "; it is cut off after that" ""))
        (not difference)))))
