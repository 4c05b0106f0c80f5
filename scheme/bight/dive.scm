;;; (bight dive) --- dives: starting one, and which one is meant.
;;;
;;; A dive is the engine's state of a world, the world it came from, and what is to run between its
;;; steps.  One is current; every verb is about that one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive)
  #:use-module (bight core errors)
  #:use-module ((bight core files) #:select (engine-parts))
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module ((bight dive past) #:select (new-past))
  #:use-module (bight engine)
  #:use-module (bight world)
  #:use-module ((bight world atlas) #:select (world-called))
  #:use-module (bight world bed)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (enter!
            with-dive
            call-with-dive
            dive?
            current-dive
            fork-dive
            engine-of
            this-engine
            this-dive
            served?
            session-dive
            house-dive set-house-dive!
            guest-dive
            dive-world
            dive-fork?
            running-dive
            check-not-running
            dive-tasks set-dive-tasks!
            dive-watchers set-dive-watchers!
            dive-past set-dive-past!
            dive-recorder set-dive-recorder!
            begin-dive
            type:dive))

(define-record <dive>
  (make-dive engine world fork? tasks watchers past recorder)
  %dive-record?
  (engine engine-of)
  (world dive-world)
  (fork? dive-fork?)                    ; true if it is a copy that goes its own way
  (tasks dive-tasks set-dive-tasks!)
  (watchers dive-watchers set-dive-watchers!)
  (past dive-past set-dive-past!)       ; (bight dive past), or #f: nothing is remembered
  (recorder dive-recorder set-dive-recorder!)) ; (bight dive recording), or #f

(define-verb (dive? (object any))
  "Return #t if OBJECT is a dive."
  (%dive-record? object))

(define-argument-type (dive value)
  "a dive, as (enter! WORLD) returns"
  (if (%dive-record? value) value refused))

(define type:maybe-dive (type:or-false dive))

(define (print-dive dive port)
  (let ((engine (engine-of dive)))
    (format port "#<dive ~a at ~a s: ~a~a>"
            (or (world-name (dive-world dive)) "in an unnamed world")
            (/ (round (* 1000 (%dive-time engine))) 1000)
            (if (null? (%names engine 'rov)) "no vehicle" (words->string (%names engine 'rov)))
            (if (null? (%names engine 'tether))
                ""
                (string-append " on " (words->string (%names engine 'tether)))))))

(set-record-type-printer! <dive> print-dive)

(define current-dive
  ;; The dive that verbs are about, or #f.
  (make-parameter #f (lambda (value)
                       (check-argument 'current-dive 'dive type:maybe-dive value))))

(set-object-property! current-dive 'documentation
                      "Return the dive that all verbs are about, or #f.  A parameter.")

;;; Threads beside the house's: they have no current dive, unless they begin one.

(define served?
  ;; True in a session of (bight shell listen).
  (make-parameter #f))

(define session-dive
  ;; A procedure of a verb's name that returns the dive of such a session, or #f.
  (make-parameter (lambda (proc) #f)))

(define the-house-dive #f)

(define (house-dive)
  "Return the dive that last went live outside of sessions, or #f."
  the-house-dive)

(define (set-house-dive! dive)
  "Let DIVE be the one that sessions are about."
  (unless (served?)
    (set! the-house-dive dive)))

(define (this-dive proc)
  "Return the current dive, or raise a &bight-error from PROC when there is none."
  (or (current-dive)
      ((session-dive) proc)
      (bight-raise 'def proc "there is no dive yet; start one, as in (enter! 'open-water)")))

(define (this-engine proc)
  "Return the engine's handle of the current dive, or raise a &bight-error from PROC."
  (engine-of (this-dive proc)))

(define (subject-names proc kind)
  (%names (this-engine proc) (if (eq? kind 'vehicle) 'rov kind)))

(current-subject-lister subject-names)

(define running-dive
  ;; The dive that is being stepped, so that what runs between its steps cannot step or leave it too.
  (make-parameter #f))

(define (check-not-running proc dive)
  "Raise a &bight-error from PROC if DIVE is being stepped now, as it is for what runs between steps."
  (when (and dive (eq? dive (running-dive)))
    (bight-raise 'def proc "what runs between the steps of a dive cannot do this to it")))

(define-argument-type (world-or-name value)
  "a world, the name of one as in 'open-water, or a file"
  (if (or (world? value) (symbol? value) (string? value)) value refused))

(define-verb (enter! (world world-or-name) #:key (trust flag #f))
  "Start a dive in WORLD: a world, a symbol naming one in worlds/, or a file name.  The dive becomes the
current one and is returned.  A file that lies in no folder of worlds is enclosed: it has the language of
worlds and cannot touch anything; with TRUST it may do all that you may.  A warning tells of a bed that the
dive is beside of."
  (check-not-running 'enter! (current-dive))
  (let* ((world (world-called 'enter! world trust))
         (dive (begin-dive (%make-dive (engine-parts 'enter! world)) world)))
    (current-dive dive)
    (and=> (beside-bed (engine-of dive))
           (lambda (text) (simple-format (current-warning-port) "bight: enter!: ~a~%" text)))
    dive))

(define (begin-dive engine world)
  "Return a dive in WORLD, of which ENGINE is the handle."
  (make-dive engine world #f '() '() (new-past engine '()) #f))

(define (guest-dive dive)
  "Return a dive that is the live DIVE for another thread.  It remembers nothing of itself."
  (make-dive (%share-live (engine-of dive)) (dive-world dive) #f '() '() #f #f))

(define (call-with-dive dive thunk)
  "Call THUNK with DIVE as the current dive, and return what it returns."
  (parameterize ((current-dive (check-argument 'with-dive 'dive type:dive dive)))
    (thunk)))

(define-syntax-rule (with-dive dive body body* ...)
  "Evaluate the body with DIVE as the current dive."
  (call-with-dive dive (lambda () body body* ...)))

(define (fork-dive dive)
  "Return a copy of DIVE that goes its own way, with copies of what runs between its steps."
  (make-dive (%fork-dive (engine-of dive))
             (dive-world dive)
             #t
             (dive-tasks dive)
             '()
             (dive-past dive)
             #f))
