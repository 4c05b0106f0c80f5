;;; (bight core scratch) --- files of a scenario's own.
;;;
;;; Scenarios run side by side, in processes of their own: a file that two of them wrote would be neither's.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core scratch)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module ((ice-9 ftw) #:select (file-system-fold))
  #:export (scratch-file
            call-with-scratch))

;; A pair of the process of the present scenario and its folder, #f until a file is asked for.  A process
;; that was forked within a scenario is none of it.
(define present (make-parameter #f))

(define (present-scratch)
  (and=> (present) (lambda (scratch) (and (eqv? (car scratch) (getpid)) scratch))))

(define (make-folder!)
  (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-scratch-XXXXXX")))

(define (remove-tree! folder)
  "Remove FOLDER and what is in it, as far as that can be done."
  (define (by remove!)
    (lambda (name status result) (false-if-exception (remove! name)) result))
  (define (leave name status . more) #f)
  (file-system-fold (const #t) (by delete-file) leave (by rmdir) leave leave #f folder))

(define-verb (scratch-file (name string))
  "Return the name of a file called NAME that a scenario may write: it lies in a folder that is the
scenario's own and is removed when it ends."
  (let ((scratch (present-scratch)))
    (unless scratch
      (bight-raise 'unsupported 'scratch-file "only a running scenario has files of its own"))
    (unless (cdr scratch)
      (set-cdr! scratch (make-folder!)))
    (string-append (cdr scratch) "/" name)))

(define (call-with-scratch thunk)
  "Call THUNK with a folder for its files, those of the scenario about it if there is one."
  (if (present-scratch)
      (thunk)
      (let ((scratch (cons (getpid) #f)))
        (dynamic-wind
          (const #t)
          (lambda () (parameterize ((present scratch)) (thunk)))
          (lambda ()
            (when (cdr scratch)
              (remove-tree! (cdr scratch))
              (set-cdr! scratch #f)))))))
