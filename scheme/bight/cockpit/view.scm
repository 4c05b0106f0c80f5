;;; (bight cockpit view) --- fly the dive live in the terminal.
;;;
;;; The dive is live: a thread of its own steps it, whatever happens here.  This loop draws it thirty
;;; times a second in a cockpit, (bight cockpit), and turns keys into the verbs that a user has too, so that all
;;; it does is recorded like anything else.  A dive that cannot be live, because its current is a procedure, is
;;; stepped by the loop.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit view)
  #:use-module (bight belief)
  #:use-module (bight belief clauses)
  #:use-module (bight cockpit)
  #:use-module ((bight cockpit view-keys) #:select (view-key!))
  #:use-module (bight cockpit believed)
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit controller)
  #:use-module (bight cockpit controls)
  #:use-module (bight cockpit keyboard)
  #:use-module (bight cockpit keys)
  #:use-module ((bight cockpit orders) #:select (answer-order! do-to-dive! call-with-desk next-order! publish!))
  #:use-module (bight cockpit palette)
  #:use-module (bight cockpit state)
  #:use-module (bight cockpit what-if)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive command)
  #:use-module (bight dive query)
  #:use-module (bight dive task)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (pilot!
            pilot-world))


;;; Time.

(define (start-time! c)
  ;; Let the dive run, live if it can.
  (set-paused! c #f)
  (set-stepped! c (clock))
  (set-live! c (or (trying c (go-live! (cockpit-dive c) 1.0) #t) #f))
  (when (eq? #f (cockpit-live? c))
    (announce! c "a current that is a procedure: the dive is stepped between the frames")))

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
        (announce! c (bight-error-message e)))
    (lambda () (pass-time! c))
    #:unwind? #t))


;;; Keys.

(define (drive-as! c values)
  (for-each (lambda (keyword value before)
              (unless (= value before)
                (drive! (cockpit-vehicle c) keyword value)))
            '(#:surge #:sway #:heave #:yaw) values (cockpit-sent c)))

(define (send-sticks! c)
  ;; Tell the vehicle when the sticks stand otherwise than it was told; what it refused it is told again.
  (set-sticks! c (settle (cockpit-sticks c) (clock)))
  (let ((values (stick-positions c)))
    (when (or (not (cockpit-sent c))
              (and (cockpit-vehicle c) (not (equal? values (cockpit-sent c)))
                   (trying c (drive-as! c values) #t)))
      (set-sent! c values))))

(define (let-go! c)
  (set-sticks! c (new-sticks))
  (set-sent! c (stick-values (cockpit-sticks c)))
  (trying c
    (release! (cockpit-vehicle c))
    (announce! c "sticks centred, autopilots off")))

(define (winch! c metres)
  (trying c
    (if (positive? metres)
        (pay-out! (cockpit-tether c) metres)
        (haul-in! (cockpit-tether c) (- metres)))
    (announce! c (simple-format #f "~a ~a m" (if (positive? metres) "paying out" "hauling in")
                            (abs metres)))))

(define (toggle-pause! c)
  (if (cockpit-paused? c)
      (start-time! c)
      (trying c (stop-time! c))))

(define (go-back! c)
  (trying c
    (let ((t (rewind! (min 5.0 (now)))))
      (set-sticks! c (new-sticks))
      (set-sent! c (and (cockpit-vehicle c) (array->list (sticks (cockpit-vehicle c))))) ; as they stood then
      (ask-anew! c)
      (announce! c (simple-format #f "back at ~a s" (/ (round (* 100 t)) 100))))))

(define (visit-prompt! c)
  ;; The screen is the user's meanwhile; the dive goes on.
  (%terminal-leave!)
  ((from (bight shell repl) run-inner-prompt)
   (if (cockpit-paused? c)
       "The dive is paused.  ,q goes back to it."
       "The dive goes on.  ,q goes back to it."))
  (%terminal-enter!)
  (look-anew! c)
  (set-paused! c (and (cockpit-live? c) (not (%live? (engine-of (cockpit-dive c))))))
  (set-stepped! c (clock))
  (set-sent! c #f))

(define (hold! c what)
  (let ((v (cockpit-vehicle c)))
    (trying c
      (case what
        ((heading) (hold-heading! v (rov-heading v)))
        ((depth) (hold-depth! v (rov-depth v)))
        ((altitude) (hold-altitude! v (rov-altitude v)))
        (else (hold-position! v)))
      (announce! c (string-append "holding " (if (eq? what 'place) "this place" (symbol->string what)))))))

(define (hold-what-is-left! c)
  ;; A controller is lost, which was told: its vehicle stays where it is.
  (send-sticks! c)
  (trying c (hold-position! (cockpit-vehicle c))))

(define (do-act! c act)
  (case (car act)
    ((leave) (set-done! c #t))
    ((release) (let-go! c))
    ((winch) (winch! c (second act)))
    ((hold) (hold! c (second act)))
    ((lost) (hold-what-is-left! c))
    ((back) (go-back! c))
    ((pause) (toggle-pause! c))
    ((ghost) (toggle-ghost! c))
    ((prompt) (visit-prompt! c))
    (else (announce! c "that key is for lessons: bight lesson"))))

(define (do-key! c key)
  (cond ((stick-key! c key))
        ((view-key! c key))
        ((act-of-key key) => (lambda (act) (do-act! c act)))))

(define (take-keys! c seconds)
  (for-each (lambda (key) (trying c (do-key! c key))) (controller-keys! c))
  (let ((keys (keys-within seconds)))
    (if keys
        (for-each (lambda (key) (trying c (do-key! c key))) keys)
        (set-done! c 'hung-up))))


;;; An instructor.

(define (obey! c order)
  ;; Do ORDER, and return what came of it, a list of lines.
  (case (car order)
    ((words) (announce! c (string-append "Instructor: " (second order))) '())
    ((light) (set-dark! c (not (second order))) '())
    ((clock) (if (second order) (start-time! c) (stop-time! c)) '())
    ((form) (let ((value (eval (call-with-input-string (second order) read) (resolve-module '(guile-user)))))
              (if (unspecified? value) '() ((from (bight view looks) value->lines) value))))
    (else (do-to-dive! order) '())))

(define (attend-instructor! c)
  (trying c (publish! (cockpit-dive c) '()))
  (let ((order (next-order!)))
    (when order
      (answer-order!
       (with-exception-handler
           (lambda (e) (list ((from (bight core told) exception->line) e)))
         (lambda () (obey! c order))
         #:unwind? #t)))))


;;; The loop.

(define hint "w s a d i k j l sticks  v view  [ ] winch  p pause  ? keys  : prompt  q quit")

(define (fly-frames! c)
  (set-sent! c (stick-values (cockpit-sticks c)))
  (let loop ((due (clock)))
    (unless (cockpit-done? c)
      (pass-time-or-stop! c)
      (look-ahead! c)
      (attend-instructor! c)
      (draw-frame! c hint)
      (and=> (belief-alarm! c) (lambda (text) (announce! c text)))
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

(define-verb (pilot! #:key (view (one-of chase pilot top side overview sonar) 'chase)
                     (paint (one-of plain tension curvature model) 'plain)
                     (colors (or-false (one-of true many few none))))
  "Fly the dive live from the keyboard, all of the terminal its picture: ? there shows the keys, : is the
prompt, q leaves.  VIEW is chase, pilot, top, side, overview or sonar; PAINT colours the tether as `snapshot'
does; COLORS, when given, says what the terminal can: true, many (256), few (16) or none.  Return the time
at which it was left."
  (let ((dive (this-dive 'pilot!)))
    (check-not-running 'pilot! dive)
    (let ((c (new-cockpit (or colors (this-palette)) view paint)))
      (board! c dive)
      (fly! c)
      (when (eq? 'hung-up (cockpit-done? c))
        (bight-raise 'io 'pilot! "the terminal is gone"))
      (now))))

(define (pilot-world world options)
  "Start a dive in WORLD, a name or a file, and fly it, with OPTIONS of the command line, an alist."
  ((from (bight dive) enter!) world #:trust (assoc-ref options "--trust"))
  (believe-as-asked! options)
  (call-with-controllers (assoc-ref options "--controller") (assoc-ref options "--mapping")
    (lambda ()
      (call-with-desk (assoc-ref options "--instructor") (lambda () (fly-as-asked options))))))

(define (believe-as-asked! options)
  (let ((text (assoc-ref options "--belief")))
    (when text
      (current-belief (make-belief (current-dive) (clauses-from 'pilot! text)
                                   #:members (tethers-from 'pilot! (assoc-ref options "--tethers")))))))

(define (fly-as-asked options)
  (apply pilot!
         (append-map (lambda (entry)
                       (let ((text (assoc-ref options (first entry))))
                         (if text (list (second entry) (string->symbol text)) '())))
                     '(("--view" #:view) ("--paint" #:paint) ("--colors" #:colors)))))
