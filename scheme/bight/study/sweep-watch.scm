;;; (bight study sweep-watch) --- who watches a sweep: how far it is, and that it is to stop.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-watch)
  #:use-module (bight core clock)
  #:use-module ((bight outlet) #:select (control watched?))
  #:export (progress-shower
            call-with-stop
            stop-asked?))

;;; Progress.

(define (two-digits n) (string-pad (number->string n) 2 #\0))

(define (duration->string seconds)
  ;; H:MM:SS, or M:SS.
  (let* ((s (inexact->exact (ceiling seconds))) (m (quotient s 60)) (h (quotient m 60)))
    (if (zero? h)
        (simple-format #f "~a:~a" m (two-digits (remainder s 60)))
        (simple-format #f "~a:~a:~a" h (two-digits (remainder m 60)) (two-digits (remainder s 60))))))

(define (tenths x) (/ (round (* 10 x)) 10))

(define bar-width 24)

(define (progress-line flown all failed seconds)
  (let* ((full (quotient (* bar-width flown) (max 1 all)))
         (rate (/ flown (max 1e-3 seconds))))
    (string-append
     "[" (make-string full #\=) (make-string (- bar-width full) #\space) "] "
     (simple-format #f "~a/~a" flown all)
     (if (positive? flown)
         (simple-format #f ", ~a/s, ~a left" (tenths rate) (duration->string (/ (- all flown) rate)))
         "")
     (if (positive? failed) (simple-format #f ", ~a failed" failed) ""))))

(define erase-line "\r\x1b[K")

(define (progress-shower)
  "Return a procedure of how many are flown, of how many, and how many failed, which shows that at a terminal;
called with #f, it clears what it showed."
  (let ((port (current-error-port)) (begun (clock)) (drawn -1))
    (if (and (watched? port) (not (equal? "dumb" (getenv "TERM"))))
        (lambda (flown . rest)
          (cond ((not flown) (control erase-line port))
                ((> (- (clock) drawn) 0.1)
                 (set! drawn (clock))
                 (control erase-line port)
                 (display (apply progress-line flown (append rest (list (- drawn begun)))) port)
                 (force-output port))))
        (const #f))))


;;; Stopping.

(define stop-asked (make-parameter #f)) ; a variable

(define (stop-asked?)
  "Return #t if ^C was typed, or an end was asked for otherwise, within `call-with-stop'."
  (variable-ref (stop-asked)))

(define (call-with-stop thunk)
  "Call THUNK; ^C, or an end that is asked for otherwise, ends nothing, and is told by `stop-asked?'."
  (let* ((stop (make-variable #f))
         (note (lambda (signal) (variable-set! stop #t)))
         (signals (list SIGINT SIGTERM SIGHUP))
         (before (map (lambda (signal) (sigaction signal note)) signals)))
    (dynamic-wind
      (const #f)
      (lambda () (parameterize ((stop-asked stop)) (thunk)))
      (lambda ()
        (for-each (lambda (signal old) (sigaction signal (car old) (cdr old))) signals before)))))
