;; A form being typed, as the screen shows it: what each character is, which parentheses match, where rows end.

(use-modules (bight shell highlight)
             (bight shell tokens)
             ((srfi srfi-1) #:hide (every)))

(define (kinds text point) (vector->list (kinds-of text point)))

(define (kind-at text part)
  ;; The kind of the first character of PART in TEXT.
  (vector-ref (kinds-of text -1) (string-contains text part)))

(define-scenario words-have-kinds
  "Strings, comments, keywords, numbers, quoted names and verbs are told apart."
  (let ((text "(when 'rov #:surge -0.5 here \"(not\" #t) ; why"))
    (expect (kind-at text "when") => 'verb)
    (expect (kind-at text "rov") => 'quoted)
    (expect (kind-at text "#:surge") => 'keyword)
    (expect (kind-at text "-0.5") => 'number)
    (expect (kind-at text "here") => #f)
    (expect (kind-at text "\"(not") => 'string)
    (expect (kind-at text "(not") => 'string)
    (expect (kind-at text "#t") => 'number)
    (expect (kind-at text "; why") => 'comment))
  (save-module-excursion
   (lambda ()
     (set-current-module (resolve-interface '(bight)))
     (expect (kind-at "(drive! 1)" "drive!") => 'verb)
     (expect (kind-at "(list drive!)" "drive!") => #f)))
  (expect (kind-at "(define x)" "define") => 'verb))

(define (places kind text point)
  (filter-map (lambda (k i) (and (eq? k kind) i)) (kinds text point) (iota (string-length text))))

(define-scenario parentheses-match
  "The one beside the cursor and its partner; one that closes nothing is wrong."
  (expect (places 'match "(a (b) c)" 9) => '(0 8))
  (expect (places 'match "(a (b) c)" 6) => '(3 5))
  (expect (places 'match "(a (b) c)" 0) => '(0 8))
  (expect (places 'match "(a (b) c)" 8) => '())
  (expect (places 'match "(a \")\" #\\) )" 12) => '(0 11))
  (expect (places 'match "(a (b" 1) => '())
  (expect (places 'wrong "(a)) b)" -1) => '(3 6)))

(define (wide c) (if (char>? c #\x2fff) 2 1))     ; as a terminal has Chinese characters

(define (drawn text point width)
  (drawn-rows "bight> " text point wide 10000 width))

(define (bare row)
  ;; ROW without what a terminal obeys.
  (let loop ((i 0) (obeyed? #f) (found '()))
    (if (= i (string-length row))
        (reverse-list->string found)
        (let ((c (string-ref row i)))
          (cond ((char=? c #\esc) (loop (+ i 1) #t found))
                (obeyed? (loop (+ i 1) (not (char=? c #\m)) found))
                (else (loop (+ i 1) #f (cons c found))))))))

(define (columns text) (fold (lambda (c n) (+ n (wide c))) 0 (string->list text)))

(define-scenario rows-end-where-the-screen-does
  "A long line is broken, and a further line begins below the first."
  (expect (map bare (first (drawn "(run 3)\n(b" 10 40))) => '("bight> (run 3)" "...... (b"))
  (expect (cdr (drawn "(run 3)\n(b" 10 40)) => '(1 9))
  (expect (cdr (drawn "(run 3)\n(b" 7 40)) => '(0 14))
  (expect (map bare (first (drawn "abcdefghij" 10 13))) => '("bight> abcde" "fghij"))
  (expect (cdr (drawn "abcdefghij" 5 13)) => '(1 0))
  (expect (map bare (first (drawn "ab\u6e29\u6e29\u6e29" 5 14))) => '("bight> ab\u6e29\u6e29" "\u6e29"))
  (expect (bare (car (first (drawn "a\tb\x1bc" 0 40)))) => "bight> a b?c"))

(define (alphabet-text state n)
  (list->string (map (lambda (i) (string-ref "()[]\"\\;'`#: ab1\n\t\u6e29" (random 18 state))) (iota n))))

(define-scenario any-text-is-shown-whole
  "Whatever is typed: rows fit, hold every character once, and the cursor stands before its own."
  (let ((state (seed->random-state 25)))
    (do ((i 0 (+ i 1)))
        ((= i 200))
      (let* ((text (alphabet-text state (random 90 state))) (width (+ 12 (random 40 state)))
             (point (random (+ 1 (string-length text)) state))
             (found (drawn text point width)) (rows (map bare (first found))))
        (require (apply max (map columns rows)) is (below width))
        (require (<= 0 (third found) (- width 1)))
        (require (string-count (string-concatenate rows) #\a) => (string-count text #\a))
        (require (< (second found) (length rows)))
        (let ((before (cdr (drawn (substring text 0 point) point width)))) ; what follows may not fit there
          (require (member (cdr found) (list before (list (+ 1 (car before)) 0)))))
        (let ((row (list-ref rows (second found))))
          (when (and (< point (string-length text)) (char=? #\a (string-ref text point))
                     (< (third found) (columns row)))
            (require (string-ref (list->string
                                  (append-map (lambda (c) (make-list (wide c) c)) (string->list row)))
                                 (third found))
                     => #\a)))))))

(define-scenario a-screen-too-low
  "Of a form with more rows than the screen those about the cursor are shown."
  (let* ((text (string-join (map number->string (iota 50)) "\n"))
         (found (drawn-rows "> " text (string-contains text "\n30\n") wide 7 40)))
    (expect (length (first found)) => 7)
    (expect (bare (list-ref (first found) (second found))) => ". 29")))

(define-scenario tokens-cover-the-text
  "Tokens are in order, apart, and leave out nothing but white space."
  (let ((state (seed->random-state 7)))
    (do ((i 0 (+ i 1)))
        ((= i 300))
      (let* ((text (alphabet-text state (random 60 state))) (found (tokens text)))
        (define (blank? from to) (string-every char-whitespace? text from to))
        (let loop ((rest found) (at 0))
          (if (null? rest)
              (require (blank? at (string-length text)))
              (begin
                (require (<= at (token-from (car rest))))
                (require (blank? at (token-from (car rest))))
                (require (< (token-from (car rest)) (token-to (car rest))))
                (loop (cdr rest) (token-to (car rest))))))))))
