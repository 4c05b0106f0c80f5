;;; (bight follow alarm) --- what whoever follows a dive should hear of: what happened, what will, what to do.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight follow alarm)
  #:use-module (bight cockpit coach)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive foresight)
  #:use-module (bight dive plain-words)
  #:use-module (bight engine)
  #:use-module (bight shell progress)
  #:use-module (srfi srfi-1)
  #:export (make-alarm alarm? alarms! fresh-events!))

(define horizon 20)                     ; s that are looked ahead

(define-record <alarm>
  (%make-alarm tether coach seen events told under-way?)
  alarm?
  (tether alarm-tether)                 ; a name, or #f
  (coach alarm-coach)
  (seen alarm-seen set-alarm-seen!)     ; how many events were told
  (events alarm-events set-alarm-events!) ; that were told lately, the last first
  (told alarm-told set-alarm-told!)     ; what was foreseen when it looked last: pairs of kind and object
  (under-way? alarm-under-way?))        ; a thunk: does the real vehicle push

(define (make-alarm tether under-way?)
  "Return what watches the current dive, and TETHER in it, a name or #f.  UNDER-WAY?, a thunk, says whether the real
vehicle is on its way, whose sticks nobody sees."
  (%make-alarm tether (make-coach) 0 '() '() under-way?))

(define lately 10)                      ; s within which the same is not told again

(define (same-event? a b)
  (and (eq? (first a) (first b)) (equal? (cddr a) (cddr b)) (< (- (second a) (second b)) lately)))

(define (worth-telling? a event)
  (not (or (memq (first event) '(arrived spooled))
           (any (lambda (before) (same-event? event before)) (alarm-events a)))))

(define (fresh-events! a events)
  "Return those of EVENTS that A should tell of, and remember them: the same not again within ten seconds."
  (filter (lambda (event)
            (and (worth-telling? a event)
                 (begin
                   (set-alarm-events! a (cons event (remove (lambda (before)
                                                              (>= (- (second event) (second before)) lately))
                                                            (alarm-events a))))
                   #t)))
          events))

(define (events-told! a)
  ;; What happened since, lines.
  (let* ((engine (this-engine 'follow)) (events (%events engine (alarm-seen a))))
    (set-alarm-seen! a (%event-count engine))
    (string-tokenize (call-with-output-string (lambda (port) (tell-events port (fresh-events! a events))))
                     (char-set-complement (char-set #\newline)))))

(define (sign f) (cons (foresight-kind f) (foresight-object f)))

(define (warning f)
  (string-append "AHEAD: "
                 (foresight-said (foresight-kind f) (foresight-object f) (foresight-seconds f) (foresight-turns f)
                                 (= 1 (foresight-confidence f)))))

(define (foreseen! a)
  ;; What was not foreseen a second ago, lines.
  (let* ((all (if (alarm-tether a)
                  (with-exception-handler
                      (lambda (e) (if (bight-error? e) '() (raise-exception e)))
                    (lambda () (foresee (alarm-tether a) horizon #:quick #t))
                    #:unwind? #t)
                  '()))
         (new (remove (lambda (f) (member (sign f) (alarm-told a))) all)))
    (set-alarm-told! a (map sign all))
    (map warning new)))

(define (advice! a)
  (let ((words (parameterize ((pushed-unseen? (alarm-under-way? a)))
                 (coach-looks! (alarm-coach a)))))
    (if words (list (string-append "COACH: " words)) '())))

(define (alarms! a)
  "Return what is to be said now, as it should be asked once a second of the dive: strings, none twice running."
  (append (events-told! a) (foreseen! a) (advice! a)))
