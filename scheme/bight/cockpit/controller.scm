;;; (bight cockpit controller) --- game controllers and joysticks: what stands where, and which keys they press.
;;;
;;; Events come from what is plugged in, by (bight cockpit sdl), or from a recorded stream; an event is
;;;
;;;   (plugged ID NAME KNOWN)   KNOWN: its axes and buttons have the names of SDL's database
;;;   (lost ID)
;;;   (axis ID CONTROL VALUE)   -1 to 1
;;;   (button ID CONTROL DOWN)
;;;
;;; Several controllers fly together: what their axes ask of a stick adds up.  A stream is a file of (bight-events 1)
;;; and lists of seconds and an event.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit controller)
  #:use-module (bight cockpit mapping)
  #:use-module (bight core datum)
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (open-controllers read-stream check-asked poll-events! note-event! controller-sticks controller-names
            controllers-mapping controllers? device? current-controllers call-with-controllers))

(define-record <controllers>
  (make-controllers next mapping devices)
  controllers?
  (next controllers-next)               ; a procedure of the clock: an event that has happened, or #f
  (mapping controllers-mapping)
  (devices controllers-devices set-devices!))

(define-record <device>
  (make-device id name bindings values)
  device?
  (id device-id)
  (name device-name)
  (bindings device-bindings)
  (values device-values set-values!))   ; an alist from controls to numbers

;; The controllers that a cockpit is flown by, or #f.
(define current-controllers (make-parameter #f))

(define (bad-stream text . values)
  (apply bight-raise 'format 'controller text values))


;;; Streams.

(define (event? event)
  (and (list? event) (pair? event)
       (let ((id? (lambda () (exact-integer? (second event)))))
         (case (length event)
           ((2) (and (eq? 'lost (first event)) (id?)))
           ((4) (and (id?) (string? (third event))
                     (case (first event)
                       ((plugged button) (boolean? (fourth event)))
                       ((axis) (and (real? (fourth event)) (<= -1 (fourth event) 1)))
                       (else #f))))
           (else #f)))))

(define (read-stream file)
  "Return the events of FILE, a list of seconds and event, or raise a &bight-error that says what is wrong with it."
  (let ((forms (read-forms 'controller file '(bight-events 1) "stream of a controller")))
    (fold (lambda (form last)
            (unless (and (pair? form) (real? (car form)) (<= last (car form)) (event? (cdr form)))
              (bad-stream "in ~a stand seconds, none before those above, and an event, as in (1.5 axis 0 \"lefty\" -0.5), \
not ~s" file form))
            (car form))
          0 forms)
    forms))

(define (stream-source events)
  ;; A procedure of the clock that returns each of EVENTS when its time, from the first call on, has come.
  (let ((begun #f))
    (lambda (now)
      (unless begun (set! begun now))
      (and (pair? events) (>= (- now begun) (caar events))
           (let ((event (cdar events)))
             (set! events (cdr events))
             event)))))

(define (sdl-source)
  (let ((interface (false-if-exception (resolve-interface '(bight cockpit sdl)))))
    (unless interface
      (bight-raise 'unsupported 'controller "this bight was built without SDL (Debian package: libsdl2-dev), which reads \
controllers; the file of a recorded stream can be flown"))
    (let ((all ((module-ref interface '%open-controllers))) (next (module-ref interface '%controller-event)))
      (lambda (now) (next all)))))

(define (check-asked what)
  "Raise a &bight-error unless WHAT is `any' or the name of a file that is there."
  (unless (or (equal? what "any") (file-exists? what))
    (bight-raise 'io 'controller "--controller is any, what is plugged in, or the file of a stream, and there is no file ~s~a"
                 what (file-meant what))))

(define (open-controllers what mapping)
  "Return the controllers that WHAT says: `any' for all that are or will be plugged in, or the file of a stream.  MAPPING
is a file, or #f for the usual one."
  (check-asked what)
  (make-controllers (if (equal? what "any") (sdl-source) (stream-source (read-stream what)))
                    (if mapping (read-mapping mapping) '())
                    '()))

(define (call-with-controllers what mapping thunk)
  "Call THUNK while cockpits are flown by the controllers that `open-controllers' returns for WHAT and MAPPING; with WHAT
#f by none."
  (parameterize ((current-controllers (and what (open-controllers what mapping))))
    (thunk)))


;;; What an event does.

(define (device-called all id)
  (find (lambda (d) (eqv? id (device-id d))) (controllers-devices all)))

(define (value-of device control)
  (or (assoc-ref (device-values device) control) 0))

(define (pressed-keys device control before now)
  ;; The keys that CONTROL presses by passing its half.
  (filter-map (lambda (b)
                (and (binding-key b) (string=? control (binding-control b))
                     (<= before (binding-dead b)) (> now (binding-dead b))
                     (binding-key b)))
              (device-bindings device)))

(define (move-control! device control value)
  (let ((before (value-of device control)))
    (set-values! device (acons control value (alist-delete control (device-values device))))
    (pressed-keys device control before value)))

(define (note-event! all event)
  "Let ALL know of EVENT.  Return what comes of it: a list of keys, of (plugged NAME) and of (lost NAME)."
  (let ((device (device-called all (second event))))
    (case (first event)
      ((plugged)
       (set-devices! all (cons (make-device (second event) (third event)
                                            (bindings-for (controllers-mapping all) (third event) (fourth event)) '())
                               (controllers-devices all)))
       (list (list 'plugged (third event))))
      ((lost)
       (set-devices! all (delq device (controllers-devices all)))
       (if device (list (list 'lost (device-name device))) '()))
      ((axis) (if device (move-control! device (third event) (fourth event)) '()))
      (else (if device (move-control! device (third event) (if (fourth event) 1 0)) '())))))

(define (poll-events! all now)
  "Return the events that have happened until NOW, s of the clock."
  (let loop ((events '()))
    (let ((event ((controllers-next all) now)))
      (if event (loop (cons event events)) (reverse events)))))


;;; Where the sticks stand.

(define (asked-of device stick)
  (fold (lambda (b sum)
          (if (eqv? stick (binding-stick b))
              (+ sum (* (binding-scale b) (without-dead-zone (value-of device (binding-control b)) (binding-dead b))))
              sum))
        0 (device-bindings device)))

(define fineness 50)                    ; steps of a stick: a hand that shakes fills no journal

(define (controller-sticks all)
  "Return where the controllers ALL want the sticks: surge sway heave yaw, each -1 to 1."
  (map (lambda (stick)
         (let ((sum (fold (lambda (device sum) (+ sum (asked-of device stick))) 0 (controllers-devices all))))
           (exact->inexact (/ (round (* fineness (max -1 (min 1 sum)))) fineness))))
       (iota (length stick-names))))

(define (controller-names all)
  "Return the names of the controllers that are plugged in, the last first."
  (map device-name (controllers-devices all)))
