;;; (bight world) --- the forms that make worlds, and what can be asked of a world.
;;;
;;; `world' and its kin are macros only because words in a part need no quote and numbers are ordinary
;;; expressions; all mistakes are found, and raised as &bight-error, when the form is evaluated.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world)
  #:use-module (bight assembly)
  #:use-module (bight core clause)
  #:use-module (bight core schema)
  #:use-module (bight core verb)
  #:use-module (bight world atlas)
  #:export (world define-world extend without with part
            world? world-name world-documentation world-parts world-file
            world-part-names world-part world->parts
            part? part-head part-name part-fields part-all-fields)
  #:re-export (worlds find-world))


;;; The forms.

(eval-when (expand load eval)
  (define (part-form stx)
    ;; Syntax of an expression for the part, or the list of parts, that STX stands for.
    (syntax-case stx ()
      ((head parts ...)
       (and (identifier? #'head) (eq? 'splice (syntax->datum #'head)))
       #'(splice-parts (list parts ...)))
      ((head . part)
       (and (identifier? #'head) (eq? 'part (syntax->datum #'head)))
       #`(data->part #,(part->expression #'part)))
      (_ #`(data->part #,(part->expression stx)))))

  (define (source-file stx)
    (let ((source (syntax-source stx)))
      (or (and source (assq-ref source 'filename)) #f))))

(define-syntax part
  (lambda (form)
    "Return a part as a value: (part HEAD (FIELD VALUE) ...)."
    (syntax-case form ()
      ((_ . part) #`(data->part #,(part->expression #'part))))))

(define-syntax world
  (lambda (form)
    "Return a world of PARTs: (world PART ...), each (HEAD (FIELD VALUE) ...) or (splice EXPRESSION)."
    (syntax-case form ()
      ((_ doc part ...)
       (string? (syntax->datum #'doc))
       #`(build-world #f doc #,(source-file form) (list #,@(map part-form #'(part ...)))))
      ((_ part ...)
       #`(build-world #f #f #,(source-file form) (list #,@(map part-form #'(part ...)))))
      (_ #`(malformed 'world '#,form)))))

(define-syntax define-world
  (lambda (form)
    "Define NAME as a world and make it known by that name: (define-world NAME \"What it is.\" PART ...)."
    (syntax-case form ()
      ((_ name doc part ...)
       (and (identifier? #'name) (string? (syntax->datum #'doc)))
       #`(define name
           (remember-world!
            (build-world 'name doc #,(source-file form) (list #,@(map part-form #'(part ...)))))))
      ((_ name part ...)
       (identifier? #'name)
       #`(define name
           (remember-world!
            (build-world 'name #f #,(source-file form) (list #,@(map part-form #'(part ...)))))))
      (_ #`(malformed 'define-world '#,form)))))

(define-syntax extend
  (lambda (form)
    "Return the world W with more PARTs: (extend W PART ...)."
    (syntax-case form ()
      ((_ w part ...)
       #`(extend-world (the-world 'extend w) (list #,@(map part-form #'(part ...)))))
      (_ #`(malformed 'extend '#,form)))))

(define-syntax with
  (lambda (form)
    "Return the world W with other values in fields of the sea, (with W (current 0.5 90)), or of the part
called NAME, (with W (NAME (FIELD VALUE) ...)).  Clumps of a tether that are given replace all it had; so
do floats."
    (define (change-form clause)
      (syntax-case clause ()
        ((name . _)
         (and (identifier? #'name) (head-field 'sea (syntax->datum #'name)))
         (clause->expression 'sea clause))
        ((name field ...)
         (identifier? #'name)
         #`(list 'name #,@(map (lambda (field) (clause->expression #f field)) #'(field ...))))
        (_ #`'#,clause)))
    (syntax-case form ()
      ((_ w change ...)
       #`(change-world (the-world 'with w) (list #,@(map change-form #'(change ...)))))
      (_ #`(malformed 'with '#,form)))))

(define-verb (without (w the-world) #:rest (names name))
  "Return the world W without the parts called NAMES; the name of a group means all its parts."
  (reduce-world w names))


;;; Asking.

(define-argument-type (a-part value)
  "a part, as (part HEAD (FIELD VALUE) ...) returns"
  (if (is-part? value) value refused))

(define-verb (world? (object any))
  "Return #t if OBJECT is a world."
  (is-world? object))

(define-verb (part? (object any))
  "Return #t if OBJECT is a part of a world."
  (is-part? object))

(define-verb (world-name (w the-world))
  "Return the name of the world W, a symbol, or #f."
  (world-name-of w))

(define-verb (world-documentation (w the-world))
  "Return the sentence that says what the world W is, or #f."
  (world-documentation-of w))

(define-verb (world-parts (w the-world))
  "Return the list of parts of the world W, the sea first."
  (world-parts-of w))

(define-verb (world-file (w the-world))
  "Return the name of the file the world W was written in, or #f."
  (world-file-of w))

(define-verb (part-head (p a-part))
  "Return the head of the part P: sea, rov, tether, box, ..."
  (part-head-of p))

(define-verb (part-name (p a-part))
  "Return the name of the part P, a symbol, or #f before it belongs to a world."
  (part-name-of p))

(define-verb (part-fields (p a-part))
  "Return the alist of fields that the part P gives itself, canonical; `type' is a record.  Each thing
inside P has an entry too, as (clump (at . 6.0) (mass . 2.0)), so that there may be many with one key."
  (part-fields-of p))

(define-verb (part-all-fields (p a-part))
  "Return the alist of fields of the part P, its own before those of its type; things inside P as
`part-fields' has them."
  (all-fields p))

(define-verb (world-part-names (w the-world))
  "Return the names of the parts of the world W, the sea's among them."
  (map part-name-of (world-parts-of w)))

(define-verb (world-part (w the-world) (name name))
  "Return the part NAME of the world W, or raise a &bight-error of kind name."
  (or (find-part (world-parts-of w) name)
      (unknown-part 'world-part w name)))

(define-verb (world->parts (w the-world))
  "Return what the engine is told of the world W: a list of (HEAD NAME ((FIELD . VALUE) ...)) with
canonical values, types resolved, and nothing that was left to its default; a thing inside a part is an
entry (INNER (FIELD . VALUE) ...)."
  (map (lambda (part) (list (part-head-of part) (part-name-of part) (all-fields part)))
       (world-parts-of w)))
