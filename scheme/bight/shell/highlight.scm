;;; (bight shell highlight) --- a form being typed as rows of the screen: colours, parentheses that match.
;;;
;;; Rows are broken here, not by the terminal, so that the cursor's place is known.  Where the environment
;;; wants no colours, matching parentheses are still shown, in reverse.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell highlight)
  #:use-module ((bight cockpit palette) #:select (this-palette))
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core verb) #:select (verb?))
  #:use-module (bight shell tokens)
  #:use-module (srfi srfi-1)
  #:export (kinds-of
            drawn-rows
            dots))

(define (dots prompt)
  "Return what stands before further lines of a form: as wide as PROMPT, so that columns are those of the form."
  (string-append (make-string (max 0 (- (string-length prompt) 1)) #\.) " "))


;;; What each character is.

(define (value-of name)
  (let ((variable (module-variable (current-module) name)))
    (and variable (variable-bound? variable) (variable-ref variable))))

(define (leads? word)
  ;; Is WORD, behind a parenthesis, a verb or a macro?
  (let ((value (value-of (string->symbol word))))
    (or (verb? value) (macro? value))))

(define (kind-of-word word before)
  ;; The kind of WORD, which stands right behind the character BEFORE.
  (cond ((string-prefix? "#:" word) 'keyword)
        ((or (text->number word) (string-prefix? "#" word)) 'number)
        ((memv before '(#\' #\` #\,)) 'quoted)
        ((and (memv before '(#\( #\[)) (leads? word)) 'verb)
        (else #f)))

(define (kind-of-token token text)
  (case (token-kind token)
    ((string open-string) 'string)
    ((comment) 'comment)
    ((word) (kind-of-word (token-text token text)
                          (and (positive? (token-from token)) (string-ref text (- (token-from token) 1)))))
    (else #f)))

(define (fill! kinds token kind)
  (do ((i (token-from token) (+ i 1)))
      ((= i (token-to token)))
    (vector-set! kinds i kind)))

(define (beside? pair point)
  ;; Is the cursor, at POINT, right behind the end of PAIR or at its beginning?
  (or (and (cdr pair) (= point (token-to (cdr pair))))
      (and (car pair) (= point (token-from (car pair))))))

(define (mark-partners! kinds pairs point)
  (for-each (lambda (pair)
              (cond ((not (car pair)) (fill! kinds (cdr pair) 'wrong))
                    ((and (cdr pair) (beside? pair point))
                     (fill! kinds (car pair) 'match)
                     (fill! kinds (cdr pair) 'match))))
            pairs))

(define (kinds-of text point)
  "Return what each character of TEXT is, a vector: string, comment, keyword, number, quoted, verb; match, a
parenthesis beside the cursor at POINT and its partner; wrong, one that closes nothing; or #f."
  (let ((kinds (make-vector (string-length text) #f)) (found (tokens text)))
    (for-each (lambda (token) (fill! kinds token (kind-of-token token text))) found)
    (mark-partners! kinds (partners found) point)
    kinds))


;;; Rows of the screen.

(define coloured
  '((string . "32") (comment . "90") (keyword . "36") (number . "33") (quoted . "35") (verb . "1")
    (match . "1;7") (wrong . "1;31")))

(define plain '((match . "7") (wrong . "7")))

(define looks (delay (if (eq? 'none (this-palette)) plain coloured)))

(define (obeyed kind)
  ;; What makes a terminal show KIND.
  (string-append "\x1b[0" (let ((look (assq-ref (force looks) kind))) (if look (string-append ";" look) "")) "m"))

(define (visible c)
  (cond ((char=? c #\tab) #\space)
        ((eq? 'Cc (char-general-category c)) #\?)
        (else c)))

(define (row->text row)
  ;; ROW, a list of (CHARACTER . KIND), the last first, as text for a terminal.
  (call-with-output-string
    (lambda (port)
      (let loop ((rest (reverse row)) (kind #f))
        (cond ((pair? rest)
               (unless (eq? kind (cdar rest)) (display (obeyed (cdar rest)) port))
               (write-char (visible (caar rest)) port)
               (loop (cdr rest) (cdar rest)))
              (kind (display (obeyed #f) port)))))))

(define (as-row text)
  (fold (lambda (c row) (cons (cons c #f) row)) '() (string->list text)))

(define (rows-of prompt text point kinds width-of width)
  ;; The rows of TEXT behind PROMPT, none wider than WIDTH, and where the cursor is: its row and column.
  (define further (dots prompt))
  (define (wide text) (fold (lambda (c sum) (+ sum (width-of c))) 0 (string->list text)))
  (let loop ((i 0) (row (as-row prompt)) (column (wide prompt)) (rows '()) (at #f))
    (let ((at (if (= i point) (list (length rows) column) at)))
      (if (= i (string-length text))
          (cons (reverse (cons (row->text row) rows)) at)
          (let* ((c (string-ref text i)) (w (width-of (visible c))))
            (cond ((char=? c #\newline)
                   (loop (+ i 1) (as-row further) (wide further) (cons (row->text row) rows) at))
                  ((> (+ column w) width)
                   (loop i '() 0 (cons (row->text row) rows) at))
                  (else (loop (+ i 1) (acons c (vector-ref kinds i) row) (+ column w) rows at))))))))

(define (within rows at height)
  ;; As many of ROWS as fit in HEIGHT, and the row among them of the cursor AT.
  (let ((first-row (max 0 (min (- (length rows) height) (- (car at) (quotient height 2))))))
    (list (take (drop rows first-row) (min height (length rows))) (- (car at) first-row) (cadr at))))

(define (hint-row hint width-of width)
  ;; HINT as a row of at most WIDTH columns, in the colour of comments.
  (define (fitting chars room)
    (cond ((null? chars) '())
          ((> (width-of (visible (car chars))) room) '())
          (else (acons (visible (car chars)) 'comment
                       (fitting (cdr chars) (- room (width-of (visible (car chars)))))))))
  (row->text (reverse (fitting (string->list hint) width))))

(define* (drawn-rows prompt text point width-of height width #:key done? hint)
  "Return what a screen of HEIGHT rows and WIDTH columns shows of TEXT behind PROMPT, with the cursor before the
character POINT: a list of the rows, strings with what makes the terminal show colours, and of the cursor's row
and column.  WIDTH-OF tells the columns of a character.  No parentheses match in a TEXT that is DONE?.  HINT, a string
or #f, is a last row, if there is room for one."
  (let* ((text-kinds (kinds-of text (if done? -1 point)))
         (room (max 10 (- width 1)))
         (found (rows-of prompt text point text-kinds width-of room))
         (hint (and hint (< (length (car found)) height) hint))
         (drawn (within (car found) (cdr found) (max 1 height))))
    (if hint
        (cons (append (car drawn) (list (hint-row hint width-of room))) (cdr drawn))
        drawn)))
