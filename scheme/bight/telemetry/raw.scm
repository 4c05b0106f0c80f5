;;; (bight telemetry raw) --- the procedure behind (bight telemetry mavlink), by its raw name.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight telemetry raw))

(load-extension "bight-telemetry" "bight_telemetry_init")
