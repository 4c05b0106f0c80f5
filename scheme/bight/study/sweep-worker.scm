;;; (bight study sweep-worker) --- workers: processes that fly the cases of a study, a process for each case.
;;;
;;; A worker is forked when the study has been read, and before any database is open.  It is told the
;;; number of a case, forks a process that flies it, and tells what came of it: what that process wrote,
;;; or how it died.  So no case sees what another did, one that breaks down takes nothing with it, and
;;; one that takes too long is ended.  When its master is gone, so is the worker, and the case.
;;;
;;; A process that was ended by a signal which comes from outside, as SIGKILL does when memory is short, says
;;; nothing about its case: that is `interrupted', and what becomes of the case is for the master to decide.
;;;
;;; Who forks must have one thread: another may hold a lock at that moment, which nobody then opens.  So
;;; neither a worker, nor its master before all workers are there, calls `sigaction', which starts one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-worker)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core fork)
  #:use-module ((bight core here) #:select (noting-places))
  #:use-module (bight core record)
  #:use-module (bight study case)
  #:use-module ((bight test expect) #:select (exception->line raised-at raised-kind))
  #:use-module ((ice-9 binary-ports) #:select (get-bytevector-some))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (start-worker
            worker?
            worker-port
            worker-case
            set-task!
            worker-answer
            interrupted
            interrupted?
            stop-worker!
            case-outcome))


;;; The process that flies one case.

