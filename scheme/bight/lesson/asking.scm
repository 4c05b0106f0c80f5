;;; (bight lesson asking) --- lines that a pupil types, and probes, asked over what the vehicle's camera sees.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson asking)
  #:use-module ((bight cockpit page) #:select (last-lines))
  #:use-module (bight cockpit line)
  #:use-module (bight cockpit state)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight lesson how-it-was)
  #:use-module (bight lesson input)
  #:use-module (bight lesson lines)
  #:use-module (bight lesson probe)
  #:use-module (bight lesson seat)
  #:use-module (srfi srfi-1)
  #:export (answer-in type-in columns-now probe-in-cockpit))

(define (answer-in text choices degrees?)
  "Return the answer that TEXT, what was typed, gives: a number, or one of CHOICES, which its beginning may stand for; or
a string that says what would be one.  DEGREES? wants a bearing."
  (let ((word (string-trim-both text)))
    (if choices
        (let* ((names (map (lambda (c) (simple-format #f "~a" c)) choices))
               (fits (if (string-null? word)
                         '()
                         (keep-by-name (lambda (c name) (string-prefix? word name)) choices names)))
               (whole (find (lambda (c) (string=? word (simple-format #f "~a" c))) choices)))
          (cond (whole)
                ((= 1 (length fits)) (car fits))
                (else (string-append "one of these words: " (string-join names ", ")))))
        (let ((n (text->number word)))
          (cond ((not (and n (real? n) (finite? n))) "a number, such as 45")
                ((and degrees? (not (<= 0 n 360))) "a bearing is from 0, north, by 90, east, to 360")
                (else n))))))

(define (keep-by-name keep? items names)
  (filter-map (lambda (item name) (and (keep? item name) item)) items names))

(define (type-in line draw)
  "Return LINE as the pupil leaves it; DRAW, a procedure of a line, shows it."
  (let loop ((line line))
    (when (null? (seat-keys (the-seat))) (draw line))
    (let* ((key (next-key 0.25)) (line (if key (edit-line line key) line)))
      (if (or (line-done? line) (line-left? line)) line (loop line)))))

(define (columns-now)
  "Return how wide the screen is."
  (car (or (cockpit-size (this-cockpit)) '(80 . 24))))

(define (typed-line label lines accept)
  ;; Let the pupil type; return what ACCEPT makes of the text, unless that is a string: then it is shown.
  (waiting
   (lambda ()
     (let loop ((lines lines))
       (let ((line (type-in (empty-line)
                            (lambda (line)
                              (draw-still (last-lines lines) (prompt-shown label line (columns-now)))))))
         (if (line-left? line)
             ((leaving))
             (let ((value (accept (line-text line))))
               (if (string? value)
                   (loop (append (drop-complaint lines) (list (complaint value))))
                   value))))))))

(define (complaint text) (string-append "  -- " text))

(define (drop-complaint lines)
  (if (and (pair? lines) (string-prefix? "  -- " (last lines))) (drop-right lines 1) lines))

(define (probe-label choices degrees?)
  (cond (choices (string-append (string-join (map (lambda (c) (simple-format #f "~a" c)) choices) ", ") "> "))
        (degrees? "a bearing, degrees> ")
        (else "a number> ")))

(define (ask-probe question choices degrees?)
  (let* ((seat (the-seat)) (how (seat-pending seat)) (again? (and how (same-dive? how))))
    (when (and how (not again?))
      (show-how-it-was!))
    (keep-up!)
    (let ((lines (append (if again? (reverse (how-verdict how)) '())
                         (in-order (seat-texts seat))
                         (list (string-append "? " question)))))
      (set-texts! seat '())
      (list 'answer
            (with-look 'pilot '()
                       (lambda ()
                         (show-but-last! lines)
                         (typed-line (probe-label choices degrees?) lines
                                     (lambda (text) (answer-in text choices degrees?)))))))))

(define (probe-in-cockpit question truth choices)
  "Ask QUESTION over what the vehicle's camera sees, and return the answer."
  (let* ((degrees? (asked-in-degrees?))
         (answer (second (next-input (lambda () (ask-probe question choices degrees?))))))
    (note-how-it-was! truth answer degrees?)
    answer))
