;;; (bight engine) --- the procedures of the C engine, by their raw names.
;;;
;;; They take positional arguments already checked; users meet them through the modules above.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight engine))

(load-extension "bight-guile" "bight_guile_init")
