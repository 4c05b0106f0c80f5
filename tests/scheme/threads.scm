;;; A dive that several threads step: asked for, refused, and never seen in what comes of it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1))

(define-world pair
  "Two vehicles apart, on lines of so many nodes that threads are worth while."
  (sea    (depth 60) (current 0.3 90))
  (rov    (named port) (at 0 10 -10))
  (rov    (named starboard) (at 20 10 -10))
  (tether (named red) (model dynamic) (nodes 250) (from 0 0 0) (to port) (length 20))
  (tether (named green) (model dynamic) (nodes 250) (from 20 0 0) (to starboard) (length 20)))

(define (work name)
  (assq-ref (profile) name))

(define (fly)
  (drive! 'port #:surge 0.3)
  (run 0.5)
  (pay-out! 'green 1)
  (run 0.5)
  (state-hash))

(define-scenario one-thread
  "A dive that does not ask for threads starts none and shares nothing out."
  (in pair)
  (expect (threads) => 1)
  (fly)
  (expect (work 'threads) => 0)
  (expect (work 'shared-steps) => 0))

(define-scenario several-threads
  "With threads all is as without; a fork begins with one, going back leaves them."
  (in pair)
  (let* ((start (checkpoint)) (alone (fly)))
    (restore! start)
    (expect (threads! 3) => 3)
    (expect (work 'threads) => 0)
    (expect (fly) => alone)
    (expect (threads) => 3)
    (expect (work 'threads) => 2)
    (expect (work 'shared-steps) is (above 50))
    (expect (what-if (threads)) => 1)
    (restore! start)
    (expect (what-if (threads! 2) (fly)) => alone)
    (expect (threads! 1) => 1)
    (expect (fly) => alone)
    (expect (work 'threads) => 2)))

(define-scenario numbers
  "How many is a whole number from 1 to 64, and stays while the dive is live."
  (in pair)
  (for-each (lambda (bad) (expect (threads! bad) raises domain)) '(0 65 1.5 -2 four))
  (expect (threads) => 1)
  (threads! 2)
  (live! #:pace 100)
  (expect (threads) => 2)
  (expect (threads! 1) raises def)
  (run 0.5)
  (freeze!)
  (expect (threads) => 2)
  (expect (work 'shared-steps) is (above 20)))

(define-scenario recorded
  "What is recorded with threads is replayed without."
  (in pair)
  (let ((file (scratch-file "threads.rec")))
    (record! file)
    (threads! 2)
    (fly)
    (stop-recording!)
    (expect (replay file) => 'identical)))
