;;; (bight bench worlds) --- `bight bench stability --family worlds': random dives in random worlds, by the
;;; thousand.
;;;
;;; The other families of that bench are a program in C; this one needs the language.  Dive number N with a
;;; seed is the same alone, in any shard and beside any others.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench worlds)
  #:use-module ((bight core argument) #:select (alternatives->string))
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight test any-dive)
  #:use-module ((bight test reproducer) #:select (make-folder))
  #:use-module (srfi srfi-1)
  #:export (worlds-asked?
            run-worlds))

(define help "bight bench stability --family worlds: random dives in random worlds, judged by laws that know no solver
  --cases N     dives, 1000 when left out, 20 with --quick
  --seed N      of the dives, 1 when left out
  --case N      one dive alone, by its number
  --shard I/N   every N-th dive alone, from the I-th on
  --wild        with the least and the greatest numbers that the schema allows, too
  --log DIR     where the scripts of what is found go, bight-bench when left out
")

(define valued '("--cases" "--seed" "--case" "--shard" "--log" "--family"))
(define flags '("--wild" "--quick" "--help"))

(define (worlds-asked? arguments)
  "Return #t if ARGUMENTS, those for the program, ask for the family of the worlds."
  (or (member "--family=worlds" arguments)
      (and=> (member "--family" arguments)
             (lambda (rest) (and (pair? (cdr rest)) (equal? "worlds" (cadr rest)))))))

(define (bad text . values)
  (apply bight-raise 'domain 'bench text values))

(define (split word)
  ;; --NAME=VALUE as two words.
  (let ((i (and (string-prefix? "--" word) (string-index word #\=))))
    (if i (list (substring word 0 i) (substring word (+ i 1))) (list word))))

(define (read-options arguments)
  ;; An alist of ARGUMENTS.
  (let loop ((rest (append-map split arguments)) (found '()))
    (cond ((null? rest) found)
          ((member (car rest) flags) (loop (cdr rest) (acons (car rest) #t found)))
          ((not (member (car rest) valued))
           (bad "the family worlds has ~a, not ~a" (alternatives->string (append valued flags)) (car rest)))
          ((null? (cdr rest)) (bad "~a needs a value after it" (car rest)))
          (else (loop (cddr rest) (acons (car rest) (cadr rest) found))))))

(define (whole options name default)
  (let* ((text (assoc-ref options name)) (n (if text (text->number text) default)))
    (unless (or (not n) (and (exact-integer? n) (>= n 0)))
      (bad "~a takes a whole number, not ~a" name text))
    n))

(define (shard options)
  ;; (I N)
  (let* ((text (or (assoc-ref options "--shard") "1/1"))
         (numbers (map text->number (string-split text #\/))))
    (unless (and (= 2 (length numbers)) (and-map exact-integer? numbers) (<= 1 (first numbers) (second numbers)))
      (bad "--shard takes I/N, I from 1 to N, not ~a" text))
    numbers))

(define (numbers-of options)
  ;; Of the dives to be flown.
  (let ((one (whole options "--case" #f))
        (cases (whole options "--cases" (if (assoc "--quick" options) 20 1000)))
        (part (shard options)))
    (if one
        (list one)
        (filter (lambda (n) (= (modulo n (second part)) (- (first part) 1))) (iota cases)))))

(define (file-name folder wild? seed n)
  (simple-format #f "~a/~a-~a-~a.scm" folder (if wild? "wild-worlds" "worlds") seed n))

(define (keep folder wild? seed finding)
  (let ((file (file-name folder wild? seed (first finding))))
    (make-folder folder)
    (call-with-output-file file
      (lambda (port)
        (set-port-encoding! port "UTF-8")
        (display (third finding) port)))
    (simple-format #t "dive ~a: ~s~%  bight ~a shows it~%" (first finding) (second finding) file)
    (force-output)))

(define (run-worlds arguments)
  "Do what ARGUMENTS of the family of the worlds ask for, print what came of it and return the exit status: 1
if a dive was not sound."
  (let ((options (read-options arguments)))
    (if (assoc "--help" options)
        (begin (display help) 0)
        (let ((folder (or (assoc-ref options "--log") "bight-bench"))
              (wild? (and (assoc "--wild" options) #t)) (seed (whole options "--seed" 1))
              (flown 0) (refused 0) (seconds 0) (bad-dives 0))
          (define (hear n outcome)
            (case (car outcome)
              ((refused) (set! refused (+ refused 1)))
              ((flown) (set! seconds (+ seconds (second outcome))) (set! flown (+ flown 1)))
              (else (set! flown (+ flown 1))))
            (when (finding? outcome) (set! bad-dives (+ bad-dives 1))))
          (let ((findings (unsound-dives (numbers-of options) #:seed seed #:wild? wild? #:hear hear
                                         #:found (lambda (finding) (keep folder wild? seed finding)))))
            (simple-format #t "~a dives flown, ~a worlds refused, ~a s dived, ~a dives not sound in ~a ways~%"
                           flown refused (inexact->exact (round seconds)) bad-dives (length findings))
            (if (zero? bad-dives) 0 1))))))
