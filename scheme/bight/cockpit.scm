;;; (bight cockpit) --- the screen in which dives are flown, watched and asked about.
;;;
;;; A cockpit draws a dive in half blocks, of which only the changed ones are written, with a display of
;;; figures over it, a map, targets, and whatever its owner adds; and it knows the keys that change how things
;;; look.  Who owns it lets time pass and does what the other keys say: free flight, (bight cockpit view), a
;;; lesson, (bight lesson cockpit), a recording, (bight cockpit watch).
;;;
;;; What can go wrong with the picture does not end the flight: plain characters take its place.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit)
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit desk)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keys)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module ((bight world) #:select (world-name))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (new-cockpit cockpit? board!
            cockpit-dive cockpit-vehicle cockpit-tether cockpit-sticks set-sticks!
            cockpit-paused? set-paused! cockpit-done? set-done!
            cockpit-sent set-sent! cockpit-live? set-live! cockpit-stepped set-stepped!
            look-ahead! toggle-ghost! drop-ghost! cockpit-ghost set-ghost!
            cockpit-plain? set-plain! cockpit-view set-view! cockpit-size cockpit-map? set-map! cockpit-dark? set-dark!
            set-targets! set-panel! set-labels!
            tell! call-or-tell trying
            clock frame look-anew! ask-anew! palette-of ascii-terminal? this-palette
            draw-frame! draw-page! pages view-key! frame-pixels
            target))

