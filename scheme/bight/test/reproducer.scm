;;; (bight test reproducer) --- a case of a property as a scenario that can be pasted, or run as a file.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test reproducer)
  #:use-module ((bight core programs) #:select (check-writable))
  #:use-module ((ice-9 pretty-print) #:select (pretty-print))
  #:use-module (srfi srfi-1)
  #:export (reproducer-text
            write-reproducer
            make-folder))

(define (indented datum)
  ;; DATUM as code, two blanks in.
  (call-with-output-string
   (lambda (port) (pretty-print datum port #:per-line-prefix "  " #:width 92 #:max-expr-width 80))))

(define (definition variable expression)
  (if (and (pair? expression) (eq? 'lambda (car expression)))
      `(define (,variable ,@(cadr expression)) ,@(cddr expression))
      `(define ,variable ,expression)))

(define (reproducer-text name sentence seed n bindings forms)
  "Return the text of a scenario with FORMS, in which the variables have the expressions of the alist
BINDINGS: the case N, with SEED, of the property NAME, which says SENTENCE."
  (string-append
   (simple-format #f "(define-scenario ~a-case-~a~%  ~s~%" name n sentence)
   (string-trim-right
    (string-concatenate
     (append (map (lambda (binding) (indented (definition (car binding) (cdr binding)))) bindings)
             (map indented forms))))
   ")\n"))


;;; Files.  What a property's file defines beside its scenarios comes along.

(define heads-left-out '(define-scenario define-property))

(define (strip-comments text)
  ;; TEXT from its first line on that is neither blank nor a comment.
  (string-join (drop-while (lambda (line)
                             (let ((line (string-trim line)))
                               (or (string-null? line) (string-prefix? ";" line))))
                           (string-split text #\newline))
               "\n"))

(define (slice file start end)
  (call-with-input-file file
    (lambda (port)
      (seek port start SEEK_SET)
      (set-port-encoding! port "UTF-8")
      (let loop ((chars '()))
        (if (>= (ftell port) end)
            (reverse-list->string chars)
            (loop (cons (read-char port) chars)))))))

(define (preamble file)
  ;; The text of the forms of FILE that are no scenarios.
  (call-with-input-file file
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (let loop ((texts '()))
        (let* ((start (ftell port)) (form (read port)) (end (ftell port)))
          (cond ((eof-object? form) (string-join (reverse texts) "\n\n"))
                ((and (pair? form) (memq (car form) heads-left-out)) (loop texts))
                (else (loop (cons (strip-comments (slice file start end)) texts)))))))))

(define (make-folder folder)
  "Make FOLDER, and those it is in, unless it is there."
  (unless (file-exists? folder)
    (make-folder (dirname folder))
    (false-if-exception (mkdir folder)))) ; another process may be first

(define (write-reproducer folder name seed n location text)
  "Write TEXT, a scenario that comes from the property NAME at LOCATION, to a file in FOLDER of its own.
Return the file's name."
  (let ((file (simple-format #f "~a/~a-seed-~a-case-~a.scm" folder name seed n)))
    (make-folder folder)
    (check-writable 'run-tests file)
    (call-with-output-file file
      (lambda (port)
        (set-port-encoding! port "UTF-8")
        (simple-format port ";;; Case ~a with seed ~a of the property ~a~a.~%~%" n seed name
                       (if location (string-append ", from " (basename (car location))) ""))
        (when (and location (file-exists? (car location)))
          (simple-format port "~a~%~%" (preamble (car location))))
        (display text port)))
    file))
