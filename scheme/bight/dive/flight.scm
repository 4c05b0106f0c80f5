;;; (bight dive flight) --- what was done to a dive so far, kept after it was done.
;;;
;;; Every dive remembers its oldest moment and the operations since, (bight dive past), so that nothing has to be
;;; recorded beforehand: a test that failed, or a lesson that ended, can be watched from its beginning.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive flight)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive past)
  #:use-module ((bight dive entry) #:select (entry->line))
  #:use-module (bight dive story)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (keep-flight! flown-seconds flight-beginning flight-lines))

(define (past-of proc dive)
  (when (%live? (engine-of dive))
    (bight-raise 'def proc "a live dive does not stand still to be looked back on; say (freeze!) first"))
  (or (dive-past dive)
      (bight-raise 'unsupported proc "this dive remembers nothing of itself")))

(define (flight-beginning proc dive)
  "Return a fork of DIVE as it was at the oldest moment that it remembers.  PROC is who asks, for errors."
  (let ((bytes (past-oldest-bytes (past-of proc dive))) (fork (fork-dive dive)))
    (%restore-dive! (engine-of fork) bytes)
    fork))

(define (flight-lines proc dive)
  "Return what was done to DIVE since `flight-beginning', lines of a recording: (do ...) and, for how it is now,
(end STEP HASH)."
  (let* ((engine (engine-of dive)) (serial (past-oldest-serial (past-of proc dive))))
    (append (map (lambda (entry) (entry->line engine (dive-world dive) entry))
                 (reverse (take-while (lambda (entry) (> (entry-serial entry) serial)) (%journal engine))))
            (list (list 'end (%dive-steps engine) (hex (%hash-dive engine)))))))

(define (flown-seconds)
  "Return how long the flight lasted that `keep-flight!' would keep, s."
  (let ((dive (this-dive 'keep-flight!)))
    (* (%dive-time-step (engine-of dive))
       (- (%dive-steps (engine-of dive)) (past-oldest (past-of 'keep-flight! dive))))))

(define-verb (keep-flight! (file string))
  "Write what was done to the dive so far to FILE, a recording that `replay' and `bight watch' read: from its beginning,
or from as far back as it remembers.  Nothing need have been recorded before.  Return FILE."
  (let* ((dive (this-dive 'keep-flight!)) (lines (flight-lines 'keep-flight! dive)))
    (check-dive 'keep-flight! dive)
    (catching-io 'keep-flight! file
      (let ((teller (make-teller 'keep-flight! file)))
        (tell-beginning! 'keep-flight! teller 'bight-recording (flight-beginning 'keep-flight! dive))
        (for-each (lambda (line) (tell-datum! teller line)) (drop-right lines 1))
        (apply tell-with-checksum! teller (last lines))
        (teller-close! teller)))
    file))
