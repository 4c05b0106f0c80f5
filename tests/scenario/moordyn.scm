;;; A flight of MoorDyn 2 in a scenario: case C of the reference data, 100 m of neutral line in a current
;;; across it, one end fixed, the other led there and back by a vehicle for a minute.  The reference is
;;; extrapolated from 200 and 400 intervals, sure to 2e-5 m; here are 200 in steps of 1/60 s.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight world track) ((srfi srfi-1) #:select (append-map)))

(define folder
  (or (getenv "BIGHT_REFERENCE_DATA")
      (string-append (or (getenv "top_srcdir") "..") "/../shared/data")))

(define file (string-append folder "/moordyn/C.csv"))

(define (neutral-line nodes)
  (world (sea (depth 1000) (density 1025) (gravity 9.81) (current 0.5 0))
         (rov (named led) (at 70 0 -100))
         (tether (named line) (from 0 0 -100) (to led) (length 100) (model dynamic) (nodes nodes)
                 (diameter 0.01) (mass 0.0805033117) (wet-weight 0)
                 (ea 2e5) (ba 50) (cdn 1.2) (cdt 0.02) (ca 1))))

(define (way t)
  ;; How far the vehicle is along its line, m: to and fro, begun smoothly.
  (let ((u (min (/ t 10) 1)))
    (* 10 (- 1 (cos (* 0.1 t))) u u u (+ 10 (* u (+ -15 (* 6 u)))))))

(define (path)
  (map (lambda (i)
         (let* ((t (/ i 60.)) (s (way t)))
           (list t (+ 70 (* 0.8 s)) 0 (+ -100 (* 0.6 s)))))
       (iota 3601)))

(define (row-points row)
  ;; The 21 points after time and tensions in ROW of the reference.
  (map (lambda (i) (apply vec (list-head (list-tail row (+ 3 (* 3 i))) 3))) (iota 21)))

(define (misses row)
  ;; Distances to the reference at the time of ROW, m.
  (let ((points (tether-points 21)))
    (map (lambda (p i) (distance p (array-cell-ref points i))) (row-points row) (iota 21))))

(define (pull-misses row)
  (list (- (anchor-tension) (list-ref row 1)) (- (rov-tension) (list-ref row 2))))

(define (rms values)
  (sqrt (/ (apply + (map (lambda (x) (* x x)) values)) (length values))))

(define (flight rows)
  ;; The misses of places and of tensions at each of ROWS.
  (let ((start (now)))
    (map (lambda (row)
           (run (max 0 (- (+ start (list-ref row 0)) (now))))
           (cons (misses row) (pull-misses row)))
         rows)))

(define-scenario as-moordyn-flies-it
  "Two programs, one line: places within 2 mm rms, tensions within 0.03 %."
  (unless (file-exists? file)
    (skip "the reference data are not here"))
  (enter! (neutral-line 200))
  (settle! #:within 1e-6 #:at-most 600)
  (let ((rows (read-columns 'flight file 66)))
    (follow! (path))
    (let* ((all (flight rows))
           (places (rms (append-map car all)))
           (pulls (/ (rms (append-map cdr all))
                     (rms (append-map (lambda (row) (list (list-ref row 1) (list-ref row 2))) rows)))))
      (format #t "# case C: ~,2f mm rms, tensions ~,3f %~%" (* 1000 places) (* 100 pulls))
      (expect places is (below 2e-3))
      (expect pulls is (below 3e-4)))))
