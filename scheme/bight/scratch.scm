;;; (bight scratch) --- files of a scenario's own.
;;;
;;; Scenarios run side by side, in processes of their own: a file that two of them wrote would be neither's.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight scratch)
  #:use-module (bight errors)
  #:use-module (bight verb)
  #:use-module ((ice-9 ftw) #:select (nftw))
  #:export (scratch-file
            call-with-scratch))

;; A variable that holds the present scenario's folder, or #f until a file is asked for.
(define present-folder (make-parameter #f))

(define (make-folder!)
  (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-scratch-XXXXXX")))

(define (remove-tree! folder)
  (nftw folder
        (lambda (name status flag base level)
          (false-if-exception ((if (eq? flag 'directory-processed) rmdir delete-file) name))
          #t)
        'depth 'physical))

(define-verb (scratch-file (name string))
  "Return the name of a file called NAME that a scenario may write: it lies in a folder that is the
scenario's own and is removed when it ends."
  (let ((folder (present-folder)))
    (unless folder
      (bight-raise 'unsupported 'scratch-file "only a running scenario has files of its own"))
    (unless (variable-ref folder)
      (variable-set! folder (make-folder!)))
    (string-append (variable-ref folder) "/" name)))

(define (call-with-scratch thunk)
  "Call THUNK with a folder for its files, those of the scenario about it if there is one."
  (if (present-folder)
      (thunk)
      (let ((folder (make-variable #f)))
        (dynamic-wind
          (const #t)
          (lambda () (parameterize ((present-folder folder)) (thunk)))
          (lambda ()
            (when (variable-ref folder)
              (remove-tree! (variable-ref folder))
              (variable-set! folder #f)))))))
