;;; (bight shell comma) --- commands of the prompt that begin with a comma.
;;;
;;; They are Guile's own, but for those that would say too little of bight.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell comma)
  #:use-module (bight core errors)
  #:use-module ((bight core sentence) #:select (sentence-of-variable))
  #:use-module (bight shell typed)
  #:use-module ((bight core told) #:select (frame->line source-line))
  #:use-module ((ice-9 session) #:select (apropos-internal))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:use-module ((system repl command) #:select (define-meta-command))
  #:use-module ((system repl common) #:select (repl-eval))
  #:export (answer-unknown-commands!
            note-chain!
            print-chain))

;; Guile's own knows no macros.
(define-meta-command ((describe #f) repl (form))
  "describe NAME
Show the documentation of NAME; (help NAME) tells how it is used too."
  (let* ((datum (syntax->datum form))
         (value (if (symbol? datum) (module-ref (current-module) datum) (repl-eval repl form)))
         (docstring-of (module-ref (resolve-interface '(bight shell doc)) 'docstring-of)))
    (display (or (docstring-of value) "There is no documentation."))
    (newline)))

;; Guile's own does not see what is loaded only when it is used.
(define-meta-command ((apropos a) repl regexp)
  "apropos REGEXP
Show the names that match REGEXP, bight's with a sentence each, then Scheme's."
  (let* ((text (object->string regexp display))
         (pattern (make-regexp text))
         (matches? (lambda (name) (regexp-exec pattern (symbol->string name))))
         (ours (filter matches? ((module-ref (resolve-interface '(bight)) 'language-names))))
         (theirs (remove (lambda (name) (memq name ours)) (apropos-internal text))))
    (for-each (lambda (name)
                (simple-format #t "  ~a  ~a~%" (string-pad-right (symbol->string name)
                                                                 (max 22 (string-length (symbol->string name))))
                               (sentence-of-variable name)))
              ours)
    (unless (null? theirs)
      (simple-format #t "of Scheme: ~a~%" (string-join (map symbol->string (sort-names theirs)) " ")))))

(define (sort-names names)
  (sort (delete-duplicates names eq?) (lambda (a b) (string<? (symbol->string a) (symbol->string b)))))

(define last-chain '())

(define (note-chain! frames)
  "Remember the FRAMES that led to the last error."
  (set! last-chain frames))

(define (print-chain frames port)
  "Print to PORT where the calls of FRAMES stand, and the source there, typed or in a file, a line each."
  (define (line-at place)
    (or (and=> (typed-line place) string-trim-both) (source-line place)))
  (for-each (lambda (frame) (simple-format port "~a~%" (frame->line frame line-at))) frames))

;; Guile's own shows the frames of its evaluator.
(define-meta-command ((backtrace bt) repl)
  "backtrace
Show the lines that led to the last error, the innermost first."
  (if (null? last-chain)
      (display "No line led to the last error.\n")
      (print-chain last-chain (current-output-port))))


;;; A command that is misspelt: Guile's own reader of commands says no more than that there is none.

(define guiles (resolve-module '(system repl command)))

(define (command-names)
  (concatenate (append-map cdr (module-ref guiles '*command-table*))))

(define (known? word)
  ((module-ref guiles 'lookup-command) (string->symbol word)))

(define (ends-word? c)
  (or (eof-object? c) (char-whitespace? c) (memv c '(#\( #\) #\"))))

(define (next-word)
  ;; The word that follows on the input, where it stays to be read.
  (let loop ((chars '()))
    (if (ends-word? (peek-char))
        (let ((word (reverse-list->string chars)))
          (unread-string word (current-input-port))
          word)
        (loop (cons (read-char) chars)))))

(define (answer-unknown word)
  (let ((near (nearest word (command-names))))
    (read-line)
    (simple-format #t "There is no command ,~a; ~a,help lists them.~%" word
                   (if near (simple-format #f "did you mean ,~a?  " near) ""))))

;; Guile reads the forms of a command as syntax; the Geiser of Debian 12 takes them for data, so that it
;; would apply the value of what an editor evaluates to nothing.
(define (run-on-data repl)
  (let* ((command ((module-ref guiles 'lookup-command) (read)))
         (forms ((module-ref guiles 'read-command-arguments) command repl)))
    (when forms
      (apply ((module-ref guiles 'command-procedure) command) repl (map syntax->datum forms)))))

(define (reader-of-commands own)
  (lambda (repl)
    (let ((word (next-word)))
      (cond ((not (or (string-null? word) (known? word))) (answer-unknown word))
            ((string=? "geiser-eval" word) (run-on-data repl))
            (else (own repl))))))

(define answer-unknown-commands!
  (let ((own #f))
    (lambda ()
      "From now on name the command that was meant when one after a comma is misspelt."
      (unless own
        (let ((variable (module-variable guiles 'meta-command)))
          (set! own (variable-ref variable))
          (variable-set! variable (reader-of-commands own)))))))
