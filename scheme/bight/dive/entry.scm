;;; (bight dive entry) --- what was done to a dive, and what came of it, as lines of text.
;;;
;;; An entry of the journal of a dive is written as (do STEP OPERATION SUBJECT NUMBER ...), and done again from
;;; that line.  A QUANTITY of what came of it is (rov NAME x y z heading) or (tether NAME length
;;; tension-at-anchor tension-at-end "16 bits of each node").
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive entry)
  #:use-module (bight core errors)
  #:use-module (bight dive past)
  #:use-module (bight engine)
  #:use-module (bight world)
  #:use-module ((rnrs bytevectors) #:select (string->utf8))
  #:use-module (srfi srfi-1)
  #:export (entry->line redo-line! quantity-heads quantities digits short-hash))


;;; Operations as lines.

(define operations (%operations))

(define (part-names engine head)
  (if (eq? head 'sea) '(sea) (%names engine head)))

(define part-heads '(sea rov tether obstacle)) ; by the engine's numbers

(define (schema-head engine world head index)
  ;; The head that the fields of the INDEX-th part of kind HEAD belong to.
  (if (eq? head 'obstacle)
      (part-head (world-part world (list-ref (%names engine 'obstacle) index)))
      head))

(define (field-names head)
  (map (lambda (v) (vector-ref v 0)) (%part-fields head)))

(define (alter->words engine world subject numbers)
  ;; PART FIELD VALUE
  (let ((head (list-ref part-heads (inexact->exact (first numbers)))))
    (list (list-ref (part-names engine head) subject)
          (list-ref (field-names (schema-head engine world head subject))
                    (inexact->exact (second numbers)))
          (third numbers))))

(define (entry->line engine world entry)
  "Return the line of a recording for ENTRY of the journal of ENGINE, a dive in WORLD."
  (let* ((operation (entry-operation entry))
         (head (assq-ref operations operation))
         (subject (entry-subject entry))
         (numbers (f64vector->list (entry-numbers entry))))
    (cons* 'do (entry-step entry) operation
           (cond ((eq? operation 'alter) (alter->words engine world subject numbers))
                 (head (cons (list-ref (part-names engine head) subject) numbers))
                 (else (cons subject numbers))))))

(define (index-of name names)
  (or (list-index (lambda (other) (eq? name other)) names)
      (unknown-name 'replay "the recorded world" name names "part")))

(define (find-subject engine name)
  ;; Two values: the number of the kind of the part called NAME, and its index.
  (let ((kind (list-index (lambda (head) (memq name (part-names engine head))) part-heads)))
    (unless kind
      (unknown-name 'replay "the recorded world" name
                    (append-map (lambda (head) (part-names engine head)) part-heads) "part"))
    (values kind (index-of name (part-names engine (list-ref part-heads kind))))))

(define (redo-alter! engine world name field value)
  (call-with-values (lambda () (find-subject engine name))
    (lambda (kind index)
      (let ((fields (field-names (schema-head engine world (list-ref part-heads kind) index))))
        (%redo! engine 'alter index (f64vector kind (index-of field fields) value))))))

(define (redo-line! engine world line)
  ;; Do what LINE, (do STEP OPERATION SUBJECT NUMBER ...), says.
  (let* ((operation (third line)) (rest (cdddr line)) (head (assq-ref operations operation)))
    (if (eq? operation 'alter)
        (apply redo-alter! engine world rest)
        (%redo! engine operation
                (if head (index-of (car rest) (part-names engine head)) (car rest))
                (list->f64vector (cdr rest))))))


;;; What came of it.

(define (digits n width)
  (let ((text (number->string n 16)))
    (string-append (make-string (- width (string-length text)) #\0) text)))

(define (quantity-heads engine)
  "Return how the quantities of each part of ENGINE begin: what `quantities' wants, the same for all time."
  (define (heads head)
    (map (lambda (name) (string->utf8 (string-append "(" (symbol->string head) " " (object->string name))))
         (%names engine head)))
  (cons (heads 'rov) (heads 'tether)))

(define (quantities engine heads)
  "Return what came of ENGINE, whose parts have the HEADS of `quantity-heads', UTF-8 in a bytevector."
  (%quantities engine (car heads) (cdr heads)))

(define (short-hash engine)
  (logand #xffffffff (%hash-dive engine)))
