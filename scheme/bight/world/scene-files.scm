;;; (bight world scene-files) --- small files of triangles, heights and currents for random worlds.
;;;
;;; A file is known by a word and always holds the same, so that a script that names it by that word can be
;;; run anywhere.  It is written when it is first asked for, to a folder of the user's own below that for
;;; temporary files.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world scene-files)
  #:use-module (bight core errors)
  #:use-module (srfi srfi-1)
  #:export (mesh-file heights-file current-file))

(define (folder)
  (let ((name (simple-format #f "~a/bight-scenes-~a" (or (getenv "TMPDIR") "/tmp") (getuid))))
    (unless (file-exists? name)
      (false-if-exception (mkdir name #o700))) ; another process may be first
    name))

(define (file-of proc table name suffix)
  ;; The file that holds the lines which TABLE has for NAME.
  (let ((lines (assq-ref table name))
        (file (string-append (folder) "/" (symbol->string name) suffix)))
    (unless lines
      (unknown-name proc "the table of these files" name (map car table)))
    (unless (file-exists? file)
      (let ((part (simple-format #f "~a.~a" file (getpid))))
        (call-with-output-file part
          (lambda (port)
            (for-each (lambda (line) (display line port) (newline port)) lines)))
        (rename-file part file)))
    file))


;;; Triangles, as Wavefront OBJ.

(define (obj vertices faces)
  (append (map (lambda (v) (string-join (cons "v" (map number->string v)))) vertices)
          (map (lambda (f) (string-join (cons "f" (map number->string f)))) faces)))

(define tetra
  (obj '((-1 -1 -1) (1 -1 -1) (0 1 -1) (0 0 1)) '((1 3 2) (1 2 4) (2 3 4) (3 1 4))))

(define sheet
  ;; Two triangles: a surface with an edge all round.
  (obj '((-2 0 -2) (2 0 -2) (2 0.5 2) (-2 -0.5 2)) '((1 2 3) (1 3 4))))

(define crate
  ;; A box without its lid.
  (obj '((-1 -1 -1) (1 -1 -1) (1 1 -1) (-1 1 -1) (-1 -1 1) (1 -1 1) (1 1 1) (-1 1 1))
       '((1 3 2) (1 4 3) (1 2 6) (1 6 5) (2 3 7) (2 7 6) (3 4 8) (3 8 7) (4 1 5) (4 5 8))))

(define spikes
  ;; Slivers of a millimetre beside large faces, two of them one above the other.
  (obj '((0 0 -1) (0.001 0 -1) (0 0 2) (-2 -1 -1) (2 -1 -1) (0 2 -1) (0 0.001 2) (1 0 0) (1.001 0 0) (1 1 2))
       '((1 2 3) (4 5 6) (1 2 7) (8 9 10) (4 6 3))))

(define meshes
  `((tetra . ,tetra) (sheet . ,sheet) (crate . ,crate) (spikes . ,spikes)))

(define (mesh-file name)
  "Return the name of a file of triangles: NAME is tetra, sheet, crate or spikes."
  (file-of 'mesh-file meshes name ".obj"))


;;; Heights, as ESRI ASCII grids: 21 by 21 posts 2 m apart about the origin.

(define posts 21)
(define spacing 2)

(define (post i)
  (* spacing (- i (quotient posts 2))))

(define (heights z)
  (append (list (simple-format #f "ncols ~a" posts) (simple-format #f "nrows ~a" posts)
                (simple-format #f "xllcorner ~a" (post 0)) (simple-format #f "yllcorner ~a" (post 0))
                (simple-format #f "cellsize ~a" spacing) "NODATA_value -9999")
          (map (lambda (row)
                 (string-join (map (lambda (column)
                                     (number->string
                                      (exact->inexact (z (post column) (post (- posts 1 row))))))
                                   (iota posts))))
               (iota posts))))

(define grids
  `((slope . ,(heights (lambda (x y) (+ -14 (* 0.2 y)))))
    (steps . ,(heights (lambda (x y) (if (> x 0) -11 -14))))
    (ridge . ,(heights (lambda (x y) (- (* -0.2 (abs x)) 12))))
    (holes . ,(heights (lambda (x y) (if (= 0 (modulo (+ x y) 10)) -9999 -13))))))

(define (heights-file name)
  "Return the name of a grid of heights: NAME is slope, steps, ridge or holes."
  (file-of 'heights-file grids name ".asc"))


;;; Currents in space and time, rows x y z t u v w.

(define (rows velocity)
  (cons "x,y,z,t,u,v,w"
        (append-map
         (lambda (t)
           (append-map
            (lambda (z)
              (append-map
               (lambda (y)
                 (map (lambda (x)
                        (string-join (map number->string
                                          (append (list x y z t) (map exact->inexact (velocity x y z t))))
                                     ","))
                      '(-20 0 20)))
               '(-20 0 20)))
            '(-30 0)))
         '(0 60))))

(define currents
  `((shear . ,(rows (lambda (x y z t) (list (+ 0.5 (/ z 60)) (/ t 300) 0))))
    (eddy . ,(rows (lambda (x y z t) (list (/ y -40) (/ x 40) 0))))))

(define (current-file name)
  "Return the name of a file of measured currents: NAME is shear or eddy."
  (file-of 'current-file currents name ".csv"))
