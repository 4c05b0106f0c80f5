;;; (bight lesson-log) --- where the results of lessons go.
;;;
;;; One hook: the logbook, if this bight has one, is told what came of a lesson and asked for what there
;;; was before.  An entry is an association list with the keys lesson title who group seed level total
;;; passed? seconds hints rewinds marks coached.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson-log)
  #:export (log-result!
            logged-results))

(define (from-logbook name)
  ;; The procedure NAME of the logbook, or #f if there is none.
  (let ((interface (false-if-exception (resolve-interface '(bight logbook)))))
    (and interface
         (let ((variable (module-variable interface name)))
           (and variable (variable-bound? variable) (variable-ref variable))))))

(define (log-result! entry)
  "Tell the logbook of ENTRY, an association list.  Return #t if there is a logbook."
  (let ((log-lesson! (from-logbook 'log-lesson!)))
    (and log-lesson!
         (begin (log-lesson! entry) #t))))

(define (logged-results who)
  "Return the entries in the logbook about WHO, a string, oldest first."
  (let ((lesson-entries (from-logbook 'lesson-entries)))
    (if lesson-entries (lesson-entries who) '())))
