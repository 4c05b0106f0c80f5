;;; (bight lesson-keys) --- taking a lesson by keys: the dive goes on by itself, ten looks a second.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson-keys)
  #:use-module (bight lesson-input)
  #:use-module (bight lesson-lines)
  #:use-module (bight lesson-play)
  #:use-module (bight lesson-score)
  #:use-module (bight lesson-tally)
  #:use-module ((bight outlet) #:select (control))
  #:use-module (bight query)
  #:use-module (bight terminal)
  #:use-module (bight time)
  #:use-module (bight view)
  #:use-module (srfi srfi-1)
  #:export (fly-by-keys hear! forget-heard!))

(define frame 6)                        ; steps between looks at the keys
(define key-help
  "w s ahead  a d turn  z c aside  r f up down  space stop  + - tether  : Scheme")
(define more-help
  "h hint  p pause  u back 10 s  t tell tender  v figures  q leave, to go on later")

(define (key->input key)
  ;; The input that KEY stands for, or #f.
  (case key
    ((#\w up) '(stick surge 0.2)) ((#\s down) '(stick surge -0.2))
    ((#\a left) '(stick yaw -0.2)) ((#\d right) '(stick yaw 0.2))
    ((#\z) '(stick sway -0.2)) ((#\c) '(stick sway 0.2))
    ((#\r) '(stick heave 0.2)) ((#\f) '(stick heave -0.2))
    ((#\space) '(release))
    ((#\+ #\=) '(winch 1)) ((#\-) '(winch -1))
    ((#\h) '(hint)) ((#\u) '(back))
    (else #f)))

(define heard '())                      ; what was said last, for the screen

(define (forget-heard!)
  "Clear what was said last."
  (set! heard '()))

(define (hear! text)
  "Put TEXT among what was said last, on the screen."
  (set! heard (take (append (reverse (wrap text 78)) heard)
                    (min 6 (+ (length heard) (length (wrap text 78)))))))

(define (blank-row? line)
  (string-every (char-set #\space #\|) line))

(define (fitted lines rows)
  ;; LINES of a picture with blank rows left out until there are at most ROWS.
  (let loop ((rest lines) (excess (- (length lines) rows)) (kept '()))
    (cond ((null? rest) (take (reverse kept) (min (length kept) rows)))
          ((and (positive? excess) (blank-row? (car rest))) (loop (cdr rest) (- excess 1) kept))
          (else (loop (cdr rest) excess (cons (car rest) kept))))))

(define (signed x) (string-append (if (negative? x) "" "+") (figure x)))

(define* (answer-or-dash thunk #:optional verb)
  ;; What THUNK tells; a dash if the lesson hides VERB, or there is no answer.
  (let ((x (and (not (hidden? verb)) (with-exception-handler (const #f) thunk #:unwind? #t))))
    (if (real? x) (figure x) "-")))

(define (panel paused?)
  (let ((s (map signed (array->list (sticks)))))
    (list
     (string-append (if paused? "PAUSED  " "") (figure (now)) " s   heading "
                    (answer-or-dash rov-heading) "   depth " (answer-or-dash rov-depth)
                    "   speed " (answer-or-dash rov-speed) "   turns " (answer-or-dash net-turns))
     (string-append "tether " (answer-or-dash tether-length 'tether-length) " m, slack "
                    (answer-or-dash (lambda () (* 100 (slack))) 'slack) " %, pull "
                    (answer-or-dash rov-tension 'rov-tension) " N   sticks " (string-join s " ")))))

(define (draw-screen! paused?)
  (let* ((size (terminal-size)) (rows (car size)) (columns (cdr size))
         (below (append (panel paused?) (reverse heard) (list key-help more-help)))
         (task (wrap (task-text) (- columns 1)))
         (room (- rows (length below) (length task) 1))
         (picture (if (and (> room 5) (not (hidden? 'look))
                               (not (eq? 'hard (session-level (this-session 'look)))))
                      (fitted (picture-lines (look #:columns (max 40 (min 160 (- columns 1))))) room)
                      '())))
    (control "\x1b[H")
    (for-each (lambda (line)
                (display (if (> (string-length line) (- columns 1))
                             (substring line 0 (- columns 1))
                             line))
                (control "\x1b[K\r\n"))
              (append task picture below))
    (control "\x1b[J")))

(define-syntax-rule (in-cooked-mode state body ...)
  (let ((raw (terminal-state)))
    (dynamic-wind
      (lambda () (restore-terminal! state) (control "\x1b[?25h\r\n"))
      (lambda () body ...)
      (lambda () (control "\x1b[?25l") (restore-terminal! raw)))))

(define (type-line state text)
  (in-cooked-mode state
    (let ((line (ask-line text)))
      (if (eof-object? line) "" line))))

(define (clock) (/ (get-internal-real-time) (exact->inexact internal-time-units-per-second)))

(define (keys-asker state)
  ;; A procedure that returns the next input of a person at the keys.
  (let ((paused? #f) (due (clock)) (drawn 0.0))
    (define (draw!)
      (set! drawn (clock))
      (draw-screen! paused?))
    (define (resume!) (set! due (clock)))
    (define (typed text make)
      (let ((line (type-line state text)))
        (resume!)
        (if (string-null? (string-trim-both line)) '(nothing) (make line))))
    (define (handle key)
      (cond ((eof-object? key) ((leaving)))
            ((memv key '(#\q #\x04)) ((leaving)))
            ((memv key '(#\p #\x03)) (set! paused? (not paused?)) (resume!) (draw!) '(nothing))
            ((memv key '(#\: #\())
             (typed (if (eqv? key #\() "scheme> (" "scheme> ")
                    (lambda (line)
                      (list 'form (if (eqv? key #\() (string-append "(" line) line)))))
            ((eqv? key #\t) (typed "to the tender> " (lambda (line) (list 'tell line))))
            ((eqv? key #\v)
             (unless (hidden? 'status) (for-each hear! (picture-lines (status))))
             (draw!)
             '(nothing))
            ((key->input key) => identity)
            (else (hear! (string-append key-help "  " more-help)) '(nothing))))
    (lambda ()
      (when (> (- (clock) drawn) 0.25) (draw!))
      (let ((key (read-key (if paused? 0.25 (max 0.0 (- due (clock)))))))
        (cond (key (handle key))
              (paused? '(nothing))
              (else
               (set! due (max (+ due (* frame (time-step))) (- (clock) 0.5)))
               (list 'pass frame)))))))

(define (fly-by-keys n seconds)
  "Let the pupil fly task N by keys until it is over."
  (let ((state (terminal-state)))
    (catch-up!)
    (call-with-keys
     (lambda ()
       (let ((ask (keys-asker state)))
         (let loop ()
           (for-each hear! (apply-input! (next-input ask)))
           (loop)))))))
