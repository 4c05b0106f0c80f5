;;; (bight dive export) --- recordings and samples for NumPy, for VTK and, as glTF, for Blender.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive export)
  #:use-module (bight core errors)
  #:use-module (bight core gltf)
  #:use-module (bight core npz)
  #:use-module ((bight core programs) #:select (check-writable write-bytes))
  #:use-module ((bight core quaternion) #:select (turn-about-z))
  #:use-module (bight core verb)
  #:use-module (bight core vtk)
  #:use-module ((bight dive frames) #:select (query-frames))
  #:use-module ((bight view plot) #:select (samples? samples-names samples-rows))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (export-npz export-vtk export-gltf))


;;; What a recording holds.  It may be anybody's file: what is no number becomes none, and nodes are counted.

(define most-numbers 100000000)

(define (number x) (if (and (real? x) (< -inf.0 x +inf.0)) (exact->inexact x) +nan.0))

(define (check-size proc n)
  (when (> n most-numbers)
    (bight-raise 'limit proc "that are ~a numbers, and one file has ~a at most" n most-numbers)))

(define (by-frame rows)
  ;; A table from frames to the rows, without their first element, in order.
  (let ((table (make-hash-table)))
    (for-each (lambda (row) (hash-set! table (car row) (cons (cdr row) (hash-ref table (car row) '()))))
              (reverse rows))
    table))

(define (named rows)
  ;; An alist from names, in order, to tables from frames to rows; ROWS are (NAME FRAME NUMBER ...).
  (let ((table (make-hash-table)) (names '()))
    (for-each (lambda (row)
                (let ((name (object->string (car row) display)))
                  (unless (hash-ref table name) (set! names (cons name names)))
                  (hash-set! table name (cons (cdr row) (hash-ref table name '())))))
              rows)
    (map (lambda (name) (cons name (by-frame (reverse (hash-ref table name))))) (sort names string<?))))

(define (read-recording proc file)
  ;; (TIMES VEHICLES TETHERS POINTS): (FRAME TIME STEP) for each frame; the others as `named' has them.
  (let ((tables (query-frames proc file
                              '("select frame, time, step from frames order by frame"
                                "select name, frame, x, y, z, heading, speed from vehicles order by frame"
                                "select name, frame, length, anchor_tension, end_tension, max_tension from tethers
order by frame"
                                "select tether, frame, x, y, z, tension from points order by frame, node"))))
    (cons (first tables) (map named (cdr tables)))))


;;; For NumPy.

(define (columns->arrays name heads frames table)
  ;; An array of a number a frame for each of HEADS.
  (map (lambda (head i)
         (list (string-append name "." head) (list (length frames))
               (map (lambda (frame)
                      (let ((rows (hash-ref table frame '())))
                        (if (null? rows) +nan.0 (number (list-ref (car rows) i)))))
                    frames)))
       heads (iota (length heads))))

(define (vehicle->arrays frames entry)
  (let ((rows (cdr entry)))
    (cons (list (string-append (car entry) ".position") (list (length frames) 3)
                (append-map (lambda (frame)
                              (let ((row (hash-ref rows frame '())))
                                (if (null? row) (make-list 3 +nan.0) (map number (take (car row) 3)))))
                            frames))
          (drop (columns->arrays (car entry) '("x" "y" "z" "heading" "speed") frames rows) 3))))

(define (padded rows width n)
  ;; The numbers of ROWS, of WIDTH each, as if there were N rows.
  (append (map number (concatenate rows)) (make-list (* width (- n (length rows))) +nan.0)))

(define (points->arrays proc frames entry)
  ;; Nodes beyond those that a frame has are no numbers.
  (let* ((all (map (lambda (frame) (hash-ref (cdr entry) frame '())) frames))
         (n (apply max 0 (map length all))) (name (car entry)))
    (check-size proc (* 4 n (length frames)))
    (list (list (string-append name ".nodes") (list (length frames)) (map length all))
          (list (string-append name ".points") (list (length frames) n 3)
                (append-map (lambda (rows) (padded (map (lambda (row) (take row 3)) rows) 3 n)) all))
          (list (string-append name ".tension") (list (length frames) n)
                (append-map (lambda (rows) (padded (map (lambda (row) (drop row 3)) rows) 1 n)) all)))))

(define (recording->arrays proc file)
  (let* ((recording (read-recording proc file))
         (frames (map first (first recording))) (n (length frames)))
    (append (list (list "time" (list n) (map (lambda (row) (number (second row))) (first recording)))
                  (list "step" (list n) (map (lambda (row) (number (third row))) (first recording))))
            (append-map (lambda (entry) (vehicle->arrays frames entry)) (second recording))
            (append-map (lambda (entry)
                          (columns->arrays (car entry) '("length" "anchor_tension" "end_tension" "max_tension")
                                           frames (cdr entry)))
                        (third recording))
            (append-map (lambda (entry) (points->arrays proc frames entry)) (fourth recording)))))

(define (samples->arrays samples)
  (let ((rows (samples-rows samples)))
    (map (lambda (name i) (list name (list (length rows)) (map (lambda (row) (number (list-ref row i))) rows)))
         (cons "time" (samples-names samples)) (iota (+ 1 (length (samples-names samples)))))))

(define-verb (export-npz (what any) (file string))
  "Write WHAT, samples of `sample!' or the frames of a recording, NAME of (record! FILE #:frames NAME), to FILE as
NumPy's arrays, .npz: of samples `time' and one for each expression; of a recording `time', `step' and, after the
name of each part, position, heading, speed, or length, anchor_tension, end_tension, max_tension, points, tension
and nodes.  What is not known is not a number.  Return the names of the arrays."
  (let* ((arrays (cond ((samples? what) (samples->arrays what))
                       ((string? what) (recording->arrays 'export-npz what))
                       (else (bight-raise 'domain 'export-npz "it writes samples of `sample!' or the file of a \
recording's frames, not ~s" what))))
         (names (plain-names (map first arrays))))
    (check-size 'export-npz (apply + (map (lambda (array) (length (third array))) arrays)))
    (check-writable 'export-npz file)
    (write-bytes 'export-npz
                 (npz-bytes (map (lambda (name array)
                                   (list name (second array) (list->f64vector (third array))))
                                 names arrays))
                 file)
    names))


;;; For VTK.

(define (frame->vtp frame vehicles points)
  ;; The bytes of what there is in FRAME: vehicles are points, tethers lines.
  (define (rows-of entry) (hash-ref (cdr entry) frame '()))
  (let ((places (filter-map (lambda (entry) (and (pair? (rows-of entry)) (map number (take (car (rows-of entry)) 3))))
                            vehicles))
        (lines (filter pair? (map rows-of points))))
    (vtp-bytes places
               (map (lambda (rows) (map (lambda (row) (map number (take row 3))) rows)) lines)
               (list (cons "tension"
                           (append (make-list (length places) +nan.0)
                                   (map (lambda (row) (number (fourth row))) (concatenate lines))))))))

(define (ensure-folder! folder)
  (unless (file-exists? folder)
    (catch 'system-error
      (lambda () (mkdir folder))
      (lambda arguments
        (bight-raise 'io 'export-vtk "cannot make the folder ~s: ~a" folder
                     (strerror (system-error-errno arguments))))))
  (unless (file-is-directory? folder)
    (bight-raise 'io 'export-vtk "~s is there, and is no folder" folder)))

(define-verb (export-vtk (frames string) (file string))
  "Write the FRAMES of a recording, NAME of (record! FILE #:frames NAME), for ParaView: FILE, a .pvd, which lists the
times, and beside it a folder of its name with a .vtp for each: a line for each tether with the tension at its
nodes, a point for each vehicle.  Return how many frames there are."
  (unless (string-suffix? ".pvd" file)
    (bight-raise 'domain 'export-vtk "the list of a series is a file NAME.pvd, not ~s" file))
  (check-writable 'export-vtk file)
  (let* ((recording (read-recording 'export-vtk frames))
         (folder (string-drop-right file 4)))
    (ensure-folder! folder)
    (write-bytes 'export-vtk
                 (pvd-bytes
                  (map (lambda (row i)
                         (let ((name (simple-format #f "~a.vtp" (string-pad (number->string i) 6 #\0))))
                           (write-bytes 'export-vtk
                                        (frame->vtp (first row) (second recording) (fourth recording))
                                        (string-append folder "/" name))
                           (cons (number (second row)) (string-append (basename folder) "/" name))))
                       (first recording) (iota (length (first recording)))))
                 file)
    (length (first recording))))


;;; For Blender.  A skeleton has as many joints in all frames: lines are drawn through so many points along them.

(define most-joints 200)

(define (rising frames)
  ;; Those of FRAMES, (FRAME TIME STEP), whose times are numbers that grow.
  (reverse
   (fold (lambda (row found)
           (let ((time (number (second row))))
             (if (if (null? found) (= time time) (> time (number (second (car found))))) (cons row found) found)))
         '() frames)))

(define (finite-rows rows width)
  ;; The first WIDTH numbers of those of ROWS that have no others.
  (filter (lambda (row) (every (lambda (x) (= x x)) row))
          (map (lambda (row) (map number (take row width))) rows)))

(define (gap a b) (sqrt (apply + (map (lambda (x y) (* (- x y) (- x y))) a b))))

(define (spread points n)
  ;; N points equally far along POINTS.
  (let* ((steps (map gap points (cdr points))) (step (/ (apply + steps) (- n 1))))
    (let loop ((i 0) (at 0) (points points) (steps steps) (found '()))
      (cond ((= i n) (reverse found))
            ((null? steps) (loop (+ i 1) at points steps (cons (car points) found)))
            ((and (> (* i step) (+ at (car steps))) (pair? (cdr steps)))
             (loop i (+ at (car steps)) (cdr points) (cdr steps) found))
            (else
             (let ((share (if (zero? (car steps)) 0 (min 1 (/ (- (* i step) at) (car steps))))))
               (loop (+ i 1) at points steps
                     (cons (map (lambda (a b) (+ a (* share (- b a)))) (first points) (second points)) found))))))))

(define (in-each-frame frames table ready)
  ;; What READY makes of the rows of each of FRAMES in TABLE; where that is #f, that of the frame before or after.
  (let* ((made (map (lambda (row) (ready (hash-ref table (first row) '()))) frames)) (first-one (find identity made)))
    (and first-one
         (reverse (fold (lambda (one found) (cons (or one (if (null? found) first-one (car found))) found)) '() made)))))

(define (line-of frames entry)
  ;; (NAME MOMENTS) of the points of a tether, or #f: it has none.
  (let* ((longest (hash-fold (lambda (frame rows most) (max most (length rows))) 0 (cdr entry)))
         (moments (in-each-frame frames (cdr entry)
                                 (lambda (rows)
                                   (let ((points (finite-rows rows 3)))
                                     (and (pair? points) (pair? (cdr points))
                                          (spread points (min longest most-joints))))))))
    (and moments (list (car entry) moments))))

(define (body-of frames entry)
  ;; (NAME PLACES TURNS) of a vehicle, or #f.
  (let ((rows (in-each-frame frames (cdr entry) (lambda (rows)
                                                  (let ((good (finite-rows rows 4)))
                                                    (and (pair? good) (car good)))))))
    (and rows
         (list (car entry) (map (lambda (row) (take row 3)) rows)
               (map (lambda (row) (turn-about-z (* -1/180 (acos -1) (fourth row)))) rows)))))

(define-verb (export-gltf (frames string) (file string) #:key (radius positive 0.02))
  "Write the FRAMES of a recording, NAME of (record! FILE #:frames NAME), to FILE, a binary glTF with an animation,
as Blender reads: a tube of RADIUS metres for each tether, a small hull for each vehicle.  Return how many frames
there are."
  (unless (string-suffix? ".glb" file)
    (bight-raise 'domain 'export-gltf "binary glTF is a file NAME.glb, not ~s" file))
  (check-writable 'export-gltf file)
  (let* ((recording (read-recording 'export-gltf frames)) (moments (rising (first recording)))
         (lines (filter-map (lambda (entry) (line-of moments entry)) (fourth recording)))
         (bodies (filter-map (lambda (entry) (body-of moments entry)) (second recording))))
    (when (and (null? lines) (null? bodies))
      (bight-raise 'domain 'export-gltf "nothing in ~s has a place" frames))
    (check-size 'export-gltf (* 7 (length moments) (+ (length bodies) (apply + (map (lambda (line) (length (car (second line))))
                                                                                    lines)))))
    (write-bytes 'export-gltf
                 (glb-bytes (map (lambda (row) (number (second row))) moments) radius lines bodies)
                 file)
    (length moments)))
