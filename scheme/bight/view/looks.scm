;;; (bight view looks) --- how a value looks at the prompt: rounded to what it means, and in columns.
;;;
;;; Only what is shown is rounded: the value keeps all its digits, and `write' shows them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view looks)
  #:use-module ((bight core decimal) #:select (fixed text->number))
  #:use-module ((bight core verb) #:select (verb? verb-usage))
  #:use-module ((bight dive plain-words) #:select (words-of words-of-answer))
  #:use-module ((bight view text) #:select (terminal-columns))
  #:use-module (ice-9 regex)
  #:use-module (srfi srfi-1)
  #:export (prompt-table
            with-sentences
            rounded
            value->lines))

(define prompt-table
  ;; Of a value that looks best as a table: a thunk that returns (HEADS ROW ...), HEADS strings or #f.
  (make-object-property))

(define (with-sentences names sentence)
  "Return NAMES, a list of symbols, which the prompt shows with what SENTENCE, a procedure of one, says of each."
  (when (pair? names)
    (set! (prompt-table names)
          (lambda () (cons #f (map (lambda (name) (list name (or (sentence name) ""))) names)))))
  names)


;;; Numbers.

(define decimals 3)                     ; millimetres, millinewtons
(define figures 3)                      ; of what is less than one
(define least 1e-4)                     ; what is smaller is written with an exponent

(define (magnitude x)
  (inexact->exact (floor (/ (log (abs x)) (log 10)))))

(define (decimals-for size)
  ;; How many decimals numbers of at most SIZE are shown with.
  (if (or (>= size 1) (< size least)) decimals (- figures 1 (magnitude size))))

(define (trimmed text)
  ;; TEXT, a number, without zeros at its end, but for the one after its point.
  (let ((short (string-trim-right text #\0)))
    (if (string-suffix? "." short) (string-append short "0") short)))

(define (with-exponent x)
  (let* ((power (magnitude x)) (text (trimmed (fixed (/ (inexact->exact x) (expt 10 power)) (- figures 1)))))
    (if (string-prefix? "10." (string-trim text #\-))
        (with-exponent (* x (+ 1 (expt 10. (- figures)))))
        (string-append text "e" (number->string power)))))

(define (plain? x)
  ;; Is X shown as it is?
  (or (exact? x) (nan? x) (inf? x) (zero? x) (>= (abs x) 1e15)))

(define (rounded x)
  "Return the real number X as the prompt shows it, a string."
  (cond ((plain? x) (number->string x))
        ((< (abs x) least) (with-exponent x))
        (else (trimmed (fixed x (decimals-for (abs x)))))))

(define (size-of numbers)
  (fold (lambda (x size) (if (plain? x) size (max size (abs x)))) 0 numbers))

(define (alike numbers)
  ;; NUMBERS, strings, with as many decimals as the largest needs.
  (let* ((size (size-of numbers)) (places (decimals-for size)))
    (map (lambda (x)
           (cond ((or (exact? x) (nan? x) (inf? x) (>= (abs x) 1e15)) (number->string x))
                 ((and (< 0 size least) (not (zero? x))) (with-exponent x))
                 (else (fixed x places))))
         numbers)))


;;; Text: numbers with more digits than they mean are rounded in whatever prints.

(define long-number (make-regexp "[-+]?[0-9]+\\.[0-9]+(e[-+]?[0-9]+)?"))

(define string-or-word (make-regexp "\"([^\"\\\\]|\\\\.)*\"|[A-Za-z_*!?<>=/$%&][^] \t\n()\"';[]*"))

(define (long? text)
  ;; Has TEXT, a number, more digits than are shown?  What was rounded by others stays as it is.
  (let* ((end (or (string-index text #\e) (string-length text))) (dot (string-index text #\.)))
    (> (- end dot 1) decimals)))

(define (round-numbers text)
  (define (shorter m)
    (let ((number (match:substring m)))
      (if (long? number) (rounded (text->number number)) number)))
  (regexp-substitute/global #f long-number text 'pre shorter 'post))

(define (round-text text)
  ;; TEXT with its numbers rounded, but for those in strings and in names.
  (let loop ((from 0) (kept (list-matches string-or-word text)) (parts '()))
    (if (null? kept)
        (string-concatenate-reverse (cons (round-numbers (substring text from)) parts))
        (loop (match:end (car kept)) (cdr kept)
              (cons* (match:substring (car kept)) (round-numbers (substring text from (match:start (car kept))))
                     parts)))))


;;; Columns.

(define most-rows 24)                  ; of a table of numbers
(define last-rows 6)                    ; of one that is cut

(define (cell->string cell)
  (cond ((real? cell) (rounded cell))
        ((string? cell) (string-join (string-tokenize cell)))
        ((not cell) "-")
        (else (round-text (simple-format #f "~a" cell)))))

(define (column head cells)
  ;; HEAD, a string or #f, and CELLS as strings of one width: numbers alike, and to the right.
  (let* ((numbers? (every real? cells))
         (texts (append (if head (list head) '()) (if numbers? (alike cells) (map cell->string cells))))
         (width (apply max 0 (map string-length texts))))
    (map (lambda (text) (if numbers? (string-pad text width) (string-pad-right text width))) texts)))

(define (shortened rows)
  ;; ROWS, the middle left out of too many numbers: (ROWS-BEFORE NUMBER-LEFT-OUT ROWS-AFTER).
  (let ((n (length rows)))
    (if (or (<= n most-rows) (not (every (lambda (row) (every real? row)) rows)))
        (list rows 0 '())
        (let ((first-rows (- most-rows last-rows 1)))
          (list (take rows first-rows) (- n first-rows last-rows) (take-right rows last-rows))))))

(define (level rows)
  ;; ROWS, all as long as the longest.
  (let ((width (apply max 0 (map length rows))))
    (map (lambda (row) (append row (make-list (- width (length row)) ""))) rows)))

(define (hung start lines)
  ;; LINES, whose last column begins at START; what is too long for the terminal goes on below it.
  (define (hang line room)
    (let ((texts (filled (substring line start) room)) (indent (make-string start #\space)))
      (cons (string-append (substring line 0 start) (car texts))
            (map (lambda (text) (string-append indent text)) (cdr texts)))))
  (let* ((long? (any (lambda (line) (> (string-length line) width)) lines))
         (room (and long? (- (terminal-columns) start))))
    (if (and room (>= room least-hung))
        (append-map (lambda (line) (if (> (string-length line) (+ start room)) (hang line room) (list line))) lines)
        lines)))

(define least-hung 30)                  ; characters of words, or there is no room for them below each other

(define (table->lines heads rows)
  (let* ((parts (shortened (level rows)))
         (shown (append (first parts) (third parts)))
         (columns (apply map (lambda (head . cells) (column head cells))
                         (or heads (map (const #f) (car shown))) shown))
         (lines (map (lambda (cells) (string-trim-right (string-append "  " (string-join cells "  "))))
                     (apply map list columns)))
         (start (fold (lambda (column from) (+ from 2 (string-length (car column)))) 2 (drop-right columns 1)))
         (before (+ (length (first parts)) (if heads 1 0))))
    (hung start
          (if (zero? (second parts))
              lines
              (append (take lines before)
                      (list (simple-format #f "  ... ~a more ..." (second parts)))
                      (drop lines before))))))


;;; Values.

(define (atom? value)
  (or (symbol? value) (number? value) (string? value) (boolean? value) (keyword? value)))

(define (row? value)
  (and (list? value) (pair? value) (pair? (cdr value)) (every atom? value)))

(define (entry? value)
  (and (pair? value) (symbol? (car value)) (or (atom? (cdr value)) (numbers? (cdr value)))))

(define (numbers? value)
  ;; Is VALUE a vector of numbers?
  (and (array? value) (= 1 (array-rank value)) (not (string? value)) (not (bitvector? value))
       (every real? (array->list value))))

(define (vector->text value)
  ;; A short vector, such as a point, on one line, so that it can be typed in again.
  (let* ((text (simple-format #f "~s" value)) (open (string-index text #\()))
    (string-append (substring text 0 (+ open 1))
                   (string-join (map trimmed-number (array->list value) (alike (array->list value))) " ")
                   ")")))

(define (trimmed-number x text)
  (if (or (exact? x) (string-index text #\e) (not (string-index text #\.))) text (trimmed text)))

(define in-a-row 8)

(define (in-rows numbers)
  ;; Rows of so many NUMBERS, each after the index of its first.
  (let loop ((rest (alike numbers)) (i 0) (rows '()))
    (if (null? rest)
        (reverse rows)
        (let ((n (min in-a-row (length rest))))
          (loop (drop rest n) (+ i n) (cons (cons i (take rest n)) rows))))))

(define (point? value)
  (and (numbers? value) (= 3 (array-length value))))

(define (table-of value)
  ;; (HEADS ROW ...) if VALUE looks best in columns, else #f.
  (cond ((and (not (immediate? value)) (prompt-table value)) => (lambda (thunk) (thunk)))
        ((and (array? value) (= 2 (array-rank value)) (every real? (concatenate (array->list value))))
         (let ((rows (array->list value)))
           (cons (and (pair? rows) (= 3 (length (car rows))) '("x" "y" "z")) rows)))
        ((and (numbers? value) (> (array-length value) in-a-row))
         (cons #f (in-rows (array->list value))))
        ((not (and (list? value) (> (length value) 1))) #f)
        ((every point? value) (cons '("x" "y" "z") (map array->list value)))
        ((every row? value) (cons #f value))
        ((every entry? value)
         (cons #f (map (lambda (entry)
                         (list (car entry) (if (numbers? (cdr entry)) (vector->text (cdr entry)) (cdr entry))))
                       value)))
        (else #f)))

(define (immediate? value)
  (or (number? value) (boolean? value) (null? value) (char? value)))

(define width 78)                       ; of lines of words

(define* (filled text #:optional (width width))
  ;; TEXT as lines of WIDTH at most, but for longer words.
  (let loop ((words (string-tokenize text)) (line #f) (lines '()))
    (cond ((null? words) (reverse (if line (cons line lines) lines)))
          ((not line) (loop (cdr words) (car words) lines))
          ((<= (+ (string-length line) 1 (string-length (car words))) width)
           (loop (cdr words) (string-append line " " (car words)) lines))
          (else (loop (cdr words) (car words) (cons line lines))))))

(define* (value->lines value #:optional question)
  "Return the lines in which the prompt shows VALUE, the answer to QUESTION if that, a symbol, is what was asked."
  (cond ((and (boolean? value) (words-of-answer question value))
         => (lambda (text) (filled (string-append (if value "#t" "#f") ": " text))))
        ((words-of-answer question value) => filled)
        (else (plain-lines value))))

(define (plain-lines value)
  ;; The lines of a VALUE that has no words of its own.
  (cond ((table-of value)
         => (lambda (table)
              (if (null? (cdr table)) (list "a table without rows") (table->lines (car table) (cdr table)))))
        ((real? value) (list (rounded value)))
        ((and (numbers? value) (positive? (array-length value))) (list (vector->text value)))
        ((string? value) (list (simple-format #f "~s" value)))
        ((verb? value) (list (simple-format #f "~a: this is how it is called" (verb-usage value))))
        (else
         (let ((text (simple-format #f "~s" value)))
           ;; What prints as a page has been laid out already.
           (if (string-index text #\newline) (string-split text #\newline) (list (round-text text)))))))
