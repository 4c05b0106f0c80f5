;;; (bight core datum) --- data that others wrote, read within limits.
;;;
;;; Guile's reader believes what it reads: an array literal of twenty characters names a size of gigabytes,
;;; a number of a million digits takes minutes, parentheses nest until memory is out.  Text from a file is
;;; therefore looked at before it is read: how deep it nests, how long its names and numbers are, and that
;;; it says no more than `write' says of lists, vectors, strings, symbols, keywords, characters, booleans and
;;; numbers, whose size is that of the text.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core datum)
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (why-not))
  #:use-module ((ice-9 textual-ports) #:select (get-string-all))
  #:export (plain-text? text->datum read-forms))

(define deepest 100)                    ; parentheses within each other
(define longest-word 1000)              ; characters of a name or a number

(define (delimiter? c)
  (or (char-whitespace? c) (memv c '(#\( #\) #\[ #\] #\" #\;))))

(define (after-word text at)
  ;; Where the word at AT ends.
  (or (string-index text delimiter? at) (string-length text)))

(define (after-short-word text at)
  ;; The same, or #f when it is too long.
  (let ((end (after-word text at)))
    (and (<= (- end at) longest-word) end)))

(define (after-string text at)
  ;; Where the string whose first character is at AT ends; at the end of TEXT when it is cut off.
  (let ((next (and (<= at (string-length text))
                   (string-index text (lambda (c) (memv c '(#\" #\\))) at))))
    (cond ((not next) (string-length text))
          ((char=? #\" (string-ref text next)) (+ next 1))
          (else (after-string text (+ next 2))))))

(define (after-line text at)
  (or (string-index text #\newline at) (string-length text)))

(define (vector-head? word)
  ;; Does WORD, between a # and a parenthesis, begin a vector or an array of its elements' own size?
  (let ((tag (if (and (positive? (string-length word)) (char-numeric? (string-ref word 0)))
                 (substring word 1)
                 word)))
    (member tag '("" "f32" "f64" "u8" "s8" "u16" "s16" "u32" "s32" "u64" "s64" "vu8"))))

(define (after-hash text at)
  ;; Where what begins with the # at AT may go on, or #f.
  (let* ((end (after-word text (+ at 1))) (word (substring text (+ at 1) end)))
    (cond ((member word '("t" "f" "true" "false" "nil")) end)
          ((string-prefix? ":" word) (after-short-word text at))
          ((string-prefix? "\\" word) (after-word text (min (+ at 3) (string-length text))))
          ((string-prefix? "{" word)
           (let ((close (string-contains text "}#" at)))
             (and close (<= (- close at) longest-word) (+ close 2))))
          ((and (< end (string-length text)) (char=? #\( (string-ref text end)) (vector-head? word))
           end)
          (else #f))))

(define (plain-text? text)
  "Return #t if TEXT can be read at a cost in proportion to its length, as data without end marks."
  (let ((n (string-length text)))
    (let loop ((at 0) (depth 0))
      (if (not (and at (<= depth deepest)))
          #f
          (if (>= at n)
              #t
              (let ((c (string-ref text at)))
                (case c
                  ((#\( #\[) (loop (+ at 1) (+ depth 1)))
                  ((#\) #\]) (loop (+ at 1) (- depth 1)))
                  ((#\") (loop (after-string text (+ at 1)) depth))
                  ((#\;) (loop (after-line text at) depth))
                  ((#\#) (loop (after-hash text at) depth))
                  ((#\' #\` #\, #\|) #f)
                  (else
                   (if (char-whitespace? c)
                       (loop (+ at 1) depth)
                       (loop (after-short-word text at) depth))))))))))

(define* (text->datum text #:optional (otherwise #f))
  "Return the first datum of TEXT, the eof object when there is none; OTHERWISE when it is not plain, or
cannot be read."
  (if (plain-text? text)
      (catch #t
        (lambda () (call-with-input-string text read))
        (lambda args otherwise))
      otherwise))

(define (text-of proc file)
  (catch 'system-error
    (lambda () (call-with-input-file file get-string-all #:encoding "UTF-8"))
    (lambda args
      (bight-raise 'io proc "cannot read ~s: ~a" file (why-not file args)))))

(define (read-forms proc file heading what)
  "Return the data in FILE behind HEADING, the datum with which WHAT, a string such as \"mapping\", begins.  Raise a
&bight-error from PROC unless FILE can be read, is plain, and begins so."
  (let ((forms (text->datum (string-append "(" (text-of proc file) "\n)"))))
    (unless (and (pair? forms) (list? forms) (equal? heading (car forms)))
      (bight-raise 'format proc "~a is no ~a that can be read: it begins with ~s" file what heading))
    (cdr forms)))
