;;; (bight test any-dive) --- random dives, each flown in a process of its own, and the smallest that is not sound.
;;;
;;; A dive is a world and orders, both expressions.  It is flown and judged in a child process that may use
;;; so much processor time and memory: one that crashes or hangs is a finding like any other.  What is found
;;; is made simpler as long as it goes wrong in the same way, and told as a script.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test any-dive)
  #:use-module (bight core clock)
  #:use-module (bight core errors)
  #:use-module (bight core fork)
  #:use-module (bight dive)
  #:use-module (bight dive any-flight)
  #:use-module (bight dive time)
  #:use-module (bight language)
  #:use-module ((bight core told) #:select (exception->line))
  #:use-module (bight test generator)
  #:use-module ((bight test trial) #:select (random-state-of call-with-seed))
  #:use-module (bight watched)
  #:use-module (bight world any-world)
  #:use-module ((ice-9 pretty-print) #:select (pretty-print))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (any-dive
            draw-dive
            evaluated
            fly-in-child
            finding?
            kind-of-finding
            simplest-dive
            dive->script
            unsound-dives))

(define* (any-dive #:key wild?)
  "Return a generator of dives, lists (WORLD ORDER ...) of expressions; WILD? as for `any-world'."
  ;; The orders come first, so that they are the first to be left out: a short flight is soon tried again.
  (made-of (lambda (orders world) (cons world orders))
           (any-flight #:wild? wild?) (any-world #:wild? wild?)))

(define (draw-dive generator seed n)
  "Return the datum of the dive number N that GENERATOR draws with SEED; others do not change it."
  (call-with-seed seed (lambda () (draw generator (random-state-of 'any-dive n)))))


;;; Flying one.

(define most-seconds 60)                ; of processor time
(define most-memory (* 3 1024 1024 1024))

(define names
  ;; The language, and what random worlds and orders speak of besides.
  (let ((module #f))
    (lambda ()
      (unless module
        (set! module (language-module))
        (for-each (lambda (name) (module-use! module (resolve-interface name)))
                  '((bight world scene-files) (bight watched))))
      module)))

(define (evaluated expression)
  "Return the value of EXPRESSION, a random world or order."
  (eval expression (names)))

(define (fly world orders)
  ;; (refused WHY), or (flown SECONDS ORDERS REFUSED WRONG ...), WRONG being sentences.
  (let ((why (with-exception-handler exception->line
               (lambda () (enter! (evaluated world)) #f)
               #:unwind? #t)))
    (if why
        (list 'refused why)
        (let* ((refused (list 0))
               (wrong (parameterize ((refusals refused)) (evaluated `(watched ,@orders)))))
          (cons* 'flown (now) (length orders) (car refused) wrong)))))

(define (limit! resource most)
  (call-with-values (lambda () (getrlimit resource))
    (lambda (soft hard)
      (let ((least (if hard (min hard most) most)))
        (setrlimit resource least least)))))

(define (in-child seconds thunk)
  ;; What THUNK returns, from a child process, or (died SIGNAL).
  (let ((ends (pipe)))
    (force-output (current-output-port))
    (force-output (current-error-port))
    (let ((process (fork-process)))
      (cond ((zero? process)
             (limit! 'cpu seconds)
             (limit! 'as most-memory)
             (catch #t
               (lambda ()
                 (let ((answer (quietly thunk)))
                   (write answer (cdr ends))
                   (force-output (cdr ends))))
               (lambda (key . arguments)
                 (write (list 'broke (simple-format #f "~a ~a" key arguments)) (cdr ends))
                 (force-output (cdr ends))))
             (primitive-_exit 0))
            (else
             (close-port (cdr ends))
             (let ((answer (false-if-exception (read (car ends)))))
               (close-port (car ends))
               (let ((status (cdr (waitpid process))))
                 (if (pair? answer) answer (list 'died (or (status:term-sig status) 0))))))))))

(define (quietly thunk)
  ;; What THUNK returns; what it prints and what it warns of is lost.
  (let ((nowhere (%make-void-port "w")))
    (parameterize ((current-output-port nowhere) (current-warning-port nowhere))
      (thunk))))

(define* (fly-in-child dive #:key (seconds most-seconds))
  "Fly DIVE, (WORLD ORDER ...), in a process that may take so many SECONDS of processor time.  Return (refused
WHY), (flown SECONDS ORDERS REFUSED WRONG ...), or (died SIGNAL)."
  (in-child seconds (lambda () (fly (car dive) (cdr dive)))))

(define (finding? outcome)
  "Return #t if OUTCOME, of `fly-in-child', is that of a dive which is not sound."
  (case (car outcome)
    ((refused) #f)
    ((flown) (pair? (list-tail outcome 4)))
    (else #t)))

(define (words text)
  ;; TEXT without its numbers and what it tells of the time.
  (let ((end (or (string-contains text " (at ") (string-length text))))
    (string-delete (lambda (c) (or (char-numeric? c) (memv c '(#\. #\- #\e #\+ #\space))))
                   (substring text 0 end))))

(define (kind-of-finding outcome)
  "Return a value that is `equal?' for two OUTCOMEs which went wrong in the same way."
  (if (eq? 'flown (car outcome))
      (words (car (list-tail outcome 4)))
      outcome))


;;; Shrinking.

(define most-tries 600)

(define* (simplest-dive generator datum outcome #:key (at-most 120))
  "Return the simplest of the data of GENERATOR, from DATUM on, that go wrong as OUTCOME tells, and its own
outcome; look for AT-MOST seconds."
  (define kind (kind-of-finding outcome))
  (define end (+ at-most (clock)))
  (define limit (if (equal? outcome (list 'died SIGKILL)) 10 most-seconds))
  (define (go-on candidates next datum outcome tries)
    (if (or (null? candidates) (= tries most-tries) (> (clock) end))
        (values datum outcome)
        (let ((found (fly-in-child (expression generator (car candidates)) #:seconds limit)))
          (if (and (finding? found) (equal? kind (kind-of-finding found)))
              (go-on (next (car candidates)) next (car candidates) found (+ tries 1))
              (go-on (cdr candidates) next datum outcome (+ tries 1))))))
  (let ((smaller (lambda (d) (simpler generator d))) (round (lambda (d) (rounder generator d))))
    (call-with-values (lambda () (go-on (smaller datum) smaller datum outcome 0))
      (lambda (datum outcome) (go-on (round datum) round datum outcome 0)))))


;;; Telling.

(define (outcome->string outcome)
  (case (car outcome)
    ((flown) (car (list-tail outcome 4)))
    ((died) (simple-format #f "the process dies by signal ~a" (second outcome)))
    (else (simple-format #f "~a" outcome))))

(define (dive->script dive outcome seed n)
  "Return the text of a script that flies DIVE, which is number N with SEED, and fails as OUTCOME tells."
  (call-with-output-string
   (lambda (port)
     (simple-format port ";;; Dive ~a of the random worlds with seed ~a.  `bight FILE' shows:~%;;; ~a~%~%" n
                    seed (outcome->string outcome))
     (display "(use-modules (bight watched) (bight world scene-files))\n\n" port)
     (pretty-print `(enter! ,(car dive)) port #:width 100)
     (newline port)
     (pretty-print `(define wrong (watched ,@(cdr dive))) port #:width 100)
     (display "\n(for-each (lambda (line) (display line) (newline)) wrong)\n(exit (null? wrong))\n" port))))


;;; Many.

(define (simplest-finding generator seed n datum outcome at-most)
  ;; The number, the outcome and the script of the simplest dive like number N, which is not sound.
  (call-with-values (lambda () (simplest-dive generator datum outcome #:at-most at-most))
    (lambda (datum outcome)
      (list n outcome (dive->script (expression generator datum) outcome seed n)))))

(define* (unsound-dives numbers #:key (seed 1) wild? (at-most 60) (hear (const #f)) (found (const #f)))
  "Fly the dives of NUMBERS with SEED and return a list (NUMBER OUTCOME SCRIPT) for each way in which one was
not sound, the first of its kind made as simple as can be in AT-MOST seconds.  HEAR is called with the number
and the outcome of each dive that was flown or refused, FOUND with each item of the list as it is known."
  (let ((generator (any-dive #:wild? wild?)) (kinds '()))
    (define (new? outcome)
      (and (finding? outcome) (not (member (kind-of-finding outcome) kinds))))
    (define (look n)
      (let* ((datum (draw-dive generator seed n)) (outcome (fly-in-child (expression generator datum))))
        (hear n outcome)
        (and (new? outcome)
             (let ((finding (simplest-finding generator seed n datum outcome at-most)))
               (set! kinds (cons (kind-of-finding outcome) kinds))
               (found finding)
               finding))))
    (filter-map look numbers)))
