;;; (bight world current) --- currents of the sea, from what a person writes to what the engine takes.
;;;
;;; One reader serves the world's (current ...) and the verb current!.  It takes plain data:
;;;
;;;   (SPEED TOWARD)                                          the same everywhere
;;;   (profile (Z SPEED TOWARD) ...)                          rows by height
;;;   (turning (speed S) (toward B) (degrees-per-metre D))    the set turns with depth
;;;   (power SPEED TOWARD (exponent E))                       falls to nothing at the sea bed
;;;   (tide (speed S) (toward B) (period T))                  comes and goes
;;;   (grid FILE)                                             measured in space and time
;;;   (from FILE (at LATITUDE LONGITUDE) (start TIME))        of an ocean model or an ADCP, in time and depth
;;;   still, or a procedure of position and time
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world current)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core units)
  #:use-module (bight world earth)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (current-forms
            current-field-names
            from-clause-names
            current-help
            parse-current
            clause-fields
            clause-field
            current->string))

(define current-forms
  '(still uniform profile turning power tide function grid from))

(define from-clause-names '(from at start))

(define current-field-names
  '(speed toward degrees-per-metre exponent period))

(define most-rows 64)
(define tidal-period (* 12.42 3600))

(define units
  `((knots . ,knots) (inches . ,inches) (feet . ,feet) (hours . ,hours) (minutes . ,minutes)))

(define (quantity value)
  ;; VALUE, or what (hours 12.42) and the like stand for inside quoted data.
  (let ((unit (and (pair? value) (symbol? (car value)) (pair? (cdr value)) (null? (cddr value))
                   (assq-ref units (car value)))))
    (if unit (unit (cadr value)) value)))

(define (check proc what type value)
  (check-argument proc (simple-format #f "the ~a of a current" what) type (quantity value)))

(define type:speed (type:between 0 20))
(define type:turn (type:between -360 360))
(define type:exponent (type:between 0 10))
(define type:period (type:between 1 1e9))

(define (check-speed proc value)
  (check proc "speed (m/s)" type:speed value))

(define (check-toward proc value)
  (check proc "bearing (toward, degrees)" type:bearing value))


;; What a current may be, as help tells it: (FORM SENTENCE EXAMPLE) each.
(define forms
  `((still "still: no current" 'still)
    (uniform "SPEED TOWARD: the same everywhere" '(0.5 90))
    (profile "(profile (Z SPEED TOWARD) ...): rows by height; between them the velocity is linear in z, beyond \
them constant" '(profile (0 0.6 90) (-30 0.3 80)))
    (turning "(turning (speed S) (toward B) (degrees-per-metre D)): the set turns with depth"
             '(turning (speed 0.5) (toward 90) (degrees-per-metre -0.9)))
    (power "(power (speed S) (toward B) (exponent E)): falls to nothing at the sea bed"
           '(power (speed 0.5) (toward 90) (exponent 1/7)))
    (tide "(tide (speed S) (toward B) (period T)): comes and goes" '(tide (speed 0.6) (toward 90) (period (hours 12.42))))
    (grid "(grid \"FILE\"): measured in space and time, a file of the world; in a dive (grid) goes back to it" #f)
    (from "(from \"FILE\" (at LATITUDE LONGITUDE) (start \"2025-03-01T06:00Z\")): the column of an ocean model \
(NetCDF) at a place, the world's origin if none is given, or an ADCP's table (columns time, depth, speed and \
direction), from a time on, the file's first if none is given; of a world" #f)
    (function "a procedure of position and time that returns a velocity: slow"
              (lambda (position time) (vec 0.3 0.1 0)))))

(define (fields-of-forms)
  ;; (NAME UNIT TYPE DEFAULT) of each field of these.
  `((speed "m/s" ,type:speed #f)
    (toward "degrees, the bearing it sets to" ,type:bearing #f)
    (z "m, up from the surface" ,type:height #f)
    (degrees-per-metre "degrees per metre of height" ,type:turn #f)
    (exponent "" ,type:exponent "1/7")
    (period "s" ,type:period "12.42 h")))

(define (current-help)
  "Return lines that tell each form of a current with an example, and what its fields take."
  (append
   (list "Forms:")
   (append-map (lambda (form)
                 (cons (string-append "  " (second form))
                       (if (third form) (list (simple-format #f "    (current! ~a)" (brief-example (third form)))) '())))
               forms)
   (list "Fields:")
   (map (lambda (field)
          (string-append "  " (symbol->string (first field)) ": "
                         (string-join (remove string-null?
                                              (list (second field) (argument-type-sentence (third field))
                                                    (if (fourth field)
                                                        (string-append (fourth field) " when left out")
                                                        "")))
                                      "; ")))
        (fields-of-forms))))

(define (brief-example datum)
  ;; As it is typed.
  (if (and (pair? datum) (eq? 'quote (car datum)))
      (simple-format #f "'~s" (cadr datum))
      (simple-format #f "~s" datum)))


;;; Reading them.

(define (uniform proc speed toward)
  (list 'uniform (check-speed proc speed) (check-toward proc toward)))

(define (profile-row proc row)
  (let ((row* (and (pair? row) (bounded-list row 3))))
    (unless (and row* (= 3 (length row*)))
      (bight-raise 'domain proc "a row of a profile is (z speed toward), not ~s" row))
    (list (check proc "height z (m)" type:height (first row*))
          (check-speed proc (second row*))
          (check-toward proc (third row*)))))

(define type:height (type:between -12000 12000))

(define (refuse-equal-heights proc rows)
  (let loop ((rest rows))
    (unless (or (null? rest) (null? (cdr rest)))
      (when (= (first (first rest)) (first (second rest)))
        (bight-raise 'domain proc "two rows of a profile have the same height, z = ~a"
                     (first (first rest))))
      (loop (cdr rest)))))

(define (profile proc rows)
  (unless (<= 1 (length rows) most-rows)
    (bight-raise (if (null? rows) 'domain 'limit) proc
                 "a profile has 1 to ~a rows (z speed toward), not ~a" most-rows (length rows)))
  (let ((sorted (sort (map (lambda (row) (profile-row proc row)) rows)
                      (lambda (a b) (> (first a) (first b))))))
    (refuse-equal-heights proc sorted)
    (cons 'profile sorted)))

(define (clause-fields proc form allowed positional clauses)
  "Return the alist of CLAUSES, (NAME VALUE) each, of what is called FORM; bare values stand for
POSITIONAL in order.  Raise a &bight-error from PROC for a name that is not ALLOWED."
  (let loop ((rest clauses) (places positional) (found '()))
    (cond ((null? rest) found)
          ((and (pair? (car rest)) (symbol? (caar rest)) (not (assq (caar rest) units)))
           (let ((clause (and (list? (car rest)) (car rest))))
             (unless (and clause (= 2 (length clause)))
               (bight-raise 'domain proc "a field of a ~a current is (NAME VALUE), not ~s"
                            form (car rest)))
             (unless (memq (first clause) allowed)
               (unknown-name proc (simple-format #f "a ~a current" form) (first clause) allowed))
             (when (assq (first clause) found)
               (bight-raise 'domain proc "~a is given twice in a ~a current" (first clause) form))
             (loop (cdr rest) places (acons (first clause) (second clause) found))))
          ((null? places)
           (bight-raise 'domain proc "a ~a current takes ~a, not ~s" form
                        (alternatives->string allowed) (car rest)))
          (else (loop (cdr rest) (cdr places) (acons (car places) (car rest) found))))))

(define no-default (list 'no-default))

(define* (clause-field proc form found name type #:optional (default no-default))
  "Return the value of NAME in the alist FOUND, checked by TYPE, or DEFAULT."
  (let ((entry (assq name found)))
    (cond (entry (check proc name type (cdr entry)))
          ((eq? default no-default)
           (bight-raise 'def proc "a ~a current needs (~a ...)" form name))
          (else default))))

(define (fielded proc form positional last-name last-type last-default clauses)
  ;; (FORM speed toward LAST) from CLAUSES.
  (let ((found (clause-fields proc form (list 'speed 'toward last-name) positional clauses)))
    (list form
          (clause-field proc form found 'speed type:speed)
          (clause-field proc form found 'toward type:bearing)
          (clause-field proc form found last-name last-type last-default))))

;; What a procedure answers is checked at each call, here, where there is somebody to tell.

(define speed-limit 20)

(define (slow? velocity)
  (every (lambda (component) (<= (abs component) speed-limit)) (f64vector->list velocity)))

(define (velocity answers)
  (or (and (= 1 (length answers))
           (accepts? type:point (first answers))
           (let ((v (check-argument 'current "the velocity" type:point (first answers))))
             (and (slow? v) v)))
      (bight-raise 'domain 'current
                   "the procedure of a current must return one velocity, three numbers of at most ~a m/s, not ~s"
                   speed-limit (if (= 1 (length answers)) (first answers) answers))))

(define (function proc arguments)
  (unless (and (= 1 (length arguments)) (procedure? (first arguments)))
    (bight-raise 'domain proc "a function current takes one procedure, not ~s" arguments))
  (let ((procedure (first arguments)))
    (unless (takes? procedure 2)
      (bight-raise 'domain proc
                   "the procedure of a current takes a position and a time; ~s does not take two" procedure))
    (list 'function
          (lambda (position time)
            (call-with-values (lambda () (procedure position time))
              (lambda answers (velocity answers)))))))

(define (grid proc arguments)
  ;; A file of rows x y z t u v w; none: the one that the world of the dive has.
  (unless (or (null? arguments)
              (and (= 1 (length arguments)) (string? (first arguments)) (not (string-null? (first arguments)))))
    (bight-raise 'domain proc "a grid current takes the name of a file, (grid \"c.csv\"), not ~s"
                 (cons 'grid arguments)))
  (cons 'grid arguments))

(define (start-time proc value)
  ;; Seconds since 1970 of VALUE, a text or such a number.
  (or (and (real? value) (< (abs value) 1e11) (exact->inexact value))
      (and (string? value) (parse-instant value))
      (bight-raise 'domain proc "a current starts at a time such as \"2025-03-01T06:00Z\", not ~s" value)))

(define (from-clause proc clause)
  (case (and (list? clause) (pair? clause) (car clause))
    ((at) (list 'at (parse-origin proc (if (and (= 2 (length clause)) (list? (second clause)))
                                           (second clause)
                                           (cdr clause)))))
    ((start)
     (unless (= 2 (length clause))
       (bight-raise 'domain proc "(start ...) of a current takes one time, not ~s" (cdr clause)))
     (list 'start (start-time proc (second clause))))
    (else (bight-raise 'domain proc "a current from a file is (from FILE), with (at LATITUDE LONGITUDE) and (start \
TIME) if wanted, not ~s" clause))))

(define (from proc arguments)
  ;; (from FILE CLAUSE ...), each clause at most once, in their order.
  (unless (and (pair? arguments) (string? (car arguments)) (not (string-null? (car arguments))))
    (bight-raise 'domain proc "a current from a file is (from \"FILE\"), not ~s" (cons 'from arguments)))
  (let ((clauses (map (lambda (clause) (from-clause proc clause)) (cdr arguments))))
    (unless (= (length clauses) (length (delete-duplicates (map car clauses))))
      (bight-raise 'domain proc "a clause of (from ...) is given twice"))
    (cons* 'from (car arguments) (filter-map (lambda (name) (assq name clauses)) '(at start)))))

(define (form-current proc form arguments)
  (case form
    ((still) (list 'still))
    ((uniform)
     (unless (= 2 (length arguments)) (refuse-current proc (cons form arguments)))
     (uniform proc (first arguments) (second arguments)))
    ((profile) (profile proc arguments))
    ((turning)
     (fielded proc form '(speed toward degrees-per-metre) 'degrees-per-metre type:turn no-default
              arguments))
    ((power) (fielded proc form '(speed toward exponent) 'exponent type:exponent (/ 1.0 7.0) arguments))
    ((tide) (fielded proc form '(speed toward period) 'period type:period tidal-period arguments))
    ((function) (function proc arguments))
    ((grid) (grid proc arguments))
    ((from) (from proc arguments))
    (else (unknown-name proc "the sea" form
                        (delq 'function (list-copy current-forms))
                        "current"))))

(define (refuse-current proc datum)
  (bight-raise 'domain proc
               "a current is SPEED TOWARD, still, a procedure, or one of (profile ...) (turning ...) (power ...) (tide ...) (grid ...) (from ...), not ~s"
               datum))

(define (parse-current proc datum)
  "Return the canonical form of the current that DATUM describes, for the engine: (still), (uniform SPEED
TOWARD), (grid FILE), (from FILE (at PLACE) (start SECONDS)), (profile (Z SPEED TOWARD) ...) from the top down, (turning SPEED TOWARD DEGREES-PER-METRE),
(power SPEED TOWARD EXPONENT), (tide SPEED TOWARD PERIOD) or (function PROCEDURE).  Raise a &bight-error
from PROC when it describes none."
  (let ((items (and (pair? datum) (bounded-list datum 1000))))
    (cond ((procedure? datum) (function proc (list datum)))
          ((eq? datum 'still) (list 'still))
          ((and (number? datum) (zero? datum)) (list 'still))
          ((symbol? datum) (form-current proc datum '()))
          ((not items) (refuse-current proc datum))
          ((and (pair? (car items)) (eq? 'from (caar items)) (list? (car items)))
           (from proc (append (cdar items) (cdr items))))
          ((and (symbol? (car items)) (not (assq (car items) units)))
           (form-current proc (car items) (cdr items)))
          ((= 2 (length items)) (uniform proc (first items) (second items)))
          (else (refuse-current proc datum)))))

(define (from->string current)
  (string-append (simple-format #f "(from ~s" (second current))
                 (string-concatenate
                  (map (lambda (clause)
                         (if (eq? 'at (car clause))
                             (simple-format #f " (at ~a ~a)" (first (second clause)) (second (second clause)))
                             (simple-format #f " (start ~s)" (instant->string (second clause)))))
                       (cddr current)))
                 ")"))

(define (current->string current)
  "Return the canonical CURRENT as it would be written in a world."
  (case (car current)
    ((still) "still")
    ((uniform) (simple-format #f "~a m/s toward ~a" (second current) (third current)))
    ((function) "a procedure of position and time (slow)")
    ((from) (from->string current))
    (else (brief current))))
