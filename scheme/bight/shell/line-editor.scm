;;; (bight shell line-editor) --- lines that a person edits at a terminal: readline, with history and completion.
;;;
;;; Guile's module (ice-9 readline) reads a line; (bight shell readline) tells of the line while it is edited.  A form
;;; may take several lines: Enter in an unfinished form begins another, indented as the ones before ask for, and
;;; all of them can be edited until the form is whole.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell line-editor)
  #:use-module (bight core folders)
  #:use-module ((bight core terminal) #:select (terminal-size))
  #:use-module ((bight outlet) #:select (behind watched? shown))
  #:use-module (bight shell complete)
  #:use-module (bight shell cursor)
  #:use-module (bight shell highlight)
  #:use-module (bight shell readline)
  #:use-module ((bight shell typed) #:select (keep-typed-text!))
  #:use-module (ice-9 buffered-input)
  #:use-module (srfi srfi-1)
  #:export (call-with-line-editing))

(define-syntax-rule (guiles name)
  ;; What Guile's module calls NAME: it is loaded at a terminal alone.
  (module-ref (resolve-module '(ice-9 readline)) 'name))

(define-syntax-rule (own name)
  (module-ref (resolve-module '(bight shell readline)) 'name))


;;; What was typed of the form that is being read before what is edited now: the reader wanted more than Enter
;;; took to be a whole form, as after a lone quote.

(define earlier "")

(define (typed-so-far)
  (string-append earlier ((own %line-before-cursor))))


;;; Lists of completions.

(define terminal #f)                    ; the port that lines are read from

(define rows-kept 3)                    ; of the screen, for the line itself and what led to it

(define (cut text width)
  (if (> (string-length text) width)
      (string-append (substring text 0 (max 0 (- width 1))) "…")
      text))

(define (listed entries head)
  ;; The lines that show ENTRIES, pairs (WORD . MEANING), below HEAD, a line or #f.
  (let* ((size (with-input-from-port terminal terminal-size))
         (room (max 3 (- (car size) rows-kept (if head 1 0))))
         (few (if (> (length entries) room) (take entries (- room 1)) entries))
         (width (fold (lambda (entry width) (max width (string-length (car entry)))) 0 few))
         (line (lambda (entry)
                 (string-trim-right
                  (string-append "  " (string-pad-right (car entry) width) "  " (cdr entry)))))
         (left (- (length entries) (length few))))
    (map (lambda (text) (shown (cut text (- (cdr size) 1))))
         (append (if head (list head) '())
                 (map line few)
                 (if (positive? left) (list (simple-format #f "  and ~a more" left)) '())))))

(define (lines->text lines)
  (string-join lines "\n" 'suffix))

(define found '())                      ; the candidates of the last completion

(define (list-words words)
  ;; The text that readline shows for WORDS, several of the candidates that were found.
  (define (entry word)
    (let ((candidate (find (lambda (c) (string=? word (candidate-word c))) found)))
      (cons word (if candidate (candidate-meaning candidate) ""))))
  (or (false-if-exception (lines->text (listed (map entry words) (usage-after (typed-so-far))))) #f))

(define (tell-usage)
  ;; Nothing can be completed: say at least how the verb is called.
  (let ((usage (usage-after (typed-so-far))))
    (when (and usage (null? found) (string-null? (cursor-word (cursor-after (typed-so-far)))))
      ((own %tell-below) (lines->text (list usage))))))


;;; The completer, as readline calls it: for the first word with CONTINUE? #f, then for the others.

(define (find-candidates! text)
  ;; A name that is quoted may have a slash, in a group.
  (set! found
        (if (and (string-index text #\/) (not (eqv? #\' (cursor-mark (cursor-after (typed-so-far))))))
            '()
            (or (false-if-exception (candidates-after (typed-so-far))) '()))))

(define (in-string?)
  (eqv? #\" (cursor-mark (cursor-after (typed-so-far)))))

(define (make-completer)
  (let ((left '()) (files? #f) (complete-file (guiles filename-completion-function)))
    (define (next-word)
      (let ((word (candidate-word (car left))))
        (set! left (cdr left))
        word))
    (lambda (text continue?)
      (unless continue?
        (find-candidates! text)
        (set! left found)
        (set! files? (and (null? found) (or (in-string?) (string-index text #\/)) #t))
        (unless files? (false-if-exception (tell-usage))))
      (cond ((pair? left) (next-word))
            (files? (complete-file text continue?))
            (else #f)))))


;;; What the screen shows of the line, and what Enter and Tab make of it.

(define (paint prompt before behind rows columns)
  ;; As %begin-editing wants it; without BEHIND the line is done, no parenthesis is marked, and nothing told below.
  (false-if-exception
   (drawn-rows prompt (string-append before (or behind "")) (string-length before) (own %columns-of) rows columns
               #:done? (not behind)
               #:hint (and behind (false-if-exception (hint-after (string-append earlier before)))))))

(define reading-form? (make-parameter #f))

(define (indented text)
  ;; TEXT with its last line indented as the ones before ask for.
  (let ((start (+ 1 (or (string-rindex text #\newline) -1))))
    (string-append (substring text 0 start)
                   (make-string (indentation-after (string-append earlier (substring text 0 start))) #\space)
                   (string-trim (substring text start)))))

(define (in-string-before? text)
  (eqv? #\" (cursor-mark (cursor-after (string-append earlier text "\n")))))

(define (last-line text)
  (substring text (+ 1 (or (string-rindex text #\newline) -1))))

(define (begins-line? text)
  ;; Is the cursor behind TEXT in the indentation of a further line?
  (and (string-index text #\newline) (string-every char-whitespace? (last-line text))))

(define (with-new-line text)
  ;; TEXT, its last line indented anew, and a line below, indented unless it is in a string.
  (if (in-string-before? text)
      (string-append text "\n")
      (indented (string-append (if (string-index text #\newline) (indented text) text) "\n"))))

(define (press key before behind)
  ;; As %begin-editing wants it.
  (false-if-exception
   (case key
     ((#\newline)
      (and (reading-form?) (unfinished? (string-append earlier before behind)) (with-new-line before)))
     (else
      (and (begins-line? before) (not (in-string-before? before)) (indented before))))))


;;; History.

(define (history-file)
  ;; Where lines are kept, or #f if there is no such place.
  (let ((folder (state-folder)))
    (and folder
         (false-if-exception
          (begin
            (ensure-folder! folder #o700)
            (string-append folder "/history"))))))

(define (keep-history! form)
  (unless (string-null? (string-trim-both form))
    ((guiles add-history) form)))

(define (begin-history!)
  (let ((file (history-file)))
    (when file
      (false-if-exception ((guiles read-history) file))
      (add-hook! exit-hook (lambda ()
                             (keep-history! (string-trim-right earlier))
                             (false-if-exception ((guiles write-history) file)))))))


;;; The port that a person's lines come from.

(define prompt-text (make-parameter "" (lambda (text) (if (procedure? text) (text) text))))

(define (end-line! port)
  ;; What was printed is seen before the prompt, which begins a line.
  (unless (eqv? 0 (port-column port))
    (newline port))
  (force-output port))

(define (edited-line prompt input indentation)
  ;; A line that a person edits, from INDENTATION on; when that is broken off, the cursor is below it.
  (dynamic-wind
    (const #f)
    (lambda ()
      ((guiles %readline) prompt input (behind (current-output-port))
       (lambda ()
         (when (positive? indentation)
           ((own %insert-text) (make-string indentation #\space)))
         (run-hook before-read-hook))))
    (lambda ()
      (display (make-string ((own %forget-drawing)) #\newline)))))

(define (read-line-at-terminal input continue?)
  (end-line! (current-output-port))
  (unless continue?
    (keep-history! (string-trim-right earlier))
    (set! earlier ""))
  (let ((line (edited-line (if continue? (dots (prompt-text)) (prompt-text))
                           input (if continue? (indentation-after earlier) 0))))
    (when (string? line)
      (set! earlier (string-append earlier line "\n")))
    line))

(define (make-reader port before)
  ;; What reads a form at the prompt, in place of BEFORE.
  (lambda* (prompt #:optional (reader (fluid-ref current-reader)))
    (if (eq? port (current-input-port))
        (parameterize ((prompt-text prompt) (reading-form? #t))
          (set-buffered-input-continuation?! port #f)
          (let ((form ((or reader read) port)))
            (keep-typed-text! earlier)
            form))
        (before prompt reader))))

(define the-port #f)

(define (begin-editing! input)
  (set! terminal input)
  ((own %begin-editing) list-words paint press)
  (begin-history!)
  (set! (guiles-completer) (make-completer))
  (set! the-port
        (make-line-buffered-input-port (lambda (continue?) (read-line-at-terminal input continue?))))
  (let ((variable (module-variable the-root-module 'repl-reader)))
    (variable-set! variable (make-reader the-port (variable-ref variable))))
  (set! (using-readline?) #t))

;; The variable that readline's C code in Guile asks for what completes a word.
(define guiles-completer
  (make-procedure-with-setter
   (lambda () (guiles *readline-completion-function*))
   (lambda (completer)
     (variable-set! (module-variable (resolve-module '(ice-9 readline)) '*readline-completion-function*)
                    completer))))

(define (editable? input)
  (and (file-port? input) (isatty? input) (watched? (current-output-port))
       (not (member (getenv "TERM") '(#f "" "dumb")))
       (there?)))

(define (call-with-line-editing thunk)
  "Call THUNK while the lines that are read from the terminal can be edited; plainly where there is no terminal,
one that has no cursor, or no readline."
  (let ((input (current-input-port)))
    (cond ((and the-port (eq? input the-port)) (thunk))
          ((editable? input)
           (unless the-port (begin-editing! input))
           (dynamic-wind
             (lambda () (set-current-input-port the-port))
             thunk
             (lambda () (set-current-input-port input))))
          (else (thunk)))))
