;;; (bight view picture) --- pictures of the dive: in a file, in the terminal.
;;;
;;; `snapshot' writes a PNG, `show' puts the same picture in the terminal.  Both ask the renderer, an
;;; extension that is loaded here and now, for the pixels of each view; a sheet of several views is put
;;; together of theirs.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view picture)
  #:use-module ((bight cockpit palette) #:select (ascii-terminal?))
  #:use-module (bight core argument)
  #:use-module ((bight core errors)
                #:select (bight-raise bight-error? bight-error-kind bight-error-message nearest))
  #:use-module (bight core late)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight outlet) #:select (control watched?))
  #:use-module ((bight world) #:select (world-name))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (snapshot
            show
            renderer-name
            renderer
            picture-pixels
            write-picture
            type:views
            type:pixels
            type:overlay
            in-water
            caption?))


;;; What is loaded when it is used.

(define (extension module name)
  ;; The value of NAME in MODULE, or #f if its extension cannot be loaded.
  (false-if-exception (module-ref (resolve-interface module) name)))

(define (on-behalf proc procedure)
  ;; PROCEDURE, whose errors are those of PROC.
  (lambda arguments
    (with-exception-handler
        (lambda (e)
          (if (bight-error? e)
              (bight-raise (bight-error-kind e) proc "~a" (bight-error-message e))
              (raise-exception e)))
      (lambda () (apply procedure arguments))
      #:unwind? #t)))

(define (renders proc name)
  (on-behalf
   proc
   (or (extension '(bight view render) name)
       (bight-raise 'unsupported proc
                    "there are no pictures: this bight was built without its renderer, bight-render"))))

(define the-renderer #f)                ; opened once

(define (renderer proc)
  "Return what draws pictures, opened if it was not, or raise a &bight-error from PROC."
  (unless the-renderer
    (set! the-renderer ((renders proc '%open-renderer) #f)))
  the-renderer)

(define (renderer-name)
  "Return what draws pictures, a string, or raise a &bight-error when nothing can."
  ((renders 'snapshot '%renderer-name) (renderer 'snapshot)))


;;; Arguments.

(define views '(chase pilot top side north east overview plan sonar))

(define (look-from value)
  ;; (look FROM AT) as an f64vector of six numbers, or #f.
  (and (list? value) (= 3 (length value)) (eq? 'look (car value))
       (every (lambda (p) (accepts? type:point p)) (cdr value))
       (let ((points (map (argument-type-coerce type:point) (cdr value))))
         (list->f64vector (append-map f64vector->list points)))))

(define (one-view value)
  (cond ((memq value views) value)
        ((look-from value))
        (else #f)))

(define most-views 16)

(define (several-views value)
  (let ((views (and (pair? value) (bounded-list value most-views))))
    (and views (every one-view views) (map one-view views))))

(define type:views
  ;; A list of views, each a symbol or an f64vector.
  (make-argument-type
   'views
   (lambda (value)
     (cond ((one-view value) => list)
           ((several-views value))
           (else refused)))
   (string-append (alternatives->string (append views '("(look FROM AT)")))
                  ", or a list of up to 16 of them for a sheet")
   views))

(define least-side 16)
(define most-side 8192)

(define (whole-between low high)
  (lambda (n) (and (real? n) (<= low n high) (integer? n))))

(define (pair-of-sides value low high)
  (if (and (list? value) (= 2 (length value)) (every (whole-between low high) value))
      (cons (inexact->exact (first value)) (inexact->exact (second value)))
      refused))

(define-argument-type (pixels value)
  "(WIDTH HEIGHT) in pixels, each a whole number from 16 to 8192"
  (pair-of-sides value least-side most-side))

(define-argument-type (cells value)
  "(COLUMNS ROWS) in characters, each a whole number from 4 to 400"
  (pair-of-sides value 4 400))

;; What is drawn over a picture: (bvh LEVEL) is one level of what bvh shows the first of.

(define overlays '(figures none contacts turns taut-string bvh current belief))

(define deepest 30)

(define (one-overlay value)
  ;; VALUE as a list of flags for the renderer, or #f.
  (cond ((eq? value 'none) '())
        ((memq value overlays) (list value))
        ((and (list? value) (= 2 (length value)) (eq? 'bvh (car value))
              ((whole-between 0 deepest) (cadr value)))
         (list 'bvh (inexact->exact (cadr value))))
        (else #f)))

(define (several-overlays value)
  (let ((values (and (pair? value) (bounded-list value (length overlays)))))
    (and values (every one-overlay values) (append-map one-overlay values))))

(define (with-figures flags)
  ;; Whatever is shown besides is read with the figures.
  (if (or (null? flags) (memq 'figures flags)) flags (cons 'figures flags)))

(define type:overlay
  ;; A list of flags.
  (make-argument-type
   'overlay
   (lambda (value)
     (cond ((or (one-overlay value) (several-overlays value)) => with-figures)
           (else refused)))
   (string-append (alternatives->string (append overlays '("(bvh LEVEL)")))
                  ", or a list of several of these")
   overlays))

(define (extension-of file)
  ;; What follows the last dot of FILE's own name, or #f.
  (let* ((name (basename file))
         (dot (string-rindex name #\.)))
    (and dot (> dot 0) (substring name (+ dot 1)))))

(define-argument-type (png-file value)
  "the name of a file to write, such as \"dive.png\""
  (if (and (string? value) (not (string-null? value)) (not (string-index value #\nul)))
      value
      refused))

(define (check-file proc file)
  (let ((kind (extension-of file)))
    (when (and kind (not (string-ci=? kind "png")))
      (bight-raise 'domain proc "a picture is written as PNG: name it ~s, not ~s"
                   (string-append (substring file 0 (- (string-length file) (string-length kind)))
                                  "png")
                   file))
    (when (and (file-exists? file) (file-is-directory? file))
      (bight-raise 'io proc "cannot write ~s: it is a folder" file))))


;;; Drawing.

(define (view-name view)
  (let ((view (if (pair? view) (car view) view)))
    (if (symbol? view) (symbol->string view) "look")))

(define (moved views at extent zoom)
  ;; VIEWS, their cameras moved as the keywords of `snapshot' say: lists as the renderer takes them.
  (if (or at extent zoom)
      (map (lambda (view) (list view at (or extent 0.) (or zoom 1.))) views)
      views))

(define (title-of view)
  (let ((name (world-name (dive-world (this-dive 'snapshot)))))
    (string-append (if name (symbol->string name) "a dive") ": " (view-name view))))

(define usual-range 30.)                ; m, of a sonar

(define (draw-sonar proc view size flags)
  (let ((extent (if (pair? view) (third view) 0.)))
    ((renders proc '%draw-sonar) (this-engine proc) (title-of view) size
                                 (if (zero? extent) usual-range extent) flags)))

(define (draw-view proc view size paint flags)
  ;; The pixels of one view of SIZE, a pair.
  (if (string=? "sonar" (view-name view))
      (draw-sonar proc view size flags)
      (draw-scene proc view size paint flags)))

(define (draw-scene proc view size paint flags)
  (define (draw-it . marks)
    (apply (renders proc '%draw) (and (not (string=? "plan" (view-name view))) (renderer proc))
           (this-engine proc) (title-of view) view size paint flags (if (null? marks) '() (cons #f marks))))
  (if (memq 'belief flags)
      (let ((tube (resolve-interface '(bight view tube))))
        ((module-ref tube 'draw-over) draw-it size ((module-ref tube 'read-drawing))))
      (draw-it)))

(define (put! whole width part size column row)
  ;; Copy PART of SIZE into WHOLE, WIDTH pixels wide, with its first pixel at COLUMN, ROW.
  (let ((line (* 4 (car size))))
    (do ((i 0 (+ i 1)))
        ((= i (cdr size)))
      (bytevector-copy! part (* i line) whole (* 4 (+ (* (+ row i) width) column)) line))))

(define (draw-sheet proc views size paint flags)
  ;; The pixels of a sheet of VIEWS, row by row, as square a grid as can be, thin gaps between.
  (let* ((n (length views))
         (columns (inexact->exact (ceiling (sqrt n))))
         (rows (ceiling-quotient n columns))
         (gap 2)
         (cell (cons (quotient (- (car size) (* gap (- columns 1))) columns)
                     (quotient (- (cdr size) (* gap (- rows 1))) rows)))
         (sheet (make-bytevector (* 4 (car size) (cdr size))
                                 (if (memq 'transparent flags) 0 255))))
    (when (< (min (car cell) (cdr cell)) least-side)
      (bight-raise 'domain proc "~a views do not fit in ~a x ~a pixels" n (car size) (cdr size)))
    (for-each (lambda (view i)
                (put! sheet (car size) (draw-view proc view cell paint flags) cell
                      (* (remainder i columns) (+ gap (car cell)))
                      (* (quotient i columns) (+ gap (cdr cell)))))
              views (iota n))
    sheet))

(define (ceiling-quotient a b)
  (quotient (+ a b -1) b))

(define (draw proc views size paint flags)
  (if (null? (cdr views))
      (draw-view proc (car views) size paint flags)
      (draw-sheet proc views size paint flags)))

(define (picture-pixels proc views size paint overlay)
  "Return the pixels of a picture of the dive, on behalf of PROC; the others as `snapshot' has them."
  (draw proc views size paint overlay))

(define (write-picture proc pixels size file)
  "Write PIXELS of SIZE, a pair, to FILE as PNG, on behalf of PROC."
  ((renders proc '%write-picture) pixels (car size) (cdr size) file))

(define (in-water overlay lights visibility)
  "Return OVERLAY, flags for the renderer, with those for LIGHTS, on or off, and for a VISIBILITY in metres, if any."
  (append (case lights ((on) '(lamp)) ((off) '(dark)) (else '()))
          (if visibility (list (cons 'visibility visibility)) '())
          overlay))

(define (flags-of overlay transparent)
  (if transparent (cons 'transparent overlay) overlay))


;;; In a file.

(define-record <caption>
  (make-caption text)
  caption?
  (text caption-text))

(set-record-type-printer! <caption>
  (lambda (caption port) (display (caption-text caption) port)))

(define (caption views . parts)
  (make-caption (string-append (string-concatenate parts) ", "
                               (string-join (map view-name views) " "))))

(define-verb (snapshot (file png-file)
                       #:key (view views '(overview)) (size pixels '(1280 . 720))
                       (paint (one-of plain tension curvature model) 'plain)
                       (overlay overlay '(figures))
                       (at (or-false point)) (extent (or-false positive)) (zoom (or-false positive))
                       (transparent flag #f) (lights (or-false (one-of on off))) (visibility (or-false positive)))
  "Write a picture of the dive as it is now to FILE, a PNG, and return its name and size.  VIEW is chase,
pilot, top, side, north, east, overview (the default), plan (a drawing on paper), sonar (what one that looks
ahead hears, as far as EXTENT or 30 m), (look FROM AT), or a list of these for a sheet; SIZE is (WIDTH
HEIGHT) in pixels; PAINT colours tethers plain, by tension, by curvature or by model; OVERLAY is figures
(title, scale, compass, legend) or none, or more than the figures: contacts (each with its force), turns
about what, taut-string (what the tether would shrink to), bvh (the boxes about obstacles that collisions
are looked for in, the first levels of them; (bvh LEVEL) is one alone), current (streamlines, their speed in
colours), belief (the tubes that hold the tethers of the current belief with 50 and 90 %, and its members by
class), or a list of several.  A view chooses where to look; AT is another point for the middle, EXTENT how
many metres across are seen there, ZOOM how many times nearer to go.  TRANSPARENT leaves out water and ground.  LIGHTS at the camera are on or off, and VISIBILITY is how many metres one sees in turbid water,
which also takes the daylight: with the view pilot, what the vehicle's camera sees."
  (check-file 'snapshot file)
  (let ((pixels (draw 'snapshot (moved view at extent zoom) size paint
                      (in-water (flags-of overlay transparent) lights visibility))))
    (write-picture 'snapshot pixels size file)
    (caption view file ", " (number->string (car size)) " x " (number->string (cdr size)) " pixels")))


;;; In the terminal.

(define (best-way)
  ;; kitty, sixel, symbols, or plain; symbols are beyond ASCII.
  (let ((ask (and (watched? (current-output-port)) (not (member (getenv "TERM") '(#f "" "dumb")))
                  (extension '(bight view chafa) '%terminal-mode))))
    (let ((way (and ask (extension '(bight view render) '%draw) (ask))))
      (if (and way (not (and (eq? way 'symbols) (ascii-terminal?)))) way 'plain))))

(define (usual-cells)
  ;; As wide as the terminal, in the shape of a snapshot; a cell is twice as high as wide.
  (let ((columns (max 20 (min 160 ((from (bight view text) terminal-columns))))))
    (cons columns (max 6 (round (/ (* columns 9) 32))))))

(define (show-text text)
  (control text)
  (newline)
  (force-output))

(define (show-plainly at extent zoom)
  (write ((from (bight view) look) #:at at #:extent extent #:zoom (or zoom 1)))
  (newline)
  (make-caption "plain characters, from above and from the side"))

(define (show-pixels views cells paint flags way)
  (let* ((size (cons (max least-side (* 8 (car cells))) (max least-side (* 16 (cdr cells)))))
         (turn (or (extension '(bight view chafa) '%picture->text)
                   (bight-raise 'unsupported 'show
                                "this bight was built without chafa; #:as 'plain always works")))
         (pixels (draw 'show views size paint flags)))
    (show-text (turn pixels (car size) (cdr size) (car cells) (cdr cells) way))
    (caption views (symbol->string way) ", " (number->string (car cells)) " x "
             (number->string (cdr cells)) " cells")))

(define-verb (show #:key (view views '(overview)) (size (or-false cells))
                   (paint (one-of plain tension curvature model) 'plain)
                   (overlay overlay '(figures))
                   (at (or-false point)) (extent (or-false positive)) (zoom (or-false positive))
                   (as (or-false (one-of kitty sixel symbols plain)))
                   (lights (or-false (one-of on off))) (visibility (or-false positive)))
  "Put a picture of the dive as it is now in the terminal, as `snapshot' draws it: VIEW, PAINT, OVERLAY, AT,
EXTENT, ZOOM, LIGHTS and VISIBILITY are the same; SIZE is (COLUMNS ROWS) in characters.  AS is kitty, sixel,
symbols or plain, by default the best that the terminal can; plain is what `look' draws.  Return what was
shown."
  (let ((way (or as (best-way))))
    (this-dive 'show)
    (if (eq? way 'plain)
        (show-plainly at extent zoom)
        (show-pixels (moved view at extent zoom) (or size (usual-cells)) paint
                     (in-water overlay lights visibility) way))))
