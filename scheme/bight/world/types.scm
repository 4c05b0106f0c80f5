;;; (bight world types) --- types of tethers and vehicles: named sets of fields, and those that come with bight.
;;;
;;; Figures of tethers that are `assumed', and those of vehicles that a sentence marks as an `estimate', were not read
;;; in a source; override them when you know better.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world types)
  #:use-module (bight core clause)
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module (bight core verb)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (define-tether-type
            define-vehicle
            define-part-type
            malformed-type
            tether-types
            vehicle-types
            merge-fields))


;;; Making types.

(define (without-derived own base)
  ;; Given exactly one of mass and wet-weight, the other follows: drop what BASE says of it.
  (cond ((and (assq 'mass own) (not (assq 'wet-weight own))) (alist-delete 'wet-weight base eq?))
        ((and (assq 'wet-weight own) (not (assq 'mass own))) (alist-delete 'mass base eq?))
        (else base)))

(define (merge-fields own base)
  "Return the alist of fields OWN, and after them those of BASE that OWN leaves open."
  (append own
          (remove (lambda (entry) (assq (car entry) own))
                  (without-derived own base))))

(define never-of-a-type '(named type from to at))

(define (like-clause? clause)
  (and (pair? clause) (eq? 'like (car clause))))

(define (base-type proc head likes)
  ;; What a type is like, or #f.
  (cond ((null? likes) #f)
        ((and (null? (cdr likes)) (list? (car likes)) (= 2 (length (car likes))))
         (find-part-type proc head (second (car likes))))
        (else (bight-raise 'def proc "a type is like one other, as in (like fathom), not ~s" likes))))

(define (define-part-type proc head name sentence clauses)
  "Make the type NAME of parts with HEAD known: SENTENCE says what it is, CLAUSES is a list of data
(FIELD VALUE ...), and (like OTHER).  Return NAME.  Raise a &bight-error from PROC when a field is wrong."
  (let* ((base (base-type proc head (filter like-clause? clauses)))
         (own (read-fields proc head (remove like-clause? clauses)))
         (odd (find (lambda (entry)
                      (or (memq (car entry) never-of-a-type)
                          (and (eq? head 'tether) (memq (car entry) '(clump float)))))
                    own)))
    (when odd
      (bight-raise 'def proc "~a belongs to a part of a world, not to a type" (car odd)))
    (add-part-type!
     (make-part-type head name sentence (merge-fields own (if base (part-type-fields base) '()))
                     (remove (lambda (entry) (assq (car entry) own)) (if base (part-type-origins base) '()))))
    name))

(define (malformed-type proc form)
  "Raise the &bight-error for FORM, the data of a definition that is not one."
  (bight-raise 'def proc "a type is written (~a NAME \"What it is.\" (FIELD VALUE) ...), not ~s" proc form))

(define-syntax-rule (define-type-definer definer head doc)
  (define-syntax definer
    (lambda (form)
      doc
      (syntax-case form ()
        ((_ name sentence clause (... ...))
         (and (identifier? #'name) (string? (syntax->datum #'sentence)))
         #`(define-part-type 'definer 'head 'name sentence
             (list #,@(map (lambda (clause) (clause->expression 'head clause))
                           #'(clause (... ...))))))
        (_ #`(malformed-type 'definer '#,form))))))

(define-type-definer define-tether-type tether
  "Make a type of tether: (define-tether-type NAME \"What it is.\" [(like OTHER)] (FIELD VALUE) ...).")

(define-type-definer define-vehicle rov
  "Make a type of vehicle: (define-vehicle NAME \"What it is.\" [(like OTHER)] (FIELD VALUE) ...).")

(define-verb (tether-types)
  "Return the names of the known types of tether."
  (map part-type-name (part-types 'tether)))

(define-verb (vehicle-types)
  "Return the names of the known types of vehicle."
  (map part-type-name (part-types 'rov)))


;;; Types that come with bight.

(define-vehicle kinematic
  "A vehicle without forces: it goes exactly where it is told.")

;; Those whose figures the engine has.
(define (add-types! head types)
  (for-each (lambda (type)
              (add-part-type! (make-part-type head (first type) (second type) (third type)
                                              (if (pair? (cdddr type)) (fourth type) '()))))
            types))

(add-types! 'tether (%tether-types))
(add-types! 'rov (%vehicle-types))
