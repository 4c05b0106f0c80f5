;;; Obstacles as parts of a world: every kind, groups, names, files, what is refused and how it is said.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight assembly)
             (bight world describe)
             (bight engine)
             (bight core errors)
             ((bight dive query) #:select (obstacle-properties (find-part . index-of-part)))
             (bight core schema)
             (bight world)
             (ice-9 exceptions)
             (srfi srfi-1)
             (srfi srfi-4))

(define-syntax-rule (message expression)
  ;; The sentence of the error that EXPRESSION raises.
  (guard (e ((bight-error? e) (bight-error-message e)))
    expression
    "no error"))

(define-syntax-rule (says? text expression)
  ;; Does the error of EXPRESSION contain TEXT?
  (and (string-contains (message expression) text) #t))

(define (field-of world part name)
  "Return the value of the field NAME that PART of WORLD gives."
  (assq-ref (part-fields (world-part world part)) name))

(define (here name)
  "Return the alist of what the obstacle NAME of the current dive is."
  (call-with-values (lambda () (index-of-part 'here name))
    (lambda (kind index) (obstacle-properties 'here index))))

(define (told name key)
  (assq-ref (here name) key))

(define (points->lists array) (array->list array))

(define bay
  ;; One of each kind that needs no file.
  (world
   (sea (depth 60))
   (seabed (friction 0.6))
   (cylinder (named leg) (from 0 0 0) (to 0 0 -60) (radius 0.6) (friction 0.3))
   (box (named manifold) (at 12 4 -58) (size 4 3 4) (heading 90))
   (sphere (named buoy) (at 3 3 -10) (radius 0.8))
   (capsule (named brace) (from 0 20 -20) (to 12 20 -8) (radius 0.25))
   (convex (named anode) (at 20 20 -5) (points (0 0 0) (2 0 0) (0 2 0) (0 0 2)))
   (rov (named minnow) (at 5 -5 -12))
   (tether (named line) (from 3 -6 -2) (to minnow) (length 18))))


;;; Every kind.

(define-scenario every-kind
  "Each kind of obstacle is where and as large as its fields say."
  (in bay)
  (expect (parts) => '(minnow line seabed leg manifold buoy brace anode))
  (expect (map (lambda (name) (told name 'head)) (cddr (parts)))
          => '(seabed cylinder box sphere capsule convex))
  (expect (told 'leg 'axis) => (list (f64vector 0 0 0) (f64vector 0 0 -60)))
  (expect (told 'leg 'radius) => 0.6)
  (expect (told 'manifold 'centre) => '(12 4 -58))
  (expect (told 'manifold 'size) => '(4 3 4))
  (expect (told 'manifold 'low) is (about '(10.5 2 -60) #:within 1e-9)) ; its own x looks south
  (expect (told 'buoy 'high) => '(3.8 3.8 -9.2))
  (expect (told 'brace 'low) is (about '(-0.25 19.75 -20.25) #:within 1e-9))
  (expect (told 'anode 'low) => '(20 20 -5))
  (expect (told 'anode 'high) => '(22 22 -3))
  (expect (told 'anode 'triangles) => 4)
  (expect (told 'seabed 'centre) => '(0 0 -60))
  (expect (told 'seabed 'high) => (f64vector +inf.0 +inf.0 +inf.0)))

(define-scenario without-obstacles
  "A world without obstacles has none."
  (in open-water)
  (expect (parts) => '(minnow line))
  (expect (obstacle-properties 'here 0) raises name))

(define-scenario expressions
  "Numbers are expressions, points may be values, rows may be computed."
  (define r 0.5)
  (define place (vec 1 2 -3))
  (define corners '((0 0 0) (1 0 0) (0 1 0) (0 0 1)))
  (define (path n) (map (lambda (i) (list i 0 i -5)) (iota n)))
  (define w (world (sphere (named a) (at place) (radius (* 2 r)))
                   (convex (named b) (points ,corners))
                   (convex (named c) (points (0 0 0) ((* 2 r) 0 0) ,(list 0 1 0) (0 0 r)))
                   (sphere (named d) (radius r) (track ,(path 3)))
                   (sphere (named e) (radius r) (track (0 0 0 (- r)) (1 r 0 0 90)))))
  (expect (field-of w 'a 'radius) => 1.0)
  (expect (field-of w 'a 'at) => '(1 2 -3))
  (expect (points->lists (field-of w 'b 'points)) => '((0. 0. 0.) (1. 0. 0.) (0. 1. 0.) (0. 0. 1.)))
  (expect (points->lists (field-of w 'c 'points)) => '((0. 0. 0.) (1. 0. 0.) (0. 1. 0.) (0. 0. 0.5)))
  (expect (map second (points->lists (field-of w 'd 'track))) => '(0. 0. 0.))
  (expect (array-ref (field-of w 'e 'track) 1 4) => 90.)
  (expect (nan? (array-ref (field-of w 'e 'track) 0 4))))

(define-scenario vehicles-alone
  "A world without tether and obstacle is gone back in, and a refused change leaves it as it was."
  (enter! (without 'open-water 'line))
  (define before (state-hash))
  (define here (checkpoint))
  (expect (alter! 'minnow #:volts 0.5 #:max-current 0.973) raises name)
  (expect (state-hash) => before)
  (drive! #:surge 1)
  (run 1)
  (restore! here)
  (expect (state-hash) => before))

(define-scenario friction
  "An obstacle has the tether's friction, or its own; it may change while a dive runs."
  (in bay)
  (expect (told 'leg 'friction) => 0.3)
  (expect (nan? (told 'buoy 'friction)))
  (define before (state-hash))
  (alter! 'buoy #:friction 0.2)
  (expect (told 'buoy 'friction) => 0.2)
  (expect (= before (state-hash)) => #f)
  (alter! 'buoy #:friction 'tether)
  (expect (state-hash) => before)
  (expect (alter! 'buoy #:friction -1) raises domain)
  (expect (alter! 'buoy #:friction 'tehter) raises name)
  (expect (alter! 'buoy #:radius 1) raises domain)
  (expect (alter! 'buoy #:size '(1 1 1)) raises name)
  (expect (alter! 'bouy #:friction 1) raises name)
  (expect (state-hash) => before)
  (what-if (alter! 'leg #:friction 1))
  (expect (told 'leg 'friction) => 0.3)
  (expect (field-of (with bay (buoy (friction 0.4))) 'buoy 'friction) => 0.4)
  (expect (nan? (field-of (with bay (leg (friction tether))) 'leg 'friction))))

(define-scenario moving-parts
  "A part on a track begins where its first row is."
  (in (world (sphere (named ball) (radius 1) (track (0 4 0 -5) (10 8 0 -5)))
             (box (named crate) (size 2 8 2) (heading 90) (track (0 0 30 -5) (9 4 30 -5)))
             (cylinder (named pipe) (from 0 0 0) (to 0 0 6) (radius 0.5) (track (0 0 60 -5)))))
  (expect (told 'ball 'moves))
  (expect (told 'ball 'centre) => '(4 0 -5))
  (expect (told 'crate 'low) is (about '(-4 29 -6) #:within 1e-9))
  (expect (told 'pipe 'axis) => (list (f64vector 0 60 -8) (f64vector 0 60 -2))))


;;; Names.

(define-scenario default-names
  "Obstacles without a name are called by their kind and a number, around the names that are taken."
  (expect (world-part-names (world (box (size 1 1 1)) (box (size 1 1 1)) (box (named box-3) (size 1 1 1))
                                   (box (size 1 1 1)) (sphere (radius 1))))
          => '(sea box box-2 box-3 box-4 sphere))
  (define w (world (box (size 1 1 1))))
  (expect (world-part-names (extend w (box (size 1 1 1)))) => '(sea box box-2))
  (expect (world-part-names (without (extend w (box (size 1 1 1))) 'box)) => '(sea box-2))
  (expect (world (rov) (rov)) raises def)
  (expect (world (sphere (named a) (radius 1)) (box (named a) (size 1 1 1))) raises def)
  (expect (world (rov (named a)) (box (named a) (size 1 1 1))) raises def)
  (expect (says? "two parts are called `a'" (world (rov (named a)) (box (named a) (size 1 1 1))))))

(define-scenario many-parts
  "Thousands of obstacles are no trouble."
  (define w (world (splice (map (lambda (i) (part sphere (at (* 3 i) 0 -5) (radius 1))) (iota 3000)))))
  (expect (length (world-parts w)) => 3001)
  (expect (part-name (last (world-parts w))) => 'sphere-3000)
  (enter! w)
  (expect (length (parts)) => 3000)
  (expect (told 'sphere-3000 'centre) => '(8997 0 -5)))


;;; Groups.

(define tower
  (world
   (group (named tower) (at 5 5 0) (heading 90)
     (box (named deck) (at 0 10 2) (size 1 2 3))
     (cylinder (named leg-1) (from 0 1 0) (to 0 1 -5) (radius 0.1) (friction 0.2))
     (convex (at 0 0 -9) (points (0 0 0) (1 0 0) (0 1 0) (0 0 1)))
     (convex (at 0 0 -19) (heading 10) (points (0 0 0) (1 0 0) (0 1 0) (0 0 1)))
     (sphere (named buoy) (radius 1) (track (0 0 2 -5) (9 0 3 -5)))
     (group (named frame) (at 0 0 1) (heading 90)
       (capsule (named rail) (from 0 0 0) (to 0 4 0) (radius 0.1)))
     (rov (named minnow) (at 1 0 -3))
     (tether (named line) (from 9 0 -3) (to minnow) (length 20) (via (5 1 -3))))))

(define-scenario groups
  "The parts of a group are turned and moved together, and named by it."
  (expect (world-part-names tower)
          => '(sea tower/deck tower/leg-1 tower/convex tower/convex-2 tower/buoy tower/frame/rail
                   tower/minnow tower/line))
  ;; North of the group is east of the world.
  (expect (field-of tower 'tower/deck 'at) => '(15 5 2))
  (expect (field-of tower 'tower/deck 'heading) => 90.)
  (expect (field-of tower 'tower/leg-1 'from) => '(6 5 0))
  (expect (field-of tower 'tower/leg-1 'to) => '(6 5 -5))
  (expect (field-of tower 'tower/leg-1 'heading) => #f)
  (expect (field-of tower 'tower/convex 'heading) => 90.)
  (expect (field-of tower 'tower/convex-2 'heading) => 100.)
  (expect (array-ref (field-of tower 'tower/convex 'points) 1 0) => 1.)
  (expect (points->lists (field-of tower 'tower/buoy 'track))
          is (lambda (rows) (equal? (map (lambda (row) (take row 4)) rows)
                                    '((0. 7. 5. -5.) (9. 8. 5. -5.)))))
  (expect (field-of tower 'tower/frame/rail 'from) => '(5 5 1))
  (expect (field-of tower 'tower/frame/rail 'to) is (about '(5 1 1) #:within 1e-12)) ; turned twice
  (expect (field-of tower 'tower/minnow 'at) => '(5 4 -3))
  (expect (field-of tower 'tower/minnow 'heading) => 90.)
  (expect (field-of tower 'tower/line 'from) => '(5 -4 -3))
  (expect (field-of tower 'tower/line 'to) => 'tower/minnow)
  (expect (points->lists (field-of tower 'tower/line 'via)) => '((6. 0. -3.)))
  (enter! tower)
  (expect (rov-position) => '(5 4 -3))
  (expect (told 'tower/buoy 'centre) => '(7 5 -5))
  (alter! 'tower/leg-1 #:friction 0.5)
  (expect (told 'tower/leg-1 'friction) => 0.5))

(define-scenario groups-by-name
  "without takes a whole group or one part of it, with one part."
  (define w (without tower 'tower/line 'tower/minnow))
  (expect (world-part-names (without w 'tower)) => '(sea))
  (expect (world-part-names (without w 'tower/frame))
          => '(sea tower/deck tower/leg-1 tower/convex tower/convex-2 tower/buoy))
  (expect (length (world-parts (without w 'tower/deck))) => (- (length (world-parts w)) 1))
  (expect (without w 'towr) raises name)
  (expect (field-of (with w (tower/leg-1 (friction 0.9))) 'tower/leg-1 'friction) => 0.9)
  (expect (says? "`tower' is a group" (with w (tower (friction 0.9)))))
  (expect (says? "did you mean `tower/leg-1'?" (with w (tower/leg-2 (friction 0.9)))))
  ;; A second one of its name would have parts of the same names.
  (expect (extend w (group (named tower) (box (named deck) (size 1 1 1)))) raises def)
  (expect (world-part-names (world (group (box (size 1 1 1))) (group (box (size 1 1 1)))))
          => '(sea group/box group-2/box)))

(define-scenario groups-as-values
  "A group is a part as a value; in it, parts are written, spliced or computed."
  (define (leg x) (part cylinder (from x 0 0) (to x 0 -9) (radius 0.2)))
  (define rack (part group (named rack) (splice (map leg '(0 1))) (part box (size 1 1 1)) (sphere (radius 1))))
  (expect (part? rack))
  (expect (part-head rack) => 'group)
  (define w (world (splice (list rack (list (part sphere (radius 2)))))))
  (expect (world-part-names w)
          => '(sea rack/cylinder rack/cylinder-2 rack/box rack/sphere sphere))
  (expect (field-of w 'rack/cylinder-2 'from) => '(1 0 0))
  (expect (map second (description-rows (describe rack))) => '("cylinder" "cylinder" "box" "sphere"))
  (expect (length (description-rows (describe (part group (box (size 1 1 1)))))) => 1)
  (expect (field-of (extend w (group (named aft) (at 0 -9 0) (splice rack))) 'aft/rack/cylinder-2 'from)
          => '(1 -9 0)))


;;; Ends and lines.

(define-scenario ends-on-obstacles
  "A tether ends at a point or a vehicle; the error says so."
  (expect (says? "not a cylinder: leg"
                 (world (cylinder (named leg) (from 0 0 0) (to 0 0 -9) (radius 1))
                        (rov (at 5 0 0)) (tether (from leg) (length 9)))))
  (expect (says? "give the point" (extend bay (tether (named second) (from 0 0 -1) (to buoy) (length 9)))))
  (expect (extend bay (tether (named second) (from bouy) (to minnow) (length 9))) raises name))

(define-scenario laying
  "A line that would be laid through an obstacle is refused, naming both; `via' leads it round."
  (define w
    (world (rov (named minnow) (at 10 0 -5))
           (box (named wall) (at 5 0 -5) (size 1 4 4))
           (tether (named line) (from 0 0 -5) (length 12))))
  (expect (enter! w) raises def)
  (expect (says? "tether `line'" (enter! w)))
  (expect (says? "box `wall'" (enter! w)))
  (enter! (with w (line (via (4 2.5 -5) (6 2.5 -5)))))
  (expect (tether-length) => 12.)
  (expect (says? "its way through its `via'" (enter! (with w (line (via (5 20 -5)))))))
  (expect (says? "sphere `ball'" (enter! (extend 'open-water (sphere (named ball) (at 0 0 0) (radius 50))))))
  (expect (says? "inside box `b'" (enter! (world (rov (at 0 0 -5)) (box (named b) (at 0 0 -5) (size 1 1 1))))))
  (define rows (map (lambda (i) (list i 3 -5)) (iota 33)))
  (expect (enter! (with w (line (via ,rows)))) raises limit))


;;; Grids and meshes.

(define-scenario grids-of-procedures
  "A sea bed may be a procedure of x and y, sampled once."
  (define calls 0)
  (define (slope x y) (set! calls (+ calls 1)) (- -10 (* 0.1 x)))
  (define w (world (sea (depth 20)) (seabed (grid slope (from -5 -4) (to 5 4) (spacing 1 2)))))
  (expect calls => 55)
  (enter! w)
  (expect calls => 55)
  (expect (told 'seabed 'low) is (about '(-5 -4 -10.5) #:within 1e-9))
  (expect (told 'seabed 'high) is (about '(5 4 -9.5) #:within 1e-9))
  (expect (told 'seabed 'triangles) => 80)
  (enter! (with w (seabed (at 100 0 -1))))
  (expect (told 'seabed 'high) is (about '(105 4 -10.5) #:within 1e-9))
  ;; NaN: no bottom there.
  (enter! (world (seabed (grid (lambda (x y) (if (< x 0) +nan.0 -5)) (from -5 0) (to 5 5) (spacing 5)))))
  (expect (told 'seabed 'triangles) => 2))

(define (call-with-folder proc)
  "Call PROC with the name of a fresh folder, and remove that afterwards."
  (let ((folder (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-parts-XXXXXX"))))
    (dynamic-wind
      (const #t)
      (lambda () (proc folder))
      (lambda () (system* "rm" "-rf" folder)))))

(define (write-file folder name . lines)
  (call-with-output-file (string-append folder "/" name)
    (lambda (port) (for-each (lambda (line) (display line port) (newline port)) lines))))

(define (write-grid folder level)
  (write-file folder "bottom.asc"
              "ncols 3" "nrows 2" "xllcorner 0" "yllcorner 0" "cellsize 10"
              (simple-format #f "~a ~a ~a" level level level)
              (simple-format #f "~a ~a ~a" level level level)))

(define-scenario grids-in-files
  "A grid file is found beside the world's own, read again only when it has changed."
  (call-with-folder
   (lambda (folder)
     (write-grid folder -7)
     (write-file folder "deep.scm" "(define-world deep \"Deep.\" (seabed (grid \"bottom.asc\")))")
     (define file (string-append folder "/deep.scm"))
     (enter! file)
     (expect (told 'seabed 'low) => '(5 5 -7))
     (expect (told 'seabed 'high) => '(25 15 -7))
     (write-grid folder -12.5)
     (enter! file)
     (expect (told 'seabed 'low) => '(5 5 -12.5))
     (write-file folder "bottom.asc" "ncols 3" "nrows")
     (expect (enter! file) raises format)
     (expect (told 'seabed 'low) => '(5 5 -12.5))
     (delete-file (string-append folder "/bottom.asc"))
     (expect (enter! file) raises io)
     (expect (says? "bottom.asc" (enter! file)))
     (expect (says? folder (enter! file)))))
  (expect (enter! (world (seabed (grid "/no/such/file.asc")))) raises io))

(define-scenario meshes-in-files
  "A mesh is placed by its own origin, turned, scaled, its up axis named."
  (call-with-folder
   (lambda (folder)
     (write-file folder "plate.obj" "v 0 0 0" "v 1 0 0" "v 1 2 0" "v 0 2 0" "f 1 2 3 4")
     (define plate (string-append folder "/plate.obj"))
     (define w (world (mesh (named plate) (file plate) (at 20 0 -58))))
     (guard (e ((and (bight-error? e) (eq? 'unsupported (bight-error-kind e)))
                (skip "built without mesh files")))
       (enter! w))
     (expect (told 'plate 'triangles) => 2)
     (expect (told 'plate 'low) => '(20 0 -58))
     (expect (told 'plate 'high) => '(21 2 -58))
     (enter! (with w (plate (heading 90) (scale 10))))
     (expect (told 'plate 'low) is (about '(20 -10 -58) #:within 1e-9))
     (expect (told 'plate 'high) is (about '(40 0 -58) #:within 1e-9))
     (enter! (with w (plate (up y))))
     (expect (told 'plate 'high) => '(21 0 -56))
     (enter! (world (sea (depth 9)) (seabed (mesh plate) (at 0 0 -9))))
     (expect (told 'seabed 'high) => '(1 2 -9))
     (expect (enter! (world (seabed (mesh plate) (grid (lambda (x y) 0) (from 0 0) (to 1 1) (spacing 1)))))
             raises def)
     (write-file folder "plate.obj" "v 0 0 0" "f 1 2 3")
     (expect (memq (guard (e ((bight-error? e) (bight-error-kind e))) (enter! w) 'entered)
                   '(format io))))))


;;; What is said.

(define-scenario descriptions
  "describe knows kinds, parts, groups, and what has changed."
  (in (extend bay (group (named rack) (at 40 0 0) (box (size 1 1 1)) (sphere (radius 1) (track (0 9 0 0))))))
  (define (row name description)
    (find (lambda (row) (string=? name (first row))) (description-rows description)))
  (for-each (lambda (head) (expect (pair? (description-rows (describe head)))))
            '(seabed box sphere cylinder capsule convex mesh group))
  (expect (third (row "friction" (describe 'box))) => "tether")
  (expect (second (row "size" (describe 'manifold))) => "4 3 4")
  (expect (fourth (row "friction" (describe 'buoy))) => "default")
  (alter! 'buoy #:friction 0.7)
  (expect (second (row "friction" (describe 'buoy))) => "0.7")
  (expect (fourth (row "friction" (describe 'buoy))) => "now")
  (expect (second (row "points" (describe 'anode))) => "(0 0 0) (2 0 0) (0 2 0) (0 0 2)")
  (expect (second (row "track" (describe 'rack/sphere))) => "(0 49 0 0)")
  (expect (map first (description-rows (describe 'rack))) => '("rack/box" "rack/sphere"))
  (expect (describe 'rakc) raises name)
  (expect (object->string bay) => "#<world: 1 rov, 1 tether, 1 seabed, 1 box, 1 sphere, 1 cylinder, 1 capsule, 1 convex>"))

(define-scenario sentences
  "An error tells what was given, what is allowed, and the nearest thing meant."
  (expect (message (world (box (size 1 1 0)))) => "`size' of a box must be three numbers above 0, not (1 1 0)")
  (expect (message (world (box (named b) (at 0 0 0))))
          => "box `b' needs (size ...), three numbers above 0: along its own x, y, z")
  (expect (says? "did you mean `radius'?" (world (sphere (radus 1)))))
  (expect (says? "did you mean `sphere'?" (world (shpere (radius 1)))))
  (expect (says? "a group has no `bxo'" (world (group (bxo (size 1 1 1))))))
  (expect (says? "one of z or y" (world (mesh (file "a.obj") (up x)))))
  (expect (says? "seconds rising from 0 on" (world (sphere (radius 1) (track (1 0 0 0) (0 0 0 0))))))
  (expect (says? "(from -50 -50)" (world (seabed (grid 5)))))
  (expect (says? "a group holds no seabed" (world (group (seabed)))))
  (expect (says? "a world has one seabed" (world (seabed) (seabed (named other))))))

(define-scenario schema-of-obstacles
  "The schema knows every kind and its fields."
  (expect (part-heads)
          => '(sea rov tether seabed box sphere cylinder capsule convex mesh group))
  (expect (filter obstacle-head? (part-heads)) => '(seabed box sphere cylinder capsule convex mesh))
  (expect (map field-name (head-fields 'box)) => '(named at size heading pitch roll friction abrasiveness track))
  (expect (map field-name (head-fields 'mesh))
          => '(named up file at heading pitch roll scale friction abrasiveness track))
  (expect (required-fields 'cylinder) => '(from to radius))
  (for-each (lambda (head)
              (for-each (lambda (name) (expect (head-field head name))) (required-fields head))
              (when (obstacle-head? head)
                (expect (field-live? (head-field head 'friction)))))
            (part-heads)))
