;;; (bight core json) --- JSON, as much of it as reports of benchmarks and scenes in glTF need.
;;;
;;; An object is an alist with strings for keys, an array a vector, null the symbol null.  Numbers are read
;;; as inexact ones unless they are whole; what is not finite is written as null.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core json)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core errors) #:select (bight-raise))
  #:use-module ((ice-9 textual-ports) #:select (get-string-n lookahead-char))
  #:export (write-json read-json json-ref))

(define (json-ref object key)
  "Return what the JSON OBJECT has for KEY, or #f."
  (and (pair? object) (assoc-ref object key)))


;;; Writing.

(define (write-json-string text port)
  (write-char #\" port)
  (string-for-each
   (lambda (c)
     (case c
       ((#\" #\\) (write-char #\\ port) (write-char c port))
       ((#\newline) (display "\\n" port))
       ((#\tab) (display "\\t" port))
       (else
        (if (char<? c #\space)
            (simple-format port "\\u~a"
                           (string-pad (number->string (char->integer c) 16) 4 #\0))
            (write-char c port)))))
   text)
  (write-char #\" port))

(define (write-separated write-one items port)
  (let loop ((rest items) (first? #t))
    (unless (null? rest)
      (unless first? (display "," port))
      (write-one (car rest))
      (loop (cdr rest) #f))))

(define (write-number x port)
  ;; Guile writes .5 and 1. where JSON wants 0.5 and 1.0.
  (let ((text (number->string (if (exact? x) (if (integer? x) x (exact->inexact x)) x))))
    (when (string-prefix? "-" text) (write-char #\- port))
    (let ((digits (string-trim text #\-)))
      (when (string-prefix? "." digits) (write-char #\0 port))
      (display digits port)
      (when (string-suffix? "." digits) (write-char #\0 port)))))

(define (write-json value port)
  "Write VALUE to PORT; an object or an array that holds others has a line for each."
  (cond ((string? value) (write-json-string value port))
        ((and (real? value) (or (exact? value) (< -inf.0 value +inf.0))) (write-number value port))
        ((eq? value #t) (display "true" port))
        ((eq? value #f) (display "false" port))
        ((vector? value)
         (display "[" port)
         (write-separated (lambda (item)
                            (when (pair? item) (newline port))
                            (write-json item port))
                          (vector->list value) port)
         (display "]" port))
        ((pair? value)
         (display "{" port)
         (write-separated (lambda (field)
                            (write-json-string (car field) port)
                            (display ":" port)
                            (write-json (cdr field) port))
                          value port)
         (display "}" port))
        (else (display "null" port))))


;;; Reading.

(define (broken text . values)
  (apply bight-raise 'format 'bench (string-append "not JSON: " text) values))

(define (next-char port)
  ;; The next character that is not blank, left in PORT.
  (let ((c (lookahead-char port)))
    (cond ((eof-object? c) (broken "it ends too soon"))
          ((char-whitespace? c) (read-char port) (next-char port))
          (else c))))

(define (expect-char! wanted port)
  (let ((c (next-char port)))
    (unless (eqv? c wanted) (broken "~s where ~s belongs" (string c) (string wanted)))
    (read-char port)))

(define (read-escape port)
  (let ((c (read-char port)))
    (case c
      ((#\n) #\newline)
      ((#\t) #\tab)
      ((#\r) #\return)
      ((#\b) #\backspace)
      ((#\f) #\page)
      ((#\u) (let ((code (text->number (get-string-n port 4) 16)))
               (if (and code (or (< code #xd800) (> code #xdfff)))
                   (integer->char code)
                   (broken "a bad \\u"))))
      (else (if (char? c) c (broken "a string without its end"))))))

(define (read-json-string port)
  (expect-char! #\" port)
  (let loop ((chars '()))
    (let ((c (read-char port)))
      (cond ((eof-object? c) (broken "a string without its end"))
            ((eqv? c #\") (list->string (reverse chars)))
            ((eqv? c #\\) (loop (cons (read-escape port) chars)))
            (else (loop (cons c chars)))))))

(define (read-items read-one close port)
  ;; What READ-ONE reads, between commas, up to CLOSE.
  (read-char port)
  (if (eqv? close (next-char port))
      (begin (read-char port) '())
      (let loop ((items (list (read-one port))))
        (if (eqv? close (next-char port))
            (begin (read-char port) (reverse items))
            (begin (expect-char! #\, port)
                   (loop (cons (read-one port) items)))))))

(define (read-field port)
  (next-char port)
  (let ((key (read-json-string port)))
    (expect-char! #\: port)
    (cons key (read-json port))))

(define (word-char? c)
  (and (char? c) (or (char-alphabetic? c) (char-numeric? c) (memv c '(#\+ #\- #\.)))))

(define (read-word port)
  (let loop ((chars '()))
    (if (word-char? (lookahead-char port))
        (loop (cons (read-char port) chars))
        (list->string (reverse chars)))))

(define (word-value word)
  (cond ((string=? word "true") #t)
        ((string=? word "false") #f)
        ((string=? word "null") 'null)
        ((text->number word) => (lambda (x) (if (exact? x) x (exact->inexact x))))
        (else (broken "~s" word))))

(define (read-json port)
  "Read a JSON value from PORT.  Raise format where it is none."
  (case (next-char port)
    ((#\{) (read-items read-field #\} port))
    ((#\[) (list->vector (read-items read-json #\] port)))
    ((#\") (read-json-string port))
    (else (word-value (read-word port)))))
