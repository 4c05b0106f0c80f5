;;; (bight lesson cockpit) --- a lesson taken in the cockpit, from its first words to its last task.
;;;
;;; What is said is gathered into pages over the picture; a probe is asked over what the vehicle's own camera
;;; sees, and how it was is shown once that gives nothing away; a task is flown with the keys of free flight.
;;; All that changes the dive is an input, (bight lesson input), so that a lesson can be left and gone on
;;; with: the loop here lets no time pass but by inputs.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson cockpit)
  #:use-module (bight cockpit)
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit desk)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit keys)
  #:use-module (bight cockpit line)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive plain-words)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight lesson input)
  #:use-module (bight lesson lines)
  #:use-module (bight lesson play)
  #:use-module (bight lesson score)
  #:use-module (bight lesson tally)
  #:use-module (bight view)
  #:use-module (srfi srfi-1)
  #:export (call-in-cockpit say-in-cockpit picture-in-cockpit probe-in-cockpit fly-in-cockpit
            failed-in-cockpit answer-in lesson-panel seat? is-how-it-was?))


;;; The seat of a pupil.

(define-record <seat>
  (make-seat cockpit keys view texts heard pending history)
  seat?
  (cockpit seat-cockpit)
  (keys seat-keys set-keys!)            ; that came and were not taken yet
  (view seat-view set-seat-view!)       ; in which the pupil flies
  (texts seat-texts set-texts!)         ; said, and not read yet; the last first
  (heard seat-heard set-heard!)         ; (INK . TEXT) while flying, the last first
  (pending seat-pending set-pending!)   ; how the last probe was, to be shown, or #f
  (history seat-history set-history!))  ; lines typed, the last first

