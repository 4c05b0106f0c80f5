;;; Flying in a terminal, without one: keys, sticks, the display, and what is written to a screen.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight cockpit)
             ((bight cockpit page) #:select (first-page last-lines))
             (bight cockpit cells)
             (bight cockpit palette)
             (bight cockpit desk)
             (bight cockpit hud)
             (bight cockpit keyboard)
             (bight cockpit keys)
             (bight cockpit line)
             (bight cockpit sequences)
             (bight cockpit state)
             (bight cockpit view)
             ((bight cockpit view-keys) #:select (view-key!))
             ((bight lesson flying) #:select (lesson-panel))
             (ice-9 regex)
             (rnrs bytevectors)
             (srfi srfi-1))

(define (keys-of text)
  (bytes->keys (map char->integer (string->list text))))

(define-scenario keys-are-told-apart
  "Letters, arrows in both their forms, and sequences that are no key of ours."
  (in open-water)
  (expect (keys-of "wW") => '(#\w #\W))
  (expect (keys-of "\x1b[A\x1bOB") => '(up down))
  (expect (keys-of "\x1b[1;5Hq") => '(#\q))
  (expect (keys-of "\x1b[15~q") => '(#\q))
  (expect (keys-of "\x1bx") => '(escape #\x))
  (expect (bytes->keys '(195 164 113)) => '(#\q)))

(define-scenario sticks-are-held-and-nudged
  "A key holds its stick while it repeats; with shift it stays where it was put, at most full."
  (in open-water)
  (let ((pressed (press (new-sticks) 0 1 10)))
    (expect (stick-values pressed) => '(1.0 0.0 0.0 0.0))
    (expect (stick-values (settle pressed 10.5)) => '(1.0 0.0 0.0 0.0))
    (expect (stick-values (settle pressed 10.6)) => '(0.0 0.0 0.0 0.0))
    (expect (stick-values (settle (press pressed 0 1 10.5) 10.65)) => '(1.0 0.0 0.0 0.0))
    (expect (stick-values (settle (press pressed 0 1 10.5) 10.7)) => '(0.0 0.0 0.0 0.0))
    (expect (stick-values (press pressed 0 -1 10.2)) => '(-1.0 0.0 0.0 0.0)))
  (let ((put (fold (lambda (i sticks) (nudge sticks 3 1/10)) (new-sticks) (iota 12))))
    (expect (stick-values put) => '(0.0 0.0 0.0 1.0))
    (expect (stick-values (settle (press put 3 -1 0) 0.1)) => '(0.0 0.0 0.0 -1.0))
    (expect (stick-values (settle (press put 3 -1 0) 1)) => '(0.0 0.0 0.0 1.0)))
  (expect (nudge-of-key #\D) => '(3 . 1/10))
  (expect (nudge-of-key #\Q) => #f))

(define-scenario releases-and-the-mouse-are-told-apart
  "Keys by kitty's protocol with their repeats and releases, the mouse by xterm's, and what is neither."
  (in open-water)
  (expect (keys-of "\x1b[119u\x1b[119;1:2u\x1b[119;1:3u") => '(#\w #\w (release #\w)))
  (expect (keys-of "\x1b[119:87;2:2u\x1b[91:123;2u") => '(#\W #\{))
  (expect (keys-of "\x1b[119;2u") => '(#\W))
  (expect (keys-of "\x1b[99;5u\x1b[27u\x1b[13u\x1b[127u") => '(#\etx escape #\return #\delete))
  (expect (keys-of "\x1b[1;1:1A\x1b[1;1:3D\x1b[A") => '(up (release left) up))
  (expect (keys-of "\x1b[57441;2u\x1b[;;u\x1b[u\x1b[-1u\x1b[119;0uq") => '(#\q))
  (expect (keys-of "\x1b[?7u\x1b[?1u\x1b[O\x1b[I") => '(releases unfocused))
  (expect (keys-of "\x1b[<0;3;5M\x1b[<32;4;6M\x1b[<0;4;6m\x1b[<64;1;1M\x1b[<65;1;1M\x1b[<2;1;1M\x1b[<0;1Mq")
          => '((mouse press 2 4) (mouse drag 3 5) (mouse release 3 5) (mouse nearer 0 0) (mouse further 0 0) #\q)))

(define-scenario what-is-pasted-is-a-text
  "Wherever the terminal's answers are cut in two: one line takes all of it, and no key of the flight comes of it."
  (in open-water)
  (let* ((text (string-append "(a b)\rq " (make-string 10240 #\x) "\x7f\n:")) (flat (string-append "(a b) q " (make-string 10240 #\x) "   "))
         (keys (keys-of (string-append "w\x1b[200~" text "\x1b[201~q"))))
    (define (gathered . chunks)
      (let loop ((chunks chunks) (within? #f) (all '()))
        (if (null? chunks)
            (list all within?)
            (call-with-values (lambda () (gather-pasted (car chunks) within?))
              (lambda (keys more?) (loop (cdr chunks) more? (append all keys)))))))
    (define (pasted keys) (string-concatenate (map second (filter pair? keys))))
    (for-each
     (lambda (at)
       (call-with-values (lambda () (split-at keys at))
         (lambda (one other)
           (let ((all (gathered one other)))
             (expect (second all) => #f)
             (expect (filter char? (first all)) => '(#\w #\q))
             (expect (pasted (first all)) => (string-append (string-drop-right flat 1) ":"))))))
     (list 0 1 2 3 5000 (- (length keys) 2) (- (length keys) 1) (length keys)))
    (expect (gathered (keys-of "\x1b[200~q")) => '(((pasted "q")) #t))
    (expect (gathered (keys-of "\x1b[200~q\x03w")) => '(((pasted "q") #\w) #f))
    (expect (gathered (keys-of "\x1b[201~q")) => '((pasted #\q) #f))
    (let ((line (edit-line (edit-line (line-of "ab") 'left) (list 'pasted flat))))
      (expect (line-text line) => (string-append "a" flat "b"))
      (expect (line-text (edit-line line #\backspace)) => (string-append "a" (string-drop-right flat 1) "b")))))

(define-scenario a-line-is-seen-in-any-width
  "Label and line never take more than the screen has, the cursor among them from six columns up."
  (in open-water)
  (for-each
   (lambda (label)
     (for-each
      (lambda (line)
        (for-each (lambda (columns)
                    (let ((shown (prompt-shown label line columns)))
                      (expect (<= (string-length shown) (max 3 (- columns 2))) => #t)
                      (expect (or (< columns 6) (string-index shown #\_)) is identity)))
                  (iota 120)))
      (list (line-of "") (line-of "(drive! #:surge 0.5)") (edit-line (line-of (make-string 10240 #\x)) #\soh)
            (line-of (make-string 10240 #\x)))))
   '("> " "a bearing, degrees> " "adrift: an obstacle, m/s and the degrees it drifts to> ")))

(define-scenario pages-hold-all-that-is-said
  "In order, on lines that fit; running text is never as wide as a drawing, and the end is seen where it matters."
  (in open-water)
  (let* ((drawing "1  43 s  a line in columns, which is as long as it is, and so is this one of eighty columns or more  9")
         (texts (append (list "First.  Then a sentence behind two blanks,\nand a line\nthat is broken." "" drawing "")
                        (append-map (lambda (i) (list (simple-format #f "Text ~a of many, which is not long.  But it ends." i) ""))
                                    (iota 40))))
         (words (lambda (lines) (append-map string-tokenize lines))))
    (define (all-pages lines)
      (call-with-values (lambda () (first-page lines))
        (lambda (page rest) (if (null? rest) (list page) (cons page (all-pages rest))))))
    (let ((pages (all-pages texts)))
      (expect (length pages) is (above 3))
      (expect (words (concatenate pages)) => (words texts))
      (when (>= (car (%screen-size)) 80)
        (expect (first (first pages)) => "First. Then a sentence behind two blanks, and a line that is broken."))
      (expect (filter (lambda (line) (> (string-length line) (- (car (%screen-size)) 4))) (concatenate pages)) => '())
      (expect (last (last-lines texts)) => "")
      (expect (length (last-lines texts)) => (length (first pages))))))

(define-scenario a-cockpit-begins-with-nothing
  "No terminal is believed to tell of releases before it says so; nothing is turned, sent, dark or left to draw."
  (in open-water)
  (let ((c (new-cockpit 'many 'side 'tension)))
    (expect (list (cockpit-view c) (cockpit-paint c) (cockpit-palette c)) => '(side tension many))
    (expect (map (lambda (f) (f c)) (list cockpit-releases? cockpit-orbit cockpit-held-at cockpit-sent cockpit-live?
                                          cockpit-panel cockpit-dark? cockpit-ghost cockpit-paused? cockpit-done?))
            => (make-list 10 #f))
    (expect (cockpit-characters c) => '(() . 0))
    (expect (list (cockpit-labels c) ((cockpit-targets c))) => '(() ()))
    (expect (cockpit-stepped c) is (above 0))))

(define-scenario keys-that-are-told-to-come-up-hold-until-then
  "Two at once, for as long as they are down; what comes up lets go of its own alone; losing the focus lets go of all."
  (in open-water)
  (let* ((one (press (new-sticks) 0 1 10 #t)) (two (press one 3 -1 11 #t)))
    (expect (stick-values (settle two 500)) => '(1.0 0.0 0.0 -1.0))
    (expect (stick-values (let-up two 0 1)) => '(0.0 0.0 0.0 -1.0))
    (expect (stick-values (let-up two 0 -1)) => '(1.0 0.0 0.0 -1.0))
    (expect (stick-values (let-all-up (nudge two 2 1/10))) => '(0.0 0.0 0.1 0.0))
    (expect (stick-values (settle (press (let-up one 0 1) 0 1 20) 20.6)) => '(0.0 0.0 0.0 0.0))))

(define-scenario the-tape-turns
  "The heading stands in the middle of its tape, whatever it is."
  (in open-water)
  (expect (string-ref (heading-tape 0 61) 30) => #\N)
  (expect (string-ref (heading-tape 270.0 61) 30) => #\W)
  (expect (substring (heading-tape 30 61) 29 32) => "030")
  (expect (string-contains (heading-tape 359.9 61) " N ") => 29)
  (expect (string-contains (heading-tape 6 61) " N ") => 27)
  (for-each (lambda (heading) (expect (string-length (heading-tape heading 20)) => 20))
            (iota 40 0.0 9.7)))

(define-scenario palettes-follow-the-terminal
  "What a terminal says of itself chooses its colours."
  (in open-water)
  (expect (palette-of "xterm-256color" "truecolor" #f) => 'true)
  (expect (palette-of "tmux-256color" #f #f) => 'many)
  (expect (palette-of "xterm" #f "") => 'few)
  (expect (palette-of "vt100" #f #f) => 'none)
  (expect (palette-of "xterm-256color" "truecolor" "1") => 'none))

(define (pixels columns rows color-of)
  "Return a picture for COLUMNS by ROWS cells; COLOR-OF is called with x and y."
  (let ((bytes (make-bytevector (* 8 columns rows))))
    (do ((i 0 (+ i 1)))
        ((= i (* 2 columns rows)) bytes)
      (bytevector-u32-native-set! bytes (* 4 i)
                                  (color-of (remainder i columns) (quotient i columns))))))

(define (half? x y) (if (even? y) #xff0000 #x0000ff))

(define-scenario only-what-changed-is-written
  "Nothing twice; one cell for one pixel; everything when asked."
  (in open-water)
  (let ((screen (%make-screen 20 5 'true)))
    (%screen-picture! screen (pixels 20 5 half?))
    (let ((all (%screen-bytes screen #t)))
      (expect (string-count all #\▀) => 100)
      (expect (->bool (string-contains all "\x1b[38;2;255;0;0m")) => #t)
      (expect (->bool (string-contains all "\x1b[48;2;0;0;255m")) => #t))
    (expect (%screen-bytes screen #f) => "")
    (%screen-picture! screen (pixels 20 5 (lambda (x y) (if (and (= x 3) (= y 4)) #x00ff00 (half? x y)))))
    (let ((one (%screen-bytes screen #f)))
      (expect (string-count one #\▀) => 1)
      (expect (->bool (string-contains one "\x1b[3;4H")) => #t))
    (%screen-picture! screen (pixels 20 5 (lambda (x y) (logxor 2 (half? x y)))))
    (expect (string-count (%screen-bytes screen #f) #\▀) => 1) ; back, and no more for a shade
    (%screen-text! screen 18 1 "längs" #xffffff 0)
    (%screen-text! screen -2 9 "outside" #xffffff 0)
    (expect (->bool (string-contains (%screen-bytes screen #f) "lä")) => #t)))

(define-scenario colors-are-those-there-are
  "In 256 and in 16 colours each is the nearest; without, light and dark are letters."
  (in open-water)
  (define (bytes-in palette color)
    ;; In sixteen colours a picture is stretched; what stands behind a word is not.
    (let ((screen (%make-screen 2 1 palette)))
      (if (eq? palette 'few)
          (%screen-text! screen 0 0 "  " #xffffff color)
          (%screen-picture! screen (pixels 2 1 (lambda (x y) color))))
      (%screen-bytes screen #t)))
  (expect (->bool (string-contains (bytes-in 'many #xff0000) "\x1b[48;5;196m")) => #t)
  (expect (->bool (string-contains (bytes-in 'many #x808080) "\x1b[48;5;244m")) => #t)
  (expect (->bool (string-contains (bytes-in 'few #xff0000) "\x1b[101m")) => #t)
  (expect (->bool (string-contains (bytes-in 'few #x0000e0) "\x1b[44m")) => #t)
  (expect (->bool (string-contains (bytes-in 'none #xffffff) "@@")) => #t)
  (expect (string-match "\x1b\\[[0-9;]*[1-9]m" (bytes-in 'none #xffffff)) => #f))

;; A jacket in the sea as it is drawn: greys and blues of a quarter of the light there could be.
(define (murky x y)
  (if (< 3 x 7) #x3a4446 #x0b2a38))

(define-scenario sixteen-colors-show-what-stands-in-murky-water
  "What is hardly lighter than the sea has other cells than the sea, and the sea is not black."
  (in open-water)
  (let ((screen (%make-screen 12 4 'few)))
    (%screen-picture! screen (pixels 12 4 murky))
    (let* ((rows (cdr (string-split (%screen-bytes screen #t) #\H)))
           (leg (map match:substring (list-matches "\x1b\\[[0-9]*m" (car rows)))))
      (expect (length (delete-duplicates leg)) is (above 2)))))

(define-scenario ascii-terminals-get-ascii
  "Where letters are not UTF-8 nothing else is written, in whatever colours."
  (in open-water)
  (for-each
   (lambda (palette)
     (let ((screen (%make-screen 30 8 palette #t)))
       (%screen-picture! screen (pixels 30 8 half?))
       (%screen-text! screen 2 2 "längs ▀" #xffffff #f)
       (expect (string-every char-set:ascii (%screen-bytes screen #t)))))
   '(none few many true)))

;; What a display of a lesson has above it, and the worst that a flight can tell of.
(define busy-slow
  '((slack . 0.123) (windings "jacket: leg-a1 +1, leg-a2 -1 and 3 more" "p1 +2" "p2 -1") (contacts . 3)
    (warnings "TETHER PARTED" "FOULED: wound round it" "HELD BACK")))

(define busy-state
  `((title . "a-world-with-a-long-name  1234.5 s") (right . "PAUSED  what if  lights  overview  tension  30/s")
    (message . ,(make-string 200 #\m)) (urgent? . #t) (sticks . (0.5 0.0 -1.0 0.0))
    (words . "Home: north and east round leg-a2 of jacket, then straight south-west 17 m, across the current; pay out 3 m first.")
    (ahead "string touches jacket/leg-a1 in 3 s" "tether taut in 12 s") (top . 2)))

(define (writes-on columns rows through)
  "Return how often the cell written most often is, and the texts; THROUGH makes the procedure that puts texts."
  (let ((cells (make-array 0 rows columns)) (texts '()))
    (draw-hud (through (lambda (column row text ink paper)
                         (set! texts (cons text texts))
                         (do ((i 0 (+ i 1))) ((= i (string-length text)))
                           (when (array-in-bounds? cells row (+ column i))
                             (array-set! cells (+ 1 (array-ref cells row (+ column i))) row (+ column i))))))
              columns rows (read-figures 'minnow 'line) busy-slow busy-state)
    (list (apply max (concatenate (array->list cells))) texts)))

(define-scenario no-text-is-written-over-another
  "In any window from 30 by 8 up every cell is written once at most; the message, the title and the depth are always there."
  (in pier)
  (define (by-desk columns rows) (lambda (put) (desk columns rows put)))
  (for-each
   (lambda (columns)
     (for-each
      (lambda (rows)
        (let ((written (writes-on columns rows (by-desk columns rows))))
          (require (first written) => 1)
          (require (any (lambda (text) (string-prefix? " mmm" text)) (second written)))
          (require (any (lambda (text) (string-prefix? " a-world" text)) (second written)))
          (require (any (lambda (text) (string-contains text "depth")) (second written)))
          (require (any (lambda (text) (string-contains text "TETHER PARTED")) (second written)))))
      (append (iota 30 8) '(50 80))))
   (append (iota 70 30 2) '(200 250)))
  ;; Without a desk there are such.
  (expect (first (writes-on 40 10 (lambda (put) put))) is (above 1)))

(define-scenario no-map-hides-a-warning
  "What to beware of stands beside what was put before it, in the middle or at the left, unless all of the row is taken."
  (in pier)
  (let* ((shown '()) (put (desk 80 24 (lambda (column row text ink paper) (set! shown (cons text shown)))))
         (ahead "string touches jacket/brace-1-2-2 in 7 s"))
    (do ((row 2 (+ row 1))) ((= row 11)) (put 58 row (make-string 22 #\-) 0 0))
    (draw-hud put 80 24 (read-figures 'minnow 'line) '((windings) (warnings "FOULED: hung about a leg of the jacket, and wound"))
              `((title . "t") (right . "r") (message . "m") (urgent? . #f) (sticks . (0 0 0 0)) (ahead . (,ahead "soon"))))
    (for-each (lambda (text) (expect (any (lambda (s) (string-contains s text)) shown) is identity))
              (list "FOULED: hung about a leg of the jacket, and wound" ahead "soon"))))

(define (draw-on columns rows)
  "Return the lines of a display of the present dive."
  (let ((lines (map (lambda (i) (make-string columns #\space)) (iota rows))))
    (draw-hud (lambda (column row text ink paper)
                (string-for-each-index
                 (lambda (i)
                   (let ((x (+ column i)))
                     (when (and (< -1 x columns) (< -1 row rows))
                       (string-set! (list-ref lines row) x (string-ref text i)))))
                 text))
              columns rows
              (read-figures 'minnow 'line) (slow-figures 'minnow 'line)
              '((title . "t") (right . "r") (message . "m") (urgent? . #f) (sticks . (0.5 0.0 -1.0 0.0))))
    lines))

(define (string-for-each-index proc text)
  (for-each proc (iota (string-length text))))

(define-scenario the-display-tells-the-figures
  "Of the dive as it is, in windows large and small."
  (in pier)
  (for-each
   (lambda (size)
     (let ((text (string-join (apply draw-on size) "\n")))
       (expect (->bool (string-match "depth +4.00 m" text)) => #t)
       (expect (->bool (string-match "out +35.00 m" text)) => #t)
       (expect (->bool (string-match "surge \\+0.5 .*heave -1.0" text)) => #t)))
   '((80 24) (120 40) (250 80)))
  (expect (list? (draw-on 20 5)) => #t))

(define-scenario what-a-pilot-does-not-see-is-not-told
  "Where a pilot does not see what the tether is wound round, the display does not say that it is round nothing."
  (in pier)
  (expect (->bool (string-match "wound +no" (string-join (draw-on 80 24) "\n"))) => #t)
  (parameterize ((unseen? (lambda (verb) (eq? verb 'windings))))
    (expect (->bool (string-match "wound +-" (string-join (draw-on 80 24) "\n"))) => #t)
    (expect (list? (draw-on 30 8)) => #t)))

(define-scenario a-sonar-needs-no-light
  "6 shows what a sonar hears, in the dark too; where a lesson hides the sonar, 6 and v do not show it."
  (in pier)
  (let ((c (new-cockpit 'true 'chase 'plain)))
    (define (drawn)
      (compose-frame! c "hint")
      (%screen-bytes (cockpit-screen c) #t))
    (define (press-all . keys) (for-each (lambda (key) (view-key! c key)) keys) (cockpit-view c))
    (board! c (current-dive))
    (fit-to-size! c '(80 . 24))
    (expect (press-all #\6) => 'sonar)
    (let ((lit (drawn)))
      (set-dark! c #t)
      (expect (bytevector-length (string->utf8 (drawn))) is (above (* 1/2 (bytevector-length (string->utf8 lit)))))
      (press-all #\1)
      (expect (bytevector-length (string->utf8 (drawn))) is (below (* 1/2 (bytevector-length (string->utf8 lit))))))
    (expect (press-all #\5 #\v #\v) => 'chase)
    (parameterize ((unseen? (lambda (verb) (eq? verb 'sonar))))
      (expect (press-all #\6) => 'chase)
      (expect (press-all #\5 #\v) => 'chase))))

;; Whoever owns the cockpit.
(define-scenario help-tells-the-keys-there-are
  "In a flight those of a flight; of another owner his own; in a small window page by page, nothing cut off."
  (in pier)
  (let ((c (new-cockpit 'none 'chase 'plain)))
    (define (help . told)
      (let ((written (begin (compose-frame! c "hint") (%screen-bytes (cockpit-screen c) #t))))
        (map (lambda (text) (->bool (string-contains written text))) told)))
    (board! c (current-dive))
    (fit-to-size! c '(80 . 24))
    (turn-help! c)
    (expect (help "ahead, astern" "my own key") => '(#t #f))
    (parameterize ((keys-told '(("x" . "my own key"))))
      (expect (help "ahead, astern" "my own key") => '(#f #t))
      (turn-help! c)
      (expect (help "my own key") => '(#f)))
    (fit-to-size! c '(30 . 8))
    (expect (let loop ((pages 0) (first? #f) (last? #f))
              (turn-help! c)
              (if (help-lines c)
                  (loop (+ pages 1) (or first? (car (help "ahead, astern"))) (or last? (car (help "this; leave"))))
                  (list (> pages 1) first? last?)))
            => '(#t #t #t))))

(define (words-of lines)
  (append-map string-tokenize lines))

(define-scenario help-loses-no-word-in-a-narrow-window
  "Sentences are wrapped beside their keys; each page fits, and all pages hold all words."
  (in open-water)
  (for-each
   (lambda (columns height)
     (let ((pages (let loop ((i 0))
                    (let ((page (keys-page columns height i)))
                      (if page (cons page (loop (+ i 1))) '())))))
       (expect (and-map (lambda (page)
                          (and (<= (length page) height)
                               (and-map (lambda (line) (<= (string-length line) columns)) page)))
                        pages)
               => #t)
       (expect (lset-difference string=?
                                (words-of (append-map (lambda (row) (list (car row) (cdr row))) (keys-told)))
                                (words-of (concatenate pages)))
               => '())))
   '(26 36 76 116) '(6 10 22 38)))

(define-scenario what-is-heard-is-read-in-a-tiny-window
  "In a window of 30 by 8 a hint stands whole, in place of the task."
  (let ((lines '()))
    (define (panel heard)
      (set! lines '())
      ((lesson-panel "Get slack, then turn to south, and hold that." heard '() '("1.3 s"))
       (lambda (column row text ink paper) (set! lines (cons (string-trim-both text) lines))) 30 8))
    (expect (panel '()) => 4)
    (expect (reverse lines) => '("Get slack, then turn to so.." "1.3 s"))
    (expect (panel '((0 . "Hint: At the end of its tether a vehicle cannot turn: first make slack.") (0 . "Coach: before."))) => 5)
    (expect (reverse lines) => '("Hint: At the end of its" "tether a vehicle cannot" "turn: first make slack."))))

(define-scenario what-is-to-come-is-foretold
  "On course for a pile the display says so, with the seconds; standing still it says nothing."
  (in pier)
  (expect (forecast 'line) => '())
  (expect (forecast #f) => '())
  (drive! #:surge 0.8)
  (run 3)
  (let* ((foretold (forecast 'line)) (said '())
         (put (lambda (column row text ink paper) (set! said (cons text said)))))
    (expect (length foretold) is (between 1 2))
    (expect (->bool (string-match "(meets|touches) pier/.* in [0-9]+ s$" (car foretold))) => #t)
    (draw-hud put 80 24 (read-figures 'minnow 'line) '((windings) (warnings "TAUT"))
              `((title . "t") (right . "r") (message . "m") (urgent? . #f) (sticks . (0 0 0 0))
                (ahead . ,foretold)))
    (expect (->bool (member "  TAUT  " said)) => #t)
    (expect (->bool (member (string-append "  " (car foretold) "  ") said)) => #t)))

(define-scenario a-dive-is-flown-in-a-terminal-alone
  "Without one nothing begins."
  (in open-water)
  (expect (with-input-from-file "/dev/null" (lambda () (pilot! #:colors 'many))) raises unsupported)
  (expect (live?) => #f)
  (expect (pilot! #:view 'plan) raises name))
