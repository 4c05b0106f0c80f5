;;; (bight core crew) --- processes that hold files of scenarios and run them, several at a time.
;;;
;;; For each file there is a shop, a process that has loaded it.  At an order the shop forks a minder,
;;; which forks the process that does the work and waits for it, so that whatever happens to that one is
;;; told.  Orders go to a shop through a pipe of its own; what is told comes through the pipes of slots,
;;; of which there are as many as orders may be under way.  All is said in Scheme data, one line each.
;;;
;;; A minder leads a process group, which is killed as a whole: when its order is late, when its work is
;;; done, and when the crew goes home, be it for ^C.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core crew)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core fork)
  #:use-module (bight core record)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (call-with-crew
            crew? shop? slot?
            open-shops
            do-orders
            tell))


;;; Lines.

(define (tell port datum)
  "Write DATUM to PORT as a line."
  (write datum port)
  (newline port)
  (force-output port))

(define (hear port)
  ;; The datum of the next line of PORT; #f if it is none; the eof object.
  (let ((line (read-line port)))
    (if (eof-object? line)
        line
        (text->datum line))))

(define (open-pipe)
  ;; The two ends (IN . OUT) of a pipe for lines.
  (let ((ends (pipe)))
    (for-each (lambda (port) (set-port-encoding! port "UTF-8")) (list (car ends) (cdr ends)))
    ends))


;;; The crew.

(define-record <slot>
  (make-slot in out order serial minder deadline)
  slot?
  (in slot-in)
  (out slot-out)
  (order slot-order set-slot-order!)    ; under way here, or #f
  (serial slot-serial set-slot-serial!) ; of that order: what is told of another comes too late
  (minder slot-minder set-slot-minder!) ; its process, or #f
  (deadline slot-deadline set-slot-deadline!)) ; in internal real time

(define-record <shop>
  (make-shop file process orders)
  shop?
  (file shop-file)
  (process shop-process)
  (orders shop-orders))                 ; the port that orders are written to

(define-record <crew>
  (make-crew slots shops patience)
  crew?
  (slots crew-slots)
  (shops crew-shops set-crew-shops!)
  (patience crew-patience))             ; s without a word after which an order is late, or #f

(define (kill-quietly process)
  (false-if-exception (kill process SIGKILL)))

(define (send-home! crew)
  (for-each (lambda (slot)
              (when (slot-minder slot) (kill-quietly (- (slot-minder slot))))
              (close-port (slot-in slot))
              (close-port (slot-out slot)))
            (crew-slots crew))
  (for-each (lambda (shop)
              (kill-quietly (shop-process shop))
              (false-if-exception (waitpid (shop-process shop)))
              (close-port (shop-orders shop)))
            (crew-shops crew)))

(define deadly (list SIGINT SIGTERM SIGHUP))

