;;; (bight shell program) --- programs evaluated form by form, so that what goes wrong has a line.
;;;
;;; What a command needs beyond the language is loaded when it is used, by `from'.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell program)
  #:use-module (bight core late)
  #:use-module (bight core errors)
  #:use-module ((bight core here) #:select (noting-places))
  #:export (evaluate-file evaluate-port program-error? program-error-text
            enter-language! ignore show-values absolute))

(define &program-error (make-exception-type '&program-error &error '(text)))
(define make-program-error (record-constructor &program-error))

(define program-error?
  (let ((ours? (exception-predicate &program-error)))
    (lambda (obj)
      "Return true if OBJ says what went wrong in a program."
      (ours? obj))))

(define program-error-text
  (let ((get (exception-accessor &program-error (record-accessor &program-error 'text))))
    (lambda (condition)
      "Return what CONDITION says: FILE:LINE: PROCEDURE: MESSAGE."
      (get condition))))

(define (located port file line exception)
  ;; What EXCEPTION says, after its place: the line it tells of itself, or LINE of FILE.
  (let ((text (string-append ((from (bight core told) exception->line) exception)
                             ((from (bight core told) chain-suffix) exception)))
        (place ((from (bight core told) raised-at) exception))
        (name (string-append (port-filename port) ":")))
    (cond ((string-prefix? name text)
           (string-append (or file "expression") ":" (substring text (string-length name))))
          ((and place (not (equal? (car place) "expression")))
           (string-append ((from (bight core told) location->string) place) ": " text))
          (file
           (string-append file ":" (number->string line) ": " text))
          (else text))))

(define (call-at port file line thunk)
  ;; Call THUNK; what it raises becomes a &program-error, but ^C and `exit' pass.
  (with-exception-handler
      (lambda (exception)
        (raise-exception
         (if (memq (exception-kind exception) '(quit signal))
             exception
             (make-program-error (located port file line exception)))))
    (lambda () (noting-places thunk))
    #:unwind? #t))

(define (line-of form)
  (+ 1 (or (assq-ref (or (syntax-source form) '()) 'line) 0)))

(define (evaluate-port port file see)
  ;; Evaluate in the current module all that stands in PORT, form by form, and call SEE with the values
  ;; of each.  An error becomes a &program-error with the line, and FILE if it is not #f.
  (let loop ((line 1))
    (let ((form (call-at port file line (lambda () (read-syntax port)))))
      (unless (eof-object? form)
        (let ((line (line-of form)))
          (call-at port file line
                   (lambda ()
                     (call-with-values
                         (lambda () ((from (bight core place) evaluate-marked) form (port-filename port)))
                       see)))
          (loop line))))))

(define (skip-first-line! port)
  ;; Pass over `#!/usr/bin/bight', but leave Guile's own `#! ... !#' to the reader.
  (let* ((start (ftell port))
         (ours? (and (string-prefix? "#!/" (next-line port))
                     (not (string=? "!#" (next-line port))))))
    (seek port start SEEK_SET)
    (set-port-line! port 0)
    (when ours?
      (next-line port))))

(define (next-line port)
  (let ((line ((from (ice-9 rdelim) read-line) port)))
    (if (eof-object? line) "" line)))

(define (script? port)
  (eqv? #\# (peek-char port)))

(define (absolute file)
  (if (string-prefix? "/" file) file (string-append (getcwd) "/" file)))

(define (evaluate-file file)
  "Evaluate the forms of FILE in the current module.  What goes wrong is raised as a &program-error that
begins with FILE and the line."
  (call-with-input-file file
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (set-port-filename! port (absolute file)) ; `load' and the like look beside it
      (when (script? port)
        (skip-first-line! port))
      (evaluate-port port file ignore))))

(define (ignore . values) *unspecified*)

(define (show-values . values)
  (for-each (lambda (value)
              (unless (unspecified? value)
                (write value)
                (newline)))
            values))

(define (enter-language!)
  ;; Make a user's module, with the language, the current one.
  (set-current-module (resolve-module '(guile-user)))
  ((from (bight language) use-language!) (current-module))
  ((from (bight core place) mark-what-is-loaded!)))
