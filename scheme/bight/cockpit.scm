;;; (bight cockpit) --- the screen in which dives are flown, watched and asked about.
;;;
;;; A cockpit draws a dive in half blocks, of which only the changed ones are written, with a display of
;;; figures over it, a map, targets, and whatever its owner adds.  (bight cockpit view-keys) has the keys that
;;; change how things look.  Who owns it lets time pass and does what the other keys say: free flight, (bight cockpit view), a
;;; lesson, (bight lesson cockpit), a recording, (bight cockpit watch).
;;;
;;; What can go wrong with the picture does not end the flight: plain characters take its place.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit)
  #:use-module (bight cockpit believed)
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit controller)
  #:use-module (bight cockpit desk)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keys)
  #:use-module ((bight cockpit page) #:select (first-page))
  #:use-module (bight cockpit state)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module ((bight view tube) #:select (draw-beneath))
  #:use-module ((bight world) #:select (world-name))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (draw-frame! compose-frame! fit-to-size! draw-page! frame-pixels))

(define slow-period 1/2)                ; s: between questions that cost something
(define forecast-period 1)              ; s: between looks ahead, or longer,
(define forecast-share 1/50)            ; so that they take no more of the time than this
(define map-period 1/2)

(define (fit-to-size! c size)
  "Let C draw for a screen of SIZE, a pair of columns and rows; return #t if all must be written."
  (if (equal? size (cockpit-size c))
      #f
      (begin
        (set-size! c size)
        (set-characters! c '(() . 0))
        (set-screen! c (%make-screen (car size) (cdr size) (cockpit-palette c) (cockpit-ascii? c)))
        #t)))

(define (fit-screen! c)
  ;; Take the terminal's size as it is now; return #t if all must be written.
  (fit-to-size! c (%screen-size)))


;;; The picture.

(define* (frame-pixels engine view paint size flags ghost #:optional (marks #f))
  "Return the pixels, a bytevector, of a quick picture of the dive of ENGINE by VIEW, as %draw takes it, for SIZE, a pair of
columns and rows; GHOST is the engine of another dive, or #f.  MARKS, an f64vector of points, receives where they
fall in it; a sonar, which hears no heights, has none."
  (let ((pixels (cons (car size) (* 2 (cdr size)))))
    (if (eq? 'sonar view)
        ((from (bight view render) %draw-sonar) engine "" pixels sonar-range '())
        ((from (bight view render) %draw) ((from (bight view picture) renderer) 'pilot!)
                                     engine "" view pixels paint (cons 'quick flags) ghost marks))))

(define sonar-range 30.)                ; m

(define least-side 16)

(define (view-turned c)
  ;; The view of C as %draw takes it: the overview as the mouse has turned it.
  (let ((orbit (and (eq? 'overview (cockpit-view c)) (cockpit-orbit c))))
    (if orbit
        (list (cockpit-view c) #f 0 (third orbit) (first orbit) (second orbit))
        (cockpit-view c))))

(define axis-length 3)                  ; m

(define (axes c)
  ;; The axes of the world at the vehicle, as targets, where the overview was turned.
  (if (and (eq? 'overview (cockpit-view c)) (cockpit-orbit c) (cockpit-vehicle c))
      (let ((at (rov-position (cockpit-vehicle c))))
        (map (lambda (name x y z) (target name (vec+ at (vec* axis-length (vec x y z)))))
             '("E" "N" "up") '(1 0 0) '(0 1 0) '(0 0 1)))
      '()))

(define (shown-marks c)
  (append ((cockpit-targets c)) (cockpit-labels c) (axes c)))

(define (marks-vector marks)
  (apply f64vector (append-map (lambda (mark) (list (x (cdr mark)) (y (cdr mark)) (z (cdr mark)))) marks)))

(define (picture-size c)
  (cons (car (cockpit-size c)) (* 2 (cdr (cockpit-size c)))))

(define (pixels-with c places)
  ;; The picture; PLACES, an f64vector of points, receives where they fall in it.
  (let ((ghost (cockpit-ghost c)))
    (frame-pixels (engine-of (cockpit-dive c)) (view-turned c) (cockpit-paint c) (cockpit-size c)
                  (if (cockpit-lamp? c) '(lamp) '()) (and (dive? ghost) (engine-of ghost)) places)))

(define (draw-picture! c)
  ;; Return the marks with where they fall: lists (NAME COLUMN ROW).
  (let* ((sonar? (eq? 'sonar (cockpit-view c))) (marks (if sonar? '() (shown-marks c)))
         (drawing (and (not sonar?) (believed-drawing c))) (size (picture-size c)))
    (let ((places (marks-vector marks)))
      (%screen-picture! (cockpit-screen c)
                        (if drawing
                            (draw-beneath drawing size places (lambda (places) (pixels-with c places)))
                            (pixels-with c places)))
      (filter-map (lambda (mark i)
                    (and (= 1 (f64vector-ref places (+ 2 (* 3 i))))
                         (list (car mark) (cell (f64vector-ref places (* 3 i)))
                               (cell (/ (f64vector-ref places (+ 1 (* 3 i))) 2)))))
                  marks (iota (length marks))))))

(define (cell x)
  (if (< (abs x) 1e5) (inexact->exact (floor x)) -1))

(define plain-period 1/5)               ; s: a drawing of characters costs as much as several pictures

(define (draw-plainly! c put)
  (let ((columns (max 40 (min 160 (car (cockpit-size c))))) (t (clock)))
    (when (> t (cdr (cockpit-characters c)))
      (set-characters! c (cons ((from (bight view) scene-lines-with) (believed-drawing c) columns)
                               (+ t plain-period))))
    (put-lines put 0 2 (car (cockpit-characters c)) #xd0e0e0 0)))

(define (no-picture! c e)
  ;; From now on without.
  (set-plain! c #t)
  (set-ghost! c #f)
  (announce! c (bight-error-message e)))

(define (room-for-picture? c)
  (and (>= (car (cockpit-size c)) least-side) (>= (* 2 (cdr (cockpit-size c))) least-side)))

(define (blind? c)
  ;; A sonar needs no light.
  (or (not (cockpit-dive c)) (and (cockpit-dark? c) (not (eq? 'sonar (cockpit-view c)))) ((unseen?) 'look) (not (room-for-picture? c))))

(define (draw-scene! c put)
  ;; The picture, or plain characters; return the marks in it.
  (cond ((blind? c) (%screen-clear! (cockpit-screen c)) '())
        ((and (not (cockpit-plain? c))
              (with-exception-handler
                  (lambda (e) (if (bight-error? e) (no-picture! c e) (raise-exception e)) #f)
                (lambda () (draw-picture! c))
                #:unwind? #t)))
        (else
         (%screen-clear! (cockpit-screen c))
         (trying c (draw-plainly! c put))
         '())))

(define (draw-marks! put columns marks)
  ;; Each has its name beside it where there is room.
  (for-each (lambda (mark)
              (define (mark! text) (put-apart put columns (second mark) (third mark) text green 0))
              (or (mark! (string-append "+ " (first mark))) (mark! "+")))
            marks))


;;; The map.

(define (map-size c)
  ;; Columns and rows of it, or #f on a screen without room.
  (let ((columns (car (cockpit-size c))) (rows (cdr (cockpit-size c))))
    (and (>= columns 60) (>= rows 18)
         (cons (if (>= columns 100) 30 22) (if (>= rows 32) 13 9)))))

(define (letter-of i)
  (string-ref "123456789" (min i 8)))

(define (draw-map! c put row)
  ;; Return the row below it.
  (let ((size (map-size c)) (t (clock)))
    (cond ((not (and (cockpit-map? c) size (not (blind? c)) (not ((unseen?) 'tether-points)))) row)
          (else
           (when (> t (cockpit-plan-due c))
             (set-plan! c (trying c ((from (bight view) plan-lines) (car size) (cdr size)
                                     (map (lambda (target i) (cons (letter-of i) (cdr target)))
                                          ((cockpit-targets c)) (iota (length ((cockpit-targets c)))))
                                     (believed-drawing c))))
             (set-plan-due! c (+ t map-period)))
           (let ((lines (or (cockpit-plan c) '())))
             (put-lines put (- (car (cockpit-size c)) (car size)) row lines white #x081820)
             (+ row (length lines)))))))


;;; The display.

(define (frames-a-second c)
  (let ((times (cockpit-times c)))
    (if (or (null? times) (null? (cdr times)))
        0
        (inexact->exact (round (/ (- (length times) 1)
                                  (max 1e-3 (- (car times) (last times)))))))))

(define (title c)
  (let ((name (and (cockpit-dive c) (world-name (dive-world (cockpit-dive c))))))
    (string-append (if name (symbol->string name) "a dive")
                   (if (cockpit-dive c)
                       (string-append "  " (number->string (/ (floor (* 10 (now))) 10)) " s")
                       ""))))

(define (leading-words words room)
  ;; The first of WORDS that fit into ROOM, with two blanks between them.
  (fold (lambda (word line)
          (let ((longer (if (string-null? line) word (string-append line "  " word))))
            (if (<= (string-length longer) room) longer line)))
        "" words))

(define (right-text c)
  ;; As much of it as there is room for beside the title, the most important first.
  (leading-words
   (filter identity
           (list (and (cockpit-paused? c) "PAUSED")
                 (and (cockpit-dark? c) "NO LIGHT")
                 (and (cockpit-ghost c) (cockpit-ghost-name c))
                 (and (cockpit-lamp? c) "lights")
                 (and (current-controllers) (pair? (controller-names (current-controllers)))
                      (simple-format #f "pads ~a" (length (controller-names (current-controllers)))))
                 (cond ((cockpit-plain? c) "plain")
                       ((eq? 'sonar (cockpit-view c)) (simple-format #f "sonar ~a m" (inexact->exact sonar-range)))
                       (else (symbol->string (cockpit-view c))))
                 (and (not (eq? 'plain (cockpit-paint c))) (symbol->string (cockpit-paint c)))
                 (string-append (number->string (frames-a-second c)) "/s")))
   (- (car (cockpit-size c)) (string-length (title c)) 4)))

(define (sticks-now c)
  (if (cockpit-vehicle c)
      (array->list (sticks (cockpit-vehicle c)))
      '(0 0 0 0)))

(define (in-words-now c)
  ;; The way home in words, or #f.
  (and (cockpit-words? c) (cockpit-tether c) (not ((unseen?) 'way-home)) (not ((unseen?) 'tether-points))
       (with-exception-handler (const #f)
         (lambda () ((from (bight dive in-words) in-words) (cockpit-tether c) 'way-home))
         #:unwind? #t)))

(define (ask-ahead! c t)
  ;; At T, of the copy that a live dive last published; not in a frame that asks for the slow figures.
  (set-ahead! c (forecast (cockpit-tether c)))
  (set-said! c (in-words-now c))
  (set-ahead-due! c (+ (clock) (max forecast-period (/ (- (clock) t) forecast-share)))))

(define (ask-what-is-due! c)
  (let ((t (clock)))
    (cond ((> t (cockpit-slow-due c))
           (set-slow! c (slow-figures (cockpit-vehicle c) (cockpit-tether c)))
           (set-slow-due! c (+ t slow-period)))
          ((and (> t (cockpit-ahead-due c))
                (or (not (cockpit-paused? c)) (not (cockpit-words c))))
           (ask-ahead! c t)))))

(define (draw-figures! c put top hint typing?)
  ;; What is told stands in the last line; where a line is typed there, among what is to come.
  (let ((telling? (< (clock) (cockpit-message-until c))))
    (draw-hud put (car (cockpit-size c)) (cdr (cockpit-size c))
              (read-figures (cockpit-vehicle c) (cockpit-tether c))
              (cockpit-slow c)
              `((title . ,(title c)) (right . ,(right-text c)) (urgent? . ,(or telling? typing?))
                (message . ,(if (and telling? (not typing?)) (cockpit-message c) hint))
                (ahead . ,(append (if (and telling? typing?) (list (cockpit-message c)) '())
                                  (believed-lines c) (cockpit-ahead c)))
                (words . ,(cockpit-words c)) (top . ,top)
                (sticks . ,(sticks-now c))))))

(define (draw-help! c put)
  (let* ((columns (car (cockpit-size c))) (rows (cdr (cockpit-size c))) (lines (help-lines c))
         (width (min columns (+ 4 (apply max (map string-length lines))))))
    (put-lines put (quotient (- columns width) 2)
               (max 1 (min 4 (- rows 1 (length lines))))
               (map (lambda (line) (string-pad-right (string-append "  " line) width)) lines)
               #xffffff #x102028)))

(define (note-frame! c)
  (let ((times (cons (clock) (cockpit-times c))))
    (set-times! c (if (> (length times) 31) (list-head times 31) times))))

(define (new-desk c)
  (let ((screen (cockpit-screen c)))
    (desk (car (cockpit-size c)) (cdr (cockpit-size c))
          (lambda (column row text ink paper)
            (%screen-text! screen column row text ink paper)))))

(define (write-frame! c new?)
  (note-frame! c)
  (unless (%screen-write! (cockpit-screen c) new?)
    (set-done! c 'hung-up)))

(define (plain-put c)
  ;; The plain drawing is a picture: texts go over it.
  (lambda (column row text ink paper)
    (%screen-text! (cockpit-screen c) column row text ink paper)))

(define* (compose-frame! c hint #:key typing?)
  "Draw the dive of C with its display on the screen of C, which nobody sees yet; HINT stands in the last line where
there is nothing to tell, or, a line that is TYPING?, whatever is told."
  (let* ((put (new-desk c)) (marks (draw-scene! c (plain-put c))))
    (when (help-lines c)
      (draw-help! c put))
    (let ((top (or (and (cockpit-panel c)
                        ((cockpit-panel c) put (car (cockpit-size c)) (cdr (cockpit-size c))))
                   2)))
      (trying c (ask-what-is-due! c))
      (look-at-belief! c)
      (draw-map! c put top)
      (trying c (draw-figures! c put top hint typing?)))
    (draw-marks! put (car (cockpit-size c)) marks)))

(define* (draw-frame! c hint #:key typing?)
  "Show the dive of C with its display; HINT and TYPING? are for `compose-frame!'."
  (let ((new? (fit-screen! c)))
    (compose-frame! c hint #:typing? typing?)
    (write-frame! c new?)))

(define (draw-lines! put columns lines)
  ;; As a box in the middle, two rows below the top.
  (when (pair? lines)
    (let ((width (max 1 (min (- columns 4) (apply max 76 (map string-length lines))))))
      (put-box put (max 0 (quotient (- columns width 2) 2)) 2
               (map (lambda (line) (string-pad-right line width)) lines)
               white #x102028))))

(define (draw-page! c lines last-line)
  "Draw the dive of C, or nothing where it has none, with the first page of LINES, strings, over it, and LAST-LINE below."
  (let* ((new? (fit-screen! c)) (put (new-desk c)) (columns (car (cockpit-size c))) (rows (cdr (cockpit-size c)))
         (marks (draw-scene! c (plain-put c))) (shown (first-page lines)))
    (put 0 (- rows 1) (string-pad-right (cut (string-append " " last-line) columns) columns) yellow #x102028)
    (put 0 0 (cut (string-append " " (title c) " ") columns) white #f)
    (draw-lines! put columns shown)
    (draw-map! c put (+ 3 (length shown)))
    (draw-marks! put columns marks)
    (write-frame! c new?)))
