;;; (bight telemetry sieve) --- readings as they should be: in order of time, within reach, in metres of the world.
;;;
;;; A source's clock may jump, a position may be anywhere.  One odd reading is dropped; that a clock or a whole
;;; track has moved is believed when the readings that follow agree with each other.  All is decided by what is
;;; read and in which order, never by this machine's clock: the same log gives the same readings.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight telemetry sieve)
  #:use-module (bight core record)
  #:use-module (bight telemetry reading)
  #:use-module (bight world earth)
  #:use-module (srfi srfi-1)
  #:export (make-sieve sieve? sift! sieve-now sieve-gap
            longest-gap fastest))

(define longest-gap 60)                 ; s without a reading that are taken for what they are
(define latest 1e12)                    ; s: what is beyond is no time
(define backward 1)                     ; s by which readings may come out of order
(define agreement 2)                    ; s within which two odd times agree
(define fastest 5.0)                    ; m/s of a vehicle, with what its position may be off by:
(define unsteady 2.0)                   ; m
(define convinced 5)                    ; odd positions that agree move the track

(define-record <sieve>
  (%make-sieve origin start tally kind shift offset now odd place odd-places gap)
  sieve?
  (origin sieve-origin set-sieve-origin!) ; (LATITUDE LONGITUDE) of the world's, or #f
  (start sieve-start)                   ; where the first position is to be, (X Y), or #f: where it says
  (kind sieve-kind set-sieve-kind!)     ; which readings tell where the vehicle is: place, position, or #f: none yet
  (shift sieve-shift set-sieve-shift!)  ; what is added to positions, (X Y), or #f before the first
  (tally sieve-tally)
  (offset sieve-offset set-sieve-offset!) ; what is added to the source's time, s, or #f before the first
  (now sieve-now set-sieve-now!)        ; the latest time, s since the first reading
  (odd sieve-odd set-sieve-odd!)        ; an impossible time that was dropped last, or #f
  (place sieve-place set-sieve-place!)  ; (TIME . POINT) of the last good position, or #f
  (odd-places sieve-odd-places set-sieve-odd-places!) ; such pairs, dropped since, the last first
  (gap sieve-gap set-sieve-gap!))       ; the longest time without a position, s

