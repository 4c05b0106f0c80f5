;;; Bathymetry and currents from files in the coordinates of maps.  The files are made here by their formats'
;;; specifications; where their numbers are in local metres is told by (bight world earth), which projects by a series
;;; of its own, so that reader and series hold each other.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight assembly) (bight world earth) (bight core errors) (rnrs bytevectors) (rnrs exceptions) (ice-9 binary-ports) (srfi srfi-1))

(primitive-load (string-append (dirname (dirname (current-filename))) "/geo-files.scm"))

(define latitude 63.45)
(define longitude 10.4)

(define (world-of . parts)
  ;; Of data, since the names of files and the fields are known only here.
  (build-world #f #f #f (map data->part parts)))

(define (bed-world . fields)
  (world-of '(sea (depth 500))
            `(seabed ,@fields)
            '(rov (named r) (type kinematic) (at 0 0 -1))
            '(tether (from 0 0 0) (length 5000) (model rubber-band))))

(define (enter-bed! . fields)
  (enter! (apply bed-world `(origin ,latitude ,longitude) fields)))

(define (height-at lat lon)
  (bed-height (list latitude longitude) lat lon))

;; Some places, degrees from the origin.
(define places '((0 0) (0.004 0.009) (-0.0071 0.0113) (0.0093 -0.0152) (-0.0082 -0.0041)))

(define (east-height lon) (+ -60 (* 1000 (- lon longitude))))
(define (north-height lat) (+ -60 (* 1000 (- lat latitude))))

(define (miss height-of)
  ;; The most that the bed is beside HEIGHT-OF, of latitude and longitude, at the places.
  (apply max (map (lambda (d)
                    (let ((lat (+ latitude (first d))) (lon (+ longitude (second d))))
                      (abs (- (height-at lat lon) (height-of lat lon)))))
                  places)))

(define west (- longitude 0.03))
(define north (+ latitude 0.02))

(define-scenario (degrees-in-every-format format way)
  "A bed that rises by a metre for each thousandth of a degree, 60 to 110 m, is where the series has its degrees: \
3 mm of height are 0.3 m."
  #:for ((format 'ascii 'xyz 'tiff 'netcdf) (way 'east 'north))
  (with-reader
   (define (value x y) (if (eq? way 'east) (east-height x) (north-height y)))
   (define file (scratch-file (simple-format #f "~a-~a" format way)))
   (case format
     ((ascii) (write-ascii file west north 0.001 61 41 value))
     ((xyz) (write-xyz file west north 0.001 61 41 value))
     ((tiff) (write-tiff file 4326 west north 0.001 61 41 value))
     ((netcdf) (write-bed-netcdf file "elevation" '(("units" . "m")) west north 0.001 61 41 value)))
   (enter-bed! `(grid ,file))
   (expect (miss (lambda (lat lon) (value lon lat))) is (below 3e-3))))

(define (utm-east lat lon) (+ 500000 (* 0.9996 (car (degrees->local '(0. 9.) lat lon)))))
(define (utm-north lat lon) (* 0.9996 (cdr (degrees->local '(0. 9.) lat lon))))

(define-scenario (metres-of-a-zone format)
  "A bed in UTM that slopes by 1 in 50 is the same slope in local metres, whether the file says its zone, the world \
does, or the numbers leave no other."
  #:for ((format 'tiff 'tiff-without 'ascii 'ascii-told))
  (with-reader
   (let* ((e0 (utm-east latitude longitude)) (n0 (utm-north latitude longitude))
          (file (scratch-file (symbol->string format)))
          (value (lambda (e n) (+ -60 (* 0.02 (+ (- e e0) (- n n0))))))
          (grid (list (- (floor e0) 2000) (+ (floor n0) 1500) 50 81 61 value)))
     (case format
       ((tiff) (apply write-tiff file 32632 grid))
       ((tiff-without) (apply write-tiff file #f grid))
       (else (apply write-ascii file grid)))
     (apply enter-bed! `(grid ,file) (if (eq? format 'ascii-told) '((system "EPSG:32632")) '()))
     (expect (miss (lambda (lat lon) (value (utm-east lat lon) (utm-north lat lon)))) is (below 1e-3)))))

(define-scenario depths-and-holes
  "Depths that the file says are depths lie below; numbers that stand for none are holes; a reach is kept; a bed of \
which every height is in the air is asked about."
  (with-reader
   (let ((file (scratch-file "depths.nc")) (holed (scratch-file "holed.tif")))
     (write-bed-netcdf file "depth" '(("positive" . "down")) west north 0.001 61 41 (lambda (x y) 42))
     (enter-bed! `(grid ,file) '(reach 800))
     (expect (height-at latitude longitude) is (about -42 #:within 1e-4))
     (expect (apply max (map abs (array->list (box-of 'seabed)))) is (between 700 800.001))
     (write-tiff holed 4326 west north 0.001 61 41 (lambda (x y) (if (> x longitude) -9999 -30)))
     (enter-bed! `(grid ,holed))
     (expect (height-at latitude (- longitude 0.004)) is (about -30 #:within 1e-4))
     (expect (height-at latitude (+ longitude 0.004)) is (below -499))
     (write-xyz (scratch-file "air.xyz") west north 0.001 61 41 (lambda (x y) 42))
     (expect (enter-bed! `(grid ,(scratch-file "air.xyz"))) raises format)
     (enter-bed! `(grid ,(scratch-file "air.xyz")) '(positive down))
     (expect (height-at latitude longitude) is (about -42 #:within 1e-4)))))

(define (box-of name)
  ;; Its four bounds in x and y, m.
  (let ((row (find (lambda (row) (string=? "box" (car row))) ((@ (bight world describe) description-rows) (describe name)))))
    (list->f64vector (append-map (lambda (corner) (list-head (map string->number (string-tokenize corner)) 2))
                                 (let* ((text (second row)) (k (string-contains text " to ")))
                                   (list (substring text 0 k) (substring text (+ k 4))))))))

(define-scenario from-elsewhere
  "A file of another place, of no place, of too much or of nothing is refused with one line, and the dive before it \
goes on."
  (with-reader
   (define (bed-refused? kind . fields)
     (and (refused? (list kind) (lambda () (enter! (apply bed-world fields)))) #t))
   (define here `(origin ,latitude ,longitude))
   (define grid (list west north 0.001 61 41 (lambda (x y) -30)))
   (define tiff (apply write-tiff (scratch-file "fine.tif") 4326 grid))
   (define bare (write-ascii (scratch-file "bare.asc") 5e6 5e6 10 11 11 (lambda (x y) -30)))
   (enter! 'open-water)
   (let ((before (state-hash)))
     (expect (bed-refused? 'def `(grid ,tiff)) => #t)
     (expect (bed-refused? 'def `(grid ,bare) '(reach 100)) => #t)
     (expect (bed-refused? 'format `(grid ,tiff) '(origin -33 151)) => #t)
     (expect (bed-refused? 'format `(grid ,tiff) here '(system "EPSG:32632")) => #t)
     (expect (bed-refused? 'format `(grid ,tiff) here '(system "/etc/passwd")) => #t)
     (expect (bed-refused? 'format `(grid ,bare) here) => #t)
     (expect (bed-refused? 'format `(grid ,(apply write-tiff (scratch-file "wide.tif") 4326
                                              (append grid (list #:claimed-width 2000000000)))) here) => #t)
     (expect (bed-refused? 'format `(grid ,(write-tiff (scratch-file "nan.tif") 4326 west north 0.001 61 41
                                                   (lambda (x y) +nan.0))) here) => #t)
     (expect (bed-refused? 'format `(grid ,(write-tiff (scratch-file "peak.tif") 4326 west north 0.001 61 41
                                                   (lambda (x y) 3e38))) here) => #t)
     (expect (bed-refused? 'limit `(grid ,(write-tiff (scratch-file "world.tif") 4326 -179.5 89.5 1 360 180
                                                  (lambda (x y) -30))) here) => #t)
     (expect (bed-refused? 'format `(grid ,(write-bed-netcdf (scratch-file "other.nc") "salinity" '() west north 0.001 61 41
                                                         (lambda (x y) -30))) here '(variable "elevation")) => #t)
     (expect (bed-refused? 'def `(grid ,tiff) here '(origin 1 2)) => #t)
     (expect (bed-refused? 'domain `(grid ,tiff) '(origin 91 2)) => #t)
     (expect (state-hash) => before))))

(define-scenario little-memory
  "A reader without memory says so and takes nothing with it."
  (with-reader
   (let ((program (getenv "BIGHT_GEO_READER")) (wrapper (scratch-file "wrapper")))
     (unless program (skip "the reader is where it was installed"))
     (call-with-output-file wrapper
       (lambda (port)
         (simple-format port "#!/bin/sh\nshift 2\nexec '~a' 60 ~a \"$@\"\n" program 60)))
     (chmod wrapper #o755)
     (write-tiff (scratch-file "some.tif") 4326 west north 0.001 61 41 (lambda (x y) -31))
     (dynamic-wind
       (lambda () (setenv "BIGHT_GEO_READER" wrapper))
       (lambda () (expect (guard (e ((bight-error? e) (not (string-index (bight-error-message e) #\newline))))
                            (enter-bed! `(grid ,(scratch-file "some.tif")))
                            #f)
                          => #t))
       (lambda () (setenv "BIGHT_GEO_READER" program))))))


;;; Currents.

(define start 1740808800)               ; 2025-03-01T06:00Z
(define depths '(0 10 30 60))
(define hours '(0 1 2 3))

(define (east-speed lat lon depth hour)
  (+ 0.5 (* -0.004 depth) (* 0.1 hour) (* 2 (- lon longitude))))
(define (north-speed lat lon depth hour)
  (+ -0.2 (* 0.002 depth) (* 0.05 hour) (* 3 (- lat latitude))))

(define model-lats (map (lambda (i) (+ latitude (* 0.05 (- i 1.3)))) (iota 4)))
(define model-lons (map (lambda (i) (+ longitude (* 0.05 (- i 1.6)))) (iota 4)))

(define* (model-numbers speed #:key (scaled identity) (bottom 1e9))
  ;; By time, depth, latitude and longitude; nothing below BOTTOM.
  (append-map
   (lambda (hour)
     (append-map
      (lambda (depth)
        (append-map
         (lambda (lat)
           (map (lambda (lon) (if (> depth bottom) 9e36 (scaled (speed lat lon depth hour)))) model-lons))
         model-lats))
      depths))
   hours))

(define (write-model style file)
  (define hours-since-1950 (map (lambda (h) (+ (/ start 3600) (* 24 7305) h)) hours))
  (define scaled (if (eq? style 'hycom) (lambda (x) (* 1000 x)) identity))
  (define attributes
    (append '(("_FillValue" . 9e36)) (if (eq? style 'hycom) '(("scale_factor" . 0.001)) '())))
  (define (named standard) (if (eq? style 'cmems) (cons (cons "standard_name" standard) attributes) attributes))
  (define-values (lat lon u v)
    (if (eq? style 'hycom) (values "lat" "lon" "water_u" "water_v") (values "latitude" "longitude" "uo" "vo")))
  (write-netcdf
   file `(("time" . 4) ("depth" . 4) (,lat . 4) (,lon . 4))
   `(("time" ("time") (("units" . "hours since 1950-01-01 00:00:00") ("calendar" . "gregorian")) ,hours-since-1950)
     ("depth" ("depth") (("units" . "m") ("positive" . "down")) ,depths)
     (,lat (,lat) (("units" . "degrees_north")) ,model-lats)
     (,lon (,lon) (("units" . "degrees_east"))
      ,(if (eq? style 'hycom) (map (lambda (x) (+ 360 x)) model-lons) model-lons))
     (,u ("time" "depth" ,lat ,lon) ,(named "eastward_sea_water_velocity")
      ,(model-numbers east-speed #:scaled scaled #:bottom 40))
     (,v ("time" "depth" ,lat ,lon) ,(named "northward_sea_water_velocity")
      ,(model-numbers north-speed #:scaled scaled #:bottom 40)))))

(define (current-world . clauses)
  (world-of `(sea (depth 100) (origin ,latitude ,longitude) (current ,@clauses))
            '(rov (named r) (type kinematic) (at 0 0 -5))
            '(tether (from 0 0 0) (length 20) (model rubber-band))))

(define (current-miss hour at)
  ;; Of the current of the dive at half depths from the model AT (latitude longitude), HOUR after its first.
  (apply max
         (append-map
          (lambda (depth)
            (let ((v (current-at (vec 3 7 (- depth)))))
              (list (abs (- (f64vector-ref v 0) (east-speed (first at) (second at) depth hour)))
                    (abs (- (f64vector-ref v 1) (north-speed (first at) (second at) depth hour))))))
          '(0 5 17 30))))

(define-scenario (ocean-models style)
  "The column of a model at a place, from a time on, linear between its times, depths, latitudes and longitudes; \
below its bottom it is as at its lowest level."
  #:for ((style 'cmems 'hycom))
  (with-reader
   (let ((file (write-model style (scratch-file (simple-format #f "~a.nc" style))))
         (there (list (+ latitude 0.02) (- longitude 0.03))))
     (enter! (current-world `(from ,file) `(at ,@there) '(start "2025-03-01T07:00Z")))
     (expect (current-miss 1 there) is (below 1e-9))
     (run 60)
     (expect (current-miss (+ 1 1/60) there) is (below 1e-9))
     (expect (current-at (vec 0 0 -80)) is (about (current-at (vec 0 0 -30)) #:within 1e-12))
     (enter! (current-world `(from ,file)))
     (expect (current-miss 0 (list latitude longitude)) is (below 1e-9))
     (expect (enter! (current-world `(from ,file) '(start "2026-03-01"))) raises format)
     (expect (enter! (current-world `(from ,file) '(at 10 10))) raises format)
     (expect (current-world `(from ,file) '(start "no day")) raises domain))))

;; ROMS: cells along a coast that is turned by ANGLE, components on faces of their own, levels that follow the bed.

(define angle 0.4)
(define roms-s '(-0.9 -0.5 -0.1))

(define (write-roms file)
  (define (cell i j) (list (+ latitude (* 0.01 (- i 2))) (+ longitude (* 0.02 (- j 2)))))
  (define (field n m which) (append-map (lambda (i) (map (lambda (j) (which (cell i j))) (iota m))) (iota n)))
  (define (flat n m value) (field n m (const value)))
  (define (speeds along) (append-map (lambda (t) (append-map (lambda (s) (flat 5 5 (+ along (* 0.1 s) (* 0.01 t))))
                                                              roms-s))
                                     '(0 1)))
  (write-netcdf
   file '(("ocean_time" . 2) ("s_rho" . 3) ("eta_rho" . 5) ("xi_rho" . 5) ("one" . 1))
   `(("ocean_time" ("ocean_time") (("units" . "seconds since 1970-01-01 00:00:00")) (,start ,(+ start 100)))
     ("s_rho" ("s_rho") (("standard_name" . "ocean_s_coordinate_g2")) ,roms-s)
     ("Cs_r" ("s_rho") () ,roms-s)
     ("hc" ("one") () (20)) ("Vtransform" ("one") () (2))
     ("lat_rho" ("eta_rho" "xi_rho") (("units" . "degree_north")) ,(field 5 5 first))
     ("lon_rho" ("eta_rho" "xi_rho") (("units" . "degree_east")) ,(field 5 5 second))
     ("h" ("eta_rho" "xi_rho") (("coordinates" . "lon_rho lat_rho")) ,(flat 5 5 80))
     ("angle" ("eta_rho" "xi_rho") (("coordinates" . "lon_rho lat_rho")) ,(flat 5 5 angle))
     ("u" ("ocean_time" "s_rho" "eta_rho" "xi_rho") (("coordinates" . "lon_rho lat_rho s_rho ocean_time"))
      ,(speeds 0.6))
     ("v" ("ocean_time" "s_rho" "eta_rho" "xi_rho") (("coordinates" . "lon_rho lat_rho s_rho ocean_time"))
      ,(speeds 0.3)))))

(define-scenario roms
  "With Cs = s its second transformation is z = s h for any hc: the levels are at 72, 40 and 8 m.  Velocities are \
turned from the cells' axes to east and north."
  (with-reader
   (enter! (current-world `(from ,(write-roms (scratch-file "roms.nc")))))
   (for-each
    (lambda (s)
      (let ((u (+ 0.6 (* 0.1 s))) (v (+ 0.3 (* 0.1 s))))
        (expect (current-at (vec 0 0 (* 80 s)))
                is (about (vec (- (* u (cos angle)) (* v (sin angle))) (+ (* u (sin angle)) (* v (cos angle))) 0)
                          #:within 1e-9))))
    roms-s)))


;;; Damage.

(define-scenario damaged-files
  "A damaged file is a bed or a current all the same, or is refused with one line."
  (with-reader
   (let* ((grid (list west north 0.001 21 11 (lambda (x y) -30)))
          (beds (list (apply write-tiff (scratch-file "d.tif") 4326 grid)
                      (apply write-bed-netcdf (scratch-file "d.nc") "z" '() grid)
                      (apply write-ascii (scratch-file "d.asc") grid)
                      (apply write-xyz (scratch-file "d.xyz") grid)))
          (flow (write-model 'cmems (scratch-file "flow.nc"))))
     (for-each
      (lambda (k)
        (for-each (lambda (bed)
                    (let ((file (damaged bed)))
                      (expect (whole-or-refused? (lambda () (enter-bed! `(grid ,file)))) => #t)))
                  beds)
        (let ((file (damaged flow)))
          (expect (whole-or-refused? (lambda () (enter! (current-world `(from ,file))))) => #t)))
      (iota runs)))))
