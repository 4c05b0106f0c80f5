;;; (bight core folders) --- making folders, and where the state of a user is kept.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core folders)
  #:export (ensure-folder!
            search-path-of
            state-folder))

(define* (ensure-folder! folder #:optional (mode #o777))
  "Make FOLDER, and those it lies in, where they are not there yet; what is made has MODE, less the umask."
  (unless (file-exists? folder)
    (ensure-folder! (dirname folder) mode)
    (catch 'system-error
      (lambda () (mkdir folder mode))
      (lambda arguments
        (unless (file-exists? folder)   ; somebody else was faster
          (apply throw arguments))))))

(define (search-path-of variable . own)
  "Return the list of the folders in the environment variable VARIABLE, separated by colons, and OWN."
  (append (delete "" (string-split (or (getenv variable) "") #\:)) own))

(define (state-folder)
  "Return the folder for what bight keeps of a user, by the XDG rules, or #f if there is no such place.  It
need not exist."
  (let ((home (getenv "HOME")) (state (getenv "XDG_STATE_HOME")))
    (cond ((and state (absolute-file-name? state)) (string-append state "/bight"))
          (home (string-append home "/.local/state/bight"))
          (else #f))))
