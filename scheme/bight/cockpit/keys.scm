;;; (bight cockpit keys) --- what the keys of a pilot mean.
;;;
;;; Most terminals tell of keys that go down, never of keys that come up.  There a key holds its stick as long
;;; as it repeats: after the first press for as long as a keyboard takes to begin to repeat, then for as
;;; long as a repeat takes.  Where releases are told, the key holds its stick until then, and several keys hold
;;; theirs at once.  With shift a key nudges the stick instead, which stays there.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit keys)
  #:use-module (bight cockpit desk)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (new-sticks press let-up let-all-up nudge settle stick-values sticks?
            stick-of-key nudge-of-key act-of-key
            view-keys-told keys-told keys-page))


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

;;; What they do, told: rows of keys and a sentence.

;; The keys of the view, which every cockpit has.
(define view-keys-told
  '(("v 1-6" . "view: chase camera top side overview sonar; the mouse turns and zooms the overview")
    ("o x" . "colour of the tether; picture or plain")
    ("z f y" . "map; the way home in words; lights")
    ("c" . "where a belief holds the tether to be")))

(define flight-keys
  `(("w s" . "ahead, astern")
    ("a d" . "turn")
    ("i k" . "up, down (arrows)")
    ("j l" . "sideways (arrows)")
    ("" . "hold them; with shift a key nudges its stick, which stays there")
    ("space" . "let go of everything")
    ("h b n m" . "hold heading, depth, altitude, place")
    ("[ ] { }" . "winch: in, out a metre; five")
    ,@view-keys-told
    ("g" . "what if: 5 s from now")
    ("p u" . "pause; back")
    ("e t" . "in a lesson: a hint; tell the tender")
    (":" . "the prompt (,q comes back)")
    ("pads" . "bight controller tells what they do")
    ("? q" . "this; leave")))

;; What ? shows, rows of (KEYS . SENTENCE): who owns the cockpit, and has other keys, tells those.
(define keys-told (make-parameter flight-keys))

(define most-wide 60)                   ; columns: a longer line is harder to read

(define (keys-lines rows columns)
  ;; ROWS, pairs of keys and what they do, as lines of at most COLUMNS, the sentences wrapped beside their keys.
  (let* ((wide (+ 2 (apply max (map (lambda (row) (string-length (car row))) rows))))
         (room (max 1 (- (min most-wide columns) wide))))
    (append-map (lambda (row)
                  (let ((lines (wrap (cdr row) room)))
                    (map (lambda (keys line) (cut (string-append (string-pad-right keys wide) line) columns))
                         (cons (car row) (map (const "") (cdr lines)))
                         lines)))
                rows)))

(define (keys-page columns height page)
  "Return what ? shows, lines of at most COLUMNS: the page PAGE, from 0 on, if a page has HEIGHT lines; #f behind the last."
  (let* ((lines (keys-lines (keys-told) columns))
         (whole? (<= (length lines) (max 1 height)))
         (n (if whole? (length lines) (max 1 (- height 1)))) ; the last line says that there is more
         (from (* page n)))
    (and (< from (length lines))
         (let ((rest (list-tail lines from)))
           (if (> (length rest) n)
               (append (list-head rest n) (list (cut "?  the other keys" columns)))
               rest)))))
