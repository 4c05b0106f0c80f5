;;; (bight world data) --- a world as data that can be written, read back and checked anew.
;;;
;;; Each part is told as one would write it, (part HEAD (named N) (FIELD VALUE) ...), with its type
;;; resolved.  Nothing that is read is evaluated.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world data)
  #:use-module (bight assembly)
  #:use-module (bight core schema)
  #:use-module (srfi srfi-1)
  #:export (world->data
            data->world
            part-by-procedure
            comes-back?))

(define (special-word field value)
  ;; The symbol that the number VALUE of FIELD is written as, or VALUE.
  (let ((entry (and (number? value)
                    (find (lambda (entry) (eqv? value (cdr entry))) (field-specials field)))))
    (if entry (car entry) value)))

(define (field->data head entry)
  ;; (FIELD VALUE), or (INNER (FIELD VALUE) ...), of ENTRY of a part with HEAD.
  (let ((field (head-field head (car entry))))
    (if field
        (list (car entry) (special-word field (cdr entry)))
        (cons (car entry)
              (map (lambda (inner) (field->data (car entry) inner)) (cdr entry))))))

(define (part->data part)
  (let ((head (part-head-of part)))
    (cons* 'part head
           (append (if (eq? head 'sea) '() `((named ,(part-name-of part))))
                   (map (lambda (entry) (field->data head entry)) (all-fields part))))))

(define (world->data world)
  "Return the parts of WORLD as data, a list of (part HEAD (FIELD VALUE) ...)."
  (map part->data (world-parts-of world)))

(define (data->world name documentation file data)
  "Return the world NAME that DOCUMENTATION describes, as it was written in FILE, of DATA as
`world->data' returns it.  Raise a &bight-error when the data are wrong."
  (build-world name documentation file (map (lambda (datum) (data->part (cdr datum))) data)))

(define (contains-procedure? value)
  (cond ((procedure? value) #t)
        ((pair? value) (or (contains-procedure? (car value)) (contains-procedure? (cdr value))))
        (else #f)))

(define (part-by-procedure world)
  "Return the name of a part of WORLD of which something is given by a procedure, or #f."
  (let ((part (find (lambda (part) (contains-procedure? (all-fields part))) (world-parts-of world))))
    (and part (part-name-of part))))

(define (engine-text world)
  ;; What the engine is told of WORLD.
  (object->string (map (lambda (part) (list (part-head-of part) (part-name-of part) (all-fields part)))
                       (world-parts-of world))))

(define (comes-back? world)
  "Return #t if the data of WORLD make the same world again."
  (string=? (engine-text world)
            (engine-text (data->world (world-name-of world) #f #f (world->data world)))))
