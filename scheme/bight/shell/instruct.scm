;;; (bight shell instruct) --- an instructor's station: what a pupil's dive looks like now, and orders handed in.
;;;
;;; The pupil's process listens with the rules of (bight shell listen) and speaks as (bight shell door) does.  The
;;; station subscribes to what (bight cockpit orders) publishes there, brings a dive of its own into that state, and
;;; shows it in a cockpit; keys become orders.  Without a terminal the orders come as forms on standard input, between
;;; which (wait SECONDS) waits, (until TIME) waits for that second of the pupil's dive, and (see) prints what he reads.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell instruct)
  #:use-module (bight cockpit)
  #:use-module ((bight cockpit view-keys) #:select (view-key!))
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit desk)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keyboard)
  #:use-module ((bight cockpit keys) #:select (keys-told view-keys-told))
  #:use-module (bight cockpit line)
  #:use-module (bight cockpit palette)
  #:use-module (bight cockpit state)
  #:use-module (bight core datum)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module ((bight dive story) #:select (begin-story read-story restore-line!))
  #:use-module (bight engine)
  #:use-module ((bight outlet) #:select (watched?))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (instruct typed->order station?))


;;; Talking to the pupil's process.

(define (connect-to socket-file)
  (catch 'system-error
    (lambda ()
      (let ((port (socket PF_UNIX SOCK_STREAM 0)))
        (connect port AF_UNIX socket-file)
        (set-port-encoding! port "UTF-8")
        (setvbuf port 'block 1048576)
        port))
    (lambda arguments
      (bight-raise 'io 'instruct "no pupil listens at ~s: ~a" socket-file
                   (strerror (system-error-errno arguments))))))

(define (pupil-left)
  (bight-raise 'io 'instruct "the pupil has left"))

(define (send! port form)
  (catch 'system-error
    (lambda ()
      (write form port)
      (newline port)
      (force-output port))
    (lambda arguments (pupil-left))))

(define (next-datum port)
  (let ((line (catch 'system-error (lambda () (read-line port)) (lambda arguments (pupil-left)))))
    (if (eof-object? line) (pupil-left) (text->datum line))))

(define (at-the-pupils name . arguments)
  ;; The form that calls NAME of (bight cockpit orders) there.
  `((@ (bight cockpit orders) ,name) ,@(map (lambda (a) (list 'quote a)) arguments)))

(define (dive-of text)
  ;; A dive in the world that TEXT, what `beginning' returned, tells of.
  (let* ((port (mkstemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-instruct-XXXXXX")))
         (file (port-filename port)))
    (set-port-encoding! port "UTF-8")
    (dynamic-wind
      (const #t)
      (lambda ()
        (display text port)
        (close-port port)
        (begin-story 'instruct file (read-story 'instruct file 'bight-recording)))
      (lambda () (delete-file file)))))


;;; A script.

(define (ask port form)
  ;; What FORM returns there.
  (send! port form)
  (let loop ()
    (let ((datum (next-datum port)))
      (case (car datum)
        ((ok) (if (null? (cdr datum)) '() (second datum)))
        ((error) (bight-raise 'domain 'instruct "~a" (third datum)))
        (else (loop))))))

(define (seen-by port)
  ;; What the pupil's loop publishes, once there is some.
  (let loop ()
    (let ((seen (ask port (at-the-pupils 'seen))))
      (if (null? seen)
          (begin (usleep 100000) (loop))
          seen))))

(define (print . parts)
  (for-each display parts)
  (newline)
  (force-output))

(define (wait-until port time)
  ;; Wait for the second TIME of the pupil's dive.
  (when (< (second (seen-by port)) time)
    (usleep 50000)
    (wait-until port time)))

(define (print-seen seen)
  (print "at " (/ (round (* 10 (second seen))) 10) " s")
  (for-each (lambda (words) (print "  " words)) (third seen)))

(define (seconds-in line)
  (if (and (= 2 (length line)) (real? (second line)) (finite? (second line)) (>= (second line) 0))
      (second line)
      (bight-raise 'domain 'instruct "say (~a SECONDS), not ~s" (car line) line)))

(define (do-line port line)
  (case (and (pair? line) (list? line) (car line))
    ((wait) (usleep (inexact->exact (round (* 1e6 (seconds-in line))))))
    ((until) (wait-until port (seconds-in line)))
    ((see) (print-seen (seen-by port)))
    (else
     (let ((answer (ask port (at-the-pupils 'hand-in! line))))
       (if (pair? answer) (for-each print answer) (print answer))))))

(define (do-script port)
  (let loop ()
    (let ((line (read)))
      (unless (eof-object? line)
        (do-line port line)
        (loop))))
  0)


;;; A station at a terminal.

(define-record <station>
  (make-station port cockpit serial typing light clock words)
  station?
  (port station-port)
  (cockpit station-cockpit)
  (serial station-serial set-serial!)   ; of the dive that is shown, or is asked for
  (typing station-typing set-typing!)   ; (KIND . LINE) while something is typed, or #f
  (light station-light set-light!)
  (clock station-clock set-clock!)
  (words station-words set-words!))     ; what the pupil reads

(define hint "w words  c current  d drift  b break  m mend  l light  t clock  : form  ? keys  q leave")

(define station-keys
  `(("w" . "words to the pupil")
    ("c" . "the current: m/s, and the degrees it sets to")
    ("d" . "an obstacle with a track adrift")
    ("b m" . "break a sensor or a thruster; mend it")
    ("l" . "take the light, give it")
    ("t" . "stop the pupil's clock, let it run")
    (":" . "a form of the language, done in his dive")
    ,@view-keys-told
    ("? q" . "this; leave")))

(define labels
  '((words . "to the pupil> ") (current . "current, m/s and the degrees it sets to> ")
    (drift . "adrift: an obstacle, m/s and the degrees it drifts to> ")
    (fault . "break (compass 2, depth, telemetry, thruster 1 ...)> ") (mend . "mend> ") (form . "form> ")))

(define (typed->order kind text)
  "Return the order that TEXT, what was typed for an order of KIND, gives, or #f for none: it is checked where it is done."
  (let ((words (string-tokenize text)))
    (cond ((null? words) #f)
          ((memq kind '(words form)) (list kind text))
          (else (cons kind (map (lambda (word) (or (text->number word) (string->symbol word))) words))))))

(define (hand-in! s order)
  (send! (station-port s) (at-the-pupils 'hand-in! order)))

(define (see! s seen)
  ;; SEEN is what the pupil's loop published: (SERIAL TIME WORDS STATE), or nothing yet.
  (unless (null? seen)
    (let ((dive (cockpit-dive (station-cockpit s))))
      (set-words! s (third seen))
      (cond ((not (eqv? (first seen) (station-serial s)))
             (set-serial! s (first seen))
             (send! (station-port s) (at-the-pupils 'beginning)))
            (dive (restore-line! 'instruct (engine-of dive) (fourth seen)))))))

(define (show-dive! s dive)
  (current-dive dive)
  (board! (station-cockpit s) dive))

(define (hear-answer! s value)
  ;; VALUE answers an order, the question for a dive, or a subscription.
  (let ((c (station-cockpit s)))
    (cond ((eq? 'done value) (announce! c "done"))
          ((eq? 'waiting value) (announce! c "the pupil reads a page: it is done when he flies"))
          ((not (pair? value)) #t)
          ((number? (car value)) (show-dive! s (dive-of (second value))))
          (else (announce! c (string-join value " "))))))

(define (hear! s datum)
  ;; DATUM came from the pupil's process.
  (case (car datum)
    ((event) (see! s (third datum)))
    ((ok) (when (pair? (cdr datum)) (hear-answer! s (second datum))))
    ((error) (announce! (station-cockpit s) (third datum)))
    ((ended) (bight-raise 'io 'instruct "~a" (fourth datum)))))

(define (hear-all! s)
  (when (char-ready? (station-port s))
    (hear! s (next-datum (station-port s)))
    (hear-all! s)))

(define (type-key! s key)
  (let* ((kind (car (station-typing s))) (line (edit-line (cdr (station-typing s)) key)))
    (set-typing! s (and (not (line-done? line)) (not (line-left? line)) (cons kind line)))
    (when (line-done? line)
      (let ((order (typed->order kind (line-text line))))
        (when order (hand-in! s order))))))

(define (do-key! s key)
  (define (type! kind) (set-typing! s (cons kind (empty-line))))
  (case key
    ((#\w) (type! 'words))
    ((#\c) (type! 'current))
    ((#\d) (type! 'drift))
    ((#\b) (type! 'fault))
    ((#\m) (type! 'mend))
    ((#\:) (type! 'form))
    ((#\l) (set-light! s (not (station-light s))) (hand-in! s (list 'light (station-light s))))
    ((#\t) (set-clock! s (not (station-clock s))) (hand-in! s (list 'clock (station-clock s))))
    ((#\q #\etx) (set-done! (station-cockpit s) #t))
    (else (view-key! (station-cockpit s) key))))

(define (take-keys! s until)
  (let* ((c (station-cockpit s)) (keys (keys-within (max 0.001 (- until (clock))))))
    (if keys
        (for-each (lambda (key) (if (station-typing s) (type-key! s key) (do-key! s key))) keys)
        (set-done! c 'hung-up))
    (when (and (not (cockpit-done? c)) (< (clock) until))
      (take-keys! s until))))

(define (station-panel words)
  ;; A panel with what the pupil reads.
  (lambda (put columns rows)
    (fold (lambda (text row)
            (put 0 row (string-pad-right (cut (string-append " " text) columns) columns) white #x102028)
            (+ row 1))
          2 (list-head words (min (length words) (max 1 (quotient rows 5)))))))

(define (draw! s)
  (let* ((c (station-cockpit s)) (typing (station-typing s))
         (last-line (if typing
                        (prompt-shown (assq-ref labels (car typing)) (cdr typing) (car (%screen-size)))
                        hint)))
    (set-panel! c (station-panel (station-words s)))
    (if (cockpit-dive c)
        (parameterize ((keys-told station-keys)) (draw-frame! c last-line #:typing? typing))
        (draw-page! c '("Waiting for the pupil to fly.") last-line))))

(define (sit! port)
  ;; Be the instructor until he leaves.
  (let* ((c (new-cockpit (this-palette) 'overview 'plain)) (s (make-station port c 0 #f #t #t '())))
    (send! port (list 'subscribe 10 (at-the-pupils 'seen)))
    (dynamic-wind
      %terminal-enter!
      (lambda ()
        (let loop ()
          (unless (cockpit-done? c)
            (let ((until (+ (clock) frame)))
              (hear-all! s)
              (draw! s)
              (take-keys! s until)
              (loop)))))
      %terminal-leave!)
    0))

(define (instruct socket)
  "Be the instructor of the pupil who listens at SOCKET, in the terminal, or by what standard input says.  Return the exit
status."
  (let ((port (connect-to socket)))
    (if (and (isatty? (current-input-port)) (watched? (current-output-port)))
        (sit! port)
        (do-script port))))
