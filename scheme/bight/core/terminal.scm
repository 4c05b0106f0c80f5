;;; (bight core terminal) --- a terminal that is left as it was found, its keys one by one, and its size.
;;;
;;; The C library's own calls, so that no program need be started.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core terminal)
  #:use-module (rnrs bytevectors)
  #:use-module (system foreign)
  #:export (terminal-state
            restore-terminal!
            call-hearing-keys
            key-within
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

;; Linux's struct termios: the local flags are its fourth word.
(define local-flags 12)
(define line-by-line 2)                 ; ICANON
(define echoing 8)                      ; ECHO

(define (hear-keys! state)
  ;; Let the terminal whose settings are STATE hand over each key as it is pressed, and show none.
  (let ((keys (bytevector-copy state)))
    (bytevector-u32-native-set! keys local-flags
                                (logand (bytevector-u32-native-ref keys local-flags)
                                        (lognot (logior line-by-line echoing))))
    (restore-terminal! keys)))

(define ends (list SIGINT SIGTERM SIGHUP))

(define (ending-with state)
  ;; A handler of signals that end this process: the terminal gets its settings STATE back first.
  (lambda (signal)
    (restore-terminal! state)
    (sigaction signal SIG_DFL)
    (kill (getpid) signal)))

(define (call-hearing-keys thunk)
  "Call THUNK while the terminal on standard input, if there is one, hands over each key as it is pressed.  A signal that
ends the process meanwhile, such as that of ^C, gives the terminal back first."
  (let ((state (terminal-state)) (handlers '()))
    (if state
        (dynamic-wind
          (lambda ()
            (set! handlers (map (lambda (signal) (sigaction signal (ending-with state))) ends))
            (hear-keys! state))
          thunk
          (lambda ()
            (restore-terminal! state)
            (for-each (lambda (signal handler) (sigaction signal (car handler) (cdr handler))) ends handlers)))
        (thunk))))

(define (key-within seconds)
  "Return the key, a character, that is pressed within SECONDS, or #f; #f too once there is no terminal."
  (let ((port (current-input-port)) (microseconds (inexact->exact (round (* 1e6 seconds)))))
    (if (not (terminal-state))
        (begin (usleep microseconds) #f)
        (and (or (char-ready? port) (pair? (car (select (list port) '() '() 0 microseconds))))
             (let ((key (read-char port)))
               (and (char? key) key))))))

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