(define-syntax-rule (from module name)
  (module-ref (resolve-interface 'module) 'name))

(define frame 1/30)                     ; s
(define slow-period 1/2)                ; s: between questions that cost something
(define forecast-period 1)              ; s: between looks ahead, or longer,
(define forecast-share 1/50)            ; so that they take no more of the time than this
(define map-period 1/2)

(define (clock)
  "Return the time of the machine's clock, s."
  (/ (get-internal-real-time) (exact->inexact internal-time-units-per-second)))


;;; What it knows.

(define-record <cockpit>
  (make-cockpit palette ascii? dive vehicle tether screen size view paint plain? lamp? help? words? map? sticks
                message message-until slow slow-due ahead words ahead-due plan plan-due
                paused? ghost ghost-fork done? times targets labels panel dark? sent live? stepped)
  cockpit?
  (palette cockpit-palette)
  (ascii? cockpit-ascii?)
  (dive cockpit-dive set-dive!)         ; or #f
  (vehicle cockpit-vehicle set-vehicle!) ; names, or #f
  (tether cockpit-tether set-tether!)
  (screen cockpit-screen set-screen!)
  (size cockpit-size set-size!)
  (view cockpit-view set-view!)
  (paint cockpit-paint set-paint!)
  (plain? cockpit-plain? set-plain!)    ; no picture
  (lamp? cockpit-lamp? set-lamp!)
  (help? cockpit-help? set-help!)
  (words? cockpit-words? set-words!)
  (map? cockpit-map? set-map!)
  (sticks cockpit-sticks set-sticks!)
  (message cockpit-message set-message!)
  (message-until cockpit-message-until set-message-until!)
  (slow cockpit-slow set-slow!)
  (slow-due cockpit-slow-due set-slow-due!)
  (ahead cockpit-ahead set-ahead!)      ; what is to come, strings
  (words cockpit-words set-said!)       ; the way home in words, or #f
  (ahead-due cockpit-ahead-due set-ahead-due!)
  (plan cockpit-plan set-plan!)         ; the lines of the map
  (plan-due cockpit-plan-due set-plan-due!)
  (paused? cockpit-paused? set-paused!)
  (ghost cockpit-ghost set-ghost!)      ; a dive to draw pale, #t: one that is not there yet, #f: none
  (ghost-fork cockpit-ghost-fork set-ghost-fork!) ; (DIVE . STEPS-LEFT) on its way, or #f
  (done? cockpit-done? set-done!)
  (times cockpit-times set-times!)      ; when the last frames were drawn, the newest first
  (targets cockpit-targets set-targets!) ; a thunk: a list of targets
  (labels cockpit-labels set-labels!)   ; a list of targets that have a name alone
  (panel cockpit-panel set-panel!)      ; (PANEL PUT COLUMNS ROWS): draw first; the row it ends at, or #f
  (dark? cockpit-dark? set-dark!)       ; the camera sees nothing
  ;; For its owner:
  (sent cockpit-sent set-sent!)         ; the stick values that the vehicle was told last, or #f
  (live? cockpit-live? set-live!)       ; #f: the owner's loop steps the dive
  (stepped cockpit-stepped set-stepped!)) ; by that loop, until when

;; A target is its name and where it is.
(define target cons)

(define (new-cockpit palette view paint)
  "Return a cockpit without a dive, for a terminal of PALETTE, that shows VIEW with tethers painted by PAINT."
  (make-cockpit palette (ascii-terminal?) #f #f #f #f #f view paint (eq? palette 'none) #f #f #t #f (new-sticks)
                "" 0 '((windings) (warnings)) 0 '() #f 0 '() 0 #f #f #f #f '() (const '()) '() #f #f #f #f (clock)))

(define (board! c dive)
  "Let C show DIVE, and ask of it anew."
  (let ((names (lambda (head) (let ((all (%names (engine-of dive) head))) (and (pair? all) (car all))))))
    (set-dive! c dive)
    (set-vehicle! c (names 'rov))
    (set-tether! c (names 'tether))
    (ask-anew! c)))

(define (ask-anew! c)
  "Let C forget what it knows of its dive."
  (set-slow! c '((windings) (warnings)))
  (set-ahead! c '())
  (set-said! c #f)
  (set-slow-due! c 0)
  (set-ahead-due! c 0)
  (set-plan-due! c 0))

(define (look-anew! c)
  "Let the next frame be written whole."
  (set-size! c #f))

(define (tell! c text)
  "Show TEXT for a while."
  (set-message! c text)
  (set-message-until! c (+ 4 (clock))))

(define (call-or-tell c thunk)
  "Call THUNK; a &bight-error that it raises is shown."
  (with-exception-handler
      (lambda (e)
        (if (bight-error? e)
            (begin (tell! c (bight-error-message e)) #f)
            (raise-exception e)))
    thunk
    #:unwind? #t))

(define-syntax-rule (trying c body ...)
  (call-or-tell c (lambda () body ...)))


;;; What a terminal shows.

(define (says? text word) (and text (string-contains-ci text word) #t))

(define (palette-of term colorterm no-color)
  "Return the palette of a terminal whose environment says TERM, COLORTERM and NO_COLOR, strings or #f:
true, many, few or none."
  (cond ((and no-color (not (string-null? no-color))) 'none)
        ((or (member colorterm '("truecolor" "24bit")) (says? term "direct")) 'true)
        ((says? term "256color") 'many)
        ((or (not term) (string-prefix? "vt" term) (says? term "mono")) 'none)
        (else 'few)))

(define (this-palette)
  "Return the palette of this terminal by its environment."
  (palette-of (getenv "TERM") (getenv "COLORTERM") (getenv "NO_COLOR")))

(define (ascii-terminal?)
  "Return #t if the locale of the environment has no UTF-8."
  (let ((locale (find (lambda (text) (and text (not (string-null? text))))
                      (map getenv '("LC_ALL" "LC_CTYPE" "LANG")))))
    (not (or (says? locale "UTF-8") (says? locale "UTF8")))))

(define (fit-screen! c)
  ;; Take the terminal's size as it is now; return #t if all must be written.
  (let ((size (%screen-size)))
    (if (equal? size (cockpit-size c))
        #f
        (begin
          (set-size! c size)
          (set-screen! c (%make-screen (car size) (cdr size) (cockpit-palette c) (cockpit-ascii? c)))
          #t))))


;;; The picture.

(define* (frame-pixels engine view paint size flags ghost #:optional (marks #f))
  "Return the pixels, a bytevector, of a quick picture of the dive of ENGINE by VIEW for SIZE, a pair of
columns and rows; GHOST is the engine of another dive, or #f.  MARKS, an f64vector of points, receives where they
fall in it."
  ((from (bight view render) %draw) ((from (bight view picture) renderer) 'pilot!)
                               engine "" view
                               (cons (car size) (* 2 (cdr size)))
                               paint (cons 'quick flags) ghost marks))

(define least-side 16)

(define (shown-marks c)
  (append ((cockpit-targets c)) (cockpit-labels c)))

(define (marks-vector marks)
  (apply f64vector (append-map (lambda (mark) (list (x (cdr mark)) (y (cdr mark)) (z (cdr mark)))) marks)))

(define (draw-picture! c)
  ;; Return the marks with where they fall: lists (NAME COLUMN ROW).
  (let ((ghost (cockpit-ghost c)) (size (cockpit-size c)) (marks (shown-marks c)))
    (unless (and (>= (car size) least-side) (>= (* 2 (cdr size)) least-side))
      (bight-raise 'unsupported 'pilot! "the terminal is too small for a picture"))
    (let ((places (marks-vector marks)))
      (%screen-picture! (cockpit-screen c)
                        (frame-pixels (engine-of (cockpit-dive c)) (cockpit-view c)
                                      (cockpit-paint c) size
                                      (if (cockpit-lamp? c) '(lamp) '())
                                      (and (dive? ghost) (engine-of ghost))
                                      places))
      (filter-map (lambda (mark i)
                    (and (= 1 (f64vector-ref places (+ 2 (* 3 i))))
                         (list (car mark) (cell (f64vector-ref places (* 3 i)))
                               (cell (/ (f64vector-ref places (+ 1 (* 3 i))) 2)))))
                  marks (iota (length marks))))))

(define (cell x)
  (if (< (abs x) 1e5) (inexact->exact (floor x)) -1))

(define (draw-plainly! c put)
  (let ((columns (max 40 (min 160 (car (cockpit-size c))))))
    (put-lines put 0 2 ((from (bight view) picture-lines) ((from (bight view) look) #:columns columns))
               #xd0e0e0 0)))

(define (no-picture! c e)
  ;; From now on without.
  (set-plain! c #t)
  (set-ghost! c #f)
  (tell! c (bight-error-message e)))

(define (blind? c)
  (or (not (cockpit-dive c)) (cockpit-dark? c) ((unseen?) 'look)))

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

(define (draw-marks! put marks)
  ;; Each has its name beside it where there is room.
  (for-each (lambda (mark)
              (let ((text (string-append "+ " (first mark))))
                (or (put (second mark) (third mark) text green 0)
                    (put (second mark) (third mark) "+" green 0))))
            marks))


;;; What if: a fork that runs ahead, a little in every frame.

(define ghost-horizon 5)                ; s
(define ghost-budget 0.006)             ; s of a frame

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

(define (drop-ghost! c)
  "Let C look ahead no more."
  (set-ghost! c #f)
  (set-ghost-fork! c #f))

(define (look-ahead! c)
  "Bring what C looks ahead to a little further, if it does."
  (when (cockpit-ghost c)
    (unless (trying c (advance-ghost! c) #t)
      (drop-ghost! c))))

(define (toggle-ghost! c)
  "Let C look ahead, or no more."
  (let ((wanted? (not (cockpit-ghost c))))
    (drop-ghost! c)
    (cond ((not wanted?))
          ((cockpit-plain? c) (tell! c "plain characters show no what-if"))
          (((unseen?) 'what-if) (tell! c "in this lesson nobody sees what will be"))
          (else (set-ghost! c #t)))))


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
                                          ((cockpit-targets c)) (iota (length ((cockpit-targets c))))))))
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

(define (right-text c)
  (string-join
   (filter identity
           (list (and (cockpit-paused? c) "PAUSED")
                 (and (cockpit-dark? c) "NO LIGHT")
                 (and (cockpit-ghost c) "what if")
                 (and (cockpit-lamp? c) "lights")
                 (if (cockpit-plain? c) "plain" (symbol->string (cockpit-view c)))
                 (and (not (eq? 'plain (cockpit-paint c))) (symbol->string (cockpit-paint c)))
                 (string-append (number->string (frames-a-second c)) "/s")))
   "  "))

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

(define (draw-figures! c put top hint)
  (let ((telling? (< (clock) (cockpit-message-until c))))
    (draw-hud put (car (cockpit-size c)) (cdr (cockpit-size c))
              (read-figures (cockpit-vehicle c) (cockpit-tether c))
              (cockpit-slow c)
              `((title . ,(title c)) (right . ,(right-text c)) (urgent? . ,telling?)
                (message . ,(if telling? (cockpit-message c) hint))
                (ahead . ,(cockpit-ahead c)) (words . ,(cockpit-words c)) (top . ,top)
                (sticks . ,(sticks-now c))))))

(define (draw-help! c put)
  (let* ((columns (car (cockpit-size c))) (rows (cdr (cockpit-size c)))
         (width (min columns (+ 4 (apply max (map string-length key-lines)))))
         (lines (map (lambda (line) (string-pad-right (cut (string-append "  " line) width) width))
                     (list-head key-lines (min (length key-lines) (max 0 (- rows 2)))))))
    (put-lines put (quotient (- columns width) 2)
               (max 1 (min 4 (- rows 1 (length lines))))
               lines #xffffff #x102028)))

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

(define (draw-frame! c hint)
  "Draw the dive of C with its display; HINT stands in the last line where there is nothing to tell."
  (let* ((new? (fit-screen! c)) (put (new-desk c)) (marks (draw-scene! c (plain-put c))))
    (when (cockpit-help? c)
      (draw-help! c put))
    (let ((top (or (and (cockpit-panel c)
                        ((cockpit-panel c) put (car (cockpit-size c)) (cdr (cockpit-size c))))
                   2)))
      (trying c (ask-what-is-due! c))
      (draw-map! c put top)
      (trying c (draw-figures! c put top hint)))
    (draw-marks! put marks)
    (write-frame! c new?)))

(define (widest-drawing lines)
  ;; Of lines that are drawings the width; running text is wrapped.
  (apply max 0 (map string-length (filter (lambda (line) (string-contains line "  ")) lines))))

(define (fitted-lines lines columns)
  ;; LINES for a box on a screen of COLUMNS.
  (let ((width (min (- columns 4) (max 76 (widest-drawing lines)))))
    (append-map (lambda (line) (if (<= (string-length line) width) (list line) (wrap line width))) lines)))

(define (pages c lines)
  "Return LINES, a list of strings, as pages for the screen of C: lists of lines that fit."
  (let* ((size (%screen-size)) (room (max 1 (- (cdr size) 3))))
    (let loop ((rest (fitted-lines lines (car size))) (all '()))
      (if (<= (length rest) room)
          (reverse (cons rest all))
          (loop (list-tail rest room) (cons (list-head rest room) all))))))

(define (draw-page! c lines last-line)
  "Draw the dive of C, or nothing where it has none, with LINES, a list of strings, over it, and LAST-LINE below."
  (let* ((new? (fit-screen! c)) (put (new-desk c)) (columns (car (cockpit-size c))) (rows (cdr (cockpit-size c)))
         (marks (draw-scene! c (plain-put c)))
         (shown (fitted-lines lines columns))
         (shown (list-head shown (min (length shown) (max 1 (- rows 3)))))
         (width (min (- columns 4) (apply max 76 (map string-length shown)))))
    (put 0 (- rows 1) (string-pad-right (cut (string-append " " last-line) columns) columns) yellow #x102028)
    (put 0 0 (cut (string-append " " (title c) " ") columns) white #f)
    (when (pair? shown)
      (put-box put (quotient (- columns width 2) 2) 2
               (map (lambda (line) (string-pad-right line width)) shown)
               white #x102028))
    (draw-map! c put (+ 3 (length shown)))
    (draw-marks! put marks)
    (write-frame! c new?)))


;;; The keys that change how things look.

(define (next-of value values)
  (let ((rest (memq value values)))
    (if (and rest (pair? (cdr rest))) (cadr rest) (car values))))

(define views '(chase pilot top side overview))

(define (show-view! c view)
  (set-view! c view)
  (tell! c (string-append "view: " (symbol->string view))))

(define (suspend! c)
  ;; As ^Z does elsewhere.
  (%terminal-leave!)
  (kill (getpid) SIGSTOP)
  (%terminal-enter!)
  (look-anew! c))

(define (view-key! c key)
  "Do what KEY says if it only changes how things look, and return #t, else #f."
  (case key
    ((#\v) (show-view! c (next-of (cockpit-view c) views)) #t)
    ((#\1 #\2 #\3 #\4 #\5)
     (show-view! c (list-ref views (- (char->integer key) (char->integer #\1))))
     #t)
    ((#\o) (set-paint! c (next-of (cockpit-paint c) '(plain tension curvature model))) #t)
    ((#\x) (set-plain! c (not (cockpit-plain? c))) #t)
    ((#\y) (set-lamp! c (not (cockpit-lamp? c))) #t)
    ((#\z) (set-map! c (not (cockpit-map? c))) (set-plan-due! c 0) #t)
    ((#\f) (set-words! c (not (cockpit-words? c))) (set-ahead-due! c 0) (set-said! c #f) #t)
    ((#\?) (set-help! c (not (cockpit-help? c))) #t)
    ((#\page) (look-anew! c) #t)        ; ^L
    ((#\sub) (suspend! c) #t)
    (else #f)))
