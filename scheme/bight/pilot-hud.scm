;;; (bight pilot-hud) --- what a pilot reads over the picture.
;;;
;;; A heading tape above; depth, speed and turns on the left; the tether on the right; sticks and words
;;; below; in the middle what to beware of.  Figures come from the queries a user has too; those that
;;; cost something are asked twice a second.  Everything is put through one procedure, so that a test can
;;; look at it without a terminal.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight pilot-hud)
  #:use-module ((bight aware) #:select (windings->strings))
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight foresight)
  #:use-module (bight query)
  #:use-module (bight record)
  #:use-module ((bight command) #:select (spooling?))
  #:use-module (srfi srfi-1)
  #:export (read-figures
            figures?
            slow-figures
            forecast
            heading-tape
            draw-hud
            draw-lines))


;;; Asking.  What a dive cannot tell is #f.

(define (call-or-false thunk)
  (with-exception-handler
      (lambda (e) (if (bight-error? e) #f (raise-exception e)))
    thunk
    #:unwind? #t))

(define-syntax-rule (answer expression)
  (call-or-false (lambda () expression)))

(define (ask name . arguments)
  ;; As `answer', for a query that the language may not have.
  (let ((variable (module-variable (resolve-interface '(bight)) name)))
    (and variable (answer (apply (variable-ref variable) arguments)))))

(define-record <figures>
  (make-figures heading depth speed altitude over turns out tension breaking spooling?)
  figures?
  (heading figures-heading)
  (depth figures-depth)
  (speed figures-speed)
  (altitude figures-altitude)
  (over figures-over)                   ; what the altitude is above, #f: the sea's depth
  (turns figures-turns)
  (out figures-out)
  (tension figures-tension)
  (breaking figures-breaking)
  (spooling? figures-spooling?))

(define (read-figures vehicle tether)
  "Return the figures of VEHICLE and TETHER, names or #f, that change with every frame."
  (make-figures (and vehicle (rov-heading vehicle))
                (and vehicle (rov-depth vehicle))
                (and vehicle (rov-speed vehicle))
                (and vehicle (answer (rov-altitude vehicle)))
                (and vehicle (answer (rov-over vehicle)))
                (and vehicle (net-turns vehicle))
                (and tether (tether-length tether))
                (and tether (answer (max-tension tether)))
                (and tether (assq-ref (tether-properties (subject-of tether)) 'breaking-load))
                (and tether (answer (spooling? tether)))))

(define (subject-of tether)
  (list-index (lambda (name) (eq? name tether)) (%names (this-engine 'pilot!) 'tether)))

(define most-named 3)

(define (windings tether)
  ;; What the tether is caught on, in words: up to three.
  (let ((wound (or (answer (windings->strings (subject-of tether))) '())))
    (take wound (min most-named (length wound)))))

(define (warnings vehicle tether)
  (define (when-true what . text) (and what (string-concatenate text)))
  (filter identity
          (append
           (if tether
               (list (when-true (ask 'parted? tether) "TETHER PARTED")
                     (when-true (answer (taut? tether)) "TAUT")
                     (when-true (ask 'stuck? tether) "STUCK")
                     (let ((why (ask 'foul-reason tether)))
                       (when-true (and why (ask 'fouled? tether))
                                  "FOULED: " (simple-format #f "~a" why)))
                     (when-true (not (answer (accurate? tether))) "SHAPE UNCERTAIN"))
               '())
           (if vehicle (list (when-true (answer (held? vehicle)) "HELD BACK")) '()))))

(define (slow-figures vehicle tether)
  "Return what costs something to ask, an alist: slack, windings, contacts, warnings."
  `((slack . ,(and tether (answer (slack tether))))
    (windings . ,(if tether (windings tether) '()))
    (contacts . ,(and tether (and=> (ask 'contacts tether) length)))
    (warnings . ,(warnings vehicle tether))))


;;; What is to come, by the string alone.

(define horizon 20)                     ; s
(define most-foretold 2)

(define (foretold f)
  (string-append
   (case (foresight-kind f)
     ((touch) (simple-format #f "string touches ~a" (foresight-object f)))
     ((turn) (simple-format #f "~a turns about ~a" (fixed (foresight-turns f) 1) (foresight-object f)))
     ((taut) "tether taut")
     (else (simple-format #f "vehicle meets ~a" (or (foresight-object f) "something"))))
   " in " (fixed (foresight-seconds f) 0) " s"))

(define (forecast tether)
  "Return what TETHER, a name or #f, will soon do if nobody touches the sticks, strings, soonest first: at
most two.  This takes milliseconds."
  (let ((all (or (and tether (answer (foresee tether horizon #:quick #t))) '())))
    (map foretold (take all (min most-foretold (length all))))))


;;; Words.

(define (fixed x places)
  (let* ((scale (expt 10 places))
         (n (inexact->exact (round (* (abs x) scale))))
         (whole (number->string (quotient n scale))))
    (string-append (if (and (negative? x) (positive? n)) "-" "") whole
                   (if (zero? places) "" ".")
                   (if (zero? places) ""
                       (string-pad (number->string (remainder n scale)) places #\0)))))

(define (figure x places unit)
  (if (and (real? x) (< (abs x) 1e9))
      (string-append (string-pad (fixed x places) 8) " " unit)
      (string-append (string-pad "-" 8) " " unit)))

(define (row title value)
  (string-pad-right (string-append " " (string-pad-right title 8) value) 22))

(define (bearing-name degrees)
  (or (assv-ref '((0 . "N") (45 . "NE") (90 . "E") (135 . "SE") (180 . "S") (225 . "SW") (270 . "W")
                  (315 . "NW"))
                degrees)
      (and (zero? (modulo degrees 30)) (string-pad (number->string degrees) 3 #\0))))

(define degrees-a-cell 3)

(define (heading-tape heading width)
  "Return the tape under the lubber line at HEADING degrees, a string of WIDTH characters."
  (let ((tape (make-string width #\space)) (middle (quotient width 2)))
    (define (place! text column)
      (for-each (lambda (c k)
                  (when (and (<= 0 k) (< k width)) (string-set! tape k c)))
                (string->list text) (iota (string-length text) column)))
    (define (mark! degrees)
      (let* ((away (- (floor-remainder (+ 180 (- degrees heading)) 360) 180))
             (column (+ middle (inexact->exact (round (/ away degrees-a-cell)))))
             (name (bearing-name degrees)))
        (when (<= (abs away) (+ 6 (* degrees-a-cell middle)))
          (if name
              (place! name (- column (quotient (string-length name) 2)))
              (place! "." column)))))
    (for-each mark! (filter (lambda (d) (not (bearing-name d))) (iota 36 0 10)))
    (for-each mark! (filter bearing-name (iota 72 0 5)))
    tape))

(define (bar share width)
  (let ((full (inexact->exact (round (* width (max 0 (min 1 share)))))))
    (string-append (make-string full #\#) (make-string (- width full) #\.))))

(define (tension-row f)
  (let ((tension (figures-tension f)) (most (figures-breaking f)))
    (row "" (if (and (real? tension) (real? most) (< 0 most +inf.0))
                (bar (sqrt (/ tension most)) 12) ; a root: small pulls are seen
                ""))))

(define (left-rows f)
  (list (row "depth" (figure (figures-depth f) 2 "m"))
        (row (if (figures-over f) "above" "no bed") (figure (figures-altitude f) 2 "m"))
        (row "speed" (figure (figures-speed f) 2 "m/s"))
        (row "turns" (figure (figures-turns f) 2 ""))))

(define (right-rows f slow)
  (append
   (list (row "out" (string-append (figure (figures-out f) 2 "m")
                                   (if (figures-spooling? f) " *" "")))
         (row "slack" (let ((s (assq-ref slow 'slack))) (figure (and s (* 100 s)) 1 "%")))
         (row "tension" (figure (figures-tension f) 1 "N"))
         (tension-row f))
   (let ((windings (assq-ref slow 'windings)))
     (if (null? windings)
         (list (row "wound" (string-pad "no" 8)))
         (map (lambda (text) (row "wound" (string-append "  " text))) windings)))))


;;; Drawing.

(define white #xe8f2f4)
(define pale #x9fc4cc)
(define yellow #xffd84a)
(define red #xb01818)
(define amber #xe0a820)

(define (draw-lines put column row lines ink paper)
  "Put LINES, strings, one below the other by PUT from COLUMN and ROW on."
  (for-each (lambda (line i) (put column (+ row i) line ink paper)) lines (iota (length lines))))

(define (centred put columns row text ink paper)
  (put (quotient (max 0 (- columns (string-length text))) 2) row text ink paper))

(define (stick-text name value)
  (string-append name " " (if (negative? value) "-" (if (zero? value) " " "+")) (fixed (abs value) 1)))

(define (sticks-line values)
  (string-join (map stick-text '("surge" "sway" "heave" "yaw") values) "  "))

(define (draw-tape put columns f)
  (when (figures-heading f)
    (let ((width (min 61 (- columns 44))))
      (when (> width 8)
        (centred put columns 0 (heading-tape (figures-heading f) width) white #f))
      (centred put columns 1
               (string-append "^ " (string-pad (fixed (floor (figures-heading f)) 0) 3 #\0) " ^")
               yellow #f))))

(define (draw-warnings put columns now ahead)
  ;; What is, and below it what is to come.
  (for-each (lambda (text ink paper i)
              (centred put columns (+ 3 i) (string-append "  " text "  ") ink paper))
            (append now ahead)
            (append (map (const #xffffff) now) (map (const #x201800) ahead))
            (append (map (const red) now) (map (const amber) ahead))
            (iota (+ (length now) (length ahead)))))

(define (draw-hud put columns rows f slow state)
  "Draw the display of the figures F and SLOW on a screen of COLUMNS and ROWS by PUT, a procedure of a
column, a row, a string, its colour and that behind it (#f: dimmed).  STATE is an alist of strings: title,
right, message; of sticks, a list; and of ahead, a list of strings."
  (let ((left (left-rows f)) (right (right-rows f slow)))
    (put 0 0 (string-append " " (assq-ref state 'title) " ") white #f)
    (let ((text (string-append " " (assq-ref state 'right) " ")))
      (put (max 0 (- columns (string-length text))) 0 text pale #f))
    (draw-tape put columns f)
    (draw-warnings put columns (assq-ref slow 'warnings) (or (assq-ref state 'ahead) '()))
    (when (and (> rows 12) (>= columns 46))
      (draw-lines put 0 (- rows 3 (length left)) left white #f)
      (draw-lines put (- columns 22) (- rows 3 (length right)) right white #f))
    (centred put columns (- rows 2) (sticks-line (assq-ref state 'sticks)) white #f)
    (put 0 (- rows 1)
         (string-pad-right (string-append " " (assq-ref state 'message)) columns)
         (if (assq-ref state 'urgent?) yellow pale) #f)))
