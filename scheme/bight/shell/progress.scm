;;; (bight shell progress) --- at a terminal: a progress bar on long runs, and what happened in them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell progress)
  #:use-module (bight core clock)
  #:use-module ((bight engine) #:select (%set-reporter!))
  #:use-module ((bight outlet) #:select (control watched?))
  #:use-module ((srfi srfi-1) #:select (first second third))
  #:export (with-progress with-telling without-telling tell-events))

(define patience 1.0)                   ; seconds of waiting before a bar is shown
(define width 40)

(define (terminal)
  ;; The error port if a person watches it, else #f.
  (let ((port (current-error-port)))
    (and (watched? port) port)))

(define (draw port share)
  (let ((full (inexact->exact (floor (* width share)))))
    (control "\r" port)
    (simple-format port "[~a~a] ~a %" (make-string full #\=) (make-string (- width full) #\space)
                   (inexact->exact (floor (* 100 share))))
    (force-output port)))

(define (clear port)
  (control (string-append "\r" (make-string (+ width 10) #\space) "\r") port))

(define (make-bar)
  ;; A procedure that draws a bar on PORT once what it is of has lasted, or, with the share #f, clears it.
  (let ((begun #f) (drawn #f))
    (lambda (port share)
      (let ((t (clock)))
        (cond ((not share)
               (when (and port drawn) (clear port))
               (set! begun #f)
               (set! drawn #f))
              ((not begun) (set! begun t))
              ((and port (> (- t begun) patience) (or (not drawn) (> (- t drawn) 0.1)))
               (set! drawn t)
               (draw port share)))))))

(define (with-bar port n work)
  (let ((bar (make-bar)))
    (dynamic-wind
      (lambda () (bar port 0))
      (lambda () (work (lambda (done) (bar port (/ (exact->inexact done) n)))))
      (lambda () (bar port #f)))))

;; One call of the engine that lasts, such as `enter!' or `place!', tells how far it is.
(let ((bar (make-bar)))
  (%set-reporter! (lambda (share) (bar (terminal) share))))

(define (at-prompt?)
  ;; Does a person type at a prompt?
  (let ((module (resolve-module '(system repl common) #f #:ensure #f)))
    (and module
         (let ((stack (module-variable module '*repl-stack*)))
           (and stack (pair? (or (fluid-ref (variable-ref stack)) '())))))))

(define (event->string event mark)
  ;; "   12.35 s  line touched leg-a1", MARK before the line.
  (simple-format #f "~a s  ~a~a ~a"
                 (string-pad (number->string (/ (round (* 100 (second event))) 100)) 10)
                 mark
                 (or (third event) "")
                 (string-join (map symbol->string (cons (first event) (cdddr event))))))

(define* (tell-events port events #:optional (mark ""))
  "Tell PORT what happened: EVENTS, lists (KIND TIME SUBJECT OBJECT ...), a line each, with MARK before what
happened."
  (for-each (lambda (event) (display (event->string event mark) port) (newline port)) events))

;; What is told by one verb is not told again by the verbs that it calls.
(define telling? (make-parameter #t))

(define (without-telling work)
  "Return what WORK, a thunk, returns; of what happens meanwhile nothing is told: it is a trial of a verb's own."
  (parameterize ((telling? #f)) (work)))

(define (with-telling mark events work)
  "Return what WORK, a thunk, returns.  Where a person types at a prompt, tell what happened meanwhile, MARK
before it: what EVENTS, a procedure of the number of events to leave out, then returns."
  (if (and (telling?) (terminal) (at-prompt?))
      (let* ((before (events #f)) (value (without-telling work)))
        (tell-events (terminal) (events before) mark)
        value)
      (work)))

(define (with-progress n work)
  "Call WORK with a procedure that it calls with how many of N steps are done.  When that takes long and
a person watches, a bar shows it."
  (let ((port (and (> n 1) (terminal))))
    (if port
        (with-bar port n work)
        (work (lambda (done) #f)))))
