;;; A tether in the crotch of a brace and its leg, as a pilot meets it: drawn in it is borne by both, and it
;;; comes out the way it went in.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define (leg-and-brace mu)
  ;; The brace leaves the leg upward, 4 m off 20 m higher; the line runs through between them.
  (world (sea (depth 40))
         (cylinder (named leg) (from 0 0 1) (to 0 0 -40) (radius 0.6) (friction mu))
         (cylinder (named brace) (from 0 0 -22) (to 4 0 -2) (radius 0.2) (friction mu))
         (rov (named minnow) (at 2 10 -4))
         (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (nodes 64)
                 (from 2 -10 -4) (to minnow) (length 34))))

(define core (* 1/4 0.0076))            ; the line's axis comes no nearer to anything

(define (go! at speed)
  (move! at #:speed speed)
  (run-until arrived? #:at-most 60))

(define-scenario (out-as-it-went-in mu speed)
  "Drawn down into the crotch and held there by both members, the line stays until its vehicle goes back; then it
is free, and nothing has passed through."
  #:for ((mu 0 0.1 0.6) (speed 0.5 1.5))
  (in (leg-and-brace mu))
  (run 10)
  (always (> (clearance) (- core))
    (go! '(0.8 10 -36) speed)
    (run 40)                            ; it settles by half in 4 s: at mu 0.6 it meets the leg last
    (let ((what (map contact-object (contacts))) (at (rov-position)))
      (expect (memq 'leg what))
      (expect (memq 'brace what))
      (run 20)
      (expect (rov-position) is (about at #:within 0.05))
      (expect (rov-tension) is (below 200)))
    (go! '(2 10 -4) speed)
    (go! '(2 22 -4) speed)
    (run 30)
    (expect (null? (contacts)))
    (expect (map winding '(leg brace)) => '(0 0))))
