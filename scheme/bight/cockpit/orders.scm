;;; (bight cockpit orders) --- what an instructor hands in to a pupil's dive, and what he sees of it: the pupil's side.
;;;
;;; The instructor is a session of (bight shell door), a thread of its own.  It never touches the dive: it leaves an
;;; order and waits for the answer, and it takes what was last published.  The loop that flies the dive takes the
;;; orders between two frames, does them as it does the pupil's own, so that they are recorded, and publishes ten
;;; times a second while somebody looks.
;;;
;;; An order is a list:
;;;
;;;   (words TEXT)                    the pupil reads them
;;;   (current SPEED TOWARD)          as `current!'
;;;   (drift OBSTACLE SPEED TOWARD)   as `drift!'
;;;   (fault WHAT [VALUE])            as `fault!'; (mend WHAT [VALUE])
;;;   (light BOOL)                    whether the pupil's camera sees anything
;;;   (clock BOOL)                    whether time passes
;;;   (form TEXT)                     any form of the language, such as "(alter! 'line #:cdn 2)"
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit orders)
  #:use-module (bight core clock)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive command)
  #:use-module (bight dive instruments)
  #:use-module (bight dive story)
  #:use-module (bight dive time)
  #:use-module (ice-9 threads)
  #:use-module (srfi srfi-1)
  #:export (call-with-desk hand-in! seen beginning next-order! answer-order! publish! do-to-dive! order->text ticket?))

(define-record <ticket>
  (make-ticket order answer left?)
  ticket?
  (order ticket-order)
  (answer ticket-answer set-ticket-answer!) ; a list of lines, or #f until it is done
  (left? ticket-left? set-ticket-left!)) ; nobody waits for the answer any more

(define mutex (make-mutex))
(define answered (make-condition-variable))
(define open? #f)
(define waiting '())                    ; tickets, the first first
(define taken #f)                       ; the ticket that is being done
(define looked-until 0)                 ; s of the clock: somebody looks
(define shown '())                      ; what was published last
(define shown-at 0)
(define shown-dive #f)
(define late '())                       ; what came of orders for which nobody waited: (UNTIL . TEXT), the last first
(define the-beginning '(0 . ""))        ; (SERIAL . TEXT) of that dive

(define (call-with-desk socket thunk)
  "Call THUNK while instructors can connect at SOCKET, a file made now that is its owner's alone; at #f none can."
  (dynamic-wind
    (lambda ()
      (when socket
        ((module-ref (resolve-interface '(bight shell door)) 'open-door!) socket)
        (set! open? #t)))
    thunk
    (lambda ()
      (when socket
        (set! open? #f)
        ((module-ref (resolve-interface '(bight shell listen)) 'stop-listening!))))))


;;; For the instructor's session.

;; What follows the first word of an order: a predicate for each, of which the last may be left out for faults.
(define orders
  `((words ,string?) (current ,real? ,real?) (drift ,symbol? ,real? ,real?) (fault ,symbol? ,real?) (mend ,symbol? ,real?)
    (light ,boolean?) (clock ,boolean?) (form ,string?)))

