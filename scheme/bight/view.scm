;;; (bight view) --- the dive drawn in plain characters.
;;;
;;; `look' draws the tether from above and from the side, on one scale, and returns a picture, which is
;;; text that prints as itself.  Everything comes from the queries a user has too.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module ((bight core units) #:select (vec))
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module (bight view asking)
  #:use-module (bight view canvas)
  #:use-module (bight view text)
  #:use-module (bight world bed)
  #:use-module (srfi srfi-1)
  #:export (look side-shown?
            plan-lines
            scene-lines-with
            scene?))


;;; What there is to draw: a scene is read once from the dive.

(define-record <scene>
  (make-scene lines tails outlines names vehicles headings current bed tubes)
  scene?
  (lines scene-lines)                   ; of each tether its points, lists (x y z), from the anchor
  (tails scene-tails)                   ; of each parted one, those of the other part
  (outlines scene-outlines)             ; lines that outline the obstacles, lists of points
  (names scene-names)                   ; of the vehicles, symbols
  (vehicles scene-vehicles)             ; a list (x y z) each
  (headings scene-headings)             ; degrees each
  (current scene-current)               ; at the first vehicle, a list of components
  (bed scene-bed)                       ; a procedure: the height of the sea bed at X Y, #f: there is none
  (tubes scene-tubes))                  ; of a belief: (CHARACTER . STATIONS) each, the widest first

(define (in-tube name)
  (module-ref (resolve-interface '(bight view tube)) name))

(define (marked-tubes drawing)
  (map (lambda (tube) (cons (if (> (car tube) 0.5) #\. #\:) (cdr tube))) ((in-tube 'drawing-tubes) drawing)))

(define* (read-scene #:optional drawing)
  ;; With the tubes of DRAWING, what a belief holds possible, if it is not #f.
  (let ((vehicles (vehicles 'look))
        (tethers (tethers 'look)))
    (when (null? vehicles)
      (bight-raise 'name 'look "this dive has no vehicle to look at"))
    (make-scene (filter-map (lambda (name) (and=> (answer (tether-points name)) array->list)) tethers)
                (filter-map (lambda (name) (and=> (answer (tether-tail name)) array->list)) tethers)
                (outlines 'look)
                vehicles
                (map (lambda (name) (point->list (rov-position name))) vehicles)
                (map rov-heading vehicles)
                (point->list (current-at (rov-position (car vehicles))))
                (bed-of 'look)
                (if drawing (marked-tubes drawing) '()))))

(define sky 1000)                       ; m: the bed is looked for from here down

(define (bed-of proc)
  (let* ((engine (this-engine proc))
         (bed (bed-number engine))
         (name (and bed (list-ref (%names engine 'obstacle) bed))))
    (lambda (x y)
      (and name
           (let ((hit (%altitude engine (vec x y sky))))
             (and (eq? (cdr hit) name) (- sky (car hit))))))))

(define (outlines proc)
  (let ((engine (this-engine proc)))
    (append-map (lambda (i) (map array->list (%outline engine i)))
                (iota (length (%names engine 'obstacle))))))

(define (scene-points scene)
  (append (concatenate (scene-lines scene)) (concatenate (scene-tails scene)) (scene-vehicles scene)))

(define (mean numbers)
  (/ (apply + numbers) (length numbers)))

(define (main-direction scene)
  ;; The bearing along which the scene is longest (least squares), from the anchor to the vehicle.
  (let* ((points (scene-points scene))
         (xs (map first points))
         (ys (map second points))
         (mx (mean xs))
         (my (mean ys))
         (moment (lambda (as ma bs mb)
                   (let loop ((as as) (bs bs) (sum 0))
                     (if (null? as)
                         sum
                         (loop (cdr as) (cdr bs) (+ sum (* (- (car as) ma) (- (car bs) mb))))))))
         (angle (* 1/2 (atan (* 2 (moment xs mx ys my))
                             (- (moment xs mx xs mx) (moment ys my ys my)))))
         (forward (+ (* (cos angle) (- (last xs) (first xs)))
                     (* (sin angle) (- (last ys) (first ys))))))
    (bearing-of (if (< forward -1e-9) (- (cos angle)) (cos angle))
                (if (< forward -1e-9) (- (sin angle)) (sin angle)))))

(define (from-above point)
  (cons (first point) (second point)))

(define (from-the-side bearing origin)
  ;; The projection on the upright plane through ORIGIN that runs toward BEARING.
  (let ((east (sin (* radian bearing)))
        (north (cos (* radian bearing))))
    (lambda (point)
      (cons (+ (* east (- (first point) (first origin)))
               (* north (- (second point) (second origin))))
            (third point)))))


;;; Fitting.

(define (call-with-extremes numbers receive)
  ;; What RECEIVE returns for the least and the greatest of NUMBERS.
  (let loop ((rest (cdr numbers)) (least (car numbers)) (most (car numbers)))
    (if (null? rest)
        (receive least most)
        (let ((x (car rest)))
          (loop (cdr rest) (if (< x least) x least) (if (> x most) x most))))))

(define (extent numbers)
  (call-with-extremes numbers (lambda (least most) (- most least))))

(define (middle numbers)
  (call-with-extremes numbers (lambda (least most) (/ (+ most least) 2))))

(define (middle-of places)
  (cons (middle (map car places)) (middle (map cdr places))))

(define finest-step 0.1)

(define (step-for places columns rows)
  ;; The metres a column must span for PLACES to fit, with a margin.
  (max (/ (extent (map car places)) (- columns 4))
       (/ (extent (map cdr places)) (* 2 (- rows 3)))
       finest-step))

(define (near-levels scene places)
  ;; The levels, surface and sea bed below the first vehicle, that are near enough to be shown with PLACES.
  (let* ((heights (map cdr places))
         (reach (max 3 (extent heights) (* 1/2 (extent (map car places))))))
    (call-with-extremes heights
      (lambda (least most)
        (filter (lambda (level) (and level (< (- least reach) level (+ most reach))))
                (list 0 (apply (scene-bed scene) (take (car (scene-vehicles scene)) 2))))))))

(define (with-levels levels places)
  (append (map (lambda (level) (cons (car (car places)) level)) levels) places))

(define (nice-length x)
  ;; The largest of 1, 2 and 5 times a power of ten that is not above X.
  (let* ((power (expt 10 (inexact->exact (floor (log10 x)))))
         (ratio (/ x power)))
    (* power (cond ((>= ratio 5) 5) ((>= ratio 2) 2) (else 1)))))

(define (scale-bar step columns)
  (let* ((metres (nice-length (* step columns 1/3)))
         (cells (max 2 (inexact->exact (round (/ metres step))))))
    (string-append "|" (make-string (- cells 1) #\-) "| "
                   (number->string (if (>= metres 1) metres (exact->inexact metres))) " m")))


;;; Drawing the scene.

(define (heading-mark heading)
  (string-ref "^>v<" (modulo (inexact->exact (round (/ heading 90))) 4)))

(define (side-mark bearing)
  ;; The mark, by its heading, of a vehicle seen with BEARING to the right: o as it points at us or away.
  (lambda (heading)
    (let ((along (cos (* radian (- heading bearing)))))
      (cond ((> along 0.4) #\>) ((< along -0.4) #\<) (else #\o)))))

(define (draw-outline! canvas places)
  (for-each (lambda (a b) (mark-line! canvas #\# a b)) places (cdr places)))

(define (draw-tube! canvas stations project mark)
  ((in-tube 'for-each-inside)
   (lambda (column row) (put! canvas (cons column row) mark))
   stations (compose project point->list) (canvas-left canvas) (canvas-top canvas)
   (canvas-step canvas) (* -2 (canvas-step canvas))
   (canvas-columns canvas) (vector-length (canvas-rows canvas))))

(define (draw-scene! canvas scene project mark)
  (for-each (lambda (tube) (draw-tube! canvas (cdr tube) project (car tube)))
            (scene-tubes scene))
  (for-each (lambda (line) (draw-outline! canvas (map project line)))
            (scene-outlines scene))
  (for-each (lambda (line)
              (draw-line! canvas (map project line))
              (put! canvas (cell-of canvas (project (car line))) #\A))
            (scene-lines scene))
  (for-each (lambda (line) (draw-line! canvas (map project line)))
            (scene-tails scene))
  (for-each (lambda (vehicle heading)
              (put! canvas (cell-of canvas (project vehicle)) (mark heading)))
            (scene-vehicles scene) (scene-headings scene)))

(define (top-panel scene places columns rows step)
  (let ((canvas (make-canvas columns rows (middle-of places) step)))
    (draw-scene! canvas scene from-above heading-mark)
    (frame "from above, north up" (canvas->lines canvas) columns)))

(define* (plan-lines columns rows marks #:optional drawing)
  "Return the present dive from above, north up, as ROWS lines of COLUMNS, the last with the scale; MARKS is a list of
(CHARACTER . POINT) that are in it, and DRAWING what a belief holds possible, or #f."
  (let* ((scene (read-scene drawing))
         (spots (map (lambda (mark) (from-above (point->list (cdr mark)))) marks))
         (places (append (map from-above (scene-points scene)) spots))
         (step (step-for places columns (- rows 1)))
         (canvas (make-canvas columns (- rows 1) (middle-of places) step)))
    (draw-scene! canvas scene from-above heading-mark)
    (for-each (lambda (mark spot) (put! canvas (cell-of canvas spot) (car mark))) marks spots)
    (append (canvas->lines canvas)
            (list (string-pad-right (string-append "N up " (scale-bar step columns)) columns)))))

(define (draw-bed! canvas scene bearing)
  ;; The bed along the plane of `from-the-side'.
  (let ((origin (car (scene-points scene))) (east (sin (* radian bearing))) (north (cos (* radian bearing))))
    (for-each (lambda (column)
                (let* ((s (+ (canvas-left canvas) (* (canvas-step canvas) (+ column 1/2))))
                       (height ((scene-bed scene) (+ (first origin) (* s east)) (+ (second origin) (* s north)))))
                  (when height
                    (put! canvas (cons column (cdr (cell-of canvas (cons s height)))) #\=))))
              (iota (canvas-columns canvas)))))

(define (side-panel scene places levels project bearing columns rows step)
  (let ((canvas (make-canvas columns rows (middle-of (with-levels levels places)) step)))
    (put-row! canvas 0 #\~)
    (draw-bed! canvas scene bearing)
    (draw-scene! canvas scene project (side-mark bearing))
    (frame (string-append "from the side, toward " (bearing->string bearing))
           (canvas->lines canvas) columns)))

(define (legend scene step columns)
  (string-join
   (append (list (scale-bar step columns))
           (if (pair? (scene-lines scene)) '("A anchor") '())
           (map (lambda (name heading) (simple-format #f "~a ~a" (heading-mark heading) name))
                (scene-names scene) (scene-headings scene))
           (list (string-append "current " (current->string (scene-current scene))))
           (if (answer (rov-over (car (scene-names scene)))) '() '("no bed below")))
   "   "))

(define panel-rows 18)

;; What a drawing is of: the tethers and vehicles, and the structure beside them, as far as it is no
;; further off than a sixth of their size, or than the nearest of it.

(define (box-of points)
  ;; The least and the greatest coordinates of POINTS.
  (apply map list
         (map (lambda (coordinate) (call-with-extremes (map coordinate points) list)) (list first second third))))

(define (gap-to box point)
  (sqrt (apply + (map (lambda (low high x) (expt (max 0 (- low x) (- x high)) 2))
                      (first box) (second box) point))))

(define (clamped box reach point)
  (map (lambda (low high x) (max (- low reach) (min (+ high reach) x))) (first box) (second box) point))

(define (size-of box)
  (sqrt (apply + (map (lambda (low high) (expt (- high low) 2)) (first box) (second box)))))

(define (places-of-structure scene)
  ;; Points of the structure that belong in a drawing of SCENE.
  (let ((lines (filter pair? (scene-outlines scene))))
    (if (null? lines)
        '()
        (let* ((box (box-of (scene-points scene)))
               (size (max 1 (size-of box)))
               (gaps (map (lambda (line) (apply min (map (lambda (p) (gap-to box p)) line))) lines))
               (nearest (apply min gaps))
               (line (list-ref lines (list-index (lambda (gap) (= gap nearest)) gaps)))
               (reach (if (< (/ size 6) nearest size)
                          (+ nearest (min (size-of (box-of line)) (/ size 2)))
                          (/ size 6))))
          (append-map (lambda (line gap)
                        (if (<= gap reach) (map (lambda (p) (clamped box reach p)) line) '()))
                      lines gaps)))))

(define (draw scene width side? at extent zoom)
  ;; The lines of both panels, or of the left one alone unless SIDE?, side by side in WIDTH columns.
  (let* ((columns (- (quotient (- width 1) 2) 2))
         (bearing (main-direction scene))
         (project (from-the-side bearing (car (scene-points scene))))
         (all (append (scene-points scene) (places-of-structure scene)))
         (points (if at (list at) all))
         (above (map from-above points))
         (beside (map project points))
         (levels (if (or at extent) '() (near-levels scene beside)))
         (step (/ (if extent
                      (/ extent columns)
                      (step-to-fit (if at (map from-above all) above) (if at (map project all) beside) columns levels))
                  zoom)))
    (append (let ((top (top-panel scene above columns panel-rows step)))
              (if side?
                  (map (lambda (left right) (string-append left " " right))
                       top
                       (side-panel scene beside levels project bearing columns panel-rows step))
                  top))
            (list (string-append " " (legend scene step columns))))))

(define (step-to-fit above beside columns levels)
  ;; The metres a column spans when the places of both drawings are in them.
  (max (step-for above columns panel-rows)
       (step-for (with-levels levels beside) columns panel-rows)))

;; False where a pupil is to see the view from above alone, whatever he asks for.
(define side-shown? (make-parameter #t))

(define-verb (look #:key (columns (or-false (between 40 400))) (side flag #t) (belief flag #f)
                   (at (or-false point)) (extent (or-false (between 0.01 1e6))) (zoom (between 1e-3 1e3) 1))
  "Draw the present dive in plain characters, from above (north up) and, unless SIDE is #f, from the side,
on one scale in both: A is the anchor, ^ > v < the vehicle and where it heads, # an obstacle, ~ the surface, = the
sea bed, where there is one.  The tethers, the vehicles and the structure beside them are in it; AT is
another point for the middle, EXTENT how many metres each drawing spans, ZOOM how many times nearer it
is.  With BELIEF what the current belief holds possible is in it: : where a tether is with 50 %, . with 90 %.  The drawing is COLUMNS wide, by default as wide as the terminal.  Return a picture, which prints as
text."
  (let ((width (inexact->exact (floor (or columns (max 40 (min 160 (terminal-columns))))))))
    (lines->picture (draw (read-scene (and belief ((in-tube 'read-drawing) #:lines? #f))) width (and side (side-shown?))
                          (and at (array->list at)) extent zoom))))

(define (scene-lines-with drawing columns)
  "Return what `look' draws in COLUMNS, a list of strings, with DRAWING, what a belief holds possible, or #f."
  (picture-lines (lines->picture (draw (read-scene drawing) columns (side-shown?) #f #f 1))))
