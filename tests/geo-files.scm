;;; Writers of geographic files for tests: ESRI ASCII, XYZ, GeoTIFF and NetCDF (classic) from procedures, by
;;; the formats' own specifications and no library, so that what reads them is held to the formats; the same files
;;; damaged; and what tests of the reader share.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core errors) (bight world earth) (rnrs bytevectors) (rnrs exceptions) (ice-9 binary-ports) (srfi srfi-1))

(define (flatten . parts)
  ;; One bytevector of bytevectors and lists of such.
  (let* ((flat (let loop ((x parts)) (if (bytevector? x) (list x) (append-map loop x))))
         (all (make-bytevector (apply + (map bytevector-length flat)))))
    (fold (lambda (b at)
            (bytevector-copy! b 0 all at (bytevector-length b))
            (+ at (bytevector-length b)))
          0 flat)
    all))

(define (write-bytes file . parts)
  (call-with-output-file file (lambda (port) (put-bytevector port (flatten parts))) #:binary #t)
  file)

(define (packed n size set)
  (let ((b (make-bytevector (* n size))))
    (set b)
    b))

;;; A grid: WIDTH by HEIGHT cells STEP apart, the centre of the north-western one at (WEST, NORTH), and what a
;;; procedure says of each centre.

(define (grid-rows west north step width height value)
  (map (lambda (r)
         (map (lambda (c) (value (+ west (* c step)) (- north (* r step)))) (iota width)))
       (iota height)))

(define (number-text x)
  (number->string (exact->inexact x)))

(define (write-ascii file west north step width height value)
  (call-with-output-file file
    (lambda (port)
      (simple-format port "ncols ~a\nnrows ~a\nxllcenter ~a\nyllcenter ~a\ncellsize ~a\nNODATA_value -9999\n"
                     width height (number-text west) (number-text (- north (* (- height 1) step)))
                     (number-text step))
      (for-each (lambda (row) (simple-format port "~a\n" (string-join (map number-text row))))
                (grid-rows west north step width height value))))
  file)

(define (write-xyz file west north step width height value)
  (call-with-output-file file
    (lambda (port)
      (for-each (lambda (r)
                  (for-each (lambda (c)
                              (let ((x (+ west (* c step))) (y (- north (* r step))))
                                (simple-format port "~a ~a ~a\n" (number-text x) (number-text y)
                                               (number-text (value x y)))))
                            (iota width)))
                (iota height))))
  file)


;;; GeoTIFF: little-endian, one strip of floats.

(define (u16s . values)
  (packed (length values) 2
          (lambda (b) (for-each (lambda (v i) (bytevector-u16-set! b (* 2 i) v 'little)) values
                                (iota (length values))))))

(define (u32 value)
  (packed 1 4 (lambda (b) (bytevector-u32-set! b 0 value 'little))))

(define (doubles values endianness)
  (packed (length values) 8
          (lambda (b) (for-each (lambda (v i) (bytevector-ieee-double-set! b (* 8 i) (exact->inexact v) endianness))
                                values (iota (length values))))))

(define (floats values)
  (packed (length values) 4
          (lambda (b) (for-each (lambda (v i) (bytevector-ieee-single-set! b (* 4 i) (exact->inexact v) 'little))
                                values (iota (length values))))))

(define* (write-tiff file epsg west north step width height value #:key (claimed-width width))
  "EPSG is the number of a projected system, 4326 for degrees, or #f for none."
  (define n (if epsg 14 13))
  (define after (+ 8 2 (* 12 n) 4))
  (define scale (doubles (list step step 0) 'little))
  (define tie (doubles (list 0 0 0 (- west (/ step 2)) (+ north (/ step 2)) 0) 'little))
  (define keys
    (let ((model (if (eqv? epsg 4326) 2 1)) (key (if (eqv? epsg 4326) 2048 3072)))
      (u16s 1 1 0 3 1024 0 1 model 1025 0 1 1 key 0 1 (or epsg 0))))
  (define none (string->utf8 "-9999\0\0\0"))
  (define cells (floats (concatenate (grid-rows west north step width height value))))
  (define scale-at after)
  (define tie-at (+ scale-at (bytevector-length scale)))
  (define keys-at (+ tie-at (bytevector-length tie)))
  (define none-at (+ keys-at (bytevector-length keys)))
  (define cells-at (+ none-at (bytevector-length none)))
  (define (tag number type count word) (list (u16s number type) (u32 count) (u32 word)))
  (write-bytes file (string->utf8 "II") (u16s 42) (u32 8) (u16s n)
               (tag 256 4 1 claimed-width) (tag 257 4 1 height) (tag 258 3 1 32) (tag 259 3 1 1) (tag 262 3 1 1)
               (tag 273 4 1 cells-at) (tag 277 3 1 1) (tag 278 4 1 height)
               (tag 279 4 1 (bytevector-length cells)) (tag 339 3 1 3)
               (tag 33550 12 3 scale-at) (tag 33922 12 6 tie-at)
               (if epsg (tag 34735 3 16 keys-at) '())
               (tag 42113 2 6 none-at)
               (u32 0) scale tie keys none cells))


;;; NetCDF classic: big-endian doubles.

(define (b32 value)
  (packed 1 4 (lambda (b) (bytevector-u32-set! b 0 value 'big))))

(define (b-name text)
  (let* ((bytes (string->utf8 text)) (k (bytevector-length bytes)))
    (list (b32 k) bytes (make-bytevector (modulo (- k) 4) 0))))

(define (b-attribute attribute)
  ;; (NAME . TEXT), or (NAME . NUMBER).
  (list (b-name (car attribute))
        (if (string? (cdr attribute))
            (list (b32 2) (b-name (cdr attribute)))
            (list (b32 6) (b32 1) (doubles (list (cdr attribute)) 'big)))))

(define (b-list tag items write)
  (if (null? items)
      (list (b32 0) (b32 0))
      (list (b32 tag) (b32 (length items)) (map write items))))

(define (write-netcdf file dimensions variables)
  "DIMENSIONS are (NAME . SIZE), VARIABLES (NAME (DIMENSION ...) ((ATTRIBUTE . VALUE) ...) NUMBERS)."
  (define (variable-bytes v) (doubles (fourth v) 'big))
  (define (header begins)
    (flatten (string->utf8 "CDF") (u8-list->bytevector '(1)) (b32 0)
             (b-list 10 dimensions (lambda (d) (list (b-name (car d)) (b32 (cdr d)))))
             (b-list 12 '() list)
             (list (b32 11) (b32 (length variables))
                   (map (lambda (v begin)
                          (list (b-name (first v)) (b32 (length (second v)))
                                (map (lambda (d) (b32 (list-index (lambda (e) (string=? d (car e))) dimensions)))
                                     (second v))
                                (b-list 12 (third v) b-attribute)
                                (b32 6) (b32 (* 8 (length (fourth v)))) (b32 begin)))
                        variables begins))))
  (define size (bytevector-length (header (map (const 0) variables))))
  (define begins
    (let loop ((rest variables) (at size))
      (if (null? rest) '() (cons at (loop (cdr rest) (+ at (* 8 (length (fourth (car rest))))))))))
  (write-bytes file (header begins) (map variable-bytes variables)))

(define (write-bed-netcdf file name attributes west north step width height value)
  "The bathymetry NAME in degrees, from south to north, as GEBCO has it."
  (define (line first n) (map (lambda (i) (+ first (* i step))) (iota n)))
  (write-netcdf file `(("lat" . ,height) ("lon" . ,width))
                `(("lat" ("lat") (("units" . "degrees_north") ("standard_name" . "latitude"))
                   ,(line (- north (* (- height 1) step)) height))
                  ("lon" ("lon") (("units" . "degrees_east") ("standard_name" . "longitude")) ,(line west width))
                  (,name ("lat" "lon") ,attributes
                   ,(concatenate (reverse (grid-rows west north step width height value)))))))


;;; Damage.

(define runs (or (and=> (getenv "BIGHT_RUNS") string->number) 5))
(define random-numbers (seed->random-state (or (and=> (getenv "BIGHT_SEED") string->number) 17)))

(define* (damaged file #:key (head 600))
  "A copy of FILE that is cut short, or of which some of the first HEAD bytes are others."
  (let* ((bytes (call-with-input-file file get-bytevector-all #:binary #t))
         (n (bytevector-length bytes))
         (head (min n head)))
    (if (zero? (random 4 random-numbers))
        (let ((short (make-bytevector (random n random-numbers))))
          (bytevector-copy! bytes 0 short 0 (bytevector-length short))
          (write-bytes (scratch-file "damaged") short))
        (begin
          (for-each (lambda (i) (bytevector-u8-set! bytes (random head random-numbers) (random 256 random-numbers)))
                    (iota (+ 1 (random 4 random-numbers))))
          (write-bytes (scratch-file "damaged") bytes)))))


;;; What tests of the reader share.

(define (refused? kinds thunk)
  "True if THUNK raises one line that is of one of KINDS."
  (guard (e ((bight-error? e)
             (and (memq (bight-error-kind e) kinds) (not (string-index (bight-error-message e) #\newline)))))
    (thunk)
    #f))

(define (whole-or-refused? thunk)
  (guard (e ((bight-error? e) (not (string-index (bight-error-message e) #\newline))))
    (thunk)
    #t))

(define (built-with-reader?)
  (let ((program (getenv "BIGHT_GEO_READER")))
    (or (not program) (file-exists? program))))

(define-syntax-rule (with-reader body ...)
  ;; BODY, unless bight was built without the reader.
  (if (built-with-reader?) (let () body ...) (skip "built without geographic files")))

(define (bed-height origin lat lon)
  "Of the bed of the dive at a place in degrees, m."
  (let ((p (degrees->local origin lat lon)))
    (place! (vec (car p) (cdr p) -1))
    (- -1 (rov-altitude))))
