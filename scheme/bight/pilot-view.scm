;;; (bight pilot-view) --- fly the dive live in the terminal.
;;;
;;; The dive is live: a thread of its own steps it, whatever happens here.  This loop draws it thirty
;;; times a second, in half blocks of which only the changed ones are written, and turns keys into the
;;; verbs that a user has too, so that all it does is recorded like anything else.  A dive that cannot be
;;; live, because its current is a procedure, is stepped by the loop.
;;;
;;; What can go wrong with the picture does not end the flight: plain characters take its place.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight pilot-view)
  #:use-module (bight cells)
  #:use-module (bight checkpoint)
  #:use-module (bight command)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight pilot-hud)
  #:use-module (bight pilot-keys)
  #:use-module (bight query)
  #:use-module (bight record)
  #:use-module (bight task)
  #:use-module (bight time)
  #:use-module (bight verb)
  #:use-module ((bight world) #:select (world-name))
  #:use-module (srfi srfi-1)
  #:export (pilot!
            pilot-world
            palette-of
            frame-pixels
            cockpit?))

(define-syntax-rule (from module name)
  (module-ref (resolve-interface 'module) 'name))

(define frame 1/30)                     ; s
(define slow-period 1/2)                ; s: between questions that cost something
(define forecast-period 1)              ; s: between looks ahead, or longer,
(define forecast-share 1/50)            ; so that they take no more of the time than this
(define ghost-horizon 5)                ; s
(define ghost-budget 0.006)             ; s of a frame

(define (clock)
  (/ (get-internal-real-time) (exact->inexact internal-time-units-per-second)))


;;; What the loop knows.

(define-record <cockpit>
  (make-cockpit dive vehicle tether palette screen size view paint plain? lamp? help? sticks sent
                message message-until slow slow-due ahead ahead-due paused? ghost ghost-fork live? done? times
                stepped)
  cockpit?
  (dive cockpit-dive)
  (vehicle cockpit-vehicle)             ; names, or #f
  (tether cockpit-tether)
  (palette cockpit-palette)
  (screen cockpit-screen set-screen!)
  (size cockpit-size set-size!)
  (view cockpit-view set-view!)
  (paint cockpit-paint set-paint!)
  (plain? cockpit-plain? set-plain!)    ; no picture: #t, or why
  (lamp? cockpit-lamp? set-lamp!)
  (help? cockpit-help? set-help!)
  (sticks cockpit-sticks set-sticks!)
  (sent cockpit-sent set-sent!)         ; the values that the vehicle was told last, or #f
  (message cockpit-message set-message!)
  (message-until cockpit-message-until set-message-until!)
  (slow cockpit-slow set-slow!)
  (slow-due cockpit-slow-due set-slow-due!)
  (ahead cockpit-ahead set-ahead!)      ; what is to come, strings
  (ahead-due cockpit-ahead-due set-ahead-due!)
  (paused? cockpit-paused? set-paused!)
  (ghost cockpit-ghost set-ghost!)      ; a dive to draw, #t: wanted, #f: not
  (ghost-fork cockpit-ghost-fork set-ghost-fork!) ; (DIVE . STEPS-LEFT) on its way, or #f
  (live? cockpit-live? set-live!)       ; #f: this loop steps the dive
  (done? cockpit-done? set-done!)
  (times cockpit-times set-times!)      ; when the last frames were drawn, the newest first
  (stepped cockpit-stepped set-stepped!)) ; by this loop, until when

(define (first-or-false list)
  (and (pair? list) (car list)))

(define (new-cockpit dive palette view paint)
  (let ((engine (engine-of dive)))
    (make-cockpit dive (first-or-false (%names engine 'rov)) (first-or-false (%names engine 'tether))
                  palette #f #f view paint (eq? palette 'none) #f #f (new-sticks) #f
                  "" 0 '((windings) (warnings)) 0 '() 0 #f #f #f #f #f '() (clock))))

(define (tell! c text)
  ;; Show TEXT for a while.
  (set-message! c text)
  (set-message-until! c (+ 4 (clock))))

(define (call-or-tell c thunk)
  ;; Call THUNK; what it raises is shown.
  (with-exception-handler
      (lambda (e)
        (if (bight-error? e) (tell! c (bight-error-message e)) (raise-exception e)))
    thunk
    #:unwind? #t))

(define-syntax-rule (trying c body ...)
  (call-or-tell c (lambda () body ...)))


;;; Colours of terminals.

(define (palette-of term colorterm no-color)
  "Return the palette of a terminal whose environment says TERM, COLORTERM and NO_COLOR, strings or #f:
true, many, few or none."
  (define (says? text word) (and text (string-contains text word) #t))
  (cond ((and no-color (not (string-null? no-color))) 'none)
        ((or (member colorterm '("truecolor" "24bit")) (says? term "direct")) 'true)
        ((says? term "256color") 'many)
        ((or (not term) (string-prefix? "vt" term) (says? term "mono")) 'none)
        (else 'few)))


;;; Time.

(define (start-time! c)
  ;; Let the dive run, live if it can.
  (set-paused! c #f)
  (set-stepped! c (clock))
  (set-live! c (or (trying c (go-live! (cockpit-dive c) 1.0) #t) #f))
  (when (eq? #f (cockpit-live? c))
    (tell! c "a current that is a procedure: the dive is stepped between the frames")))

(define (stop-time! c)
  (set-paused! c #t)
  (when (cockpit-live? c)
    (freeze-dive! (cockpit-dive c))))

(define (step-along! c)
  ;; Take the steps that are due since the last frame, at most a tenth of a second.
  (let* ((t (clock)) (dt (time-step))
         (n (min (inexact->exact (floor (/ (- t (cockpit-stepped c)) dt)))
                 (inexact->exact (floor (/ 0.1 dt))))))
    (when (> n 0)
      (set-stepped! c (max (+ (cockpit-stepped c) (* n dt)) (- t 0.1)))
      (run (* n dt)))))

(define (pass-time! c)
  (let ((dive (cockpit-dive c)))
    (cond ((cockpit-paused? c) #f)
          ((not (cockpit-live? c)) (step-along! c))
          (else
           (%step-dive! (engine-of dive) 0) ; raises what stopped it
           (unless (idle? dive)
             (parameterize ((running-dive dive))
               (run-tasks! dive)))))))

(define (pass-time-or-stop! c)
  ;; A dive that can go no further stands still, and says why.
  (with-exception-handler
      (lambda (e)
        (unless (bight-error? e) (raise-exception e))
        (false-if-exception (stop-time! c))
        (set-paused! c #t)
        (tell! c (bight-error-message e)))
    (lambda () (pass-time! c))
    #:unwind? #t))


;;; What if: a fork that runs ahead, a little in every frame.

(define (advance-ghost! c)
  (let ((fork (or (cockpit-ghost-fork c)
                  (cons (fork-dive (cockpit-dive c))
                        (inexact->exact (round (/ ghost-horizon (time-step))))))))
    (let loop ((left (cdr fork)) (until (+ (clock) ghost-budget)))
      (cond ((zero? left)
             (set-ghost! c (car fork))
             (set-ghost-fork! c #f))
            ((> (clock) until) (set-ghost-fork! c (cons (car fork) left)))
            (else
             (%step-dive! (engine-of (car fork)) 1)
             (loop (- left 1) until))))))

(define (look-ahead! c)
  (when (cockpit-ghost c)
    (unless (trying c (advance-ghost! c) #t)
      (set-ghost! c #f)
      (set-ghost-fork! c #f))))


;;; Drawing.

(define (fit-screen! c)
  ;; Take the terminal's size as it is now; return #t if all must be written.
  (let ((size (%screen-size)))
    (if (equal? size (cockpit-size c))
        #f
        (begin
          (set-size! c size)
          (set-screen! c (%make-screen (car size) (cdr size) (cockpit-palette c)))
          #t))))

(define (frame-pixels engine view paint size flags ghost)
  "Return the pixels, a bytevector, of a quick picture of the dive of ENGINE by VIEW for SIZE, a pair of
columns and rows; GHOST is the engine of another dive, or #f."
  ((from (bight render) %draw) ((from (bight picture) renderer) 'pilot!)
                               engine "" view
                               (cons (car size) (* 2 (cdr size)))
                               paint (cons 'quick flags) ghost))

(define least-side 16)

(define (draw-picture! c)
  (let ((ghost (cockpit-ghost c)) (size (cockpit-size c)))
    (unless (and (>= (car size) least-side) (>= (* 2 (cdr size)) least-side))
      (bight-raise 'unsupported 'pilot! "the terminal is too small for a picture"))
    (%screen-picture! (cockpit-screen c)
                      (frame-pixels (engine-of (cockpit-dive c)) (cockpit-view c)
                                    (cockpit-paint c) size
                                    (if (cockpit-lamp? c) '(lamp) '())
                                    (and (dive? ghost) (engine-of ghost))))))

(define (draw-plainly! c put)
  (let ((columns (max 40 (min 160 (car (cockpit-size c))))))
    (draw-lines put 0 2 ((from (bight view) picture-lines) ((from (bight view) look) #:columns columns))
                #xd0e0e0 0)))

(define (no-picture! c e)
  ;; From now on without.
  (set-plain! c #t)
  (set-ghost! c #f)
  (tell! c (bight-error-message e)))

(define (draw-scene! c put)
  (unless (cockpit-plain? c)
    (with-exception-handler
        (lambda (e) (if (bight-error? e) (no-picture! c e) (raise-exception e)))
      (lambda () (draw-picture! c))
      #:unwind? #t))
  (when (cockpit-plain? c)
    (%screen-clear! (cockpit-screen c))
    (trying c (draw-plainly! c put))))

(define (frames-a-second c)
  (let ((times (cockpit-times c)))
    (if (or (null? times) (null? (cdr times)))
        0
        (inexact->exact (round (/ (- (length times) 1)
                                  (max 1e-3 (- (car times) (last times)))))))))

(define (title c)
  (let ((name (world-name (dive-world (cockpit-dive c)))))
    (string-append (if name (symbol->string name) "a dive") "  "
                   (number->string (/ (floor (* 10 (now))) 10)) " s")))

(define (right-text c)
  (string-join
   (filter identity
           (list (and (cockpit-paused? c) "PAUSED")
                 (and (cockpit-ghost c) "what if")
                 (and (cockpit-lamp? c) "lights")
                 (if (cockpit-plain? c) "plain" (symbol->string (cockpit-view c)))
                 (and (not (eq? 'plain (cockpit-paint c))) (symbol->string (cockpit-paint c)))
                 (string-append (number->string (frames-a-second c)) "/s")))
   "  "))

(define hint "w s a d i k j l sticks  v view  [ ] winch  p pause  ? keys  : prompt  q quit")

(define (sticks-now c)
  (if (cockpit-vehicle c)
      (f64vector->list* (sticks (cockpit-vehicle c)))
      '(0 0 0 0)))

(define (f64vector->list* v)
  (array->list v))

(define (ask-ahead! c t)
  ;; At T, of the copy that a live dive last published; not in a frame that asks for the slow figures.
  (set-ahead! c (forecast (cockpit-tether c)))
  (set-ahead-due! c (+ (clock) (max forecast-period (/ (- (clock) t) forecast-share)))))

(define (draw-figures! c put)
  (let ((t (clock)))
    (cond ((> t (cockpit-slow-due c))
           (set-slow! c (slow-figures (cockpit-vehicle c) (cockpit-tether c)))
           (set-slow-due! c (+ t slow-period)))
          ((and (> t (cockpit-ahead-due c)) (not (cockpit-paused? c)))
           (ask-ahead! c t)))
    (let ((telling? (< t (cockpit-message-until c))))
      (draw-hud put (car (cockpit-size c)) (cdr (cockpit-size c))
                (read-figures (cockpit-vehicle c) (cockpit-tether c))
                (cockpit-slow c)
                `((title . ,(title c)) (right . ,(right-text c)) (urgent? . ,telling?)
                  (message . ,(if telling? (cockpit-message c) hint))
                  (ahead . ,(cockpit-ahead c))
                  (sticks . ,(sticks-now c)))))))

(define (draw-help! c put)
  (let* ((width (+ 4 (apply max (map string-length key-lines))))
         (column (quotient (max 0 (- (car (cockpit-size c)) width)) 2)))
    (draw-lines put column 4
                (map (lambda (line) (string-pad-right (string-append "  " line) width)) key-lines)
                #xffffff #x102028)))

(define (note-frame! c)
  (let ((times (cons (clock) (cockpit-times c))))
    (set-times! c (if (> (length times) 31) (list-head times 31) times))))

(define (draw-frame! c)
  (let* ((new? (fit-screen! c)) (screen (cockpit-screen c))
         (put (lambda (column row text ink paper)
                (%screen-text! screen column row text ink paper))))
    (draw-scene! c put)
    (trying c (draw-figures! c put))
    (when (cockpit-help? c)
      (draw-help! c put))
    (note-frame! c)
    (unless (%screen-write! screen new?)
      (set-done! c 'hung-up))))


;;; Keys.

(define (send-sticks! c)
  ;; Tell the vehicle when the sticks stand otherwise than it was told.
  (set-sticks! c (settle (cockpit-sticks c) (clock)))
  (let ((values (stick-values (cockpit-sticks c))))
    (when (and (cockpit-vehicle c) (cockpit-sent c) (not (equal? values (cockpit-sent c))))
      (trying c
        (for-each (lambda (keyword value before)
                    (unless (= value before)
                      (drive! (cockpit-vehicle c) keyword value)))
                  '(#:surge #:sway #:heave #:yaw) values (cockpit-sent c))))
    (set-sent! c values)))

(define (let-go! c)
  (set-sticks! c (new-sticks))
  (set-sent! c (stick-values (cockpit-sticks c)))
  (trying c
    (release! (cockpit-vehicle c))
    (tell! c "sticks centred, autopilots off")))

(define (next-of value values)
  (let ((rest (memq value values)))
    (if (and rest (pair? (cdr rest))) (cadr rest) (car values))))

(define views '(chase pilot top side overview))

(define (show-view! c view)
  (set-view! c view)
  (tell! c (string-append "view: " (symbol->string view))))

(define (winch! c metres)
  (trying c
    (if (positive? metres)
        (pay-out! (cockpit-tether c) metres)
        (haul-in! (cockpit-tether c) (- metres)))
    (tell! c (simple-format #f "~a ~a m" (if (positive? metres) "paying out" "hauling in")
                            (abs metres)))))

(define (hold! c what hold value)
  (trying c
    (hold (cockpit-vehicle c) value)
    (tell! c (string-append "holding " what))))

(define (toggle-pause! c)
  (if (cockpit-paused? c)
      (start-time! c)
      (trying c (stop-time! c))))

(define (go-back! c)
  (trying c
    (let ((t (rewind! (min 5.0 (now)))))
      (set-sticks! c (new-sticks))
      (set-sent! c (stick-values (cockpit-sticks c)))
      (set-slow-due! c 0)
      (set-ahead-due! c 0)
      (tell! c (simple-format #f "back at ~a s" (/ (round (* 100 t)) 100))))))

(define (toggle-ghost! c)
  (set-ghost! c (not (cockpit-ghost c)))
  (set-ghost-fork! c #f)
  (when (and (cockpit-ghost c) (cockpit-plain? c))
    (set-ghost! c #f)
    (tell! c "plain characters show no what-if")))

(define (visit-prompt! c)
  ;; The screen is the user's meanwhile; the dive goes on.
  (%terminal-leave!)
  ((from (bight repl) run-inner-prompt)
   (if (cockpit-paused? c)
       "The dive is paused.  ,q goes back to it."
       "The dive goes on.  ,q goes back to it."))
  (%terminal-enter!)
  (set-size! c #f)                      ; all must be written
  (set-paused! c (and (cockpit-live? c) (not (%live? (engine-of (cockpit-dive c))))))
  (set-stepped! c (clock))
  (set-sent! c #f))

(define (suspend! c)
  ;; As ^Z does elsewhere.
  (%terminal-leave!)
  (kill (getpid) SIGSTOP)
  (%terminal-enter!)
  (set-size! c #f))

(define (do-key! c key)
  (let ((v (cockpit-vehicle c)))
    (cond
     ((stick-of-key key)
      => (lambda (stick)
           (set-sticks! c (press (cockpit-sticks c) (car stick) (cdr stick) (clock)))))
     ((nudge-of-key key)
      => (lambda (step) (set-sticks! c (nudge (cockpit-sticks c) (car step) (cdr step)))))
     (else
      (case key
        ((#\q #\etx) (set-done! c #t))
        ((#\space) (let-go! c))
        ((#\v) (show-view! c (next-of (cockpit-view c) views)))
        ((#\1 #\2 #\3 #\4 #\5)
         (show-view! c (list-ref views (- (char->integer key) (char->integer #\1)))))
        ((#\o) (set-paint! c (next-of (cockpit-paint c) '(plain tension curvature model))))
        ((#\x) (set-plain! c (not (cockpit-plain? c))))
        ((#\y) (set-lamp! c (not (cockpit-lamp? c))))
        ((#\g) (toggle-ghost! c))
        ((#\h) (hold! c "heading" hold-heading! (rov-heading v)))
        ((#\b) (hold! c "depth" hold-depth! (rov-depth v)))
        ((#\n) (hold! c "altitude" hold-altitude! (rov-altitude v)))
        ((#\m) (trying c (hold-position! v) (tell! c "holding this place")))
        ((#\[) (winch! c -1))
        ((#\]) (winch! c 1))
        ((#\{) (winch! c -5))
        ((#\}) (winch! c 5))
        ((#\p) (toggle-pause! c))
        ((#\u) (go-back! c))
        ((#\?) (set-help! c (not (cockpit-help? c))))
        ((#\:) (visit-prompt! c))
        ((#\page) (set-size! c #f))     ; ^L
        ((#\sub) (suspend! c)))))))

(define (take-keys! c seconds)
  (let ((bytes (%terminal-keys (max 0 seconds))))
    (if bytes
        (for-each (lambda (key) (trying c (do-key! c key))) (bytes->keys bytes))
        (set-done! c 'hung-up))))


;;; The loop.

(define (fly-frames! c)
  (set-sent! c (stick-values (cockpit-sticks c)))
  (let loop ((due (clock)))
    (unless (cockpit-done? c)
      (pass-time-or-stop! c)
      (look-ahead! c)
      (draw-frame! c)
      (let* ((next (max (clock) (+ due frame))))
        (let wait ()
          (take-keys! c (- next (clock)))
          (when (and (not (cockpit-done? c)) (> (- next (clock)) 0.001))
            (wait)))
        (send-sticks! c)
        (loop next)))))

(define (fly! c)
  (let* ((dive (cockpit-dive c)) (was-live? (%live? (engine-of dive))))
    (dynamic-wind
      (lambda () (%terminal-enter!))
      (lambda ()
        (start-time! c)
        (fly-frames! c))
      (lambda ()
        (%terminal-leave!)
        (unless was-live?
          (false-if-exception (freeze-dive! dive)))))))

(define-verb (pilot! #:key (view (one-of chase pilot top side overview) 'chase)
                     (paint (one-of plain tension curvature model) 'plain)
                     (colors (or-false (one-of true many few none))))
  "Fly the dive live from the keyboard, all of the terminal its picture: ? there shows the keys, : is the
prompt, q leaves.  VIEW is chase, pilot, top, side or overview; PAINT colours the tether as `snapshot'
does; COLORS, when given, says what the terminal can: true, many (256), few (16) or none.  Return the time
at which it was left."
  (let ((dive (this-dive 'pilot!)))
    (check-not-running 'pilot! dive)
    (let ((c (new-cockpit dive
                          (or colors (palette-of (getenv "TERM") (getenv "COLORTERM")
                                                 (getenv "NO_COLOR")))
                          view paint)))
      (fly! c)
      (when (eq? 'hung-up (cockpit-done? c))
        (bight-raise 'io 'pilot! "the terminal is gone"))
      (now))))

(define (pilot-world world options)
  "Start a dive in WORLD, a name or a file, and fly it, with OPTIONS of the command line, an alist."
  ((from (bight dive) enter!) world #:trust (assoc-ref options "--trust"))
  (apply pilot!
         (append-map (lambda (entry)
                       (let ((text (assoc-ref options (first entry))))
                         (if text (list (second entry) (string->symbol text)) '())))
                     '(("--view" #:view) ("--paint" #:paint) ("--colors" #:colors)))))
