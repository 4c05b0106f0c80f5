;;; (bight bench sampler) --- the procedures behind (bight bench where), by their raw names.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench sampler))

(load-extension "bight-sampler" "bight_sampler_init")
