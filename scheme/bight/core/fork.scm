;;; (bight core fork) --- another process like this one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core fork)
  #:export (fork-process))

(define (fork-process)
  "Fork this process, as `primitive-fork' does, and return 0 in the child and its process here.

Guile stops its thread of finalizers before it forks; a collection between that and the fork starts another, which
may hold the lock of the table of symbols just then, and then the child waits for ever for the first symbol it
makes.  So nothing is collected meanwhile."
  (dynamic-wind gc-disable primitive-fork gc-enable))
