;;; (bight world orcaflex) --- lines of OrcaFlex's text data files (YAML) as worlds.
;;;
;;; Units are OrcaFlex's SI: tonnes, kilonewtons, metres.  Of a model the lines, their types and their ends are taken,
;;; with depth and density of the sea; what a line has that a tether has no place for is refused by name.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world orcaflex)
  #:use-module (bight assembly)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core table) #:select (file-lines))
  #:use-module (bight core verb)
  #:use-module (bight core yaml)
  #:use-module ((bight world shape) #:select (type:file-name))
  #:use-module (srfi srfi-1)
  #:export (import-orcaflex))

(define tonne 1000.)                    ; kg, and N in a kilonewton

(define (refuse kind file name what)
  (bight-raise kind 'import-orcaflex "~a: `~a' ~a" file name what))

(define (said mapping . names)
  ;; What MAPPING says under the first of NAMES that it has, or #f.
  (and (list? mapping)
       (any (lambda (name) (assoc-ref mapping name)) names)))

(define (entry? x) (and (list? x) (every pair? x)))

(define (objects model name)
  ;; The mappings in the sequence NAME of MODEL.
  (let ((all (said model name)))
    (if (vector? all) (filter entry? (vector->list all)) '())))

(define (as-number x)
  (let ((number (and (string? x) (text->number x 10))))
    (and (real? number) (< (abs number) 1e15) (exact->inexact number))))

(define (first-of x) (if (and (vector? x) (> (vector-length x) 0)) (vector-ref x 0) x))
(define (last-of x) (if (and (vector? x) (> (vector-length x) 0)) (vector-ref x (- (vector-length x) 1)) x))

(define (number-of file object pick . names)
  ;; The number that PICK takes of what OBJECT says under one of NAMES.
  (or (as-number (pick (apply said object names)))
      (refuse 'format file (or (said object "Name") "an object") (string-append "gives no number for " (car names)))))

(define (columns object . names)
  ;; The rows of the table of OBJECT whose columns begin with NAMES, as lists; ().
  (let* ((head (string-join names ", "))
         (entry (find (lambda (e) (and (string? (car e)) (string-prefix? head (car e)))) object)))
    (if (and entry (vector? (cdr entry)))
        (filter-map (lambda (row) (and (vector? row) (>= (vector-length row) (length names))
                                       (list-head (vector->list row) (length names))))
                    (vector->list (cdr entry)))
        '())))

(define (type-fields file type)
  (define (number pick . names) (apply number-of file type pick names))
  `((diameter ,(number first-of "OD" "OuterDiameter"))
    (mass ,(* tonne (number first-of "MassPerUnitLength")))
    (ea ,(* tonne (number first-of "EA" "AxialStiffness")))
    (ei ,(* tonne (or (as-number (first-of (said type "EI" "BendingStiffness"))) 0.)))
    (cdn ,(number first-of "Cd" "NormalDragCoefficient"))
    (cdt ,(number last-of "Cd"))
    (ca ,(number first-of "Ca"))))

(define degree (/ (acos -1) 180))

(define (placed file object place)
  ;; PLACE in the axes of OBJECT, a vessel or buoy, in those of the model.
  (let* ((position (said object "InitialPosition"))
         (at (and (vector? position) (= 3 (vector-length position)) (map as-number (vector->list position))))
         (turn (* degree (or (as-number (said object "InitialHeading")) 0.))))
    (unless (and at (every identity at))
      (refuse 'format file (said object "Name") "has no InitialPosition of three numbers"))
    (list (+ (first at) (- (* (cos turn) (first place)) (* (sin turn) (second place))))
          (+ (second at) (+ (* (sin turn) (first place)) (* (cos turn) (second place))))
          (+ (third at) (third place)))))

(define (line-end file model depth line name row)
  ;; Two values: the end of a tether that ROW of LINE says, and the part that holds it, or #f.
  (let ((place (map as-number (cdr row))) (to (car row)))
    (unless (and (string? to) (every identity place))
      (refuse 'format file (said line "Name") "has an end without a place"))
    (cond ((string=? to "Fixed") (values place #f))
          ((string=? to "Anchored") (values (list (first place) (second place) (- (third place) depth)) #f))
          ((find (lambda (o) (equal? to (said o "Name")))
                 (append (objects model "Vessels") (objects model "6DBuoys") (objects model "3DBuoys")))
           => (lambda (object)
                (values (list name) `(rov (named ,name) (type kinematic) (at ,@(placed file object place))))))
          (else (refuse 'unsupported file (said line "Name")
                        "ends at what is neither fixed, anchored, a vessel nor a buoy")))))

(define (one-section file model line)
  ;; Three values: the type of LINE, its length and the number of its segments.
  (let* ((rows (columns line "LineType" "Length" "TargetSegmentLength"))
         (names (delete-duplicates (map first rows))))
    (unless (= 1 (length names))
      (refuse 'unsupported file (said line "Name") "has sections of several line types, or none: a tether is of one"))
    (let ((type (find (lambda (t) (equal? (car names) (said t "Name"))) (objects model "LineTypes")))
          (lengths (map as-number (map second rows))) (segments (map as-number (map third rows))))
      (unless type (refuse 'format file (said line "Name") "is of a line type that is not there"))
      (unless (and (every identity lengths) (every (lambda (x) (or (not x) (> x 0))) segments))
        (refuse 'format file (said line "Name") "has a section without a length"))
      (values type (apply + lengths)
              (apply + (map (lambda (l s) (if s (max 1 (inexact->exact (ceiling (/ (min (abs l) 1e6) (max s 1e-3))))) 20))
                            lengths segments))))))

(define (line-parts file model depth line number)
  ;; The tether that LINE is, and the vehicles that hold its ends.
  (define (named end) (string->symbol (simple-format #f "end-~a~a" end number)))
  (let ((ends (columns line "Connection" "ConnectionX" "ConnectionY" "ConnectionZ")))
    (unless (= 2 (length ends))
      (refuse 'format file (or (said line "Name") "a line") "has no two rows of Connection, ConnectionX, ConnectionY, \
ConnectionZ"))
    (call-with-values (lambda () (one-section file model line))
      (lambda (type length segments)
        (call-with-values (lambda () (line-end file model depth line (named 'a) (first ends)))
          (lambda (from holder-a)
            (call-with-values (lambda () (line-end file model depth line (named 'b) (second ends)))
              (lambda (to holder-b)
                (append (filter identity (list holder-a holder-b))
                        `((tether (named ,(string->symbol (simple-format #f "line-~a" number)))
                                  (from ,@from) (to ,@to) (length ,length) (model dynamic)
                                  (nodes ,(min 1000 (max 2 segments)))
                                  ,@(type-fields file type))))))))))))

(define-verb (import-orcaflex (file file-name))
  "Return the world of the lines in FILE, a text data file (YAML) of OrcaFlex in SI units: a tether line-N for each, a
kinematic vehicle end-aN or end-bN where a vessel or buoy holds it, still water and a level bed.  A line of several
types, and one that ends at another, is refused."
  (let* ((proc 'import-orcaflex)
         (model (parse-yaml proc file (file-lines proc file)))
         (lines (objects model "Lines"))
         (units (said (said model "General") "UnitsSystem"))
         (sea (or (said model "Environment") '()))
         (depth (or (as-number (said sea "WaterDepth" "SeabedOriginDepth")) 100.)))
    (when (null? lines)
      (bight-raise 'format proc "~a is no text data file of OrcaFlex: it has no Lines" file))
    (unless (member units '(#f "SI"))
      (bight-raise 'unsupported proc "~a is in other units than SI" file))
    (build-world #f (string-append "The lines of " (basename file) ".") #f
                 (map data->part
                      `((sea (depth ,depth)
                             (density ,(* tonne (or (as-number (first-of (said sea "Density" "SeaDensity"))) 1.025))))
                        (seabed)
                        ,@(append-map (lambda (line number) (line-parts file model depth line number))
                                      lines (iota (length lines) 1)))))))
