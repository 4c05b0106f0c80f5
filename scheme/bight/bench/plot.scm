;;; (bight bench plot) --- measurements as SVG: error against cost with its front, and maps.
;;;
;;; A plot has the rows of one case and metric: cost in multiples of the calibration kernel to the right,
;;; error upwards, both logarithmic; a ring and a line for the front, whose points name their settings.  A model
;;; has one colour and one shape in all plots of a report.  What errs by nothing stands in a strip of its own
;;; below, for a logarithm has no zero.  A map has the two numbers of its settings,
;;; "X=1;Y=2", for its sides, and the error for its colour.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench plot)
  #:use-module (bight bench row)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core markup) #:select (as-xml))
  #:use-module (srfi srfi-1)
  #:export (plots-of plot-file plot-sentence call-with-svg color-of draw-line draw-text tenth
            draw-on-decades))

(define width 760)
(define height 440)
(define left 90)
(define right 200)                      ; the legend's
(define top 40)
(define bottom 55)

(define colors '("#1f6feb" "#d1242f" "#1a7f37" "#bf5af2" "#e36209" "#0e7490" "#8b5e34" "#57606a"))

(define (color-of i)
  "Return the color of the I-th of what is drawn together."
  (list-ref colors (modulo i (length colors))))

(define (tenth x)
  "Return X to a tenth, as it stands in SVG."
  (number->string (/ (round (* 10 (exact->inexact x))) 10)))

(define (log10 x) (/ (log x) (log 10)))

(define (draw-text port x y words . attributes)
  "Write WORDS at X and Y to PORT, with ATTRIBUTES of their element."
  (simple-format port "<text x='~a' y='~a' ~a>~a</text>~%" (tenth x) (tenth y)
                 (string-join attributes) (as-xml words)))

(define (draw-line port x1 y1 x2 y2 style)
  "Write a line from X1 and Y1 to X2 and Y2 to PORT, its attributes STYLE."
  (simple-format port "<line x1='~a' y1='~a' x2='~a' y2='~a' ~a/>~%"
                 (tenth x1) (tenth y1) (tenth x2) (tenth y2) style))

(define (call-with-svg title draw)
  "Return the SVG, a string, that DRAW writes to its port under TITLE: 760 wide, 440 high."
  (call-with-output-string
    (lambda (port)
      (simple-format port "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 ~a ~a' width='~a' \
height='~a' font-family='sans-serif' font-size='12' fill='#24292f'>~%<rect width='~a' height='~a' \
fill='white'/>~%"
                     width height width height width height)
      (draw-text port left 22 title "font-size='14'" "font-weight='bold'")
      (draw port)
      (display "</svg>\n" port))))


;;; Axes of decades.

(define (decades numbers)
  ;; Whole decades (LOW . HIGH) around the positive NUMBERS, at least one.
  (let ((low (floor (log10 (apply min numbers)))) (high (ceiling (log10 (apply max numbers)))))
    (cons low (if (= low high) (+ low 1) high))))

(define (scale range from to)
  ;; From a number to its place.
  (lambda (x)
    (+ from (* (- to from) (/ (- (log10 x) (car range)) (- (cdr range) (car range)))))))

(define (tics range)
  ;; Powers of ten in RANGE, ten of them at most.
  (let* ((count (- (cdr range) (car range))) (by (ceiling (/ count 10))))
    (let loop ((k (car range)) (all '()))
      (if (> k (cdr range)) (reverse all) (loop (+ k by) (cons k all))))))

(define (power k)
  (simple-format #f "1e~a" (inexact->exact k)))

(define* (draw-axes port xs ys x y metric #:optional (along "CPU time, in steps of the calibration kernel"))
  (let ((floor-y (- height bottom)) (end-x (- width right)))
    (for-each (lambda (k)
                (let ((at (x (expt 10 k))))
                  (draw-line port at top at floor-y "stroke='#d0d7de'")
                  (draw-text port at (+ floor-y 16) (power k) "text-anchor='middle'")))
              (tics xs))
    (for-each (lambda (k)
                (let ((at (y (expt 10 k))))
                  (draw-line port left at end-x at "stroke='#d0d7de'")
                  (draw-text port (- left 6) (+ at 4) (power k) "text-anchor='end'")))
              (tics ys))
    (draw-text port (/ (+ left end-x) 2) (- height 16) along "text-anchor='middle'")
    (draw-text port 0 0 metric "text-anchor='middle'"
          (simple-format #f "transform='translate(18 ~a) rotate(-90)'" (tenth (/ (+ top floor-y) 2))))))

(define (draw-on-decades title across up along metric draw)
  "Return the SVG of axes with decades for the numbers ACROSS, called ALONG, and UP, called METRIC, under TITLE, and of
what DRAW draws: it is given the port and two procedures, from numbers to their places."
  (let* ((xs (decades across)) (ys (decades up))
         (x (scale xs left (- width right))) (y (scale ys (- height bottom) top)))
    (call-with-svg title
      (lambda (port)
        (draw-axes port xs ys x y metric along)
        (draw port x y)))))


;;; Fronts.

(define strip 26)                       ; the height of the strip of what errs by nothing

(define (positive-errors rows)
  (filter positive? (map row-error rows)))

(define (draw-mark port number px py words)
  ;; The mark of the model of that NUMBER, at PX and PY: a circle, a square or a diamond, as the colours go round.
  (let ((shape (modulo (quotient number (length colors)) 3)))
    (if (zero? shape)
        (simple-format port "<circle cx='~a' cy='~a' r='4' " (tenth px) (tenth py))
        (simple-format port "<rect x='~a' y='~a' width='7' height='7' transform='rotate(~a ~a ~a)' "
                       (tenth (- px 3.5)) (tenth (- py 3.5)) (if (= shape 1) 0 45) (tenth px) (tenth py)))
    (simple-format port "fill='~a' fill-opacity='0.8'><title>~a</title></~a>~%" (color-of number)
                   (as-xml words) (if (zero? shape) "circle" "rect"))))

(define (draw-series port rows model number i x y)
  ;; The ROWS of MODEL, which has that NUMBER in the report, and its entry, the I-th of the legend.
  (for-each (lambda (row)
              (draw-mark port number (x (row-ratio row)) (y (row-error row))
                         (string-append model ", " (row-setting row))))
            (filter (lambda (row) (string=? model (row-model row))) rows))
  (let ((at (+ top 10 (* 18 i))))
    (draw-mark port number (- width right -14) at model)
    (draw-text port (- width right -24) (+ at 4) model)))

(define (draw-front port rows x y)
  (let ((front (sort (filter row-front? rows) (lambda (a b) (< (row-ratio a) (row-ratio b))))))
    (simple-format port "<polyline fill='none' stroke='#24292f' stroke-dasharray='4 3' points='~a'/>~%"
                   (string-join (map (lambda (row)
                                       (string-append (tenth (x (row-ratio row))) ","
                                                      (tenth (y (row-error row)))))
                                     front)))
    (fold (lambda (row written)
            ;; WRITTEN is the height of the last setting that found room.
            (let ((px (x (row-ratio row))) (py (y (row-error row))))
              (simple-format port "<circle cx='~a' cy='~a' r='7' fill='none' stroke='#24292f'/>~%"
                             (tenth px) (tenth py))
              (cond ((> (- py written) 12)
                     (draw-text port (+ px 9) (- py 6) (row-setting row) "font-size='10'")
                     py)
                    (else written))))
          -100
          front)))

(define (draw-strip port y)
  (draw-line port left (- height bottom strip) (- width right) (- height bottom strip) "stroke='#57606a'")
  (draw-text port (- left 6) (+ y 4) "exact" "text-anchor='end'"))

(define (front-svg rows models)
  ;; MODELS are those of the whole report: the place there of a model is its colour and shape.
  (let* ((errors (positive-errors rows))
         (exact? (< (length errors) (length rows)))
         (low (if exact? (- height bottom strip) (- height bottom)))
         (xs (decades (map row-ratio rows)))
         (ys (decades (if (null? errors) '(1) errors)))
         (x (scale xs left (- width right)))
         (y-of (scale ys low top))
         (strip-y (- height bottom (/ strip 2)))
         (y (lambda (e) (if (positive? e) (y-of e) strip-y))))
    (call-with-svg (string-join (list (row-bench (car rows)) (row-case (car rows))) ", ")
      (lambda (port)
        (draw-axes port xs ys x y (row-metric (car rows)))
        (when exact? (draw-strip port strip-y))
        (let ((here (filter (lambda (model) (any (lambda (row) (string=? model (row-model row))) rows)) models)))
          (for-each (lambda (model i)
                      (draw-series port rows model (list-index (lambda (m) (string=? m model)) models) i x y))
                    here (iota (length here))))
        (draw-front port rows x y)))))


;;; What a plot says, in words.

(define (round-number x)
  ;; Two figures are enough for a sentence.
  (cond ((zero? x) "0")
        ((<= 0.01 (abs x) 99999)
         (let ((unit (expt 10. (- 1 (inexact->exact (floor (log10 (abs x))))))))
           (let ((text (number->string (/ (round (* x unit)) unit))))
             (if (string-suffix? ".0" text) (string-drop-right text 2) text))))
        (else
         (let* ((k (inexact->exact (floor (log10 (abs x))))) (digits (/ (round (* 10 (/ x (expt 10. k)))) 10)))
           (simple-format #f "~ae~a" digits k)))))

(define rounding 1e-14)                 ; the errors of double precision

(define (point-words row)
  (simple-format #f "~a~a: ~a in ~a calibration steps" (row-model row)
                 (if (string-null? (row-setting row)) "" (string-append " (" (row-setting row) ")"))
                 (if (< (row-error row) rounding) "no error but rounding" (string-append "an error of " (round-number (row-error row))))
                 (round-number (row-ratio row))))

(define (plot-sentence rows)
  "Return what the plot of ROWS says, a sentence or two for who sees it for the first time."
  (let ((front (sort (filter row-front? rows) (lambda (a b) (< (row-ratio a) (row-ratio b)))))
        (models (delete-duplicates (map row-model rows))))
    (cond ((row-map? (car rows)) "The darker a field, the larger the error at these settings; rest on one for the number.")
          ((null? front) "Lower is more exact, further left is faster.")
          ((null? (cdr front))
           (string-append "Lower is more exact, further left is faster. Nothing beats " (point-words (car front)) "."))
          (else
           (simple-format #f "Lower is more exact, further left is faster. Of ~a settings~a, ~a are worth having \
(dashed): from the fastest, ~a, to the most exact, ~a."
                          (length rows)
                          (if (null? (cdr models)) "" (simple-format #f " of ~a models" (length models)))
                          (length front) (point-words (car front)) (point-words (last front)))))))


;;; Maps.

(define (setting-pairs setting)
  ;; "X=1;Y=2" as (("X" . 1) ("Y" . 2)).
  (map (lambda (word)
         (let ((i (or (string-index word #\=) (string-length word))))
           (cons (substring word 0 i)
                 (or (text->number (substring word (min (+ i 1) (string-length word)))) 0))))
       (string-split setting #\;)))

(define (places numbers)
  (let ((all (delete-duplicates (sort numbers <))))
    (map cons all (iota (length all)))))

(define (shade share)
  ;; From white through yellow and red to black.
  (let* ((channel (lambda (from to) (inexact->exact (round (* 255 (- 1 (max 0 (min 1 (/ (- share from)
                                                                                        (- to from))))))))))
         (hex (lambda (n) (string-pad (number->string n 16) 2 #\0))))
    (string-append "#" (hex (channel 0.67 1)) (hex (channel 0.33 0.67)) (hex (channel 0 0.33)))))

(define (share-of value low high)
  (cond ((= low high) 0)
        ((positive? low) (/ (log (/ value low)) (log (/ high low))))
        (else (/ (- value low) (- high low)))))

(define (map-svg rows)
  (let* ((pairs (map (lambda (row) (setting-pairs (row-setting row))) rows))
         (xs (places (map cdar pairs)))
         (ys (places (map cdadr pairs)))
         (errors (map row-error rows))
         (low (apply min errors))
         (high (apply max errors))
         (dx (/ (- width right left) (length xs)))
         (dy (/ (- height top bottom) (length ys))))
    (define (place-x x) (+ left (* dx (assv-ref xs x))))
    (define (place-y y) (- height bottom (* dy (+ 1 (assv-ref ys y)))))
    (call-with-svg (string-join (list (row-bench (car rows)) (row-case (car rows))
                                      (row-metric (car rows)))
                                ", ")
      (lambda (port)
        (for-each (lambda (row pair)
                    (simple-format port "<rect x='~a' y='~a' width='~a' height='~a' fill='~a'><title>~a: ~a\
</title></rect>~%"
                                   (tenth (place-x (cdar pair))) (tenth (place-y (cdadr pair)))
                                   (tenth dx) (tenth dy) (shade (share-of (row-error row) low high))
                                   (as-xml (row-setting row)) (row-error row)))
                  rows pairs)
        (for-each (lambda (x)
                    (draw-text port (+ (place-x (car x)) (/ dx 2)) (- height bottom -16)
                          (number->string (car x)) "text-anchor='middle'"))
                  xs)
        (for-each (lambda (y)
                    (draw-text port (- left 6) (+ 4 (place-y (car y)) (/ dy 2)) (number->string (car y))
                          "text-anchor='end'"))
                  ys)
        (draw-text port (/ (+ left (- width right)) 2) (- height 16) (caaar pairs) "text-anchor='middle'")
        (draw-text port 18 (- top 8) (caadar pairs))
        (draw-text port (- width right -14) (+ top 10) (simple-format #f "white ~a" low))
        (draw-text port (- width right -14) (+ top 28) (simple-format #f "black ~a" high))))))


;;; All of them.

(define (plot-file rows)
  "Return the name of the file for the plot of ROWS, which are of one group: no blank or slash in it."
  (string-append
   (string-map (lambda (c) (if (or (char-alphabetic? c) (char-numeric? c) (memv c '(#\- #\.))) c #\-))
               (string-join (row-group (car rows)) "-"))
   ".svg"))

(define (alike rows)
  (map (lambda (group) (filter (lambda (row) (equal? group (row-group row))) rows))
       (delete-duplicates (map row-group rows))))

(define (map-like? row)
  (and (row-error row)
       (= 2 (length (setting-pairs (row-setting row))))))

(define (worth? rows)
  ;; Is there a front to be seen?
  (and (> (length rows) 1)
       (> (length (delete-duplicates (map row-error rows))) 1)))

(define (plots-of rows)
  "Return an alist from those lists of ROWS that are worth a plot, or a map, to the SVG, a string."
  (append
   (map (lambda (group) (cons group (front-svg group (delete-duplicates (map row-model rows)))))
        (filter worth?
                (alike (filter (lambda (row) (and (row-judged? row) (< (row-error row) +inf.0))) rows))))
   (map (lambda (group) (cons group (map-svg group)))
        (filter worth? (alike (filter (lambda (row) (and (row-map? row) (map-like? row))) rows))))))
