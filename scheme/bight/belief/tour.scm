;;; (bight belief tour) --- tours that are planned, and hold for the tethers of a belief where a limit of risk is given.
;;;
;;; The plan of (bight dive tour) sees a tether drawn tight.  Given a limit, the plan is flown on a fork of each tether of
;;; the current belief, its winch and vehicle going by what that tether does.  At each place, and at home, the share of
;;; the tethers that are fouled, or do not come there, must be within the limit.  Where the shortest tour is not, others
;;; are flown, those with a stretch of it turned round, the shorter first; where none of them is, the place at which the
;;; shortest goes wrong is left out, and said.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief tour)
  #:use-module (bight belief)
  #:use-module ((bight belief answer) #:select (share-interval))
  #:use-module (bight belief cloud)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive plain-words) #:select (percent-said))
  #:use-module (bight dive tour)
  #:use-module ((bight dive tour-flight) #:select (tour-troubles))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (plan-tour))

(define most-flown 6)                   ; tours of the same places, before one of them is left out

(define (troubles-of member tour speed enough?)
  ;; Where TOUR goes wrong, flown on the tether of MEMBER: a list; everywhere, if its dive fails.  See `tour-troubles'.
  (unless-refused (lambda () (in-member member (lambda () (tour-troubles tour speed enough?))))
                  (lambda () (make-list (+ 1 (length (tour-places tour))) #t))))

(define (chances tethers tour limit speed)
  ;; Of TETHERS, (MEMBER . SHARE), the share for which TOUR goes wrong at each place, and at home; once one is beyond LIMIT
  ;; no more are flown.  Return it with TETHERS in the order in which another tour had best be flown on them: what one
  ;; catches on, another may.
  (let loop ((rest tethers) (sums (make-list (+ 1 (length (tour-places tour))) 0.0)) (wrong '()) (right '()))
    (if (or (null? rest) (beyond? sums limit))
        (cons sums (append wrong rest right))
        (let* ((share (cdar rest))
               (troubles (troubles-of (caar rest) tour speed
                                      (lambda (k) (beyond? (list (+ share (list-ref sums k))) limit))))
               (more (map (lambda (sum wrong?) (if wrong? (+ sum share) sum)) sums troubles)))
          (if (any identity troubles)
              (loop (cdr rest) more (cons (car rest) wrong) right)
              (loop (cdr rest) more wrong (cons (car rest) right)))))))

(define (beyond? sums limit) (> (apply max sums) (+ limit 1e-9)))

(define (at-risk tour sums belief)
  (let ((p (min 1.0 (apply max sums))))
    (tour-at-risk tour (cons p (share-interval p (effective-number (weights belief)))))))

(define (worst-place tour sums)
  ;; The number of the place of TOUR where most goes wrong; the last, if that is at home.
  (min (list-index (lambda (sum) (= sum (apply max sums))) sums) (- (length (tour-places tour)) 1)))

(define (chooser belief limit speed)
  ;; See `tour-found'.
  (let ((tethers (map cons (living belief) (f64vector->list (weights belief)))))
    (define (fly! tour limit)
      (let ((flown (chances tethers tour limit speed)))
        (set! tethers (cdr flown))
        (car flown)))
    (define (kept tour)
      (let ((sums (fly! tour limit)))
        (and (not (beyond? sums limit)) (at-risk tour sums belief))))
    (lambda (others shortest)
      (let ((sums (fly! shortest limit)))
        (cond ((not (beyond? sums limit)) (at-risk shortest sums belief))
              ((null? (tour-places shortest)) ; the way home alone
               (at-risk shortest (fly! shortest 1) belief))
              ((any kept (at-most (- most-flown 1)
                                  (remove (lambda (tour) (same-order? tour shortest)) (others)))))
              (else
               (cons (worst-place shortest sums)
                     (simple-format #f "with it P(fouled) is above ~a" (percent-said limit)))))))))

(define (same-order? a b) (equal? (tour-places a) (tour-places b)))

(define (at-most n items) (list-head items (min n (length items))))

(define-verb (plan-tour #:subject (t tether) (places places)
                        #:key (stay positive 1.0) (line (or-false positive) #f) (risk (or-false (between 0 1)) #f)
                        (speed positive 0.35))
  "Return the tour on which the vehicle visits PLACES and comes home to the anchor with its tether wound about
nothing: the shortest that is found, its legs wide enough for the hull, its tether never longer than LINE m (left
out: what is on the drum, or what is out where the drum has no end).  A place is a point; or the name of an obstacle,
seen from STAY m off its surface; or that of a structure, whose members are all seen.  With RISK, a probability, it is
the shortest that keeps within that risk: it is flown at SPEED m/s on every tether of the current belief, and at no
place, and not at home, are more of them fouled, or not there.  What cannot be reached is left out, and said.  The
prompt says the tour in words; `tour-trial' flies it on a fork, `fly-tour!' flies it."
  (if risk
      (tour-found t places stay line (chooser (ready-belief 'plan-tour #f) risk speed))
      (tour-found t places stay line)))
