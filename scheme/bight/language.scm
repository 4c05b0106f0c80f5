;;; (bight language) --- modules in which all names are the language's, for files and for what is typed.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight language)
  #:export (language-module
            call-in-language))

(define (language-module)
  "Return a new module that has Scheme's names and bight's, and nobody's definitions."
  (let ((module (make-fresh-user-module)))
    (module-use! module (resolve-interface '(bight)))
    module))

(define (call-in-language thunk)
  "Call THUNK with such a module as the current one."
  (save-module-excursion
   (lambda ()
     (set-current-module (language-module))
     (thunk))))
