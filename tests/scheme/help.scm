;;; What `help' says of a question is what the question returns.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?))))

(define questions
  ;; Verbs that ask: all that these modules export and the language has.
  (append-map (lambda (module)
                (filter (lambda (name)
                          (and (memq name (language-names))
                               (not (string-suffix? "!" (symbol->string name)))))
                        (module-map (lambda (name variable) name) (resolve-interface module))))
              '((bight query) (bight contact) (bight aware) (bight instruments) (bight foresight))))

(define (says? text . words)
  (any (lambda (word) (string-contains text word)) words))

(define (first-sentence text)
  (let* ((text (string-join (string-tokenize text)))
         (end (string-contains text ". ")))
    (if end (substring text 0 end) text)))

(define (row-of-numbers? rank columns)
  (lambda (value) (and (array? value) (= rank (array-rank value))
                       (or (not columns) (= columns (last (array-dimensions value)))))))

;; What the words of a docstring promise, the first that fits: a predicate.
(define promises
  `((("Return #t if" "Return #t unless" "Return #t while") . ,boolean?)
    (("alist") . ,(lambda (value) (and (list? value) (all? pair? value))))
    (("polylines") . ,list?)
    (("polyline" "n x 3") . ,(row-of-numbers? 2 3))
    ((", a list" "list of" "lists (" "a list (") . ,list?)
    (("f64vector") . ,f64vector?)
    ((", a point" ", a vector") . ,(row-of-numbers? 1 3))
    ((", m" ", N" "degrees" "whole number" "share of") . ,real?)))

(define (promise-of text)
  ;; What TEXT, the first sentence of a docstring, promises; #f if nothing that is known.
  (and=> (find (lambda (entry) (apply says? text (car entry))) promises) cdr))

(define (as-told? text value)
  (let ((promise (promise-of text)))
    (or (not promise)
        (and (says? text "or #f") (not value))
        (promise value))))

(define (told-and-not-so name)
  ;; #f, or NAME, what it says and what it returns in the present dive.
  (let* ((verb (module-ref (resolve-interface '(bight)) name #f))
         (text (and (procedure? verb) (procedure-documentation verb)))
         (value (and text
                     (with-exception-handler
                         (lambda (e) (if (bight-error? e) e (raise-exception e)))
                       (lambda () (verb))
                       #:unwind? #t))))
    (and text (not (bight-error? value)) (not (as-told? (first-sentence text) value))
         (list name (first-sentence text) value))))

(define (promise-in name)
  ;; What the help of the question NAME promises.
  (let ((text (procedure-documentation (module-ref (resolve-interface '(bight)) name))))
    (and text (promise-of (first-sentence text)))))

(define-scenario (help-says-what-is-returned model)
  "Each question returns what the first sentence of its help says, or is refused, with every model."
  #:for ((model 'rubber-band 'steady 'dynamic))
  (in (with pile (line (model ,model) (nodes 16))))
  (run 1)
  (expect (length questions) is (above 80))
  (expect (length (filter promise-in questions)) is (above 70))
  (expect (as-told? "Return the depth of the vehicle, m." 'deep) => #f)
  (for-each (lambda (question) (expect (told-and-not-so question) => #f)) questions))
