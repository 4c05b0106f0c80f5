;;; (bight lesson review) --- the last page of a lesson: where marks were lost, and those moments watched.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson review)
  #:use-module (bight cockpit state)
  #:use-module (bight cockpit watch)
  #:use-module (bight dive)
  #:use-module (bight dive reel)
  #:use-module (bight engine)
  #:use-module (bight lesson expert)
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

(define (told-of outcome)
  ;; What is said of how the expert, the ghost, came out, (done), (failed TEXT), (late) or #f.
  (string-append
   "pale: the expert, from where you began this task: "
   (case (and outcome (car outcome))
     ((done) "done")
     ((failed late) "not done either, for it was lost before")
     (else "as far as you let him come"))))

(define (enough?)
  (memv (next-key 0) '(escape #\etx)))

(define (probe-mark? mark) (string-prefix? "question " (mark-label mark)))

(define (expert-at report dive time)
  ;; (REEL . OUTCOME) of the task that was going on in DIVE at TIME as the expert flies it, or #f.
  (let ((set (task-at report dive time)))
    (and set
         (begin
           (draw-still '("The expert flies this task, from where you began it ...") "Esc: no further")
           (expert-flight report set #:limit enough?)))))

(define (seconds-into dive time)
  (- time (%dive-time (engine-of dive))))

(define (watch-moment! report entry)
  ;; Watch the flight of ENTRY, (MARK DIVE TIME), standing still at TIME, beside the expert's.
  (let* ((dive (second entry)) (reel (flight-reel dive)) (begun (reel-dive reel))
         (expert (and (not (probe-mark? (first entry))) (expert-at report dive (third entry)))))
    (when (eq? 'hung-up
               (watch-reel reel (max 0 (seconds-into begun (third entry)))
                           #:ghost (and expert (car expert))
                           #:behind (if expert (- (%dive-steps (engine-of (reel-dive (car expert))))
                                                  (%dive-steps (engine-of begun)))
                                        0)
                           #:ghost-name "expert"
                           #:told (and expert (told-of (cdr expert)))
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
         (trying c (watch-moment! report (car next)))
         (set! next (cdr next))
         #f)
        ((#\q) #t)
        (else (enter-turns key))))
    (unless (null? lost)
      (board! c (second (last lost)))
      (turn-pages (review-lines lost) "w watches where marks were lost   Enter ends" turn))))
