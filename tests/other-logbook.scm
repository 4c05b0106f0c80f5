;;; Another logbook than the user's, while some forms are run.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-syntax-rule (with-logbook file body ...)
  (let ((before (getenv "BIGHT_LOGBOOK")))
    (dynamic-wind
      (lambda () (setenv "BIGHT_LOGBOOK" file))
      (lambda () body ...)
      (lambda () (if before (setenv "BIGHT_LOGBOOK" before) (unsetenv "BIGHT_LOGBOOK"))))))
