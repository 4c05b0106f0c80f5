;;; (bight shell door) --- lines on a socket, for another program to fly and to ask.
;;;
;;; A line that comes is one form of the language; the line that answers it is one datum:
;;;
;;;   (ok VALUE)              what the form returned; (ok) for nothing worth telling
;;;   (error KIND TEXT)       what went wrong: KIND is a symbol, TEXT a sentence
;;;   (printed TEXT)          before the answer, what the form printed
;;;
;;; Two forms are the door's own.  (subscribe RATE FORM) answers (ok N), and from then on, RATE times a second,
;;; comes (event N VALUE) with what FORM returns; an error is told by (ended N KIND TEXT) and ends it.
;;; (unsubscribe N) ends it as well.  What was not taken in time is left out, not sent later.
;;;
;;; A VALUE is a number, #t, #f, a string, a symbol or a list of those; in a string stand \" and \\, the
;;; letters of C after a \, and \xHH, \uHHHH or \UHHHHHH for what else is not printed.  Vectors and arrays come as lists, a pair
;;; that is no list as the list of its elements, and what has no written form as (object TEXT).
;;;
;;; Who may connect, and which dive a session is about, is settled by (bight shell listen).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell door)
  #:use-module (bight core clock)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight shell listen)
  #:use-module ((bight core told) #:select (exception->line raised-kind))
  #:use-module (ice-9 binary-ports)
  #:use-module (ice-9 exceptions)
  #:use-module ((ice-9 textual-ports) #:select (get-string-all))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (open-door!))

