;;; (bight view canvas) --- lines drawn in characters.
;;;
;;; A canvas is an array of characters with a frame: metres to cells, a cell being twice as high as wide.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view canvas)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (canvas?
            canvas-columns
            canvas-left
            canvas-rows
            canvas-step
            canvas-top
            make-canvas
            cell-of
            put!
            put-row!
            mark-line!
            draw-line!
            canvas->lines
            frame))

(define-record <canvas>
  (%make-canvas rows left top step)
  canvas?
  (rows canvas-rows)                    ; a vector of strings
  (left canvas-left)                    ; metres at the left edge
  (top canvas-top)                      ; metres at the upper edge
  (step canvas-step))                   ; metres a column; a row is twice that

(define (make-canvas columns rows middle step)
  ;; A blank canvas with the point MIDDLE, a pair of metres, in its middle.
  (%make-canvas (list->vector (map (lambda (row) (make-string columns #\space)) (iota rows)))
                (- (car middle) (* 1/2 columns step))
                (+ (cdr middle) (* rows step))
                step))

(define (canvas-columns canvas)
  (string-length (vector-ref (canvas-rows canvas) 0)))

(define (cell-of canvas place)
  ;; The cell, a pair of column and row, at PLACE, a pair of metres.
  (let ((step (canvas-step canvas)))
    (cons (inexact->exact (floor (/ (- (car place) (canvas-left canvas)) step)))
          (inexact->exact (floor (/ (- (canvas-top canvas) (cdr place)) (* 2 step)))))))

(define (put! canvas cell char)
  (let ((rows (canvas-rows canvas)))
    (when (and (< -1 (cdr cell) (vector-length rows)) (< -1 (car cell) (canvas-columns canvas)))
      (string-set! (vector-ref rows (cdr cell)) (car cell) char))))

(define (put-row! canvas height char)
  ;; A level line at HEIGHT metres, behind everything drawn later.
  (let ((row (cdr (cell-of canvas (cons 0 height)))))
    (for-each (lambda (column) (put! canvas (cons column row) char))
              (iota (canvas-columns canvas)))))

(define (cells-between a b)
  ;; The cells from A, left out, to B, each touching the next.
  (let* ((dx (- (car b) (car a)))
         (dy (- (cdr b) (cdr a)))
         (n (max (abs dx) (abs dy))))
    (map (lambda (i)
           (cons (+ (car a) (round (/ (* i dx) n)))
                 (+ (cdr a) (round (/ (* i dy) n)))))
         (iota n 1))))

(define (trace-cells corners)
  ;; The connected cells along CORNERS, a list of cells.
  (let loop ((rest (cdr corners)) (at (car corners)) (trail (list (car corners))))
    (if (null? rest)
        (reverse trail)
        (loop (cdr rest) (car rest)
              (append (reverse (cells-between at (car rest))) trail)))))

(define (stroke before after)
  ;; The character that leads from the cell BEFORE to the cell AFTER.
  (let ((dx (- (car after) (car before)))
        (dy (- (cdr after) (cdr before))))
    (cond ((zero? dy) #\-)
          ((zero? dx) #\|)
          ((positive? (* dx dy)) #\\)
          (else #\/))))

(define (mark-line! canvas char a b)
  ;; Put CHAR all along the straight line from A to B, pairs of metres, where it is on the canvas.
  (let* ((step (canvas-step canvas))
         (dx (- (car b) (car a)))
         (dy (- (cdr b) (cdr a)))
         (span (clipped canvas a dx dy)))
    (when span
      (let* ((from (car span)) (length (- (cdr span) from))
             (n (+ 1 (inexact->exact
                      (ceiling (/ (* length (max (abs dx) (* 1/2 (abs dy)))) step))))))
        (do ((i 0 (+ i 1))) ((> i n))
          (let ((k (+ from (* length (/ i n)))))
            (put! canvas (cell-of canvas (cons (+ (car a) (* k dx)) (+ (cdr a) (* k dy)))) char)))))))

(define (clipped canvas a dx dy)
  ;; The shares, a pair, between which the line from A by (DX DY) is on the canvas, or #f.
  (let ((width (* (canvas-columns canvas) (canvas-step canvas)))
        (height (* 2 (vector-length (canvas-rows canvas)) (canvas-step canvas))))
    (define (cut span start way low high)
      (and span
           (if (zero? way)
               (and (<= low start high) span)
               (let* ((s (/ (- low start) way)) (t (/ (- high start) way))
                      (from (max (car span) (min s t))) (to (min (cdr span) (max s t))))
                 (and (<= from to) (cons from to))))))
    (cut (cut '(0 . 1) (car a) dx (canvas-left canvas) (+ (canvas-left canvas) width))
         (cdr a) dy (- (canvas-top canvas) height) (canvas-top canvas))))

(define (draw-line! canvas places)
  ;; Draw the line through PLACES, a list of pairs of metres.
  (let ((trail (trace-cells (map (lambda (place) (cell-of canvas place)) places))))
    (let loop ((before (car trail)) (rest trail))
      (unless (null? rest)
        (let ((after (if (null? (cdr rest)) (car rest) (cadr rest))))
          (put! canvas (car rest) (if (equal? before after) #\* (stroke before after)))
          (loop (car rest) (cdr rest)))))))

(define (canvas->lines canvas)
  (vector->list (canvas-rows canvas)))

(define (frame title lines columns)
  ;; LINES, each COLUMNS long, in a box under TITLE.
  (let ((edge (string-append "+" (make-string columns #\-) "+")))
    (append (list (string-pad-right (string-append " " title) (+ 2 columns)) edge)
            (map (lambda (line) (string-append "|" line "|")) lines)
            (list edge))))
