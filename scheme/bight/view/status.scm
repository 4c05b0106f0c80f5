;;; (bight view status) --- the panel of figures.
;;;
;;; A row is a title and its cells; what the dive cannot tell is left out.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view status)
  #:use-module ((bight core decimal) #:select (fixed))
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (windings->strings))
  #:use-module ((bight dive command) #:select (spooling?))
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module (bight view asking)
  #:use-module (bight view text)
  #:use-module (bight world bed)
  #:use-module (srfi srfi-1)
  #:export (status))

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
