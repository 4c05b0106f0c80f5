;;; (bight world waves) --- waves of the sea, from what a person writes to what the engine takes.
;;;
;;;   (airy (height M) (period S) (toward B) (phase D))        one regular wave; phase in degrees, 0: a
;;;                                                            crest at the origin as the dive begins
;;;   (jonswap (height M) (period S) (toward B) (gamma G) (components N) (seed N) (accuracy A))
;;;                                                            a wind sea: significant height, peak period;
;;;                                                            how exact lines are asked it to be, 0: exact
;;;   none
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world waves)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module ((bight world current) #:select (clause-fields clause-field))
  #:use-module (srfi srfi-1)
  #:export (wave-forms
            wave-field-names
            parse-waves
            waves->numbers
            waves->string))

(define wave-forms '(airy jonswap none))

(define wave-field-names '(height period toward phase gamma components seed accuracy))

(define type:height (type:between 0 40))
(define type:period (type:between 1/2 60))
(define type:phase (type:between -360 360))
(define type:gamma (type:between 1 10))
(define type:components (type:between 2 64))
(define type:seed (type:between 0 1000000000))
(define type:accuracy (type:between 0 1/10))

(define (form-waves proc form clauses)
  ;; Bare values stand in the order of the canonical form, so that this can be read, too.
  (let* ((names (if (eq? form 'airy)
                    '(height period toward phase)
                    '(height period toward gamma components seed accuracy)))
         (found (clause-fields proc form names names clauses)))
    (define (field name type . default)
      (apply clause-field proc form found name type default))
    (cons* form
           (field 'height type:height) (field 'period type:period) (field 'toward type:bearing 0.0)
           (if (eq? form 'airy)
               (list (field 'phase type:phase 0.0))
               (list (field 'gamma type:gamma 3.3) (field 'components type:components 32.0)
                     (field 'seed type:seed 1.0) (field 'accuracy type:accuracy 1e-4))))))

(define (refuse-waves proc datum)
  (bight-raise 'domain proc
               "waves are none, (airy (height M) (period S) (toward B)) or (jonswap (height M) (period S) (toward B) (seed N)), not ~s"
               datum))

(define (parse-waves proc datum)
  "Return the canonical form of the waves that DATUM describes: (none), (airy HEIGHT PERIOD TOWARD PHASE)
or (jonswap HEIGHT PERIOD TOWARD GAMMA COMPONENTS SEED ACCURACY), in metres, seconds and degrees.  Raise a
&bight-error from PROC when it describes none."
  (let ((items (and (pair? datum) (bounded-list datum 20))))
    (cond ((memq datum '(none #f)) '(none))
          ((equal? items '(none)) '(none))
          ((not (and items (symbol? (car items)))) (refuse-waves proc datum))
          ((memq (car items) '(airy jonswap)) (form-waves proc (car items) (cdr items)))
          (else (unknown-name proc "the sea" (car items) wave-forms "kind of waves")))))

(define degree (/ (acos -1) 180))

(define (waves->numbers waves)
  "Return the numbers of the canonical WAVES for the engine: kind height period toward phase gamma
components seed accuracy, in radians."
  (case (car waves)
    ((airy) (let ((w (cdr waves)))
              (list 1 (first w) (second w) (* degree (third w)) (* degree (fourth w)) 3.3 2 0 0)))
    ((jonswap) (let ((w (cdr waves)))
                 (list 2 (first w) (second w) (* degree (third w)) 0
                       (fourth w) (round (fifth w)) (round (sixth w)) (seventh w))))
    (else (list 0 0 10 0 0 3.3 2 0 0))))

(define (waves->string waves)
  "Return the canonical WAVES as they would be written in a world."
  (if (eq? 'none (car waves)) "none" (brief waves)))
