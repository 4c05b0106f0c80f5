;;; How values look at the prompt: rounded, in columns, and never otherwise than they are.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight view looks)
             (ice-9 regex)
             ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?)))
             (srfi srfi-4))

(define (any-number)
  "Return a number of any size, and of either sign."
  (* (if (zero? (random 2)) -1 1) (+ 1 (random:uniform)) (expt 10. (- (random 30) 14))))

(define (error-allowed x)
  "Return by how much the text of X may differ from X."
  (if (>= (abs x) 1) 0.000501 (* 0.00501 (abs x))))

(define (long-numbers text)
  "Return the numbers in TEXT with more than three decimals that are not those of a number below 1."
  (filter (lambda (number) (and (> (abs (string->number number)) 1)
                                (> (string-length (cadr (string-split number #\.))) 3)))
          (map match:substring (list-matches "[0-9]+\\.[0-9]+" text))))

(define-scenario numbers-are-rounded
  "A number is shown to the third decimal, one below 1 to three figures, whatever its size."
  (do ((i 0 (+ i 1)))
      ((= i 2000))
    (let* ((x (any-number)) (text (rounded x)))
      (require (string->number text) is (about x #:within (error-allowed x)))
      (require (<= (string-length (string-trim (if (< (abs x) 1e14) text "") #\-)) 20))
      (require (long-numbers text) => '())))
  (expect (map rounded (list 0.354123 12.3456 20. -0.00061 7.43066e-7 1/3 42 1e-17 9.99999e-5 0.99999 0.))
          => '("0.354" "12.346" "20.0" "-0.00061" "7.43e-7" "1/3" "42" "1.0e-17" "1.0e-4" "1.0" "0.0"))
  (expect (map rounded (list +inf.0 +nan.0)) => '("+inf.0" "+nan.0")))

(define (columns-of line)
  "Return where the words of LINE end."
  (map match:end (list-matches "[^ ]+" line)))

(define-scenario tables-are-straight
  "The rows of a table of numbers end in the same columns, and each number is the one that it stands for."
  (for-each
   (lambda (n)
     (let* ((rows (map (lambda (i) (map (lambda (j) (* 100 (random:normal))) (iota 3))) (iota n)))
            (lines (value->lines (list->typed-array 'f64 2 rows)))
            (shown (filter (lambda (line) (not (string-contains line "more"))) lines)))
       (expect (length (delete-duplicates (map columns-of shown))) => 1)
       (expect (<= (length lines) 25) => #t)
       (expect (map string->number (string-tokenize (cadr lines)))
               is (lambda (row) (all? (lambda (a b) (< (abs (- a b)) 0.00051)) row (car rows))))
       (expect (map string->number (string-tokenize (last lines)))
               is (lambda (row) (all? (lambda (a b) (< (abs (- a b)) 0.00051)) row (last rows))))))
   '(1 2 24 25 300))
  (expect (value->lines '((arrived 26.0166 minnow) (touched 7. line p1)))
          => '("  arrived  26.017  minnow" "  touched   7.000  line    p1"))
  (expect (value->lines '((kinetic . 1.5) (strain . 20.25))) => '("  kinetic   1.500" "  strain   20.250")))

(define-scenario points-can-be-typed-in-again
  "A point is shown on one line, as it is written."
  (expect (value->lines (vec 1.23456 -2 3e-17)) => '("#f64(1.235 -2.0 0.0)"))
  (expect (value->lines #(1 2 3)) => '("#(1 2 3)")))

(define-scenario names-and-strings-are-left-alone
  "What stands in a string or in a name is no number; what others rounded stays as it is."
  (in pile)
  (expect (value->lines '(a1.23456 "b 1.23456" 1.23456)) => '("(a1.23456 \"b 1.23456\" 1.235)"))
  (expect (value->lines "1.23456") => '("\"1.23456\""))
  (expect (string-join (value->lines (status)) "\n") => (object->string (status))))

(define-scenario every-answer-has-a-look
  "Whatever a question returns can be shown, in lines that have no long numbers, and is as it was afterwards."
  (in pile)
  (run 5.3)
  (for-each (lambda (name)
              (let* ((question (module-ref (resolve-interface '(bight)) name))
                     (value (false-if-exception (question)))
                     (before (object->string value)))
                (when value
                  (expect (append-map long-numbers (value->lines value)) => '())
                  (expect (string=? before (object->string value)) => #t))))
            (filter (lambda (name) (not (string-suffix? "!" (symbol->string name))))
                    (append-map (lambda (module)
                                  (filter (lambda (name) (memq name (language-names)))
                                          (module-map (lambda (name variable) name) (resolve-interface module))))
                                '((bight dive query) (bight dive contact) (bight dive aware) (bight dive figures) (bight dive instruments))))))
