;;; The reference of the language, as Texinfo, from the live modules: `bight reference.scm >FILE'.
;;;
;;; What a name takes and does is asked of the verb or macro itself, as `help' asks; what a part is made
;;; of is asked of the table that reads worlds.  With the argument --check nothing is written but the
;;; names that say too little of themselves, one a line.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight world describe) #:select (head-description type-description description-sentence
                                               description-rows))
             ((bight shell doc) #:select (docstring-of))
             ((bight core schema) #:select (part-heads inner-heads part-types part-type-name))
             ((bight core verb) #:select (verb? verb-usage verb-arguments))
             (ice-9 rdelim)
             (ice-9 regex)
             (srfi srfi-1))


;;; Text.

(define (escape text)
  (regexp-substitute/global #f "[@{}]" text 'pre (lambda (m) (string-append "@" (match:substring m)))
                            'post))

(define (say . parts)
  (for-each display parts)
  (newline))

;; A word in capitals stands for an argument.
(define word "[A-Za-z0-9*!?-]+")

(define (capitals text)
  (filter (lambda (text) (and (string-any char-upper-case? text) (not (string-any char-lower-case? text))))
          (map match:substring (list-matches word text))))

(define (mark-arguments words text)
  ;; TEXT, escaped, with the WORDS, in capitals, as variables.
  (define (marked m)
    (let ((text (match:substring m)))
      (if (member text words)
          (string-append "@var{" (string-downcase text) "}")
          text)))
  (regexp-substitute/global #f word text 'pre marked 'post))

(define (print-doc name words doc)
  ;; A line that shows how NAME is used begins a line; the others flow.
  (let ((lines (map string-trim (string-split doc #\newline)))
        (form (simple-format #f "(~a" name)))
    (for-each (lambda (line first?)
                (when (and (not first?) (string-prefix? form line))
                  (say "@*"))
                (say (mark-arguments words (escape line))))
              lines
              (cons #t (map (const #f) (cdr lines))))))


;;; The names, by the module that makes them.

(define interface (resolve-interface '(bight)))

(define (module-files folder)
  ;; The files of the modules below FOLDER/bight, whether loaded or not, in order.
  (define found '())
  ((@ (ice-9 ftw) nftw) (string-append folder "/bight")
   (lambda (file info flag base level)
     (when (string-suffix? ".scm" file)
       (set! found (cons file found)))
     #t))
  (sort found string<?))

(define (source-folder)
  (dirname (%search-load-path "bight.scm")))

(define (title-of file)
  ;; (MODULE . TITLE): what the first lines of FILE say of it.
  (call-with-input-file file
    (lambda (port)
      (let loop ((text ""))
        (let* ((line (read-line port))
               (text (string-append text (string-trim line (lambda (c) (memv c '(#\; #\space)))) " "))
               (m (string-match "^(\\(bight [a-z -]+\\)) --- ([^.]*)\\." text)))
          (cond (m (cons (call-with-input-string (match:substring m 1) read) (match:substring m 2)))
                ((string-prefix? ";;;" line) (loop text))
                (else (error "no first line as in `;;; (bight shell doc) --- what it is.'" file))))))))

(define titles
  (map title-of (module-files (source-folder))))

(define (home-of variable)
  ;; The module that exports VARIABLE, and says what it is.
  (find (lambda (entry)
          (let ((i (false-if-exception (resolve-interface (car entry)))))
            (and i (hash-fold (lambda (name v found) (or found (eq? v variable))) #f (module-obarray i)))))
        titles))

(define (title home)
  (if home (cdr home) "the language itself"))

(define (home-name home)
  (if home (object->string (car home)) "(bight)"))

(define homes
  ;; alist, (MODULE . TITLE) or #f -> sorted names.
  (let loop ((names (language-names)) (homes '()))
    (if (null? names)
        (map (lambda (entry) (cons (car entry) (reverse (cdr entry))))
             (sort homes (lambda (a b) (string<? (home-name (car a)) (home-name (car b))))))
        (let* ((home (home-of (module-variable interface (car names))))
               (entry (or (assoc home homes) (list home))))
          (loop (cdr names)
                (cons (cons* home (car names) (cdr entry)) (delete entry homes)))))))


;;; One name.

(define (arguments-of usage name)
  ;; USAGE without its parentheses and NAME, variables marked.
  (let* ((inside (substring usage (+ 1 (string-length (symbol->string name))) (- (string-length usage) 1)))
         (text (string-trim-both inside)))
    (mark-arguments (capitals text) (escape text))))

(define (macro-usage name value)
  (let ((patterns (or (assq-ref (procedure-properties (macro-transformer value)) 'patterns) '())))
    (if (null? patterns)
        (simple-format #f "(~a ...)" name)
        (simple-format #f "~s" (cons name (car patterns))))))

(define (plain-usage name value)
  (car (string-split ((@@ (bight shell doc) plain-usage) name value) #\newline)))

;; A macro shows how it is used in its own words.
(define (forms-in doc)
  (string-join (map match:substring (list-matches "\\([^.]*\\)" doc))))

(define (print-arguments arguments)
  (unless (null? arguments)
    (say "@table @asis")
    (for-each (lambda (argument)
                (let ((name (second argument)))
                  (say "@item @var{" (if (keyword? name) (keyword->symbol name) name) "}")
                  (say (escape (third argument)))))
              arguments)
    (say "@end table")))

(define (print-name name)
  (let* ((value (module-ref interface name))
         (doc (or (docstring-of value) ""))
         (usage (cond ((verb? value) (verb-usage value))
                      ((macro? value) (macro-usage name value))
                      ((procedure? value) (plain-usage name value))
                      (else #f)))
         (words (capitals (if (and usage (not (macro? value))) usage (forms-in doc)))))
    (if usage
        (say "@deffn {" (if (macro? value) "Syntax" "Procedure") "} " (escape (symbol->string name)) " "
             (if (and (macro? value) (string-prefix? "(" doc)) "" (arguments-of usage name)))
        (say "@defvr {Value} " (escape (symbol->string name))))
    (print-doc name words doc)
    (when (procedure? value)
      (print-arguments (verb-arguments value)))
    (say (if usage "@end deffn" "@end defvr"))
    (say)))


;;; Parts, their fields and types.

(define (print-rows rows)
  (say "@table @code")
  (for-each (lambda (row)
              (say "@item " (first row))
              (say (escape (string-join
                            (append (if (string-null? (second row)) '() (list (second row)))
                                    (list (fourth row))
                                    (if (string-null? (third row))
                                        '()
                                        (list (string-append "default " (third row)))))
                            "; "))
                   "."))
            rows)
  (say "@end table"))

(define (print-head head)
  (let ((described (head-description head)))
    (say "@anchor{Part " head "}")
    (say "@subheading " head)
    (say "@cindex " head ", a part")
    (say "A " head " is " (escape (description-sentence described)) ".")
    (print-rows (description-rows described))
    (for-each (lambda (type) (print-type type)) (part-types head))
    (for-each print-head (inner-heads head))))

(define (print-type type)
  (let ((described (type-description type)))
    (say "@cindex " (part-type-name type) ", a type")
    (say "@noindent The type @code{" (part-type-name type) "}: "
         (escape (description-sentence described)))
    (say "@quotation")
    (say (escape (string-join (map (lambda (row)
                                     (string-join (delete "" (take row 3)) " "))
                                   (description-rows described))
                              ", "))
         ".")
    (say "@end quotation")))


;;; All of it.

(define (print-reference)
  (say "@c Made by reference.scm from the live modules.")
  (say "@node Names")
  (say "@section Names")
  (say "The names of @code{(bight)}, by the module that makes them.")
  (say)
  (for-each (lambda (entry)
              (let ((home (car entry)))
                (say "@subheading " (escape (home-name home)) ": " (escape (title home)))
                (for-each print-name (cdr entry))))
            homes)
  (say "@node Parts and fields")
  (say "@section Parts and fields")
  (say "What may stand in a world, as @code{describe} tells it.")
  (say)
  (for-each print-head (part-heads)))

(define (too-short name)
  ;; Whether NAME's own words are missing or no sentence.
  (let ((doc (docstring-of (module-ref interface name))))
    (not (and doc (>= (string-length doc) 10) (string-index doc #\.)))))

(if (member "--check" (command-line))
    (for-each (lambda (name) (say name)) (filter too-short (language-names)))
    (print-reference))
