;;; (bight types) --- types of tethers and vehicles: named sets of fields, and those that come with bight.
;;;
;;; Figures marked `estimate' in a type's sentence were not read in a source; override them when you know
;;; better.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight types)
  #:use-module (bight clause)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight schema)
  #:use-module (bight verb)
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

(define (base-fields proc head likes)
  (cond ((null? likes) '())
        ((and (null? (cdr likes)) (list? (car likes)) (= 2 (length (car likes))))
         (part-type-fields (find-part-type proc head (second (car likes)))))
        (else (bight-raise 'def proc "a type is like one other, as in (like fathom), not ~s" likes))))

(define (define-part-type proc head name sentence clauses)
  "Make the type NAME of parts with HEAD known: SENTENCE says what it is, CLAUSES is a list of data
(FIELD VALUE ...), and (like OTHER).  Return NAME.  Raise a &bight-error from PROC when a field is wrong."
  (let* ((likes (filter like-clause? clauses))
         (own (read-fields proc head (remove like-clause? clauses)))
         (odd (find (lambda (entry)
                      (or (memq (car entry) never-of-a-type)
                          (and (eq? head 'tether) (memq (car entry) (inner-heads head)))))
                    own)))
    (when odd
      (bight-raise 'def proc "~a belongs to a part of a world, not to a type" (car odd)))
    (add-part-type!
     (make-part-type head name sentence (merge-fields own (base-fields proc head likes))))
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

(define-tether-type fathom
  "Blue Robotics Fathom R2: 7.6 mm, floats a little in the sea; stiffness, friction, bend estimates."
  (diameter 0.0076) (mass 0.043) (breaking-load 1557)
  (cdn 1.2) (cdt 0.01) (ca 1)
  (ea 1e5) (friction 0.3) (min-bend-radius 0.05))

(define-tether-type fathom-slim
  "Blue Robotics Fathom Slim: 4 mm, one pair; all but the diameter estimates."
  (like fathom)
  (diameter 0.004) (mass 0.014) (breaking-load 785) (ea 5e4) (min-bend-radius 0.03))

(define-tether-type falcon
  "Seaeye Falcon umbilical: 14.5 mm, neutral; estimates throughout."
  (like fathom)
  (diameter 0.0145) (wet-weight 0) (breaking-load 5000) (ea 2e5) (min-bend-radius 0.1))

(define-tether-type cat5e
  "Direct-burial network cable: 0.0285 N/m weighed in the sea; the rest estimates."
  (like fathom)
  (diameter 0.006) (wet-weight 0.0285) (breaking-load 200) (ea 5e4) (min-bend-radius 0.04))

(define-tether-type work-umbilical
  "Armoured umbilical of a work-class vehicle: 30 mm, 2.5 kg/m; estimates from typical ranges."
  (diameter 0.030) (mass 2.5) (breaking-load 250000)
  (cdn 1.5) (cdt 0.01) (ca 1)
  (ea 1e7) (friction 0.3) (min-bend-radius 0.5))

(define-tether-type leaded-rope
  "Leaded rope, cable 6 of the Toulon experiments (Filliung 2024), fitted; strength, stiffness estimates."
  (diameter 0.0035) (mass 0.0517) (wet-weight 0.40) (breaking-load 1000)
  (cdn 1.3) (cdt 0.01) (ca 1)
  (ea 5e4) (friction 0.3) (min-bend-radius 0.02))

(define-vehicle kinematic
  "A vehicle without forces: it goes exactly where it is told.")

;; Those whose figures the engine has.
(for-each (lambda (type)
            (add-part-type! (make-part-type 'rov (first type) (second type) (third type))))
          (%vehicle-types))
