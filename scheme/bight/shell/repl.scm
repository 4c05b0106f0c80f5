;;; (bight shell repl) --- the prompt.
;;;
;;; Guile's own read-eval-print loop with manners: a short banner, one clear line for an error and no
;;; nested prompts, ^C that comes back to the prompt, a history kept between sessions, and completion of
;;; names, parts, keywords and files where readline is there.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell repl)
  #:use-module ((bight core here) #:select (chain-here))
  #:use-module ((bight core place) #:select (mark-what-is-loaded!))
  #:use-module ((bight dive) #:select (served?))
  #:use-module ((bight language) #:select (use-language!))
  #:use-module (bight shell comma)
  #:use-module (bight shell line-editor)
  #:use-module (bight shell typed)
  #:use-module ((bight core told) #:select (syntax-error->line))
  #:use-module ((bight view looks) #:select (value->lines))
  #:use-module ((system repl common) #:select (repl-default-option-set!))
  #:use-module ((system repl repl) #:select (start-repl))
  #:export (run-prompt
            set-manners!
            run-inner-prompt))


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
  (repl-default-option-set! 'value-history #f) ; ours shows pictures and tables, too
  (repl-default-option-set! 'print show-value)
  (remove-hook! before-eval-hook note-what-is-asked!)
  (add-hook! before-eval-hook note-what-is-asked!)
  (repl-default-option-set! 'warning-level 0)
  (set-exception-printer! 'syntax-error print-syntax-error)
  (answer-unknown-commands!))

;; What was typed last, if it is a call: the name of what is called, else #f.  An answer such as #t is said in
;; words where it is asked for, not where it comes up among other things.
(define asked #f)

(define (note-what-is-asked! form)
  (let ((form (syntax->datum form)))
    (set! asked (and (pair? form) (symbol? (car form)) (car form)))))

;;; Values, as they look at the prompt, are called $1, $2 and so on, in Guile's own module for them.

(define shown-values 0)

(define (remember! value)
  ;; The name by which VALUE is known from now on.
  (let ((history (resolve-module '(value-history))))
    (set! shown-values (+ shown-values 1))
    (let ((name (string->symbol (simple-format #f "$~a" shown-values))))
      (module-define! history name value)
      (module-export! history (list name))
      (module-use! (current-module) (module-public-interface history))
      name)))

(define (show-value repl value)
  (cond ((unspecified? value))
        ((served?) (write value) (newline)) ; an editor reads it
        (else
         (let ((name (remember! value)) (lines (value->lines value asked)))
           (simple-format #t "~a =~a" name (if (null? (cdr lines)) " " "\n"))
           (for-each (lambda (line) (display line) (newline)) lines)))))

(define (print-syntax-error port key args default-printer)
  ;; In one line, and without the place in what was typed just now.
  (display (apply syntax-error->line args) port))

(define (enter-language!)
  (set-current-module (resolve-module '(guile-user)))
  (process-use-modules '(((ice-9 session))))
  (use-language! (current-module))
  (mark-what-is-loaded!)
  (add-hook! after-error-hook tell-chain))

(define (tell-chain)
  ;; Guile reports an error where it is raised: the calls that led there are still under way.
  (note-chain! (chain-here))
  (print-chain (frames-elsewhere (chain-here)) (current-error-port)))

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

(define (read-and-evaluate)
  ;; The loop; forms are interpreted, so that their errors know their lines.
  (repl-default-option-set! 'interp #t)
  (call-with-interrupts
   (lambda ()
     (call-with-line-editing
      (lambda () (call-with-prompt-below (lambda () (start-repl language-of-prompt))))))))

(define (run-inner-prompt greeting)
  "Say GREETING, and run a prompt within what is going on until the user leaves it."
  (set-manners!)
  (display greeting)
  (newline)
  (read-and-evaluate))

(define (run-prompt version)
  "Run the prompt of bight VERSION, a string, until the user leaves.  Return the exit status."
  (enter-language!)
  (set-manners!)
  (print-banner version)
  (let ((result (read-and-evaluate)))
    (run-hook exit-hook)
    (status-of result)))
