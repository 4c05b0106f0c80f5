;;; (bight bench in-time) --- as much of a long measurement as fits into the minutes that it was given, and how far it is.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench in-time)
  #:use-module (bight core clock)
  #:use-module ((bight outlet) #:select (control watched?))
  #:use-module ((ice-9 control) #:select (let/ec))
  #:export (say-progress minutes-from-now share-of-time as-many-as-fit in-time?))

(define (say-progress text . values)
  "Say TEXT, filled with VALUES, on the error port, if that is a terminal: in place of what was said before."
  (let ((port (current-error-port)))
    (when (watched? port)
      (control "\r\x1b[K" port)
      (display (apply simple-format #f text values) port)
      (force-output port))))

(define (minutes-from-now minutes)
  "Return the time, s by a clock of the machine's own, that is MINUTES from now; never, if that is #f."
  (if minutes (+ (clock) (* 60.0 minutes)) +inf.0))

(define (share-of-time end parts)
  "Return when the first of PARTS that share the time until END, as `minutes-from-now' returns it, is to end."
  (if (= end +inf.0) end (+ (clock) (/ (- end (clock)) parts))))

(define leave (make-parameter (const #f))) ; called once the time is over
(define end-of-time (make-parameter +inf.0))

(define (in-time?)
  "Return #t.  Within `as-many-as-fit', once the time is over, leave what is being measured instead."
  (when (>= (clock) (end-of-time)) ((leave)))
  #t)

(define between 15)                     ; s from one line about the progress to the next, in a file

(define (make-teller what n)
  ;; A procedure of how many of N are done, which says so on the error port: at a terminal at once, in a file now and then.
  (let* ((begun (clock)) (told begun) (live? (watched? (current-error-port))))
    (define (progress done)
      (simple-format #f "~a: ~a of ~a in ~a s" what done n (inexact->exact (round (- (clock) begun)))))
    (lambda (done)
      (cond ((eq? done 'end) (say-progress ""))
            (live? (say-progress "~a" (progress done)))
            ((>= (- (clock) told) between)
             (set! told (clock))
             (simple-format (current-error-port) "~a~%" (progress done))
             (force-output (current-error-port)))))))

(define (as-many-as-fit what n end measure)
  "Return what MEASURE returns of 0, 1 ... N - 1, a list: of as many as are measured before END, as `minutes-from-now'
returns it.  MEASURE calls `in-time?' often.  What was under way at END is not among them.  WHAT, a string, says on the
error port what it is of which so many are done."
  (let ((tell! (make-teller what n)))
    (let loop ((k 0) (found '()))
      (let ((value (and (< k n)
                        (let/ec out
                          (parameterize ((end-of-time end) (leave (lambda () (out #f))))
                            (in-time?)
                            (list (measure k)))))))
        (cond (value
               (tell! (+ k 1))
               (loop (+ k 1) (cons (car value) found)))
              (else
               (tell! 'end)
               (reverse! found)))))))
