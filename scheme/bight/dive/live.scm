;;; (bight dive live) --- dives that run by themselves.
;;;
;;; A thread that never enters Scheme steps the dive in real time; what one does to it goes through its
;;; queue, what one asks is answered from the latest copy it has published.  So an endless loop at the
;;; prompt does not stop the dive.  What `every', `on' and pilots do runs in Scheme, and therefore only
;;; while Scheme lets time pass, as in (run 5).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive live)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:export (live! freeze! live?))

(define-argument-type (pace value)
  "seconds of the dive in a second, from 0.01 to 1000"
  (if (and (real? value) (<= 1/100 value 1000)) (exact->inexact value) refused))

(define-verb (live! #:key (pace pace 1.0))
  "Let the dive run by itself, in real time or PACE seconds in a second, until `freeze!'.  All verbs work as
ever; (run S) waits, and while it does, no longer, `every', `on' and pilots run.  Raise unsupported when the current is a procedure.  Return the dive."
  (let ((dive (this-dive 'live!)))
    (check-not-running 'live! dive)
    (go-live! dive pace)
    dive))

(define-verb (freeze!)
  "Stop the dive that `live!' lets run, between two steps.  Raise what stopped it before, if anything did.
Return the time."
  (let ((dive (this-dive 'freeze!)))
    (check-not-running 'freeze! dive)
    (freeze-dive! dive)
    (now)))

(define-verb (live?)
  "Return #t while the dive runs by itself."
  (%live? (this-engine 'live?)))