(define longest-line 262144)            ; bytes
(define most-printed 65536)             ; bytes of what a form prints that are told
(define most-parts 1000000)             ; of a value
(define deepest 100)                    ; lists within each other
(define most-subscriptions 64)
(define rates '(0.01 . 100))            ; times a second


;;; Values as data.

(define (written object)
  (list 'object (object->string object)))

(define (symbol->datum symbol)
  ;; A symbol that is not written as it is spelt comes as a string.
  (let ((text (symbol->string symbol)))
    (if (string=? text (object->string symbol)) symbol text)))

(define (value->datum value)
  "Return VALUE as a datum that any program reads, or raise a &bight-error if it is too large."
  (let ((parts 0))
    (define (count!)
      (set! parts (+ parts 1))
      (when (> parts most-parts)
        (bight-raise 'limit #f "the value has more than ~a parts" most-parts)))
    (define (list->data l depth)
      ;; The elements of L, of which the last may be no list.
      (let loop ((l l) (data '()))
        (count!)
        (cond ((null? l) (reverse! data))
              ((pair? l) (loop (cdr l) (cons (datum (car l) depth) data)))
              (else (reverse! (cons (datum l depth) data))))))
    (define (datum value depth)
      (count!)
      (cond ((or (boolean? value) (string? value) (null? value)) value)
            ((and (number? value) (real? value)) value)
            ((symbol? value) (symbol->datum value))
            ((keyword? value) (symbol->datum (keyword->symbol value)))
            ((> depth deepest) (bight-raise 'limit #f "the value is deeper than ~a lists" deepest))
            ((pair? value) (list->data value (+ depth 1)))
            ((array? value) (list->data (array->list value) (+ depth 1)))
            (else (written value))))
    (datum value 0)))


;;; Doing what a line says.

(define (failure exception)
  ;; (KIND TEXT)
  (list (symbol->datum (raised-kind exception)) (exception->line exception)))

(define (leaving? exception)
  (memq (exception-kind exception) '(quit)))

(define (call-or-fail thunk fail)
  ;; What THUNK returns, or FAIL with (KIND TEXT); `exit' passes, it ends the session.
  (with-exception-handler
      (lambda (exception)
        (if (leaving? exception)
            (raise-exception exception)
            (fail (failure exception))))
    thunk
    #:unwind? #t))

(define most-open 1000)                 ; parentheses at a time

(define (check-nesting text)
  ;; The reader takes ages for what nests without end.
  (string-fold (lambda (c open)
                 (when (> open most-open)
                   (bight-raise 'limit #f "a form has ~a parentheses open at most" most-open))
                 (case c
                   ((#\( #\[) (+ open 1))
                   ((#\) #\]) (- open 1))
                   (else open)))
               0 text))

(define (read-form text)
  ;; The one datum of TEXT.
  (check-nesting text)
  (call-with-input-string text
    (lambda (port)
      (let ((form (read port)))
        (unless (eof-object? (read port))
          (bight-raise 'format #f "a line holds one form; there is more behind it"))
        form))))

(define (evaluate form)
  (eval form (resolve-module '(guile-user))))

(define (call-printing thunk)
  ;; What THUNK returns, and what it printed, a string.
  (call-with-values open-bytevector-output-port
    (lambda (kept get)
      (let* ((room most-printed)
             (port (make-custom-binary-output-port
                    "printed"
                    (lambda (bytes start count)
                      (let ((n (min room count)))
                        (put-bytevector kept bytes start n)
                        (set! room (- room n))
                        count))
                    #f #f #f)))
        (set-port-encoding! port "UTF-8")
        (let ((value (parameterize ((current-output-port port) (current-error-port port)
                                    (current-warning-port port))
                       (let ((value (thunk)))
                         (force-output port)
                         value))))
          (values value (utf8->text (get))))))))

(define (utf8->text bytes)
  ;; BYTES as text, where what is none stands as a question mark.
  (call-with-port (open-bytevector-input-port bytes)
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (set-port-conversion-strategy! port 'substitute)
      (get-string-all port))))


;;; A session.

(define-record <session>
  (make-session port chunks size subscriptions serial)
  session?
  (port session-port)
  (chunks session-chunks set-session-chunks!) ; bytes of a line that has not ended, the last first
  (size session-size set-session-size!) ; of that line; no chunks are kept of one that is too long
  (subscriptions session-subscriptions set-session-subscriptions!)
  (serial session-serial set-session-serial!)) ; of the last subscription

(define-record <subscription>
  (make-subscription number form period due)
  subscription?
  (number subscription-number)
  (form subscription-form)
  (period subscription-period)          ; s
  (due subscription-due set-subscription-due!)) ; on `clock'

(document
 (session? "Return true if OBJECT is a session.")
 (subscription? "Return true if OBJECT is a subscription."))

(define (say session datum)
  (let ((text (string-append (object->string datum) "\n")))
    (put-bytevector (session-port session) (string->utf8 text))
    (force-output (session-port session))))

(define (subscribe! session rate form)
  (unless (and (real? rate) (<= (car rates) rate (cdr rates)))
    (bight-raise 'domain 'subscribe "a rate is a number of times a second from ~a to ~a, not ~s" (car rates)
                 (cdr rates) rate))
  (when (>= (length (session-subscriptions session)) most-subscriptions)
    (bight-raise 'limit 'subscribe "a session has ~a subscriptions at most" most-subscriptions))
  (let ((number (+ 1 (session-serial session))))
    (set-session-serial! session number)
    (set-session-subscriptions!
     session (append (session-subscriptions session)
                     (list (make-subscription number form (/ 1.0 rate) (clock)))))
    number))

(define (subscription session number)
  (find (lambda (s) (equal? number (subscription-number s))) (session-subscriptions session)))

(define (end-subscription! session number)
  (set-session-subscriptions! session (remove (lambda (s) (equal? number (subscription-number s)))
                                              (session-subscriptions session))))

(define (unsubscribe! session number)
  (unless (subscription session number)
    (bight-raise 'name 'unsubscribe "there is no subscription ~s; there are ~s" number
                 (map subscription-number (session-subscriptions session))))
  (end-subscription! session number))

(define (do-form session form)
  (cond ((not (list? form)) (evaluate form))
        ((and (= 3 (length form)) (eq? 'subscribe (first form)))
         (subscribe! session (second form) (third form)))
        ((and (= 2 (length form)) (eq? 'unsubscribe (first form)))
         (unsubscribe! session (second form)))
        ((memq (and (pair? form) (first form)) '(subscribe unsubscribe))
         (bight-raise 'domain (first form) "it is used as (subscribe RATE FORM) or (unsubscribe NUMBER)"))
        (else (evaluate form))))

(define (answer session thunk)
  ;; The answer to what THUNK does, after what it printed.
  (call-or-fail
   (lambda ()
     (call-with-values (lambda () (call-printing thunk))
       (lambda (value printed)
         (unless (string-null? printed)
           (say session (list 'printed printed)))
         (if (unspecified? value)
             '(ok)
             (list 'ok (value->datum value))))))
   (lambda (failure) (cons 'error failure))))

(define (do-line session bytes)
  (let ((text (utf8->text bytes)))
    (unless (string-null? (string-trim-both text))
      (say session (answer session (lambda () (do-form session (read-form text))))))))


;;; Events.

(define (send-event session subscription)
  (say session
       (call-or-fail
        (lambda ()
          (call-with-values (lambda () (call-printing (lambda () (evaluate (subscription-form subscription)))))
            (lambda (value printed)
              (list 'event (subscription-number subscription) (value->datum value)))))
        (lambda (failure)
          (end-subscription! session (subscription-number subscription))
          (cons* 'ended (subscription-number subscription) failure))))
  (set-subscription-due! subscription (max (+ (subscription-due subscription) (subscription-period subscription))
                                           (clock))))

(define (send-due-events session)
  (let ((now (clock)))
    (for-each (lambda (s) (when (<= (subscription-due s) now) (send-event session s)))
              (session-subscriptions session))))

(define (until-next-event session)
  ;; Seconds, or #f for none.
  (let ((all (session-subscriptions session)))
    (and (pair? all)
         (max 0.0 (- (apply min (map subscription-due all)) (clock))))))


;;; Lines out of bytes.

(define newline-byte 10)

(define (index-of-newline bytes from)
  (let loop ((i from))
    (cond ((= i (bytevector-length bytes)) #f)
          ((= newline-byte (bytevector-u8-ref bytes i)) i)
          (else (loop (+ i 1))))))

(define (part bytes from to)
  (let ((new (make-bytevector (- to from))))
    (bytevector-copy! bytes from new 0 (- to from))
    new))

(define (joined chunks)
  ;; The bytes of CHUNKS, the last first.
  (let ((all (make-bytevector (apply + (map bytevector-length chunks)))))
    (fold (lambda (chunk end)
            (let ((start (- end (bytevector-length chunk))))
              (bytevector-copy! chunk 0 all start (bytevector-length chunk))
              start))
          (bytevector-length all) chunks)
    all))

(define (keep! session bytes)
  ;; BYTES are more of the line that comes.
  (let* ((before (session-size session)) (size (+ before (bytevector-length bytes))))
    (set-session-size! session size)
    (set-session-chunks! session
                         (if (> size longest-line) '() (cons bytes (session-chunks session))))
    (when (and (> size longest-line) (<= before longest-line))
      (say session `(error limit ,(simple-format #f "a line has ~a bytes at most" longest-line))))))

(define (end-line! session)
  (let ((chunks (session-chunks session)) (size (session-size session)))
    (set-session-chunks! session '())
    (set-session-size! session 0)
    (unless (> size longest-line)
      (do-line session (joined chunks)))))

(define (take-bytes! session bytes)
  (let loop ((from 0))
    (let ((end (index-of-newline bytes from)))
      (keep! session (part bytes from (or end (bytevector-length bytes))))
      (when end
        (end-line! session)
        (loop (+ end 1))))))

(define (converse session)
  (let loop ()
    (let* ((wait (until-next-event session))
           (port (session-port session))
           (ready (first (if wait (select (list port) '() '() wait) (select (list port) '() '())))))
      (send-due-events session)
      (if (null? ready)
          (loop)
          (let ((bytes (get-bytevector-some port)))
            (unless (eof-object? bytes)
              (take-bytes! session bytes)
              (loop)))))))

(define (serve-lines client)
  (setvbuf client 'block 65536)
  (converse (make-session client '() 0 '() 0)))

(define (open-door! file)
  "Serve lines at FILE, a socket made now, or at the usual one for #f, until this process ends.  Return the
file's name."
  (start-serving! file ".door" serve-lines))
