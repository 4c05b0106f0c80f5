;;; (bight outlet) --- where text goes out to a terminal.
;;;
;;; A terminal obeys some characters instead of showing them, and text may come from anybody's file: names,
;;; sentences, errors.  So what the program displays passes an outlet, a port that escapes them; nobody who
;;; displays anything need think of it.  What bight itself wants obeyed, such as colours and the cursor's
;;; moves, goes to the port behind, by `control'.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight outlet)
  #:use-module (bight core escape)
  #:export (outlet
            guard-outputs!
            behind
            watched?
            control
            shown))

(define (outlet port)
  "Return a port whose text goes to PORT with all that a terminal would obey escaped."
  (let ((guarded (%outlet port)))
    (setvbuf guarded (if (and (file-port? port) (isatty? port)) 'line 'block))
    guarded))

(define (behind port)
  "Return the port that PORT, an outlet, writes to; any other port itself."
  (%behind port))

(define (watched? port)
  "Return #t if a terminal is at the end of PORT."
  (let ((port (behind port)))
    (and (file-port? port) (isatty? port))))

(define* (control text #:optional (port (current-output-port)))
  "Write TEXT, which a terminal is to obey, to PORT, after what was written there."
  (force-output port)
  (display text (behind port))
  (force-output (behind port)))

(define (shown text)
  "Return TEXT, a string, as an outlet writes it."
  (%shown text))


;;; Programs that are started write to this process's own ports: only files will do.

(define (call-behind proc)
  (lambda arguments
    (let ((out (current-output-port)) (err (current-error-port)))
      (force-output out)
      (force-output err)
      (parameterize ((current-output-port (behind out)) (current-error-port (behind err)))
        (apply proc arguments)))))

(define (wrap! module name)
  (let ((variable (module-variable (resolve-module module) name)))
    (when variable
      (variable-set! variable (call-behind (variable-ref variable))))))

(define (guard-outputs!)
  "From now on let what this process displays pass outlets."
  (set-current-output-port (outlet (current-output-port)))
  (let ((error (outlet (current-error-port))))
    (setvbuf error 'none)
    (set-current-error-port error)
    (current-warning-port error))
  (wrap! '(guile) 'system*)
  (wrap! '(ice-9 popen) 'open-process))
