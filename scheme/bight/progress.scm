;;; (bight progress) --- a progress bar on long runs at a terminal.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight progress)
  #:export (with-progress))

(define patience 1.0)                   ; seconds of waiting before a bar is shown
(define width 40)

(define (clock)
  (/ (get-internal-real-time) (exact->inexact internal-time-units-per-second)))

(define (terminal)
  ;; The error port if a person watches it, else #f.
  (let ((port (current-error-port)))
    (and (file-port? port) (isatty? port) port)))

(define (draw port share)
  (let ((full (inexact->exact (floor (* width share)))))
    (simple-format port "\r[~a~a] ~a %" (make-string full #\=) (make-string (- width full) #\space)
                   (inexact->exact (floor (* 100 share))))
    (force-output port)))

(define (clear port)
  (simple-format port "\r~a\r" (make-string (+ width 10) #\space))
  (force-output port))

(define (with-bar port n work)
  (let ((begun (clock)) (drawn #f))
    (define (report done)
      (let ((t (clock)))
        (when (and (> (- t begun) patience) (or (not drawn) (> (- t drawn) 0.1)))
          (set! drawn t)
          (draw port (/ (exact->inexact done) n)))))
    (dynamic-wind
      (lambda () #f)
      (lambda () (work report))
      (lambda () (when drawn (clear port) (set! drawn #f))))))

(define (with-progress n work)
  "Call WORK with a procedure that it calls with how many of N steps are done.  When that takes long and
a person watches, a bar shows it."
  (let ((port (and (> n 1) (terminal))))
    (if port
        (with-bar port n work)
        (work (lambda (done) #f)))))
