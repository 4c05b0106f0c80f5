;;; (bight shell complete) --- what may stand where the cursor is, the likeliest first, each with its meaning.
;;;
;;; The forms around the cursor tell: the keywords of this verb, the names of the kind it asks for, the
;;; fields of this part, the words of this field.  Where nothing is known, the names of the language and the
;;; user's own.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell complete)
  #:use-module (bight core allowance)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module (bight core sentence)
  #:use-module ((bight core signature) #:select (verb-parameters current-subject-lister))
  #:use-module ((bight core verb) #:select (verb? verb-usage))
  #:use-module ((bight dive query) #:select (find-part))
  #:use-module (bight engine)
  #:use-module (bight shell cursor)
  #:use-module ((bight shell guide) #:select (unit-of))
  #:use-module (bight shell meant)
  #:use-module ((ice-9 regex) #:select (regexp-quote))
  #:use-module ((ice-9 session) #:select (apropos-internal))
  #:use-module (srfi srfi-1)
  #:export (candidates-after
            candidate-word
            candidate-meaning
            usage-after
            hint-after))

;; A candidate is a word and its meaning, a thunk that is called when it is shown.
(define-syntax-rule (candidate word meaning)
  (cons word (lambda () meaning)))

(define (candidate-word candidate)
  "Return the word of CANDIDATE, a string."
  (car candidate))

(define (candidate-meaning candidate)
  "Return what CANDIDATE means, a line, or the empty string."
  (first-sentence (or (false-if-exception ((cdr candidate))) "")))

(define (named symbols)
  ;; Candidates for names that are quoted.
  (map (lambda (name) (candidate (symbol->string name) (sentence-of-name name))) symbols))

(define (words symbols)
  (map (lambda (name) (candidate (symbol->string name) "")) symbols))


;;; Names.

(define (user-names)
  (module-map (lambda (name variable) name) (current-module)))