(define (make-sieve origin start tally)
  "Return a sieve for a world with ORIGIN, (LATITUDE LONGITUDE) or #f, that counts in TALLY.  START, (X Y), is where
the first position is taken to be, #f: where it says."
  (%make-sieve origin start tally #f (if start #f '(0 0)) #f 0 #f #f '() 0))


;;; Time.

(define (move-clock! s raw)
  ;; RAW and the odd time before it are of another clock, or after a long gap.
  (let ((passed (if (> (- raw (- (sieve-now s) (sieve-offset s))) 0)
                    longest-gap
                    (- raw (sieve-odd s)))))
    (tally! (sieve-tally s) 'jumps)
    (set-sieve-now! s (+ (sieve-now s) passed))
    (set-sieve-offset! s (- (sieve-now s) raw))
    (set-sieve-odd! s #f)
    (sieve-now s)))

(define (steady-time! s raw)
  ;; The time since the first reading of what the source dates RAW, or #f: it is dropped.
  (if (and (real? raw) (<= (abs raw) latest))
      (timely! s raw)
      (begin (tally! (sieve-tally s) 'untimely) #f)))

(define (timely! s raw)
  (unless (sieve-offset s)
    (set-sieve-offset! s (- raw)))
  (let* ((t (+ raw (sieve-offset s))) (ahead (- t (sieve-now s))))
    (cond ((<= (- backward) ahead longest-gap)
           (set-sieve-odd! s #f)
           (set-sieve-now! s (max t (sieve-now s)))
           t)
          ((and (sieve-odd s) (<= 0 (- raw (sieve-odd s)) agreement)) (move-clock! s raw))
          (else
           (tally! (sieve-tally s) 'untimely)
           (set-sieve-odd! s raw)
           #f))))


;;; Places.

(define (apart p q)
  (sqrt (fold (lambda (a b sum) (+ sum (* (- a b) (- a b)))) 0 p q)))

(define (reachable? from to)
  ;; Of pairs (TIME . POINT).
  (<= (apart (cdr from) (cdr to)) (+ unsteady (* fastest (abs (- (car to) (car from)))))))

(define (accept-place! s place)
  (when (sieve-place s)
    (set-sieve-gap! s (max (sieve-gap s) (- (car place) (car (sieve-place s))))))
  (set-sieve-place! s place)
  (set-sieve-odd-places! s '())
  #t)

(define (odd-place! s place)
  ;; Is PLACE the last of so many that agree that the track has moved?
  (let ((odd (sieve-odd-places s)))
    (tally! (sieve-tally s) 'outliers)
    (set-sieve-odd-places! s (cons place (if (and (pair? odd) (reachable? (car odd) place)) odd '())))
    (and (>= (length (sieve-odd-places s)) convinced)
         (begin
           (tally! (sieve-tally s) 'resets)
           (accept-place! s place)))))

(define (believable-place? s place)
  (let ((last (sieve-place s)))
    (cond ((not last) (accept-place! s place))
          ((< (car place) (car last)) (tally! (sieve-tally s) 'late) #f)
          ((reachable? last place) (accept-place! s place))
          (else (odd-place! s place)))))

(define farthest 1e5)                   ; m from the origin

(define (within-bounds? p)
  (every (lambda (x) (and (real? x) (<= (abs x) farthest))) p))

(define (degrees->point s value)
  ;; VALUE, latitude, longitude and height, as a point about the origin, or #f.
  (let ((p (and (<= (abs (first value)) 89) (<= (abs (second value)) 360)
                (degrees->local (sieve-origin s) (first value) (second value)))))
    (and p (list (car p) (cdr p) (third value)))))

(define (shifted s p)
  (unless (sieve-shift s)
    (set-sieve-shift! s (map - (sieve-start s) (take p 2))))
  (append (map + (take p 2) (sieve-shift s)) (drop p 2)))

(define (sift-point! s time p)
  (let ((p (and p (within-bounds? p) (shifted s p))))
    (cond ((not p) (tally! (sieve-tally s) 'absurd) #f)
          ((believable-place? s (cons time p)) (make-reading time 'position p))
          (else #f))))

(define (choose-kind! s kind)
  ;; Readings of KIND tell from now on where the vehicle is.
  (set-sieve-kind! s kind)
  (set-sieve-place! s #f)
  (when (sieve-start s) (set-sieve-shift! s #f)))

(define (sift-position! s time p)
  ;; P is about an origin of the source's own, of no use where degrees are told as well.
  (unless (sieve-kind s) (choose-kind! s 'position))
  (and (eq? 'position (sieve-kind s)) (sift-point! s time p)))

(define (sift-place! s time value)
  (when (and (sieve-start s) (not (sieve-origin s)) (every real? value) (<= (abs (first value)) 89))
    (set-sieve-origin! s (take value 2)))
  (cond ((not (sieve-origin s)) (tally! (sieve-tally s) 'homeless) #f)
        (else
         (unless (eq? 'place (sieve-kind s)) (choose-kind! s 'place))
         (sift-point! s time (degrees->point s value)))))


;;; All else.

(define bounds
  '((heading -720 720) (pitch -180 180) (roll -180 180) (payout 0 2e4) (tension -1e3 1e6) (turns -1e4 1e4)
    (pressure 0 2e8) (temperature -100 200) (voltage 0 2000) (current -1e4 1e4) (remaining -1 101)))

(define (sift-number! s time quantity value)
  (let ((range (assq-ref bounds quantity)))
    (cond ((not (and range (real? value) (<= (first range) value (second range))))
           (tally! (sieve-tally s) 'absurd)
           #f)
          ((eq? quantity 'heading)
           (make-reading time quantity (- value (* 360 (floor (/ value 360))))))
          (else (make-reading time quantity value)))))

(define course-bounds '((-720 720) (0 20) (-12000 9000)))

(define (sift-course! s time value)
  (cond ((every (lambda (x range) (<= (first range) x (second range))) value course-bounds)
         (make-reading time 'course value))
        (else (tally! (sieve-tally s) 'absurd) #f)))

(define (sift! s reading)
  "Return READING at its time since the first, in metres of the world, or #f if it is not believed."
  (let ((time (steady-time! s (reading-time reading))) (value (reading-value reading)))
    (and time
         (case (reading-quantity reading)
           ((position) (sift-position! s time value))
           ((place) (sift-place! s time value))
           ((course) (sift-course! s time value))
           (else (sift-number! s time (reading-quantity reading) value))))))
