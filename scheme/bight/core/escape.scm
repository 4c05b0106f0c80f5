;;; (bight core escape) --- the procedures behind (bight outlet), by their raw names.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core escape))

(load-extension "bight-outlet" "bight_outlet_init")
