;;; What pupils and their instructor see, driven by keys in terminals of tmux and taken from these: lessons from start to
;;; marks with all colours, 256 and sixteen, an instructor beside his pupil, a recorded controller, a recording that is watched.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core programs)
             (ice-9 popen)
             (ice-9 regex)
             (ice-9 textual-ports))

(load "cells.scm")

(unless (program? "tmux")
  (error "there is no tmux here"))

(define folder (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-show-XXXXXX")))
(define (in-folder name) (string-append folder "/" name))


;;; A terminal.

(define (tmux . arguments)
  (let* ((port (apply open-pipe* OPEN_READ "tmux" "-S" (in-folder "tmux") "-f" "/dev/null" arguments)) (text (get-string-all port)))
    (close-pipe port)
    text))

(define (open-terminal! columns rows . settings)
  "Begin a shell of COLUMNS by ROWS with SETTINGS, texts such as \"TERM=screen\", of its environment."
  (tmux "new-session" "-d" "-x" (number->string columns) "-y" (number->string rows)
        (string-join `("exec env PS1='$ '" ,(string-append "XDG_STATE_HOME=" folder)
                       ,(string-append "BIGHT_LOGBOOK=" (in-folder "logbook.db")) "BIGHT_TRAINEE=ann" ,@settings "sh")))
  (see "^\\$ *$"))

(define (close-terminal!) (tmux "kill-server"))

(define (leave!)
  (close-terminal!)
  (system* "rm" "-r" folder))

(define pane (make-parameter "0"))

(define (screen) (tmux "capture-pane" "-p" "-t" (pane)))

(define patience 120)                   ; s

(define (see pattern)
  "Wait until the terminal shows the regular expression PATTERN."
  (let ((wanted (make-regexp pattern regexp/newline)) (end (+ patience (current-time))))
    (let loop ()
      (unless (regexp-exec wanted (screen))
        (when (> (current-time) end)
          (let ((shown (screen)))
            (leave!)
            (error "not seen:" pattern shown)))
        (usleep 100000)
        (loop)))))

(define (press . keys) (apply tmux "send-keys" "-t" (pane) keys))

(define (type text)
  (press "-l" "--" text)
  (press "Enter"))

(define (cells-now columns rows)
  (text->cells (tmux "capture-pane" "-p" "-e" "-N" "-t" (pane)) columns rows))

(define (picture! name columns rows)
  (draw-cells (cells-now columns rows) (string-append name ".png")))

(define (answer text)
  (see "^ (a bearing, degrees|left, right)> _")
  (type text))


;;; The first lesson, from start to marks, with all colours.

(open-terminal! 120 40 "COLORTERM=truecolor" "LC_ALL=C.UTF-8")
(type "bight lesson 1")
(see "You are the pilot of")
(press "Enter")
(see "bears 180 from you")
(press "Enter")
(see "a bearing, degrees> _")
(press "-l" "211")
(see "> 211_")
(picture! "fig-show-question" 120 40)
(press "Enter")
(answer "right")
(see "So it was")
(press "Enter")
(answer "215")
(see "it was 21.; asked")
(press "Enter")
(answer "300")
(answer "left")
(see "So it was, with the anchor")
(press "Enter")
(answer "98")
(see "So it was")
(press "Enter")
(see "Last, use it")
(press "Enter")
(see "TASK")
(press "Enter")
(see "^ e hint")
(press "W" "W" "W" "W" "W" "e")
(see "surge \\+0\\.5")
(see "speed +0\\.[2-9]")
(picture! "fig-show-flight" 120 40)
(press ":")
(see "bight> _")
(type "(let on () (fly-to! (point-at (/ (tether-length) 2)) #:speed 0.8) (run 1) (on))")
(see "Done\\.")
(press "Enter")
(see "Marks were lost here")
(picture! "fig-show-marks" 120 40)
(press "Enter")
(see "out of 100, passed")
(close-terminal!)


;;; A later lesson in a small terminal: 256 colours, sixteen, and letters that are all ASCII.

(define (small! name . settings)
  (apply open-terminal! 80 24 settings)
  (type "bight lesson 16")
  (let loop ()
    (see "^ Enter (goes on|begins)|> _")
    (unless (regexp-exec (make-regexp "^ Enter begins" regexp/newline) (screen))
      (if (string-contains (screen) "> _") (type "over") (press "Enter"))
      (usleep 300000)
      (loop)))
  (press "Enter")
  (see "^ e hint")
  (press "W" "W" "W" "W" "W")
  (see "surge \\+0\\.5")
  (picture! name 80 24)
  (close-terminal!))

(small! "fig-show-256" "COLORTERM=" "TERM=screen-256color" "LC_ALL=C.UTF-8")
(small! "fig-show-16" "COLORTERM=" "TERM=screen" "LC_ALL=C.UTF-8")
(small! "fig-show-ascii" "COLORTERM=" "TERM=screen" "LC_ALL=C")


;;; A controller's stream, flown beside the keys.

(call-with-output-file (in-folder "events")
  (lambda (port)
    (for-each (lambda (event) (write event port) (newline port))
              '((bight-events 1)
                (0 plugged 0 "Pad" #t)
                (0.5 axis 0 "righty" -0.6)
                (3 axis 0 "leftx" 0.35)))))

(open-terminal! 100 30 "COLORTERM=truecolor" "LC_ALL=C.UTF-8")
(type (string-append "bight pilot jacket --controller " (in-folder "events")))
(see "pads 1 .*(.|\n)*yaw \\+0\\.[1-9]")
(see " speed +0\\.[2-9]")
(picture! "fig-show-pad" 100 30)
(press "q")
(see "^\\$ *$")
(close-terminal!)


;;; A recording, gone through beside another.

(define (record-dive! file speed)
  (enter! 'jacket)
  (record! file)
  (fly-to! '(4 -4 -9) #:speed speed)
  (run 24)
  (stop-recording!))

(record-dive! (in-folder "one.bight") 0.5)
(record-dive! (in-folder "other.bight") 0.3)
(open-terminal! 100 30 "COLORTERM=truecolor" "LC_ALL=C.UTF-8")
(type (simple-format #f "bight watch ~a --ghost ~a" (in-folder "one.bight") (in-folder "other.bight")))
(see "^ 0:0")
(press "Space")
(see "PAUSED")
(press "]" "]")
(see "^ 0:2")
(press "Left" "5" "t")
(see "^ 0:1")
(picture! "fig-show-watch" 100 30)
(press "q")
(see "^\\$ *$")
(close-terminal!)


;;; An instructor, and his pupil beside him.

(define door (in-folder "door"))

(open-terminal! 181 36 "COLORTERM=truecolor" "LC_ALL=C.UTF-8")
(tmux "split-window" "-h" "-l" "90" "exec env PS1='$ ' COLORTERM=truecolor LC_ALL=C.UTF-8 sh")

(define-syntax-rule (at-station body ...)
  (parameterize ((pane "1")) body ...))

(type (string-append "bight lesson 5 --instructor " door))
(let loop ()
  (see "^ Enter (goes on|begins)")
  (unless (regexp-exec (make-regexp "^ Enter begins" regexp/newline) (screen))
    (press "Enter")
    (usleep 300000)
    (loop)))
(press "Enter")
(see "^ e hint")
(press "W" "W" "W" "W" "W")
(at-station
 (see "^\\$ *$")
 (type (string-append "bight instruct " door))
 (see "w words")
 (see "Fly to the far side")
 (press "c")
 (see "current, m/s")
 (type "0.4 90")
 (see "done")
 (press "w")
 (see "to the pupil> _")
 (type "The tide is making: give yourself more room."))
(see "Instructor: The tide is making")
(at-station
 (press "b")
 (see "break ")
 (press "-l" "compass 2"))
(at-station (see "compass 2_"))
(draw-cells (beside (cells-now 90 36) (at-station (cells-now 90 36))) "fig-show-instructor.png")
(leave!)
