;;; (bight shell readline) --- the procedures of line editing, by their raw names.
;;;
;;; (bight shell line-editor) is what others use.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell readline)
  #:export (there?))

(define (there?)
  "Load readline; return #t if bight was built with it, and Guile has its own module for it."
  (catch #t
    (lambda ()
      (resolve-interface '(ice-9 readline))
      (save-module-excursion
       (lambda ()
         (set-current-module (resolve-module '(bight shell readline)))
         (load-extension "bight-prompt" "bight_prompt_init")))
      #t)
    (lambda args #f)))
