;;; (bight dive in-words) --- answers about the tether as sentences, for programs and panels.
;;;
;;; The prompt shows an answer in words by itself.  Elsewhere `in-words' gives them: of an answer, or of the
;;; question by its name, since an answer such as #t cannot carry words.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive in-words)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive aware)
  #:use-module (bight dive foresight)
  #:use-module (bight dive plain-words)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (in-words))

(define horizon 20)                     ; s: of what is to come, asked by its name

(define questions
  ;; Each with how it is asked of a tether, by its name.
  `((way-home . ,way-home) (unwind-plan . ,unwind-plan) (haul-prospect . ,haul-prospect)
    (free-to-haul? . ,free-to-haul?) (homotopy-class . ,homotopy-class) (windings . ,windings)
    (foresee . ,(lambda (tether) (foresee tether horizon)))))

(define-argument-type (answer value)
  "an answer of way-home, unwind-plan, haul-prospect, homotopy-class, windings, foresee or slack-to-reach, or the name
of such a question: (in-words 'way-home), (in-words 'free-to-haul?)"
  (if (or (assq value questions) (words-of value)) value refused))

(define-verb (in-words #:subject (t tether) (answer answer))
  "Return ANSWER, what a question about the tether returned, as sentences: a string.  The name of a question asks
it: way-home, unwind-plan, haul-prospect, free-to-haul?, homotopy-class, windings, or foresee, which looks 20 s
ahead."
  (let ((ask (assq-ref questions answer)))
    (if ask
        (words-of-answer answer (ask (list-ref (%names (this-engine 'in-words) 'tether) t)))
        (words-of answer))))
