;;; (bight shell fold) --- lines of help folded to the width of the terminal that they are read in.
;;;
;;; What goes to a file or a pipe keeps its lines, so that a search finds whole sentences, unless COLUMNS asks.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell fold)
  #:use-module ((bight outlet) #:select (watched?))
  #:use-module ((bight view text) #:select (terminal-columns))
  #:use-module (ice-9 regex)
  #:use-module (srfi srfi-1)
  #:export (reader-columns
            joined-lines
            folded-lines))

(define (reader-columns)
  "Return the columns of the terminal that reads the present output, or of the variable COLUMNS; #f if nobody says."
  (and (or (getenv "COLUMNS") (watched? (current-output-port)))
       (terminal-columns)))

(define fill-column 88)                 ; a line of a docstring that its next word would take beyond was broken there

(define (broken-for-room? line next)
  (let ((word (string-index next #\space)))
    (and (not (string-null? next))
         (> (+ (string-length line) 1 (or word (string-length next))) fill-column))))

(define (joined-lines lines)
  "Return LINES, those of a text, with those made one that were broken only because the source has so many columns."
  (if (null? lines)
      '()
      (let loop ((text (car lines)) (line (car lines)) (rest (cdr lines)))
        (cond ((null? rest) (list text))
              ((broken-for-room? line (car rest))
               (loop (string-append text " " (car rest)) (car rest) (cdr rest)))
              (else (cons text (loop (car rest) (car rest) (cdr rest))))))))

;; Two blanks that do not end a sentence stand between columns.
(define between-columns (make-regexp "[^ ]   +|[^ .!?:]  +|^ +[^ ]+  +"))
(define indented (make-regexp "^ *"))

(define (hanging line columns)
  ;; The column at which what does not fit into COLUMNS goes on: that of the last column that LINE has in the left half,
  ;; or a little to the right of where LINE begins.
  (let ((gap (find (lambda (m) (<= (match:end m) (quotient columns 2)))
                   (reverse (list-matches between-columns line))))
        (indent (match:end (regexp-exec indented line))))
    (cond (gap (match:end gap))
          ((zero? indent) 0)
          (else (min (+ indent 2) (quotient columns 2))))))

(define (break-of line from columns)
  ;; Where LINE, whose text begins at FROM, is broken so that at most COLUMNS come before: at the last blank, or behind
  ;; a longer word; #f if all of it fits.
  (and (> (string-length line) columns)
       (or (string-rindex line #\space from (+ columns 1))
           (string-index line #\space columns))))

(define (folded-line line columns)
  ;; LINE as lines of at most COLUMNS, but for longer words; where it goes on it is indented as its text is.
  (let ((indent (make-string (hanging line columns) #\space)))
    (let loop ((line line))
      (let* ((at (break-of line (or (string-skip line #\space) 0) columns))
             (rest (if at (string-trim (substring line at)) "")))
        (if (string-null? rest)
            (list line)
            (cons (string-trim-right (substring line 0 at))
                  (loop (string-append indent rest))))))))

(define (folded-lines lines columns)
  "Return LINES folded to COLUMNS, or as they are if COLUMNS is #f."
  (if columns
      (append-map (lambda (line) (folded-line line (max 20 columns))) lines)
      lines))
