;;; (bight core sandbox) --- reading and running a lesson, or a world, from outside without harm.
;;;
;;; Three walls.  The first is the language: the forms are evaluated in a module that has Guile's own pure
;;; bindings, the language of worlds, dives and lessons, and nothing that names files, modules, processes,
;;; the clock or another's syntax, nor anything that changes a value in place; what eats memory in one call
;;; is guarded.  The second is the process: limits on memory, on files, and on processor time, which is
;;; granted anew whenever the lesson has let time pass or waits for the pupil.  The third is the kernel's,
;;; where it has Landlock: no path can be written, no program started, no port bound or reached.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core sandbox)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core files) #:select (limit-reading!))
  #:use-module ((bight core here) #:select (noting-places place-of))
  #:use-module ((bight core landlock) #:select (close-paths!))
  #:use-module ((bight core place) #:select (evaluate-marked))
  #:use-module (bight lesson)
  #:use-module ((bight lesson guide) #:select (untrusted?))
  #:use-module ((bight world atlas) #:select (worlds-path))
  #:use-module (ice-9 sandbox)
  #:use-module ((language tree-il)
                #:select (tree-il-fold toplevel-ref? toplevel-ref-name toplevel-define? toplevel-define-name))
  #:use-module (srfi srfi-1)
  #:export (enclose!
            readable-paths
            breathe!
            ending-text
            sandbox-module
            unbound-inside
            evaluate-inside
            read-lessons-inside))

(define (limit-from variable default)
  ;; The user, who is not the lesson, may choose other limits.
  (let ((n (and=> (getenv variable) text->number)))
    (if (and n (exact-integer? n) (positive? n)) n default)))

(define memory-limit                    ; bytes of address space
  (* 1024 1024 (limit-from "BIGHT_LESSON_MEGABYTES" 1024)))
(define most-seconds 7200)              ; of processor time in all
(define breath                          ; seconds of processor time without letting time pass
  (limit-from "BIGHT_LESSON_SECONDS" 20))


;;; The language inside.

(define (groups-without . names)
  ;; Guile's pure bindings but the groups that hold one of NAMES.
  (remove (lambda (group) (any (lambda (name) (memq name (cdr group))) names))
          all-pure-bindings))

;; datum->syntax could be turned against the syntax of our own macros.
(define guile-bindings
  (groups-without 'datum->syntax 'get-internal-real-time))

(define most-items 100000)
(define most-bits 10000)

