;;; (bight telemetry mavlink) --- readings out of MAVLink frames: a stream of them, or a .tlog file.
;;;
;;; The frames are found and decoded in C (src/telemetry/mavlink.c), which has a fuzzer.  Here they become
;;; readings.  Only the first vehicle that tells its attitude or where it is has a say.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight telemetry mavlink)
  #:use-module (bight core columns)
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (why-not))
  #:use-module (bight core record)
  #:use-module ((bight core table) #:select (refuse-device))
  #:use-module (bight telemetry raw)
  #:use-module (bight telemetry reading)
  #:use-module (ice-9 binary-ports)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (make-frames frames? take-frames! end-frames! frames-system
            tlog-name? tlog-readings
            stamp-size))

(define stamp-size 8)                   ; bytes of time before each frame of a .tlog file


;;; Messages.

(define (values-of fields names)
  ;; What FIELDS say of NAMES, or #f if one of them says nothing.
  (let ((values (map (lambda (name) (assq-ref fields name)) names)))
    (and (every identity values) values)))

(define (named-readings time fields)
  ;; Of a value that a program on board has named: `TetherTrn' is ArduSub's own, others name a column.
  (let* ((name (or (assq-ref fields 'name) "")) (value (assq-ref fields 'value))
         (known (column name 0)))
    (cond ((not value) '())
          ((string=? name "TetherTrn") (list (make-reading time 'turns value)))
          ((and known (memq (column-quantity known) '(payout tension)))
           (list (make-reading time (column-quantity known) (* value (column-factor known)))))
          (else '()))))

(define (one time quantity value)
  (if value (list (make-reading time quantity value)) '()))

(define (place-of fields)
  ;; Before its filter has an origin, ArduPilot tells 0 degrees, 0 degrees.
  (let ((place (values-of fields '(lat lon relative-alt))))
    (and place (not (and (zero? (first place)) (zero? (second place)))) place)))

(define (message-readings message time fields)
  ;; The readings of MESSAGE, a symbol, whose FIELDS are an alist.
  (case message
    ((ATTITUDE)
     (append (one time 'heading (assq-ref fields 'yaw)) (one time 'pitch (assq-ref fields 'pitch))
             (one time 'roll (assq-ref fields 'roll))))
    ((LOCAL_POSITION_NED)
     (let ((p (values-of fields '(east north down))))
       (one time 'position (and p (list (first p) (second p) (- (third p)))))))
    ((GLOBAL_POSITION_INT) (one time 'place (place-of fields)))
    ((VFR_HUD) (one time 'course (values-of fields '(heading groundspeed alt))))
    ((SCALED_PRESSURE2)
     (append (one time 'pressure (assq-ref fields 'pressure))
             (one time 'temperature (assq-ref fields 'temperature))))
    ((BATTERY_STATUS)
     (append-map (lambda (name) (one time name (assq-ref fields name))) '(voltage current remaining)))
    ((NAMED_VALUE_FLOAT) (named-readings time fields))
    (else '())))


;;; A stream of frames.

(define-record <frames>
  (%make-frames stamp tally keep rest system time numbers)
  frames?
  (stamp frames-stamp)                  ; bytes of time before each frame
  (tally frames-tally)
  (keep frames-keep)                    ; (KEEP BYTES START END) of each frame, or #f
  (rest frames-rest set-frames-rest!)   ; bytes that are no whole frame yet
  (system frames-system set-frames-system!) ; (SYSTEM . COMPONENT) of the vehicle, or #f
  (time frames-time set-frames-time!)   ; that the vehicle told last, s, or #f
  (numbers frames-numbers))             ; of each sender's last frame, a hash table

(define* (make-frames stamp tally #:optional (keep #f))
  "Return a stream of MAVLink frames, each after STAMP bytes of time, that counts in TALLY what is wrong.  KEEP
is called with BYTES, START and END of each frame, or is #f."
  (%make-frames stamp tally keep (make-bytevector 0) #f #f (make-hash-table)))

(define tells-vehicle '(ATTITUDE LOCAL_POSITION_NED GLOBAL_POSITION_INT))

(define (note-number! f sender number)
  ;; How many frames of SENDER are missing before the one of NUMBER, as far as eight bits tell.
  (let ((before (hash-ref (frames-numbers f) sender)))
    (hash-set! (frames-numbers f) sender number)
    (when before
      (let ((missing (modulo (- number before 1) 256)))
        (when (< 0 missing 128)
          (tally! (frames-tally f) 'lost missing))))))

(define (decoded f message sender fields)
  (when (and (not (frames-system f)) (memq message tells-vehicle))
    (set-frames-system! f sender))
  (cond ((equal? sender (frames-system f))
         (and=> (assq-ref fields 'time) (lambda (time) (set-frames-time! f time)))
         (if (frames-time f) (message-readings message (frames-time f) fields) '()))
        ((frames-system f) (tally! (frames-tally f) 'foreign) '())
        (else '())))

(define (frame-readings f found)
  (let ((sender (cons (fourth found) (fifth found))))
    (tally! (frames-tally f) 'frames)
    (note-number! f sender (sixth found))
    (if (third found)
        (decoded f (third found) sender (seventh found))
        '())))

(define (whole-frame? found) (memq (first found) '(good other)))

(define (keep-frame! f bytes end found)
  (when (and (frames-keep f) (whole-frame? found))
    ((frames-keep f) bytes (- end (- (second found) (frames-stamp f))) end)))

(define (note-waste! f found last?)
  (case (first found)
    ((wrong) (tally! (frames-tally f) 'wrong))
    ((noise) (tally! (frames-tally f) 'noise (second found)))
    ((short) (when last? (tally! (frames-tally f) 'truncated)))))

(define (scan f bytes last?)
  ;; The readings of BYTES; what is not whole at their end stays, or is passed over if they are the LAST.
  (let ((n (bytevector-length bytes)))
    (let loop ((at 0) (readings '()) (cut? #f))
      (let* ((found (and (< at n) (%mavlink-next bytes at n (frames-stamp f))))
             (short? (and found (eq? 'short (first found)))))
        (cond ((not found) (set-frames-rest! f (make-bytevector 0)) (reverse! readings))
              ((and short? (not last?))
               (set-frames-rest! f (part-of bytes at n))
               (reverse! readings))
              (else
               (let ((end (+ at (if short? 1 (second found)))))
                 (unless cut? (note-waste! f found last?))
                 (keep-frame! f bytes end found)
                 (loop end
                       (if (whole-frame? found) (append-reverse (frame-readings f found) readings) readings)
                       (or cut? short?)))))))))

(define (part-of bytes from to)
  (let ((new (make-bytevector (- to from))))
    (bytevector-copy! bytes from new 0 (- to from))
    new))

(define (joined a b)
  (if (zero? (bytevector-length a))
      b
      (let ((all (make-bytevector (+ (bytevector-length a) (bytevector-length b)))))
        (bytevector-copy! a 0 all 0 (bytevector-length a))
        (bytevector-copy! b 0 all (bytevector-length a) (bytevector-length b))
        all)))

(define (take-frames! f bytes)
  "Return the readings of BYTES, more of the stream F."
  (scan f (joined (frames-rest f) bytes) #f))

(define (end-frames! f)
  "Return the readings of what is left of F, of which nothing more comes: of a file or a datagram."
  (scan f (frames-rest f) #t))


;;; Files.

(define (tlog-name? file)
  "Return true if FILE is called as ArduPilot's logs of telemetry are."
  (string-suffix-ci? ".tlog" file))

(define chunk 65536)

(define (tlog-readings proc file tally)
  "Return all readings of FILE, a .tlog, and count in TALLY.  Raise a &bight-error from PROC of kind io."
  (catch 'system-error
    (lambda ()
      (refuse-device proc file)
      (call-with-input-file file
        (lambda (port)
          (let ((f (make-frames stamp-size tally)))
            (let loop ((all '()))
              (let ((bytes (get-bytevector-n port chunk)))
                (if (eof-object? bytes)
                    (reverse! (append-reverse! (end-frames! f) all))
                    (loop (append-reverse! (take-frames! f bytes) all)))))))
        #:binary #t))
    (lambda args
      (bight-raise 'io proc "cannot read ~s: ~a" file (why-not file args)))))
