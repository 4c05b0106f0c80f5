;;; Pictures: files of the size asked for, errors that teach, nothing loaded before it is used.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core errors)
             ((bight core scratch) #:select (call-with-scratch))
             (bight view picture)
             (ice-9 exceptions)
             (ice-9 ftw)
             (ice-9 textual-ports)
             (ice-9 binary-ports)
             (rnrs bytevectors)
             (srfi srfi-1))

(define (maps)
  "Return the text of /proc/self/maps, or the empty string."
  (if (file-exists? "/proc/self/maps")
      (call-with-input-file "/proc/self/maps" get-string-all)
      ""))

(define (loaded? library)
  "Return true if LIBRARY is in this process."
  (and (string-contains (maps) library) #t))

;; Asked before anything here could have drawn.
(define loaded-at-first
  (filter loaded? '("libOSMesa" "libEGL" "libcairo" "libchafa" "bight-render")))

(define-syntax-rule (raised expression)
  ;; (KIND . MESSAGE) of what EXPRESSION raises, or #f.
  (guard (e ((bight-error? e) (cons (bight-error-kind e) (bight-error-message e))))
    expression
    #f))

(define (file-bytes name)
  (call-with-input-file (scratch-file name) get-bytevector-all #:binary #t))

(define (png-size name)
  "Return (WIDTH HEIGHT) of the PNG called NAME, or #f if it is none."
  (let ((bytes (file-bytes name)))
    (and (> (bytevector-length bytes) 24)
         (equal? '(137 80 78 71 13 10 26 10) (map (lambda (i) (bytevector-u8-ref bytes i)) (iota 8)))
         (list (bytevector-u32-ref bytes 16 (endianness big))
               (bytevector-u32-ref bytes 20 (endianness big))))))

(define (shown value)
  (call-with-output-string (lambda (port) (write value port))))

;;; Drawn once, while this file is loaded: the scenarios are forks, and have what graphics libraries compile for that.

(define plan-at-first
  ;; Of a plan that is drawn before anything else: why there is none, or #f; its size; whether it loaded OpenGL.
  (call-with-scratch
   (lambda ()
     (enter! 'open-water)
     (run 0.1)
     (let ((missing (raised (snapshot (scratch-file "plan.png") #:view 'plan #:size '(320 200)))))
       (list missing (and (not missing) (png-size "plan.png")) (or (loaded? "libOSMesa") (loaded? "libEGL")))))))

(define (without-osmesa)
  ;; Why OSMesa draws nothing here, or #f.
  (setenv "BIGHT_GL" "osmesa")
  (let ((why (raised (renderer-name))))
    (unsetenv "BIGHT_GL")
    why))

;; OSMesa draws in a process's own memory, which forks have, too; of a graphics card nothing is asked yet.
(unless (or (getenv "BIGHT_GL") (without-osmesa))
  (enter! 'pier)
  (for-each (lambda (view) (picture-pixels 'snapshot (list view) '(64 . 64) 'plain (in-water '() 'on 10)))
            (list 'overview 'pilot 'top (list 'sonar #f 20. 1.)))
  (picture-pixels 'snapshot '(overview) '(64 . 64) 'tension '()))

(define why-not
  ;; Why there are no pictures, or #f.  To ask is to load.
  (delay (raised (renderer-name))))

(define-syntax-rule (with-pictures body ...)
  ;; Only where there are any.
  (if (force why-not)
      (skip (cdr (force why-not)))
      (let () body ...)))

(define-scenario nothing-loaded-at-first
  "A dive loads no graphics library, and a plan needs none."
  (expect loaded-at-first => '())
  (if (first plan-at-first)
      (skip (cdr (first plan-at-first)))
      (expect (cdr plan-at-first) => '((320 200) #f))))

(define-scenario a-picture-is-written
  "A snapshot writes a PNG of the size asked for and says so."
  (in open-water)
  (with-pictures
   (expect (shown (snapshot (scratch-file "a.png") #:size '(160 90))) =>
           (string-append (scratch-file "a.png") ", 160 x 90 pixels, overview"))
   (expect (png-size "a.png") => '(160 90))
   (expect (or (loaded? "libOSMesa") (loaded? "libEGL")) => #t)
   (for-each (lambda (view)
               (snapshot (scratch-file "v.png") #:view view #:size '(96 64))
               (expect (png-size "v.png") => '(96 64)))
             '(chase pilot top side north east plan (look (5 -5 -3) (0 5 -5))))
   (for-each (lambda (paint)
               (snapshot (scratch-file "p.png") #:paint paint #:size '(96 64))
               (expect (png-size "p.png") => '(96 64)))
             '(plain tension curvature model))
   (snapshot (scratch-file "s.png") #:view '(top side chase) #:size '(300 200))
   (expect (png-size "s.png") => '(300 200))
   (snapshot (scratch-file "t.png") #:transparent #t #:size '(96 64))
   (expect (png-size "t.png") => '(96 64))))

(define-scenario a-picture-leaves-the-dive-alone
  "Drawing changes nothing, and the same dive gives the same bytes."
  (in cross-current)
  (run 0.5)
  (with-pictures
   (let ((before (state-hash)))
     (snapshot (scratch-file "one.png") #:size '(160 120) #:paint 'tension)
     (snapshot (scratch-file "two.png") #:size '(160 120) #:paint 'tension)
     (expect (state-hash) => before)
     (expect (equal? (file-bytes "one.png") (file-bytes "two.png")) => #t)
     (snapshot (scratch-file "two.png") #:size '(160 120) #:paint 'curvature)
     (expect (equal? (file-bytes "one.png") (file-bytes "two.png")) => #f))))

(define-scenario obstacles-are-seen
  "A pile between the camera and the tether changes the picture; so does where it stands."
  (in open-water)
  (with-pictures
   (define (draw-with name . parts)
     (enter! (extend (find-world 'open-water) (splice parts)))
     (snapshot (scratch-file name) #:size '(120 90) #:view '(look (20 5 -6) (0 5 -6)) #:overlay 'none)
     (file-bytes name))
   (let ((bare (draw-with "o0.png"))
         (one (draw-with "o1.png" (part cylinder (named p) (from 8 5 0) (to 8 5 -40) (radius 0.5))))
         (other (draw-with "o2.png" (part box (named p) (at 8 9 -5) (size 2 2 2)))))
     (expect (equal? bare one) => #f)
     (expect (equal? bare other) => #f)
     (expect (equal? one other) => #f))))

(define-scenario no-bed-is-drawn-where-there-is-none
  "A sea without a bed shows none, however deep it says it is; one with a bed shows that."
  (with-pictures
   (define (down depth bed?)
     (enter! (world (sea (depth depth)) (splice (if bed? (list (part seabed)) '()))
                    (rov (named minnow) (at 5 0 -5))
                    (tether (named line) (from 0 0 0) (to minnow) (length 9))))
     (snapshot (scratch-file "bed.png") #:size '(120 90) #:view '(look (0 -8 -5) (3 0 -12)) #:overlay 'none)
     (file-bytes "bed.png"))
   (let ((bare (down 14 #f)))
     (expect (equal? bare (down 20 #f)))
     (expect (equal? bare (down 14 #t)) => #f))))

(define-scenario more-is-drawn-over
  "Each overlay changes the picture, the same twice; levels of boxes differ; a list is all of its parts."
  (in pile)
  (for-each (lambda (p) (move! p #:speed 0.5) (run-until arrived? #:at-most 60))
            '((6 6 -5) (-4 6 -6) (-4 -4 -5) (6 -4 -6)))
  (expect (contacts) is pair?)
  (with-pictures
   (define (drawn overlay)
     (snapshot (scratch-file "o.png") #:overlay overlay #:size '(320 240))
     (file-bytes "o.png"))
   (let ((all (map drawn '(none figures contacts turns taut-string bvh (contacts bvh)))))
     (expect (length (delete-duplicates all)) => (length all))
     (expect (equal? (drawn '(bvh contacts)) (last all)) => #t)
     (expect (equal? (drawn '(bvh 0)) (drawn '(bvh 1))) => #f))
   (expect (snapshot (scratch-file "o.png") #:overlay 'turns #:view 'plan #:size '(96 64))))
  (expect (snapshot "x.png" #:overlay 'trees) raises name)
  (expect (snapshot "x.png" #:overlay '(bvh -1)) raises domain)
  (expect (snapshot "x.png" #:overlay '(bvh trees)) raises domain))

(define-scenario a-vehicle-is-as-large-as-its-hull
  "A hull of another size changes the picture."
  (in open-water)
  (with-pictures
   (define (drawn w)
     (enter! w)
     (snapshot (scratch-file "h.png") #:view 'chase #:size '(96 64) #:overlay 'none)
     (file-bytes "h.png"))
   (define (sized y)
     (world (sea (depth 40))
            (rov (named minnow) (type kinematic) (at 0 0 -5) (size 0.6 y 0.4))
            (tether (from 0 -5 -2) (to minnow) (length 8) (wet-weight 0) (model catenary))))
   (expect (equal? (drawn (sized 0.5)) (drawn (sized 0.5))) => #t)
   (expect (equal? (drawn (sized 0.5)) (drawn (sized 0.9))) => #f)))

(define-scenario mistakes-teach
  "What is wrong with a call is said before anything is drawn, with what is allowed."
  (in open-water)
  (expect (snapshot "x.png" #:view 'topp) raises name)
  (expect (->bool (string-contains (cdr (raised (snapshot "x.png" #:view 'topp)))
                                   "chase, pilot, top, side, north, east, overview, plan or sonar"))
          => #t)
  (expect (->bool (string-contains (cdr (raised (snapshot "x.png" #:view 'topp))) "`top'")) => #t)
  (expect (snapshot "x.png" #:view '(look (0 0 0))) raises domain)
  (expect (snapshot "x.png" #:view '()) raises domain)
  (expect (snapshot "x.png" #:paint 'tensions) raises name)
  (expect (snapshot "x.png" #:size '(0 0)) raises domain)
  (expect (snapshot "x.png" #:size '(8193 100)) raises domain)
  (expect (snapshot "x.png" #:size '(100000 100000)) raises domain)
  (expect (snapshot "x.png" #:size 100) raises domain)
  (expect (snapshot "x.jpg") raises domain)
  (expect (snapshot 'x) raises domain)
  (expect (snapshot "x.png" #:vieuw 'top) raises name)
  (expect (snapshot (dirname (scratch-file "x"))) raises io)
  (expect (show #:as 'telepathy) raises name)
  (expect (file-exists? "x.png") => #f))

(define-scenario obstacles-alone-are-seen
  "A dive without vehicle and tether shows its obstacles; a view that is a vehicle's says what is missing."
  (enter! (world (sea (depth 20)) (sphere (named log) (at 40 8 -4) (radius 0.4))))
  (with-pictures
   (for-each (lambda (view)
               (expect (raised (snapshot (scratch-file "x.png") #:size '(64 64) #:view view)) is
                       (lambda (raised)
                         (and (eq? 'def (car raised))
                              (string-contains (cdr raised) "this dive has none: give its world one, as in (rov ")))))
             '(chase pilot sonar))
   (for-each (lambda (view)
               (snapshot (scratch-file "log.png") #:size '(64 64) #:view view)
               (expect (png-size "log.png") => '(64 64)))
             '(overview top side plan))))

(define-scenario files-that-cannot-be-written
  "A file that cannot be written is one clear line, and nothing is left behind."
  (in open-water)
  (with-pictures
   (expect (snapshot "/nowhere/at/all.png" #:size '(64 64)) raises io)
   (expect (snapshot (scratch-file "none/x.png") #:size '(64 64)) raises io)
   (expect (filter (lambda (file) (string-suffix? ".part" file)) (scandir (dirname (scratch-file "x")))) => '())
   (expect (raised (snapshot (scratch-file "l.png") #:view '(look (1 1 1) (1 1 1)))) =>
           (cons 'domain "a camera looks from one point at another, not at itself"))))

(define-scenario shown-in-a-terminal
  "What is no terminal gets plain characters; symbols and sixels are made when asked for."
  (in open-water)
  (let ((plain (with-output-to-string (lambda () (show)))))
    (expect (->bool (string-contains plain "A")) => #t)
    (expect (string-index plain #\esc) => #f))
  (cond ((force why-not) (skip (cdr (force why-not))))
        ((raised (with-output-to-string (lambda () (show #:as 'symbols #:size '(20 8)))))
         => (lambda (reason) (skip (cdr reason))))
        (else
         (let ((text (with-output-to-string (lambda () (show #:as 'symbols #:size '(20 8))))))
           (expect (string-count text #\newline) => 8)
           (expect (->bool (string-index text #\esc)) => #t))
         (let ((text (with-output-to-string (lambda () (show #:as 'sixel #:size '(20 8))))))
           (expect (->bool (string-contains text "\x1bP")) => #t)))))

;;; What is written on a picture.

(define (overlap? a b)
  ;; Do the boxes A and B, (X Y WIDTH HEIGHT), share more than a hair?
  (define (share x w y v) (- (min (+ x w) (+ y v)) (max x y)))
  (and (> (share (first a) (third a) (first b) (third b)) 0.01)
       (> (share (second a) (fourth a) (second b) (fourth b)) 0.01)))

(define (outside? box size)
  (or (< (first box) 0) (< (second box) 0)
      (> (+ (first box) (third box)) (car size)) (> (+ (second box) (fourth box)) (cdr size))))

(define (collisions boxes)
  (append-map (lambda (rest)
                (filter-map (lambda (other) (and (overlap? (car rest) other) (list (car rest) other)))
                            (cdr rest)))
              (filter pair? (map (lambda (i) (list-tail boxes i)) (iota (length boxes))))))

(define written
  ;; (DIVE TITLE AIM SIZE PAINT FLAGS) -> boxes; #f where there is no renderer.
  (false-if-exception (module-ref (resolve-interface '(bight view render)) '%written)))

(define-scenario nothing-written-overlaps
  "In every world, at every size and with all that can be told, no words overlap or leave the picture."
  (in open-water)
  (if (not written)
      (skip "there is no renderer")
      (for-each
       (lambda (world)
         (enter! world)
         (run 0.2)
         (for-each
          (lambda (size paint)
            (for-each
             (lambda (aim)
               (let ((boxes (written ((@ (bight dive) this-engine) 'test) (symbol->string world) aim size paint
                                     '(figures contacts turns))))
                 (expect (cons world (collisions boxes)) => (list world))
                 (expect (cons world (filter (lambda (box) (outside? box size)) boxes)) => (list world))))
             '(overview side top)))
          '((1280 . 720) (640 . 360) (400 . 800) (96 . 64)) '(plain tension model curvature)))
       (worlds))))

(define-scenario a-camera-is-moved
  "EXTENT says how many metres are seen, AT what is in the middle, ZOOM how much nearer; errors teach."
  (in box)
  (with-pictures
   (define (bytes . keys)
     (apply snapshot (scratch-file "m.png") #:size '(160 90) #:overlay 'none keys)
     (file-bytes "m.png"))
   (expect (equal? (bytes #:view 'top) (bytes #:view 'top #:zoom 1)) => #t)
   (expect (equal? (bytes #:view 'top #:at '(0 0 -9) #:extent 20)
                   (bytes #:view 'top #:at '(0 0 -9) #:extent 40 #:zoom 2)) => #t)
   (expect (equal? (bytes #:view 'top #:at '(0 0 -9) #:extent 20)
                   (bytes #:view 'top #:at '(4 0 -9) #:extent 20)) => #f))
  (expect (snapshot (scratch-file "m.png") #:zoom 0) raises domain)
  (expect (look #:extent -3) raises domain))

(define-scenario looking-shows-the-structure
  "What stands beside the dive is in the drawing of `look'; an extent and a middle choose what is."
  (in box)
  (define (signs char text) (string-count text char))
  (define (text . keys) (shown (apply look #:columns 100 keys)))
  (expect (>= (signs #\# (text)) 10))
  (expect (>= (signs #\# (text #:at '(0 0 -10.7) #:extent 12)) (signs #\# (text))))
  (expect (signs #\# (text #:at '(0 100 -9) #:extent 5)) => 0))


;;; What a camera sees in turbid water, where the current goes, what a sonar hears.

(define (seen view size flags)
  (picture-pixels 'snapshot (list view) size 'plain flags))

(define (brightness pixels i)
  ;; Of the pixel number I: the sum of its colours.
  (+ (bytevector-u8-ref pixels (* 4 i)) (bytevector-u8-ref pixels (+ 1 (* 4 i)))
     (bytevector-u8-ref pixels (+ 2 (* 4 i)))))

(define (all-brightness pixels)
  (map (lambda (i) (brightness pixels i)) (iota (quotient (bytevector-length pixels) 4))))

(define (mean numbers) (/ (apply + numbers) (length numbers) 1.))

(define (contrast pixels)
  (let* ((all (all-brightness pixels)) (middle (mean all)))
    (sqrt (mean (map (lambda (b) (expt (- b middle) 2)) all)))))

(define-scenario the-current-is-seen-as-streamlines
  "Where there is a current the overlay draws lines; in still water the picture is what it was."
  (in (with open-water (current 0.4 90)))
  (with-pictures
   (let ((plain (seen 'overview '(160 . 90) '())))
     (expect (equal? plain (seen 'overview '(160 . 90) '(current))) => #f)
     (expect (equal? (seen 'overview '(160 . 90) '(current)) (seen 'overview '(160 . 90) '(current))) => #t)
     (current! 0 0)
     (expect (equal? (seen 'overview '(160 . 90) '()) (seen 'overview '(160 . 90) '(current))) => #t))))

(define (in-murk metres lights)
  (seen 'pilot '(160 . 90) (in-water '() lights metres)))

(define-scenario turbid-water-hides-and-darkens
  "The less one sees, the less contrast; daylight goes, and lights bring some back."
  (in pier)
  (with-pictures
   (let ((pictures (map (lambda (metres) (in-murk metres 'off)) '(40 10 3))))
     (expect (apply > (map contrast pictures)) => #t)
     (expect (apply > (map (lambda (p) (mean (all-brightness p))) pictures)) => #t))
   (expect (mean (all-brightness (in-murk 3 'on))) is (above (* 1.1 (mean (all-brightness (in-murk 3 'off))))))
   (snapshot (scratch-file "murk.png") #:view 'pilot #:visibility 3 #:lights 'on #:size '(96 64))
   (expect (png-size "murk.png") => '(96 64))
   (expect (car (raised (snapshot (scratch-file "murk.png") #:visibility 0))) => 'domain)
   (expect (car (raised (snapshot (scratch-file "murk.png") #:lights 'onn))) => 'name)))

(define (loudest pixels)
  ;; The number of the brightest pixel.
  (let loop ((i 0) (best 0))
    (cond ((= i (quotient (bytevector-length pixels) 4)) best)
          ((> (brightness pixels i) (brightness pixels best)) (loop (+ i 1) i))
          (else (loop (+ i 1) best)))))

(define (heard range)
  ;; What a sonar hears, in 320 x 180 pixels: the apex is at (160, 171), the range 155 pixels away.
  (picture-pixels 'snapshot (list (list 'sonar #f range 1.)) '(320 . 180) 'plain '()))

(define-scenario a-sonar-shows-where-a-thing-is
  "A ball is as bright as the picture goes, at its bearing and range; nothing is seen of what is behind."
  (in (world (sea (depth 500))
             (sphere (named ball) (at 5 8.66 -250) (radius 0.5))
             (rov (named eye) (type kinematic) (at 0 0 -250) (heading 0))))
  (with-pictures
   (let* ((pixels (heard 20.)) (i (loudest pixels))
          (x (- (remainder i 320) 160)) (y (- 171 (quotient i 320)))
          (echo (* 155 (/ 9.5 20))))
     (expect (sqrt (+ (* x x) (* y y))) is (about echo #:within 5))
     (expect (atan (/ x y)) is (about (/ (acos -1) 6) #:within 0.06))
     (expect (equal? pixels (heard 20.)) => #t)
     (expect (brightness (heard 5.) (loudest (heard 5.))) is (below (/ (brightness pixels i) 3))))))

(define-scenario a-sonar-hears-a-tether
  "A line before the vehicle echoes, on the side where no other vehicle does."
  (in (world (sea (depth 500))
             (rov (named eye) (type kinematic) (at 0 0 -250) (heading 0))
             (rov (named far) (type kinematic) (at 3 9 -250))
             (tether (named line) (type fathom) (wet-weight 0) (from -3 9 -250) (to far) (length 6.2))))
  (with-pictures
   (let* ((with-line (heard 20.))
          (port (filter (lambda (i) (< (remainder i 320) 155)) (iota (* 320 180)))))
     (expect (apply max (map (lambda (i) (brightness with-line i)) port)) is (above 200)))))

(define-scenario a-sonar-hears-the-hull-of-another
  "Another vehicle is as bright as the picture goes, at its bearing and range, and nothing is heard of it from behind."
  (in (world (sea (depth 500))
             (rov (named eye) (type kinematic) (at 0 0 -250) (heading 0))
             (rov (named other) (type kinematic) (at 4 9 -250) (heading 30) (size 0.8 1 0.6))))
  (with-pictures
   (let* ((pixels (heard 20.)) (i (loudest pixels))
          (x (- (remainder i 320) 160)) (y (- 171 (quotient i 320))))
     (expect (brightness pixels i) is (above 200))
     (expect (sqrt (+ (* x x) (* y y))) is (about (* 155 (/ 9.2 20)) #:within 6))
     (expect (atan (/ x y)) is (about (atan 4 8.8) #:within 0.06))
     (place! 'eye '(8 18 -250))
     (expect (brightness (heard 20.) (loudest (heard 20.))) is (below 100)))))

(define (row-brightness pixels y)
  ;; The mean of the middle hundred of 320 pixels in row Y.
  (mean (map (lambda (x) (brightness pixels (+ (* 320 y) x))) (iota 100 110))))

(define-scenario a-sonar-hears-a-flat-bed-everywhere
  "A level bed, met at a flat angle, is brighter than the water before it, and no row of it stands out."
  (in (world (sea (depth 20)) (seabed) (rov (named eye) (type kinematic) (at 0 0 -17) (heading 0))))
  (with-pictures
   (let* ((pixels (heard 30.))
          (bed (map (lambda (y) (row-brightness pixels y)) (iota 40 30)))
          (water (map (lambda (y) (row-brightness pixels y)) (iota 40 115))))
     (expect (apply min bed) is (above (apply max water)))
     (expect (apply max bed) is (below (* 1.5 (mean bed)))))))

(define (darkest-line-of-a-box metres)
  ;; How much darker a pixel is than those a little to the left and to the right of it, at most, in the middle row of a
  ;; picture of a wide box that far away, which looks at what is near.
  (enter! (world (sea (depth 60)) (box (named wall) (at 0 metres -20) (size 4 1 12))
                 (rov (named m) (at 40 0 -20)) (tether (named t) (wet-weight 0) (from 40 -6 -20) (to m) (length 8))))
  (let* ((columns 320) (rows 200) (pixels (seen (f64vector 0. 0. -20. 0. 5. -20.) (cons columns rows) '()))
         (at (lambda (column) (brightness pixels (+ column (* columns (quotient rows 2)))))))
    (apply max (map (lambda (column) (- (min (at (- column 5)) (at (+ column 5))) (at column)))
                    (iota (- columns 10) 5)))))

(define-scenario outlines-fade-with-distance
  "Where water hides what is far, its outline is hidden too."
  (with-pictures
   (expect (darkest-line-of-a-box 5) is (above 25))
   (expect (darkest-line-of-a-box 30) is (below 5))))
