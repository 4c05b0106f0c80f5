;;; (bight cockpit page) --- text for a screen: lines that fit its width, pages that fit its height.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit page)
  #:use-module (bight cockpit cells)
  #:use-module ((bight cockpit desk) #:select (wrap))
  #:use-module (srfi srfi-1)
  #:export (first-page last-lines))

(define columned (make-regexp "(^|[^.!?:]) {2}"))

(define (drawing? line)
  ;; Does LINE stand in columns?  Blanks behind the end of a sentence, and lines that are broken, are running text.
  (and (not (string-index line #\newline)) (regexp-exec columned line)))

(define (fitted-lines lines columns)
  ;; LINES for a box on a screen of COLUMNS, as wide as the drawings among them; running text is wrapped.
  (let ((width (max 1 (min (- columns 4) (apply max 76 (map string-length (filter drawing? lines)))))))
    (append-map (lambda (line)
                  (if (and (<= (string-length line) width) (not (string-index line #\newline)))
                      (list line)
                      (wrap line width)))
                lines)))

(define (page-rows)
  (max 1 (- (cdr (%screen-size)) 3)))

(define (first-page lines)
  "Return two values: what of LINES, strings, fits on the screen as it is now, as lines that fit; and the rest."
  (let ((fitted (fitted-lines lines (car (%screen-size)))) (room (page-rows)))
    (if (<= (length fitted) room)
        (values fitted '())
        (values (list-head fitted room) (drop-while string-null? (list-tail fitted room))))))

(define (last-lines lines)
  "Return what of LINES, strings, fits on the screen as it is now, where their end is what matters, as lines that fit."
  (let ((fitted (fitted-lines lines (car (%screen-size)))))
    (take-right fitted (min (length fitted) (page-rows)))))
