;;; Bathymetry and currents laid out as providers document their files: NetCDF 4 with deflated chunks, numbers packed
;;; into 16 bits by scale_factor, add_offset and _FillValue, longitudes of 0 to 360, latitudes from north to south, depths
;;; positive down, hours since 1950.  The files are written by netCDF's own ncgen from text in its language CDL (and by
;;; GDAL's gdal_translate from those), neither of which has to do with the reader, and are far from Greenwich and south of
;;; the equator, where a sign that is lost is seen.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight assembly) (srfi srfi-1))

(primitive-load (string-append (dirname (dirname (current-filename))) "/geo-files.scm"))

(define (program name)
  (search-path (parse-path (getenv "PATH")) name))

(define-syntax-rule (with-programs (name ...) body ...)
  (cond
   ((not (built-with-reader?)) (skip "built without geographic files"))
   ((find (negate program) (list name ...)) => (lambda (missing) (skip (string-append "there is no " missing))))
   (else (let () body ...))))

(define (called program . arguments)
  (unless (zero? (apply system* program arguments))
    (error "it failed:" (cons program arguments))))

;;; CDL

(define (number-text x)
  (if (nan? x) "_" (number->string (if (integer? x) (inexact->exact x) (exact->inexact x)))))

(define (write-cdl file dimensions variables)
  ;; The NetCDF 4 FILE of DIMENSIONS, (NAME . SIZE), and VARIABLES, (DECLARATION (ATTRIBUTE ...) NUMBERS): a number that is
  ;; NaN is filled by ncgen, a variable without numbers has none written.
  (define (name-of declaration)
    (let* ((start (+ 1 (string-index declaration #\space))))
      (substring declaration start (or (string-index declaration #\( start) (string-length declaration)))))
  (define text (string-append file ".cdl"))
  (call-with-output-file text
    (lambda (port)
      (simple-format port "netcdf made {\ndimensions:\n")
      (for-each (lambda (d) (simple-format port "  ~a = ~a ;\n" (car d) (cdr d))) dimensions)
      (simple-format port "variables:\n")
      (for-each (lambda (v)
                  (simple-format port "  ~a ;\n" (first v))
                  (for-each (lambda (a) (simple-format port "    ~a:~a ;\n" (name-of (first v)) a)) (second v)))
                variables)
      (simple-format port "data:\n")
      (for-each (lambda (v)
                  (when (pair? (third v))
                    (simple-format port "  ~a = ~a ;\n" (name-of (first v))
                                   (string-join (map number-text (third v)) ", "))))
                variables)
      (simple-format port "}\n")))
  (called "ncgen" "-k" "nc4" "-o" file text)
  file)

(define (table rows columns value)
  ;; VALUE of each of ROWS and COLUMNS, the rows in turn.
  (append-map (lambda (y) (map (lambda (x) (value y x)) columns)) rows))

(define (pack scale offset value)
  (if (nan? value) value (round (/ (- value offset) scale))))

;;; The place: in the Bay of Tasmania, and one in Hudson Bay; of longitudes of 0 to 360 the latter is 275.

(define hobart '(-43.1 147.4))
(define hudson '(58.2 -85.05))

(define (enter-bed! origin . fields)
  (enter! (build-world #f #f #f
                       (map data->part
                            `((sea (depth 900)) (seabed ,@fields (origin ,@origin))
                              (rov (named r) (type kinematic) (at 0 0 -1))
                              (tether (from 0 0 0) (length 5000) (model rubber-band)))))))

(define (slope origin)
  ;; A bed that falls to the east by 480 m a degree and to the north by 960, and has whole metres each 1/240 degree.
  (lambda (lat lon) (+ -300 (* -480 (- lon (second origin))) (* -960 (- lat (first origin))))))

(define step 1/240)                     ; 15 seconds of arc, GEBCO's

(define (line origin n) (map (lambda (i) (+ (inexact->exact origin) (* step (- i (quotient n 2))))) (iota n)))

(define (miss origin height)
  ;; The most that the bed is beside HEIGHT, m, at places between its posts.
  (apply max (map (lambda (north east)
                    (let ((lat (+ (first origin) north)) (lon (+ (second origin) east)))
                      (abs (- (bed-height origin lat lon) (height lat lon)))))
                  '(0 0.004 -0.0071 0.0093 -0.0082) '(0 0.009 0.0113 -0.0152 -0.0041))))

(define degrees-north '("units = \"degrees_north\"" "standard_name = \"latitude\"" "axis = \"Y\""))
(define degrees-east '("units = \"degrees_east\"" "standard_name = \"longitude\"" "axis = \"X\""))

(define (write-gebco file origin)
  ;; The grid of GEBCO as its download page cuts it: 16 bits, from south to north, deflated.
  (let ((lats (line (first origin) 31)) (lons (line (second origin) 41)))
    (write-cdl
     file '(("lat" . 31) ("lon" . 41))
     `(("char crs" ("grid_mapping_name = \"latitude_longitude\"" "epsg_code = \"EPSG:4326\"" "semi_major_axis = 6378137."
                    "inverse_flattening = 298.257223563") ())
       ("double lat(lat)" ("sdn_parameter_urn = \"SDN:P01::ALATZZ01\"" ,@degrees-north) ,lats)
       ("double lon(lon)" ("sdn_parameter_urn = \"SDN:P01::ALONZZ01\"" ,@degrees-east) ,lons)
       ("short elevation(lat, lon)"
        ("standard_name = \"height_above_mean_sea_level\"" "units = \"m\"" "grid_mapping = \"crs\""
         "_DeflateLevel = 4" "_Shuffle = \"true\"" "_ChunkSizes = 8, 16")
        ,(table lats lons (compose round (slope origin))))))))

(define (write-emodnet file origin)
  ;; The tile of EMODnet: one grid of heights among several of how they were found.
  (let ((lats (line (first origin) 31)) (lons (line (second origin) 41)))
    (write-cdl
     file '(("lat" . 31) ("lon" . 41))
     `(("double lat(lat)" ,degrees-north ,lats)
       ("double lon(lon)" ,degrees-east ,lons)
       ("int value_count(lat, lon)" ("_FillValue = -1" "units = \"1\"") ,(table lats lons (const 17)))
       ("byte interpolation_flag(lat, lon)" ("_FillValue = 0b") ,(table lats lons (const 1)))
       ("float standard_deviation(lat, lon)" ("_FillValue = NaNf" "units = \"m\"") ,(table lats lons (const 0.3)))
       ("float elevation(lat, lon)" ("_FillValue = NaNf" "units = \"m\"" "_DeflateLevel = 9")
        ,(table lats lons (slope origin)))))))

(define (write-packed file origin)
  ;; Depths in tenths of a metre from 250 m on, from north to south, at longitudes of 0 to 360; the first row has none.
  (let* ((lats (reverse (line (first origin) 31))) (lons (map (lambda (x) (+ 360 x)) (line (second origin) 41)))
         (height (slope origin)))
    (write-cdl
     file '(("latitude" . 31) ("longitude" . 41))
     `(("float latitude(latitude)" ,degrees-north ,lats)
       ("float longitude(longitude)" ,degrees-east ,lons)
       ("short deptho(latitude, longitude)"
        ("standard_name = \"sea_floor_depth_below_geoid\"" "units = \"m\"" "_FillValue = -32767s" "scale_factor = 0.1"
         "add_offset = 250." "_DeflateLevel = 1")
        ,(table lats lons
                (lambda (lat lon)
                  (if (eqv? lat (first lats)) +nan.0 (pack 1/10 250 (- (height lat (- lon 360))))))))))))

(define-scenario (bathymetry layout)
  "A bed is as deep as was written wherever it is between its posts: to 3 mm where posts are whole metres, 5 cm where \
coordinates are 32 bits."
  #:for ((layout 'gebco 'emodnet 'packed))
  (with-programs ("ncgen")
   (let* ((origin (if (eq? layout 'packed) hudson hobart)) (height (slope origin)) (file (scratch-file "bed.nc")))
     ((case layout ((gebco) write-gebco) ((emodnet) write-emodnet) (else write-packed)) file origin)
     (enter-bed! origin `(grid ,file))
     (expect (miss origin height) is (below (if (eq? layout 'packed) 0.05 3e-3))))))

(define-scenario (translated format)
  "What GDAL's own tools make of GEBCO's grid is the same bed: a GeoTIFF of 16 bits, tiled and packed by a predictor, an \
ESRI grid, a table, a NetCDF file of their layout, and one in metres of a UTM zone."
  #:for ((format 'tiff 'ascii 'xyz 'netcdf 'utm))
  (with-programs ("ncgen" "gdal_translate" "gdalwarp")
   (let ((source (write-gebco (scratch-file "gebco.nc") hobart)) (file (scratch-file "translated.nc"))
         (height (slope hobart)))
     (case format
       ((tiff) (called "gdal_translate" "-q" "-of" "GTiff" "-a_srs" "EPSG:4326" "-a_nodata" "-32767" "-co" "TILED=YES"
                       "-co" "COMPRESS=DEFLATE" "-co" "PREDICTOR=2" source file))
       ((ascii) (called "gdal_translate" "-q" "-of" "AAIGrid" source file))
       ((xyz) (called "gdal_translate" "-q" "-of" "XYZ" source file))
       ((netcdf) (called "gdal_translate" "-q" "-of" "netCDF" "-co" "FORMAT=NC4C" "-co" "COMPRESS=DEFLATE" source file))
       (else (called "gdalwarp" "-q" "-et" "0" "-of" "GTiff" "-ot" "Float32" "-t_srs" "EPSG:32755" "-r" "bilinear" "-tr" "150" "150" "-dstnodata" "-9999"
                     "-s_srs" "EPSG:4326" source file)))
     (enter-bed! hobart `(grid ,file))
     ;; Warped once more from cells of 460 m, a slope of 960 m a degree stays a slope but for what a plane loses in the turn.
     (expect (miss hobart height) is (below (if (eq? format 'utm) 0.05 3e-3))))))

;;; Currents.

(define start 1740808800)               ; 2025-03-01T06:00Z
(define hours '(0 1 2))
(define depths '(0.5 10 30 60))

(define (east-speed origin)
  (lambda (lat lon depth hour)
    (+ 0.5 (* -0.004 depth) (* 0.1 hour) (* 2 (- lon (second origin))) (* -1 (- lat (first origin))))))
(define (north-speed origin)
  (lambda (lat lon depth hour)
    (+ -0.2 (* 0.002 depth) (* 0.05 hour) (* 3 (- lat (first origin))) (* 0.5 (- lon (second origin))))))

(define (around value) (map (lambda (i) (+ value (* 0.05 (- i 1.5)))) (iota 4)))

(define* (model-numbers speed lats lons #:key (of identity) (bottom 40))
  ;; By time, depth, latitude and longitude; nothing below BOTTOM.
  (append-map
   (lambda (hour)
     (append-map
      (lambda (depth)
        (table lats lons (lambda (lat lon) (if (> depth bottom) +nan.0 (of (speed lat lon depth hour))))))
      depths))
   hours))

(define (time-line seconds epoch)
  ;; HOURS after the start in units of SECONDS since EPOCH, s of 1970.
  (map (lambda (h) (/ (+ start (* 3600 h) (- epoch)) seconds)) hours))

(define epoch-1950 (* -86400 7305))
(define epoch-2000 946684800)

(define* (write-cmems file origin #:key (told-scale "0.000610370188951492") (told-offset "0.") (calendar "gregorian") (depths depths)
                      (times (time-line 3600 epoch-1950)))
  ;; Copernicus Marine's analysis, packed; from north to south, as no product of theirs but others are.
  (let ((lats (reverse (around (first origin)))) (lons (around (second origin))))
    (define (component name standard speed scale offset told-scale told-offset)
      `(,(string-append "short " name "(time, depth, latitude, longitude)")
        ("_FillValue = -32767s" ,(string-append "standard_name = \"" standard "\"") "units = \"m s-1\""
         ,(string-append "scale_factor = " told-scale) ,(string-append "add_offset = " told-offset)
         "valid_min = -32000s" "_DeflateLevel = 4" "_Shuffle = \"true\"" "_ChunkSizes = 1, 2, 4, 4")
        ,(model-numbers speed lats lons #:of (lambda (v) (pack scale offset v)))))
    (write-cdl
     file '(("time" . 3) ("depth" . 4) ("latitude" . 4) ("longitude" . 4))
     `(("float depth(depth)" ("units = \"m\"" "positive = \"down\"" "standard_name = \"depth\"" "axis = \"Z\"") ,depths)
       ("float latitude(latitude)" ,degrees-north ,lats)
       ("float longitude(longitude)" ,degrees-east ,lons)
       ("int time(time)" ("units = \"hours since 1950-01-01\"" "axis = \"T\""
                          ,(string-append "calendar = \"" calendar "\""))
        ,times)
       ,(component "uo" "eastward_sea_water_velocity" (east-speed origin) 0.000610370188951492 0 told-scale told-offset)
       ,(component "vo" "northward_sea_water_velocity" (north-speed origin) 0.0005 0.25 "0.0005" "0.25")))))

(define (write-hycom file origin)
  ;; HYCOM's GOFS: thousandths of a m/s, longitudes of 0 to 360, hours since 2000, `missing_value' beside the fill value.
  (let* ((lats (around (first origin))) (lons (around (second origin))) (turned (map (lambda (x) (floor-turn x)) lons)))
    (define (component name speed)
      `(,(string-append "short " name "(time, depth, lat, lon)")
        ("_FillValue = -30000s" "missing_value = -30000s" "scale_factor = 0.001f" "add_offset = 0.f" "units = \"m/s\"")
        ,(model-numbers speed lats lons #:of (lambda (v) (pack 1/1000 0 v)))))
    (write-cdl
     file '(("time" . 3) ("depth" . 4) ("lat" . 4) ("lon" . 4))
     `(("double depth(depth)" ("units = \"m\"" "positive = \"down\"" "NAVO_code = 5") ,depths)
       ("double lat(lat)" ,degrees-north ,lats)
       ("double lon(lon)" ("units = \"degrees_east\"" "modulo = \"360 degrees\"") ,turned)
       ("double time(time)" ("units = \"hours since 2000-01-01 00:00:00\"" "time_origin = \"2000-01-01 00:00:00\""
                             "calendar = \"gregorian\"") ,(time-line 3600 epoch-2000))
       ,(component "water_u" (east-speed origin))
       ,(component "water_v" (north-speed origin))))))

(define (floor-turn x) (if (negative? x) (+ 360 x) x))

(define (write-heights file origin)
  ;; Levels as heights that rise, `missing_value' alone, CF's shortest unit of latitude, seconds since 1970.
  (let ((lats (around (first origin))) (lons (around (second origin))))
    (define (component name speed)
      `(,(string-append "float " name "(time, z, y, x)") ("missing_value = -999.f")
        ,(map (lambda (v) (if (nan? v) -999 v)) (model-numbers speed lats lons))))
    (write-cdl
     file '(("time" . 3) ("z" . 4) ("y" . 4) ("x" . 4))
     `(("double z(z)" ("units = \"m\"" "positive = \"Up\"") ,(map - depths))
       ("double y(y)" ("units = \"degreeN\"") ,lats)
       ("double x(x)" ("units = \"degree_E\"") ,lons)
       ("double time(time)" ("units = \"seconds since 1970-01-01T00:00:00Z\"") ,(time-line 1 0))
       ,(component "u" (east-speed origin))
       ,(component "v" (north-speed origin))))))

(define (write-current layout file origin)
  ((case layout ((cmems) write-cmems) ((hycom) write-hycom) (else write-heights)) file origin))

(define (enter-current! origin . clauses)
  (enter! (build-world #f #f #f
                       (map data->part
                            `((sea (depth 100) (origin ,@origin) (current ,@clauses))
                              (rov (named r) (type kinematic) (at 0 0 -5))
                              (tether (from 0 0 0) (length 20) (model rubber-band)))))))

(define (current-miss origin hour)
  ;; Of the current at depths between levels, m/s.
  (apply max
         (append-map
          (lambda (depth)
            (let ((v (current-at (vec 3 7 (- depth)))))
              (map (lambda (k speed) (abs (- (f64vector-ref v k) (speed (first origin) (second origin) depth hour))))
                   '(0 1) (list (east-speed origin) (north-speed origin)))))
          '(0.5 5 17 30))))

(define-scenario (currents layout place)
  "The current at a place is the model's, to what 16 bits of it and 32 of its coordinates can tell; below its bottom it \
is as at the lowest level that has a number."
  #:for ((layout 'cmems 'hycom 'heights) (place hobart hudson))
  (with-programs ("ncgen")
   (let ((file (write-current layout (scratch-file "current.nc") place)))
     (enter-current! place `(from ,file) '(start "2025-03-01T07:00Z"))
     (expect (current-miss place 1) is (below 6e-4))
     (run 60)
     (expect (current-miss place (+ 1 1/60)) is (below 6e-4))
     (expect (current-at (vec 0 0 -80)) is (about (current-at (vec 0 0 -30)) #:within 1e-12)))))

;;; Files that promise more than they hold.

(define (write-claims file latitudes times)
  ;; A small file of chunks that were never written, of so many latitudes and times.
  (write-cdl
   file `(("time" . ,times) ("depth" . 4) ("latitude" . ,latitudes) ("longitude" . 4))
   `((":_NOFILL = \"true\"" () ())
     ("double latitude(latitude)" (,@degrees-north "_DeflateLevel = 9" ,(simple-format #f "_ChunkSizes = ~a" (min latitudes 100000))) ())
     ("double longitude(longitude)" ,degrees-east ,(around 147.4))
     ("double depth(depth)" ("positive = \"down\"") ,depths)
     ("double time(time)" ("units = \"hours since 1950-01-01\"" "_DeflateLevel = 9"
                           ,(simple-format #f "_ChunkSizes = ~a" (min times 100000))) ())
     ("short uo(time, depth, latitude, longitude)" ("_DeflateLevel = 9" "_ChunkSizes = 1, 1, 1, 4") ())
     ("short vo(time, depth, latitude, longitude)" ("_DeflateLevel = 9" "_ChunkSizes = 1, 1, 1, 4") ()))))

(define-scenario hostile
  "A small file of 2e9 latitudes or times, coordinates that were never written, a year of 360 days, times that do not rise, \
scales that are no numbers: each is refused with one line, and the dive before it goes on."
  (with-programs ("ncgen")
   (enter! 'open-water)
   (let ((before (state-hash)) (file (scratch-file "hostile.nc")))
     (define (current-refused?)
       (and (refused? '(format limit domain) (lambda () (enter-current! hobart `(from ,file)))) #t))
     (for-each (lambda (sizes)
                 (apply write-claims file sizes)
                 (expect (current-refused?) => #t))
               '((2000000000 1) (4 2000000000) (4 4)))
     (for-each (lambda (options)
                 (apply write-cmems file hobart options)
                 (expect (current-refused?) => #t))
               '((#:calendar "360_day") (#:times (658902 658902 658903)) (#:told-scale "NaN") (#:told-scale "1e300")
                 (#:told-offset "Infinity") (#:depths (0 10 10 60))))
     (expect (state-hash) => before))))

(define-scenario damaged-files
  "A damaged file of NetCDF 4, chunks and all, or of a packed GeoTIFF is a bed or a current all the same, or is refused with \
one line."
  (with-programs ("ncgen" "gdal_translate")
   (let ((bed (write-gebco (scratch-file "bed.nc") hobart)) (flow (write-cmems (scratch-file "flow.nc") hobart))
         (tiff (scratch-file "bed.tif")))
     (called "gdal_translate" "-q" "-a_srs" "EPSG:4326" "-co" "COMPRESS=LZW" "-co" "PREDICTOR=2" bed tiff)
     (for-each
      (lambda (k)
        (for-each (lambda (whole head)
                    (let ((file (damaged whole #:head head)))
                      (expect (whole-or-refused? (lambda () (enter-bed! hobart `(grid ,file)))) => #t)))
                  (list bed tiff bed tiff) '(8000 600 1000000 1000000))
        (let ((file (damaged flow #:head 16000)))
          (expect (whole-or-refused? (lambda () (enter-current! hobart `(from ,file)))) => #t)))
      (iota runs)))))
