;;; (bight view) --- the dive in plain characters: two drawings and a panel of figures.
;;;
;;; `look' draws the tether from above and from the side, on one scale; `status' tells the figures.
;;; Both return a picture, which is text that prints as itself.  A canvas is an array of characters
;;; with a frame: metres to cells, a cell being twice as high as wide.  Everything comes from the
;;; queries a user has too.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view)
  #:use-module ((bight core decimal) #:select (fixed text->number))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module ((bight core units) #:select (vec))
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (windings->strings))
  #:use-module ((bight dive command) #:select (spooling?))
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module ((bight outlet) #:select (watched?))
  #:use-module (bight world bed)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (look side-shown?
            status
            picture?
            picture-lines
            lines->picture
            plan-lines
            scene-lines-with
            terminal-columns
            scene?
            canvas?))


;;; Pictures: text that prints as itself.

(define-record <picture>
  (make-picture lines)
  picture?
  (lines picture-lines))

(set-record-type-printer! <picture>
  (lambda (picture port)
    (display (string-join (picture-lines picture) "\n") port)))

(define (lines->picture lines)
  "Return the picture whose text is LINES, a list of strings."
  (make-picture (map (lambda (line) (string-trim-right line #\space)) lines)))

(define (stty-columns)
  ;; The width that the terminal itself reports, or #f.
  (and (watched? (current-output-port))
       (false-if-exception
        (let* ((open (module-ref (resolve-interface '(ice-9 popen)) 'open-input-pipe))
               (close (module-ref (resolve-interface '(ice-9 popen)) 'close-pipe))
               (pipe (open "stty size < /dev/tty 2> /dev/null"))
               (rows (read pipe))
               (columns (read pipe)))
          (close pipe)
          (and (integer? rows) (integer? columns) columns)))))

(define (terminal-columns)
  "Return the number of columns of the terminal: from the variable COLUMNS, from the terminal, or 80."
  (let ((columns (or (and=> (getenv "COLUMNS") text->number) (stty-columns))))
    (if (and columns (exact-integer? columns) (> columns 0)) columns 80)))


;;; Asking, where a dive may have no answer.

(define-syntax-rule (answer expression)
  ;; The value of EXPRESSION, or #f if the dive cannot tell.
  (with-exception-handler
      (lambda (exception)
        (if (bight-error? exception) #f (raise-exception exception)))
    (lambda () expression)
    #:unwind? #t))

(define (ask name . arguments)
  ;; As `answer', for a query that the language may not have yet.
  (let ((variable (module-variable (resolve-interface '(bight)) name)))
    (and variable (answer (apply (variable-ref variable) arguments)))))

(define (vehicles proc)
  (%names (this-engine proc) 'rov))

(define (tethers proc)
  (%names (this-engine proc) 'tether))

(define (point->list p)
  (if (list? p) p (array->list p)))


;;; Numbers as people read them.

(define (bearing->string degrees)
  (string-pad (number->string (modulo (inexact->exact (round degrees)) 360)) 3 #\0))

(define radian (/ (acos -1) 180))

(define (bearing-of x y)
  (let ((degrees (/ (atan x y) radian)))
    (if (negative? degrees) (+ 360 degrees) degrees)))

(define (horizontal-speed v)
  (sqrt (+ (expt (first v) 2) (expt (second v) 2))))

(define (current->string v)
  ;; A current, a list of its components, as speed, arrow and bearing.
  (let* ((speed (horizontal-speed v))
         (toward (bearing-of (first v) (second v))))
    (if (< speed 0.005)
        "none"
        (string-append (fixed speed 2) " m/s " (arrow toward) " " (bearing->string toward)))))

(define (arrow bearing)
  (vector-ref #("^" "^>" "-->" "v>" "v" "<v" "<--" "<^")
              (modulo (inexact->exact (round (/ bearing 45))) 8)))


;;; Canvases.

(define-record <canvas>
  (%make-canvas rows left top step)
  canvas?
  (rows canvas-rows)                    ; a vector of strings
  (left canvas-left)                    ; metres at the left edge
  (top canvas-top)                      ; metres at the upper edge
  (step canvas-step))                   ; metres a column; a row is twice that

(define (make-canvas columns rows middle step)
  ;; A blank canvas with the point MIDDLE, a pair of metres, in its middle.
  (%make-canvas (list->vector (map (lambda (row) (make-string columns #\space)) (iota rows)))
                (- (car middle) (* 1/2 columns step))
                (+ (cdr middle) (* rows step))
                step))

(define (canvas-columns canvas)
  (string-length (vector-ref (canvas-rows canvas) 0)))

(define (cell-of canvas place)
  ;; The cell, a pair of column and row, at PLACE, a pair of metres.
  (let ((step (canvas-step canvas)))
    (cons (inexact->exact (floor (/ (- (car place) (canvas-left canvas)) step)))
          (inexact->exact (floor (/ (- (canvas-top canvas) (cdr place)) (* 2 step)))))))

(define (put! canvas cell char)
  (let ((rows (canvas-rows canvas)))
    (when (and (< -1 (cdr cell) (vector-length rows)) (< -1 (car cell) (canvas-columns canvas)))
      (string-set! (vector-ref rows (cdr cell)) (car cell) char))))

(define (put-row! canvas height char)
  ;; A level line at HEIGHT metres, behind everything drawn later.
  (let ((row (cdr (cell-of canvas (cons 0 height)))))
    (for-each (lambda (column) (put! canvas (cons column row) char))
              (iota (canvas-columns canvas)))))

(define (cells-between a b)
  ;; The cells from A, left out, to B, each touching the next.
  (let* ((dx (- (car b) (car a)))
         (dy (- (cdr b) (cdr a)))
         (n (max (abs dx) (abs dy))))
    (map (lambda (i)
           (cons (+ (car a) (round (/ (* i dx) n)))
                 (+ (cdr a) (round (/ (* i dy) n)))))
         (iota n 1))))

(define (trace-cells corners)
  ;; The connected cells along CORNERS, a list of cells.
  (let loop ((rest (cdr corners)) (at (car corners)) (trail (list (car corners))))
    (if (null? rest)
        (reverse trail)
        (loop (cdr rest) (car rest)
              (append (reverse (cells-between at (car rest))) trail)))))

(define (stroke before after)
  ;; The character that leads from the cell BEFORE to the cell AFTER.
  (let ((dx (- (car after) (car before)))
        (dy (- (cdr after) (cdr before))))
    (cond ((zero? dy) #\-)
          ((zero? dx) #\|)
          ((positive? (* dx dy)) #\\)
          (else #\/))))

(define (mark-line! canvas char a b)
  ;; Put CHAR all along the straight line from A to B, pairs of metres, where it is on the canvas.
  (let* ((step (canvas-step canvas))
         (dx (- (car b) (car a)))
         (dy (- (cdr b) (cdr a)))
         (span (clipped canvas a dx dy)))
    (when span
      (let* ((from (car span)) (length (- (cdr span) from))
             (n (+ 1 (inexact->exact
                      (ceiling (/ (* length (max (abs dx) (* 1/2 (abs dy)))) step))))))
        (do ((i 0 (+ i 1))) ((> i n))
          (let ((k (+ from (* length (/ i n)))))
            (put! canvas (cell-of canvas (cons (+ (car a) (* k dx)) (+ (cdr a) (* k dy)))) char)))))))

(define (clipped canvas a dx dy)
  ;; The shares, a pair, between which the line from A by (DX DY) is on the canvas, or #f.
  (let ((width (* (canvas-columns canvas) (canvas-step canvas)))
        (height (* 2 (vector-length (canvas-rows canvas)) (canvas-step canvas))))
    (define (cut span start way low high)
      (and span
           (if (zero? way)
               (and (<= low start high) span)
               (let* ((s (/ (- low start) way)) (t (/ (- high start) way))
                      (from (max (car span) (min s t))) (to (min (cdr span) (max s t))))
                 (and (<= from to) (cons from to))))))
    (cut (cut '(0 . 1) (car a) dx (canvas-left canvas) (+ (canvas-left canvas) width))
         (cdr a) dy (- (canvas-top canvas) height) (canvas-top canvas))))

(define (draw-line! canvas places)
  ;; Draw the line through PLACES, a list of pairs of metres.
  (let ((trail (trace-cells (map (lambda (place) (cell-of canvas place)) places))))
    (let loop ((before (car trail)) (rest trail))
      (unless (null? rest)
        (let ((after (if (null? (cdr rest)) (car rest) (cadr rest))))
          (put! canvas (car rest) (if (equal? before after) #\* (stroke before after)))
          (loop (car rest) (cdr rest)))))))

(define (canvas->lines canvas)
  (vector->list (canvas-rows canvas)))

(define (frame title lines columns)
  ;; LINES, each COLUMNS long, in a box under TITLE.
  (let ((edge (string-append "+" (make-string columns #\-) "+")))
    (append (list (string-pad-right (string-append " " title) (+ 2 columns)) edge)
            (map (lambda (line) (string-append "|" line "|")) lines)
            (list edge))))


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


;;; The panel of figures.  A row is a title and its cells; what the dive cannot tell is left out.

(define (cell label value . units)
  ;; "LABEL VALUE UNITS", or #f if there is no VALUE.
  (and value
       (string-join (remove string-null? (cons* label value units)) " ")))

(define (figure x places)
  (and (real? x) (fixed x places)))

(define (point->string p)
  (and p
       (string-append "(" (string-join (map (lambda (x) (fixed x 2)) (point->list p)) " ") ")")))

(define (row title . cells)
  (let ((cells (filter identity cells)))
    (and (pair? cells)
         (string-append (string-pad-right title 10) (string-join cells "   ")))))

(define (vehicle-rows name)
  (list (row (symbol->string name)
             (cell "at" (point->string (rov-position name)))
             (cell "heading" (bearing->string (rov-heading name)))
             (cell "speed" (figure (rov-speed name) 2) "m/s")
             (cell "depth" (figure (rov-depth name) 2) "m"))
        (apply row "sticks"
               (cell "turns" (figure (net-turns name) 2))
               (map (lambda (title value) (cell title (figure value 2)))
                    '("surge" "sway" "heave" "yaw")
                    (point->list (sticks name))))
        (row "attitude"
             (cell "altitude" (figure (answer (rov-altitude name)) 2) "m")
             (cell "" (over->string (ask 'rov-over name)))
             (cell "pitch" (figure (rov-pitch name) 1))
             (cell "roll" (figure (rov-roll name) 1))
             (let ((all (ask 'thrusts name)))
               (and all (positive? (array-length all))
                    (cell "thrust" (string-join (map (lambda (f) (fixed f 0)) (array->list all)))
                          "N"))))
        (row "current"
             (cell "" (current->string (point->list (current-at (rov-position name))))))))

(define (over->string below)
  ;; What is below, unless that is the bed.
  (cond ((not below) "no bed: counted from the sea's depth")
        ((eq? below 'seabed) #f)
        (else (simple-format #f "over ~a" below))))

(define (tether-rows name)
  (list (row (symbol->string name)
             (word->string (model-of name))
             (cell "out" (figure (tether-length name) 2) "m")
             (cell "chord" (figure (straight-distance name) 2) "m")
             (cell "slack" (and=> (answer (slack name)) (lambda (s) (fixed (* 100 s) 1))) "%")
             (cell "contacts" (and=> (ask 'contacts name)
                                     (lambda (all) (number->string (length all))))))
        (row "tension"
             (cell "anchor" (figure (answer (anchor-tension name)) 1) "N")
             (cell "vehicle" (figure (answer (rov-tension name)) 1) "N")
             (cell "most" (figure (answer (max-tension name)) 1) "N")
             (worn name))))

(define (worn name)
  ;; What is worn of the jacket of the tether NAME, #f while it does not show.
  (let ((share (ask 'wear name)))
    (and share (>= share 5e-4)
         (cell "worn" (fixed (* 100 share) 1) "%"))))

(define (among-obstacles?)
  (pair? (%names (this-engine 'status) 'obstacle)))

(define (awareness-rows name)
  ;; What the tether is doing among obstacles; nothing in open water.
  (if (among-obstacles?)
      (list (row "string"
                 (cell "taut" (figure (answer (taut-length name)) 2) "m")
                 (cell "free way" (figure (answer (free-length name)) 2) "m")
                 (cell "excess" (figure (answer (excess name)) 2) "m"))
            (apply row "windings"
                   (or (answer (windings->strings (subject-index 'status 'tether name))) '())))
      '()))

(define (foul-warning name)
  (let ((reason (and (among-obstacles?) (ask 'foul-reason name))))
    (and reason (string-append "fouled: " (symbol->string reason)))))

(define tension-alarm 0.5)              ; share of the breaking load

(define (breaking-load name)
  (let ((properties (tether-properties (subject-index 'status 'tether name))))
    (assq-ref properties 'breaking-load)))

(define (overload name)
  ;; What to say if the tether NAME is near to breaking, else #f.
  (let ((most (answer (max-tension name)))
        (limit (breaking-load name)))
    (and (real? most) (real? limit) (> most (* tension-alarm limit))
         (string-append "tension at " (fixed (* 100 (/ most limit)) 0) " % of the breaking load"))))

(define (inexactness name)
  (and (not (answer (accurate? name)))
       (string-append "shape uncertain by " (fixed (error-estimate name) 2) " m")))

(define (tether-warnings name)
  (map (lambda (text) (simple-format #f "~a ~a" name text))
       (filter identity
               (list (and (ask 'parted? name) "parted")
                     (and (answer (taut? name)) "taut")
                     (and (ask 'stuck? name) "stuck")
                     (foul-warning name)
                     (overload name)
                     (inexactness name)
                     (and (answer (spooling? name)) "spooling")))))

(define (broken->string fault)
  (if (pair? fault) (simple-format #f "~a ~a" (car fault) (cadr fault)) (symbol->string fault)))

(define recent 3)                       ; s: what is still worth a warning

(define (near-props? name)
  (find (lambda (event) (and (eq? 'prop-danger (first event)) (eq? name (third event))))
        (events #:since (- (now) recent))))

(define (vehicle-warnings name)
  (map (lambda (text) (simple-format #f "~a ~a" name text))
       (filter identity
               (list (and (answer (held? name)) "held back")
                     (and (not (over-bed? (this-engine 'status) (rov-position name)))
                          "is beyond the edge of the bed")
                     (and (near-props? name) "has a tether near its thrusters")
                     (let ((broken (or (ask 'faults name) '())))
                       (and (pair? broken)
                            (string-append "without " (string-join (map broken->string broken) ", "))))))))

(define-verb (status)
  "Return the figures of the present dive as a picture, which prints as text: time, and of each vehicle
and tether position, sticks, current, length, slack, tension; then what to beware of."
  (let* ((vehicles (vehicles 'status))
         (tethers (tethers 'status))
         (time (row "time" (string-append (fixed (now) 2) " s")))
         (warnings (append (append-map vehicle-warnings vehicles)
                           (append-map tether-warnings tethers))))
    (lines->picture
     (filter identity
             (append (list time)
                     (append-map vehicle-rows vehicles)
                     (append-map tether-rows tethers)
                     (append-map awareness-rows tethers)
                     (list (and (pair? warnings)
                                (row "BEWARE" (string-join warnings "; ")))))))))
