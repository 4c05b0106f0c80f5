;;; Places in degrees and instants in dates: laws of the projection, a calendar counted day by day, and what is
;;; read by them: logs of vehicles and tables of ADCPs.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight assembly) (bight world earth) (srfi srfi-1) (srfi srfi-4))

(define degree (/ (acos -1) 180))
(define a 6378137.)
(define e2 (let ((f (/ 298.257223563))) (* f (- 2 f))))

(define (meridian-radius phi)
  ;; Of curvature along the meridian, m.
  (/ (* a (- 1 e2)) (expt (- 1 (* e2 (expt (sin (* degree phi)) 2))) 1.5)))

(define (normal-radius phi)
  (/ a (sqrt (- 1 (* e2 (expt (sin (* degree phi)) 2))))))

(define (meridian-arc from to)
  ;; m, by Simpson's rule.
  (let* ((n 2000) (h (/ (- to from) n)))
    (* (/ (* h degree) 3)
       (apply + (map (lambda (i)
                       (* (cond ((or (= i 0) (= i n)) 1) ((odd? i) 4) (else 2))
                          (meridian-radius (+ from (* i h)))))
                     (iota (+ n 1)))))))

(define (gap . points) (apply max (map abs points)))

(define-scenario (along-the-meridian latitude)
  "North of the origin the way is the meridian's arc."
  #:for ((latitude -60. 0. 35. 70.))
  (for-each (lambda (d)
              (let ((p (degrees->local (list latitude 10.) (+ latitude d) 10.)))
                (expect (car p) is (about 0 #:within 1e-6))
                (expect (cdr p) is (about (meridian-arc latitude (+ latitude d)) #:within 1e-5))))
            '(-0.5 0.1 2)))

(define-scenario (conformal latitude east)
  "A step to the east and one to the north are as long as on the earth and at right angles, but for the one scale of \
the place, 1 + x2 / 2 M N."
  #:for ((latitude -60. 5. 63.4) (east 0. 0.7))
  (let* ((origin (list latitude 10.)) (h 1e-5) (here (+ 0.2 latitude)) (longitude (+ 10 east))
         (p (degrees->local origin here longitude))
         (n (degrees->local origin (+ here h) longitude))
         (w (degrees->local origin here (+ longitude h)))
         (to-north (cons (- (car n) (car p)) (- (cdr n) (cdr p))))
         (to-east (cons (- (car w) (car p)) (- (cdr w) (cdr p))))
         (long (lambda (v) (sqrt (+ (expt (car v) 2) (expt (cdr v) 2)))))
         (scale (+ 1 (/ (expt (car p) 2) (* 2 (meridian-radius here) (normal-radius here))))))
    (expect (/ (long to-north) (* h degree (meridian-radius here))) is (about scale #:within 1e-6))
    (expect (/ (long to-east) (* h degree (normal-radius here) (cos (* degree here)))) is (about scale #:within 1e-6))
    (expect (gap (/ (+ (* (car to-north) (car to-east)) (* (cdr to-north) (cdr to-east)))
                    (* (long to-north) (long to-east))))
            is (below 1e-6))))

(define-scenario dates
  "Counted day by day from 1970; offsets of clocks; what is no date is none."
  (define (leap? y) (and (zero? (modulo y 4)) (or (not (zero? (modulo y 100))) (zero? (modulo y 400)))))
  (define (two n) (string-pad (number->string n) 2 #\0))
  (let loop ((y 1970) (day 0))
    (when (< y 2040)
      (loop (+ y 1)
            (fold (lambda (length month day)
                    (expect (parse-instant (simple-format #f "~a-~a-01T12:30Z" y (two month)))
                            => (+ (* 86400. day) 45000))
                    (+ day length))
                  day
                  (list 31 (if (leap? y) 29 28) 31 30 31 30 31 31 30 31 30 31)
                  (iota 12 1)))))
  (expect (parse-instant "2025-03-01T07:00+01:00") => (parse-instant "2025-03-01 06:00"))
  (expect (parse-instant "2025-03-01T05:30:15.5-00:30") => (+ 15.5 (parse-instant "2025-03-01T06:00Z")))
  (expect (instant->string (parse-instant "2025-03-01T06:00")) => "2025-03-01T06:00:00Z")
  (for-each (lambda (text) (expect (parse-instant text) => #f))
            '("2025-02-30" "2025-13-01" "noon" "" "2025" "12" "2025-03-01T25:00Z" "(system* \"x\")")))


;;; What is read by them.

(define (written name . lines)
  (let ((file (scratch-file name)))
    (call-with-output-file file (lambda (port) (for-each (lambda (l) (display l port) (newline port)) lines)))
    file))

(define (sea-world . fields)
  (build-world #f #f #f
               (map data->part
                    `((sea (depth 100) ,@fields)
                      (rov (named r) (type kinematic) (at 0 0 -5))
                      (tether (from 0 0 0) (length 400) (model rubber-band))))))

(define-scenario logs-in-degrees
  "A log of latitude and longitude is followed where the origin puts it, by dates or by seconds; without an origin it \
is refused, and says what to give."
  (define log (written "log.csv" "timestamp,lat,lon,depth_m,heading"
                       "2025-03-01T06:00:00Z,63.4000,10.4000,5,0"
                       "2025-03-01T06:00:30Z,63.4005,10.4020,8,0"
                       "2025-03-01T06:01:00Z,63.4010,10.4000,9,0"))
  (define (place lat lon z)
    (let ((p (degrees->local '(63.4 10.4) lat lon))) (vec (car p) (cdr p) z)))
  (enter! (sea-world '(origin 63.4 10.4)))
  (expect (follow! log) => 60.)
  (run 30)
  (expect (rov-position) is (about (place 63.4005 10.402 -8) #:within 1e-6))
  (run 31)
  (expect (rov-position) is (about (place 63.401 10.4 -9) #:within 1e-6))
  (follow! (written "seconds.csv" "time_s;latitude;longitude;z" "0;63.4;10.4;-5" "10;63.4001;10.4;-6"))
  (run 11)
  (expect (rov-position) is (about (place 63.4001 10.4 -6) #:within 1e-6))
  (enter! (sea-world))
  (expect (follow! log) raises format))

(define-scenario tables-of-adcps
  "Each row is the water at a time and depth; between them it is linear; a direction is where the water goes."
  (define table
    (apply written "adcp.csv" "time,depth (m),speed (cm/s),direction"
           (append-map (lambda (minute)
                         (map (lambda (depth)
                                (simple-format #f "2025-03-01 06:0~a,~a,~a,~a" minute depth (+ 40 minute (- (/ depth 2)))
                                               90))
                              '(0 10 30)))
                       '(0 1 2))))
  (enter! (sea-world `(current (from ,table))))
  (expect (current-at (vec 9 9 -5)) is (about (vec 0.375 0 0) #:within 1e-12))
  (run 30)
  (expect (current-at (vec 0 0 -30)) is (about (vec 0.255 0 0) #:within 1e-9))
  (enter! (sea-world `(current (from ,table) (start "2025-03-01T06:01Z"))))
  (expect (current-at (vec 0 0 0)) is (about (vec 0.41 0 0) #:within 1e-12))
  (expect (enter! (sea-world `(current (from ,table) (start "2025-04-01")))) raises format)
  (expect (enter! (sea-world `(current (from ,(written "no.csv" "a,b" "1,2"))))) raises format)
  (expect (enter! (sea-world `(current (from ,(written "short.csv" "time,depth,speed,direction" "0,0,1,0" "0,5,1,0"
                                                        "9,0,1,0")))))
          raises format)
  (expect (sea-world '(current (from 7))) raises domain)
  (expect (sea-world `(current (from ,table) (where 3))) raises domain))

(define-scenario comes-back
  "Origin and current are told by the world as data, and a save keeps them; another file there is noticed."
  (define table (written "kept.csv" "time,depth,speed,direction" "0,0,0.5,0" "60,0,0.7,0"))
  (define saved (scratch-file "kept.bight"))
  (enter! (sea-world '(origin 63.4 10.4) `(current (from ,table) (start 0))))
  (run 1)
  (let ((hash (state-hash)))
    (save! saved)
    (run 1)
    (load-dive saved)
    (expect (state-hash) => hash)
    (written "kept.csv" "time,depth,speed,direction" "0,0,0.5,0" "60,0,0.9,0")
    (expect (load-dive saved) raises version)))