(define (variables word)
  ;; The language's names and the user's own, or Scheme's if none of these begins with WORD.
  ;; The types of errors are for those who ask for them.
  (define (begins? name)
    (let ((text (symbol->string name)))
      (and (string-prefix? word text)
           (or (string-prefix? "&" word) (not (string-prefix? "&" text))))))
  (let* ((language (module-ref (resolve-interface '(bight)) 'language-names))
         (ours (filter begins? (delete-duplicates (append (user-names) (language)) eq?)))
         (all (if (null? ours) (apropos-internal (string-append "^" (regexp-quote word))) ours)))
    (map (lambda (name) (candidate (symbol->string name) (sentence-of-variable name)))
         (sort all (lambda (a b) (string<? (symbol->string a) (symbol->string b)))))))


;;; The names of a kind.

(define (names-in-dive kind)
  (or (false-if-exception ((current-subject-lister) 'complete kind)) '()))

(define most-judged 40)

(define (nearness name)
  ((module-ref (resolve-interface '(bight)) 'clearance) name))

(define (nearest-first names)
  ;; Obstacles, those first that are nearest to the tether.
  (or (and (<= (length names) most-judged)
           (false-if-exception
            (map car (sort (map (lambda (name) (cons name (nearness name))) names)
                           (lambda (a b) (< (cdr a) (cdr b)))))))
      names))

(define (kind phrase)
  (or (assoc-ref (quoted-names) phrase) '()))

(define (names-for parameter)
  ;; The names that PARAMETER, (NAME . TYPE) of a verb, takes, likeliest first, or the empty list.
  (let ((type (argument-type-name (cdr parameter))))
    (cond ((pair? (argument-type-words (cdr parameter))) (words (argument-type-words (cdr parameter))))
          ((memq type '(the-world world-designator world-or-name)) (named (kind "a world")))
          ((memq type '(a-lesson)) (named (kind "a lesson")))
          ((memq type '(describable topic))
           (named (append-map kind '("a part of this dive" "a kind of part" "a type of tether"
                                     "a type of vehicle" "a world"))))
          ((memq type '(name maybe-name maybe-object))
           (case (car parameter)
             ((object) (named (nearest-first (names-in-dive 'obstacle))))
             ((model) (named (kind "a model of tethers")))
             ((kind) (named (kind "an event")))
             ((a b part names) (named (kind "a part of this dive")))
             (else '())))
          (else '()))))


;;; The arguments of a verb.

(define (verb-called head)
  (let ((variable (and head (module-variable (current-module) head))))
    (and variable (variable-bound? variable) (verb? (variable-ref variable)) (variable-ref variable))))

(define (keyword-text keyword)
  (string-append "#:" (symbol->string (keyword->symbol keyword))))

(define (parameter-sentence unit type default)
  (string-append (if unit (string-append unit "; ") "")
                 (argument-type-sentence type)
                 (if default (simple-format #f "; ~a when left out" default) "")))

(define (rows-of verb role)
  ;; The rows (ROLE NAME TYPE DEFAULT) of VERB with ROLE.
  (filter (lambda (row) (eq? role (first row))) (verb-parameters verb)))

(define (keywords verb used)
  (filter-map (lambda (row)
                (let ((text (keyword-text (second row))))
                  (and (not (member text used))
                       (candidate text (parameter-sentence (unit-of (procedure-name verb) (second row))
                                                                (third row) (fourth row))))))
              (rows-of verb 'key)))

(define (all-keywords)
  (let ((language (module-ref (resolve-interface '(bight)) 'language-names)))
    (map (lambda (keyword) (candidate (keyword-text keyword) ""))
         (delete-duplicates
          (append-map (lambda (name)
                        (let ((verb (verb-called name))) (if verb (keywords-of verb) '())))
                      (language))))))

(define (positional items)
  ;; ITEMS without keywords and their values.
  (cond ((null? items) '())
        ((string-prefix? "#:" (car items)) (positional (if (pair? (cdr items)) (cddr items) '())))
        (else (cons (car items) (positional (cdr items))))))

(define (subjects verb)
  (let ((rows (rows-of verb 'subject)))
    (if (null? rows) '() (names-in-dive (second (car rows))))))

(define (after-keyword? items)
  (and (pair? items) (string-prefix? "#:" (last items))))

(define (row-at verb items)
  ;; The row (ROLE NAME TYPE DEFAULT) of what follows ITEMS, the arguments that are there, or #f.
  (if (after-keyword? items)
      (find (lambda (row) (string=? (last items) (keyword-text (second row)))) (rows-of verb 'key))
      (let* ((given (positional items))
             (named? (and (pair? given)
                          (member (car given)
                                  (map (lambda (name) (simple-format #f "'~a" name)) (subjects verb)))))
             (n (length (if named? (cdr given) given)))
             (rows (append (rows-of verb 'required) (rows-of verb 'optional))))
        (if (< n (length rows))
            (list-ref rows n)
            (let ((rest (rows-of verb 'rest))) (and (pair? rest) (car rest)))))))

(define (row-name row)
  (let ((name (second row))) (if (keyword? name) (keyword->symbol name) name)))

(define (names-at verb items)
  ;; What may be quoted after ITEMS: what the parameter takes, then the verb's subjects.
  (let ((row (row-at verb items)))
    (append (if row (names-for (cons (row-name row) (third row))) '())
            (if (null? items) (named (subjects verb)) '()))))

(define (quoted-candidate entry)
  (cons (string-append "'" (car entry)) (cdr entry)))

(define (arguments verb items word)
  ;; What may follow ITEMS, unquoted.
  (let ((names (map quoted-candidate (names-at verb items))))
    (cond ((not (string-null? word)) (variables word))
          ((after-keyword? items) names)
          (else (append names (keywords verb items))))))

(define (altered-fields items)
  ;; Keywords for the fields of the part that (alter! 'PART ...) is about.
  (let* ((name (and (pair? items) (string-prefix? "'" (car items)) (string->symbol (substring (car items) 1))))
         (head (cond ((eq? name 'sea) 'sea)
                     (name (false-if-exception (call-with-values (lambda () (find-part 'alter! name))
                                                 (lambda (kind index) (if (eq? kind 'vehicle) 'rov kind)))))
                     (else #f))))
    (if head
        (map (lambda (entry) (cons (string-append "#:" (car entry)) (cdr entry))) (fields head))
        '())))


;;; Parts of a world.

(define (field-sentence field)
  (string-join
   (remove string-null? (list (field-unit field) (field-text field)
                              (if (string-null? (field-default-string field))
                                  ""
                                  (string-append "default " (field-default-string field)))))
   "; "))

(define (fields head)
  (append (map (lambda (field) (candidate (symbol->string (field-name field)) (field-sentence field)))
               (head-fields head))
          (map (lambda (inner) (candidate (symbol->string inner) (head-sentence inner))) (inner-heads head))))

(define (field-values head name)
  (let ((field (head-field head name)))
    (cond ((not field) '())
          ((eq? name 'type) (named (map part-type-name (part-types head))))
          (else (words (append (field-words field) (map car (field-specials field))))))))

(define (part-like? head) (or (part-head? head) (inner-head? head)))

(define (world-like? head) (memq head '(world define-world extend group)))

(define (in-world heads)
  ;; Candidates where HEADS, of the open forms, the innermost first, #f for one that has none yet, say that a
  ;; part of a world is written; or #f.
  (let ((here (first heads))
        (around (and (pair? (cdr heads)) (second heads))))
    (cond ((and (not here) (world-like? around))
           (map (lambda (head) (candidate (symbol->string head) (head-sentence head))) (part-heads)))
          ((and (not here) (eq? around 'with)) (fields 'sea))
          ((and (not here) around (part-like? around)) (fields around))
          ((and here around (part-like? around) (head-field around here)) (field-values around here))
          (else #f))))


;;; All together.

(define (own-name-begins? word name)
  ;; Does NAME, of a member of a group, begin with WORD behind its last slash?
  (let ((slash (string-rindex name #\/)))
    (and slash (string-prefix? word name 0 (string-length word) (+ 1 slash)))))

(define (begin-with word candidates)
  ;; Those of CANDIDATES that begin with WORD, or else those that are called so in their group.
  (let ((found (filter (lambda (entry) (string-prefix? word (car entry))) candidates)))
    (if (null? found)
        (filter (lambda (entry) (own-name-begins? word (car entry))) candidates)
        found)))

(define (in-form frame around word mark)
  (let* ((head (frame-head frame))
         (items (if head (cdr (frame-items frame)) '()))
         (verb (verb-called head)))
    (cond ((in-world (map frame-head (cons frame around))))
          ((and (eq? head 'alter!) (string-prefix? "#" word)) (altered-fields items))
          ((string-prefix? "#" word) (if verb (keywords verb items) (all-keywords)))
          ((and (eqv? mark #\') verb)
           (let ((names (names-at verb items)))
             (if (null? names) (named (append-map cdr (quoted-names))) names)))
          ((eqv? mark #\') (named (append-map cdr (quoted-names))))
          (verb (arguments verb items word))
          (else (variables word)))))

(define (candidates-after text)
  "Return what may stand at the end of TEXT, what was typed so far: a list of candidates that begin with the word
there, the likeliest first; of the members of groups those too that are called so in their group, if no others are."
  (let* ((cursor (cursor-after text))
         (word (cursor-word cursor))
         (mark (cursor-mark cursor))
         (frames (cursor-frames cursor)))
    (delete-duplicates
     (begin-with word
                 (cond ((memv mark '(#\" #\;)) '())
                       ((pair? frames) (in-form (car frames) (cdr frames) word mark))
                       ((eqv? mark #\') (named (append-map cdr (quoted-names))))
                       ((string-prefix? "#" word) (all-keywords))
                       (else (variables word))))
     (lambda (a b) (string=? (car a) (car b))))))

(define (usage-after text)
  "Return how the verb is called whose arguments are typed at the end of TEXT, a line, or #f."
  (let* ((frames (cursor-frames (cursor-after text)))
         (verb (and (pair? frames) (verb-called (frame-head (car frames))))))
    (and verb (verb-usage verb))))


;;; What is told below the line while it is typed.

(define (row-hint verb row)
  ;; What the argument of ROW of VERB is, with its unit and default.
  (string-append (string-upcase (symbol->string (row-name row))) ": "
                 (parameter-sentence (unit-of (procedure-name verb) (second row)) (third row) (fourth row))))

(define (verb-hint verb items word)
  (let ((row (and (not (string-prefix? "#" word)) (row-at verb items))))
    (string-append (if row (string-append (row-hint verb row) "   ") "") (verb-usage verb))))

(define (field-hint head name)
  (let ((field (head-field head name)))
    (and field (simple-format #f "~a: ~a" name (field-sentence field)))))

(define (hint-after text)
  "Return what is expected at the end of TEXT, what was typed so far: the argument of a verb or the field of a part,
with its unit, what it may be and its default, then how the verb is used; or #f."
  (let* ((cursor (cursor-after text))
         (frames (cursor-frames cursor))
         (head (and (pair? frames) (frame-head (car frames))))
         (around (and (pair? frames) (pair? (cdr frames)) (frame-head (cadr frames))))
         (verb (verb-called head)))
    (cond ((eqv? #\; (cursor-mark cursor)) #f)
          ((and head around (part-like? around)) (field-hint around head))
          (verb (verb-hint verb (cdr (frame-items (car frames))) (cursor-word cursor)))
          (else #f))))
