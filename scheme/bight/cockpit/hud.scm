;;; (bight cockpit hud) --- what a pilot reads over the picture.
;;;
;;; A heading tape above; depth, speed and turns on the left; the tether on the right; sticks and words
;;; below; in the middle what to beware of.  Figures come from the queries a user has too; those that
;;; cost something are asked twice a second.  Everything is put through one procedure, so that a test can
;;; look at it without a terminal.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit hud)
  #:use-module (bight cockpit desk)
  #:use-module (bight core decimal)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (windings->strings))
  #:use-module ((bight dive command) #:select (spooling?))
  #:use-module (bight dive foresight)
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (read-figures
            figures?
            slow-figures
            forecast
            unseen?
            heading-tape
            draw-hud
            white pale yellow red amber green))


;;; Asking.  What a dive cannot tell is #f.

(define (call-or-false thunk)
  (with-exception-handler
      (lambda (e) (if (bight-error? e) #f (raise-exception e)))
    thunk
    #:unwind? #t))

(define-syntax-rule (answer expression)
  (call-or-false (lambda () expression)))

;; Of a verb: does the pilot not see what it tells?  So it is in some lessons.
(define unseen? (make-parameter (const #f)))

(define-syntax-rule (seen verb expression)
  (and (not ((unseen?) 'verb)) (answer expression)))

(define (ask name . arguments)
  ;; As `seen', for a query that the language may not have.
  (let ((variable (module-variable (resolve-interface '(bight)) name)))
    (and variable (not ((unseen?) name)) (answer (apply (variable-ref variable) arguments)))))

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
                (and tether (seen tether-length (tether-length tether)))
                (and tether (seen tensions (seen rov-tension (max-tension tether))))
                (and tether (assq-ref (tether-properties (subject-of tether)) 'breaking-load))
                (and tether (answer (spooling? tether)))))

(define (subject-of tether)
  (list-index (lambda (name) (eq? name tether)) (%names (this-engine 'pilot!) 'tether)))

(define most-named 3)

(define (windings tether)
  ;; What the tether is caught on, in words: up to three; #f if the pilot does not see that.
  (let ((wound (seen windings (seen status (windings->strings (subject-of tether))))))
    (and wound (take wound (min most-named (length wound))))))

(define (warnings vehicle tether)
  (define (when-true what . text) (and what (string-concatenate text)))
  (filter identity
          (append
           (if tether
               (list (when-true (ask 'parted? tether) "TETHER PARTED")
                     (when-true (seen taut? (taut? tether)) "TAUT")
                     (when-true (ask 'stuck? tether) "STUCK")
                     (let ((why (ask 'foul-reason tether)))
                       (when-true (and why (ask 'fouled? tether))
                                  "FOULED: " (simple-format #f "~a" why)))
                     (when-true (not (answer (accurate? tether))) "SHAPE UNCERTAIN"))
               '())
           (if vehicle (list (when-true (answer (held? vehicle)) "HELD BACK")) '()))))

(define (slow-figures vehicle tether)
  "Return what costs something to ask, an alist: slack, windings, contacts, warnings."
  `((slack . ,(and tether (seen slack (slack tether))))
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
  (let ((all (or (and tether (seen foresee (foresee tether horizon #:quick #t))) '())))
    (map foretold (take all (min most-foretold (length all))))))


;;; Words.

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
     (if (pair? windings)
         (map (lambda (text) (row "wound" (string-append "  " text))) windings)
         (list (row "wound" (string-pad (if windings "no" "-") 8)))))))


;;; Drawing.

(define white #xe8f2f4)
(define pale #x9fc4cc)
(define yellow #xffd84a)
(define red #xb01818)
(define amber #xe0a820)
(define green #x60e080)

(define (stick-text name value)
  (string-append name " " (if (zero? value) " 0.0" (fixed-with-sign value 1))))

(define (sticks-line values)
  (string-join (map stick-text '("surge" "sway" "heave" "yaw") values) "  "))

(define (short-sticks values)
  (string-join (map (lambda (name value) (string-append name (fixed-with-sign value 1)))
                    '("s" "w" "h" "y") values)))

(define least-tape 9)

(define (draw-tape put columns f left right)
  ;; Between what stands LEFT and RIGHT on the first row.
  (when (figures-heading f)
    (let ((width (min 61 (- columns (* 2 (max left right)) 2))))
      (when (>= width least-tape)
        (put-centred put columns 0 (heading-tape (figures-heading f) width) white #f))
      (put-centred put columns 1
                   (string-append "^ " (string-pad (fixed (floor (figures-heading f)) 0) 3 #\0) " ^")
                   yellow #f))))

(define (draw-warnings put columns row now ahead)
  ;; What is, and below it what is to come, from ROW on: in the middle, or, where something stands there, such as the
  ;; map, at the left.
  (for-each (lambda (text ink paper i)
              (let ((text (string-append "  " text "  ")))
                (or (put-centred put columns (+ row i) text ink paper)
                    (put 0 (+ row i) (cut text columns) ink paper))))
            (append now ahead)
            (append (map (const #xffffff) now) (map (const #x201800) ahead))
            (append (map (const red) now) (map (const amber) ahead))
            (iota (+ (length now) (length ahead)))))

(define (short name value places unit)
  (string-append name " " (if (and (real? value) (< (abs value) 1e9)) (fixed value places) "-") unit))

(define (short-figures f slow)
  ;; The figures as words, the most wanted first.
  (let ((s (assq-ref slow 'slack)))
    (append (list (short "depth" (figures-depth f) 1 "m") (short "out" (figures-out f) 1 "m")
                  (short "slack" (and s (* 100 s)) 0 "%") (short "turns" (figures-turns f) 1 "")
                  (short "tension" (figures-tension f) 0 "N") (short "speed" (figures-speed f) 1 "m/s")
                  (short "altitude" (figures-altitude f) 1 "m"))
            (or (assq-ref slow 'windings) '()))))

(define (flowed words columns)
  ;; WORDS, strings, on lines of COLUMNS with two blanks between them.
  (let loop ((words words) (line "") (lines '()))
    (cond ((null? words) (reverse (if (string-null? line) lines (cons line lines))))
          ((string-null? line) (loop (cdr words) (cut (string-append " " (car words)) columns) lines))
          ((<= (+ (string-length line) 2 (string-length (car words))) columns)
           (loop (cdr words) (string-append line "  " (car words)) lines))
          (else (loop words "" (cons line lines))))))

(define most-short-rows 3)

(define (draw-short put columns rows top f slow)
  ;; On a small screen the figures stand in a line or two above the sticks.
  (let* ((room (max 1 (min most-short-rows (quotient (- rows 4 top) 2))))
         (lines (flowed (short-figures f slow) columns))
         (lines (if (> (length lines) room) (take lines room) lines)))
    (put-lines put 0 (- rows 2 (length lines)) lines white #f)
    (- rows 2 (length lines))))

(define block-width 22)

(define (draw-blocks put columns rows left right)
  (put-lines put 0 (- rows 3 (length left)) left white #f)
  (put-lines put (- columns block-width) (- rows 3 (length right)) right white #f)
  (- rows 3))

(define (draw-words put columns row words top blocks?)
  ;; The answers in words, above ROW and below TOP, between the blocks if there are.
  (let* ((width (- columns (if blocks? (* 2 (+ block-width 1)) 2)))
         (lines (if (and words (>= width 24)) (wrap words width) '())))
    (when (and (pair? lines) (> (- row (length lines)) (+ top 3)))
      (put-lines put (quotient (- columns width) 2) (- row (length lines)) lines pale #f))))

(define (draw-hud put columns rows f slow state)
  "Draw the display of the figures F and SLOW on a screen of COLUMNS and ROWS by PUT, such as that of a desk: a
procedure of a column, a row, a string, its colour and that behind it (#f: dimmed).  STATE is an alist of strings:
title, right, message, and words or #f; of sticks, a list; of ahead, a list of strings; and of top, the row that what
is drawn above the display ends at."
  (let* ((title (cut (string-append " " (assq-ref state 'title) " ") columns))
         (right (string-append " " (assq-ref state 'right) " "))
         (top (or (assq-ref state 'top) 2))
         (left-block (left-rows f)) (right-block (right-rows f slow))
         (blocks? (and (> (- rows 3 (max (length left-block) (length right-block))) (+ top 3)) (>= columns 46)))
         (sticks (assq-ref state 'sticks))
         (sticks-text (sticks-line sticks)))
    (put 0 (- rows 1)
         (string-pad-right (cut (string-append " " (assq-ref state 'message)) columns) columns)
         (if (assq-ref state 'urgent?) yellow pale) #f)
    (put 0 0 title white #f)
    (put-right put columns 0 right pale #f)
    (put-centred put columns (- rows 2)
                 (if (<= (string-length sticks-text) columns) sticks-text (short-sticks sticks)) white #f)
    (let ((row (if blocks?
                   (draw-blocks put columns rows left-block right-block)
                   (draw-short put columns rows top f slow))))
      (draw-warnings put columns (+ top 1) (assq-ref slow 'warnings) (or (assq-ref state 'ahead) '()))
      (draw-tape put columns f (string-length title) (string-length right))
      (draw-words put columns row (assq-ref state 'words) top blocks?))))
