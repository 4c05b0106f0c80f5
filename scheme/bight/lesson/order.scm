;;; (bight lesson order) --- what a command line about lessons asks for.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson order)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module ((bight core options) #:select (bad-usage))
  #:use-module (bight core record)
  #:use-module (bight lesson file)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:export (read-words option seed-of level-of display-of who-of
            make-order is-order? order-of order-file order-outside? order-given))

(define flags '("--check" "--typed" "--trust" "--fresh" "--quiet" "--csv" "--skills" "--table"))
(define options '("--trainee" "--group" "--seed" "--level" "--pilot" "--merge" "--display" "--instructor"
                  "--controller" "--mapping"))

(define (split-option word)
  (let ((i (string-index word #\=)))
    (and i (member (substring word 0 i) options)
         (cons (substring word 0 i) (substring word (+ i 1))))))

(define (pair-of-words? words)
  ;; Is the first of WORDS, an option, followed by a value?
  (and (pair? (cdr words)) (not (string-prefix? "--" (cadr words)))))

(define (read-words command words)
  "Return the plain words of WORDS, what COMMAND was given, and an alist of options; a flag has the
value #t."
  (let loop ((rest words) (plain '()) (given '()))
    (cond ((null? rest) (values (reverse plain) given))
          ((member (car rest) flags) (loop (cdr rest) plain (acons (car rest) #t given)))
          ((split-option (car rest)) => (lambda (pair) (loop (cdr rest) plain (cons pair given))))
          ((member (car rest) options)
           (cond ((pair-of-words? rest) (loop (cddr rest) plain (acons (car rest) (cadr rest) given)))
                 ((and (equal? command "lessons") (equal? (car rest) "--group"))
                  (loop (cdr rest) plain (acons (car rest) #t given))) ; all groups, compared
                 (else (bad-usage "~a: ~a needs a value after it" command (car rest)))))
          ((string-prefix? "-" (car rest))
           (bad-usage "~a has no option ~a~a" command (car rest)
                      (did-you-mean (car (string-split (car rest) #\=)) (append flags options))))
          (else (loop (cdr rest) (cons (car rest) plain) given)))))

(define (option given name default)
  "Return the value of the option NAME among those GIVEN, or DEFAULT."
  (or (assoc-ref given name) default))

(define (seed-of given)
  "Return the seed GIVEN, 1 when there is none."
  (let ((text (option given "--seed" "1")))
    (or (let ((n (text->number text))) (and (exact-integer? n) n))
        (bad-usage "lesson: --seed needs a whole number, not ~a" text))))

(define (word-given given name usual words)
  ;; What the option --NAME says, one of WORDS, a symbol; USUAL, a string, when nothing is said.
  (let ((word (string->symbol (option given (string-append "--" name) usual))))
    (if (memq word words)
        word
        (unknown-name 'lesson "a lesson" word words name))))

(define (level-of given)
  "Return the level GIVEN, a symbol, normal when there is none."
  (word-given given "level" "normal" levels))

(define (display-of given)
  "Return what of the dive's views the pupil may see, a symbol: three, plan or none; three when nothing is said."
  (word-given given "display" "three" displays))

(define (who-of given)
  "Return the name of the pupil, a string."
  (option given "--trainee"
          (or (getenv "BIGHT_TRAINEE") (getenv "LOGNAME") (getenv "USER") "pupil")))

(define (file-like? word)
  (or (string-index word #\/) (string-suffix? ".scm" word)))

(define (absolute file)
  (if (string-prefix? "/" file) file (string-append (getcwd) "/" file)))

(define-record <order>
  (make-order file outside? given)
  is-order?
  (file order-file)
  (outside? order-outside?)             ; it came from outside and is not trusted
  (given order-given))

(define (order-of words given)
  "Return the order for the lesson that WORDS name, with the options GIVEN."
  (unless (= 1 (length words))
    (bad-usage "lesson: name one lesson or file, as in bight lesson read-the-bow; `bight lessons' lists them"))
  (let ((word (car words)))
    (if (file-like? word)
        (begin
          (unless (and (file-exists? word) (eq? 'regular (stat:type (stat word))))
            (bad-usage "lesson: there is no file ~s~a" word (file-meant word)))
          (make-order (absolute word) (not (option given "--trust" #f)) given))
        (make-order (lesson-file word) #f given))))
