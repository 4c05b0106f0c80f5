;;; What terminals show, as pictures: texts with their colours become cells, and gnuplot draws these, two pixels for each
;;; cell, and its letter.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (ice-9 popen)
             (srfi srfi-1))

(define basic-colors                    ; xterm's first sixteen
  #(#x000000 #xcd0000 #x00cd00 #xcdcd00 #x0000ee #xcd00cd #x00cdcd #xe5e5e5
    #x7f7f7f #xff0000 #x00ff00 #xffff00 #x5c5cff #xff00ff #x00ffff #xffffff))

(define usual-ink #xe5e5e5)
(define usual-paper #x000000)

(define (rgb r g b) (+ (* 65536 r) (* 256 g) b))

(define (indexed-color i)
  ;; Of xterm's 256: sixteen, a cube of six levels, greys.
  (define (level k) (if (zero? k) 0 (+ 55 (* 40 k))))
  (cond ((< i 16) (vector-ref basic-colors i))
        ((< i 232) (let ((k (- i 16))) (apply rgb (map level (list (quotient k 36) (remainder (quotient k 6) 6) (remainder k 6))))))
        (else (let ((grey (+ 8 (* 10 (- i 232))))) (rgb grey grey grey)))))

(define (colors-after numbers ink paper)
  ;; (INK . PAPER) after the NUMBERS of an SGR sequence.
  (if (null? numbers)
      (cons ink paper)
      (let ((n (car numbers)) (more (cdr numbers)))
        (define (extended set)
          ;; 5 N or 2 R G B.
          (if (= 5 (car more))
              (set (indexed-color (second more)) (cddr more))
              (set (rgb (second more) (third more) (fourth more)) (list-tail more 4))))
        (cond ((= n 0) (colors-after more usual-ink usual-paper))
              ((= n 38) (extended (lambda (color rest) (colors-after rest color paper))))
              ((= n 48) (extended (lambda (color rest) (colors-after rest ink color))))
              ((= n 39) (colors-after more usual-ink paper))
              ((= n 49) (colors-after more ink usual-paper))
              ((<= 30 n 37) (colors-after more (vector-ref basic-colors (- n 30)) paper))
              ((<= 40 n 47) (colors-after more ink (vector-ref basic-colors (- n 40))))
              ((<= 90 n 97) (colors-after more (vector-ref basic-colors (- n 82)) paper))
              ((<= 100 n 107) (colors-after more ink (vector-ref basic-colors (- n 92))))
              (else (colors-after more ink paper))))))

(define (numbers-of text)
  (map (lambda (part) (or (string->number part) 0)) (string-split text #\;)))

(define (text->cells text columns rows)
  "Return the array, ROWS by COLUMNS, of the cells, vectors of letter, ink and paper, that a terminal shows of TEXT: lines, or
what a screen wrote, with its colours."
  (let ((cells (make-array (vector #\space usual-ink usual-paper) rows columns)) (n (string-length text)))
    (let loop ((i 0) (row 0) (column 0) (ink usual-ink) (paper usual-paper))
      (cond ((>= i n) cells)
            ((char=? #\newline (string-ref text i)) (loop (+ i 1) (+ row 1) 0 ink paper))
            ((char=? #\escape (string-ref text i))
             (let* ((end (string-index text char-alphabetic? i)) (said (numbers-of (substring text (+ i 2) end))))
               (case (string-ref text end)
                 ((#\H) (loop (+ end 1) (- (first said) 1) (- (second said) 1) ink paper))
                 ((#\m) (let ((colors (colors-after said ink paper)))
                          (loop (+ end 1) row column (car colors) (cdr colors))))
                 (else (loop (+ end 1) row column ink paper)))))
            (else
             (when (array-in-bounds? cells row column)
               (array-set! cells (vector (string-ref text i) ink paper) row column))
             (loop (+ i 1) row (+ column 1) ink paper))))))

(define (beside left right)
  "Return the cells of LEFT and of RIGHT, arrays of as many rows, with a line between them."
  (let* ((rows (first (array-dimensions left))) (w (second (array-dimensions left)))
         (both (make-array (vector #\│ #x7f7f7f usual-paper) rows (+ w 1 (second (array-dimensions right))))))
    (define (copy! from by)
      (array-index-map! (make-shared-array both (lambda (row column) (list row (+ by column))) rows (second (array-dimensions from)))
                        (lambda (row column) (array-ref from row column))))
    (copy! left 0)
    (copy! right (+ w 1))
    both))


;;; Drawing.

(define (half cell upper?)
  (if (and upper? (char=? #\▀ (vector-ref cell 0))) (vector-ref cell 1) (vector-ref cell 2)))

(define (each-cell cells proc)
  (let ((rows (first (array-dimensions cells))) (columns (second (array-dimensions cells))))
    (do ((row 0 (+ row 1))) ((= row rows))
      (do ((column 0 (+ column 1))) ((= column columns))
        (proc column row (array-ref cells row column))))))

(define (put-pixel port x y color)
  (simple-format port "~a ~a ~a ~a ~a\n" x y (quotient color 65536) (remainder (quotient color 256) 256)
                 (remainder color 256)))

(define (hex color)
  (string-pad (number->string color 16) 6 #\0))

(define (draw-cells cells file)
  "Write CELLS to FILE, a PNG."
  (let ((port (open-pipe* OPEN_WRITE "gnuplot")) (rows (first (array-dimensions cells))) (columns (second (array-dimensions cells))))
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