(define (place->text place)
  ;; Without its folder, which another machine has elsewhere.
  (if place (simple-format #f "~a:~a: " (basename (car place)) (cdr place)) ""))

(define (failure e)
  (list (cons 'status "failed")
        (cons 'error (object->string (raised-kind e) display))
        (cons 'message (string-append (place->text (raised-at e)) (exception->line e)))))

(define (case-outcome study number)
  "Return what comes of the case NUMBER, from 0, of STUDY: an alist of status, cpu and hash, measures, legs,
or error and message."
  (let* ((begun (get-internal-run-time))
         (outcome
          (with-exception-handler failure
            (lambda ()
              (let ((found (noting-places (lambda () (fly-case study number)))))
                (list '(status . "done")
                      (cons 'hash (object->string (third found) display))
                      (cons 'measures (first found))
                      (cons 'legs (second found)))))
            #:unwind? #t)))
    (acons 'cpu (/ (- (get-internal-run-time) begun) (exact->inexact internal-time-units-per-second))
           outcome)))

(define (quiet!)
  ;; What a study prints would stand between the cases; what it complains about is worth seeing.
  (let ((nowhere (open-file "/dev/null" "w")))
    (set-current-output-port nowhere)
    (dup2 (fileno nowhere) 1)))

(define (fly-and-write study number port)
  ;; In the process of a case, for good.
  (quiet!)
  (let ((limit (study-limit study)))
    (setitimer ITIMER_PROF 0 0 (inexact->exact (floor limit))
               (inexact->exact (floor (* 1000000 (- limit (floor limit)))))))
  (write (case-outcome study number) port)
  (force-output port)
  (primitive-_exit 0))


;;; The worker.

(define patience 10)                    ; seconds of waiting allowed for each of processor time

(define (timed-out study)
  `((status . "timed out") (error . "limit")
    (message . ,(simple-format #f "it took more than (at-most ~a) seconds of processor time"
                               (study-limit study)))))

(define (broken-down how)
  `((status . "failed") (error . "crash") (message . ,(string-append "the dive's process " how))))

(define own-signals
  ;; Those that a process is ended by for what it did itself.  All others come from outside.
  (list SIGABRT SIGBUS SIGFPE SIGILL SIGSEGV SIGSYS SIGTRAP SIGPIPE SIGALRM SIGVTALRM))

(define (interrupted how)
  "Return the outcome of a case whose process was ended from outside; HOW says by what."
  `((status . "failed") (error . "interrupted")
    (message . ,(string-append "the dive's process was ended from outside, " how))))

(define (interrupted? outcome)
  "Return #t if OUTCOME says no more than that the case was ended from outside."
  (equal? "interrupted" (assq-ref outcome 'error)))

(define (signal->string signal)
  (if (= signal SIGKILL)
      (simple-format #f "by signal ~a, as when memory is short" signal)
      (simple-format #f "by signal ~a" signal)))

(define (written text)
  ;; What the process wrote, if it wrote all of it.
  (let ((datum (text->datum text)))
    (and (list? datum) (every pair? datum) (assq 'status datum) datum)))

(define (verdict study text status)
  ;; What came of a case whose process wrote TEXT and ended with STATUS.
  (let ((signal (status:term-sig status)))
    (cond ((written text))              ; however it ended afterwards
          ((eqv? signal SIGPROF) (timed-out study))
          ((and signal (not (memv signal own-signals))) (interrupted (signal->string signal)))
          (signal (broken-down (simple-format #f "was ended by signal ~a" signal)))
          (else (broken-down (simple-format #f "ended with status ~a" (status:exit-val status)))))))

(define (now) (/ (get-internal-real-time) (exact->inexact internal-time-units-per-second)))

(define (read-or-end pid port orders deadline)
  ;; All that comes through PORT from the process PID, which is ended at DEADLINE, #f then; the worker itself
  ;; ends when ORDERS, where its master is silent meanwhile, is closed.
  (let loop ((chunks '()))
    (let ((ready (first (select (list port orders) '() '() (max 0 (- deadline (now)))))))
      (cond ((memq orders ready)
             (kill pid SIGKILL)
             (primitive-_exit 0))
            ((null? ready)
             (kill pid SIGKILL)
             #f)
            (else
             (let ((bytes (get-bytevector-some port)))
               (if (eof-object? bytes)
                   (joined (reverse chunks))
                   (loop (cons bytes chunks)))))))))

(define (joined chunks)
  ;; The text of CHUNKS, bytes; a letter may have been cut in two.
  (let ((all (make-bytevector (apply + (map bytevector-length chunks)))))
    (fold (lambda (chunk at)
            (bytevector-copy! chunk 0 all at (bytevector-length chunk))
            (+ at (bytevector-length chunk)))
          0 chunks)
    (utf8->string all)))

(define (open-pipe-utf8)
  (let ((ends (pipe)))
    (set-port-encoding! (car ends) "UTF-8")
    (set-port-encoding! (cdr ends) "UTF-8")
    ends))

(define (fly-in-process study number orders answers)
  ;; What comes of the case NUMBER, from 0, of STUDY.
  (let* ((ends (open-pipe-utf8))
         (pid (fork-process)))
    (when (zero? pid)
      (close-port (car ends))
      (close-port orders)
      (close-port answers)              ; else the master would not hear that the worker is gone
      (fly-and-write study number (cdr ends)))
    (close-port (cdr ends))
    (let* ((text (read-or-end pid (car ends) orders
                              (+ (now) (* patience (+ 1 (study-limit study))))))
           (status (cdr (waitpid pid))))
      (close-port (car ends))
      (if text
          (verdict study text status)
          (timed-out study)))))

(define (work study orders answers)
  ;; In the worker, for good: do what ORDERS say, a number each.  ^C is for the master alone.
  (setsid)
  (let loop ()
    (let ((order (read-line orders)))   ; nothing of it must stay in the port's buffer
      (unless (eof-object? order)
        (write (fly-in-process study (string->number order) orders answers) answers)
        (newline answers)
        (force-output answers)
        (loop))))
  (primitive-_exit 0))


;;; The master's side.

(define-record <worker>
  (make-worker pid orders port case)
  worker?
  (pid worker-pid)
  (orders worker-orders)
  (port worker-port)                    ; where its answers come from
  (case worker-case set-worker-case!))  ; the number of the case that it flies, or #f

(define (start-worker study others)
  "Start a worker for STUDY, beside OTHERS, the workers there are, and return it."
  (let* ((orders (open-pipe-utf8))
         (answers (open-pipe-utf8))
         (pid (fork-process)))
    (when (zero? pid)
      ;; Else another worker would not hear that its master is gone.
      (for-each (lambda (other)
                  (close-port (worker-orders other))
                  (close-port (worker-port other)))
                others)
      (close-port (cdr orders))
      (close-port (car answers))
      (work study (car orders) (cdr answers)))
    (close-port (car orders))
    (close-port (cdr answers))
    (make-worker pid (cdr orders) (car answers) #f)))

(define (set-task! worker number)
  "Let WORKER fly the case NUMBER, from 0.  Return #f if it is gone."
  (set-worker-case! worker number)
  (catch 'system-error
    (lambda ()
      (write number (worker-orders worker))
      (newline (worker-orders worker))
      (force-output (worker-orders worker))
      #t)
    (lambda arguments #f)))

(define (worker-answer worker)
  "Return what came of the case that WORKER flew, an alist, or #f if the worker is gone."
  (let ((datum (false-if-exception (read (worker-port worker)))))
    (and (list? datum)
         (begin
           (set-worker-case! worker #f)
           datum))))

(define (stop-worker! worker)
  "End WORKER, and what it flies."
  (false-if-exception (close-port (worker-orders worker)))
  (false-if-exception (close-port (worker-port worker)))
  (false-if-exception (waitpid (worker-pid worker))))
