;;; (bight test entry) --- a line of the report to be, and what came of it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test entry)
  #:use-module (bight core record)
  #:use-module (bight test file)
  #:use-module (bight test tap)
  #:use-module (srfi srfi-1)
  #:export (entry? entry-file entry-index entry-parts entry-point set-entry-point!
            settled-entry
            scenario-entry
            known
            part? part-from part-end part-case set-part-case! part-outcome set-part-outcome! part-ended
            set-part-ended!
            bad-part?
            ending->string
            entry->point))


;;; An entry is a line of the report to be: a scenario, of which the parts come in, or a point already.

(define-record <entry>
  (make-entry file index data parts point)
  entry?
  (file entry-file)
  (index entry-index)                   ; in its file
  (data entry-data)                     ; what its shop told of it, an alist
  (parts entry-parts)
  (point entry-point set-entry-point!)) ; when all is known

;; A property with many cases is run in parts.
(define-record <part>
  (make-part from end case outcome ended)
  part?
  (from part-from)
  (end part-end)
  (case part-case set-part-case!)       ; the last that was begun, or #f
  (outcome part-outcome set-part-outcome!) ; what its process told, an alist, or #f
  (ended part-ended set-part-ended!))   ; how it ended, or #f

(define (known entry key)
  (assq-ref (entry-data entry) key))

(define (settled-entry point)
  (make-entry (point-file point) #f '() '() point))

(define cases-at-once 50)

(define (parts-of cases)
  (if cases
      (map (lambda (from) (make-part from (min cases (+ from cases-at-once)) #f #f #f))
           (iota (max 1 (quotient (+ cases cases-at-once -1) cases-at-once)) 0 cases-at-once))
      (list (make-part 0 #f #f #f #f))))

(define (scenario-entry file index data cases)
  (make-entry file index data (parts-of (and (assq-ref data 'cases) (or cases (assq-ref data 'cases))))
              #f))


;;; What came of a scenario.

(define (signal-name n)
  (or (assv-ref `((,SIGSEGV . "a segmentation fault") (,SIGABRT . "it aborted")
                  (,SIGKILL . "it was killed") (,SIGTERM . "it was told to end")
                  (,SIGFPE . "a floating point exception") (,SIGBUS . "a bus error")
                  (,SIGXCPU . "it used up its processor time"))
                n)
      (simple-format #f "signal ~a" n)))

(define (ending->string ended settings)
  ;; How a process that told no outcome ended.
  (case (car ended)
    ((late) "its process gave no sign of life for too long, and was killed")
    ((orphaned closed) "the process that had loaded its file is gone")
    (else
     (let ((code (second ended)) (signal (third ended)))
       (cond ((and signal (= signal SIGKILL) (settings-limit settings))
              (simple-format #f "its process was killed, as is done ~a: ~a s"
                             "when one goes on after the limit of processor time" (settings-limit settings)))
             (signal (string-append "its process died: " (signal-name signal)))
             (else (simple-format #f "its process ended by itself, with status ~a" code)))))))

(define (failure-lines failure)
  (apply
   (lambda (location form expected actual remarks)
     (append (list (string-append location ": " (or form "an error that was not expected"))
                   (string-append "  expected: " expected)
                   (string-append "  actual:   " actual))
             (map (lambda (line) (string-append "  " line)) remarks)))
   failure))

(define (said-once failures)
  ;; FAILURES, the remarks taken from those that only repeat those of the one before.
  (map (lambda (failure before)
         (if (and before (equal? (fifth failure) (fifth before)))
             (append (take failure 4) '(()))
             failure))
       failures (cons #f failures)))

(define (outcome-details outcome)
  (append (append-map failure-lines (said-once (assq-ref outcome 'failures)))
          (if (and (eq? 'pass (assq-ref outcome 'status)) (eqv? 0 (assq-ref outcome 'claims)))
              '("nothing was expected here: only that no error is raised")
              '())
          (output-lines (assq-ref outcome 'output))))

(define (lost-details entry part shown settings)
  (append
   (list (string-append (known entry 'location) ": " (ending->string (part-ended part) settings)))
   (if (and (known entry 'cases) (part-case part))
       (cons (simple-format #f "  in case ~a with seed ~a:" (part-case part) (settings-seed settings))
             (map (lambda (line) (string-append "  " line)) shown))
       '())))

(define (bad-part? part)
  (or (not (part-outcome part)) (eq? 'fail (assq-ref (part-outcome part) 'status))))

(define (part-details entry part shown settings)
  (append (if (part-outcome part)
              (outcome-details (part-outcome part))
              (lost-details entry part shown settings))
          (if (bad-part? part)
              (list (simple-format #f "seed ~a" (settings-seed settings)))
              '())))

(define (seconds-of parts)
  (fold (lambda (part sum)
          (+ sum (or (and=> (part-outcome part) (lambda (o) (assq-ref o 'seconds))) 0)))
        0. parts))

(define (entry->point entry shown settings)
  ;; The first part that failed speaks for all.
  (let* ((parts (entry-parts entry))
         (part (or (find bad-part? parts) (first parts)))
         (outcome (part-outcome part)))
    (make-point (entry-file entry) (known entry 'label) (known entry 'sentence)
                (known entry 'location)
                (if outcome (assq-ref outcome 'status) 'fail)
                (and outcome (assq-ref outcome 'reason))
                (part-details entry part shown settings)
                (seconds-of parts)
                (and outcome (assq-ref outcome 'view)))))
