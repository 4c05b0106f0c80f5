;;; What a lesson from outside may say: the language of lessons, and nothing that reaches beyond it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core sandbox)
             ((bight lesson file) #:select (lesson-files))
             ((bight lesson guide) #:select (untrusted?)))

(define (read-inside text)
  ;; The lessons that TEXT, read as a file from outside, defines.
  (let* ((port (mkstemp (string-copy "/tmp/bight-XXXXXX")))
         (file (port-filename port)))
    (display text port)
    (close-port port)
    (dynamic-wind
      (const #t)
      (lambda () (parameterize ((untrusted? #f)) (read-lessons-inside file)))
      (lambda () (delete-file file)))))

(define-scenario a-plain-lesson-is-read
  "Definitions, worlds, builders and arithmetic are all there."
  (expect (length (read-inside "
(define depth* (* 2 10))
(define (row n) (map (lambda (i) (part cylinder (named ,(if (= i 0) 'a 'b)) (from i 2 0) (to i 2 -9) (radius 0.1))) n))
(define-world pond \"A pond.\" (sea (depth depth*)) (splice (row '(0 3)))
  (rov (named m) (at 1 5 -5)) (tether (wet-weight 0) (from 1 0 -2) (to m) (length 12)))
(define-lesson pond-lesson \"A pond\"
  (in (with pond (current (setting 'u) 90))) (setting u 0 0.1 0.2) (say \"~a\" (winding 'a))
  (branch ((> (now) 1) (say \"late\")) (else (say \"early\")))
  (task \"Wait.\" (done-when (> (now) 1)) (fault-after 0.5 \"!\" (current! 0.3 0)))
  (score (slack 0 1)) (count n (taut?)) (tender \"Sleeps.\" (run 1))
  (pilot expert \"Waits.\" (answers (truth choices) truth) (flies (run 1))))")) => 1))

(define-scenario lessons-use-what-there-is-inside
  "No shipped lesson uses a name, in whatever branch, that it could not use from outside; what does is found."
  (for-each (lambda (file) (expect (cons file (unbound-inside file)) => (list file))) (lesson-files))
  (let* ((port (mkstemp (string-copy "/tmp/bight-XXXXXX"))) (file (port-filename port)))
    (write '(define (far x) (if x (own x) (beyond))) port)
    (write '(define (own x) (lambda (y) (elsewhere y x))) port)
    (close-port port)
    (expect (sort (map symbol->string (unbound-inside file)) string<?) => '("beyond" "elsewhere"))
    (delete-file file)))

(define-scenario names-are-made-by-format
  "`format' makes a string, as of names of many parts; it prints nothing.  It was unbound."
  (expect (length (read-inside "
(define piles
  (map (lambda (i) (part cylinder (named ,(string->symbol (format #f \"pile-~a\" i))) (from i 2 0) (to i 2 -9) (radius 0.1)))
       (iota 3)))
(define-world yard \"A yard.\" (sea (depth 20)) (splice piles)
  (rov (named m) (at 1 5 -5)) (tether (wet-weight 0) (from 1 0 -2) (to m) (length 12)))
(define-lesson yard-lesson \"A yard\"
  (in yard) (say \"~a\" (simple-format #f \"~a of ~s\" 1 \"3\")) (task \"Wait.\" (done-when (> (now) 1)))
  (score (winding 'pile-2) 0 1))")) => 1)
  (expect (read-inside "(format #t \"printed\")") raises domain)
  (expect (read-inside "(simple-format #t \"printed\")") raises domain))

(define-scenario (the-language-ends form)
  "Files, processes, modules, syntax, clocks, change in place and eval are not part of it."
  #:for ((form "(call-with-output-file \"/tmp/stolen\" write)"
               "(open-file \"/tmp/stolen\" \"w\")" "(open-output-file \"/tmp/stolen\")"
               "(with-output-to-file \"/tmp/stolen\" newline)"
               "(call-with-input-file \"/etc/passwd\" read)" "(open-input-file \"/etc/passwd\")"
               "(delete-file \"/tmp/x\")" "(rename-file \"/tmp/x\" \"/tmp/y\")" "(mkdir \"/tmp/stolen\")"
               "(stat \"/etc/passwd\")" "(opendir \"/\")" "(getcwd)" "(chdir \"/\")"
               "(system \"id\")" "(system* \"id\")" "(execl \"/bin/sh\")" "(primitive-fork)"
               "(open-input-pipe \"id\")" "(kill 1 9)" "(exit 0)" "(primitive-exit 0)" "(primitive-_exit 0)"
               "(load \"/etc/passwd\")" "(primitive-load \"/etc/passwd\")" "(include \"/etc/passwd\")"
               "(load-from-path \"ice-9/popen\")" "(load-extension \"x\" \"y\")"
               "(use-modules (ice-9 popen))" "(define-module (evil))" "(import (guile))"
               "((@ (guile) system) \"id\")" "((@@ (bight lesson) take-lesson) 1)"
               "(resolve-module '(guile))" "(resolve-interface '(guile))" "(current-module)"
               "(set-current-module 1)" "(module-ref 1 'car)" "(module-define! 1 'car cdr)"
               "(the-root-module)" "(interaction-environment)" "(nested-ref 1 '(a))"
               "(eval '(+ 1 2) 1)" "(primitive-eval '(+ 1 2))" "(compile '(+ 1 2))" "(local-eval 1 2)"
               "(the-environment)" "(eval-string \"1\")" "(call-with-input-string \"1\" read)"
               "(define-syntax when (syntax-rules () ((_) 1)))" "(define-syntax-rule (f) 1)"
               "(datum->syntax #'x 'system)" "(syntax->datum 1)" "(macroexpand '(when 1 2))"
               "(let-syntax () 1)" "#.(system \"id\")" "(eval-when (expand) (system \"id\"))"
               "(set! car cdr)" "(set-car! (list 1) 2)" "(vector-set! (vector 1) 0 2)"
               "(string-set! (string #\\a) 0 #\\b)" "(hashq-set! 1 2 3)" "(variable-set! 1 2)"
               "(struct-set! 1 2 3)" "(set-object-property! car 'x 1)" "(set-procedure-property! car 'x 1)"
               "(fluid-set! 1 2)" "(array-set! 1 2 3)" "(f64vector-set! (vec 0 0 0) 0 1)"
               "(dynamic-link)" "(dynamic-func \"system\" 1)" "(make-pointer 0)"
               "(pointer->procedure 1 1 1)" "(pointer->bytevector 1 1)" "(bytevector->pointer 1)"
               "(current-output-port)" "(display 1)" "(write 1)" "(read)" "(open-fdes \"/x\" 0)" "(fdopen 0 \"r\")"
               "(socket 2 1 0)" "(connect 1 2)" "(call-with-new-thread (lambda () 1))" "(make-thread 1)"
               "(getenv \"HOME\")" "(setenv \"HOME\" \"/\")" "(getpid)" "(setrlimit 'as #f #f)"
               "(sigaction 2 (lambda (x) 1))" "(setitimer 1 0 0 0 0)"
               "(current-time)" "(gettimeofday)" "(get-internal-real-time)" "(times)" "(random 3)"
               "(sleep 1)" "(gc)" "(make-guardian)" "(object-address 1)"
               "(call-with-prompt 1 2 3)" "(abort-to-prompt 1)" "(default-prompt-tag)"
               "(enter! \"/etc/passwd\")" "(find-world \"/etc/passwd\")" "(follow! \"/etc/passwd\")"
               "(snapshot \"/tmp/stolen\")" "(save! \"/tmp/stolen\")" "(record! \"/tmp/stolen\")"
               "(load-dive \"/tmp/x\")" "(log-lesson! 'x)" "(run-tests \"/tmp\")" "(world-file (world))"
               "(run-lesson 'x)" "(take-lesson 1 2)" "(breathe!)" "(untrusted? #f)" "(define-verb (f) \"x\" 1)"))
  (require (read-inside "(+ 1 2)") => (list))
  (expect (read-inside form) raises)
  (expect (file-exists? "/tmp/stolen") => #f))

(define-scenario (what-eats-memory-is-refused form)
  "One call cannot make a huge thing; many calls end by the limits of the process."
  #:for ((form "(make-list 1000000000 0)" "(iota 1000000000)" "(make-string 1000000000 #\\a)"
               "(make-vector 1000000000 0)" "(expt 7 (expt 10 9))" "(integer-expt 7 (expt 10 9))"
               "(ash 1 1000000000000)" "(string-pad \"\" 1000000000)" "(make-array 0 1000000 1000000)"
               "(let loop ((n 12345)) (loop (* n n)))" "(let loop ((n 3/7)) (loop (* n n)))"
               "(let loop ((s \"abc\")) (loop (string-append s s)))"
               "(let loop ((l '(1 2))) (loop (append l l)))"
               "(string-tabulate (lambda (i) #\\a) 1000000000)" "(xsubstring \"abc\" 0 1000000000)"
               "(make-bitvector 100000000000 #f)" "(make-f64vector 1000000000 0)"))
  (require (read-inside "(+ 1 2)") => (list))
  (expect (read-inside form) raises))

(define-scenario bindings-cannot-be-poisoned
  "What a lesson defines is its own: the language of others stays as it was."
  (read-inside "(define car cdr) (define (run seconds) 'poisoned) (define define-lesson 1)")
  (expect (car '(1 2)) => 1)
  (in open-water)
  (expect (run 1) => 1)
  (expect (length (read-inside "(define-lesson x \"X\" (in open-water) (pilot expert \"x\"))")) => 1))

(define-scenario a-lesson-from-outside-names-worlds
  "It defines worlds or names those of bight; it does not read others from files."
  (let ((found (read-inside "(define-lesson x \"X\" (in \"/etc/passwd\") (task \"t\" (done-when #t)) (pilot expert \"x\"))")))
    (expect (parameterize ((untrusted? #t)) (run-lesson (car found))) raises domain)))
