;;; (bight shell typed) --- forms typed at the prompt, evaluated so that an error knows the line it is on.
;;;
;;; Each form has a place of its own, prompt[N] for the Nth: a procedure that was typed is told by its line, as one of
;;; a file is.  The text of each form is kept, so that ,bt can show the line.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell typed)
  #:use-module (bight core place)
  #:use-module (language scheme spec)
  #:use-module (srfi srfi-1)
  #:use-module (system base language)
  #:export (language-of-prompt
            keep-typed-text!
            typed-line
            frames-elsewhere))

(define forms 0)                        ; how many were typed

(define texts (make-hash-table))        ; place -> what was typed there

(define most-kept 1000)                 ; texts

(define (present-place)
  (simple-format #f "prompt[~a]" forms))

(define (keep-typed-text! text)
  "Remember that TEXT, of which the last form was read, was typed at the present place; a command after a comma, which
has none of its own, changes nothing."
  (hash-remove! texts (simple-format #f "prompt[~a]" (- forms most-kept)))
  (unless (hash-ref texts (present-place))
    (hash-set! texts (present-place) text)))

(define (typed-line place)
  "Return the line that was typed at PLACE, (FILE . LINE), or #f."
  (let ((text (hash-ref texts (car place))))
    (and text
         (let ((lines (string-split text #\newline)))
           (and (<= (cdr place) (length lines))
                (list-ref lines (- (cdr place) 1)))))))

(define (frames-elsewhere frames)
  "Return those of FRAMES, of calls, that tell more than that the form typed last was evaluated."
  (filter (lambda (frame)
            (or (cdr frame) (not (equal? (present-place) (car (car frame))))))
          frames))

(define (read-form port environment)
  ;; The next form of PORT; its lines count from the form's first.
  (set! forms (+ 1 forms))
  (set-port-filename! port (present-place))
  (set-port-line! port 0)
  ((language-reader scheme) port environment))

(define language-of-prompt
  (make-language #:name 'scheme
                 #:title "Scheme"
                 #:reader read-form
                 #:compilers (language-compilers scheme)
                 #:decompilers (language-decompilers scheme)
                 #:evaluator (lambda (form module) (evaluate-marked form (present-place)))
                 #:printer (language-printer scheme)
                 #:make-default-environment (language-make-default-environment scheme)))
