;;; (bight lesson log) --- what came of lessons, in the logbook.
;;;
;;; A result is an association list with the keys lesson title who group seed level total passed? seconds
;;; hints rewinds marks coached, and when as it is read; the logbook keeps it as the data of an entry, and its total as the score.
;;; Probes get entries of their own.  The logbook is a module that is loaded when it is needed, and a bight
;;; without it, or without a place to keep it, teaches all the same.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson log)
  #:use-module (bight core errors)
  #:use-module (srfi srfi-1)
  #:export (log-result!
            logged-results
            earlier?
            why-no-record))

(define (logbook-ref name)
  ;; The procedure NAME of the logbook, or #f if there is none.
  (let ((interface (false-if-exception (resolve-interface '(bight lesson logbook)))))
    (and interface
         (let ((variable (module-variable interface name)))
           (and variable (variable-ref variable))))))

(define (trying default thunk)
  ;; What THUNK returns, or DEFAULT if the logbook refuses.
  (with-exception-handler
      (lambda (e) (if (bight-error? e) default (raise-exception e)))
    thunk
    #:unwind? #t))

(define (write-result! log-lesson! log-probe! result)
  (let ((get (lambda (key) (assq-ref result key))))
    (log-lesson! (get 'lesson) #:trainee (get 'who) #:score (get 'total) #:data result)
    (for-each (lambda (mark)
                (when (string-prefix? "question " (first mark))
                  (log-probe! (string-append (symbol->string (get 'lesson)) ": " (first mark))
                              #:trainee (get 'who) #:score (second mark)
                              #:data `((passed? ,(third mark)) (how ,(fourth mark))))))
              (get 'marks))
    #t))

(define (log-result! result)
  "Tell the logbook of RESULT.  Return #t if it is written there."
  (let ((log-lesson! (logbook-ref 'log-lesson!)) (log-probe! (logbook-ref 'log-probe!)))
    (and log-lesson! log-probe!
         (trying #f (lambda () (write-result! log-lesson! log-probe! result))))))

(define (logged-results who)
  "Return the results in the logbook of WHO, a string, or of all if it is #f, oldest first."
  (let ((logbook (logbook-ref 'logbook)) (data (logbook-ref 'log-entry-data))
        (when-logged (logbook-ref 'log-entry-when)))
    (if logbook
        (filter-map (lambda (entry)
                      (let ((result (data entry)))
                        (and (pair? result) (every pair? result) (assq 'lesson result)
                             (acons 'when (when-logged entry) result))))
                    (trying '() (lambda () (logbook #:trainee who #:kind 'lesson))))
        '())))

(define (when-of result)
  (or (assq-ref result 'when) ""))

(define (earlier? a b)
  "Return #t if the result A came before B.  Results of the same second go by their own text, so that where they were
written does not matter."
  (if (string=? (when-of a) (when-of b))
      (string<? (simple-format #f "~s" a) (simple-format #f "~s" b))
      (string<? (when-of a) (when-of b))))

(define (why-no-record)
  "Return why there is no logbook to read results from, a sentence, or #f if there is one."
  (with-exception-handler
      (lambda (e) (if (bight-error? e) (bight-error-message e) (raise-exception e)))
    (lambda ()
      (let ((logbook (logbook-ref 'logbook)))
        (if logbook
            (begin (logbook #:trainee "" #:kind 'lesson) #f)
            "the logbook cannot be loaded")))
    #:unwind? #t))
