;;; (bight cockpit controls) --- the sticks of a cockpit, whoever moves them: keys, and controllers if there are any.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit controls)
  #:use-module (bight cockpit controller)
  #:use-module (bight cockpit keys)
  #:use-module (bight cockpit state)
  #:use-module (srfi srfi-1)
  #:export (stick-positions stick-key! controller-keys!))

(define (stick-key! c key)
  "Let KEY do what it does to the sticks of C, and return #t; #f if it is about something else."
  (define (hold! proc stick . more)
    (set-sticks! c (apply proc (cockpit-sticks c) (car stick) (cdr stick) more))
    #t)
  (cond ((stick-of-key key) => (lambda (stick) (hold! press stick (clock) (cockpit-releases? c))))
        ((nudge-of-key key) => (lambda (step) (hold! nudge step)))
        ((and (pair? key) (eq? 'release (car key)))
         (let ((stick (stick-of-key (second key))))
           (when stick (hold! let-up stick)))
         #t)
        ((eq? 'releases key) (set-releases! c #t) #t)
        ((eq? 'unfocused key) (set-sticks! c (let-all-up (cockpit-sticks c))) #t)
        (else #f)))

(define (stick-positions c)
  "Return where the sticks of C stand: what a key holds goes before what a controller says."
  (let ((keys (stick-values (cockpit-sticks c))))
    (if (current-controllers)
        (map (lambda (key other) (if (zero? key) other key)) keys (controller-sticks (current-controllers)))
        keys)))

(define (controller-keys! c)
  "Take what the controllers did meanwhile, and return the keys that came of it; `lost' is one of them if a controller
was lost: then the sticks are centred."
  (if (current-controllers)
      (append-map (lambda (event) (filter-map (lambda (what) (news->key! c what)) (note-event! (current-controllers) event)))
                  (poll-events! (current-controllers) (clock)))
      '()))

(define long 20)                        ; s that a loss is told

(define (news->key! c news)
  ;; The key that NEWS is, or #f: then it is told.
  (cond ((not (and (pair? news) (memq (car news) '(plugged lost)))) news)
        ((eq? 'plugged (car news))
         (announce! c (string-append "controller: " (second news)))
         #f)
        (else
         (set-sticks! c (new-sticks))
         (announce! c (string-append (second news) " is lost: sticks centred, holding this place") long)
         'lost)))
