;;; (bight identify flight) --- lines led through measured runs, on all cores.
;;;
;;; Each flight is a thread that leads one line without a dive (bight/lead.h): as many at a time as there are cores.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify flight)
  #:use-module (bight core record)
  #:use-module ((bight core schema) #:select (least-mass))
  #:use-module (bight identify lean)
  #:use-module (bight identify measured)
  #:use-module (bight identify solver)
  #:use-module (bight identify unknown)
  #:use-module ((ice-9 threads) #:select (call-with-new-thread join-thread current-processor-count
                                          make-mutex with-mutex))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (make-setting setting? setting-known setting-length setting-places setting-pieces setting-clamped?
            setting-moving? setting-intervals setting-density setting-gravity
            line-values line-sets
            make-flight flight? flight-failed?
            fly-all
            place-of pull-of))

(define pi (* 4 (atan 1)))

(define-record <setting>
  (make-setting known length places pieces clamped? moving? intervals step density gravity floor)
  setting?
  (known setting-known)                 ; alist of a tether's fields
  (length setting-length)               ; m
  (places setting-places)               ; of the markers along the line, m
  (pieces setting-pieces)               ; of a set that is unknown, of equal length
  (clamped? setting-clamped?)           ; do the ends leave along directions
  (moving? setting-moving?)             ; does it begin along the markers of the first row, else at rest
  (intervals setting-intervals)
  (step setting-step)                   ; s
  (density setting-density)             ; kg/m3
  (gravity setting-gravity)             ; m/s2
  (floor setting-floor))                ; m, or #f

(document
 (setting? "Return true if OBJECT is how lines are led.")
 (make-setting "Return how lines are led: see the fields.")
 (setting-known "Return the fields that are known in SETTING, an alist.")
 (setting-length "Return the length of the line in SETTING, m.")
 (setting-places "Return the places of the markers along the line in SETTING, m.")
 (setting-pieces "Return of how many pieces of equal length an unknown set is in SETTING.")
 (setting-clamped? "Return true if the ends of the line are clamped in SETTING.")
 (setting-moving? "Return true if the line of SETTING begins as it was seen, not at rest.")
 (setting-intervals "Return how many intervals the line of SETTING has.")
 (setting-density "Return the density of the water of SETTING, kg/m3.")
 (setting-gravity "Return the gravity of SETTING, m/s2."))


;;; The line that coordinates stand for.

(define (unknown-values coordinates x)
  ;; ((WHAT WHICH . VALUE) ...)
  (map (lambda (coordinate value)
         (cons* (coordinate-what coordinate) (coordinate-which coordinate) (coordinate-value coordinate value)))
       coordinates (f64vector->list x)))

(define (value-of values what which otherwise)
  (let ((found (find (lambda (entry) (and (eq? what (first entry)) (equal? which (cadr entry)))) values)))
    (if found (cddr found) otherwise)))

