;;; (bight core fork) --- another process like this one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core fork)
  #:export (fork-process
            await-signal-thread!))

(define (fork-process)
  "Fork this process, as `primitive-fork' does, and return 0 in the child and its process here.

Guile stops its thread of finalizers before it forks; a collection between that and the fork starts another, which
may hold the lock of the table of symbols just then, and then the child waits for ever for the first symbol it
makes.  So nothing is collected meanwhile."
  (dynamic-wind gc-disable primitive-fork gc-enable))

(define begun? #f)                      ; here, or in a process that this one was forked from

(define most-looks 1000)                ; 1 ms apart; a thread that has not begun by then is not there

(define (await-signal-thread!)
  "Wait until the thread that takes signals, which the first `sigaction' of a process starts, has begun: be called
after that by whoever will fork.

While the thread begins, it holds the lock of the table of symbols now and then, and a process forked just then waits
for ever for the first symbol it makes.  Once a signal has been heard, the thread has begun.  A process forked by one
that has it gets no thread of its own, and hears nothing."
  (unless begun?
    (let* ((heard? #f)
           (old (sigaction SIGURG (lambda (signal) (set! heard? #t)))))
      (kill (getpid) SIGURG)
      (let look ((left most-looks))
        (unless (or heard? (zero? left))
          (usleep 1000)
          (look (- left 1))))
      (sigaction SIGURG (car old) (cdr old))
      (set! begun? #t))))
