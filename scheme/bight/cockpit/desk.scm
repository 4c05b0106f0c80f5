;;; (bight cockpit desk) --- where texts go on a screen, so that none is ever written over another.
;;;
;;; A desk puts a text only where nothing was put: what is more important is put first, and what finds no
;;; room is left out.  So it is at any size, whoever draws.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit desk)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (desk wrap cut put-lines put-centred put-right put-apart put-box))

(define (desk columns rows put)
  "Return a procedure of column, row, text, ink and paper that puts the text on a screen of COLUMNS and ROWS by PUT,
a procedure of the same, where there is room for all of it and nothing was put before.  It returns #t if it was put."
  (let ((taken (make-bytevector (max 1 (* columns rows)) 0)))
    (define (free? from n)
      (let loop ((i 0))
        (or (= i n)
            (and (zero? (bytevector-u8-ref taken (+ from i))) (loop (+ i 1))))))
    (lambda (column row text ink paper)
      (let ((n (string-length text)))
        (and (positive? n) (<= 0 row) (< row rows) (<= 0 column) (<= (+ column n) columns)
             (free? (+ column (* row columns)) n)
             (begin
               (do ((i 0 (+ i 1))) ((= i n)) (bytevector-u8-set! taken (+ column i (* row columns)) 1))
               (put column row text ink paper)
               #t))))))

(define (wrap text width)
  "Return TEXT as lines of at most WIDTH characters; a word that is longer is cut."
  (let loop ((words (string-tokenize text)) (line "") (lines '()))
    (cond ((null? words) (reverse (if (string-null? line) lines (cons line lines))))
          ((string-null? line) (loop (cdr words) (cut (car words) width) lines))
          ((<= (+ 1 (string-length line) (string-length (car words))) width)
           (loop (cdr words) (string-append line " " (car words)) lines))
          (else (loop words "" (cons line lines))))))

(define (cut text width)
  "Return TEXT, or its beginning with two dots if it has more than WIDTH characters."
  (cond ((<= (string-length text) width) text)
        ((< width 3) (substring text 0 (max 0 width)))
        (else (string-append (substring text 0 (- width 2)) ".."))))

(define (put-lines put column row lines ink paper)
  "Put LINES, strings, one below the other by PUT from COLUMN and ROW on."
  (for-each (lambda (line i) (put column (+ row i) line ink paper)) lines (iota (length lines))))

(define (put-centred put columns row text ink paper)
  "Put TEXT in the middle of ROW, cut to COLUMNS."
  (let ((text (cut text columns)))
    (put (quotient (- columns (string-length text)) 2) row text ink paper)))

(define (put-right put columns row text ink paper)
  "Put TEXT at the right end of ROW."
  (put (- columns (string-length text)) row text ink paper))

(define (put-apart put columns column row text ink paper)
  "Put TEXT with a blank before and behind it, where its ROW of COLUMNS goes on there, so that it is read as a word."
  (put (max 0 (- column 1)) row
       (string-append (if (> column 0) " " "") text (if (< (+ column (string-length text)) columns) " " ""))
       ink paper))

(define (put-box put column row lines ink paper)
  "Put LINES as a block with a margin, all as wide as the widest.  Return the row below it."
  (let ((width (+ 2 (apply max 0 (map string-length lines)))))
    (put-lines put column row
               (map (lambda (line) (string-pad-right (string-append " " line) width)) lines)
               ink paper)
    (+ row (length lines))))
