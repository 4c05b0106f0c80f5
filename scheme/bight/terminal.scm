;;; (bight terminal) --- keys one by one, and a terminal that is left as it was found.
;;;
;;; The C library's own calls, so that no program need be started.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight terminal)
  #:use-module ((bight outlet) #:select (control))
  #:use-module (rnrs bytevectors)
  #:use-module (system foreign)
  #:export (terminal-state
            restore-terminal!
            call-with-keys
            read-key
            terminal-size))

(define (libc name return . arguments)
  (pointer->procedure return (dynamic-func name (dynamic-link)) arguments))

(define state-size 256)                 ; more than any struct termios

(define (input-fd) (fileno (current-input-port)))

(define (get-state!)
  (let ((state (make-bytevector state-size 0)))
    (and (zero? ((libc "tcgetattr" int int '*) (input-fd) (bytevector->pointer state)))
         state)))

(define (terminal-state)
  "Return the settings of the terminal on standard input, a value for `restore-terminal!', or #f if there is
no terminal."
  (and (file-port? (current-input-port))
       (isatty? (current-input-port))
       (get-state!)))

(define drained 1)                      ; TCSADRAIN

(define (restore-terminal! state)
  "Give the terminal the settings STATE, or do nothing if STATE is #f."
  (when state
    ((libc "tcsetattr" int int int '*) (input-fd) drained (bytevector->pointer state))))

(define (raw-state state)
  ;; STATE changed so that keys come one by one, unseen, ^C too.
  (let ((raw (bytevector-copy state)))
    ((libc "cfmakeraw" void '*) (bytevector->pointer raw))
    raw))

(define (call-with-keys thunk)
  "Call THUNK while keys come one by one, on the screen's other page with the cursor hidden; put everything
back afterwards."
  (let ((state (terminal-state)))
    (dynamic-wind
      (lambda () (restore-terminal! (raw-state state)) (control "\x1b[?1049h\x1b[?25l"))
      thunk
      (lambda () (control "\x1b[?25h\x1b[?1049l") (restore-terminal! state)))))

(define (key-within? seconds)
  (pair? (car (select (list (current-input-port)) '() '()
                      (inexact->exact (floor seconds))
                      (inexact->exact (floor (* 1e6 (- seconds (floor seconds)))))))))

(define (read-key seconds)
  "Return the key pressed within SECONDS, a character or one of up down left right escape, or #f; the end
of the input is an eof object."
  (and (key-within? seconds)
       (let ((c (read-char)))
         (if (eqv? c #\esc) (read-arrow) c))))

(define (read-arrow)
  ;; What follows an escape: an arrow sends ESC [ A, or ESC O A.
  (if (and (key-within? 0.02) (memv (peek-char) '(#\[ #\O)))
      (begin
        (read-char)
        (case (if (key-within? 0.02) (read-char) #\nul)
          ((#\A) 'up) ((#\B) 'down) ((#\C) 'right) ((#\D) 'left)
          (else 'escape)))
      'escape))

(define window-size #x5413)             ; TIOCGWINSZ

(define (terminal-size)
  "Return the rows and the columns of the terminal, a pair: 24 and 80 if it does not tell."
  (let* ((size (make-bytevector 8 0))
         (told? (false-if-exception
                 (zero? ((libc "ioctl" int int unsigned-long '*) (input-fd) window-size
                         (bytevector->pointer size)))))
         (rows (bytevector-u16-native-ref size 0))
         (columns (bytevector-u16-native-ref size 2)))
    (if (and told? (> rows 0) (> columns 0))
        (cons rows columns)
        (cons 24 80))))
