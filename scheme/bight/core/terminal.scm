;;; (bight core terminal) --- a terminal that is left as it was found, and its size.
;;;
;;; The C library's own calls, so that no program need be started.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core terminal)
  #:use-module (rnrs bytevectors)
  #:use-module (system foreign)
  #:export (terminal-state
            restore-terminal!
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
