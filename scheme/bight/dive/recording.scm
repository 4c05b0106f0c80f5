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
;;; Operations and quantities are written by (bight dive entry).  What `every', `on' and pilots did is recorded like everything else, so that a
;;; replay needs none of their code.  Each second is handed to the system at once, and once a second of real
;;; time to the disk.  While the dive is live, a thread of Scheme's own writes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive recording)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive entry)
  #:use-module (bight dive past)
  #:use-module (bight dive story)
  #:use-module (bight engine)
  #:use-module (ice-9 threads)
  #:use-module (srfi srfi-1)
  #:export (record! stop-recording! recording? recorder?))

(define second-long 60)                 ; steps
(define frame-every 6)                  ; steps: ten frames a second


;;; The recorder.

(define-record <recorder>
  (make-recorder dive teller mutex serial second first hashes synced frames pending thread scratch heads)
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
  (heads recorder-heads)                        ; of the parts, as `quantities' wants them
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
    (tell-text! (recorder-teller r)
                (string-append "(steps " (number->string (recorder-first r)) " \""
                               (string-concatenate-reverse (recorder-hashes r)) "\")\n"))
    (set-recorder-hashes! r '())))

(define (write-second! r step hash quantities)
  (tell-bytes-with-checksum! (recorder-teller r)
                             (string-append "(second " (number->string step) " \"" (hex hash) "\"")
                             quantities)
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
        (write-second! r step (%hash-dive engine) (quantities engine (recorder-heads r)))))))

(define (jump! r)
  (let ((engine (recorder-engine r)))
    (write-hashes! r)
    (tell-datum! (recorder-teller r) (state-line engine))
    (set-recorder-serial! r (%serial engine))
    (set-recorder-second! r (%dive-steps engine))
    (write-second! r (%dive-steps engine) (%hash-dive engine) (quantities engine (recorder-heads r)))))


;;; A live dive.

(define (look-at r bytes)
  ;; The quantities of the state BYTES; none when it follows a track that was given since.
  (catch 'bight-error
    (lambda ()
      (%restore-dive! (recorder-scratch r) bytes)
      (when (recorder-frames r)
        (take-frame! r (recorder-scratch r)))
      (quantities (recorder-scratch r) (recorder-heads r)))
    (lambda args #vu8())))

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
                   0 (and frames ((from (bight dive frames) open-frames) 'record! frames)) '() #f #f
                   (quantity-heads engine))))

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
