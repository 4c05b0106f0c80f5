;;; What is advised, in places where a pilot would say it himself, and that asking changes nothing.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight belief cloud) #:select (belief-members in-member)))

(define (wound-about-a-pile)
  (world (sea (depth 15))
         (cylinder (named p1) (from 0 0 1) (to 0 0 -15) (radius 0.45))
         (rov (named minnow) (at 6 -6 -5))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from -6 -8 -3) (to minnow)
                 (via (3 0 -4) (0 3 -4) (-3 0 -5) (0 -3 -5)) (length 45))))

(define-scenario a-free-tether
  "Who is in no trouble goes on, and the dive is as it was."
  (in pile)
  (let* ((hash (state-hash)) (advice (advise)))
    (expect (advice-action advice) => 'go-on)
    (expect (assq-ref (advice-chances advice) 'go-on) => 0.0)
    (expect (state-hash) => hash)))

(define-scenario a-wound-tether
  "Round the pile only a way back helps, along the tether or round by the other side; flown, the latter does."
  (enter! (wound-about-a-pile))
  (let ((advice (advise)))
    (expect (advice-action advice) is (lambda (action) (memq action '(go-back unwind))))
    (expect (assq-ref (advice-chances advice) 'go-on) => 1.0)
    (expect (assq-ref (advice-chances advice) 'unwind) => 0.0))
  (fly-along! (unwind-plan) #:speed 0.35)
  (run-until arrived? #:at-most 200)
  (expect (fouled?) => #f))

(define-scenario advice-of-a-belief
  "With a belief the probabilities are its tethers'; none is better than what is advised by what is worth while."
  (enter! (wound-about-a-pile))
  (believe! (current (error 0.05)) #:members 8)
  (let* ((advice (advise)) (chances (map cdr (advice-chances advice))))
    (for-each (lambda (p) (expect p is (between 0 1))) chances)
    (expect (assq-ref (advice-chances advice) (advice-action advice)) is (below (+ 0.021 (apply min chances)))))
  (current-belief #f))

(define-scenario parted-tethers-are-in-trouble
  "Half of a belief's tethers have parted: whatever is done, half are in trouble, before and after; and a belief of another
dive is not asked."
  (enter! (world (sea (depth 15))
                 (rov (named minnow) (type kinematic) (at 6 -6 -5))
                 (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 8) (from -6 -8 -3) (to minnow) (length 20))))
  (with-belief (make-belief (current-dive) '((current (error 0.05))) #:members 8)
    (for-each (lambda (m) (in-member m (lambda () (cut-tether! 'line #:at 5)))) (list-head (belief-members (current-belief)) 4))
    (let ((advice (advise)))
      (expect (map cdr (advice-chances advice)) => (map (const 0.5) (advice-chances advice)))
      (expect (object->string advice) => "#<advice: Go on.  Trouble: 50 % now, 50 % in 30 s.>"))
    (expect (what-if (map cdr (advice-chances (advise)))) => (map (const 0.0) (iota 6)))))

(define-scenario advice-refused
  "A tether that has parted, and one with no vehicle, are refused, and the dive is as it was."
  (in pile)
  (cut-tether! 'line #:at 5)
  (let ((hash (state-hash)))
    (expect (advise) raises unsupported)
    (expect (state-hash) => hash)))
