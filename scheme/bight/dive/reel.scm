;;; (bight dive reel) --- a recording that can be brought to any place of it, back and forth.
;;;
;;; A place is a number of steps that were taken since the recording began, which goes on where the dive itself
;;; was taken back.  The recording is done again as far as it is looked at; every few seconds its state is kept,
;;; and going back begins at the last of these.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive reel)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module ((bight dive flight) #:select (flight-beginning flight-lines))
  #:use-module ((bight dive entry) #:select (redo-line!))
  #:use-module ((bight dive replay) #:select (after-beginning))
  #:use-module (bight dive story)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (open-reel flight-reel reel? reel-dive reel-place reel-length reel-cut? wind! next-event-place event-before))

(define kept-every 300)                 ; steps
(define most-at-once 1000000)           ; steps between two lines of a recording, as `replay' has it

(define-record <reel>
  (make-reel dive length cut? place left kept)
  reel?
  (dive reel-dive)
  (length reel-length)                  ; steps
  (cut? reel-cut?)                      ; does something follow that is not vouched for?
  (place reel-place set-place!)
  (left reel-left set-left!)            ; what is still to be done: (PLACE . LINE), in order
  (kept reel-kept set-kept!))           ; (PLACE BYTES CARRIED LEFT), the last first

(define (plan file lines begun)
  ;; Two values: what is done at which place, ((PLACE . LINE) ...), and how long it all is.  BEGUN is the step of the
  ;; dive that it begins at.
  (let loop ((lines lines) (step begun) (place 0) (all '()))
    (if (null? lines)
        (values (reverse all) place)
        (let ((line (car lines)))
          (case (car line)
            ((do second end)
             (let ((n (cadr line)))
               (unless (and (exact-integer? n) (<= step n (+ step most-at-once)))
                 (bight-raise 'format 'watch "a line of ~s is at step ~s, after step ~a" file n step))
               (let ((place (+ place (- n step))))
                 (loop (cdr lines) n place
                       (if (eq? 'do (car line)) (acons place line all) all)))))
            ((state) (loop (cdr lines) (cadr line) place (acons place line all)))
            (else (loop (cdr lines) step place all)))))))

(define (reel-of dive file lines cut?)
  ;; A reel at its beginning, where it is in the state of DIVE.
  (call-with-values (lambda () (plan file lines (%dive-steps (engine-of dive))))
    (lambda (left length)
      (let ((reel (make-reel dive length cut? 0 left '())))
        (keep! reel)
        reel))))

(define (open-reel file)
  "Return the recording in FILE as a reel, at its beginning."
  (let* ((story (read-story 'watch file 'bight-recording #:salvage? #t))
         (dive (begin-story 'watch file story)))
    (reel-of dive file (after-beginning story) (story-cut? story))))

(define (flight-reel dive)
  "Return what was done to DIVE so far as a reel, at its beginning."
  (reel-of (flight-beginning 'watch dive) "this flight" (flight-lines 'watch dive) #f))

(define (keep! reel)
  (let ((engine (engine-of (reel-dive reel))))
    (set-kept! reel (cons (list (reel-place reel) (%keep-dive engine) (%carried engine) (reel-left reel))
                          (reel-kept reel)))))

(define (go-back! reel place)
  ;; To what was kept last at PLACE or before.
  (let* ((kept (find-tail (lambda (k) (<= (first k) place)) (reel-kept reel)))
         (k (car kept)) (engine (engine-of (reel-dive reel))))
    (%restore-dive! engine (second k))
    (%carry! engine (third k))
    (set-left! reel (fourth k))
    (set-place! reel (first k))))

(define (do-what-is-due! reel)
  (let loop ()
    (let ((left (reel-left reel)) (dive (reel-dive reel)))
      (when (and (pair? left) (<= (caar left) (reel-place reel)))
        (set-left! reel (cdr left))
        (let ((line (cdar left)))
          (if (eq? 'do (car line))
              (redo-line! (engine-of dive) (dive-world dive) line)
              (restore-line! 'watch (engine-of dive) line)))
        (loop)))))

(define (step-on! reel)
  (do-what-is-due! reel)
  (%step-dive! (engine-of (reel-dive reel)) 1)
  (set-place! reel (+ 1 (reel-place reel)))
  (when (and (zero? (remainder (reel-place reel) kept-every))
             (> (reel-place reel) (first (car (reel-kept reel)))))
    (keep! reel)))

(define (wind! reel place)
  "Bring REEL to PLACE, or to the end that is nearer.  Return where it is."
  (let ((place (max 0 (min (reel-length reel) place))))
    (when (< place (reel-place reel))
      (go-back! reel place))
    (let loop ()
      (when (< (reel-place reel) place)
        (step-on! reel)
        (loop)))
    (do-what-is-due! reel)
    place))

(define (events-of reel)
  (%events (engine-of (reel-dive reel)) 0))

(define (next-event-place reel)
  "Bring REEL to the next place at which an event was noted, such as a touch, or to its end.  Return it."
  (let ((engine (engine-of (reel-dive reel))))
    (let loop ((before (%event-count engine)))
      (cond ((= (reel-place reel) (reel-length reel)) (reel-place reel))
            (else
             (step-on! reel)
             (let ((now (%event-count engine)))
               (if (> now before) (reel-place reel) (loop now))))))))

(define (event-before reel)
  "Bring REEL back to the last event before where it is, or to its beginning.  Return the place."
  (let* ((engine (engine-of (reel-dive reel))) (dt (%dive-time-step engine)) (now (%dive-time engine))
         (times (filter (lambda (t) (< t (- now (* 1.5 dt)))) (map cadr (events-of reel)))))
    (wind! reel (if (null? times)
                    0
                    (- (reel-place reel)
                       (inexact->exact (round (/ (- now (apply max times)) dt))))))))
