;;; (bight world group) --- parts that are placed together: their names and fields as the world has them.
;;;
;;; A group is a part only until a world is put together: its members then stand in its place, turned and
;;; moved with it, each called GROUP/MEMBER.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world group)
  #:use-module (bight core schema)
  #:use-module (bight world shape)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (member-name
            member-of?
            place-fields))

(define (member-name group name)
  "Return the name, in the world, of what is called NAME within GROUP: GROUP/NAME, symbols all."
  (symbol-append group '/ name))

(define (member-of? group name)
  "Return true if the part NAME of a world belongs to GROUP, or to a group within it."
  (string-prefix? (string-append (symbol->string group) "/") (symbol->string name)))

(define origin (f64vector 0 0 0))

(define (renamed value group names)
  ;; VALUE, an end; a member's name as the world has it.
  (let ((name (if (reference? value) (reference-name value) value)))
    (if (memq name names) (member-name group name) value)))

(define (placed head entry at heading rename)
  ;; ENTRY, (NAME . VALUE) of a part with HEAD, as it is in the world.
  (let ((name (car entry)) (value (cdr entry)))
    (cons name
          (cond ((not (head-field head name)) value) ; a thing inside the part
                ((and (memq name '(at from to)) (f64vector? value)) (place-point value at heading))
                ((memq name '(from to)) (rename value))
                ((eq? name 'via) (turn-points value at heading))
                ((eq? name 'track) (turn-rows value at heading (head-field head 'heading)))
                ((eq? name 'heading) (+ value heading))
                (else value)))))

(define (given head fields name value)
  ;; FIELDS, with the default VALUE of NAME where a part with HEAD leaves it open.
  (if (and (head-field head name) (not (assq name fields)))
      (append fields (list (cons name value)))
      fields))

(define (place-fields head fields group at heading names)
  "Return the alist FIELDS of a member, a part with HEAD, as the world has them: turned by HEADING degrees
about the origin of GROUP, which is AT.  Ends that are among NAMES, those of the members, become theirs
in the world."
  (map (lambda (entry)
         (placed head entry at heading (lambda (end) (renamed end group names))))
       (given head (given head fields 'at origin) 'heading 0.)))
