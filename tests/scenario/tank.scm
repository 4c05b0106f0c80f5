;;; A measured tether: the path of the vehicle in the tank of M. Filliung et al. (ICRA 2024), cable 6,
;;; surge run.  The reference holds 16 points of the cable at known arc lengths, 33 times a second; a
;;; frame moves when a plain catenary is off by more than 20 mm there.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight world track)
             ((srfi srfi-1) #:select (filter-map)))

(define folder
  (or (getenv "BIGHT_REFERENCE_DATA")
      (string-append (or (getenv "top_srcdir") "..") "/../shared/data")))

(define file (string-append folder "/real/toulon_cable6_surge_0p6_0031.csv"))

(define markers
  '(0.00 0.05 0.25 0.45 0.65 0.85 1.05 1.25 1.45 1.65 1.85 2.05 2.25 2.45 2.65 2.85))

(define (frame-time row) (list-ref row 0))
(define (frame-plain row) (list-ref row 11)) ; mm, of a plain catenary, as the reference gives it
(define (frame-points row)
  (let loop ((rest (list-tail row 12)) (points '()))
    (if (null? rest)
        (reverse points)
        (loop (cdddr rest) (cons (list (car rest) (cadr rest) (caddr rest)) points)))))

(define (mean values)
  (/ (apply + values) (length values)))

(define (deviations rows)
  ;; The mean distance to the measured points, m, at each of ROWS, flying through them.
  (map (lambda (row)
         (run (max 0 (- (frame-time row) (now))))
         (deviation-mean (deviation (frame-points row) #:at markers)))
       rows))

(define-scenario (measured-tether model)
  "Flown along the measured path, a static line is about 87 mm from the real one while that moves."
  #:for ((model 'catenary 'steady))
  (unless (file-exists? file)
    (skip "the reference data are not here"))
  (in tank)
  (tether-model! model)
  (let* ((rows (read-columns 'tank file 60))
         (all (begin (follow! file) (deviations rows)))
         (moving (filter-map (lambda (row d) (and (> (frame-plain row) 20) d)) rows all))
         (resting (filter-map (lambda (row d) (and (<= (frame-plain row) 20) d)) rows all)))
    (format #t "# ~a: ~,1f mm over ~a moving frames, ~,1f mm over ~a others~%"
            model (* 1000 (mean moving)) (length moving) (* 1000 (mean resting)) (length resting))
    (expect (length moving) => 144)
    (expect (* 1000 (mean moving)) is (about 87 #:within 3))))
