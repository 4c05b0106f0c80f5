;;; (bight cockpit view-keys) --- the keys and the mouse that change how things look, in every cockpit.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit view-keys)
  #:use-module (bight cockpit believed)
  #:use-module (bight cockpit cells)
  #:use-module ((bight cockpit hud) #:select (unseen?))
  #:use-module (bight cockpit state)
  #:use-module (srfi srfi-1)
  #:export (view-key!))

(define (next-of value values)
  (let ((rest (memq value values)))
    (if (and rest (pair? (cdr rest))) (cadr rest) (car values))))

(define views '(chase pilot top side overview sonar))

(define (has-sonar? c)
  (and (cockpit-vehicle c) (not ((unseen?) 'sonar))))

(define (views-of c)
  (if (has-sonar? c) views (delq 'sonar views)))

(define a-cell 1.5)                     ; degrees that the mouse turns the overview by for a column; a row is two
(define nearer 1.15)                    ; by a notch of its wheel

(define (turn-overview! c turn dip zoom)
  ;; Turn and dip by degrees, and come nearer by the factor ZOOM.
  (let ((orbit (or (cockpit-orbit c) '(0 0 1))))
    (set-orbit! c (list (+ (first orbit) turn) (max -90 (min 90 (+ (second orbit) dip)))
                        (max 1/10 (min 20 (* (third orbit) zoom)))))))

(define (do-mouse! c what column row)
  (let ((held (cockpit-held-at c)))
    (case what
      ((press) (set-held-at! c (cons column row)))
      ((release) (set-held-at! c #f))
      ((nearer) (turn-overview! c 0 0 nearer))
      ((further) (turn-overview! c 0 0 (/ nearer)))
      ((drag)
       (when held
         (turn-overview! c (* a-cell (- column (car held))) (* 2 a-cell (- row (cdr held))) 1))
       (set-held-at! c (cons column row))))))

(define (mouse-moved! c mouse)
  ;; MOUSE is (WHAT COLUMN ROW).
  (if (eq? 'overview (cockpit-view c))
      (apply do-mouse! c mouse)
      (when (eq? 'press (car mouse))
        (announce! c "the mouse turns the overview: 5"))))

(define (show-view! c view)
  (if (memq view (views-of c))
      (begin
        (set-view! c view)
        (set-orbit! c #f)
        (announce! c (string-append "view: " (symbol->string view))))
      (announce! c "there is no sonar here")))

(define (suspend! c)
  ;; As ^Z does elsewhere: all of the job, since a lesson is taken by a process whose parent waits for it.
  (%terminal-leave!)
  (kill 0 SIGSTOP)
  (%terminal-enter!)
  (look-anew! c))

(define (view-key! c key)
  "Do what KEY says if it only changes how things look, and return #t, else #f."
  (if (and (pair? key) (eq? 'mouse (car key)))
      (begin (mouse-moved! c (cdr key)) #t)
      (plain-view-key! c key)))

(define (plain-view-key! c key)
  (case key
    ((#\v) (show-view! c (next-of (cockpit-view c) (views-of c))) #t)
    ((#\1 #\2 #\3 #\4 #\5 #\6)
     (show-view! c (list-ref views (- (char->integer key) (char->integer #\1))))
     #t)
    ((#\o) (set-paint! c (next-of (cockpit-paint c) '(plain tension curvature model))) #t)
    ((#\x) (set-plain! c (not (cockpit-plain? c))) #t)
    ((#\y) (set-lamp! c (not (cockpit-lamp? c))) #t)
    ((#\z) (set-map! c (not (cockpit-map? c))) (set-plan-due! c 0) #t)
    ((#\f) (set-words! c (not (cockpit-words? c))) (set-ahead-due! c 0) (set-said! c #f) #t)
    ((#\c) (toggle-belief! c) #t)
    ((#\?) (turn-help! c) #t)
    ((#\page) (look-anew! c) #t)        ; ^L
    ((#\sub) (suspend! c) #t)
    (else #f)))