(define (call-with-signals crew thunk)
  ;; Call THUNK; what ends this process meanwhile ends the CREW first, and writing to one that is gone is
  ;; no end of ours.  A process forked once Guile has handled signals handles none: shops come before.
  (let ((old '()))
    (define (handler signal)
      (send-home! crew)
      (primitive-exit (+ 128 signal)))
    (dynamic-wind
      (lambda ()
        (set! old (map (lambda (signal) (cons signal (sigaction signal handler))) deadly))
        (set! old (acons SIGPIPE (sigaction SIGPIPE SIG_IGN) old)))
      thunk
      (lambda ()
        (for-each (lambda (entry) (sigaction (car entry) (cadr entry) (cddr entry))) old)))))

(define (call-with-crew n patience receive)
  "Call RECEIVE with a crew that does N orders at a time, and gives up on one of which nothing was heard for
PATIENCE seconds unless that is #f.  No process outlives the call."
  (let ((crew (make-crew (map (lambda (i)
                                (let ((ends (open-pipe)))
                                  (make-slot (car ends) (cdr ends) #f 0 #f 0)))
                              (iota n))
                         '() patience))
        (ours (getpid)))
    (define (home)
      (when (= ours (getpid))
        (send-home! crew)))
    (dynamic-wind (const #f) (lambda () (receive crew)) home)))

(define (deadline-of crew)
  (and (crew-patience crew)
       (+ (get-internal-real-time)
          (inexact->exact (ceiling (* (crew-patience crew) internal-time-units-per-second))))))

(define (late? deadline)
  (and deadline (> (get-internal-real-time) deadline)))


;;; Children.

;; Is this process of somebody else's crew?
(define child? #f)

(define (become-child!)
  ;; The standard input is empty; what is written to the standard output by others than Scheme must not
  ;; get into the report.
  (let ((nothing (open "/dev/null" O_RDONLY)))
    (dup2 (fileno nothing) 0))
  (dup2 2 1)
  (set! child? #t))

(define (await-signals!)
  ;; Guile's thread for signals holds locks while it begins, and a process forked then waits for them for
  ;; ever.  A child may just have begun one, for its own time limit: when a signal has been heard, it has
  ;; begun.  In a child that hears none there is no such thread, and the wait is in vain.
  (when child?
    (let ((heard? #f) (old (sigaction SIGURG)))
      (sigaction SIGURG (lambda (signal) (set! heard? #t)))
      (kill (getpid) SIGURG)
      (let wait ((turns 100))
        (unless (or heard? (zero? turns))
          (usleep 10000)
          (wait (- turns 1))))
      (sigaction SIGURG (car old) (cdr old)))))

(define (call-in-child thunk)
  ;; Fork; the child calls THUNK and ends.  Return its process.
  (force-output (current-output-port))
  (force-output (current-error-port))
  (let ((process (fork-process)))
    (when (zero? process)
      (catch #t
        (lambda ()
          (thunk)
          (primitive-_exit 0))
        (lambda (key . arguments)
          (primitive-_exit (if (and (eq? key 'quit) (pair? arguments) (exact-integer? (car arguments)))
                               (logand 255 (car arguments))
                               1)))))
    process))

(define (mind serial port thunk)
  ;; Do THUNK in a process, and tell PORT how it ended.
  (setpgid 0 0)
  (tell port (list serial 'began (getpid)))
  (let* ((process (call-in-child thunk))
         (status (cdr (waitpid process))))
    (newline port)                      ; it may have ended within a line
    (tell port (list serial 'ended (status:exit-val status) (status:term-sig status)))))

(define (bury-minders)
  (when (false-if-exception (positive? (car (waitpid WAIT_ANY WNOHANG))))
    (bury-minders)))

(define (keep-shop orders slots work)
  ;; Take orders, lists (SLOT SERIAL WHAT), until there are no more.
  (let loop ()
    (let ((order (hear orders)))
      (bury-minders)
      (when (pair? order)
        (let ((port (slot-out (list-ref slots (first order))))
              (serial (second order)))
          (call-in-child
           (lambda ()
             (mind serial port
                   (lambda () (work (third order) (lambda (datum) (tell port (cons serial datum)))))))))
        (loop)))))

(define (open-shop crew file load)
  ;; Return the shop for FILE and the port where it tells what LOAD told.
  (let ((answer (open-pipe)) (orders (open-pipe)))
    (let ((process
           (call-in-child
            (lambda ()
              (become-child!)
              (for-each (lambda (shop) (close-port (shop-orders shop))) (crew-shops crew))
              (close-port (cdr orders))
              (let ((work (load file (lambda (datum) (tell (cdr answer) datum)))))
                (close-port (cdr answer))
                (when work
                  (keep-shop (car orders) (crew-slots crew) work)))))))
      (close-port (cdr answer))
      (close-port (car orders))
      (let ((shop (make-shop file process (cdr orders))))
        (set-crew-shops! crew (cons shop (crew-shops crew)))
        (values shop (car answer))))))

(define (readable ports seconds)
  ;; Those of PORTS that have something to read, within SECONDS.
  (catch 'system-error
    (lambda () (car (select ports '() '() seconds)))
    (lambda (key . arguments)
      (if (= EINTR (system-error-errno (cons key arguments))) '() (apply throw key arguments)))))

(define (end-of process)
  ;; How PROCESS, which ends, ended.
  (let ((status (cdr (waitpid process))))
    (list 'died (status:exit-val status) (status:term-sig status))))

(define (await-shop crew shop port)
  ;; What SHOP tells first, or (late) or (died EXIT SIGNAL).
  (let ((deadline (deadline-of crew)))
    (let loop ()
      (cond ((pair? (readable (list port) 1))
             (let ((datum (hear port)))
               (if (pair? datum) datum (end-of (shop-process shop)))))
            ((late? deadline)
             (kill-quietly (shop-process shop))
             (list 'late))
            (else (loop))))))

(define (open-shops crew files load)
  "Open a shop for each of FILES, as many at a time as CREW does orders.  In its process LOAD is called with
the file and a procedure that tells one datum, a list; it returns a procedure that does work, for
`do-orders', or #f if there is none to do.  Return what they told, in order; (late) and (died EXIT SIGNAL)
stand for what was told by none."
  (await-signals!)
  (let loop ((rest files) (told '()))
    (if (null? rest)
        (concatenate (reverse told))
        (let* ((n (min (length (crew-slots crew)) (length rest)))
               (pairs (map-in-order (lambda (file)
                                      (call-with-values (lambda () (open-shop crew file load)) cons))
                                    (take rest n)))
               (answers (map-in-order (lambda (pair) (await-shop crew (car pair) (cdr pair))) pairs)))
          (for-each (lambda (pair) (close-port (cdr pair))) pairs)
          (loop (drop rest n) (cons answers told))))))


;;; Orders.

(define (shop-for crew file)
  (find (lambda (shop) (equal? file (shop-file shop))) (crew-shops crew)))

(define (free-slot! slot)
  (when (slot-minder slot)
    (kill-quietly (- (slot-minder slot)))) ; and what it left behind
  (set-slot-minder! slot #f)
  (set-slot-order! slot #f))

(define (begin-order! crew slot order)
  ;; ORDER is (FILE WHAT); return #t if it could be given.
  (set-slot-order! slot order)
  (set-slot-serial! slot (+ 1 (slot-serial slot)))
  (set-slot-deadline! slot (deadline-of crew))
  (->bool
   (false-if-exception
    (begin
      (tell (shop-orders (shop-for crew (first order)))
            (list (list-index (lambda (s) (eq? s slot)) (crew-slots crew))
                  (slot-serial slot) (second order)))
      #t))))

(define (hear-slot! crew slot heard)
  ;; Take one line of what is told of SLOT.
  (let ((datum (hear (slot-in slot))))
    (when (and (pair? datum) (slot-order slot) (eqv? (car datum) (slot-serial slot)))
      (set-slot-deadline! slot (deadline-of crew))
      (case (second datum)
        ((began) (set-slot-minder! slot (third datum)))
        ((ended)
         (let ((order (slot-order slot)))
           (free-slot! slot)
           (heard order (cdr datum))))
        (else (heard (slot-order slot) (cdr datum)))))))

(define (give-up! slot heard)
  (let ((order (slot-order slot)))
    (free-slot! slot)
    (newline (slot-out slot))
    (force-output (slot-out slot))
    (heard order '(late))))

(define (do-orders crew orders heard)
  "Let the shops of CREW do ORDERS, lists (FILE WHAT), beginning them in order.  Call HEARD with an order and
what is told of it: all that its work tells, and last (ended EXIT SIGNAL), one of which is #f, (late) or
(closed), when there is no shop any more.  ^C meanwhile exits with status 130."
  (call-with-signals crew (lambda () (go-on-with crew orders heard))))

(define (go-on-with crew orders heard)
  (let ((slots (crew-slots crew)))
    (let loop ((rest orders))
      (let ((idle (find (lambda (slot) (not (slot-order slot))) slots))
            (busy (filter slot-order slots)))
        (cond ((and idle (pair? rest))
               (unless (begin-order! crew idle (car rest))
                 (free-slot! idle)
                 (heard (car rest) '(closed)))
               (loop (cdr rest)))
              ((pair? busy)
               (for-each (lambda (port)
                           (hear-slot! crew (find (lambda (slot) (eq? port (slot-in slot))) slots)
                                       heard))
                         (readable (map slot-in busy) 1))
               (for-each (lambda (slot)
                           (when (and (slot-order slot) (late? (slot-deadline slot)))
                             (give-up! slot heard)))
                         busy)
               (loop rest)))))))
