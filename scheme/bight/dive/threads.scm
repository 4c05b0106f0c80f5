;;; (bight dive threads) --- a dive of many tethers, stepped by several threads.
;;;
;;; How many never shows in what comes of it: the engine shares out what has nothing to do with each
;;; other, and no thread ever enters Scheme.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive threads)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:export (threads! threads))

(define most-threads (%most-threads))

(define-argument-type (thread-count value)
  "a whole number of threads from 1 to 64"
  (if (and (exact-integer? value) (<= 1 value most-threads)) value refused))

(define-verb (threads! (n thread-count))
  "Let up to N threads, 1 to 64, step the tethers of the dive; 1 is how every dive begins.  What comes of it is
the same to the last bit.  Worth while with some ten tethers and more that do not touch each other, and with no
more threads than the machine has processors.  They start in the first step that has work for several and
end with the dive; a fork has 1, and a world whose current is a procedure stays with 1.  Raise def
while the dive is live.  Return N."
  (%set-threads! (this-engine 'threads!) n)
  n)

(define-verb (threads)
  "Return how many threads may step the dive, as `threads!' said."
  (%threads (this-engine 'threads)))
