;;; (bight core part) --- parts and worlds as records.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core part)
  #:use-module (bight core errors)
  #:use-module ((bight core record) #:select (document))
  #:use-module (bight core schema)
  #:use-module (bight world group)
  #:use-module (bight world types)
  #:use-module (srfi srfi-1)
  #:export (make-part is-part? part-head-of part-name-of part-fields-of
            make-world is-world? world-name-of world-documentation-of world-parts-of world-file-of
            all-fields
            find-part
            group-members
            world-title
            unknown-part))

(define <part>
  (make-record-type 'part '(head name fields) (lambda (part port) (print-part part port))))

(define make-part (record-constructor <part>))
(define part-head-of (record-accessor <part> 'head))
(define part-name-of (record-accessor <part> 'name))
(define part-fields-of (record-accessor <part> 'fields))
(define is-part? (record-predicate <part>))

(define <world>
  (make-record-type 'world '(name documentation parts file)
                    (lambda (world port) (print-world world port))))

(define make-world (record-constructor <world>))
(define is-world? (record-predicate <world>))
(define world-name-of (record-accessor <world> 'name))
(define world-documentation-of (record-accessor <world> 'documentation))
(define world-parts-of (record-accessor <world> 'parts))
(define world-file-of (record-accessor <world> 'file))

(document
 (make-part "Return a part: its HEAD, NAME (#f: not yet) and alist of canonical FIELDS.")
 (make-world "Return a world: NAME, DOCUMENTATION, PARTS, FILE.")
 (is-part? "Return true if OBJECT is a part.")
 (part-head-of "Return the head of PART, a symbol.")
 (part-name-of "Return the name of PART, a symbol, or #f.")
 (part-fields-of "Return the alist of fields PART itself gives, canonical, and what is inside it.")
 (is-world? "Return true if OBJECT is a world.")
 (world-name-of "Return the name of WORLD, a symbol, or #f.")
 (world-documentation-of "Return the sentence of WORLD, or #f.")
 (world-parts-of "Return the parts of WORLD, the sea first.")
 (world-file-of "Return the name of the file WORLD was written in, or #f."))

(define (print-part part port)
  (simple-format port "#<~a~a>" (part-head-of part)
                 (if (part-name-of part) (string-append " " (symbol->string (part-name-of part))) "")))

(define plurals
  '((box . "boxes") (mesh . "meshes") (convex . "convex bodies")))

(define (plural n head)
  (if (= n 1)
      (simple-format #f "1 ~a" head)
      (simple-format #f "~a ~a" n (or (assq-ref plurals head)
                                      (string-append (symbol->string head) "s")))))

(define (inventory world)
  ;; "1 rov, 2 tethers"
  (let ((counts (filter-map
                 (lambda (head)
                   (let ((n (count (lambda (part) (eq? head (part-head-of part))) (world-parts-of world))))
                     (and (> n 0) (not (eq? head 'sea)) (plural n head))))
                 (part-heads))))
    (if (null? counts) "open water" (string-join counts ", "))))

(define (print-world world port)
  (simple-format port "#<world~a: ~a>"
                 (if (world-name-of world)
                     (string-append " " (symbol->string (world-name-of world)))
                     "")
                 (inventory world)))

(define (all-fields part)
  "Return the alist of fields of PART, its own before those of its type."
  (let* ((own (part-fields-of part))
         (type (assq-ref own 'type)))
    (alist-delete 'type (merge-fields own (if type (part-type-fields type) '())) eq?)))

(define (find-part parts name)
  "Return the one of PARTS called NAME, or #f."
  (find (lambda (part) (eq? name (part-name-of part))) parts))

(define (group-members parts name)
  "Return those of PARTS, the parts of a world, that belong to the group NAME."
  (filter (lambda (part) (member-of? name (part-name-of part))) parts))

(define (unknown-part proc w name)
  "Raise a &bight-error of kind name from PROC: the world W has no part NAME."
  (unknown-name proc (world-title w) name (map part-name-of (world-parts-of w)) "part"))

(define (world-title w)
  "Return what the world W is called in a sentence."
  (if (world-name-of w)
      (string-append "world " (symbol->string (world-name-of w)))
      "this world"))
