;;; (bight core late) --- what a module needs only now and then is loaded when it is used.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core late)
  #:export (from))

(define-syntax-rule (from module name)
  "Return the value of NAME in MODULE, a list of symbols that is not evaluated, loaded now."
  (module-ref (resolve-interface 'module) 'name))
