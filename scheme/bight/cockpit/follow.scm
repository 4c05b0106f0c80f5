;;; (bight cockpit follow) --- a followed dive in the cockpit: what comes drives it, and what is wrong is told.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit follow)
  #:use-module (bight cockpit)
  #:use-module ((bight cockpit view-keys) #:select (view-key!))
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit desk)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keyboard)
  #:use-module ((bight cockpit keys) #:select (keys-told view-keys-told))
  #:use-module (bight cockpit palette)
  #:use-module (bight cockpit state)
  #:use-module (bight cockpit what-if)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive time)
  #:use-module (bight follow carrier)
  #:use-module (bight follow session)
  #:use-module (bight telemetry source)
  #:use-module (srfi srfi-1)
  #:export (follow-in-cockpit follow-panel screen?))

(define hint "v view  o paint  z map  f words  x plain  g what if  p pause  ? keys  q leave")

;; The sticks of the vehicle that is followed are its pilot's: none are here.
(define follow-keys
  `(("space p" . "pause, go on: what comes meanwhile is read then")
    ("g" . "what if: 5 s from now, if he lets the sticks stand")
    ,@view-keys-told
    ("? q" . "this; leave")))

(define-record <screen>
  (make-screen cockpit session alarms pace due)
  screen?
  (cockpit screen-cockpit)
  (session screen-session)
  (alarms screen-alarms set-alarms!)    ; the last ones, strings, the last first
  (pace screen-pace)                    ; seconds of the dive in a second, of a file
  (due screen-due set-due!))            ; s: how far the dive of a file is let come

(define most-alarms 4)

(define (add-alarm! screen text)
  (set-alarms! screen (let ((all (cons text (screen-alarms screen))))
                        (take all (min most-alarms (length all)))))
  (announce! (screen-cockpit screen) text))

(define (follow-panel lines alarms)
  "Return a panel of a cockpit with LINES of what comes, and ALARMS under them, the last first."
  (lambda (put columns rows)
    (let* ((room (max 1 (min (length lines) (quotient rows 5))))
           (below (fold (lambda (line row)
                          (put 0 row (cut (string-append " " line " ") columns) white #x102028)
                          (+ row 1))
                        2 (take lines room))))
      (fold (lambda (alarm row)
              (put 0 row (cut (string-append " " alarm " ") columns) yellow #f)
              (+ row 1))
            below (take alarms (min (length alarms) (max 1 (quotient rows 8))))))))

(define (let-come! screen until)
  ;; Let the session follow what has come, but no longer than UNTIL on the clock.
  (let* ((session (screen-session screen)) (file? (not (source-live? (session-source session)))))
    (set-due! screen (+ (screen-due screen) (* (screen-pace screen) frame)))
    (listen! session 0
             (lambda ()
               (let ((t (session-time session)))
                 (or (> (clock) until)
                     (and file? t (>= t (screen-due screen)))))))))

(define (do-key! c key)
  (case key
    ((#\space #\p) (set-paused! c (not (cockpit-paused? c))))
    ((#\g) (toggle-ghost! c))
    ((#\q #\etx) (set-done! c #t))
    (else (view-key! c key))))

(define (take-keys! c until)
  (let loop ()
    (let ((keys (keys-within (max 0.001 (- until (clock))))))
      (if keys
          (for-each (lambda (key) (trying c (do-key! c key))) keys)
          (set-done! c 'hung-up))
      (when (and (not (cockpit-done? c)) (< (clock) until))
        (loop)))))

(define (show-frame! screen)
  (let* ((c (screen-cockpit screen)) (dive (carrier-dive (session-carrier (screen-session screen)))))
    (set-panel! c (follow-panel (session-lines (screen-session screen)) (screen-alarms screen)))
    (cond (dive
           (unless (cockpit-dive c) (board! c dive))
           (look-ahead! c)
           (draw-frame! c hint))
          (else (draw-page! c (cons "Waiting until it says where it is." (session-lines (screen-session screen)))
                            "q leave")))))

(define (follow-frames! screen stop?)
  (let ((c (screen-cockpit screen)) (session (screen-session screen)))
    (let loop ()
      (unless (or (cockpit-done? c) (stop?))
        (let ((until (+ (clock) frame)))
          (unless (cockpit-paused? c)
            (let-come! screen until))
          (show-frame! screen)
          (when (session-ended? session)
            (announce! c "the telemetry has ended; q leaves"))
          (take-keys! c until)
          (loop))))))

(define (number-of options name default)
  (let* ((text (assoc-ref options name)) (x (and text (text->number text))))
    (cond ((not text) default)
          ((and x (real? x) (<= 1/100 x 1000)) x)
          (else (bight-raise 'domain 'follow "~a is a number from 0.01 to 1000, not ~s" name text)))))

(define (view-of options)
  (let ((view (string->symbol (or (assoc-ref options "--view") "chase"))) (views '(chase pilot top side overview)))
    (if (memq view views)
        view
        (unknown-name 'follow "a cockpit" view views "view"))))

(define (follow-in-cockpit session set-tell! stop? options)
  "Show the dive of SESSION in the terminal until it is left or STOP?, a thunk, returns true.  SET-TELL! is called with
a procedure that shows an alarm.  OPTIONS are those of the command line, an alist."
  (let* ((c (new-cockpit (this-palette) (view-of options) 'plain))
         (screen (make-screen c session '() (number-of options "--pace" 1) 0)))
    (set-tell! (lambda (text) (add-alarm! screen text)))
    (dynamic-wind
      %terminal-enter!
      (lambda () (parameterize ((keys-told follow-keys)) (follow-frames! screen stop?)))
      %terminal-leave!)
    (when (eq? 'hung-up (cockpit-done? c))
      (bight-raise 'io 'follow "the terminal is gone"))))
