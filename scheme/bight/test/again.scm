;;; (bight test again) --- files run again and again, whenever one of them or beside them changes.
;;;
;;; Meanwhile w shows in the cockpit how the scenarios that failed came to it, one after the other.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test again)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core terminal)
  #:use-module (bight test file)
  #:use-module (bight test memory)
  #:use-module (bight test tap)
  #:use-module (srfi srfi-1)
  #:export (run-again-and-again))

(define (state-of file)
  ;; What is another when FILE was written anew.
  (let ((s (false-if-exception (stat file))))
    (and s (list (stat:mtime s) (stat:mtimensec s) (stat:size s) (stat:ino s)))))

(define (states files)
  (map (lambda (file) (cons file (state-of file))) files))

(define (beside files)
  ;; The other files of Scheme in the folders of FILES and in worlds here: a change of one may change any test.
  (lset-difference string=?
                   (delete-duplicates
                    (append-map (lambda (folder) (or (false-if-exception (files-at folder)) '()))
                                (cons "worlds" (delete-duplicates (map dirname files)))))
                   files))

(define (changed before now)
  (filter-map (lambda (entry) (and (not (equal? entry (assoc (car entry) before))) (car entry))) now))

(define look-period 0.2)                ; s

(define (wait-for-change paths before do-key)
  ;; Wait until some of the files of PATHS, or beside them, are others than BEFORE: those that are to be run; meanwhile
  ;; DO-KEY is called with each key.  A file that is still being written is waited for: two looks, one after the other,
  ;; must see the same.
  (let loop ((last before))
    (let* ((files (append-map files-at paths))
           (now (states (append files (beside files))))
           (new (changed before now)))
      (cond ((or (null? new) (not (equal? now last)))
             (let ((key (key-within look-period)))
               (when key (do-key key)))
             (loop now))
            (else (values (if (every (lambda (file) (member file files)) new) new files) now))))))


;;; How a failure came about.

(define (failed-flights paths)
  ;; The scenarios of the files of PATHS that failed, of which there is a recording: pairs of a label and its file.
  (append-map (lambda (file)
                (filter-map (lambda (label)
                              (let ((flight (and label (flight-file file label))))
                                (and flight (file-exists? flight) (cons label flight))))
                            (failed-before file)))
              (append-map files-at paths)))

(define (show-flight flight)
  ;; FLIGHT, one of `failed-flights', in the cockpit, from the moment at which it failed, the last that was recorded.
  (with-exception-handler
      (lambda (e)
        (print-comments (list (bight-error-message e))))
    (lambda ()
      ((from (bight cockpit watch) watch-file) (cdr flight) '(("--at" . "end"))))
    #:unwind? #t
    #:unwind-for-type &bight-error))

(define (say-waiting flights)
  (print-comments
   (list (if (and (pair? flights) (terminal-state))
             (simple-format #f "waiting for a change; w shows how ~a failed; C-c ends" (car (car flights)))
             "waiting for a change; C-c ends")))
  (force-output))

(define (wait-and-show paths before)
  ;; As `wait-for-change' does; w shows the first of the flights that failed, then the next, all in turn.
  (let ((flights (failed-flights paths)))
    (say-waiting flights)
    (call-hearing-keys
     (lambda ()
       (wait-for-change paths before
                        (lambda (key)
                          (when (and (eqv? #\w key) (pair? flights))
                            (show-flight (car flights))
                            (set! flights (append (cdr flights) (list (car flights))))
                            (say-waiting flights))))))))

(define (run-again-and-again paths run)
  ;; RUN the files of PATHS, then those that change, until ^C.
  (let loop ((files (append-map files-at paths))
             (before (let ((files (append-map files-at paths))) (states (append files (beside files))))))
    (run files)
    (call-with-values (lambda () (wait-and-show paths before)) loop)))
