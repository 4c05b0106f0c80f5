;;; (bight test again) --- files run again and again, whenever one of them or beside them changes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test again)
  #:use-module (bight test file)
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

(define (wait-for-change paths before)
  ;; Wait until some of the files of PATHS, or beside them, are others than BEFORE: those that are to be run.
  ;; A file that is still being written is waited for: two looks, one after the other, must see the same.
  (let loop ((last before))
    (let* ((files (append-map files-at paths))
           (now (states (append files (beside files))))
           (new (changed before now)))
      (cond ((or (null? new) (not (equal? now last))) (usleep 200000) (loop now))
            (else (values (if (every (lambda (file) (member file files)) new) new files) now))))))

(define (run-again-and-again paths run)
  ;; RUN the files of PATHS, then those that change, until ^C.
  (let loop ((files (append-map files-at paths))
             (before (let ((files (append-map files-at paths))) (states (append files (beside files))))))
    (run files)
    (print-comments '("waiting for a change; C-c ends"))
    (force-output)
    (call-with-values (lambda () (wait-for-change paths before)) loop)))
