;;; (bight cockpit palette) --- what the terminal shows: how many colours, and whether more letters than those of ASCII.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit palette)
  #:use-module (srfi srfi-1)
  #:export (palette-of this-palette ascii-terminal?))

(define (says? text word) (and text (string-contains-ci text word) #t))

(define (palette-of term colorterm no-color)
  "Return the palette of a terminal whose environment says TERM, COLORTERM and NO_COLOR, strings or #f:
true, many, few or none."
  (cond ((and no-color (not (string-null? no-color))) 'none)
        ((or (member colorterm '("truecolor" "24bit")) (says? term "direct")) 'true)
        ((says? term "256color") 'many)
        ((or (not term) (string-prefix? "vt" term) (says? term "mono")) 'none)
        (else 'few)))

(define (this-palette)
  "Return the palette of this terminal by its environment."
  (palette-of (getenv "TERM") (getenv "COLORTERM") (getenv "NO_COLOR")))

(define (ascii-terminal?)
  "Return #t if the locale of the environment has no UTF-8."
  (let ((locale (find (lambda (text) (and text (not (string-null? text))))
                      (map getenv '("LC_ALL" "LC_CTYPE" "LANG")))))
    (not (or (says? locale "UTF-8") (says? locale "UTF8")))))
