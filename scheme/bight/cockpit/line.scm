;;; (bight cockpit line) --- a line that is typed within the cockpit, key by key.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit line)
  #:use-module ((bight cockpit desk) #:select (cut))
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (empty-line line-of line? line-text line-done? line-left? line-shown prompt-shown edit-line))

(define-record <line>
  (make-line text at state older newer)
  line?
  (text line-text)
  (at line-at)                          ; where the next character goes
  (state line-state)                    ; editing, done or left
  (older line-older)                    ; what was typed before, the last first
  (newer line-newer))                   ; of these, what was passed

(define (line-of text)
  "Return a line of TEXT with the cursor behind it."
  (make-line text (string-length text) 'editing '() '()))

(define* (empty-line #:optional (history '()))
  "Return an empty line; up and down go through HISTORY, the last first."
  (make-line "" 0 'editing history '()))

(define (line-done? line) (eq? 'done (line-state line)))
(define (line-left? line) (eq? 'left (line-state line)))

(define (line-shown line width)
  "Return what is seen of LINE in WIDTH columns, the cursor, an underscore, always among it."
  (let* ((text (string-append (substring (line-text line) 0 (line-at line)) "_"
                              (substring (line-text line) (line-at line))))
         (from (max 0 (- (+ 1 (line-at line)) width))))
    (substring text from (min (string-length text) (+ from (max 1 width))))))

(define (prompt-shown label line columns)
  "Return LABEL, and behind it what is seen of LINE, in COLUMNS; where there is little room the label is cut."
  (let* ((room (max 1 (- columns 2))) (least (min 16 (quotient (+ room 1) 2)))
         (label (cut label (- room least))))
    (string-append label (line-shown line (- room (string-length label))))))

(define* (changed line text at #:optional (state 'editing))
  (make-line text at state (line-older line) (line-newer line)))

(define (recalled line from to make)
  ;; LINE with the first of FROM in place of its text, which goes to TO.
  (if (null? from)
      line
      (make (car from) (cdr from) (cons (line-text line) to))))

(define (before line n) (substring (line-text line) 0 (max 0 (- (line-at line) n))))
(define (behind line n)
  (let ((text (line-text line)))
    (substring text (min (string-length text) (+ (line-at line) n)))))

(define (word-before line)
  ;; The characters from the beginning of the word before the cursor to it.
  (let* ((text (before line 0)) (trimmed (string-trim-right text))
         (space (string-rindex trimmed #\space)))
    (- (string-length text) (if space (+ space 1) 0))))

(define (deleted line n)
  (changed line (string-append (before line n) (behind line 0)) (max 0 (- (line-at line) n))))

(define (inserted line text)
  (changed line (string-append (before line 0) text (behind line 0)) (+ (line-at line) (string-length text))))

(define (edit-line line key)
  "Return LINE after KEY, a character, up down left right escape, or (pasted TEXT)."
  (let ((text (line-text line)) (at (line-at line)))
    (case key
      ((#\return #\newline) (changed line text at 'done))
      ((escape #\etx) (changed line text at 'left))
      ((#\eot) (if (string-null? text) (changed line text at 'left) line))
      ((#\delete #\backspace) (deleted line 1))
      ((#\etb) (deleted line (word-before line)))                        ; ^W
      ((#\nak) (changed line (behind line 0) 0))                         ; ^U
      ((#\vtab) (changed line (before line 0) at))                       ; ^K
      ((left) (changed line text (max 0 (- at 1))))
      ((right) (changed line text (min (string-length text) (+ at 1))))
      ((#\soh) (changed line text 0))                                    ; ^A
      ((#\enq) (changed line text (string-length text)))                 ; ^E
      ((up) (recalled line (line-older line) (line-newer line)
                      (lambda (text older newer)
                        (make-line text (string-length text) 'editing older newer))))
      ((down) (recalled line (line-newer line) (line-older line)
                        (lambda (text newer older)
                          (make-line text (string-length text) 'editing older newer))))
      (else
       (cond ((and (char? key) (char<=? #\space key #\~)) (inserted line (string key)))
             ((and (pair? key) (eq? 'pasted (car key))) (inserted line (second key)))
             (else line))))))
