;;; Texts over pictures never meet, in a frame of the cockpit and on a picture in a file, whatever stands in the world,
;;; whatever is told of it, and in whatever window.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight cockpit)
             (bight cockpit cells)
             (bight cockpit state)
             (bight core errors)
             ((bight dive) #:select (this-engine))
             ((bight lesson flying) #:select (lesson-panel target-line))
             (bight view picture)
             (srfi srfi-1))

(define no-picture
  ;; Why there are none, or #f.
  (with-exception-handler (lambda (e) (if (bight-error? e) (bight-error-message e) (raise-exception e)))
    (lambda () (renderer-name) #f)
    #:unwind? #t))

(define (enter-or-none! world)
  ;; A random world that is refused is no case.
  (assume (with-exception-handler (lambda (e) (if (bight-error? e) #f (raise-exception e)))
            (lambda () (enter! world) #t)
            #:unwind? #t)))


;;; A frame of the cockpit.

(define words "Go round the far leg, keeping the line clear of the braces, and come home by the way that you went out by.")

(define (texts-of-frame c)
  "Compose a frame of C; return the texts it put over its picture: lists of column, row and text."
  (let* ((put (module-variable (resolve-module '(bight cockpit)) '%screen-text!)) (before (variable-ref put)) (texts '()))
    (dynamic-wind
      (lambda ()
        (variable-set! put (lambda (screen column row text ink paper)
                             (set! texts (cons (list column row text) texts))
                             (before screen column row text ink paper))))
      (lambda () (compose-frame! c "w s a d i k j l sticks  v view  [ ] winch  p pause  ? keys  : prompt  q quit"))
      (lambda () (variable-set! put before)))
    texts))

(define (cells-of text)
  (map (lambda (i) (cons (+ i (first text)) (second text))) (iota (string-length (third text)))))

(define (wrong-among texts columns rows)
  ;; Those that lie on another, or outside.
  (let ((taken (make-hash-table)))
    (filter (lambda (text)
              (any (lambda (cell)
                     (or (hash-ref taken cell) (not (< -1 (car cell) columns)) (not (< -1 (cdr cell) rows))
                         (begin (hash-set! taken cell #t) #f)))
                   (cells-of text)))
            texts)))

(define (glued texts)
  ;; Pairs of those of which one begins where the other ends, so that they read as one word.
  (append-map (lambda (a)
                (filter-map (lambda (b)
                              (and (= (second a) (second b)) (= (first b) (+ (first a) (string-length (third a))))
                                   (not (string-suffix? " " (third a))) (not (string-prefix? " " (third b)))
                                   (list (third a) (third b))))
                            texts))
              texts))

(define (told? texts part)
  (any (lambda (text) (string-contains (third text) part)) texts))

(define-property no-text-of-a-frame-meets-another
  "Figures, panel, map, help, targets beside each other, and what is to be beware of, in random worlds and windows from 30 by 8
up; the title and the last line are always there."
  #:for ((world (random-world))
         (places (list-of (point-in '(-9 -9 -12) '(9 9 -2)) #:most 12))
         (view (one-of 'chase 'pilot 'top 'side 'overview 'sonar))
         (columns (integer 30 160))
         (rows (integer 8 60))
         (panel? (one-of #f #t))
         (help? (one-of #f #t)))
  #:cases 60
  (if no-picture
      (skip no-picture)
      (let ((c (new-cockpit 'true view 'plain)) (n (length places)))
        (enter-or-none! world)
        (board! c (current-dive))
        (fit-to-size! c (cons columns rows))
        (set-targets! c (lambda () (map (lambda (i p) (target (string-append "target " (number->string i)) p)) (iota n) places)))
        (when panel?
          (set-panel! c (lesson-panel words (list (cons #xffd84a words)) (map target-line ((cockpit-targets c)) (iota n))
                                      '("0:24  touches 0"))))
        (when help? (turn-help! c))
        (announce! c words 1e6)
        (compose-frame! c "") ; what is asked now and then is asked in one frame or the next
        (let ((texts (texts-of-frame c)))
          (expect (wrong-among texts columns rows) => '())
          (expect (glued texts) => '())
          (expect (told? texts (substring words 0 20)))
          (expect (told? texts (if (< columns 40) " " " s ")))))))


;;; A picture in a file.

(define (written title view size paint flags)
  ;; Boxes (X Y WIDTH HEIGHT) of what is written on a picture of the dive.
  ((module-ref (resolve-interface '(bight view render)) '%written) (this-engine 'test) title view size paint flags))

(define (overlap? a b)
  (define (share x w y v) (- (min (+ x w) (+ y v)) (max x y)))
  (and (> (share (first a) (third a) (first b) (third b)) 0.01)
       (> (share (second a) (fourth a) (second b) (fourth b)) 0.01)))

(define (wrong-boxes boxes width height)
  ;; Pairs that overlap, and boxes outside.
  (append (append-map (lambda (rest) (filter-map (lambda (b) (and (overlap? (car rest) b) (list (car rest) b))) (cdr rest)))
                      (filter pair? (map (lambda (i) (list-tail boxes i)) (iota (length boxes)))))
          (filter (lambda (b) (or (< (first b) 0) (< (second b) 0) (> (+ (first b) (third b)) width)
                                  (> (+ (second b) (fourth b)) height)))
                  boxes)))

(define-property nothing-on-a-picture-meets-anything-else
  "Title, figures, bars, names, contacts and turns, in random worlds, by any view and at any size."
  #:for ((world (random-world))
         (view (one-of 'overview 'chase 'pilot 'top 'side))
         (zoom (uniform 0.3 6))
         (turn (uniform 0 360))
         (width (integer 64 1400))
         (height (integer 64 900))
         (paint (one-of 'plain 'tension 'curvature 'model)))
  #:cases 60
  (if no-picture
      (skip no-picture)
      (begin
        (enter-or-none! world)
        (let ((boxes (written "A world of chance" (if (eq? view 'overview) (list view #f 0 zoom turn 30.) view)
                              (cons width height) paint '(figures contacts turns))))
          (expect (wrong-boxes boxes width height) => '())))))
