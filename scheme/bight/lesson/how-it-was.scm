;;; (bight lesson how-it-was) --- how a probe was, shown after it was answered, when no other is asked about the same dive.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson how-it-was)
  #:use-module (bight cockpit state)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive plain-words)
  #:use-module (bight dive query)
  #:use-module (bight lesson input)
  #:use-module (bight lesson seat)
  #:use-module (srfi srfi-1)
  #:export (note-how-it-was! show-how-it-was! read-what-was-said! same-dive? how-verdict set-verdict! is-how-it-was?))

(define (bearing-point from degrees metres)
  (let ((a (* degrees (/ (acos -1) 180))))
    (vec (+ (x from) (* metres (sin a))) (+ (y from) (* metres (cos a))) (z from))))

(define-record <how-it-was>
  (make-how-it-was dive hash verdict bearings)
  is-how-it-was?
  (dive how-dive)                       ; a fork
  (hash how-hash)
  (verdict how-verdict set-verdict!)    ; a list of texts, the last first
  (bearings how-bearings))              ; (SAID . TRUE), degrees, or #f

(define (note-how-it-was! truth answer degrees?)
  ;; Unless there was an input after this answer, before which that was shown.
  (unless (replaying?)
    (let ((before (seat-pending (the-seat))))
      (set-pending! (the-seat)
                    (make-how-it-was (fork-dive (current-dive)) (state-hash)
                                     (if before (how-verdict before) '())
                                     (cond (degrees? (cons answer truth))
                                           (before (how-bearings before))
                                           (else #f)))))))

(define (same-dive? how)
  (and (current-dive) (= (how-hash how) (state-hash))))

(define (bearing-labels bearings)
  (let* ((here (rov-position (cockpit-vehicle (this-cockpit))))
         (far (max 4 (* 0.4 (distance here (point-at (cockpit-tether (this-cockpit)) 0))))))
    (list (target "said" (bearing-point here (car bearings) far))
          (target "was" (bearing-point here (cdr bearings) far)))))

(define (show-how-it-was!)
  (let ((how (seat-pending (the-seat))))
    (when how
      (set-pending! (the-seat) #f)
      (unless (replaying?)
        (board! (this-cockpit) (how-dive how))
        (parameterize ((current-dive (how-dive how)))
          (with-look (if (from-above-alone?) 'top 'overview)
                     (append (labels-now) (if (how-bearings how) (bearing-labels (how-bearings how)) '()))
                     (lambda ()
                       (show-page! (append (reverse (how-verdict how)) '("So it was."))
                                   "Enter goes on   q leaves   v other views"))
                     #:map? (not (hard?))))))))


(define (read-what-was-said!)
  "Show what was said on a page until it is read."
  (show-how-it-was!)
  (let ((texts (seat-texts (the-seat))))
    (set-texts! (the-seat) '())
    (when (pair? texts)
      (keep-up!)
      (with-look 'pilot '()
                 (lambda () (show-page! (in-order texts) "Enter goes on   q leaves, to go on later"))))))
