;;; (bight core sqlite) --- the procedures of databases, by their raw names.
;;;
;;; They take positional arguments already checked; (bight core database) is what others use.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core sqlite)
  #:export (there?))

(define there?
  ;; Was bight built with SQLite?
  (catch #t
    (lambda () (load-extension "bight-sqlite" "bight_sqlite_init") #t)
    (lambda args #f)))
