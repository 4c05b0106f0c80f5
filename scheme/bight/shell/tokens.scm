;;; (bight shell tokens) --- what is being typed, as tokens: parentheses, strings, comments, words.
;;;
;;; What is typed is no datum yet, so it is read by its characters.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell tokens)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (tokens
            token?
            token-kind
            token-from
            token-to
            token-text
            partners))

(define-record <token>
  (make-token kind from to)
  token?
  (kind token-kind)
  (from token-from)
  (to token-to))

(document
 (token? "Return true if OBJECT is a token.")
 (token-kind "Return what TOKEN is: open, close, mark (a quote of any sort), comment, string, open-string or word.")
 (token-from "Return the index of the first character of TOKEN.")
 (token-to "Return the index after the last character of TOKEN."))

(define (token-text token text)
  "Return what stands at TOKEN in TEXT."
  (substring text (token-from token) (token-to token)))

(define (ends-word? c)
  (or (char-whitespace? c) (memv c '(#\( #\) #\[ #\] #\" #\;))))

(define (word-end text from)
  ;; A character such as #\( is one word.
  (let ((inside (if (string-prefix? "#\\" (substring text from)) (min (string-length text) (+ from 3)) from)))
    (or (string-index text ends-word? inside) (string-length text))))

(define (string-end text from)
  ;; The index after the quote that ends the string whose text begins at FROM, or #f.
  (let loop ((i from))
    (cond ((>= i (string-length text)) #f)
          ((char=? #\\ (string-ref text i)) (loop (+ i 2)))
          ((char=? #\" (string-ref text i)) (+ i 1))
          (else (loop (+ i 1))))))

(define (token-at text i)
  ;; The token of TEXT that begins at I, where no white space is.
  (let ((c (string-ref text i)) (end (string-length text)))
    (cond ((memv c '(#\( #\[)) (make-token 'open i (+ i 1)))
          ((memv c '(#\) #\])) (make-token 'close i (+ i 1)))
          ((memv c '(#\' #\` #\,)) (make-token 'mark i (+ i 1)))
          ((char=? c #\;) (make-token 'comment i (or (string-index text #\newline i) end)))
          ((char=? c #\")
           (let ((after (string-end text (+ i 1))))
             (make-token (if after 'string 'open-string) i (or after end))))
          (else (make-token 'word i (word-end text i))))))

(define (tokens text)
  "Return the tokens of TEXT, a list, in order."
  (let loop ((i 0) (found '()))
    (let ((start (string-skip text char-whitespace? i)))
      (if start
          (let ((token (token-at text start)))
            (loop (token-to token) (cons token found)))
          (reverse found)))))

(define (partners tokens)
  "Return the pairs (OPEN . CLOSE) of TOKENS that belong to each other; (#f . CLOSE) for a parenthesis that
closes nothing, (OPEN . #f) for one that nothing closes."
  (let loop ((rest tokens) (open '()) (pairs '()))
    (cond ((null? rest) (append (map (lambda (token) (cons token #f)) open) pairs))
          ((eq? 'open (token-kind (car rest))) (loop (cdr rest) (cons (car rest) open) pairs))
          ((not (eq? 'close (token-kind (car rest)))) (loop (cdr rest) open pairs))
          ((null? open) (loop (cdr rest) '() (cons (cons #f (car rest)) pairs)))
          (else (loop (cdr rest) (cdr open) (cons (cons (car open) (car rest)) pairs))))))
