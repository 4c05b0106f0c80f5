;;; (bight bench cases) --- `bight bench cases': how many short dives a second of CPU a sweep flies.
;;;
;;; A study of dives of a minute in open water, on 20 intervals, is swept with a process for each and with fifty in each;
;;; CPU time is that of all processes, as the kernel tells it once they have ended.  Beside it stands the CPU time of the
;;; same dives flown in one process, with nothing written.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench cases)
  #:use-module (bight bench options)
  #:use-module (bight core scratch)
  #:use-module (bight study case)
  #:use-module ((bight study sweep) #:select (sweep))
  #:use-module ((bight study sweep-file) #:select (load-study))
  #:use-module (srfi srfi-1)
  #:export (run-cases))

(define help "bight bench cases: how many short dives a second of CPU a sweep flies
  --cases N     how many of each kind; 200 when left out, 20 with --quick
")

(define (study-form model n fellows)
  `(define-study short
     "A minute in open water."
     #:for ((case (seeds ,n)) (U (uniform 0.1 0.5)) (push (uniform 0.2 0.8)))
     (latin-hypercube 1)
     (together ,fellows)
     (in (with open-water (current U 90) (line (model ,model) (nodes 20))))
     (fly (drive! #:surge push #:yaw (random 0.2)) (run 60))
     (measure (tension (max-tension)) (slack (slack)))))

(define (write-study name form)
  (let ((file (scratch-file name)))
    (call-with-output-file file (lambda (port) (write form port)))
    file))

(define (cpu)
  ;; Of this process and of those that have ended, s.
  (let ((t (times)))
    (/ (+ (tms:utime t) (tms:stime t) (tms:cutime t) (tms:cstime t)) (exact->inexact internal-time-units-per-second))))

(define (cpu-of thunk)
  (let ((begun (cpu)))
    (thunk)
    (- (cpu) begun)))

(define (rounded x digits)
  (let ((scale (expt 10 digits)))
    (/ (round (* scale x)) scale)))

(define (swept model n fellows)
  (let* ((name (simple-format #f "~a-~a" model fellows))
         (file (write-study (string-append name ".scm") (study-form model n fellows))))
    (cpu-of (lambda () (sweep file (scratch-file (string-append name ".db")) 1 #f #f)))))

(define (flown-alone model n)
  (let ((study (load-study (write-study (string-append (symbol->string model) ".scm") (study-form model n 1)))))
    (cpu-of (lambda () (for-each (lambda (i) (fly-case study i)) (iota n))))))

(define kinds '((auto 1) (auto 50) (dynamic 1) (dynamic 50)))

(define (run-cases arguments)
  "Do what ARGUMENTS of `bight bench cases' ask for, and return the exit status."
  (let ((options (bench-options "cases" '("--cases") '("--quick" "--help") arguments)))
    (if (assoc-ref options "--help")
        (display help)
        (let ((n (whole options "--cases" (if (assoc-ref options "--quick") 20 200) 1 100000)))
          (call-with-scratch
           (lambda ()
             ;; Flown last: who forks has flown nothing.
             (let* ((swept (map (lambda (kind) (swept (first kind) n (second kind))) kinds))
                    (alone (map (lambda (model) (cons model (flown-alone model n))) '(auto dynamic))))
               (display "model,cases in a process,cases,cases a second of CPU,ms a case,ms of the dive alone\n")
               (for-each (lambda (kind seconds)
                           (simple-format #t "~a,~a,~a,~a,~a,~a~%" (first kind) (second kind) n (rounded (/ n seconds) 1)
                                          (rounded (* 1000 (/ seconds n)) 2)
                                          (rounded (* 1000 (/ (assq-ref alone (first kind)) n)) 2)))
                         kinds swept))))))
    0))
