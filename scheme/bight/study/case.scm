;;; (bight study case) --- one case of a study, flown in a dive of its own.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study case)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module ((bight dive query) #:select (rov-position))
  #:use-module (bight study sweep-design)
  #:use-module ((bight world) #:select (find-world world->parts))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (run-case
            study-cases
            study?
            ;; For those who make and run studies.
            make-study
            study-name
            study-sentence
            study-location
            study-design
            study-limit
            study-together
            study-measures
            study-legs
            fly-case
            case-values
            world-text
            ;; What a study's body calls.
            fly-leg!
            end-case
            flight?))


;;; Studies.

(define-record <study>
  (make-study name sentence location design limit together measures legs world body)
  is-study?
  (name study-name)                     ; a symbol
  (sentence study-sentence)             ; a string
  (location study-location)             ; (FILE . LINE) or #f
  (design study-design)
  (limit study-limit)                   ; seconds of processor time that a case may take
  (together study-together)             ; how many cases one process may fly, one after the other
  (measures study-measures)             ; symbols
  (legs study-legs)                     ; symbols, in the order in which they are flown
  (world study-world)                   ; a procedure of the values of the variables
  (body study-body))                    ; a procedure of a flight and those values

(set-record-type-printer! <study>
  (lambda (study port)
    (simple-format port "#<study ~a, ~a cases: ~a>" (study-name study)
                   (design-size (study-design study)) (study-sentence study))))

(define-argument-type (study value)
  "a study, as `define-study' makes"
  (if (is-study? value) value refused))


;;; One case.

(define-record <flight>
  (make-flight legs)
  flight?
  (legs flight-legs set-flight-legs!))  ; (NAME POSITION MEASURES), the last first

(define (measured entry)
  ;; (NAME . VALUE) from ENTRY, (NAME . THUNK).
  (let ((value ((cdr entry))))
    (cons (car entry)
          (cond ((boolean? value) value)
                ((symbol? value) value)
                ((string? value) value)
                ((and (number? value) (real? value) (exact? value) (not (exact-integer? value)))
                 (exact->inexact value))
                ((real? value) value)
                (else
                 (bight-raise 'domain 'measure "~a is a number, true or false, a symbol or a string, not ~s"
                              (car entry) value))))))

(define (position)
  ;; Where the only vehicle is, or no place at all.
  (catch 'bight-error
    (lambda () (f64vector->list (rov-position)))
    (lambda arguments '(#f #f #f))))

(define (fly-leg! flight name measures thunk)
  "Fly the leg NAME of FLIGHT, THUNK, and measure MEASURES at its end."
  (thunk)
  (set-flight-legs! flight
                    (cons (list name (position) (map measured measures)) (flight-legs flight))))

(define (end-case flight measures)
  "Return the outcome of FLIGHT: (MEASURES LEGS HASH)."
  (list (map measured measures) (reverse (flight-legs flight)) (state-hash)))

(define (case-values study number)
  "Return the values of the variables of STUDY in its case NUMBER, from 0."
  (design-case (study-design study) number))

(define (call-with-numbers values thunk)
  ;; Call THUNK; what (random N) gives there depends on VALUES alone.
  (let ((stream (number-stream 'case values))
        (before *random-state*))
    (dynamic-wind
      (lambda ()
        (set! *random-state*
              (seed->random-state
               (string-concatenate (map (lambda (i) (number->string (stream i))) (iota 2))))))
      thunk
      (lambda () (set! *random-state* before)))))

(define (fly-case study number)
  "Fly the case NUMBER, from 0, of STUDY in a dive of its own; return (MEASURES LEGS HASH): what was
measured at the end, an alist; of each leg (NAME POSITION MEASURES); the hash of the state."
  (let ((values (case-values study number)))
    (call-with-numbers values
      (lambda ()
        (parameterize ((current-dive #f))
          (enter! (apply (study-world study) values))
          (apply (study-body study) (make-flight '()) values))))))

(define (plain datum)
  ;; DATUM, in which what prints by its address stands by its name alone.
  (cond ((pair? datum) (cons (plain (car datum)) (plain (cdr datum))))
        ((or (number? datum) (symbol? datum) (string? datum) (boolean? datum) (null? datum)) datum)
        ((procedure? datum) 'procedure)
        ((array? datum) (cons 'array (plain (array->list datum))))
        (else 'object)))

(define (world-text study)
  "Return what the world of the first case of STUDY is made of, a string."
  (object->string
   (plain (world->parts (find-world (apply (study-world study) (case-values study 0)))))))


;;; At the prompt.

(define-verb (study? (object any))
  "Return #t if OBJECT is a study."
  (is-study? object))

(define-verb (study-cases (s study))
  "Return how many cases the study S has."
  (design-size (study-design s)))

(define-verb (run-case (s study) #:optional (number (at-least 1) 1))
  "Fly the case NUMBER, from 1, of the study S in a dive of its own, and return an alist: the values of its
variables, what was measured at its end, and under `legs' what was measured after each leg."
  (let ((size (design-size (study-design s))))
    (when (> number size)
      (bight-raise 'domain 'run-case "the study ~a has ~a cases; there is no case ~a" (study-name s) size
                   number))
    (let ((outcome (fly-case s (- number 1))))
      (append (map cons (design-variables (study-design s)) (case-values s (- number 1)))
              (first outcome)
              (if (null? (second outcome))
                  '()
                  (list (cons 'legs (map (lambda (leg) (cons (first leg) (third leg)))
                                         (second outcome)))))))))
