;;; (bight shell status) --- how a command ends: its exit status, and one line on stderr for what went wrong.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell status)
  #:use-module (bight core errors)
  #:use-module ((bight core here) #:select (noting-places))
  #:use-module (bight core late)
  #:use-module (bight shell program)
  #:export (complain exit-status))

(define (lost-output)
  ;; Why what was written to the standard output cannot go there, a string, or #f.  What is left of it is
  ;; then thrown away, so that nobody stumbles over it again.
  (catch 'system-error
    (lambda ()
      (force-output (current-output-port))
      #f)
    (lambda arguments
      (dup2 (open-fdes "/dev/null" O_WRONLY) 1)
      (force-output (current-output-port))
      (string-append "cannot write to the standard output: " (strerror (system-error-errno arguments))))))

(define (complain text)
  "Say TEXT on the standard error, or that the standard output is lost, and return the exit status for it."
  (simple-format (current-error-port) "bight: ~a~%" (or (lost-output) text))
  (force-output (current-error-port))   ; a child may be made next
  1)

(define (status-of arguments)
  ;; The exit status that `exit' was called with.
  (cond ((null? arguments) 0)
        ((exact-integer? (car arguments)) (logand (car arguments) 255))
        ((car arguments) 0)
        (else 1)))

(define (told-status thunk)
  ;; What THUNK returns, or the status of an exit; what it raises is told in a line.
  (catch 'quit
    (lambda ()
      (with-exception-handler
          (lambda (exception)
            (cond ((program-error? exception) (complain (program-error-text exception)))
                  ((memq (exception-kind exception) '(quit)) (raise-exception exception))
                  (else (complain ((from (bight core told) exception->placed-line) exception)))))
        (lambda () (noting-places thunk))
        #:unwind? #t))
    (lambda (key . arguments) (status-of arguments))))

(define (exit-status thunk)
  "Call THUNK, which returns an exit status or exits, and return that.  What it raises, and that its output
could not be written, is told in one line on the standard error."
  (let* ((status (told-status thunk))
         (lost (lost-output)))
    (if lost (complain lost) status)))
