;;; A tether wound round a pile by driving round it once.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(enter! 'pile)
(for-each (lambda (p)
            (move! p #:speed 0.5)
            (run-until arrived? #:at-most 60))
          '((6 6 -5) (-4 6 -6) (-4 -4 -5) (6 -4 -6)))
(snapshot "fig-pile.png" #:overlay 'turns #:size '(960 540))
