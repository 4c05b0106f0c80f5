;;; (bight lesson seat) --- where a pupil sits: the cockpit, his keys, and pages over a dive that stands still.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson seat)
  #:use-module (bight cockpit)
  #:use-module ((bight cockpit page) #:select (first-page))
  #:use-module ((bight cockpit view-keys) #:select (view-key!))
  #:use-module (bight cockpit controls)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keyboard)
  #:use-module (bight cockpit state)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson input)
  #:use-module (bight lesson lines)
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:export (make-seat seat? the-seat this-cockpit hard? from-above-alone? one-view hidden-in-lesson?
            seat-view set-seat-view! seat-texts set-texts! seat-heard set-heard! seat-pending set-pending!
            seat-history set-history! seat-keys seat-lost? set-lost!
            keep-up! next-key waiting
            view-key-here! draw-still turn-pages enter-turns show-page! show-but-last! in-order
            labels-now with-look hear!))

(define-record <seat>
  (make-seat cockpit keys view texts heard pending history lost?)
  seat?
  (cockpit seat-cockpit)
  (keys seat-keys set-keys!)            ; that came and were not taken yet
  (view seat-view set-seat-view!)       ; in which the pupil flies
  (texts seat-texts set-texts!)         ; said, and not read yet; the last first
  (heard seat-heard set-heard!)         ; (INK . TEXT) while flying, the last first
  (pending seat-pending set-pending!)   ; how the last probe was, to be shown, or #f
  (history seat-history set-history!)   ; lines typed, the last first
  (lost? seat-lost? set-lost!))         ; a controller was lost, and the vehicle was not told to hold its place

(define the-seat (make-parameter #f))

(define (this-cockpit) (seat-cockpit (the-seat)))

(define (hard?)
  (and (current-session) (eq? 'hard (session-level (current-session)))))

(define (from-above-alone?)
  (and (current-session) (eq? 'plan (display-allowed))))

(define (one-view)
  "Return the one view that the lesson lets its pupil fly by; #f: any."
  (cond ((from-above-alone?) 'top)
        ((hard?) 'pilot)
        (else #f)))

(define (hidden-in-lesson? verb)
  (and (current-session) (hidden? verb)))

(define (keep-up!)
  "Let the cockpit show the dive that the lesson is in."
  (let ((c (this-cockpit)))
    (unless (or (not (current-dive)) (eq? (current-dive) (cockpit-dive c)))
      (board! c (current-dive)))))

(define (next-key seconds)
  "Return the next key that was pressed, or is within SECONDS; #f if there is none."
  (let ((seat (the-seat)))
    (when (null? (seat-keys seat))
      (set-keys! seat (controller-keys! (seat-cockpit seat))))
    (when (null? (seat-keys seat))
      (let ((keys (keys-within seconds)))
        (if keys (set-keys! seat keys) ((leaving)))))
    (and (pair? (seat-keys seat))
         (let ((key (car (seat-keys seat))))
           (set-keys! seat (cdr (seat-keys seat)))
           (case key                    ; whatever is asked just now
             ((releases) (set-releases! (seat-cockpit seat) #t))
             ((lost) (set-lost! seat #t)))
           key))))

(define (waiting thunk)
  "Call THUNK while the pupil thinks: nothing is counted against the lesson."
  ((breathing) #f)
  (let ((value (thunk)))
    ((breathing) #t)
    value))


;;; Pages: the dive stands still.

(define (view-key-here! key)
  "Change how things look as far as the level lets a pupil."
  (let ((c (this-cockpit)))
    (if (or (and (one-view) (memv key '(#\v #\1 #\2 #\3 #\4 #\5 #\6))) (and (hard?) (eqv? key #\z)))
        (begin
          (announce! c (if (from-above-alone?)
                       "you fly by the view from above alone"
                       "at this level you see what the camera sees"))
          #t)
        (view-key! c key))))

(define (draw-still lines last-line)
  (let ((c (this-cockpit)))
    (parameterize ((current-dive (or (cockpit-dive c) (current-dive))))
      (draw-page! c lines last-line))))

(define (enter-turns key)
  (case key
    ((#\return #\newline #\space) #t)
    ((#\q #\etx #\eot) ((leaving)))
    (else (view-key-here! key) #f)))

(define going-on "Enter goes on   q leaves")

(define (after-page lines)
  (call-with-values (lambda () (first-page lines)) (lambda (page rest) rest)))

(define (turn-pages lines last-line turn)
  "Show LINES page by page, as many as the screen needs, until TURN, a procedure of a key that is pressed on the last of
them, returns what is not #f, and return that.  LAST-LINE stands below the last page."
  (waiting
   (lambda ()
     (let loop ((lines lines))
       (let* ((rest (after-page lines)) (last? (null? rest)))
         (draw-still lines (if last? last-line going-on))
         (let* ((key (next-key 0.25)) (turned (and key ((if last? turn enter-turns) key))))
           (cond ((not turned) (loop lines))
                 (last? turned)
                 (else (loop rest)))))))))

(define (show-page! lines last-line)
  (unless (replaying?)
    (let ((lines (without-last-blanks lines)))
      (unless (null? lines)
        (turn-pages lines last-line enter-turns)))))

(define (without-last-blanks lines)
  (reverse (drop-while string-null? (reverse lines))))

(define (show-but-last! lines)
  "Show LINES page by page, but for the last page."
  (call-with-values (lambda () (first-page lines))
    (lambda (page rest)
      (unless (null? rest)
        (turn-pages page going-on enter-turns)
        (show-but-last! rest)))))

(define (in-order texts)
  "Return TEXTS, the last first, as the lines of a page."
  (append-map (lambda (text) (list text "")) (reverse texts)))

(define (labels-now)
  "Return labels of the anchor and the vehicle, where the lesson lets them be seen."
  (let ((c (this-cockpit)))
    (if (and (cockpit-tether c) (cockpit-vehicle c) (not (hidden-in-lesson? 'point-at)))
        (list (target "A" (point-at (cockpit-tether c) 0))
              (target (symbol->string (cockpit-vehicle c)) (rov-position (cockpit-vehicle c))))
        '())))

(define* (with-look view labels thunk #:key (map? #f))
  "Call THUNK while the cockpit shows VIEW with LABELS, and the map if MAP?; return what it returns."
  (let* ((c (this-cockpit)) (map-before (cockpit-map? c)) (view-before (cockpit-view c)))
    (set-view! c view)
    (set-labels! c labels)
    (set-map! c map?)
    (let ((value (thunk)))
      (set-labels! c '())
      (set-view! c view-before)
      (set-map! c map-before)
      value)))


;;; What is heard while flying.

(define (hear! ink text)
  "Let the pupil hear TEXT, in a line of its own of the colour INK."
  (set-heard! (the-seat) (let ((all (acons ink text (seat-heard (the-seat)))))
                           (if (> (length all) 6) (list-head all 6) all))))
