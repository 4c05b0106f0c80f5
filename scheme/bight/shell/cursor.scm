;;; (bight shell cursor) --- where the cursor is in what is being typed: in which forms, behind which arguments.
;;;
;;; What is typed is no datum yet, so it is read by its characters.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell cursor)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (cursor-after
            cursor?
            cursor-word
            cursor-mark
            cursor-frames
            frame?
            frame-head
            frame-items
            indentation-after))

(define-record <cursor>
  (make-cursor word mark frames)
  cursor?
  (word cursor-word)                    ; what of the word at the cursor is there already
  (mark cursor-mark)                    ; the character before it: ', " for a string, ; for a comment; or #f
  (frames cursor-frames))               ; the forms that are open, the innermost first

(document
 (cursor? "Return true if OBJECT is a cursor.")
 (cursor-word "Return what of the word at CURSOR is there already, a string.")
 (cursor-mark "Return the character that marks the word at CURSOR: a quote, a string's or a comment's, or #f.")
 (cursor-frames "Return the forms that are open at CURSOR, the innermost first."))

(define-record <frame>
  (make-frame column items first-argument)
  frame?
  (column frame-column)                 ; of its parenthesis
  (items %frame-items)                  ; what is complete in it, as written, the last first
  (first-argument frame-first-argument)) ; the column of its second item, if that is on the line of the first

(document
 (frame? "Return true if OBJECT is a form that is open at a cursor."))

(define (frame-items frame)
  "Return what is complete in FRAME, strings as they were written, in order."
  (reverse (%frame-items frame)))

(define (frame-head frame)
  "Return the first item of FRAME, a symbol, or #f."
  (let ((items (frame-items frame)))
    (and (pair? items) (string->symbol (car items)))))

(define (with-item frame item column)
  (make-frame (frame-column frame)
              (cons item (%frame-items frame))
              (if (= 1 (length (%frame-items frame))) column (frame-first-argument frame))))

(define (with-item-in frames item column)
  (if (null? frames) '() (cons (with-item (car frames) item column) (cdr frames))))

(define (ends-word? c)
  (or (char-whitespace? c) (memv c '(#\( #\) #\[ #\] #\" #\;))))

(define (word-end text from)
  (or (string-index text ends-word? from) (string-length text)))

(define (string-end text from)
  ;; Where the string whose text begins at FROM ends, after its quote, or #f.
  (let loop ((i from))
    (cond ((>= i (string-length text)) #f)
          ((char=? #\\ (string-ref text i)) (loop (+ i 2)))
          ((char=? #\" (string-ref text i)) (+ i 1))
          (else (loop (+ i 1))))))

(define (column-of text i)
  (- i (+ 1 (or (string-rindex text #\newline 0 i) -1))))

(define (cursor-after text)
  "Return the cursor that stands after TEXT, what was typed of a form."
  (define end (string-length text))
  (define (at i mark frames)
    (if (>= i end)
        (make-cursor "" mark frames)
        (let ((c (string-ref text i)))
          (cond ((char-whitespace? c) (at (+ i 1) #f frames))
                ((memv c '(#\( #\[))
                 (at (+ i 1) #f (cons (make-frame (column-of text i) '() #f) frames)))
                ((memv c '(#\) #\]))
                 (at (+ i 1) #f
                     (if (null? frames)
                         '()
                         (with-item-in (cdr frames) "()" (frame-column (car frames))))))
                ((memv c '(#\' #\` #\,)) (at (+ i 1) c frames))
                ((char=? c #\;)
                 (let ((line-end (string-index text #\newline i)))
                   (if line-end (at line-end #f frames) (make-cursor "" #\; frames))))
                ((char=? c #\") (after-string (+ i 1) frames))
                (else (after-word i mark frames))))))
  (define (after-string i frames)
    (let ((string-end (string-end text i)))
      (if string-end
          (at string-end #f (with-item-in frames (substring text (- i 1) string-end) (column-of text (- i 1))))
          (make-cursor (substring text i) #\" frames))))
  (define (after-word i mark frames)
    ;; A character such as #\( is one word.
    (let* ((from (if (string-prefix? "#\\" (substring text i)) (min end (+ i 3)) i))
           (word-end (word-end text from))
           (word (substring text i word-end)))
      (if (= word-end end)
          (make-cursor word mark frames)
          (at word-end #f
              (with-item-in frames (if mark (string-append (string mark) word) word) (column-of text i))))))
  (at 0 #f '()))

;; The forms whose body is indented by two.
(define bodies
  '(define define* lambda lambda* let let* letrec when unless cond case do begin define-syntax-rule
    define-world world extend with define-scenario define-property define-lesson define-study define-pilot
    what-if with-dive with-pilot every every-seconds))

(define (indentation-after text)
  "Return how many spaces the line that follows TEXT begins with."
  (let ((frames (cursor-frames (cursor-after (string-append text "\n")))))
    (if (null? frames)
        0
        (let ((frame (car frames)))
          (cond ((null? (%frame-items frame)) (+ 1 (frame-column frame)))
                ((memq (frame-head frame) bodies) (+ 2 (frame-column frame)))
                ((frame-first-argument frame))
                (else (+ 1 (frame-column frame))))))))
