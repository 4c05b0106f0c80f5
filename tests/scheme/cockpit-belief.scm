;;; The belief that a cockpit shows: its line and its tubes in picture, plain characters and map, its alarms, and that
;;; neither the dive nor the belief is another for being looked at.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight cockpit)
             ((bight cockpit view-keys) #:select (view-key!))
             (bight cockpit believed)
             (bight cockpit cells)
             (bight cockpit hud)
             (bight cockpit state)
             ((bight dive) #:select (fork-dive))
             (ice-9 regex)
             (srfi srfi-1))

(define beside-a-post
  (with (find-world (string-append (dirname (dirname (dirname (current-filename)))) "/testbed/worlds/beside-a-post.scm")
              #:trust #t)
    (line (length 20))))

(define-belief doubtful
  "The current, and the drag of the line."
  (current (error 0.2) (levels 0 -20) (correlation 20))
  (line (cdn (uniform 1 1.6))))

(define (cockpit-in palette)
  (let ((c (new-cockpit palette 'top 'plain)))
    (board! c (current-dive))
    (fit-to-size! c '(100 . 36))
    c))

(define (bytes-of-a-frame c)
  ;; What is written of a frame, the belief flown on to now and asked, whatever the time.
  (when (current-belief) (effective-size))
  (set-believed-due! c 0)
  (look-at-belief! c)
  (set-characters! c '(() . 0))
  (set-plan-due! c 0)
  (compose-frame! c "hint")
  (%screen-bytes (cockpit-screen c) #t))

(define (text-of-a-frame c)
  (regexp-substitute/global #f "\x1b\\[[0-9;?]*[a-zA-Z]" (bytes-of-a-frame c) 'pre " " 'post))

(define (marks-in text) (string-count text (char-set #\: #\.)))

(define (colours-in bytes)
  ;; Looked for between one escape and the next: each match in a text copies what is left of the text.
  (let ((seen (make-hash-table)))
    (for-each (lambda (piece)
                (for-each (lambda (m) (hash-set! seen (match:substring m) #t))
                          (list-matches "[34]8;2;[0-9]+;[0-9]+;[0-9]+" piece)))
              (string-split bytes #\esc))
    (hash-count (const #t) seen)))

(define-scenario the-line-and-the-tubes-are-shown
  "In plain characters the line and the tubes are there while the belief is shown, and are not after its key."
  (in beside-a-post)
  (let ((c (cockpit-in 'none)))
    (run 5)
    (let ((without (text-of-a-frame c)))
      (expect (string-contains without "P(wound)") => #f)
      (believe! doubtful #:members 8)
      (run 5)
      (let ((with (text-of-a-frame c)))
        (expect (string-match "P\\(wound\\) 0.0 \\(0.0 to 0.3[0-9]\\) of 8 tethers" with) is regexp-match?)
        (expect (- (marks-in with) (marks-in without)) is (above 10)))
      (expect (view-key! c #\c) => #t)
      (let ((again (text-of-a-frame c)))
        (expect (string-contains again "P(wound)") => #f)
        (expect (abs (- (marks-in again) (marks-in without))) is (below 3))))))

(define-scenario the-picture-and-the-map-have-the-tubes
  "The tubes blend into a picture in colours, which has more of them then; the map has the marks of plain characters."
  (in beside-a-post)
  (believe! doubtful #:members 8)
  (run 5)
  (let* ((c (cockpit-in 'true))
         (with (begin (fit-to-size! c '(160 . 50)) (set-map! c #t) (bytes-of-a-frame c)))
         (map-with (string-concatenate (cockpit-plan c))))
    (toggle-belief! c)
    (let ((without (bytes-of-a-frame c)))
      (expect (- (marks-in map-with) (marks-in (string-concatenate (cockpit-plan c)))) is (above 2))
      (unless (cockpit-plain? c)        ; there is a renderer
        (expect (- (colours-in with) (colours-in without)) is (above 10))))))

(define-scenario looking-changes-nothing
  "The dive is the same to the last bit, and so is the belief, looked at in every half second or once."
  (in beside-a-post)
  (define (flown looks?)
    (what-if
     (let ((b (make-belief (current-dive) doubtful #:members 8)) (c (cockpit-in 'none)))
       (parameterize ((current-belief b))
         (drive! #:surge 0.5)
         (do ((k 0 (+ k 1))) ((= k 10))
           (run 0.5)
           (when looks? (bytes-of-a-frame c)))
         (list (state-hash) (belief-hash b))))))
  (expect (flown #t) => (flown #f)))

(define-scenario an-alarm-is-told-once
  "As the vehicle winds the line about the post the probability rises: told once, and not by the next frame."
  (in beside-a-post)
  (believe! doubtful #:members 8)
  (let ((c (cockpit-in 'none)))
    (bytes-of-a-frame c)
    (expect (belief-alarm! c) => #f)
    (for-each (lambda (place) (move! place #:speed 1) (run 8) (bytes-of-a-frame c)) '((8 12 -8) (8 5 -8)))
    (expect (string-match "^BELIEF: P\\(wound\\) [01].[0-9]* and rising$" (belief-alarm! c)) is regexp-match?)
    (expect (belief-alarm! c) => #f)
    (bytes-of-a-frame c)
    (expect (belief-alarm! c) => #f)))

(define-scenario only-the-belief-of-the-dive-is-shown
  "Not that of another dive, nothing where the line is not to be seen, and no more once the dive is before its belief."
  (in beside-a-post)
  (run 2)
  (believe! doubtful #:members 8)
  (let ((c (cockpit-in 'none)))
    (run 1)
    (bytes-of-a-frame c)
    (expect (length (believed-lines c)) => 1)
    (expect (string-contains (car (believed-lines c)) "ago") => #f)
    (run 4)
    (expect (string-contains (car (believed-lines c)) ", 4 s ago") is number?)
    (parameterize ((unseen? (lambda (verb) (eq? verb 'tether-points))))
      (expect (believed-lines c) => '()))
    (board! c (fork-dive (current-dive)))
    (bytes-of-a-frame c)
    (expect (believed-lines c) => '())
    (board! c (current-dive))
    (rewind! 6)
    (set-believed-due! c 0)
    (look-at-belief! c)
    (expect (believed-lines c) => '())
    (expect (string-contains (cockpit-message c) "believe anew") is number?)))
