;;; (bight cockpit keys) --- what the keys of a pilot mean.
;;;
;;; Most terminals tell of keys that go down, never of keys that come up.  There a key holds its stick as long
;;; as it repeats: after the first press for as long as a keyboard takes to begin to repeat, then for as
;;; long as a repeat takes.  Where releases are told, the key holds its stick until then, and several keys hold
;;; theirs at once.  With shift a key nudges the stick instead, which stays there.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit keys)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (new-sticks press let-up let-all-up nudge settle stick-values sticks?
            stick-of-key nudge-of-key act-of-key
            view-key-lines keys-told))


;;; Sticks: for each axis where it was put, and where a key holds it until when.

(define-record <sticks>
  (make-sticks put held until)
  sticks?
  (put sticks-put)                      ; of each axis a number
  (held sticks-held)                    ; of each axis a number, or #f
  (until sticks-until))                 ; seconds of the clock

(define axes 4)                         ; surge sway heave yaw

(define first-hold 0.55)                ; s: longer than keyboards wait before they repeat
(define next-hold 0.16)

(define (new-sticks)
  "Return sticks that are centred."
  (make-sticks (make-list axes 0) (make-list axes #f) (make-list axes 0)))

(define (with-element list i value)
  (append (take list i) (cons value (drop list (+ i 1)))))

(define* (press sticks axis value now #:optional (told? #f))
  "Return STICKS after a key that holds AXIS at VALUE came at the time NOW, s; TOLD? says that it will be told when the
key comes up."
  (let ((again? (eqv? value (list-ref (sticks-held sticks) axis))))
    (make-sticks (sticks-put sticks)
                 (with-element (sticks-held sticks) axis value)
                 (with-element (sticks-until sticks) axis
                               (max (list-ref (sticks-until sticks) axis)
                                    (cond (told? +inf.0) (again? (+ now next-hold)) (else (+ now first-hold))))))))

(define (let-up sticks axis value)
  "Return STICKS after the key that holds AXIS at VALUE came up."
  (if (eqv? value (list-ref (sticks-held sticks) axis))
      (make-sticks (sticks-put sticks) (with-element (sticks-held sticks) axis #f)
                   (with-element (sticks-until sticks) axis 0))
      sticks))

(define (let-all-up sticks)
  "Return STICKS that no key holds, where they were put."
  (make-sticks (sticks-put sticks) (make-list axes #f) (make-list axes 0)))

(define (nudge sticks axis step)
  "Return STICKS with AXIS put STEP further."
  (let* ((value (+ step (list-ref (sticks-put sticks) axis)))
         (value (/ (round (* 10 (max -1 (min 1 value)))) 10)))
    (make-sticks (with-element (sticks-put sticks) axis value)
                 (sticks-held sticks) (sticks-until sticks))))

(define (settle sticks now)
  "Return STICKS at the time NOW, s: what no key holds any more is where it was put."
  (make-sticks (sticks-put sticks)
               (map (lambda (held until) (and held (< now until) held))
                    (sticks-held sticks) (sticks-until sticks))
               (map (lambda (held until) (if (and held (< now until)) until 0))
                    (sticks-held sticks) (sticks-until sticks))))

(define (stick-values sticks)
  "Return where STICKS are: surge sway heave yaw, each -1 to 1."
  (map (lambda (put held) (exact->inexact (or held put))) (sticks-put sticks) (sticks-held sticks)))


;;; Which key is which.

(define holding
  '((#\w 0 . 1) (#\s 0 . -1) (#\d 3 . 1) (#\a 3 . -1) (#\l 1 . 1) (#\j 1 . -1) (#\i 2 . 1) (#\k 2 . -1)
    (up 2 . 1) (down 2 . -1) (right 1 . 1) (left 1 . -1)))

(define (stick-of-key key)
  "Return (AXIS . VALUE) if KEY holds a stick, else #f."
  (assv-ref holding key))

(define (nudge-of-key key)
  "Return (AXIS . STEP) if KEY nudges a stick, else #f."
  (and (char? key) (char-upper-case? key)
       (let ((stick (assv-ref holding (char-downcase key))))
         (and stick (cons (car stick) (* 1/10 (cdr stick)))))))

(define acts
  '((#\space release) (#\[ winch -1) (#\] winch 1) (#\{ winch -5) (#\} winch 5)
    (#\h hold heading) (#\b hold depth) (#\n hold altitude) (#\m hold place)
    (#\u back) (#\p pause) (#\g ghost) (#\e hint) (#\t tell) (#\: prompt) (lost lost) (#\q leave) (#\etx leave)))

(define (act-of-key key)
  "Return what KEY asks for besides the sticks and the view, a list such as (winch 1), or #f."
  (assv-ref acts key))

(define (view-key-lines column)
  "Return what the keys of the view do, lines in which the keys take COLUMN characters."
  (map (lambda (row) (string-append (string-pad-right (car row) column) (cdr row)))
       '(("v 1-6" . "view: chase camera top side overview sonar;")
         ("" . "the mouse turns and zooms the overview")
         ("o x" . "colour of the tether; picture or plain"))))

(define key-lines
  `("w s     ahead, astern          hold them; with shift"
    "a d     turn                   a key nudges its stick,"
    "i k     up, down    (arrows)   which stays there"
    "j l     sideways    (arrows)"
    "space   let go of everything"
    "h b n m hold heading, depth, altitude, place"
    "[ ]     winch: in, out a metre      { } five"
    ,@(view-key-lines 8)
    "z f     map; the way home in words"
    "y       lights       g   what if: 5 s from now"
    "c       where a belief holds the tether to be"
    "p       pause        u   back"
    "e t     in a lesson: a hint; tell the tender"
    ":       the prompt (,q comes back)"
    "pads    bight controller tells what they do"
    "? q     this; leave"))

;; What ? shows, lines: who owns the cockpit, and has other keys, tells those.
(define keys-told (make-parameter key-lines))
