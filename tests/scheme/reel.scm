;;; A recording watched: brought to any place of it, back and forth, it is what it was; and what stands above it fits.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight dive) #:select (engine-of))
             ((bight engine) #:select (%hash-dive %dive-steps))
             ((bight cockpit desk) #:select (desk))
             (bight cockpit traces)
             (bight core chart)
             (bight dive reel)
             ((bight cockpit watch) #:select (film-stretch watch-panel))
             (srfi srfi-1))

(define (hash-of reel) (%hash-dive (engine-of (reel-dive reel))))

(define (recorded pilot)
  "Return the file of a recording of what PILOT, a thunk, does to the present dive, and the hash at its end."
  (let ((file (scratch-file "flight.rec")))
    (record! file)
    (pilot)
    (stop-recording!)
    (cons file (state-hash))))

(define-property any-place-is-what-it-was
  "Whatever was flown: a reel brought to places at random has the state there that it had when it went there straight; its
end is that of the dive."
  #:for ((scene (random-world #:models '(dynamic rubber-band)))
         (pilot (random-pilot #:most 4 #:seconds 3 #:does '(drive fly pay-out haul-in current)))
         (first-place (uniform 0 1)) (second-place (uniform 0 1)))
  #:cases 8
  (in scene)
  (let* ((it (recorded pilot)) (straight (open-reel (car it))) (reel (open-reel (car it)))
         (place (lambda (share) (inexact->exact (floor (* share (reel-length reel)))))))
    (wind! reel (reel-length reel))
    (expect (hash-of reel) => (cdr it))
    (for-each (lambda (share)
                (wind! reel (place share))
                (wind! straight 0)
                (wind! straight (place share))
                (expect (hash-of reel) => (hash-of straight)))
              (list first-place second-place 0 1))))

(define-property a-flight-is-kept-after-it-was-flown
  "Whatever was flown, taken back and gone on with: what the dive remembers of it replays to the last bit, nothing having
been recorded, and is as long as the dive is."
  #:for ((scene (random-world #:models '(dynamic rubber-band)))
         (before (random-pilot #:most 3 #:seconds 3 #:does '(drive fly pay-out haul-in current)))
         (after (random-pilot #:most 3 #:seconds 3 #:does '(drive pay-out current)))
         (back (uniform 0 2)))
  #:cases 6
  (in scene)
  (before)
  (rewind! (min back (now)))
  (after)
  (let* ((file (keep-flight! (scratch-file "kept.rec"))) (reel (flight-reel (current-dive))))
    (expect (replay file) => 'identical)
    (expect (reel-length reel) => (%dive-steps (engine-of (current-dive))))
    (wind! reel (reel-length reel))
    (expect (hash-of reel) => (state-hash))
    (wind! reel 0)
    (wind! reel (reel-length reel))
    (expect (hash-of reel) => (state-hash))))

(define-scenario every-change-of-a-dive-is-in-its-flight
  "A cut line, a moved end, a track followed, a checkpoint gone back to, a fork, and what a watcher of its own did."
  (in pile)
  (drive! #:surge 0.6)
  (every 1 (alter! 'line #:cdn (+ 1 (/ (now) 10))))
  (run 3)
  (let ((here (checkpoint)))
    (drive! #:surge -1)
    (run 2)
    (restore! here))
  (pay-out! 2)
  (run 2)
  (cut-tether! #:at 5)
  (run 1)
  (expect (begin (keep-flight! (scratch-file "all.rec")) (replay (scratch-file "all.rec"))) => 'identical)
  (expect (what-if (run 1) (keep-flight! (scratch-file "fork.rec")) (replay (scratch-file "fork.rec")))
          => 'identical)
  (expect (what-if (run 1) (reel-length (flight-reel (current-dive)))) => 420)
  (live!)
  (expect (keep-flight! (scratch-file "live.rec")) raises def)
  (freeze!))

(define-scenario a-dive-taken-back-goes-on-in-its-recording
  "What was taken back is watched too: the recording is as long as all that was flown, and ends where the dive did."
  (in pile)
  (let* ((it (recorded (lambda () (drive! #:surge 0.5) (run 6) (rewind! 4) (drive! #:surge -0.4) (run 3))))
         (reel (open-reel (car it))))
    (expect (reel-length reel) => 540)
    (wind! reel 360)
    (expect (%dive-steps (engine-of (reel-dive reel))) is (between 120 360))
    (wind! reel 540)
    (expect (hash-of reel) => (cdr it))
    (wind! reel 100)
    (wind! reel 540)
    (expect (hash-of reel) => (cdr it))))

(define-scenario events-are-gone-to
  "From event to event, forth and back."
  (in pile)
  (let* ((it (recorded (lambda () (move! '(6 -4 -5) #:speed 1) (run 5) (move! '(6 0 -5) #:speed 1) (run 6))))
         (reel (open-reel (car it))))
    (let* ((one (next-event-place reel)) (two (next-event-place reel)))
      (expect one is (between 1 (- two 1)))
      (expect two is (between one (reel-length reel)))
      (wind! reel (reel-length reel))
      (expect (event-before reel) is (about two #:within 2))
      (expect (event-before reel) is (about one #:within 2))
      (expect (event-before reel) => 0)
      (expect (open-reel "no-such-file") raises io))))

(define-scenario the-bar-fits
  "What stands above a recording is within the window, whatever its size."
  (in open-water)
  (for-each
   (lambda (columns)
     (let ((texts '()))
       ((watch-panel 70 100 1/60 2 '((touched 1.5 line p1) (wrapped 2.5 line a-very-long-name/of-a-part 3)))
        (desk columns 10 (lambda (column row text ink paper) (set! texts (cons text texts))))
        columns 10)
       (require (length texts) => 2)
       (require (apply max (map string-length texts)) is (between 1 columns))))
   (iota 60 30 3)))

(define-scenario a-chart-shows-what-it-is-given
  "Every value in its row and column, levels and the present among them, within the width that was asked for."
  (in open-water)
  (let* ((ramp (map (lambda (i) (cons i i)) (iota 40)))
         (lines (chart-lines "ramp" (list (cons #\* ramp) (cons #\o (map (lambda (s) (cons (car s) 39)) ramp)))
                             #:levels '(0 +inf.0) #:from 0 #:to 40 #:at 20 #:columns 40 #:rows 40))
         (cells (map (lambda (line) (string-drop line 10)) (take (cdr lines) 40))))
    (expect (map (lambda (line) (string-index line #\*)) cells) => (reverse (iota 40)))
    (expect (string-count (first cells) #\o) => 39)
    (expect (string-count (last cells) #\.) => 39)
    (expect (map (lambda (line) (memv (string-ref line 20) '(#\| #\* #\o #\.))) cells) is (lambda (all) (and-map identity all)))
    (expect (delete-duplicates (map string-length (cdr lines))) is (lambda (all) (and-map (lambda (n) (<= n 50)) all))))
  (expect (chart-lines "none" '((#\*))) => '())
  (expect (length (chart-lines "flat" '((#\* (1 . 5) (1 . 5))))) => 9))

(define-scenario traces-do-not-ask-how-one-came-there
  "What is plotted of a recording is the same, watched straight or back and forth; a ghost's stands where it began."
  (in pile)
  (let* ((it (recorded (lambda () (drive! #:surge 0.5) (run 3) (pay-out! 1) (run 5))))
         (plotted (lambda (places)
                    (let ((traces (new-traces)) (reel (open-reel (car it))))
                      (next-trace! traces)
                      (for-each (lambda (place) (wind-tracing! traces reel place)) places)
                      (trace-lines traces reel #f 0 60)))))
    (expect (plotted '(480)) => (plotted '(100 20 350 200 480)))
    (expect (plotted '(480)) => (plotted '(480 0 7 480)))
    (expect (plotted '(480)) is (lambda (lines) (= 9 (length lines))))
    (let ((traces (new-traces)) (reel (open-reel (car it))) (ghost (open-reel (car it))))
      (define (lines behind) (trace-lines traces reel ghost behind 60))
      (expect (lines 0) => '())
      (for-each (lambda (i) (next-trace! traces)) (iota 4))
      (wind-tracing! traces ghost 480)
      (expect (any (lambda (line) (string-index line #\*)) (lines 0)) => #f)
      (expect (apply min (filter-map (lambda (line) (string-index line #\o)) (lines 240)))
              => (+ 10 25))
      (next-trace! traces)
      (next-trace! traces)
      (expect (lines 0) => '()))))

(define-scenario a-stretch-is-filmed
  "As many pictures as the stretch has, and no stretch that ends before it begins."
  (in pile)
  (let* ((it (recorded (lambda () (drive! #:surge 0.5) (run 2)))) (reel (open-reel (car it))))
    (expect (film-stretch reel (scratch-file "stretch.png") 2 1) raises domain)
    (when (false-if-exception (snapshot (scratch-file "try.png")))
      (film-stretch reel (scratch-file "stretch.png") 1 1.2)
      (expect (reel-place reel) => 72))))
