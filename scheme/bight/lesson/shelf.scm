;;; (bight lesson shelf) --- lessons as values, and the shelf they are put on as they are defined.
;;;
;;; A lesson is its clauses: those that declare something about the whole, as lists (KIND VALUE ...), and
;;; those taken in order, as one thunk.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson shelf)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core shelf)
  #:use-module (bight core verb)
  #:use-module (bight lesson skill)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (lesson? lesson-name lesson-title lesson-code lesson-location lesson-steps
            lesson-list collect-lessons register-lesson! declared))

(define-record <lesson>
  (make-lesson name title code location declarations steps)
  lesson?
  (name lesson-name)
  (title lesson-title)
  (code lesson-code)                    ; its clauses, as data
  (location lesson-location)            ; (FILE . LINE) or #f
  (declarations lesson-declarations)    ; lists (KIND VALUE ...)
  (steps lesson-steps))                 ; a thunk

(set-record-type-printer! <lesson>
  (lambda (lesson port)
    (simple-format port "#<lesson ~a: ~a>" (lesson-name lesson) (lesson-title lesson))))

(define shelf (make-shelf))

(define-verb (lesson-list)
  "Return the lessons defined so far, in order."
  (on-shelf shelf))

(define (collect-lessons thunk)
  "Call THUNK and return the lessons it defines, in order."
  (call-with-empty-shelf shelf thunk))

(define (register-lesson! name title code location declarations steps)
  "Put the lesson that these make on the shelf, in place of one with its NAME, and return it."
  (let ((lesson (make-lesson name title code location declarations steps)))
    (check-settings lesson)
    (check-limits lesson)
    (check-place lesson)
    (shelve! shelf lesson-name name (list lesson))
    lesson))

(define (declared kind lesson)
  "Return what LESSON declares of KIND, a list of lists of values."
  (filter-map (lambda (d) (and (eq? kind (car d)) (cdr d))) (lesson-declarations lesson)))

(define (check-limits lesson)
  (for-each (lambda (d)
              (unless (and (exact-integer? (car d)) (>= (car d) 0))
                (bight-raise 'def 'define-lesson "(message-limit N) takes a whole number, not ~s" (car d))))
            (declared 'message-limit lesson)))

(define (check-place lesson)
  ;; Its place on the path: a grade, and skills that there are.
  (for-each (lambda (d)
              (unless (memv (car d) grades)
                (bight-raise 'def 'define-lesson "(grade N) takes a whole number from 1 to ~a, not ~s"
                             (last grades) (car d))))
            (declared 'grade lesson))
  (for-each check-skill
            (concatenate (append (declared 'trains lesson) (declared 'needs lesson)))))

(define (check-settings lesson)
  (for-each (lambda (s)
              (unless (= 3 (length (cdr s)))
                (bight-raise 'def 'define-lesson "(setting ~a EASY NORMAL HARD) needs three values, not ~a"
                             (car s) (length (cdr s)))))
            (declared 'setting lesson)))
