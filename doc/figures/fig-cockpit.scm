;;; The cockpit as terminals show it: a dive at a jacket flown freely, and with the panel of a lesson over it.
;;;
;;; A frame is composed as for a terminal of all colours, its bytes are read back into cells, and gnuplot draws these: two
;;; pixels for each cell, and its letter.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight cockpit)
             (bight cockpit cells)
             (bight cockpit state)
             (bight dive)
             (bight lesson flying)
             (ice-9 popen)
             (srfi srfi-1))

(define columns 100)
(define rows 30)


;;; Cells: vectors of letter, ink and paper.

(define (numbers text)
  (map (lambda (part) (or (string->number part) 0)) (string-split text #\;)))

(define (color numbers)
  ;; 0xRRGGBB of (38 2 R G B).
  (fold (lambda (x sum) (+ x (* 256 sum))) 0 (cddr numbers)))

(define (bytes->cells text)
  "Return the array of cells that TEXT, what a screen wrote, shows."
  (let ((cells (make-array (vector #\space 0 0) rows columns)) (n (string-length text)))
    (let loop ((i 0) (at 0) (ink #xffffff) (paper 0))
      (cond ((>= i n) cells)
            ((char=? #\escape (string-ref text i))
             (let* ((end (string-index text char-alphabetic? i)) (said (numbers (substring text (+ i 2) end))))
               (case (string-ref text end)
                 ((#\H) (loop (+ end 1) (+ (* columns (- (first said) 1)) (- (second said) 1)) ink paper))
                 ((#\m) (case (first said)
                          ((38) (loop (+ end 1) at (color said) paper))
                          ((48) (loop (+ end 1) at ink (color said)))
                          (else (loop (+ end 1) at ink paper))))
                 (else (loop (+ end 1) at ink paper)))))
            (else
             (array-set! cells (vector (string-ref text i) ink paper) (quotient at columns) (remainder at columns))
             (loop (+ i 1) (+ at 1) ink paper))))))


;;; Drawing.

(define (half cell upper?)
  (if (and upper? (char=? #\▀ (vector-ref cell 0))) (vector-ref cell 1) (vector-ref cell 2)))

(define (each-cell cells proc)
  (do ((row 0 (+ row 1))) ((= row rows))
    (do ((column 0 (+ column 1))) ((= column columns))
      (proc column row (array-ref cells row column)))))

(define (put-pixel port x y color)
  (simple-format port "~a ~a ~a ~a ~a\n" x y (quotient color 65536) (remainder (quotient color 256) 256)
                 (remainder color 256)))

(define (hex color)
  (string-pad (number->string color 16) 6 #\0))

(define (draw-cells cells file)
  "Write CELLS to FILE, a PNG."
  (let ((port (open-pipe* OPEN_WRITE "gnuplot")))
    (simple-format port "set terminal pngcairo size ~a,~a font 'DejaVu Sans Mono,9'\nset output '~a'\n" (* 9 columns)
                   (* 18 rows) file)
    (simple-format port "unset key\nunset border\nunset tics\nset margins 0,0,0,0\nset xrange [-0.5:~a]\nset yrange [~a:-0.5]\n"
                   (- columns 1/2 -0.0) (- (* 2 rows) 1/2 -0.0))
    (each-cell cells
               (lambda (column row cell)
                 (let ((letter (vector-ref cell 0)))
                   (unless (memv letter '(#\▀ #\space))
                     (simple-format port "set label ~s at ~a,~a center noenhanced tc rgb '#~a' front\n" (string letter) column
                                    (+ (* 2 row) 0.5) (hex (vector-ref cell 1)))))))
    (display "$cells << EOD\n" port)
    (do ((y 0 (+ y 1))) ((= y (* 2 rows)))
      (do ((x 0 (+ x 1))) ((= x columns))
        (put-pixel port x y (half (array-ref cells (quotient y 2) x) (even? y)))))
    (display "EOD\nplot $cells using 1:2:3:4:5 with rgbimage\n" port)
    (close-pipe port)))

(define (frame c hint)
  ;; Twice: what is asked now and then is asked in one frame or the next.
  (fit-to-size! c (cons columns rows))
  (compose-frame! c hint)
  (compose-frame! c hint)
  (bytes->cells (%screen-bytes (cockpit-screen c) #t)))


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