(define (well-formed? order)
  (let ((kinds (and (pair? order) (list? order) (assq-ref orders (car order)))))
    (and kinds
         (or (= (length kinds) (length (cdr order)))
             (and (memq (car order) '(fault mend)) (= 1 (length (cdr order)))))
         (every (lambda (is? part) (is? part)) kinds (cdr order)))))

(define (check-order order)
  (unless (well-formed? order)
    (bight-raise 'domain 'hand-in "an order is (words TEXT), (current SPEED TOWARD), (drift OBSTACLE SPEED TOWARD), \
(fault WHAT [VALUE]), (mend WHAT [VALUE]), (light BOOL), (clock BOOL) or (form TEXT), not ~s" order)))

(define patience 5)                     ; s: a pupil who reads a page takes no orders

(define (hand-in! order)
  "Leave ORDER for the pupil's dive and wait until it is done.  Return `done', the lines that came of it, or, if the pupil
does not fly at present, `waiting'."
  (check-order order)
  (let ((ticket (make-ticket order #f #f)))
    (with-mutex mutex
      (set! waiting (append waiting (list ticket)))
      (let ((until (+ (current-time) patience)))
        (let loop ()
          (cond ((ticket-answer ticket) => (lambda (lines) (if (null? lines) 'done lines)))
                ((wait-condition-variable answered mutex until) (loop))
                (else
                 (set-ticket-left! ticket #t)
                 'waiting)))))))

(define (seen)
  "Return what was published last: (SERIAL TIME WORDS STATE), or () if nothing was; SERIAL counts the dives."
  (with-mutex mutex
    (let ((nobody-looked? (< looked-until (clock))) (before shown-at))
      (set! looked-until (+ 3 (clock)))
      (when nobody-looked?
        (await-news! before))
      shown)))

(define (await-news! before)
  ;; Nothing is published while nobody looks: wait a little for what is newer than BEFORE, s of the clock.
  (let ((until (+ 2 (current-time))))
    (let loop ()
      (when (and (= shown-at before) (wait-condition-variable answered mutex until))
        (loop)))))

(define (beginning)
  "Return (SERIAL TEXT) of the dive that is published: the world it is in, as a recording begins."
  (with-mutex mutex
    (list (car the-beginning) (cdr the-beginning))))


;;; For the loop that flies.

(define (next-order!)
  "Return the next order, to be answered by `answer-order!', or #f."
  (and open?
       (with-mutex mutex
         (and (pair? waiting)
              (begin
                (set! taken (car waiting))
                (set! waiting (cdr waiting))
                (ticket-order taken))))))

(define long 60)                        ; s that what came late is told

(define (note-late! order lines)
  (set! late (cons (cons (+ (clock) long)
                         (string-append "late: " (order->text order) ": "
                                        (if (null? lines) "done" (string-join lines " "))))
                   (filter (lambda (entry) (> (car entry) (clock))) late))))

(define (answer-order! lines)
  "Say that the order taken last is done, and LINES came of it; nothing if none was, as when a journal is done again."
  (with-mutex mutex
    (when taken
      (set-ticket-answer! taken lines)
      (when (ticket-left? taken)
        (note-late! (ticket-order taken) lines))
      (set! taken #f)
      (broadcast-condition-variable answered))))

(define (beginning-of dive)
  (check-dive 'instruct dive)
  (call-with-output-string
    (lambda (port)
      (tell-beginning! 'instruct (port-teller port) 'bight-recording dive))))

(define (publish! dive words)
  "Let the instructors see DIVE and WORDS, a list of strings, if any of them looks; ten times a second at most."
  (when (and open? dive (< (clock) looked-until) (> (- (clock) shown-at) 0.1))
    (let ((new (and (not (eq? dive shown-dive)) (beginning-of dive)))
          (state (state-line (engine-of dive))))
      (with-mutex mutex
        (when new
          (set! the-beginning (cons (+ 1 (car the-beginning)) new))
          (set! shown-dive dive))
        (set! shown (list (car the-beginning) (now) (append words (late-texts)) state))
        (set! shown-at (clock))
        (broadcast-condition-variable answered)))))

(define (late-texts)
  (filter-map (lambda (entry) (and (> (car entry) (clock)) (cdr entry))) late))

(define (do-to-dive! order)
  "Do ORDER, one that changes the dive by a verb of its own."
  (apply (case (car order)
           ((current) current!)
           ((drift) drift!)
           ((fault) fault!)
           (else mend!))
         (cdr order)))

(define (order->text order)
  "Return ORDER as it is told in a report."
  (string-join (map (lambda (x) (if (boolean? x) (if x "on" "off") (simple-format #f "~a" x))) order)))
