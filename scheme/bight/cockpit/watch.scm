;;; (bight cockpit watch) --- a recording watched in the cockpit: played, scrubbed, from event to event, with a ghost.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit watch)
  #:use-module (bight cockpit)
  #:use-module ((bight cockpit view-keys) #:select (view-key!))
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit desk)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keyboard)
  #:use-module ((bight cockpit keys) #:select (keys-told view-keys-told))
  #:use-module (bight cockpit palette)
  #:use-module (bight cockpit state)
  #:use-module (bight cockpit traces)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive reel)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module ((bight world) #:select (world-name))
  #:export (watch-file watch-reel film-stretch watch-panel show?))

(define hint "space play  arrows 1 s  [ ] 10 s  n b events  t plot  g ghost  ? keys  q leave")

(define watch-keys
  `(("space p" . "play, pause; at the end: from the beginning")
    ("arrows" . "left, right: a second back, forth")
    ("[ ]" . "ten seconds")
    ("n b" . "the next event; the one before")
    ("0" . "the beginning")
    ("+ -" . "twice as fast; half")
    ("t" . "plots, one after another, then none")
    ("g" . "the ghost, where there is one")
    ,@view-keys-told
    ("? q" . "this; leave")))

(define-record <show>
  (make-show cockpit reel ghost behind traces pace owed drawn)
  show?
  (cockpit show-cockpit)
  (reel show-reel)
  (ghost show-ghost)                    ; another reel, or #f
  (behind show-behind)                  ; the place of the reel at which the ghost begins
  (traces show-traces)                  ; what is plotted of both
  (pace show-pace set-pace!)            ; seconds of the dive in a second
  (owed show-owed set-owed!)            ; steps, and the share of one, that are due
  (drawn show-drawn set-drawn!))        ; s of the clock: when the last frame was drawn

(define (engine-of-reel reel) (engine-of (reel-dive reel)))

(define (step-length show)
  (%dive-time-step (engine-of-reel (show-reel show))))

(define (steps-in show seconds)
  (inexact->exact (round (/ seconds (step-length show)))))


;;; What stands above the picture.

(define (two n) (string-pad (number->string n) 2 #\0))

(define (clock-said seconds)
  (let ((s (inexact->exact (floor seconds))))
    (string-append (number->string (quotient s 60)) ":" (two (remainder s 60)))))

(define (bar-of share width)
  (let ((at (min (- width 1) (inexact->exact (floor (* share width))))))
    (string-append "[" (make-string at #\=) "|" (make-string (- width at 1) #\-) "]")))

(define (event-said event)
  (string-join (cons* (clock-said (cadr event)) (map (lambda (x) (simple-format #f "~a" x))
                                                     (cons (car event) (filter symbol? (cddr event)))))))

(define most-events 3)

(define* (watch-panel place length dt pace events #:key (plot (const '())))
  "Return a panel of a cockpit that says where a recording of LENGTH steps of DT seconds is, at PLACE, played at PACE,
the last of its EVENTS, and, where there is room, what PLOT, a procedure of a width, returns, lines."
  (lambda (put columns rows)
    (let* ((said (string-append (clock-said (* place dt)) " / " (clock-said (* length dt))
                                (if (= pace 1) "" (simple-format #f "  x~a" pace))))
           (width (max 4 (- columns (string-length said) 6)))
           (room (if (>= rows 16) most-events 1))
           (shown (take-right events (min room (fold (lambda (e n) (+ n 1)) 0 events)))))
      (put 0 2 (cut (string-append " " said "  " (bar-of (if (zero? length) 0 (/ place length)) width)) columns)
           white #x102028)
      (draw-plot put columns rows plot
                 (fold (lambda (event row)
                         (put 0 row (cut (string-append " " (event-said event) " ") columns) yellow #f)
                         (+ row 1))
                       3 shown)))))

(define widest-plot 60)

(define (draw-plot put columns rows plot row)
  ;; At the left from ROW on, if the screen has room for it beside the picture; return the row below the events.
  (when (and (>= columns 60) (>= rows 22))
    (let ((lines (plot (min widest-plot (quotient columns 2)))))
      (put-lines put 0 row lines white #x081820)))
  row)


;;; Playing.

(define (wind-both! show place)
  (let ((reel (show-reel show)) (ghost (show-ghost show)))
    (wind-tracing! (show-traces show) reel place)
    (when ghost
      (wind-tracing! (show-traces show) ghost (- (reel-place reel) (show-behind show))))
    (set-owed! show 0)))

(define (scrub! show seconds)
  (wind-both! show (+ (reel-place (show-reel show)) (steps-in show seconds)))
  (ask-anew! (show-cockpit show)))

(define most-owed 20)                   ; steps in a frame: a slow machine plays slower

(define (play-on! show)
  ;; Take the steps that are due since the last frame.
  (let* ((c (show-cockpit show)) (t (clock))
         (owed (+ (show-owed show) (/ (* (show-pace show) (- t (show-drawn show))) (step-length show))))
         (n (min most-owed (inexact->exact (floor owed)))))
    (set-drawn! show t)
    (cond ((cockpit-paused? c) (set-owed! show 0))
          (else
           (wind-both! show (+ (reel-place (show-reel show)) n))
           (set-owed! show (min 1 (- owed n)))
           (when (= (reel-place (show-reel show)) (reel-length (show-reel show)))
             (set-paused! c #t))))))

(define (pause! show)
  (let ((c (show-cockpit show)) (reel (show-reel show)))
    (when (and (cockpit-paused? c) (= (reel-place reel) (reel-length reel)))
      (wind-both! show 0))
    (set-paused! c (not (cockpit-paused? c)))))

(define (go-to-event! show find)
  (set-paused! (show-cockpit show) #t)
  (find (show-reel show))
  (wind-both! show (reel-place (show-reel show)))
  (ask-anew! (show-cockpit show)))

(define (toggle-ghost-reel! show)
  (let ((c (show-cockpit show)) (ghost (show-ghost show)))
    (cond ((not ghost) (announce! c "bight watch FILE --ghost OTHER shows another recording beside it"))
          ((cockpit-plain? c) (announce! c "plain characters show no ghost"))
          (else (set-ghost! c (and (not (cockpit-ghost c)) (reel-dive ghost)))))))

(define (faster! show factor)
  (set-pace! show (max 1/8 (min 16 (* factor (show-pace show))))))

(define (do-key! show key)
  (let ((c (show-cockpit show)))
    (case key
      ((#\space #\p) (pause! show))
      ((left) (scrub! show -1))
      ((right) (scrub! show 1))
      ((#\[) (scrub! show -10))
      ((#\]) (scrub! show 10))
      ((#\0) (wind-both! show 0) (ask-anew! c))
      ((#\n) (go-to-event! show next-event-place))
      ((#\b) (go-to-event! show event-before))
      ((#\+ #\=) (faster! show 2))
      ((#\-) (faster! show 1/2))
      ((#\g) (toggle-ghost-reel! show))
      ((#\t) (announce! c (next-trace! (show-traces show))))
      ((#\q #\etx) (set-done! c #t))
      (else (view-key! c key)))))

(define (take-keys! show until)
  (let loop ()
    (let* ((c (show-cockpit show)) (keys (keys-within (max 0.001 (- until (clock))))))
      (if keys
          (for-each (lambda (key) (trying c (do-key! show key))) keys)
          (set-done! c 'hung-up))
      (when (and (not (cockpit-done? c)) (< (clock) until))
        (loop)))))

(define (ghost-shown show)
  (and (cockpit-ghost (show-cockpit show)) (show-ghost show)))

(define (draw-show! show)
  (let* ((c (show-cockpit show)) (reel (show-reel show)))
    (set-panel! c (watch-panel (reel-place reel) (reel-length reel) (step-length show) (show-pace show)
                               (%events (engine-of-reel reel) 0)
                               #:plot (lambda (columns)
                                        (trace-lines (show-traces show) reel (ghost-shown show) (show-behind show)
                                                     columns))))
    (draw-frame! c hint)))

(define (play-frames! show)
  (let ((c (show-cockpit show)))
    (let loop ()
      (unless (cockpit-done? c)
        (let ((until (+ (clock) frame)))
          (unless (trying c (play-on! show) #t)
            (set-paused! c #t))
          (draw-show! show)
          (take-keys! show until)
          (loop))))))

;;; A film of a stretch.

(define (seconds-of name text)
  ;; TEXT, what stands behind the option NAME, as seconds.
  (let ((s (text->number text)))
    (if (and s (real? s) (finite? s) (>= s 0))
        s
        (bight-raise 'domain 'watch "~a is seconds from the beginning, 0 or more, not ~s" name text))))

(define (winder reel)
  ;; A procedure that lets so many seconds of REEL pass, parts of steps kept for later.
  (let ((owed 0) (dt (%dive-time-step (engine-of-reel reel))))
    (lambda (seconds)
      (set! owed (+ owed (/ seconds dt)))
      (let ((n (inexact->exact (floor (+ owed 1e-6)))))
        (set! owed (- owed n))
        (wind! reel (+ (reel-place reel) n))))))

(define (film-stretch reel out from to)
  "Write a film of REEL between the seconds FROM and TO, #f for its end, to the file OUT.  Return what was written."
  (let* ((dt (%dive-time-step (engine-of-reel reel)))
         (to (min (or to +inf.0) (* dt (reel-length reel)))))
    (unless (< from to)
      (bight-raise 'domain 'watch "a stretch ends after it begins: from ~a to ~a s of ~a s is none" from to
                   (* dt (reel-length reel))))
    (wind! reel (inexact->exact (round (/ from dt))))
    (parameterize ((current-dive (reel-dive reel))
                   ((module-ref (resolve-interface '(bight view film)) 'pass-time) (winder reel)))
      ((module-ref (resolve-interface '(bight view film)) 'film) out #:for (- to from)))))

(define (watch-file file options)
  "Watch the recording FILE in the terminal, with OPTIONS of the command line, an alist; or film it."
  (let ((out (assoc-ref options "--film"))
        (seconds (lambda (name) (and=> (assoc-ref options name) (lambda (text) (seconds-of name text))))))
    (if out
        (begin
          (display (film-stretch (open-reel file) out (or (seconds "--from") 0) (seconds "--to")))
          (newline))
        (watch-in-cockpit file options (if (equal? "end" (assoc-ref options "--at")) 'end (seconds "--at"))))))

(define* (watch-reel reel at #:key ghost (behind 0) (ghost-name "ghost") told plain?)
  "Watch REEL in a terminal that was taken, from its beginning, or, if AT is a number of seconds or end, standing still
there; beside GHOST, another reel or #f, called GHOST-NAME, that begins where REEL is at its place BEHIND.  TOLD, a string
or #f, is told first.  PLAIN? wants plain characters for a picture.  Return how it ended: #t, or hung-up."
  (let* ((c (new-cockpit (this-palette) 'chase 'plain)) (show (make-show c reel ghost behind (new-traces) 1 0 (clock))))
    (when plain? (set-plain! c #t))
    (when told (announce! c told long))
    (set-ghost-name! c ghost-name)
    (parameterize ((current-dive (reel-dive reel)) (keys-told watch-keys))
      (board! c (reel-dive reel))
      (when ghost (set-ghost! c (reel-dive ghost)))
      (when at
        (wind-both! show (if (eq? 'end at) (reel-length reel) (steps-in show at)))
        (set-paused! c #t))
      (set-drawn! show (clock))
      (play-frames! show)
      (cockpit-done? c))))

(define long 20)                        ; s that something is told

(define (other-world reel ghost)
  ;; A sentence that the GHOST is in another world than REEL, or #f.
  (let ((name (lambda (reel) (world-name (dive-world (reel-dive reel))))))
    (and (not (eq? (name reel) (name ghost)))
         (simple-format #f "the ghost is in another world, ~a: it is shown where it would be in this one" (name ghost)))))

(define (watch-in-cockpit file options at)
  (let ((reel (open-reel file)) (ghost (and=> (assoc-ref options "--ghost") open-reel)) (ended #f))
    (dynamic-wind
      %terminal-enter!
      (lambda () (set! ended (watch-reel reel at #:ghost ghost #:told (and ghost (other-world reel ghost)))))
      %terminal-leave!)
    (when (eq? 'hung-up ended)
      (bight-raise 'io 'watch "the terminal is gone"))))
