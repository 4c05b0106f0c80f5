;;; (bight repl) --- the prompt.
;;;
;;; Guile's own read-eval-print loop with manners: a short banner, one clear line for an error and no
;;; nested prompts, ^C that comes back to the prompt, a history kept between sessions, and completion of
;;; names, parts, keywords and files where readline is there.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight repl)
  #:use-module ((bight dive) #:select (served?))
  #:use-module (bight comma)
  #:use-module (bight errors)
  #:use-module ((bight expect) #:select (syntax-error->line))
  #:use-module ((bight outlet) #:select (behind))
  #:use-module ((bight folders) #:select (ensure-folder! state-folder))
  #:use-module (bight verb)
  #:use-module ((ice-9 regex) #:select (regexp-quote))
  #:use-module ((ice-9 session) #:select (apropos-internal))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module ((system foreign) #:select (string->pointer pointer->bytevector pointer-address sizeof))
  #:use-module ((system repl common) #:select (repl-default-option-set!))
  #:use-module ((system repl repl) #:select (start-repl))
  #:export (run-prompt
            set-manners!
            run-inner-prompt
            completions))


;;; Completion.

(define (language-names)
  ((module-ref (resolve-interface '(bight)) 'language-names)))

(define (language-ref name)
  (let ((variable (module-variable (resolve-interface '(bight)) name)))
    (and variable (variable-bound? variable) (variable-ref variable))))

(define (ask-names name)
  ;; The symbols that the query NAME lists, such as the parts of the dive, or none.
  (or (false-if-exception (filter symbol? ((language-ref name)))) '()))

(define (local-names)
  (module-map (lambda (name variable) name) (current-module)))

(define (all-keywords)
  (delete-duplicates
   (filter-map (lambda (argument) (and (keyword? (second argument)) (second argument)))
               (append-map (lambda (name) (verb-arguments (language-ref name))) (language-names)))))

(define (keyword->text keyword)
  (string-append "#:" (symbol->string (keyword->symbol keyword))))

(define (words-for text)
  ;; What may stand where TEXT begins, strings.
  (if (string-prefix? "#:" text)
      (map keyword->text (all-keywords))
      (map symbol->string
           (delete-duplicates (append (language-names) (local-names)
                                      (ask-names 'parts) (ask-names 'worlds))))))

(define (guile-names text)
  (map symbol->string (apropos-internal (string-append "^" (regexp-quote text)))))

(define (completions text)
  "Return the sorted list of the words that begin with TEXT: names of the language, of the user, of
parts and of worlds; keywords after #:; Guile's own names if there are none of these."
  (let ((ours (filter (lambda (word) (string-prefix? text word)) (words-for text))))
    (sort (if (null? ours) (guile-names text) ours) string<?)))

(define (make-completer complete-file)
  ;; A completer as readline calls it: for the first word with CONTINUE? #f, then for the others.
  (let ((words '()) (files? #f))
    (define (next-file text continue?)
      (set! files? #t)
      (complete-file text continue?))
    (define (next-word)
      (let ((word (car words)))
        (set! words (cdr words))
        word))
    (lambda (text continue?)
      (unless continue?
        (set! files? #f)
        (set! words (if (string-index text #\/) '() (or (false-if-exception (completions text)) '()))))
      (cond ((pair? words) (next-word))
            ((and continue? (not files?)) #f)
            (else (next-file text continue?))))))


;; Readline closes a quote after what it completes, and to it the ' of a symbol is one.  Guile offers no
;; switch, so its variable is set where it lies.
(define quotes (string->pointer "\""))

(define (set-quotes!)
  (let ((variable (dynamic-pointer "rl_basic_quote_characters" (dynamic-link "guile-readline"))))
    (bytevector-uint-set! (pointer->bytevector variable (sizeof '*)) 0 (pointer-address quotes)
                          (native-endianness) (sizeof '*))))


;;; History and line editing.

(define (history-file)
  ;; Where lines are kept, or #f if there is no such place.
  (let ((folder (state-folder)))
    (and folder
         (false-if-exception
          (begin
            (ensure-folder! folder #o700)
            (string-append folder "/history"))))))

(define (call-with-line-editing thunk)
  ;; Call THUNK with readline on, if this Guile has it.
  (let ((readline (false-if-exception
                   ;; It writes to a file of the C library.
                   (parameterize ((current-output-port (behind (current-output-port))))
                     (resolve-interface '(ice-9 readline))))))
    (if readline
        (let ((from-readline (lambda (name) (module-ref readline name))))
          (setenv "GUILE_HISTORY" (or (history-file) "/dev/null"))
          ((from-readline 'activate-readline))
          (false-if-exception (set-quotes!))
          ((from-readline 'with-readline-completion-function)
           (make-completer (from-readline 'filename-completion-function))
           thunk))
        (thunk))))


;;; The loop.

(define (call-with-interrupts thunk)
  ;; Call THUNK with ^C raising an error, which ends what is running and returns to the prompt.
  (let ((old #f))
    (dynamic-wind
      (lambda ()
        (set! old (sigaction SIGINT
                    (lambda (signal)
                      (scm-error 'signal #f "interrupted" '() (list signal))))))
      thunk
      (lambda ()
        (sigaction SIGINT (car old) (cdr old))))))

(set-exception-printer! 'signal
                        (lambda (port key args default-printer)
                          (display (cadr args) port)))

(define (prompt-of repl)
  ;; Editors look for Guile's own.
  (if (served?) "scheme@(guile-user)> " "bight> "))

(define (set-manners!)
  (repl-default-option-set! 'prompt prompt-of)
  (repl-default-option-set! 'on-error 'report)
  (repl-default-option-set! 'value-history #f) ; a picture must begin in the first column
  (repl-default-option-set! 'warning-level 0)
  (set-exception-printer! 'syntax-error print-syntax-error)
  (answer-unknown-commands!))

(define (print-syntax-error port key args default-printer)
  ;; In one line, and without the place in what was typed just now.
  (display (apply syntax-error->line args) port))

(define (enter-language!)
  (set-current-module (resolve-module '(guile-user)))
  (process-use-modules '(((ice-9 session)) ((bight)))))

(define (print-banner version)
  (simple-format #t "bight ~a, a tether to play with.  (help) is a short tour, ,q leaves.~%" version))

(define (status-of result)
  ;; The exit status in RESULT, what ended the loop: the arguments of `exit', or none.
  (let ((value (if (pair? result) (car result) 0)))
    (cond ((exact-integer? value) (logand value 255))
          ((not value) 1)
          (else 0))))

(define (call-with-prompt-below thunk)
  ;; With a loop below it a new one does not print Guile's own banner.
  (with-fluids ((*repl-stack* (cons 'bight (or (fluid-ref *repl-stack*) '()))))
    (thunk)))

(define (run-inner-prompt greeting)
  "Say GREETING, and run a prompt within what is going on until the user leaves it."
  (set-manners!)
  (display greeting)
  (newline)
  (call-with-interrupts
   (lambda ()
     (call-with-line-editing
      (lambda () (call-with-prompt-below (lambda () (start-repl))))))))

(define (run-prompt version)
  "Run the prompt of bight VERSION, a string, until the user leaves.  Return the exit status."
  (enter-language!)
  (set-manners!)
  (print-banner version)
  (let ((result (call-with-interrupts
                 (lambda ()
                   (call-with-line-editing
                    (lambda () (call-with-prompt-below (lambda () (start-repl)))))))))
    (run-hook exit-hook)
    (status-of result)))
