;;; Run every example of documents: `bight documents.scm FILE...', as TAP without a plan.
;;;
;;; In a manual (.texi) a block @lisp is Scheme, @example shell a script, @example c a program; a block
;;; @example without a word is a mistake, since nobody could try it.  In a text with fences (.md) they are
;;; ```scheme, ```sh, ```c; a fence without a word is tried when it shows the prompt.
;;;
;;; A block with lines that begin `bight> ' (in a script `$ ') is a conversation: what stands below such a
;;; line is compared with what is printed there.  A number is as shown when it rounds to it, a line of
;;; dots stands for anything.  All blocks of a document are one session, in an empty folder.  What this
;;; build of bight does not support is skipped.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (tests documents)
  #:use-module ((bight core errors) #:select (bight-error? bight-error-kind))
  #:use-module ((bight core told) #:select (exception->line))
  #:use-module (ice-9 popen)
  #:use-module (ice-9 rdelim)
  #:use-module (ice-9 regex)
  #:use-module (ice-9 textual-ports)
  #:use-module (srfi srfi-1))


;;; Blocks: (LANGUAGE FIRST-LINE LINES).

(define (unescaped line)
  (regexp-substitute/global #f "@([@{}])" line 'pre 1 'post))

(define (texinfo-opening line)
  (cond ((string=? line "@lisp") "scheme")
        ((string=? line "@example") "nothing")
        ((string-prefix? "@example " line) (string-trim-both (substring line 9)))
        (else #f)))

(define (texinfo-closing? line)
  (or (string=? line "@end lisp") (string=? line "@end example")))

(define (markdown-opening line)
  (and (string-prefix? "```" line)
       (if (string=? line "```") "text" (substring line 3))))

(define (markdown-closing? line)
  (string=? line "```"))

(define (blocks-of file)
  (let* ((manual? (string-suffix? ".texi" file))
         (opening (if manual? texinfo-opening markdown-opening))
         (closing? (if manual? texinfo-closing? markdown-closing?))
         (tidy (if manual? unescaped identity)))
    (call-with-input-file file
      (lambda (port)
        (let outside ((number 1) (blocks '()))
          (let ((line (read-line port)))
            (cond ((eof-object? line) (reverse blocks))
                  ((opening line)
                   => (lambda (language)
                        (let inside ((next (+ number 1)) (lines '()))
                          (let ((line (read-line port)))
                            (if (or (eof-object? line) (closing? line))
                                (outside (+ next 1) (cons (list language number (reverse lines)) blocks))
                                (inside (+ next 1) (cons (tidy line) lines)))))))
                  (else (outside (+ number 1) blocks)))))))))

(define (conversation lines prompt)
  ;; The turns of LINES, pairs of what is typed and the lines expected below it; #f when there is no PROMPT.
  (define (more line turn)
    (cons (car turn) (append (cdr turn) (list line))))
  (and (any (lambda (line) (string-prefix? prompt line)) lines)
       (reverse
        (fold (lambda (line turns)
                (if (string-prefix? prompt line)
                    (cons (list (substring line (string-length prompt))) turns)
                    (cons (more line (car turns)) (cdr turns))))
              '()
              lines))))


;;; Comparing what is shown with what is printed.

(define number-pattern (make-regexp "-?[0-9]+(\\.[0-9]+)?(e-?[0-9]+)?"))

(define (pieces text)
  ;; TEXT as texts and numbers, as written, in turn.
  (let loop ((from 0) (matches (list-matches number-pattern text)) (found '()))
    (if (null? matches)
        (reverse (cons (substring text from) found))
        (loop (match:end (car matches))
              (cdr matches)
              (cons* (match:substring (car matches)) (substring text from (match:start (car matches)))
                     found)))))

(define (decimals shown)
  (let ((dot (string-index shown #\.)))
    (if dot (- (string-length shown) dot 1) 0)))

(define (rounds-to? printed shown)
  ;; A number is given a unit of its last place: it may have been cut, and computers differ.
  (or (string=? printed shown)
      (and (string-index shown #\.)
           (<= (abs (- (string->number printed) (string->number shown)))
               (* 1.0001 (expt 10. (- (decimals shown))))))))

(define (line-as-shown? printed shown)
  (let ((a (pieces printed)) (b (pieces shown)))
    (and (= (length a) (length b))
         (every (lambda (x y i) (if (odd? i) (rounds-to? x y) (string=? x y))) a b (iota (length a))))))

(define (as-shown? printed shown)
  (cond ((null? shown) (null? printed))
        ((string=? "..." (string-trim-both (car shown))) #t)
        ((null? printed) #f)
        (else (and (line-as-shown? (string-trim-right (car printed)) (string-trim-right (car shown)))
                   (as-shown? (cdr printed) (cdr shown))))))

(define (lines-of text)
  (let ((lines (string-split text #\newline)))
    (reverse (drop-while string-null? (reverse lines)))))


;;; Scheme.

(define (print-values . values)
  (for-each (lambda (value)
              (unless (unspecified? value)
                (write value)
                (newline)))
            values))

(define (unsupported? exception)
  (and (bight-error? exception) (eq? 'unsupported (bight-error-kind exception))))

(define session (resolve-module '(guile-user))) ; a script's: it has the language

(define (evaluate form)
  (save-module-excursion
   (lambda ()
     (set-current-module session)
     (primitive-eval form))))

(define (say-or-raise exception shown?)
  ;; At the prompt a mistake is one line, which may be what is shown.
  (if shown?
      (begin (display (exception->line exception)) (newline))
      (raise-exception exception)))

(define (printed-by form shown?)
  (with-output-to-string
    (lambda ()
      (with-exception-handler
          (lambda (exception) (say-or-raise exception shown?))
        (lambda () (call-with-values (lambda () (evaluate form)) print-values))
        #:unwind? #t))))

(define (differs what printed)
  (list (string-append "typed: " what)
        (string-append "printed: " printed)))

(define (try-turn typed shown)
  ;; #f when it is as shown, else lines that tell.  A form may go on below its first line.
  (let* ((port (open-input-string (string-join (cons typed shown) "\n")))
         (form (read port))
         (shown (lines-of (string-trim (get-string-all port) #\newline)))
         (printed (printed-by form (pair? shown))))
    (and (pair? shown)
         (not (as-shown? (lines-of printed) shown))
         (differs typed printed))))

(define (try-script lines)
  (let ((port (open-input-string (string-join lines "\n"))))
    (let loop ()
      (let ((form (read port)))
        (unless (eof-object? form)
          (with-output-to-string (lambda () (evaluate form)))
          (loop))))
    #f))

(define (try-scheme lines)
  (let ((turns (conversation lines "bight> ")))
    (if turns
        (any (lambda (turn) (try-turn (car turn) (cdr turn))) turns)
        (try-script lines))))


;;; Shell and C.

(define (output-and-status command)
  ;; Each of several commands must succeed.
  (let* ((port (open-input-pipe (string-append "set -e\n{ " command "\n} 2>&1 </dev/null")))
         (text (get-string-all port)))
    (values text (status:exit-val (close-pipe port)))))

(define (try-command command shown)
  (call-with-values (lambda () (output-and-status command))
    (lambda (text status)
      (cond ((pair? shown) (and (not (as-shown? (lines-of text) shown)) (differs command text)))
            ((eqv? 0 status) #f)
            (else (differs command text))))))

(define (try-shell lines)
  (let ((turns (conversation lines "$ ")))
    (if turns
        (any (lambda (turn) (try-command (car turn) (cdr turn))) turns)
        (try-command (string-join lines "\n") '()))))

(define (try-c lines)
  ;; The environment says how a program is built and run: $RUN_C FILE.
  (call-with-output-file "example.c"
    (lambda (port) (display (string-join lines "\n" 'suffix) port)))
  (try-command "$RUN_C example.c" '()))


;;; All of them.

(define (shows-prompt? lines)
  (any (lambda (line) (string-prefix? "bight> " line)) lines))

(define (trial language lines)
  (cond ((string=? language "scheme") (lambda () (try-scheme lines)))
        ((string=? language "sh") (lambda () (try-shell lines)))
        ((string=? language "shell") (lambda () (try-shell lines)))
        ((string=? language "c") (lambda () (try-c lines)))
        ((and (string=? language "text") (shows-prompt? lines)) (lambda () (try-scheme lines)))
        ((string=? language "text") #f)
        (else (lambda () (list (string-append "nobody can try an example in `" language "'"))))))

(define (outcome try)
  ;; #t, #f, the reason it is skipped, a string, or the lines that tell why it failed.
  (with-exception-handler
      (lambda (exception)
        (if (unsupported? exception)
            (exception->line exception)
            (list (exception->line exception))))
    (lambda () (or (try) #t))
    #:unwind? #t))

(define (tell name result)
  (simple-format #t "~aok - ~a~a\n" (if (pair? result) "not " "") name
                 (if (string? result) (string-append " # SKIP " result) ""))
  (when (pair? result)
    (for-each (lambda (line) (simple-format #t "# ~a\n" line))
              (append-map (lambda (text) (string-split text #\newline)) result)))
  (force-output))

(define (try-document file)
  (for-each (lambda (block)
              (let ((try (trial (first block) (third block))))
                (when try
                  (tell (simple-format #f "~a:~a" (basename file) (second block)) (outcome try)))))
            (blocks-of file)))

(for-each try-document (cdr (command-line)))
