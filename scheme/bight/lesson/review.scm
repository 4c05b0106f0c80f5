;;; (bight lesson review) --- the last page of a lesson: where marks were lost, and those moments watched.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson review)
  #:use-module (bight cockpit state)
  #:use-module (bight cockpit watch)
  #:use-module (bight dive)
  #:use-module (bight dive reel)
  #:use-module (bight engine)
  #:use-module (bight lesson lines)
  #:use-module (bight lesson report)
  #:use-module (bight lesson score)
  #:use-module (bight lesson seat)
  #:use-module (srfi srfi-1)
  #:export (review! review-lines))

(define (review-lines lost)
  "Return the lines of a page that says where marks were lost, LOST as `report-lost' returns it."
  (cons* "Marks were lost here; w watches the moment, and w again the next:" ""
         (append-map (lambda (entry i)
                       (let ((mark (first entry)))
                         (cons (string-append (number->string (+ i 1)) "  " (figure (third entry)) " s  "
                                              (mark-label mark) ": " (mark-detail mark))
                               (if (mark-why mark) (list (string-append "   " (mark-why mark))) '()))))
                     lost (iota (length lost)))))

(define (watch-moment! entry)
  ;; Watch the flight of ENTRY, (MARK DIVE TIME), standing still at TIME.
  (let* ((reel (flight-reel (second entry)))
         (begun (%dive-time (engine-of (reel-dive reel)))))
    (when (eq? 'hung-up (watch-reel reel (max 0 (- (third entry) begun))
                                    #:plain? (cockpit-plain? (this-cockpit))))
      ((leaving)))
    (look-anew! (this-cockpit))))

(define (review! report)
  "Show the pupil where the marks of REPORT were lost, until Enter; w takes him to each moment in turn."
  (let* ((lost (report-lost report)) (next (apply circular-list (if (null? lost) '(#f) lost)))
         (c (this-cockpit)))
    (define (turn key)
      (case key
        ((#\w)
         (trying c (watch-moment! (car next)))
         (set! next (cdr next))
         #f)
        ((#\q) #t)
        (else (enter-turns key))))
    (unless (null? lost)
      (board! c (second (last lost)))
      (turn-pages (review-lines lost) "w watches where marks were lost   Enter ends" turn))))
