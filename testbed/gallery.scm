;;; The worlds, as C: guile -s gallery.scm FOLDER... prints the tables of testbed/gallery_rows.h for the worlds
;;; in FOLDERs, of the parts that `enter!' gives to the engine.
;;;
;;; A number is written with as many digits as bring the same number back.  A world with a mesh, a bed or a
;;; current from a file, or with a current that is a procedure, is left out: the engine has those from
;;; elsewhere than from the table.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight core files) #:select (engine-parts))
             (bight core part)
             (bight core schema)
             (bight engine)
             ((bight world atlas) #:select (find-world))
             (ice-9 ftw)
             (srfi srfi-1)
             (srfi srfi-4)
             ((system foreign) #:select (pointer?)))

(define (say . parts)
  (for-each display parts)
  (newline))

(define (world-files folder)
  (map (lambda (file) (string-append folder "/" file))
       (scandir folder (lambda (name) (string-suffix? ".scm" name)))))

(define (part-entries part) (third part))

(define (from-elsewhere? parts)
  ;; Is something in PARTS held by the engine, or a procedure?
  (define (held? value)
    (if (pair? value)
        (or (held? (car value)) (held? (cdr value)))
        (or (pointer? value) (procedure? value))))
  (any (lambda (part) (held? (part-entries part))) parts))


;;; Rows.

(define (c-string object)
  (simple-format #f "~s" (if (symbol? object) (symbol->string object) object)))

(define (c-name object)
  (string-map (lambda (c) (if (char-alphabetic? c) c #\_)) (symbol->string object)))

(define (c-number x)
  (cond ((nan? x) "NAN")
        ((inf? x) (if (positive? x) "INFINITY" "-INFINITY"))
        (else (number->string (exact->inexact x)))))

(define (say-numbers name n width numbers)
  (say "  { .name = " (c-string name) ", .n = " n ", .width = " width ",")
  (say "    .numbers = (const double[]){ " (string-join (map c-number numbers) ", ") " } },"))

(define (say-values name . numbers)
  (say-numbers name 1 (length numbers) numbers))

(define (say-field engine entry)
  (let ((name (car entry)) (value (cdr entry)))
    (cond ((symbol? value)
           (say "  { .name = " (c-string name) ", .word = " (c-string value) " },"))
          ((number? value) (say-values name value))
          ((eq? name 'current)          ; as the engine took it
           (apply say-values name (f64vector->list (%current-numbers engine))))
          ((vector? value)              ; heights
           (apply say-values name
                  (append (list-head (vector->list value) 6) (f64vector->list (vector-ref value 6)))))
          ((f64vector? value) (apply say-values name (f64vector->list value)))
          (else
           (say-numbers name (car (array-dimensions value)) (cadr (array-dimensions value))
                        (concatenate (array->list value)))))))

(define (say-fields engine head entries)
  ;; What is inside the part comes after the part's own fields.
  (call-with-values (lambda () (partition (lambda (entry) (inner-head? (car entry))) entries))
    (lambda (inner own)
      (for-each (lambda (entry) (say-field engine entry)) own)
      (for-each (lambda (entry)
                  (say "  { .head = " (c-string (car entry)) " },")
                  (say-fields engine (car entry) (cdr entry)))
                inner))))

(define (say-part engine part)
  (say "  { .head = " (c-string (first part)) ", .name = " (c-string (second part)) " },")
  (say-fields engine (first part) (part-entries part)))

(define (say-world name parts)
  (let ((engine (%make-dive parts)))
    (say)
    (say "static const gallery_row " (c-name name) "[] = {")
    (for-each (lambda (part) (say-part engine part)) parts)
    (say "};")))


;;; All of them.

(define found
  ;; (NAME . PARTS) of each world.
  (map (lambda (file)
         (let ((world (find-world file #:trust #t)))
           (cons (world-name-of world) (engine-parts 'gallery world))))
       (append-map world-files (cdr (command-line)))))

(define told (remove (lambda (entry) (from-elsewhere? (cdr entry))) found))

(say "/* Made by gallery.scm.  */")
(say)
(say "#include <math.h>")
(say)
(say "#include \"testbed/gallery_rows.h\"")
(for-each (lambda (entry) (say-world (car entry) (cdr entry))) told)
(say)
(say "const gallery_table gallery_tables[] = {")
(for-each (lambda (entry)
            (say "  { " (c-string (car entry)) ", " (c-name (car entry)) ", sizeof " (c-name (car entry))
                 " / sizeof *" (c-name (car entry)) " },"))
          told)
(say "  { NULL, NULL, 0 },")
(say "};")
