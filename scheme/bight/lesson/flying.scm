;;; (bight lesson flying) --- a task flown in the cockpit: what its panel says, its keys, and how time passes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson flying)
  #:use-module (bight cockpit)
  #:use-module (bight cockpit controls)
  #:use-module (bight cockpit desk)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keys)
  #:use-module (bight cockpit line)
  #:use-module ((bight cockpit orders) #:select (answer-order! next-order! publish!))
  #:use-module (bight cockpit state)
  #:use-module (bight cockpit what-if)
  #:use-module ((bight core decimal) #:select (figure))
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive plain-words)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight lesson asking)
  #:use-module (bight lesson how-it-was)
  #:use-module (bight lesson input)
  #:use-module (bight lesson lines)
  #:use-module (bight lesson seat)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:use-module (bight lesson task)
  #:export (fly-in-cockpit lesson-panel target-line show-lines!))

(define (show-lines! lines)
  "Show LINES as they are, without a picture behind them."
  (parameterize ((unseen? (lambda (verb) (or (eq? verb 'look) (hidden-in-lesson? verb)))))
    (show-page! lines "Enter goes on   q leaves")))



;;; Flying: what the panel says.

(define (target-line target i)
  "Return the line of the panel about TARGET, a pair of its name and place, the one with the number I."
  (let ((p (cdr target)))
    (string-append (number->string (+ i 1)) " " (car target) "  " (metres (range-to p)) "  "
                   (string-pad (number->string (modulo (inexact->exact (round (bearing-to p))) 360)) 3 #\0)
                   "  " (metres (- (z p))) " deep")))

(define (target-lines targets)
  (map target-line targets (iota (length targets))))

(define (counters-line)
  (string-join
   (append (list (seconds-said (task-seconds)))
           (map (lambda (entry) (simple-format #f "~a ~a" (car entry) (cdr entry))) (task-counters))
           (map (lambda (entry)
                  (string-append (car entry) " "
                                 (let ((value (cdr entry))) (if (number? value) (figure value) (simple-format #f "~a" value)))))
                (task-gauges)))
   "  "))

(define (lesson-panel task heard targets counters)
  "Return a panel of a cockpit, a procedure of PUT, columns and rows: the TASK, a string; HEARD, a list of (INK . TEXT),
the last first; TARGETS and COUNTERS, lists of lines.  It returns the row below."
  (lambda (put columns rows)
    (define tiny? (and (< rows 12) (pair? heard))) ; what was heard last then takes the place of task and counters
    (define most (cond ((>= rows 30) 4) ((>= rows 20) 3) (else 1)))
    (define (shown text most)
      (let ((lines (wrap text (- columns 2))))
        (if (<= (length lines) most)
            lines
            (append (list-head lines (- most 1))
                    (list (cut (string-append (list-ref lines (- most 1)) " " (list-ref lines most)) (- columns 2)))))))
    (define (inked entry most)
      (map (lambda (line) (cons (car entry) line)) (shown (cdr entry) most)))
    (define (heard-lines)
      (if tiny?
          (inked (car heard) 3)
          (let ((lines (append-map (lambda (entry) (inked entry most)) (reverse heard))))
            (take-right lines (min most (length lines))))))
    (define (put-all row lines ink)
      (fold (lambda (line row)
              (put 0 row (string-pad-right (string-append " " line) columns) ink #x102028)
              (+ row 1))
            row lines))
    (let* ((row (put-all 2 (if tiny? '() (shown task most)) white))
           (row (fold (lambda (entry row) (put-all row (list (cdr entry)) (car entry))) row (heard-lines)))
           (room (if (>= rows 20) 9 1))
           (row (fold (lambda (line row)
                        (put 0 row (cut (string-append " " line " ") columns) green #f)
                        (+ row 1))
                      row (if (> (length targets) room) (list-head targets room) targets))))
      (fold (lambda (line row)
              (put 0 row (cut (string-append " " line " ") columns) pale #f)
              (+ row 1))
            row (if tiny? '() counters)))))

(define (targets-seen)
  ;; Where the level lets a pupil have them.
  (if (hard?) '() (task-targets)))

(define (panel-now put columns rows)
  (let ((targets (targets-seen)))
    ((lesson-panel (task-text) (seat-heard (the-seat))
                   (target-lines targets)
                   (list (counters-line)))
     put columns rows)))


;;; Flying: keys and time.

(define flight-hint "e hint  u back  p pause  t tender  z map  v view  : Scheme  ? keys  q leave")

(define most-steps 6)                   ; in a frame: a slow machine flies slower rather than in jumps

(define (steps-due! c)
  ;; How many steps are due since the last frame.
  (let* ((t (clock)) (dt (time-step))
         (n (inexact->exact (floor (/ (- t (cockpit-stepped c)) dt)))))
    (cond ((> n most-steps) (set-stepped! c t) most-steps)
          (else (set-stepped! c (+ (cockpit-stepped c) (* n dt))) n))))

(define (stick-input! c)
  ;; The input of sticks that stand otherwise than before, in a list.
  (set-sticks! c (settle (cockpit-sticks c) (clock)))
  (let ((values (stick-positions c)))
    (if (equal? values (cockpit-sent c))
        '()
        (begin
          (set-sent! c values)
          (list (cons 'sticks values))))))

(define (typed label)
  ;; A line typed at the foot of the flight, or #f.
  (let ((c (this-cockpit)) (seat (the-seat)))
    (waiting
     (lambda ()
       (let* ((line (type-in (empty-line (seat-history seat))
                             (lambda (line)
                               (draw-flight! c (prompt-shown label line (columns-now)) #:typing? #t))))
              (text (string-trim-both (line-text line))))
         (and (line-done? line) (not (member text '("" ",q")))
              (begin
                (set-history! seat (cons text (seat-history seat)))
                text)))))))

(define (typed-input label make)
  (let* ((c (this-cockpit)) (text (typed label)))
    (set-stepped! c (clock))
    (if text (list (make text)) '())))

(define (act->inputs c act)
  ;; What ACT of a key means for the dive: a list of inputs.
  (case (car act)
    ((leave) ((leaving)))
    ((release)
     (set-sticks! c (new-sticks))
     (set-sent! c (stick-values (new-sticks)))
     '((release)))
    ((winch hold) (list act))
    ((back hint) (list act))
    ((ghost) (toggle-ghost! c) '())
    ((pause) (set-paused! c (not (cockpit-paused? c))) (set-stepped! c (clock)) '())
    ((prompt) (typed-input "bight> " (lambda (text) (list 'form text))))
    ((tell) (typed-input "to the tender> " (lambda (text) (list 'tell text))))
    (else '())))

(define (key->inputs c key)
  (cond ((stick-key! c key) '())
        ((view-key-here! key) '())
        ((act-of-key key) => (lambda (act) (act->inputs c act)))
        (else '())))

(define (call-with-targets c thunk)
  ;; Call THUNK, which draws: the task's targets are in the view and on the map.
  (set-targets! c targets-seen)
  (let ((value (thunk)))
    (set-targets! c (const '()))
    value))

(define* (draw-flight! c last-line #:key typing?)
  (set-panel! c panel-now)
  (call-with-targets c (lambda () (draw-frame! c last-line #:typing? typing?)))
  (set-panel! c #f))

(define (inputs-until c end)
  ;; What the keys mean that come before the time END, s of the clock.
  (let loop ((inputs '()))
    (let ((key (next-key (- end (clock)))))
      (cond (key (loop (append inputs (key->inputs c key))))
            ((< (clock) end) (loop inputs))
            (else inputs)))))

(define (publish-flight! c)
  ;; Let an instructor see the dive, the task and what the pupil hears.
  (trying c (publish! (current-dive) (cons* (task-text) (counters-line) (map cdr (seat-heard (the-seat)))))))

(define (stopped? c)
  ;; Whether an instructor has stopped the clock; no time is owed for that then.
  (and (tally-ref 'stopped)
       (begin
         (set-stepped! c (clock))
         (announce! c "the instructor has stopped the clock")
         #t)))

(define (orders-now)
  ;; The input of an instructor's order, in a list.
  (let ((order (next-order!)))
    (if order (list (list 'instruct order)) '())))

(define (inputs-of-loss! c)
  ;; What a controller that was lost means, also while a page was read or a line typed: a list of inputs.
  (cond ((seat-lost? (the-seat))
         (set-lost! (the-seat) #f)
         (set-sent! c (stick-values (new-sticks)))
         '((release) (hold place)))
        (else '())))

(define (frame-inputs! c)
  ;; Draw a frame, take the keys of its time, and return the inputs that came of both.
  (let ((end (+ (clock) frame)))
    (publish-flight! c)
    (set-dark! c (tally-ref 'dark))
    (look-ahead! c)
    (draw-flight! c flight-hint)
    (when (cockpit-done? c) ((leaving)))
    (let* ((pressed (inputs-until c end))
           (lost (inputs-of-loss! c))
           (moved (stick-input! c))
           (steps (if (or (cockpit-paused? c) (stopped? c)) 0 (steps-due! c))))
      (append (orders-now) pressed lost moved (if (positive? steps) (list (list 'pass steps)) '())))))

(define (flight-asker c)
  ;; A procedure that returns the next input of a pupil at the sticks.
  (let ((waiting '()))
    (lambda ()
      (let loop ()
        (if (pair? waiting)
            (let ((input (car waiting)))
              (set! waiting (cdr waiting))
              input)
            (begin
              (set! waiting (frame-inputs! c))
              (loop)))))))

(define few 2)                          ; lines that are heard; more stand on a page

(define (show-result! c lines)
  (if (> (length lines) few)
      (show-lines! lines)
      (for-each (lambda (line) (hear! #xffffff line)) lines))
  (when (pair? lines)
    (ask-anew! c)
    (set-stepped! c (clock))))

(define (sticks-now)
  (array->list (sticks)))

(define (note-sticks!)
  ;; How the lesson set the sticks for the task; what the pupil does with them comes later.
  (let ((n (tally-ref 'tasks)))
    (unless (eqv? n (car (tally-ref 'sticks-set '(#f))))
      (tally-set! 'sticks-set (cons n (sticks-now))))))

(define (feel-sticks! c)
  ;; The dive's sticks may stand otherwise than the pupil's, as after a step back in time: then the pupil's are told
  ;; again, unless the lesson itself set those of the dive.
  (note-sticks!)
  (set-sent! c (if (equal? (sticks-now) (cdr (tally-ref 'sticks-set)))
                   (stick-values (new-sticks))
                   (sticks-now))))

(define (take-seat! c)
  (keep-up!)
  (set-view! c (or (one-view) (seat-view (the-seat))))
  (set-map! c (not (hard?)))
  (set-sticks! c (new-sticks))
  (feel-sticks! c)
  (drop-ghost! c)
  (set-paused! c #f)
  (set-stepped! c (clock)))

(define (fly-in-cockpit n seconds)
  "Let the pupil fly task N until it is over."
  (let ((c (this-cockpit)))
    (note-sticks!)
    (catch-up!)
    (read-what-was-said!)
    (take-seat! c)
    (set-plan-due! c 0)
    (call-with-targets c
      (lambda ()
        (show-page! (cons (string-append "TASK: " (task-text)) (target-lines (task-targets)))
                    "Enter begins   ? in flight shows the keys   q leaves")))
    (set-stepped! c (clock))
    (dynamic-wind
      (const #t)
      (lambda ()
        (let ((ask (flight-asker c)))
          (let loop ()
            (let* ((input (next-input ask)) (lines (apply-input! input)))
              (case (car input)
                ((instruct) (answer-order! lines))
                (else
                 (when (eq? 'back (car input)) (feel-sticks! c))
                 (show-result! c lines))))
            (loop))))
      (lambda () (set-seat-view! (the-seat) (if (one-view) 'chase (cockpit-view c)))))))
