;;; (bight view asking) --- questions to a dive that may have no answer.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view asking)
  #:use-module (bight core errors)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:export (answer
            ask
            vehicles
            tethers
            point->list))

(define-syntax-rule (answer expression)
  ;; The value of EXPRESSION, or #f if the dive cannot tell.
  (with-exception-handler
      (lambda (exception)
        (if (bight-error? exception) #f (raise-exception exception)))
    (lambda () expression)
    #:unwind? #t))

(define (ask name . arguments)
  ;; As `answer', for a query that the language may not have yet.
  (let ((variable (module-variable (resolve-interface '(bight)) name)))
    (and variable (answer (apply (variable-ref variable) arguments)))))

(define (vehicles proc)
  (%names (this-engine proc) 'rov))

(define (tethers proc)
  (%names (this-engine proc) 'tether))

(define (point->list p)
  (if (list? p) p (array->list p)))
