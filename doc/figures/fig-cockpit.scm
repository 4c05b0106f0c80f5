;;; The cockpit as terminals show it: a dive at a jacket flown freely, and with the panel of a lesson over it.
;;;
;;; A frame is composed as for a terminal of all colours, its bytes are read back into cells, and these are drawn.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight cockpit)
             (bight cockpit cells)
             (bight cockpit state)
             (bight dive)
             (bight lesson flying))

(load "cells.scm")

(define columns 100)
(define rows 30)

(define (frame c hint)
  ;; Twice: what is asked now and then is asked in one frame or the next.
  (fit-to-size! c (cons columns rows))
  (compose-frame! c hint)
  (compose-frame! c hint)
  (text->cells (%screen-bytes (cockpit-screen c) #t) columns rows))


;;; The dive.

(enter! 'jacket)
(fly-to! '(4 -4 -9) #:speed 0.5)
(run 24)

(define cockpit (new-cockpit 'true 'chase 'plain))
(board! cockpit (current-dive))
(draw-cells (frame cockpit "w s a d i k j l sticks  v view  [ ] winch  p pause  ? keys  : prompt  q quit") "fig-cockpit.png")

(define places (list (target "the far leg" '(10 10 -12)) (target "home" '(0 -20 -3))))
(set-view! cockpit 'overview)
(set-targets! cockpit (lambda () (map (lambda (p) (target (car p) (apply vec (cdr p)))) places)))
(set-panel! cockpit
            (lesson-panel "Go round the far leg, keeping the line clear of the braces, and come home the way you went."
                          '((#xffd84a . "Coach: your line lies round a leg."))
                          (map target-line ((cockpit-targets cockpit)) '(0 1)) '("0:24  touches 0")))
(draw-cells (frame cockpit "e hint  u back  p pause  t tender  z map  v view  : Scheme  ? keys  q leave, to go on later")
            "fig-cockpit-lesson.png")