(define the-seat (make-parameter #f))

(define (this-cockpit) (seat-cockpit (the-seat)))

(define (hard?)
  (and (current-session) (eq? 'hard (session-level (current-session)))))

(define (from-above-alone?)
  (and (current-session) (eq? 'plan (display-allowed))))

(define (one-view)
  ;; The one view that the lesson lets its pupil fly by; #f: any.
  (cond ((from-above-alone?) 'top)
        ((hard?) 'pilot)
        (else #f)))

(define (hidden-in-lesson? verb)
  (and (current-session) (hidden? verb)))

(define* (call-in-cockpit thunk #:key (plain? #f))
  "Call THUNK while a lesson is taken in the cockpit, which takes the terminal and gives it back; PLAIN? wants plain
characters for a picture."
  (let ((c (new-cockpit (this-palette) 'chase 'plain)))
    (when plain? (set-plain! c #t))
    (parameterize ((the-seat (make-seat c '() 'chase '() '() #f '())) (unseen? hidden-in-lesson?))
      (dynamic-wind
        %terminal-enter!
        (lambda ()
          (let ((report (thunk)))
            (read-what-was-said!)
            report))
        %terminal-leave!))))

(define (keep-up!)
  ;; The cockpit shows the dive that the lesson is in.
  (let ((c (this-cockpit)))
    (unless (or (not (current-dive)) (eq? (current-dive) (cockpit-dive c)))
      (board! c (current-dive)))))

(define (next-key seconds)
  ;; The next key that was pressed, or is within SECONDS; #f if there is none.
  (let ((seat (the-seat)))
    (when (null? (seat-keys seat))
      (let ((bytes (%terminal-keys (max 0 seconds))))
        (if bytes (set-keys! seat (bytes->keys bytes)) ((leaving)))))
    (and (pair? (seat-keys seat))
         (let ((key (car (seat-keys seat))))
           (set-keys! seat (cdr (seat-keys seat)))
           key))))

(define (waiting thunk)
  ;; While the pupil thinks nothing is counted against the lesson.
  ((breathing) #f)
  (let ((value (thunk)))
    ((breathing) #t)
    value))


;;; Pages: the dive stands still.

(define (view-key-here! key)
  ;; Change how things look as far as the level lets a pupil.
  (let ((c (this-cockpit)))
    (if (or (and (one-view) (memv key '(#\v #\1 #\2 #\3 #\4 #\5))) (and (hard?) (eqv? key #\z)))
        (begin
          (tell! c (if (from-above-alone?)
                       "you fly by the view from above alone"
                       "at this level you see what the camera sees"))
          #t)
        (view-key! c key))))

(define (draw-still lines last-line)
  (let ((c (this-cockpit)))
    (parameterize ((current-dive (or (cockpit-dive c) (current-dive))))
      (draw-page! c lines last-line))))

(define (turn-page lines last-line turn)
  ;; Show LINES until TURN, a procedure of a key, returns what is not #f, and return that.
  (waiting
   (lambda ()
     (let loop ()
       (draw-still lines last-line)
       (let ((key (next-key 0.25)))
         (or (and key (turn key)) (loop)))))))

(define (enter-turns key)
  (case key
    ((#\return #\newline #\space) #t)
    ((#\q #\etx #\eot) ((leaving)))
    (else (view-key-here! key) #f)))

(define (show-page! lines last-line)
  (unless (replaying?)
    (for-each (lambda (page) (turn-page page last-line enter-turns))
              (pages (this-cockpit) (without-last-blanks lines)))))

(define (without-last-blanks lines)
  (reverse (drop-while string-null? (reverse lines))))

(define (show-but-last! lines)
  ;; Where LINES need several pages show all but the last, and return that.
  (let ((all (pages (this-cockpit) lines)))
    (for-each (lambda (page) (turn-page page "Enter goes on   q leaves" enter-turns)) (drop-right all 1))
    (last all)))

(define (in-order texts)
  ;; TEXTS, the last first, as the lines of a page.
  (append-map (lambda (text) (list text "")) (reverse texts)))

(define (labels-now)
  ;; The anchor and the vehicle, where the lesson lets them be seen.
  (let ((c (this-cockpit)))
    (if (and (cockpit-tether c) (cockpit-vehicle c) (not (hidden-in-lesson? 'point-at)))
        (list (target "A" (point-at (cockpit-tether c) 0))
              (target (symbol->string (cockpit-vehicle c)) (rov-position (cockpit-vehicle c))))
        '())))

(define* (with-look view labels thunk #:key (map? #f))
  ;; Call THUNK while the cockpit shows VIEW with LABELS, and the map if MAP?.
  (let* ((c (this-cockpit)) (map-before (cockpit-map? c)) (view-before (cockpit-view c)))
    (set-view! c view)
    (set-labels! c labels)
    (set-map! c map?)
    (let ((value (thunk)))
      (set-labels! c '())
      (set-view! c view-before)
      (set-map! c map-before)
      value)))

(define (read-what-was-said!)
  ;; What was said stands on a page until it is read.
  (show-how-it-was!)
  (let ((texts (seat-texts (the-seat))))
    (set-texts! (the-seat) '())
    (when (pair? texts)
      (keep-up!)
      (with-look 'pilot '()
                 (lambda () (show-page! (in-order texts) "Enter goes on   q leaves, to go on later"))))))


;;; How it was: after a probe, when no other is asked about the same dive.

(define (bearing-point from degrees metres)
  (let ((a (* degrees (/ (acos -1) 180))))
    (vec (+ (x from) (* metres (sin a))) (+ (y from) (* metres (cos a))) (z from))))

(define-record <how-it-was>
  (make-how-it-was dive hash verdict bearings)
  is-how-it-was?
  (dive how-dive)                       ; a fork
  (hash how-hash)
  (verdict how-verdict set-verdict!)    ; a list of texts, the last first
  (bearings how-bearings))              ; (SAID . TRUE), degrees, or #f

(define (note-how-it-was! truth answer degrees?)
  (let ((before (seat-pending (the-seat))))
    (set-pending! (the-seat)
                  (make-how-it-was (fork-dive (current-dive)) (state-hash)
                                   (if before (how-verdict before) '())
                                   (cond (degrees? (cons answer truth))
                                         (before (how-bearings before))
                                         (else #f))))))

(define (same-dive? how)
  (and (current-dive) (= (how-hash how) (state-hash))))

(define (bearing-labels bearings)
  (let* ((here (rov-position (cockpit-vehicle (this-cockpit))))
         (far (max 4 (* 0.4 (distance here (point-at (cockpit-tether (this-cockpit)) 0))))))
    (list (target "said" (bearing-point here (car bearings) far))
          (target "was" (bearing-point here (cdr bearings) far)))))

(define (show-how-it-was!)
  (let ((how (seat-pending (the-seat))))
    (when how
      (set-pending! (the-seat) #f)
      (unless (replaying?)
        (board! (this-cockpit) (how-dive how))
        (parameterize ((current-dive (how-dive how)))
          (with-look (if (from-above-alone?) 'top 'overview)
                     (append (labels-now) (if (how-bearings how) (bearing-labels (how-bearings how)) '()))
                     (lambda ()
                       (show-page! (append (reverse (how-verdict how)) '("So it was."))
                                   "Enter goes on   v other views   q leaves"))
                     #:map? (not (hard?))))))))


;;; What the guide does.

(define titles
  '((hint . "Hint: ") (coach . "Coach: ") (fault . "! ") (message . "Tender: ")
    (right . "Right: ") (wrong . "Not quite: ")))

(define inks
  `((hint . ,yellow) (coach . ,yellow) (fault . #xff9060) (message . #xffffff)))

(define (hear! ink text)
  (set-heard! (the-seat) (let ((all (acons ink text (seat-heard (the-seat)))))
                           (if (> (length all) 6) (list-head all 6) all))))

(define (say-in-cockpit kind text)
  "Say TEXT of KIND to the pupil: while flying in a line of its own, else on the next page."
  (let* ((seat (the-seat)) (how (seat-pending seat))
         (line (string-append (or (assq-ref titles kind) "") text)))
    (unless (quiet?)
      (case kind
        ((task)
         (set-heard! seat '()))
        ((hint coach fault message)
         (hear! (assq-ref inks kind) line))
        ((right wrong)
         (when how (set-verdict! how (cons line (how-verdict how)))))
        (else (set-texts! seat (cons line (seat-texts seat))))))))

(define (picture-in-cockpit thunk)
  "Show what THUNK returns; the dive itself, where that is all it would draw."
  (unless (replaying?)
    (keep-up!)
    (let* ((seat (the-seat)) (how (seat-pending seat))
           (texts (append (seat-texts seat) (if how (how-verdict how) '()))))
      (set-pending! seat #f)            ; this picture tells it
      (set-texts! seat '())
      (if (eq? thunk look)
          (with-look (or (one-view) 'overview) (labels-now)
                     (lambda ()
                       (show-page! (in-order texts) "Enter goes on   v other views   q leaves"))
                     #:map? (not (hard?)))
          (show-lines! (append (in-order texts) (value-lines (thunk))))))))

(define (value-lines value)
  (cond ((picture? value) (picture-lines value))
        ((string? value) (string-split value #\newline))
        (else (string-split (show-value value) #\newline))))

(define (show-lines! lines)
  ;; LINES as they are, without a picture behind them.
  (parameterize ((unseen? (lambda (verb) (or (eq? verb 'look) (hidden-in-lesson? verb)))))
    (show-page! lines "Enter goes on   q leaves")))


;;; Probes.

(define (answer-in text choices degrees?)
  "Return the answer that TEXT, what was typed, gives: a number, or one of CHOICES, which its beginning may stand for; or
a string that says what would be one.  DEGREES? wants a bearing."
  (let ((word (string-trim-both text)))
    (if choices
        (let* ((names (map (lambda (c) (simple-format #f "~a" c)) choices))
               (fits (if (string-null? word)
                         '()
                         (keep-by-name (lambda (c name) (string-prefix? word name)) choices names)))
               (whole (find (lambda (c) (string=? word (simple-format #f "~a" c))) choices)))
          (cond (whole)
                ((= 1 (length fits)) (car fits))
                (else (string-append "one of these words: " (string-join names ", ")))))
        (let ((n (false-if-exception (string->number word))))
          (cond ((not (and n (real? n) (finite? n))) "a number, such as 45")
                ((and degrees? (not (<= 0 n 360))) "a bearing is from 0, north, by 90, east, to 360")
                (else n))))))

(define (keep-by-name keep? items names)
  (filter-map (lambda (item name) (and (keep? item name) item)) items names))

(define (type-in line draw)
  ;; LINE as the pupil leaves it; DRAW, a procedure of a line, shows it.
  (let loop ((line line))
    (when (null? (seat-keys (the-seat))) (draw line))
    (let* ((key (next-key 0.25)) (line (if key (edit-line line key) line)))
      (if (or (line-done? line) (line-left? line)) line (loop line)))))

(define (columns-for label)
  (- (car (or (cockpit-size (this-cockpit)) '(80 . 24))) (string-length label) 2))

(define (typed-line label lines accept)
  ;; Let the pupil type; return what ACCEPT makes of the text, unless that is a string: then it is shown.
  (waiting
   (lambda ()
     (let loop ((lines lines))
       (let ((line (type-in (empty-line)
                            (lambda (line)
                              (draw-still lines (string-append label (line-shown line (columns-for label))))))))
         (if (line-left? line)
             ((leaving))
             (let ((value (accept (line-text line))))
               (if (string? value)
                   (loop (append (drop-complaint lines) (list (complaint value))))
                   value))))))))

(define (complaint text) (string-append "  -- " text))

(define (drop-complaint lines)
  (if (and (pair? lines) (string-prefix? "  -- " (last lines))) (drop-right lines 1) lines))

(define (probe-label choices degrees?)
  (cond (choices (string-append (string-join (map (lambda (c) (simple-format #f "~a" c)) choices) ", ") "> "))
        (degrees? "a bearing, degrees> ")
        (else "a number> ")))

(define (ask-probe question choices degrees?)
  (let* ((seat (the-seat)) (how (seat-pending seat)) (again? (and how (same-dive? how))))
    (when (and how (not again?))
      (show-how-it-was!))
    (keep-up!)
    (let ((lines (append (if again? (reverse (how-verdict how)) '())
                         (in-order (seat-texts seat))
                         (list (string-append "? " question)))))
      (set-texts! seat '())
      (list 'answer
            (with-look 'pilot '()
                       (lambda ()
                         (typed-line (probe-label choices degrees?) (show-but-last! lines)
                                     (lambda (text) (answer-in text choices degrees?)))))))))

(define (probe-in-cockpit question truth choices)
  "Ask QUESTION over what the vehicle's camera sees, and return the answer."
  (let* ((degrees? (asked-in-degrees?))
         (answer (second (next-input (lambda () (ask-probe question choices degrees?))))))
    (note-how-it-was! truth answer degrees?)
    answer))


;;; Flying: what the panel says.

(define (target-line target i)
  (let ((p (cdr target)))
    (string-append (number->string (+ i 1)) " " (car target) "  " (metres (range-to p)) "  "
                   (string-pad (number->string (modulo (inexact->exact (round (bearing-to p))) 360)) 3 #\0)
                   "  " (metres (- (z p))) " deep")))

(define (counters-line)
  (string-join
   (append (list (seconds-said (task-seconds)))
           (map (lambda (entry) (simple-format #f "~a ~a" (car entry) (cdr entry))) (task-counters)))
   "  "))

(define (lesson-panel task heard targets counters)
  "Return a panel of a cockpit, a procedure of PUT, columns and rows: the TASK, a string; HEARD, a list of (INK . TEXT),
the last first; TARGETS and COUNTERS, lists of lines.  It returns the row below."
  (lambda (put columns rows)
    (define most (cond ((>= rows 30) 4) ((>= rows 20) 3) (else 1)))
    (define (shown text)
      (let ((lines (wrap text (- columns 2))))
        (if (<= (length lines) most)
            lines
            (append (list-head lines (- most 1))
                    (list (cut (string-append (list-ref lines (- most 1)) " " (list-ref lines most)) (- columns 2)))))))
    (define (put-all row lines ink)
      (fold (lambda (line row)
              (put 0 row (string-pad-right (string-append " " line) columns) ink #x102028)
              (+ row 1))
            row lines))
    (let* ((row (put-all 2 (shown task) white))
           (lines (fold (lambda (entry lines)
                          (append (map (lambda (line) (cons (car entry) line)) (shown (cdr entry))) lines))
                        '() heard))
           (lines (if (> (length lines) most) (take-right lines most) lines))
           (row (fold (lambda (entry row) (put-all row (list (cdr entry)) (car entry))) row lines))
           (room (if (>= rows 20) 9 1))
           (row (fold (lambda (line row)
                        (put 0 row (cut (string-append " " line " ") columns) green #f)
                        (+ row 1))
                      row (if (> (length targets) room) (list-head targets room) targets))))
      (fold (lambda (line row)
              (put 0 row (cut (string-append " " line " ") columns) pale #f)
              (+ row 1))
            row counters))))

(define (targets-seen)
  ;; Where the level lets a pupil have them.
  (if (hard?) '() (task-targets)))

(define (panel-now put columns rows)
  (let ((targets (targets-seen)))
    ((lesson-panel (task-text) (seat-heard (the-seat))
                   (map target-line targets (iota (length targets)))
                   (list (counters-line)))
     put columns rows)))


;;; Flying: keys and time.

(define flight-hint "e hint  u back  p pause  t tender  z map  v view  : Scheme  ? keys  q leave, to go on later")

(define most-steps 6)                   ; in a frame: a slow machine flies slower rather than in jumps

(define (steps-due! c)
  ;; How many steps are due since the last frame.
  (let* ((t (clock)) (dt (time-step))
         (n (inexact->exact (floor (/ (- t (cockpit-stepped c)) dt)))))
    (cond ((> n most-steps) (set-stepped! c t) most-steps)
          (else (set-stepped! c (+ (cockpit-stepped c) (* n dt))) n))))

(define (stick-input! c)
  ;; The input of sticks that stand otherwise than before, in a list.
  (set-sticks! c (settle (cockpit-sticks c) (clock)))
  (let ((values (stick-values (cockpit-sticks c))))
    (if (equal? values (cockpit-sent c))
        '()
        (begin
          (set-sent! c values)
          (list (cons 'sticks values))))))

(define (typed label)
  ;; A line typed at the foot of the flight, or #f.
  (let ((c (this-cockpit)) (seat (the-seat)))
    (waiting
     (lambda ()
       (let* ((line (type-in (empty-line (seat-history seat))
                             (lambda (line)
                               (draw-flight! c (string-append label (line-shown line (columns-for label)))))))
              (text (string-trim-both (line-text line))))
         (and (line-done? line) (not (member text '("" ",q")))
              (begin
                (set-history! seat (cons text (seat-history seat)))
                text)))))))

(define (typed-input label make)
  (let* ((c (this-cockpit)) (text (typed label)))
    (set-stepped! c (clock))
    (if text (list (make text)) '())))

(define (act->inputs c act)
  ;; What ACT of a key means for the dive: a list of inputs.
  (case (car act)
    ((leave) ((leaving)))
    ((release)
     (set-sticks! c (new-sticks))
     (set-sent! c (stick-values (new-sticks)))
     '((release)))
    ((winch hold) (list act))
    ((back hint) (list act))
    ((ghost) (toggle-ghost! c) '())
    ((pause) (set-paused! c (not (cockpit-paused? c))) (set-stepped! c (clock)) '())
    ((prompt) (typed-input "bight> " (lambda (text) (list 'form text))))
    ((tell) (typed-input "to the tender> " (lambda (text) (list 'tell text))))
    (else '())))

(define (key->inputs c key)
  (cond ((stick-of-key key)
         => (lambda (stick)
              (set-sticks! c (press (cockpit-sticks c) (car stick) (cdr stick) (clock)))
              '()))
        ((nudge-of-key key)
         => (lambda (step) (set-sticks! c (nudge (cockpit-sticks c) (car step) (cdr step))) '()))
        ((view-key-here! key) '())
        ((act-of-key key) => (lambda (act) (act->inputs c act)))
        (else '())))

(define (draw-flight! c last-line)
  (set-targets! c targets-seen)
  (set-panel! c panel-now)
  (draw-frame! c last-line)
  (set-panel! c #f)
  (set-targets! c (const '())))

(define (inputs-until c end)
  ;; What the keys mean that come before the time END, s of the clock.
  (let loop ((inputs '()))
    (let ((key (next-key (- end (clock)))))
      (cond (key (loop (append inputs (key->inputs c key))))
            ((< (clock) end) (loop inputs))
            (else inputs)))))

(define (frame-inputs! c)
  ;; Draw a frame, take the keys of its time, and return the inputs that came of both.
  (let ((end (+ (clock) frame)))
    (look-ahead! c)
    (draw-flight! c flight-hint)
    (when (cockpit-done? c) ((leaving)))
    (let* ((pressed (inputs-until c end))
           (moved (stick-input! c))
           (steps (if (cockpit-paused? c) 0 (steps-due! c))))
      (append pressed moved (if (positive? steps) (list (list 'pass steps)) '())))))

(define (flight-asker c)
  ;; A procedure that returns the next input of a pupil at the sticks.
  (let ((waiting '()))
    (lambda ()
      (let loop ()
        (if (pair? waiting)
            (let ((input (car waiting)))
              (set! waiting (cdr waiting))
              input)
            (begin
              (set! waiting (frame-inputs! c))
              (loop)))))))

(define few 2)                          ; lines that are heard; more stand on a page

(define (show-result! c lines)
  (if (> (length lines) few)
      (show-lines! lines)
      (for-each (lambda (line) (hear! #xffffff line)) lines))
  (when (pair? lines)
    (ask-anew! c)
    (set-stepped! c (clock))))

(define (take-seat! c)
  (keep-up!)
  (set-view! c (or (one-view) (seat-view (the-seat))))
  (set-map! c (not (hard?)))
  (set-sticks! c (new-sticks))
  (set-sent! c (stick-values (new-sticks)))
  (drop-ghost! c)
  (set-paused! c #f)
  (set-stepped! c (clock)))

(define (fly-in-cockpit n seconds)
  "Let the pupil fly task N until it is over."
  (let ((c (this-cockpit)))
    (catch-up!)
    (read-what-was-said!)
    (take-seat! c)
    (show-page! (list (string-append "TASK: " (task-text))) "Enter begins   ? in flight shows the keys   q leaves")
    (set-stepped! c (clock))
    (dynamic-wind
      (const #t)
      (lambda ()
        (let ((ask (flight-asker c)))
          (let loop ()
            (show-result! c (apply-input! (next-input ask)))
            (loop))))
      (lambda () (set-seat-view! (the-seat) (if (one-view) 'chase (cockpit-view c)))))))


;;; A task that failed.

(define (ask-what-next)
  (turn-page (in-order (append '("u: go back ten seconds    a: begin the task again    e: end the lesson")
                               (seat-texts (the-seat))))
             "u, a or e   q leaves, to go on later"
             (lambda (key)
               (case key
                 ((#\u) '(failed back))
                 ((#\a) '(failed again))
                 ((#\e) '(failed end))
                 ((#\q #\etx #\eot) ((leaving)))
                 (else (view-key-here! key) #f)))))

(define (failed-in-cockpit text)
  "Ask the pupil what to do after a task that ended by TEXT."
  (let ((choice (second (next-input ask-what-next))))
    (set-texts! (the-seat) '())
    choice))
