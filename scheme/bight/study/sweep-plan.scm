;;; (bight study sweep-plan) --- what a result says of its study: which results may be put together.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-plan)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (make-plan
            plan?
            plan-name
            plan-facts
            plan-fact
            plan-kind
            check-same))

(define-record <plan>
  (make-plan facts)
  plan?
  (facts plan-facts))                   ; an alist of symbols and data

(define (plan-fact plan name)
  "Return what PLAN says about NAME: name, sentence, text, world, version, variables, spread, measures,
legs or cases."
  (assq-ref (plan-facts plan) name))

(define (plan-kind plan name)
  "Return what the values of the measure NAME of PLAN were so far, boolean, number or text, or #f when that is
not known: no case was flown, or by an older bight."
  (assq-ref (or (plan-fact plan 'kinds) '()) name))

(define (plan-name plan)
  "Return the name of the study of PLAN."
  (plan-fact plan 'name))

(define identity                        ; what two sweeps must share, and what it is called
  '((name . "a study of another name")
    (text . "another text of the study")
    (world . "another world")
    (version . "another version of bight")
    (variables . "other variables")
    (measures . "other measures")
    (legs . "other legs")))

(define (difference ours theirs)
  ;; What sets the plans apart, a string, or #f.
  (any (lambda (entry)
         (and (not (equal? (plan-fact ours (car entry)) (plan-fact theirs (car entry))))
              (cdr entry)))
       identity))

(define (check-same file ours theirs)
  "Raise a &bight-error unless the result FILE, of the plan THEIRS, can hold cases of the plan OURS."
  (let ((other (difference ours theirs)))
    (when other
      (bight-raise 'stale 'sweep "~s is the result of ~a (~a, bight ~a), and is not mixed: \
name another result with -o, or move that one away" file other (plan-name theirs)
                   (plan-fact theirs 'version)))))
