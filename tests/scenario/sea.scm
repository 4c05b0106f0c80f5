;;; The sea: measured currents, lee, waves on lines, vehicles and ships.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (ice-9 rdelim) ((srfi srfi-1) #:hide (every)))

(define pi (acos -1))

(define (table name lines)
  ;; A file with LINES in the folder for temporary files.
  (let ((file (string-append (or (getenv "TMPDIR") "/tmp") "/bight-" (number->string (getpid)) name)))
    (with-output-to-file file
      (lambda () (for-each (lambda (line) (display line) (newline)) lines)))
    file))

(define-scenario a-measured-current
  "A current from a file: linear in place and time between its points, as it is at them, constant beyond."
  (let ((file (table "-grid.csv" '("x,y,z,t,u,v,w"
                                   "0,0,0,0,0.2,0,0" "10,0,0,0,0.6,0,0"
                                   "0,0,0,100,0.4,0,0" "10,0,0,100,1.0,0.2,0"))))
    (enter! (world (sea (current (grid file))) (rov (named minnow) (at 5 0 -5))))
    (delete-file file)
    (expect (current-at '(0 0 -3)) is (about '(0.2 0 0) #:within 1e-12))
    (expect (current-at '(5 0 -3)) is (about '(0.4 0 0) #:within 1e-12))
    (run 50)
    (expect (current-at '(5 0 -3)) is (about '(0.55 0.05 0) #:within 1e-12))
    (expect (current-at '(99 9 0)) is (about '(0.8 0.1 0) #:within 1e-12))
    (current! 0.5 90)
    (expect (current-at '(5 0 0)) is (about '(0.5 0 0) #:within 1e-12))
    (current! '(grid))
    (expect (current-at '(5 0 0)) is (about '(0.55 0.05 0) #:within 1e-12))
    (expect (current! '(grid "another.csv")) raises unsupported))
  (expect (enter! (world (sea (current (grid "no-such-file.csv"))))) raises io)
  (in (world (sea) (rov (named minnow) (at 0 0 -5))))
  (expect (current! '(grid)) raises unsupported))

(define (behind-a-pile . sea)
  (world (sea (depth 20) (current 0.5 90) (wake #t))
         (cylinder (named pile) (from 0 0 0) (to 0 0 -20) (radius 0.5))
         (rov (named minnow) (at 3 0 -10))))

(define-scenario in-the-lee-of-a-pile
  "Half the current is left within three diameters behind a pile; upstream and aside it is whole; switched
off, everywhere."
  (in (behind-a-pile))
  (expect (x (current-at '(2.5 0 -10))) is (about 0.25 #:within 0.01))
  (expect (x (current-at '(-2 0 -10))) is (about 0.5 #:within 1e-9))
  (expect (x (current-at '(2.5 4 -10))) is (about 0.5 #:within 1e-3))
  (alter! 'sea #:wake #f)
  (expect (x (current-at '(2.5 0 -10))) => 0.5))

(define-scenario lee-lets-a-tether-hang
  "The same slack tether bows less far down-current in the lee than beside it: what shields a line is felt."
  (define (bow y)
    (enter! (world (sea (depth 30) (current 0.5 90) (wake #t))
                   (cylinder (named pile) (from -3 0 0) (to -3 0 -30) (radius 1.5))
                   (rov (named minnow) (at 0 y -20))
                   (tether (named line) (type fathom) (wet-weight 0) (from 0 y -5) (to minnow)
                           (length 20) (model dynamic))))
    (run 60)
    (list (x (point-at 10)) (max-tension)))
  (let ((lee (bow 0)) (free (bow 40)))
    (expect (second lee) is (below (* 0.5 (second free))))))

(define (swell . more)
  (world (sea (depth 50) (waves (airy (height 2) (period 8) (toward 90))))
         (rov (named float) (type bluerov2-heavy) (volume neutral) (at 0 0 -2))))

(define-scenario waves-move-the-water
  "A regular wave moves the water by its own velocities: height omega / 2 at the crest, gone at depth."
  (in (swell))
  (let* ((omega (/ (* 2 pi) 8)) (surface (x (current-at '(0 0 0)))))
    (expect surface is (about omega #:within (* 0.01 omega)))
    (expect (x (current-at '(0 0 -45))) is (below (* 0.2 surface)))
    (run 4)
    (expect (x (current-at '(0 0 0))) is (about (- surface) #:within 0.01))
    (waves! 'none)
    (expect (current-at '(0 0 0)) is (about '(0 0 0) #:within 0)))
  (expect (waves! '(airy (height 20) (period 4) (toward 0))) raises domain)
  (expect (waves! '(airy (hight 2) (period 4))) raises name)
  (expect (waves! '(tidal)) raises name))

(define-scenario what-floats-goes-with-the-waves
  "A neutral vehicle with its thrusters off goes round with the water near the surface, and hardly deep
down."
  (define (way-up-and-down z)
    (enter! (with (swell) (float (at 0 0 z))))
    (stabilise! #f)
    (run 40)
    (let ((heights (map (lambda (i) (step!) (rov-depth)) (iota 480))))
      (- (apply max heights) (apply min heights))))
  (expect (way-up-and-down -2) is (between 1.2 2))
  (expect (way-up-and-down -40) is (below 0.2)))

(define-scenario a-ship-heaves-its-tether
  "An anchor that rides the waves goes up and down with them, and jerks at a heavy line."
  (define (rig ride)
    (world (sea (depth 100) (waves (airy (height 3) (period 9) (toward 0))))
           (rov (named minnow) (at 0 5 -60))
           (tether (named line) (type leaded-rope) (from 0 0 0) (to minnow) (length 62) (ride ride 0 0)
                   (model dynamic))))
  (define (swing)
    (run 60)
    (let ((all (map (lambda (i) (step!) (cons (z (point-at 0)) (anchor-tension))) (iota 540))))
      (list (- (apply max (map car all)) (apply min (map car all)))
            (- (apply max (map cdr all)) (apply min (map cdr all))))))
  (enter! (rig 1))
  (let ((riding (swing)))
    (expect (first riding) is (about 3 #:within 0.01))
    (enter! (rig 0))
    (let ((standing (swing)))
      (expect (first standing) => 0.0)
      (expect (second riding) is (above (* 2 (second standing)))))))

(define-scenario a-wind-sea-is-seeded
  "A wind sea is the same from the same seed and another from another; a rerun gives the same bits."
  (define (fly seed)
    (enter! (world (sea (depth 50) (waves (jonswap (height 1.5) (period 7) (toward 60) (seed seed))))
                   (rov (named minnow) (type bluerov2-heavy) (at 0 10 -5))
                   (tether (named line) (type fathom) (from 0 0 0) (to minnow) (length 15) (ride 1 1 1)
                           (model dynamic))))
    (hold-position!)
    (run 10)
    (let* ((c (checkpoint)) (there (begin (run 10) (state-hash))))
      (restore! c)
      (run 10)
      (expect (state-hash) => there)
      there))
  (expect (fly 1) => (fly 1))
  (expect (= (fly 1) (fly 2)) => #f))

(define reference
  (string-append (or (getenv "BIGHT_REFERENCE_DATA")
                     (string-append (or (getenv "top_srcdir") "..") "/../shared/data"))
                 "/published/lowe_langley_2006_case6.csv"))

(define (history file)
  ;; The rows (TIME TENSION) of FILE, s and kN.
  (call-with-input-file file
    (lambda (port)
      (let loop ((line (read-line port)) (rows '()))
        (if (eof-object? line)
            (reverse rows)
            (let ((row (map string->number (string-split line #\,))))
              (loop (read-line port) (if (and (= 2 (length row)) (and-map real? row)) (cons row rows) rows))))))))

(define-scenario a-jumper-in-waves
  "Waves of 10 m, 10 s, across a flexible jumper: its top tension is that of Lowe and Langley (2006, case
6) within 0.5 kN, once the first cycle of the reference, which is not yet like its others, is over."
  (unless (file-exists? reference)
    (skip "the reference data are not here"))
  (in (world (sea (depth 100) (density 1000) (gravity 9.807)
                  (waves (airy (height 10) (period 10) (toward 0))))
             (tether (named line) (from 0 0 -5) (to -100 0 -55) (length 170) (diameter 0.396) (mass 165)
                     (ea 5e8) (ei 120.8e3) (ba 0) (cdn 1) (cdt 0) (ca 1) (nodes 160) (model dynamic))))
  (run 60)
  (let ((off (map (lambda (row)
                    (run (max 0 (- (+ 60 (first row)) (now))))
                    (cons (first row) (abs (- (/ (anchor-tension) 1000) (second row)))))
                  (history reference))))
    (expect (apply max (filter-map (lambda (pair) (and (> (car pair) 10) (cdr pair))) off)) is (below 0.5))
    (expect (apply max (map cdr off)) is (below 0.7))))

(define-scenario (held-by-the-surface heave)
  "A vehicle driven up bobs at the surface and does not fly: a thruster in the air pushes nothing."
  #:for ((heave 0.5 1))
  (enter! (world (rov (named minnow) (type bluerov2-heavy) (at 0 0 -3))))
  (never (> (z (rov-position)) 0.5)
    (drive! #:heave heave) (run 30))
  (expect (z (rov-position)) is (between -0.6 0.4)))
