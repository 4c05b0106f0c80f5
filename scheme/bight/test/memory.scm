;;; (bight test memory) --- which scenarios failed the last time that they were run.
;;;
;;; Each file of tests with failures has a file of its own among what bight keeps of a user, so that several
;;; runs at once do not disturb each other.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test memory)
  #:use-module (bight core datum)
  #:use-module (bight core folders)
  #:use-module (bight test tap)
  #:use-module ((ice-9 textual-ports) #:select (get-string-all))
  #:use-module (srfi srfi-1)
  #:export (failed-before
            remember-failures!
            flight-file))

(define (absolute file)
  (or (false-if-exception (canonicalize-path file)) file))

(define (memory-of file)
  ;; Where the failures of FILE are kept, or #f if there is no such place.
  (and=> (state-folder)
         (lambda (folder)
           (string-append folder "/tests/" (number->string (string-hash (absolute file) (expt 2 60)) 16)))))

(define (flight-file file label)
  "Return the name of the recording of how the scenario LABEL of FILE failed, or #f if there is no place for it."
  (and=> (memory-of file)
         (lambda (memory)
           (string-append memory "-" (number->string (string-hash label (expt 2 60)) 16) ".rec"))))

(define (failed-before file)
  "Return the labels of the scenarios of FILE, a file of tests, that failed the last time, strings; one is #f where
FILE as a whole did."
  (let ((memory (memory-of file)))
    (or (and memory (file-exists? memory)
             (false-if-exception
              (let ((kept (text->datum (call-with-input-file memory get-string-all))))
                (and (list? kept) (equal? (absolute file) (car kept)) (cdr kept)))))
        '())))

(define (keep! file labels)
  (let ((memory (memory-of file)))
    (when memory
      (false-if-exception
       (if (null? labels)
           (when (file-exists? memory) (delete-file memory))
           (begin
             (ensure-folder! (dirname memory) #o700)
             (call-with-output-file memory
               (lambda (port) (write (cons (absolute file) labels) port)))))))))

(define (remember-failures! points)
  "Remember which of POINTS, what became of scenarios, failed; of those that were not run it stays known."
  (define (of-file file) (filter (lambda (p) (string=? file (point-file p))) points))
  (for-each (lambda (file)
              (let* ((own (of-file file))
                     (run (remove (lambda (p) (eq? 'skip (point-status p))) own))
                     (failed (filter (lambda (p) (eq? 'fail (point-status p))) own)))
                (keep! file
                       (append (map point-label failed)
                               (lset-difference equal? (delete #f (failed-before file)) (map point-label run))))))
            (delete-duplicates (map point-file points))))
