;;; (bight cockpit sequences) --- bytes of a terminal as keys, releases of keys, and the mouse.
;;;
;;; What stands for no character comes as an escape sequence: arrows; keys by kitty's protocol, which tells of releases
;;; too (sw.kovidgoyal.net/kitty/keyboard-protocol), where a terminal has it; the mouse as xterm's mode 1006 tells it;
;;; that the window is looked at no longer, mode 1004; and where what is pasted begins and ends, mode 2004.
;;; %terminal-enter! asks for all of these, and a terminal tells what it knows.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit sequences)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (ice-9 match)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-11)
  #:export (bytes->keys))

(define (parameter-byte? b) (<= #x20 b #x3f))

(define (numbers text)
  ;; The numbers of TEXT, such as 97:65;2:3, a list of lists; #f for one that is left out.
  (map (lambda (part) (map text->number (string-split part #\:))) (string-split text #\;)))

(define (number-at all i j)
  ;; The Jth number of the Ith list of ALL, or #f.
  (and (< i (length all)) (< j (length (list-ref all i))) (list-ref (list-ref all i) j)))

;;; Keys.

(define (with-event key all)
  ;; KEY, or a list of (release KEY): the second number of the second parameter is 3 when it comes up.
  (list (if (and key (eqv? 3 (number-at all 1 1))) (list 'release key) key)))

(define (arrow letter)
  (assv-ref '((#\A . up) (#\B . down) (#\C . right) (#\D . left)) letter))

(define (character code shifted modifiers)
  ;; The character of the key CODE, or #f.  SHIFTED is what it is with shift, as far as that is told.
  (let ((shift? (odd? modifiers)) (control? (odd? (quotient modifiers 4))))
    (cond ((= code 27) 'escape)
          ((and control? (<= 97 code 122)) (integer->char (- code 96)))
          ((memv code '(9 13 127)) (integer->char code))
          ((not (<= 32 code 126)) #f)
          ((and shift? shifted (<= 32 shifted 126)) (integer->char shifted))
          (shift? (char-upcase (integer->char code)))
          (else (integer->char code)))))

(define (kitty-key all)
  (let ((code (number-at all 0 0)) (modifiers (- (or (number-at all 1 0) 1) 1)))
    (if (and code (exact-integer? modifiers) (>= modifiers 0))
        (filter identity (with-event (character code (number-at all 0 1) modifiers) all))
        '())))

;;; The mouse.

(define (mouse all pressed?)
  ;; (mouse WHAT COLUMN ROW): WHAT is press, drag, release, nearer or further.
  (let ((button (number-at all 0 0)) (x (number-at all 1 0)) (y (number-at all 2 0)))
    (if (and button x y)
        (let ((what (cond ((= button 64) 'nearer)
                          ((= button 65) 'further)
                          ((not (zero? (remainder button 4))) #f) ; another button than the left one
                          ((not pressed?) 'release)
                          ((= 32 (logand button 96)) 'drag)
                          ((zero? (logand button 96)) 'press)
                          (else #f))))
          (if what (list (list 'mouse what (- x 1) (- y 1))) '()))
        '())))

;;; All of them.

(define (sequence->keys parameters letter)
  ;; The keys that an escape sequence of PARAMETERS, a string, with LETTER at its end stands for, a list.
  (define (after-mark) (numbers (substring parameters 1)))
  (cond ((arrow letter) => (lambda (key) (with-event key (numbers parameters))))
        ((and (string-prefix? "<" parameters) (memv letter '(#\M #\m))) (mouse (after-mark) (eqv? letter #\M)))
        ((and (string-prefix? "?" parameters) (eqv? letter #\u))
         (let ((flags (number-at (after-mark) 0 0)))
           (if (and flags (odd? (quotient flags 2))) '(releases) '())))
        ((string-any (char-set #\< #\= #\> #\?) parameters) '())
        ((eqv? letter #\u) (kitty-key (numbers parameters)))
        ((and (eqv? letter #\~) (assoc-ref '(("200" . paste) ("201" . pasted)) parameters)) => list)
        ((and (eqv? letter #\O) (string-null? parameters)) '(unfocused))
        (else '())))

(define (bytes->keys bytes)
  "Return the keys that BYTES, a list of what a terminal sent, stand for: characters; the symbols up down left right
escape; (release KEY); releases, when the terminal says that it tells of releases, and unfocused, when it tells of
nothing any more; paste and pasted, about what is pasted; (mouse press COLUMN ROW), as well with drag, release, nearer or
further."
  (match bytes
    (() '())
    ((27 79 byte . rest) (append (or (and=> (arrow (integer->char byte)) list) '()) (bytes->keys rest)))
    ((27 91 . rest)
     (let-values (((parameters after) (span parameter-byte? rest)))
       (if (null? after)
           '()
           (append (sequence->keys (list->string (map integer->char parameters)) (integer->char (car after)))
                   (bytes->keys (cdr after))))))
    ((27 . rest) (cons 'escape (bytes->keys rest)))
    ((byte . rest)
     (if (< byte 128)
         (cons (integer->char byte) (bytes->keys rest))
         (bytes->keys rest)))))           ; no key of ours
