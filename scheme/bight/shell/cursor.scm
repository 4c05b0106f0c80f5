;;; (bight shell cursor) --- where the cursor is in what is being typed: in which forms, behind which arguments.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell cursor)
  #:use-module (bight core record)
  #:use-module (bight shell tokens)
  #:use-module (srfi srfi-1)
  #:export (cursor-after
            cursor?
            cursor-word
            cursor-mark
            cursor-frames
            frame?
            frame-head
            frame-items
            indentation-after
            unfinished?))

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

(define (column-of text i)
  (- i (+ 1 (or (string-rindex text #\newline 0 i) -1))))

(define (after-token token text mark frames)
  ;; The FRAMES behind TOKEN, which is complete; MARK is the character right before TOKEN, or #f.
  (let ((column (column-of text (token-from token))) (written (token-text token text)))
    (case (token-kind token)
      ((open) (cons (make-frame column '() #f) frames))
      ((close) (if (null? frames) '() (with-item-in (cdr frames) "()" (frame-column (car frames)))))
      ((string) (with-item-in frames written column))
      ((word) (with-item-in frames (string-append (if mark (string mark) "") written) column))
      (else frames))))

(define (cursor-after text)
  "Return the cursor that stands after TEXT, what was typed of a form."
  (define end (string-length text))
  (let loop ((rest (tokens text)) (mark #f) (mark-end 0) (frames '()))
    (if (null? rest)
        (make-cursor "" (and (= mark-end end) mark) frames)
        (let* ((token (car rest)) (last? (= end (token-to token))) (written (token-text token text))
               (mark (and (= mark-end (token-from token)) mark)))
          (case (token-kind token)
            ((mark) (loop (cdr rest) (string-ref written 0) (token-to token) frames))
            ((open-string) (make-cursor (substring written 1) #\" frames))
            ((word comment)
             (cond ((not last?) (loop (cdr rest) #f 0 (after-token token text mark frames)))
                   ((eq? 'word (token-kind token)) (make-cursor written mark frames))
                   (else (make-cursor "" #\; frames))))
            (else (loop (cdr rest) #f 0 (after-token token text mark frames))))))))

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

(define (unfinished? text)
  "Return true if TEXT ends within a form or a string."
  (let ((cursor (cursor-after text)))
    (or (pair? (cursor-frames cursor)) (eqv? #\" (cursor-mark cursor)))))
