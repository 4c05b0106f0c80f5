;;; (bight view tube) --- where a belief's tethers may be, drawn: the tubes that hold them with 50 and 90 %, and the
;;; members' lines in the colours of their homotopy classes.
;;;
;;; At each of many places the tube has an ellipsoid, whose outline in a picture is an ellipse: points c + u with
;;; u^T S^-1 u at most 1, where S is the sum of w w^T over the half axes w as they are seen.  Between places c and S
;;; are interpolated.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view tube)
  #:use-module (bight belief)
  #:use-module (bight belief answer)
  #:use-module (bight belief cloud)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module ((bight dive aware) #:select (homotopy-class))
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module (bight dive)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (believed-tubes for-each-inside read-drawing drawing? drawing-tubes draw-over draw-beneath))

(define places 40)                      ; along a tether

(define (tethers-believed)
  (%names (engine-of (belief-host (this-belief 'look))) 'tether))

(define (believed-tubes share)
  "Return for each tether of the current belief the tube that holds it with probability SHARE: a list of stations, each
the centre of an ellipsoid and its half axes."
  (map (lambda (tether) (tether-tube #:share share #:n places #:tether tether)) (tethers-believed)))


;;; Ellipses.  One is a list: its centre x and y, and S as xx, xy and yy.

(define (ellipse-of station project)
  ;; Of a STATION as PROJECT, which turns a point into a pair, shows it.
  (let* ((centre (project (car station)))
         (off (map (lambda (axis)
                     (let ((end (project (vec+ (car station) axis))))
                       (cons (- (car end) (car centre)) (- (cdr end) (cdr centre)))))
                   (cdr station)))
         (sum (lambda (a b) (apply + (map (lambda (w) (* (a w) (b w))) off)))))
    (list (car centre) (cdr centre) (sum car car) (sum car cdr) (sum cdr cdr))))

(define (between a b step)
  ;; The ellipses from A to B, B left out, at most STEP apart.
  (let ((n (max 1 (inexact->exact (ceiling (/ (max (abs (- (first b) (first a))) (abs (- (second b) (second a)))) step))))))
    (map (lambda (k) (map (lambda (x y) (+ x (* (/ k n) (- y x)))) a b)) (iota n))))

(define (band stations project step)
  (let ((ellipses (map (lambda (s) (ellipse-of s project)) stations)))
    (append (append-map (lambda (a b) (between a b step)) ellipses (cdr ellipses)) (list (last ellipses)))))

(define (within? e x y)
  (let ((dx (- x (first e))) (dy (- y (second e))) (xx (third e)) (xy (fourth e)) (yy (fifth e)))
    (<= (+ (* yy dx dx) (* -2 xy dx dy) (* xx dy dy)) (- (* xx yy) (* xy xy)))))

(define (cells-of middle half start size n)
  ;; The first and the last of N cells of SIZE from START whose middles may lie within HALF of MIDDLE.
  (let* ((a (/ (- middle half start) size)) (b (/ (- (+ middle half) start) size))
         (whole (lambda (x) (inexact->exact (floor (max -1.0 (min (* 1.0 n) x)))))))
    (cons (max 0 (whole (min a b))) (min (- n 1) (whole (max a b))))))

(define (for-each-inside f stations project left top width height columns rows)
  "Call F with column and row of each cell, of COLUMNS and ROWS of them, whose middle lies in the tube of STATIONS as
PROJECT shows it.  A cell is WIDTH by HEIGHT, which may be negative; the first begins at LEFT, TOP."
  (for-each
   (lambda (e)
     (let ((across (cells-of (first e) (sqrt (third e)) left width columns))
           (down (cells-of (second e) (sqrt (fifth e)) top height rows)))
       (do ((row (car down) (+ row 1))) ((> row (cdr down)))
         (do ((column (car across) (+ column 1))) ((> column (cdr across)))
           (when (within? e (+ left (* width (+ column 0.5))) (+ top (* height (+ row 0.5))))
             (f column row))))))
   (band stations project (max 1 (abs width)))))


;;; Over the pixels of a picture.

;; Of the likeliest class first: red, green and blue.
(define colours '((230 90 30) (60 120 230) (40 170 80) (170 70 200) (210 170 0) (0 160 170)))

(define (blend! pixels at colour share)
  (for-each (lambda (k c)
              (let ((old (bytevector-u8-ref pixels (+ at k))))
                (bytevector-u8-set! pixels (+ at k) (inexact->exact (round (+ old (* share (- c old))))))))
            '(2 1 0) colour))           ; a pixel is blue, green, red and alpha

(define (tint! pixels size stations project colour share)
  ;; Blend COLOUR once over each pixel in the tube.
  (let ((seen (make-bytevector (* (car size) (cdr size)) 0)))
    (for-each-inside (lambda (column row)
                       (let ((at (+ column (* row (car size)))))
                         (when (zero? (bytevector-u8-ref seen at))
                           (bytevector-u8-set! seen at 1)
                           (blend! pixels (* 4 at) colour share))))
                     stations project 0 0 1 1 (car size) (cdr size))))

(define (stroke! pixels size points colour)
  ;; A thin line through POINTS, pairs of pixels.
  (for-each
   (lambda (a b)
     (let* ((dx (- (car b) (car a))) (dy (- (cdr b) (cdr a)))
            (n (min 4000 (max 1 (inexact->exact (ceiling (max (abs dx) (abs dy))))))))
       (for-each (lambda (k)
                   (let ((x (floor (+ (car a) (* (/ k n) dx)))) (y (floor (+ (cdr a) (* (/ k n) dy)))))
                     (when (and (<= 0 x (- (car size) 1)) (<= 0 y (- (cdr size) 1)))
                       (blend! pixels (* 4 (inexact->exact (+ x (* y (car size))))) colour 0.5))))
                 (iota n))))
   points (cdr points)))

(define (rows-of polyline)
  (map list->f64vector (array->list polyline)))

(define (lines-by-class tether)
  ;; Of each member that has a class its points and a colour.
  (let* ((answer (ask-belief #f (lambda () (list (rows-of (tether-points tether places)) (homotopy-class tether)))))
         (told (answer-values answer))
         (order (map car (sort (map (lambda (class) (cons class (count (lambda (t) (equal? class (second t))) told)))
                                    (delete-duplicates (map second told)))
                               (lambda (a b) (> (cdr a) (cdr b)))))))
    (map (lambda (t)
           (cons (list-ref colours (min (- (length colours) 1) (list-index (lambda (c) (equal? c (second t))) order)))
                 (first t)))
         told)))

(define (points-of stations)
  ;; Each centre, and the end of each of its half axes.
  (append-map (lambda (s) (cons (car s) (map (lambda (axis) (vec+ (car s) axis)) (cdr s)))) stations))

;; What the current belief holds possible, read once and drawn by any view.
(define-record <drawing>
  (make-drawing tubes lines points)
  drawing?
  (tubes drawing-tubes)                 ; (SHARE . STATIONS) each, the widest first
  (lines drawing-lines)                 ; of each member its colour and its points
  (points drawing-points))              ; all of both, a list

(define (tubes-of share)
  (map (lambda (stations) (cons share stations)) (believed-tubes share)))

(define* (read-drawing #:key (lines? #t))
  "Return what the current belief holds possible of its tethers: a drawing, for `draw-over'; the tubes alone unless LINES?."
  (let ((tubes (append-map tubes-of '(0.9 0.5)))
        (lines (if lines? (append-map lines-by-class (tethers-believed)) '())))
    (make-drawing tubes lines
                  (delete-duplicates (append (append-map (compose points-of cdr) tubes) (append-map cdr lines)) eq?))))

(define (places-shown where points)
  ;; A table from each of POINTS to its place in the picture, (X . Y), left out where it is behind the camera.
  (let ((seen (make-hash-table)))
    (for-each (lambda (p k)
                (when (positive? (f64vector-ref where (+ 2 (* 3 k))))
                  (hash-set! seen p (cons (f64vector-ref where (* 3 k)) (f64vector-ref where (+ 1 (* 3 k)))))))
              points (iota (length points)))
    seen))

(define (draw-over draw size drawing)
  "Return the pixels that DRAW returns, a picture of SIZE, a pair, with DRAWING over it.  DRAW is called with an f64vector of
points, which it tells where they fall in the picture: x and y in pixels, and 0 for what lies behind."
  (let* ((points (drawing-points drawing))
         (where (list->f64vector (append-map f64vector->list points)))
         (pixels (draw where))
         (seen (places-shown where points))
         (project (lambda (p) (hash-ref seen p))))
    (for-each (lambda (tube)
                (when (every project (points-of (cdr tube)))
                  (tint! pixels size (cdr tube) project '(255 150 0) 0.22)))
              (drawing-tubes drawing))
    (for-each (lambda (line)
                (when (every project (cdr line))
                  (stroke! pixels size (map project (cdr line)) (car line))))
              (drawing-lines drawing))
    pixels))

(define (f64-append a b) (list->f64vector (append (f64vector->list a) (f64vector->list b))))

(define (fill! to from start)
  ;; Fill TO with what FROM has from START on.
  (do ((i 0 (+ i 1))) ((= i (f64vector-length to)))
    (f64vector-set! to i (f64vector-ref from (+ start i)))))

(define (draw-beneath drawing size places draw)
  "Return the pixels that DRAW returns, a picture of SIZE with DRAWING over it, as `draw-over' does; PLACES, an f64vector of
other points, receives where they fall in it."
  (draw-over (lambda (where)
               (let* ((all (f64-append places where)) (pixels (draw all)))
                 (fill! places all 0)
                 (fill! where all (f64vector-length places))
                 pixels))
             size drawing))