(define (line-values setting coordinates x)
  "Return the alist of the fields of the line that COORDINATES at X, an f64vector, and SETTING make: what of mass and
wet weight is neither known nor sought follows from the other."
  (let* ((values (unknown-values coordinates x))
         (known (setting-known setting))
         (get (lambda (name otherwise) (value-of values name #f (or (assq-ref known name) otherwise))))
         (diameter (get 'diameter .005))
         (displaced (* (setting-density setting) pi 1/4 diameter diameter))
         (g (setting-gravity setting))
         (mass (get 'mass #f)) (weight (get 'wet-weight #f))
         (follows (cond (mass) (weight (+ displaced (/ weight g))) (else .05)))
         (weighs (or weight (* g (- (or mass .05) displaced)))))
    `((diameter . ,diameter)
      (mass . ,(max follows (least-mass diameter weighs (setting-density setting) g)))
      (wet-weight . ,weighs)
      (ea . ,(let ((ea (get 'ea 2e5))) (if (< ea +inf.0) ea 1e9)))
      (ei . ,(get 'ei 0.)) (ba . ,(get 'ba 20.)) (bending-damping . ,(get 'bending-damping 0.))
      (gj . ,(get 'gj 0.))
      (ei-stuck . ,(let ((stuck (get 'ei-stuck 0.))) (if (> stuck 0) (max stuck (get 'ei 0.)) stuck)))
      (slip-curvature . ,(get 'slip-curvature 0.))
      (cdn . ,(get 'cdn 1.2)) (cdt . ,(get 'cdt .01)) (ca . ,(get 'ca 1.)) (friction . ,(get 'friction .3))
      (length . ,(value-of values 'length #f (setting-length setting))))))

(define (known-set fields)
  ;; (AT SPAN CURVATURE PLANE) of the FIELDS of a set.
  (map (lambda (name otherwise) (exact->inexact (or (assq-ref fields name) otherwise)))
       '(at span curvature plane) '(0 +inf.0 0 0)))

(define (found-set piece pieces long across aside)
  ;; The like of PIECE, of the components of its curvature toward 0 and 90 degrees.
  (list (* long (/ (+ piece .5) pieces)) (if (= pieces 1) +inf.0 (/ long pieces))
        (sqrt (+ (* across across) (* aside aside))) (* (/ 180 pi) (atan aside across))))

(define (line-sets setting coordinates x)
  "Return the sets of the line that COORDINATES at X and SETTING make, lists (AT SPAN CURVATURE PLANE): those that are
known, and those that are sought."
  (let* ((values (unknown-values coordinates x)) (pieces (setting-pieces setting))
         (long (value-of values 'length #f (setting-length setting))))
    (append (filter-map (lambda (entry) (and (eq? 'set (car entry)) (known-set (cdr entry))))
                        (setting-known setting))
            (if (assq 'set values)
                (map (lambda (piece)
                       (found-set piece pieces long (value-of values 'set (cons piece 0) 0.)
                                  (value-of values 'set (cons piece 1) 0.)))
                     (iota pieces))
                '()))))

(define (flag x) (if x 1. 0.))

(define (line-numbers setting coordinates x run-index last)
  ;; In the order of src/identify/guile_identify.c.
  (let ((values (unknown-values coordinates x)))
    (list->f64vector
     (append (map (lambda (entry) (exact->inexact (cdr entry))) (line-values setting coordinates x))
             (list (exact->inexact (setting-intervals setting))
                   (flag (setting-clamped? setting))
                   (setting-density setting) (setting-gravity setting)
                   (value-of values 'current 0 0.) (value-of values 'current 1 0.) 0.
                   (or (setting-floor setting) +nan.0)
                   (setting-step setting)
                   (value-of values 'clock run-index 0.)
                   (exact->inexact last))
             (map (lambda (which) (value-of values 'tilt which 0.)) '((0 . 0) (0 . 1) (1 . 0) (1 . 1)))
             (concatenate (line-sets setting coordinates x))))))

(define (marks setting coordinates x)
  (let ((values (unknown-values coordinates x)))
    (list->f64vector (map (lambda (place k) (value-of values 'places k place))
                          (setting-places setting) (iota (length (setting-places setting)))))))


;;; How a run begins.

(define (track-of run lean)
  (define (in-order vectors) (map (lambda (v) (upright v lean)) vectors))
  (let ((ends (in-order (run-ends run))) (directions (in-order (or (run-directions run) '(#f #f)))))
    (vector (run-times run) (first ends) (second ends) (first directions) (second directions) (run-out run))))

(define (end-place run end row)
  (map (lambda (k) (f64vector-ref (list-ref (run-ends run) end) (+ k (* 3 row)))) '(0 1 2)))

(define (known-place? place) (every (lambda (x) (= x x)) place))

(define (start-of setting run lean)
  ;; Along the markers of the first row, each as fast as it is in the second; #f: at rest.
  (and (setting-moving? setting)
       (let* ((h (f64vector-ref (run-times run) 1))
              (seen (filter-map (lambda (k s)
                                  (let ((a (run-place run 0 k)) (b (run-place run 1 k)))
                                    (and (known-place? a) (known-place? b) (list s a b))))
                                (iota (run-markers run)) (setting-places setting)))
              (all (append (list (list 0. (end-place run 0 0) (end-place run 0 1)))
                           (filter (lambda (entry) (< 0 (first entry) (setting-length setting))) seen)
                           (list (list (setting-length setting) (end-place run 1 0) (end-place run 1 1))))))
         (vector (list->f64vector (map (lambda (entry) (exact->inexact (first entry))) all))
                 (upright (list->f64vector (append-map second all)) lean)
                 (upright (list->f64vector (append-map (lambda (entry)
                                                         (map (lambda (a b) (/ (- b a) h)) (second entry) (third entry)))
                                                       all))
                          lean)))))


;;; Flights.

(define-record <flight>
  (%make-flight line track start marks lean)
  flight?
  (line flight-line)
  (track flight-track)
  (start flight-start)
  (marks flight-marks)
  (lean flight-lean))                   ; of the frame of the run

(document (flight? "Return true if OBJECT is a flight."))

(define (make-flight setting coordinates x run run-index last)
  "Return the flight of the line that COORDINATES at X and SETTING make through the first LAST rows of RUN, the one of
RUN-INDEX."
  (let* ((values (unknown-values coordinates x))
         (lean (make-lean (value-of values 'vertical 0 0.) (value-of values 'vertical 1 0.))))
    (%make-flight (line-numbers setting coordinates x run-index last) (track-of run lean) (start-of setting run lean)
                  (marks setting coordinates x) lean)))

(define (as-seen flown lean)
  ;; What was flown, in the frame of the run.
  (if (pair? flown)
      (cons (leaning (car flown) lean) (leaning (cdr flown) lean))
      flown))

(define (flight-failed? flown)
  "Return true if FLOWN, of `fly-all', says why a flight went wrong."
  (string? flown))

(define (fly-all flights)
  "Fly FLIGHTS, as many at a time as there are cores; return for each (PLACES . PULLS), f64vectors, or a string that
says what went wrong.  No flight goes on when the call is left."
  (let* ((n (length flights))
         (waiting (list->vector flights)) (flown (make-vector n #f))
         (next 0) (turn (make-mutex)) (halt (make-s8vector 1 0)))
    (define (take!)
      (with-mutex turn
        (let ((k next)) (set! next (+ k 1)) k)))
    (define (work)
      (let ((k (take!)))
        (when (and (< k n) (zero? (s8vector-ref halt 0)))
          (let ((f (vector-ref waiting k)))
            (vector-set! flown k (as-seen (%lead (flight-line f) (flight-track f) (flight-start f) (flight-marks f) halt)
                                          (flight-lean f))))
          (work))))
    (dynamic-wind
      (const #t)
      (lambda ()
        (for-each join-thread
                  (map (lambda (i) (call-with-new-thread work)) (iota (max 1 (min n (current-processor-count))))))
        (vector->list flown))
      (lambda () (s8vector-set! halt 0 1)))))

(define (place-of flown markers row marker)
  "Return the index in the places of FLOWN, of so many MARKERS, of the x of MARKER in ROW."
  (* 3 (+ marker (* row markers))))

(define (pull-of flown row end)
  "Return the index in the pulls of FLOWN of the x of the force on END in ROW."
  (* 3 (+ end (* 2 row))))
