;;; (bight core crew) --- processes that hold what was loaded and do orders, several at a time.
;;;
;;; Tests and sweeps run so.  For each file of scenarios, or for a study, there is a shop, a process that has loaded it.
;;; At an order the shop forks a process that does the work, a hand, and tells how that ended, so that no order sees
;;; what another did and whatever happens to a hand is told.  Orders go to a shop through a pipe of its own; what is
;;; told comes through the pipes of slots, of which there are as many as orders may be under way.  All is said in
;;; Scheme data, one line each.
;;;
;;; A hand leads a process group, which is killed as a whole: when its order is late, when its work is done, and when
;;; the crew goes home, be it for ^C.  When the process that gives the orders is killed, the pipes of the shops end, and
;;; every shop ends its hands and itself.
;;;
;;; Who forks must have one thread, or others that are known to hold no lock: nobody would open it in the child.  Guile
;;; starts a thread at the first `sigaction', so shops are opened before that, and a shop calls none; a hand that does
;;; waits for the thread to have begun (`await-signal-thread!').
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core crew)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core fork)
  #:use-module (bight core record)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (call-with-crew
            crew? hand? shop? slot?
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
  (make-slot in out order shop serial hand deadline)
  slot?
  (in slot-in)
  (out slot-out)
  (order slot-order set-slot-order!)    ; under way here, or #f
  (shop slot-shop set-slot-shop!)       ; which has that order, or #f
  (serial slot-serial set-slot-serial!) ; of that order: what is told of another comes too late
  (hand slot-hand set-slot-hand!)       ; the process that does it, or #f
  (deadline slot-deadline set-slot-deadline!)) ; in internal real time