(define (too-much name what)
  (bight-raise 'domain name "~a is more than a lesson from outside may make" what))

(define (sized name proc argument-index)
  ;; PROC, whose argument number ARGUMENT-INDEX is the size of what it makes.
  (lambda arguments
    (let ((n (and (> (length arguments) argument-index) (list-ref arguments argument-index))))
      (when (and (real? n) (> n most-items)) (too-much name n))
      (apply proc arguments))))

(define (bits x)
  (cond ((exact-integer? x) (integer-length x))
        ((and (number? x) (exact? x) (rational? x))
         (+ (integer-length (numerator x)) (integer-length (denominator x))))
        (else 0)))

(define (power name proc)
  (lambda (base exponent)
    (when (and (real? exponent) (exact? base) (> (* (bits base) (abs exponent)) most-bits))
      (too-much name "such a power"))
    (proc base exponent)))

(define (shift name proc)
  (lambda (n count)
    (when (> count most-bits) (too-much name "such a shift"))
    (proc n count)))

(define (product . factors)
  ;; Squaring again and again doubles the digits each time.
  (when (> (apply + (map bits factors)) (* 2 most-bits)) (too-much '* "such a product"))
  (apply * factors))

(define (joined name proc)
  ;; PROC makes something as long as its list or string arguments together.
  (lambda arguments
    (let ((n (apply + (map (lambda (a) (cond ((string? a) (string-length a))
                                             ((list? a) (length a))
                                             (else 0)))
                           arguments))))
      (when (> n most-items) (too-much name "such a length"))
      (apply proc arguments))))

(define (format-text to text . arguments)
  ;; `format', to a string alone: a file from outside prints nothing.
  (when to (bight-raise 'domain 'format "in a file from outside it makes a string: #f, not ~s, comes first" to))
  (apply simple-format #f text arguments))

(define guarded
  `((expt . ,(power 'expt expt))
    (format . ,format-text)
    (simple-format . ,format-text)
    (inexact->exact . ,inexact->exact)  ; at most 1074 bits; Guile's own groups leave it out
    (integer-expt . ,(power 'integer-expt integer-expt))
    (ash . ,(shift 'ash ash))
    (round-ash . ,(shift 'round-ash round-ash))
    (* . ,product)
    (iota . ,(sized 'iota iota 0))
    (make-list . ,(sized 'make-list make-list 0))
    (make-string . ,(sized 'make-string make-string 0))
    (make-vector . ,(sized 'make-vector make-vector 0))
    (make-bitvector . ,(sized 'make-bitvector make-bitvector 0))
    (string-pad . ,(sized 'string-pad string-pad 1))
    (string-pad-right . ,(sized 'string-pad-right string-pad-right 1))
    (string-tabulate . ,(sized 'string-tabulate string-tabulate 1))
    (append . ,(joined 'append append))
    (string-append . ,(joined 'string-append string-append))))

;; Made by size through many names, and of no use in a lesson; or patterns that take for ever.
(define left-out
  '(make-array make-typed-array make-shared-array xsubstring string-unfold string-unfold-right
    string-append/shared string-concatenate string-concatenate/shared symbol-append make-regexp
    regexp-exec string->number rationalize exact-integer-sqrt with-throw-handler make-hash-table
    make-doubly-weak-hash-table make-weak-key-hash-table make-weak-value-hash-table modulo-expt
    integer-length procedure-documentation procedure-name
    make-f32vector make-f64vector make-s16vector make-s32vector make-s64vector make-s8vector
    make-u16vector make-u32vector make-u64vector make-u8vector abort-to-prompt abort-to-prompt*
    call-with-prompt make-prompt-tag start-stack
    version major-version minor-version micro-version effective-version))

(define (plain-name entry) (if (pair? entry) (cdr entry) entry))

(define (with-guards bindings)
  (filter-map
   (lambda (group)
     (let ((names (remove (lambda (entry)
                            (or (assq (plain-name entry) guarded) (memq (plain-name entry) left-out)))
                          (cdr group))))
       (and (pair? names) (cons (car group) names))))
   bindings))

;; Whole modules of the language, but for the names after each.
(define language
  '(((bight core units))
    ((bight world) world-file find-world worlds world->parts)
    ((bight world types))
    ((bight dive) call-with-dive current-dive fork-dive engine-of this-engine this-dive dive-world
     enter! running-dive check-not-running dive-tasks set-dive-tasks! dive-watchers
     set-dive-watchers! type:dive)
    ((bight dive command) follow!)
    ((bight dive query) find-part tether-properties obstacle-properties)
    ((bight dive contact))
    ((bight world build))
    ((bight dive time))
    ((bight lesson) run-lesson lesson-list lesson-code lesson-location collect-lessons take-lesson
     scripted-guide pilot-named register-lesson! unknown-clause malformed-clause malformed-lesson)
    ((bight dive aware) unwind-said members-of)
    ((bight dive figures) held-vehicle refuse-parted)
    ((bight dive homing) untold-fork)
    ((bight dive tour))
    ((bight dive tour-flight))
    ((bight belief tour))
    ((bight dive instruments))
    ((bight dive foresight))
    ((bight dive in-words))
    ((bight dive probe))))

(define single-names
  '(((bight dive task) every on cancel!)
    ((bight dive pilot) define-pilot make-pilot with-pilot)
    ((bight dive checkpoint) checkpoint restore! what-if state-hash)
    ((bight test expect) about between above below)
    ((bight view) look)
    ((bight view status) status)))

(define (public-names module)
  (module-map (lambda (name variable) name) (resolve-interface module)))

(define (language-bindings)
  (append single-names
          (map (lambda (entry)
                 (cons (car entry) (lset-difference eq? (public-names (car entry)) (cdr entry))))
               language)))

(define (sandbox-module)
  "Return a new module in which a lesson from outside can be evaluated."
  (let* ((ours (language-bindings))
         (our-names (append-map cdr ours))
         (guile (map (lambda (group)
                       (cons (car group)
                             (remove (lambda (entry) (memq (plain-name entry) our-names)) (cdr group))))
                     (with-guards guile-bindings)))
         (module (make-sandbox-module (append guile ours))))
    (for-each (lambda (entry) (module-define! module (car entry) (cdr entry))) guarded)
    module))


;;; Reading.

(define (line-of form)
  (+ 1 (or (assq-ref (or (syntax-source form) '()) 'line) 0)))

(define (cure exception)
  ;; What to do about a name that is not there, if it is there for others.
  (if (eq? 'unbound-variable (exception-kind exception))
      "; what comes from outside has only the language, unless it is trusted: --trust, or #:trust #t"
      ""))

(define (refused-at file line exception)
  ;; Raise what EXCEPTION says, after its place; the reader tells that itself.
  (let ((text ((module-ref (resolve-interface '(bight core told)) 'exception->line) exception))
        (place (place-of exception)))
    (raise-engine-error (if (bight-error? exception) (bight-error-kind exception) 'def) #f
                        (string-append (if (string-prefix? (string-append file ":") text)
                                           ""
                                           (string-append file ":"
                                                          (number->string (if place (cdr place) line))
                                                          ": "))
                                       text
                                       (cure exception)))))

(define (forms-in port)
  (let ((form (read-syntax port)))
    (if (eof-object? form) '() (cons form (forms-in port)))))

(define (unbound-inside file)
  "Return the names, symbols, that FILE uses, in whatever branch, and neither FILE nor the language inside defines."
  (let ((module (sandbox-module)) (used '()) (defined '()))
    (define (note! x)
      (cond ((toplevel-ref? x) (set! used (cons (toplevel-ref-name x) used)))
            ((toplevel-define? x) (set! defined (cons (toplevel-define-name x) defined)))))
    (save-module-excursion
     (lambda ()
       (set-current-module module)
       (for-each (lambda (form)
                   (tree-il-fold (lambda (x seed) (note! x)) (lambda (x seed) seed) #f
                                 (macroexpand form 'c '(compile load eval))))
                 (call-with-input-file file forms-in))))
    (remove (lambda (name) (or (memq name defined) (module-variable module name)))
            (delete-duplicates used eq?))))

(define* (evaluate-inside port file module #:optional (between breathe!))
  "Evaluate the forms in PORT, from FILE, in MODULE, one from `sandbox-module'; call BETWEEN before each.
Raise a &bight-error that begins with FILE and the line for whatever goes wrong."
  (define (at line thunk)
    (with-exception-handler (lambda (e) (refused-at file line e))
      (lambda () (noting-places thunk))
      #:unwind? #t))
  (let loop ((line 1))
    (let ((form (at line (lambda () (read-syntax port)))))
      (unless (eof-object? form)
        (between)
        (at (line-of form)
            (lambda ()
              (save-module-excursion
               (lambda ()
                 (set-current-module module)
                 (evaluate-marked form file)))))
        (loop (line-of form))))))

(define (read-lessons-inside file)
  "Return the lessons that FILE, which is not trusted, defines.  Raise a &bight-error for whatever goes
wrong in it."
  (untrusted? #t)
  (collect-lessons
   (lambda ()
     (call-with-input-file file
       (lambda (port)
         (set-port-filename! port file)
         (evaluate-inside port file (sandbox-module)))))))


;;; The process.

(define enclosed? #f)

(define* (breathe! #:optional (busy? #t))
  "Grant this process, if it is enclosed, processor time anew.  BUSY? is #f while it waits for the pupil."
  ;; The collector has SIGXCPU for itself, so a timer ends the process, by SIGPROF.
  (when enclosed?
    (setitimer ITIMER_PROF 0 0 breath 0)
    ;; A collector that finds no memory may wait for ever, and then takes no processor time.  A machine
    ;; with much else to do is slow, and no reason to end anything.
    (setitimer ITIMER_REAL 0 0 (if busy? (+ 240 (* 10 breath)) 0) 0)))

(define heap-share 0.6)                 ; of the memory: what the lesson's own data may take

(define (watch-heap!)
  ;; End by a signal before the collector meets the limit: there it may break down in its own ways.
  (add-hook! after-gc-hook
             (lambda ()
               (when (> (assq-ref (gc-stats) 'heap-size) (* heap-share memory-limit))
                 (sigaction SIGABRT SIG_DFL)
                 (kill (getpid) SIGABRT)))))

(define (limit! resource value)
  (false-if-exception (setrlimit resource value value)))

(define page 4096)

(define (mapped)
  ;; The address space that this process has taken, bytes.
  (* page (or (false-if-exception (call-with-input-file "/proc/self/statm" read)) 0)))

(define (readable-paths file)
  "Return the folders and files that a process may read in which FILE, from outside, is read: those beside it,
the worlds and lessons that may be named, and what the language itself may still have to load."
  (filter file-exists?
          (map (lambda (path) (if (absolute-file-name? path) path (string-append (getcwd) "/" path)))
               (cons (dirname file)
                     (append (worlds-path) %load-path %load-compiled-path
                             '("/usr/lib" "/lib" "/proc/self" "/dev/null"))))))

(define* (enclose! #:key reading)
  "Take from this process, for good, what a lesson from outside has no use for: writing to any path,
starting programs, more than so much memory or processor time; reading, too, if READING is a list of the
folders and files that still may be read.  Return `kernel' if the kernel watches the paths, else `limits'."
  (when reading
    (limit-reading! reading))
  (chdir "/")                           ; no folder of worlds lies here
  (limit! 'fsize (* 16 1024 1024))      ; standard output may be a file
  (limit! 'core 0)
  (when (< (mapped) memory-limit)       ; a sanitizer takes terabytes, and uses few
    (limit! 'as memory-limit))
  (limit! 'cpu most-seconds)
  (set! enclosed? #t)
  (watch-heap!)
  (breathe!)
  (if (close-paths! #:reading reading) 'kernel 'limits))

(define (ending-text signal)
  "Return why an enclosed process was ended by SIGNAL, in a few words."
  (cond ((eqv? signal SIGPROF)
         (simple-format #f "it took more than ~a s of processor time at one stretch" breath))
        ((memv signal (list SIGABRT SIGSEGV SIGBUS SIGALRM))
         (simple-format #f "it broke down or hung, as one that wants more than ~a megabytes of memory does"
                        (quotient memory-limit (* 1024 1024))))
        ((eqv? signal SIGINT) "it was interrupted")
        (else (simple-format #f "it was ended by signal ~a" signal))))
