;;; (bight core errors) --- the one kind of error a user of bight meets.
;;;
;;; Every mistake raises a condition of type &bight-error that says what kind of mistake it was, which
;;; procedure met it, one sentence, and what was given.  The condition also carries Guile's own
;;; &message, &origin, &irritants and throw key (`bight-error'), so that `guard', `catch', the prompt
;;; and an uncaught error in a script all show the same clear line.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core errors)
  #:use-module ((bight core here) #:select (note-place!))
  #:use-module (ice-9 exceptions)
  #:use-module (srfi srfi-1)
  #:export (&bight-error
            bight-error?
            bight-error-kind
            bight-error-procedure
            bight-error-message
            bight-error-given
            bight-error-kinds
            bight-raise
            raise-engine-error
            whole-args
            unknown-name
            nearest
            did-you-mean
            word->string
            words->string
            abbreviate
            brief))

(define bight-error-kinds
  '(domain name stale def limit diverged io format version unsupported))

(define &bight-error
  (make-exception-type '&bight-error &error '(kind procedure message given)))

(set-object-property! &bight-error 'documentation
                      "The type of condition that every mistake raises.")

(define make-bight-error (record-constructor &bight-error))

;; What asks of a condition cannot be a verb, since verbs raise conditions: it checks its own argument.
(define-syntax-rule (define-question (name condition) doc body)
  (define name
    (case-lambda
      doc
      ((condition) body)
      (arguments (bight-raise 'domain 'name "it is used as (~a CONDITION); ~a arguments were given"
                              'name (length arguments))))))

(define (ours? object)
  ;; Guile's own predicates trip over structures that are no records, such as record types.
  (and (record? object)
       ((exception-predicate &bight-error) object)))

(define-question (bight-error? obj)
  "Return true if OBJ is a condition raised by bight."
  (ours? obj))

(define-syntax-rule (define-error-field name field doc)
  (define-question (name condition)
    doc
    (if (ours? condition)
        ((exception-accessor &bight-error (record-accessor &bight-error 'field)) condition)
        (bight-raise 'domain 'name "the condition must be one raised by bight, not ~s" condition))))

(define-error-field bight-error-kind kind
  "Return the kind of CONDITION: domain name stale def limit diverged io format version unsupported.")
(define-error-field bight-error-procedure procedure
  "Return the symbol of the procedure that raised CONDITION, or #f.")
(define-error-field bight-error-message message
  "Return the sentence of CONDITION, a string.")
(define-error-field bight-error-given given
  "Return the list of values that CONDITION complains of.")


;;; Raising.

(define (raise-sentence kind proc text given)
  (raise-exception
   (note-place!
    (make-exception (make-bight-error kind proc text given)
                    (make-exception-with-message text)
                    (make-exception-with-origin proc)
                    (make-exception-with-irritants '())
                    (make-exception-from-throw 'bight-error (list proc text kind given))))))

(define (bight-raise kind proc format-string . args)
  "Raise a &bight-error of KIND, a symbol, from PROC, a symbol or #f.  Its sentence is FORMAT-STRING
with ~a, ~s and ~~ filled in from ARGS, which are abbreviated there and kept whole as the values given."
  (raise-sentence kind proc
                  (apply simple-format #f format-string (map abbreviate args))
                  args))

(define (raise-engine-error kind proc text)
  "Raise a &bight-error of KIND from PROC with the sentence TEXT, as the engine found it."
  (raise-sentence kind proc text '()))

(define (print-bight-error port key args default-printer)
  (let* ((proc (car args))
         (text (cadr args))
         (prefix (if proc (simple-format #f "~a" proc) "")))
    (unless (or (string-null? prefix) (string-prefix? prefix text))
      (display prefix port)
      (display ": " port))
    (display text port)))

(set-exception-printer! 'bight-error print-bight-error)


;; A name that nobody defined: what was meant is looked up only then.
(define (print-unbound port key args default-printer)
  (let ((name (and (pair? (caddr args)) (car (caddr args)))))
    (apply simple-format port (cadr args) (caddr args))
    (when (symbol? name)
      (display (or (false-if-exception
                    ((module-ref (resolve-interface '(bight shell meant)) 'unbound-hint) name))
                   "")
               port))))

(set-exception-printer! 'unbound-variable print-unbound)

;; Guile 3.0.8 raises what is out of the range of an unsigned number with a first irritant, the least value, that is
;; no value at all: whoever looks at it dies.
(define of-a-range "Value out of range ~S to< ~S: ~S")

(define (whole-args args)
  "Return ARGS of an exception, (PROCEDURE MESSAGE IRRITANTS . REST), with irritants that can be looked at."
  (if (and (pair? args) (pair? (cdr args)) (equal? of-a-range (cadr args)))
      (cons* (car args) "Value out of range: ~S; it may be ~S at most" (reverse (cdr (caddr args))) (cdddr args))
      args))

(define (print-out-of-range port key args default-printer)
  (let ((args (whole-args args)))
    (when (car args)
      (simple-format port "~a: " (car args)))
    (apply simple-format port (cadr args) (map abbreviate (caddr args)))))

(set-exception-printer! 'out-of-range print-out-of-range)


;;; Showing what was given, however large, deep or circular.

(define items-shown 8)
(define levels-shown 3)
(define characters-shown 160)

;; What prints as its text in place of something too long to print.
(define <stand-in>
  (make-record-type 'stand-in '(text)
                    (lambda (it port) (display (struct-ref it 0) port))))

(define stand-in (record-constructor <stand-in>))

(define (clip text)
  (if (> (string-length text) characters-shown)
      (string-append (substring text 0 (- characters-shown 1)) "…")
      text))

(define (abbreviate-list items level)
  (let loop ((rest items) (room items-shown))
    (cond ((null? rest) '())
          ((not (pair? rest)) (abbreviate-to rest level))
          ((zero? room) '(…))
          (else (cons (abbreviate-to (car rest) level)
                      (loop (cdr rest) (- room 1)))))))

(define (abbreviate-array array level)
  (let* ((long? (> (array-length array) items-shown))
         (head (map (lambda (i) (abbreviate-to (array-ref array i) level))
                    (iota (min items-shown (array-length array)) (caar (array-shape array))))))
    (list->vector (if long? (append head '(…)) head))))

(define (abbreviate-integer n)
  (if (< (abs n) (expt 10 21))
      n
      (stand-in (simple-format #f "an integer of ~a bits" (integer-length n)))))

(define (abbreviate-struct value)
  ;; Some records print as a page: such a one by the name of its type alone.
  (let ((text (simple-format #f "~s" value)))
    (if (or (> (string-length text) characters-shown) (string-index text #\newline))
        (stand-in (simple-format #f "#<~a>" (record-type-name (struct-vtable value))))
        value)))

(define (abbreviate-to value level)
  (cond ((string? value) (clip value))
        ((symbol? value)
         (let ((text (symbol->string value)))
           (if (> (string-length text) characters-shown) (string->symbol (clip text)) value)))
        ((and (number? value) (exact? value) (rational? value) (not (integer? value)))
         (if (< (integer-length (denominator value)) 70) value (stand-in "a long fraction")))
        ((and (number? value) (exact-integer? value)) (abbreviate-integer value))
        ((pair? value) (if (zero? level) '… (abbreviate-list value (- level 1))))
        ((and (array? value) (not (vector? value)) (<= (array-size value) items-shown)) value)
        ((and (array? value) (= 1 (array-rank value)))
         (if (zero? level) '… (abbreviate-array value (- level 1))))
        ((array? value)
         (stand-in (simple-format #f "an array of shape ~a" (array-dimensions value))))
        ((and (struct? value) (record? value)) (abbreviate-struct value))
        (else value)))

(define (array-size array)
  ;; Bounds need not begin at 0.
  (fold (lambda (bounds size) (* size (+ 1 (- (cadr bounds) (car bounds))))) 1 (array-shape array)))

(define (abbreviate value)
  "Return VALUE itself if it is short, else something short that prints like it.  Circular, deep and
huge data are cut."
  (abbreviate-to value levels-shown))

(define (brief value)
  "Return VALUE written in at most a line, a string."
  (clip (simple-format #f "~s" (abbreviate value))))


;;; The nearest thing meant.

(define longest-word 48)

(define (word->string word)
  "Return WORD, a symbol, keyword, string or anything else, as a person would type it."
  (cond ((symbol? word) (clip (symbol->string word)))
        ((string? word) (clip word))
        (else (brief word))))

(define (words->string words)
  "Return WORDS joined by commas."
  (string-join (map word->string words) ", "))

(define (edit-row above two-above char previous b)
  ;; One row of the edit-distance table of CHAR (after PREVIOUS) against the string B.
  (let* ((n (string-length b))
         (row (make-vector (+ n 1) (+ 1 (vector-ref above 0)))))
    (do ((j 1 (+ j 1)))
        ((> j n) row)
      (let* ((same? (char=? char (string-ref b (- j 1))))
             (swap? (and (> j 1)
                         (char=? char (string-ref b (- j 2)))
                         (char=? previous (string-ref b (- j 1)))))
             (best (min (+ 1 (vector-ref above j))
                        (+ 1 (vector-ref row (- j 1)))
                        (+ (if same? 0 1) (vector-ref above (- j 1))))))
        (vector-set! row j (if swap? (min best (+ 9/10 (vector-ref two-above (- j 2)))) best))))))

(define (beyond? row limit)
  ;; Whether all of ROW is above LIMIT.
  (let loop ((j (- (vector-length row) 1)))
    (or (< j 0)
        (and (> (vector-ref row j) limit) (loop (- j 1))))))

(define (edit-distance a b limit)
  ;; Insertions, deletions, substitutions and swaps of neighbours (optimal string alignment).  The row
  ;; above the first is farther than anything: no swap begins there.  A swap keeps all letters, so it is a
  ;; little nearer than a wrong one: `piel' is pile rather than pier.  A row follows from the two above it and is
  ;; no nearer than they are: where both are above LIMIT the words are.
  (let* ((width (+ 1 (string-length b)))
         (nowhere (make-vector width (+ width (string-length a)))))
    (let loop ((i 0) (above (list->vector (iota width))) (two-above nowhere))
      (cond ((= i (string-length a)) (vector-ref above (string-length b)))
            ((and (beyond? above limit) (beyond? two-above limit)) longest-word)
            (else (loop (+ i 1)
                        (edit-row above two-above (string-ref a i)
                                  (if (zero? i) #\nul (string-ref a (- i 1))) b)
                        above))))))

;; What marks a word as an option, or as a keyword, is not part of its spelling.
(define marks (string->char-set "-#:"))

(define (letters-of word)
  (let ((letters (string-trim word marks)))
    (string-downcase (if (string-null? letters) word letters))))

(define (word-distance a b limit)
  ;; How far B is from A, both as `letters-of' has them; any number above LIMIT when it is farther.
  (let ((n (string-length a)) (m (string-length b)))
    (cond ((string=? a b) 0)
          ((or (> n longest-word) (> m longest-word)) longest-word)
          ((and (>= n 3) (string-prefix? a b)) 1)
          ((> (abs (- n m)) limit) longest-word)
          (else (edit-distance a b limit)))))

(define (own-name letters)
  ;; What a member of a group is called in the group: LETTERS behind the last slash.
  (substring letters (+ 1 (or (string-rindex letters #\/) -1))))

(define (distance-to letters candidate limit)
  ;; How far CANDIDATE is from LETTERS: a member of a group may be meant by its own name.
  (let* ((whole (letters-of (word->string candidate))) (own (own-name whole)))
    (if (string=? own whole)
        (word-distance letters whole limit)
        (min (word-distance letters whole limit) (+ 1/2 (word-distance letters own limit))))))

(define (nearest word candidates)
  "Return the member of CANDIDATES spelt most like WORD, or #f when none is near.  Words are symbols,
keywords or strings; of GROUP/NAME, NAME alone may be like WORD."
  (let* ((text (word->string word))
         (letters (letters-of text))
         (limit (max 1 (quotient (+ 1 (string-length text)) 3))))
    (let loop ((rest candidates) (best #f) (distance (+ limit 1)))
      (if (null? rest)
          best
          (let ((d (distance-to letters (car rest) (min limit distance)))) ; a farther one is no matter
            (if (< d distance)
                (loop (cdr rest) (car rest) d)
                (loop (cdr rest) best distance)))))))

(define (did-you-mean word candidates)
  "Return \"; did you mean `CANDIDATE'?\" about the member of CANDIDATES spelt most like WORD, or the empty
string when none is near."
  (let ((near (nearest word candidates)))
    (if near (string-append "; did you mean `" (word->string near) "'?") "")))

;; So much of a list that the hint behind it is not cut off at the end of a line.
(define list-shown 60)

(define (fit names room)
  ;; As many of NAMES as take ROOM characters, at least the first.
  (let loop ((rest names) (room room) (kept '()))
    (let ((left (and (pair? rest) (- room 2 (string-length (word->string (car rest)))))))
      (if (and left (or (null? kept) (>= left 0)))
          (loop (cdr rest) left (cons (car rest) kept))
          (reverse kept)))))

(define (list-names names)
  (let ((kept (fit names list-shown)))
    (string-append (words->string kept) (if (= (length kept) (length names)) "" ", …"))))

(define* (unknown-name proc what given candidates #:optional noun)
  "Raise a &bight-error of kind name from PROC: WHAT, such as \"a tether\", has no NOUN GIVEN; it has
CANDIDATES, the nearest first.  NOUN, a string, may be left out."
  (let* ((near (nearest given candidates))
         (ordered (if near (cons near (delete near candidates)) candidates)))
    (raise-sentence
     'name proc
     (string-append what " has no " (if noun (string-append noun " ") "")
                    "`" (word->string given) "'; it has "
                    (if (null? ordered) "none" (list-names ordered))
                    (did-you-mean given candidates))
     (list given))))