(define-record <shop>
  (make-shop file process orders answer)
  shop?
  (file shop-file)
  (process shop-process)
  (orders shop-orders)                  ; the port that orders are written to
  (answer shop-answer))                 ; the port where it told what was loaded; it ends with the shop

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
              (when (slot-hand slot) (kill-quietly (- (slot-hand slot))))
              (close-port (slot-in slot))
              (close-port (slot-out slot)))
            (crew-slots crew))
  (for-each (lambda (shop)
              (kill-quietly (shop-process shop))
              (false-if-exception (waitpid (shop-process shop)))
              (close-port (shop-orders shop))
              (close-port (shop-answer shop)))
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
                                  (make-slot (car ends) (cdr ends) #f #f 0 #f 0)))
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

(define (become-child!)
  ;; The standard input is empty; what is written to the standard output by others than Scheme must not
  ;; get into the report.
  (let ((nothing (open "/dev/null" O_RDONLY)))
    (dup2 (fileno nothing) 0))
  (dup2 2 1))

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

;; The process of an order, as its shop knows it.
(define-record <hand>
  (make-hand process life port serial)
  hand?
  (process hand-process)
  (life hand-life)                      ; a port that ends with the process
  (port hand-port)                      ; of its slot
  (serial hand-serial))

;; In a hand, the other end of its life, kept from the collector.
(define life #f)

(define (fork-hand port serial answer thunk)
  ;; Fork the process that calls THUNK for the order SERIAL of the slot of PORT; ANSWER is its shop's alone.
  (let* ((ends (pipe))
         (process (call-in-child
                   (lambda ()
                     (setpgid 0 0)
                     (close-port answer)
                     (close-port (car ends))
                     (set! life (cdr ends))
                     (fcntl life F_SETFD FD_CLOEXEC)
                     (tell port (list serial 'began (getpid)))
                     (thunk)))))
    (close-port (cdr ends))
    (make-hand process (car ends) port serial)))

(define (gone? hand flags)
  ;; Has HAND ended?  If so that is told; with the FLAGS 0 it is waited for.
  (let ((end (waitpid (hand-process hand) flags)))
    (and (positive? (car end))
         (let ((port (hand-port hand)) (status (cdr end)))
           (close-port (hand-life hand))
           (newline port)               ; it may have ended within a line
           (tell port (list (hand-serial hand) 'ended (status:exit-val status) (status:term-sig status)))
           #t))))

(define (those-left hands ready)
  ;; HANDS without those that have ended, as the lives among the ports READY say.  A process that a hand left
  ;; behind may hold its life; so when nothing is ready, all are asked.
  (remove (lambda (hand)
            (cond ((memq (hand-life hand) ready) (gone? hand 0))
                  ((null? ready) (gone? hand WNOHANG))
                  (else #f)))
          hands))

(define (kill-hand hand)
  ;; It may not lead a group yet.
  (kill-quietly (- (hand-process hand)))
  (kill-quietly (hand-process hand)))

(define (keep-shop orders answer slots work)
  ;; Take orders, lists (SLOT SERIAL WHAT), until there are no more.  ^C is for those who give them.
  (define (begin-hand order)
    (let ((port (slot-out (list-ref slots (first order)))) (serial (second order)))
      (fork-hand port serial answer
                 (lambda () (work (third order) (lambda (datum) (tell port (cons serial datum))))))))
  (setpgid 0 0)
  (let loop ((hands '()))
    (let* ((ready (readable (cons orders (map hand-life hands)) (if (null? hands) #f 1)))
           (hands (those-left hands ready))
           (order (and (memq orders ready) (hear orders))))
      (cond ((eof-object? order) (for-each kill-hand hands))
            ((pair? order) (loop (cons (begin-hand order) hands)))
            (else (loop hands))))))

(define (open-shop crew file load)
  ;; Return the shop for FILE, which will tell what LOAD told.
  (let ((answer (open-pipe)) (orders (open-pipe)))
    (let ((process
           (call-in-child
            (lambda ()
              (become-child!)
              (for-each (lambda (shop) (close-port (shop-orders shop))) (crew-shops crew))
              (close-port (cdr orders))
              (let ((work (load file (lambda (datum) (tell (cdr answer) datum)))))
                (when work
                  (keep-shop (car orders) (cdr answer) (crew-slots crew) work)))))))
      (close-port (cdr answer))
      (close-port (car orders))
      (let ((shop (make-shop file process (cdr orders) (car answer))))
        (set-crew-shops! crew (cons shop (crew-shops crew)))
        shop))))

(define (readable ports seconds)
  ;; Those of PORTS that have something to read, within SECONDS.
  (catch 'system-error
    (lambda () (car (select ports '() '() seconds)))
    (lambda (key . arguments)
      (if (= EINTR (system-error-errno (cons key arguments))) '() (apply throw key arguments)))))

(define (close-shop! crew shop)
  ;; SHOP, whose process ends, is none of CREW any more; return how it ended.
  (let ((status (cdr (waitpid (shop-process shop)))))
    (close-port (shop-orders shop))
    (close-port (shop-answer shop))
    (set-crew-shops! crew (delq shop (crew-shops crew)))
    (list 'died (status:exit-val status) (status:term-sig status))))

(define (await-shop crew shop)
  ;; What SHOP tells first, or (late) or (died EXIT SIGNAL).
  (let ((deadline (deadline-of crew)))
    (let loop ()
      (cond ((pair? (readable (list (shop-answer shop)) 1))
             (let ((datum (hear (shop-answer shop))))
               (if (pair? datum) datum (close-shop! crew shop))))
            ((late? deadline)
             (kill-quietly (shop-process shop))
             (close-shop! crew shop)
             (list 'late))
            (else (loop))))))

(define (open-shops crew files load)
  "Open a shop for each of FILES, as many at a time as CREW does orders.  In its process LOAD is called with
the file and a procedure that tells one datum, a list; it returns a procedure that does work, for
`do-orders', or #f if there is none to do.  Return what they told, in order; (late) and (died EXIT SIGNAL)
stand for what was told by none."
  (let loop ((rest files) (told '()))
    (if (null? rest)
        (concatenate (reverse told))
        (let* ((n (min (length (crew-slots crew)) (length rest)))
               (shops (map-in-order (lambda (file) (open-shop crew file load)) (take rest n)))
               (answers (map-in-order (lambda (shop) (await-shop crew shop)) shops)))
          (loop (drop rest n) (cons answers told))))))


;;; Orders.

(define (shop-for crew file)
  ;; The shop of FILE that has the fewest orders under way, or #f.
  (define (load shop)
    (count (lambda (slot) (eq? shop (slot-shop slot))) (crew-slots crew)))
  (reduce (lambda (shop best) (if (< (load shop) (load best)) shop best))
          #f
          (filter (lambda (shop) (equal? file (shop-file shop))) (crew-shops crew))))

(define (free-slot! slot)
  (when (slot-hand slot)
    (kill-quietly (- (slot-hand slot)))) ; and what it left behind
  (set-slot-hand! slot #f)
  (set-slot-shop! slot #f)
  (set-slot-order! slot #f))

(define (give-order! crew slot order)
  ;; Give ORDER, (FILE WHAT), which is that of SLOT, to a shop; return #f if there is none.
  (let ((shop (shop-for crew (first order)))
        (number (list-index (lambda (s) (eq? s slot)) (crew-slots crew))))
    (set-slot-shop! slot shop)
    (and shop
         (or (false-if-exception
              (begin (tell (shop-orders shop) (list number (slot-serial slot) (second order))) #t))
             (begin
               (close-shop! crew shop)
               (give-order! crew slot order))))))

(define (begin-order! crew slot order)
  ;; Return #t if ORDER could be given.
  (set-slot-order! slot order)
  (set-slot-serial! slot (+ 1 (slot-serial slot)))
  (set-slot-deadline! slot (deadline-of crew))
  (give-order! crew slot order))

(define (hear-slot! crew slot heard)
  ;; Take one line of what is told of SLOT.
  (let ((datum (hear (slot-in slot))))
    (when (and (pair? datum) (slot-order slot) (eqv? (car datum) (slot-serial slot)))
      (set-slot-deadline! slot (deadline-of crew))
      (case (second datum)
        ((began) (set-slot-hand! slot (third datum)))
        ((ended)
         (let ((order (slot-order slot)))
           (free-slot! slot)
           (heard order (cdr datum))))
        (else (heard (slot-order slot) (cdr datum)))))))

(define (give-up! slot heard why)
  (let ((order (slot-order slot)))
    (free-slot! slot)
    (newline (slot-out slot))
    (force-output (slot-out slot))
    (heard order (list why))))

(define* (do-orders crew orders heard #:key (stop? #f))
  "Let the shops of CREW do ORDERS, lists (FILE WHAT), beginning them in order.  Call HEARD with an order and
what is told of it: all that its work tells, and last (ended EXIT SIGNAL), one of which is #f, (late),
(orphaned), when its shop came to an end, or (closed), when there is no shop any more.  ^C meanwhile exits with
status 130.  With STOP?, a procedure without arguments, signals are for the caller: as soon as STOP? returns
true, no more is begun or heard, and what is under way ends with CREW."
  (if stop?
      (go-on-with crew orders heard stop?)
      (call-with-signals crew (lambda () (go-on-with crew orders heard (const #f))))))

(define (hear-slots! crew busy heard)
  ;; Take what is told, within a second, of the slots that are BUSY; those that are late are given up, and, when all
  ;; is heard, those whose shop is gone.
  (let* ((ready (readable (append (map slot-in busy) (map shop-answer (crew-shops crew))) 1))
         (gone (filter (lambda (shop)
                         (and (memq (shop-answer shop) ready) (eof-object? (hear (shop-answer shop)))))
                       (crew-shops crew))))
    (for-each (lambda (slot)
                (cond ((memq (slot-in slot) ready) (hear-slot! crew slot heard))
                      ((memq (slot-shop slot) gone) (give-up! slot heard 'orphaned))
                      ((late? (slot-deadline slot)) (give-up! slot heard 'late))))
              busy)
    (for-each (lambda (shop)
                (unless (any (lambda (slot) (eq? shop (slot-shop slot))) busy)
                  (close-shop! crew shop)))
              gone)))

(define (go-on-with crew orders heard stop?)
  (let loop ((rest orders))
    (let ((idle (find (lambda (slot) (not (slot-order slot))) (crew-slots crew)))
          (busy (filter slot-order (crew-slots crew))))
      (cond ((stop?) #f)
            ((and idle (pair? rest))
             (unless (begin-order! crew idle (car rest))
               (free-slot! idle)
               (heard (car rest) '(closed)))
             (loop (cdr rest)))
            ((pair? busy)
             (hear-slots! crew busy heard)
             (loop rest))))))
