;;; Telemetry: what readings become of bytes, what the sieve lets pass, and a dive that does what it is told.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core columns) (bight follow alarm) (bight follow carrier) (bight telemetry mavlink)
             (bight telemetry reading) (bight telemetry rows) (bight telemetry sieve) (bight telemetry source)
             (ice-9 binary-ports) (rnrs bytevectors) (rnrs exceptions) (srfi srfi-1) (srfi srfi-4))

(define dice (seed->random-state (or (and=> (getenv "BIGHT_SEED") string->number) 23)))
(define (draw low high) (+ low (* (- high low) (random:uniform dice))))

(define data (string-append (or (getenv "top_srcdir") ".") "/tests/data/telemetry/"))
(define here (and (file-exists? data) data))

(define (as-data reading) (list (reading-time reading) (reading-quantity reading) (reading-value reading)))

(define (sifted sieve readings)
  (map as-data (filter-map (lambda (r) (sift! sieve r)) readings)))


;;; Bytes.

(define (file-bytes name)
  (call-with-input-file name get-bytevector-all #:binary #t))

(define (cut-anywhere bytes take end)
  ;; What TAKE and END make of BYTES in pieces of random length.
  (let loop ((at 0) (all '()))
    (if (= at (bytevector-length bytes))
        (append all (end))
        (let* ((size (min (- (bytevector-length bytes) at) (+ 1 (random 300 dice))))
               (part (make-bytevector size)))
          (bytevector-copy! bytes at part 0 size)
          (loop (+ at size) (append all (take part)))))))

(define-scenario frames-of-others
  "Frames of an encoder that others wrote say what was put into them, in both versions and cut anywhere."
  (when here
    (let ((both (map (lambda (name)
                       (map as-data (tlog-readings 'test (string-append here name) (make-tally))))
                     '("others-1.tlog" "others-2.tlog"))))
      (expect (equal? (first both) (second both)))
      (expect (length (first both)) => (+ (* 4 41) (* 5 9)))
      (let ((at-six (filter (lambda (r) (= 6 (first r))) (first both))))
        (define (value quantity) (third (find (lambda (r) (eq? quantity (second r))) at-six)))
        (expect (map (lambda (x) (/ (round (* 1e4 x)) 1e4)) (value 'position)) => '(2.0 4.0 -4.0))
        (expect (value 'place) => '(54.0 4.000001 -4.0))
        (expect (value 'course) => '(29.0 1.0 -4.0))
        (expect (value 'heading) is (about (/ 90 (acos -1)) #:within 1e-5))
        (expect (value 'pressure) => 141525.0)
        (expect (list (value 'voltage) (value 'current) (value 'remaining)) => '(16.0 2.5 77.0))
        (expect (list (value 'payout) (value 'tension)) => '(14.0 12.5)))
      (for-each
       (lambda (k)
         (let ((f (make-frames stamp-size (make-tally))))
           (expect (equal? (map as-data (cut-anywhere (file-bytes (string-append here "others-2.tlog"))
                                                      (lambda (part) (take-frames! f part))
                                                      (lambda () (end-frames! f))))
                           (second both)))))
       (iota 10)))))

(define table "# of a dive\ntime_ms, Heading (deg), rov_x, note, rov_y_cm, depth_ft, tension_kN, payout\n\
0, 90, 1, a, 200, 10, 0.05, 12\n\
100, , 1.5, b, 210, 10, , 12.5\n\
200, 91, , c, 220, 10, 0.06, 13\n\
300, x, 2, d, 230, 10, 0.06, 13\n\
400\n\
500, 92, 3, e, 240, 10, 0.07, 14")

(define-scenario rows-of-a-table
  "Columns by their names, in their units; an empty cell says nothing, a wrong one costs its line; cut anywhere."
  (for-each
   (lambda (k)
     (let* ((tally (make-tally)) (rows (make-rows "t.csv" tally))
            (all (map as-data (cut-anywhere (string->utf8 table) (lambda (part) (take-rows! rows part))
                                            (lambda () (end-rows! rows))))))
       (expect (map first all) => '(0. 0. 0. 0. .1 .1 .2 .2 .2 .5 .5 .5 .5))
       (expect (map second all) => '(heading payout tension position payout position heading payout tension
                                     heading payout tension position))
       (expect (third (list-ref all 3)) => (list 1. 2. (* -10 3048/10000 1.)))
       (expect (third (list-ref all 2)) => 50.)
       (expect (tally-of tally 'unreadable) => 2)))
   (iota 20)))

(define-scenario tables-that-say-nothing
  "A table without times or places is refused, and quotes no word of its own."
  (for-each
   (lambda (names)
     (expect (guard (e ((bight-error? e)
                        (and (eq? 'format (bight-error-kind e))
                             (not (string-contains (bight-error-message e) "secret")))))
               (take-rows! (make-rows "t.csv" (make-tally)) (string->utf8 (string-append names "\n")))
               #f)))
   '("secret" "x,y,z" "t,x,y,secret" "t,lat,lon" "t,rov_x,nav_x,y,z")))


;;; The sieve.

(define (walk n)
  ;; N positions of a walk at most 2 m/s, ten in a second.
  (let loop ((i 0) (p '(0. 0. -5.)) (all '()))
    (if (= i n)
        (reverse all)
        (loop (+ i 1) (map (lambda (x) (+ x (draw -.1 .1))) p)
              (cons (make-reading (/ i 10.) 'position p) all)))))

(define-scenario outliers-are-dropped
  "Single positions far off leave the track as it is without them; whatever the source's clock begins with."
  (for-each
   (lambda (k)
     (let* ((track (walk 60)) (tally (make-tally)) (start (draw -1e5 1e9))
            (spoilt (map (lambda (r i)
                           (if (memv (modulo i 7) '(3 5))
                               (make-reading (reading-time r) 'position (map (lambda (x) (+ x 50)) (reading-value r)))
                               r))
                         track (iota 60)))
            (later (map (lambda (r) (make-reading (+ start (reading-time r)) 'position (reading-value r))) spoilt))
            (clean (filter (lambda (r) (memq r track)) spoilt))
            (got (sifted (make-sieve #f #f tally) later)))
       (expect (map third got) => (map reading-value clean))
       (expect (apply max (map (lambda (g c) (abs (- (first g) (reading-time c)))) got clean)) is (below 1e-5))
       (expect (tally-of tally 'outliers) => (- 60 (length clean)))))
   (iota 20)))

(define-scenario a-track-that-moves
  "Five positions that agree move the track, once."
  (let* ((tally (make-tally))
         (track (map (lambda (r)
                       (if (>= (reading-time r) 3)
                           (make-reading (reading-time r) 'position (map + (reading-value r) '(80 0 0)))
                           r))
                     (walk 60)))
         (got (sifted (make-sieve #f #f tally) track)))
    (expect (length got) => 56)
    (expect (tally-of tally 'resets) => 1)
    (expect (tally-of tally 'outliers) => 5)))

(define-scenario clocks-that-jump
  "A clock set back or far ahead costs a reading, and time goes on; one odd time costs no more than itself."
  (for-each
   (lambda (jump)
     (let* ((tally (make-tally))
            (track (map (lambda (r)
                          (let ((t (reading-time r)))
                            (make-reading (if (>= t 3) (+ t jump) t) 'position (reading-value r))))
                        (walk 60)))
            (got (sifted (make-sieve #f #f tally) track)))
       (expect (length got) => 59)
       (expect (tally-of tally 'jumps) => 1)
       (expect (apply < (map first got)))
       (expect (first (last got)) is (about (if (> jump 0) (+ 5.7 longest-gap) 5.8) #:within .11))))
   '(-1e6 -50 1e3 1e7))
  (let* ((tally (make-tally))
         (track (map (lambda (r i) (make-reading (if (= 20 i) 1e9 (reading-time r)) 'position (reading-value r)))
                     (walk 60) (iota 60)))
         (got (sifted (make-sieve #f #f tally) track)))
    (expect (length got) => 59)
    (expect (first (last got)) is (about 5.9 #:within 1e-9))
    (expect (tally-of tally 'jumps) => 0)))

(define quantities '(position place course heading pitch roll payout tension turns pressure voltage))

(define (any-number)
  (list-ref (list 0 1. -1. 1e300 -1e300 +inf.0 -inf.0 +nan.0 (draw -400 400) (draw -1e7 1e7)) (random 10 dice)))

(define-scenario anything-at-all
  "Whatever numbers come, times go on without end, places are finite, and nothing is raised."
  (for-each
   (lambda (origin)
     (let ((sieve (make-sieve origin #f (make-tally))) (passed 0))
       (for-each
        (lambda (k)
          (let* ((quantity (list-ref quantities (random (length quantities) dice)))
                 (r (sift! sieve (make-reading (any-number) quantity
                                               (if (memq quantity '(position place course))
                                                   (list (any-number) (any-number) (any-number))
                                                   (any-number))))))
            (when r (set! passed (+ 1 passed)))
            (expect (or (not r)
                        (and (finite? (reading-time r))
                             (and-map (lambda (x) (and (finite? x) (<= (abs x) 1e9)))
                                      (if (pair? (reading-value r)) (reading-value r) (list (reading-value r)))))))))
        (iota 3000))
       (expect passed is (above 100))))
   '(#f (54. 4.))))

(define-scenario degrees-and-metres
  "A place told in degrees lies where the local metres about the world's origin say; then metres of another origin
have no say, and where the first position is to be is kept."
  (let* ((tally (make-tally)) (sieve (make-sieve '(54. 4.) #f tally))
         (got (sifted sieve (list (make-reading 0 'position '(5. 5. -1.))
                                  (make-reading 0.1 'place '(54.001 4. -3.))
                                  (make-reading 0.2 'position '(500. 5. -1.))))))
    (expect (length got) => 2)
    (expect (second (third (second got))) is (about 111.3 #:within 0.2))
    (expect (tally-of tally 'outliers) => 0))
  (let ((got (sifted (make-sieve #f '(7 8) (make-tally))
                     (list (make-reading 0 'place '(54.001 4. -3.)) (make-reading 1 'place '(54.00101 4. -3.))))))
    (expect (third (first got)) => '(7. 8. -3.))
    (expect (second (third (second got))) is (about 9.11 #:within .01))))


;;; The dive.

(define (carry world readings)
  ;; A carrier to which all READINGS were given, and the tally.
  (let* ((tally (make-tally)) (c (make-carrier world tally)) (sieve (make-sieve #f #f tally)))
    (for-each (lambda (r) (let ((good (sift! sieve r))) (when good (follow-reading! c good)))) readings)
    (end-readings! c)
    (cons c tally)))

(define (along corners speed)
  ;; Readings of a vehicle along CORNERS, five a second, and its heading.
  (let loop ((p (car corners)) (left (cdr corners)) (t 0) (all '()))
    (if (null? left)
        (reverse all)
        (let* ((way (map - (car left) p)) (far (sqrt (apply + (map * way way)))) (step (* speed .2)))
          (if (<= far step)
              (loop (car left) (cdr left) (+ t .2) (cons (make-reading t 'position (car left)) all))
              (let ((q (map (lambda (a w) (+ a (* w (/ step far)))) p way)))
                (loop q left (+ t .2) (cons (make-reading t 'position p) all))))))))

(define long-line (with (find-world 'open-water) (line (length 60) (model v-shape))))

(define-scenario where-it-says
  "At each position the vehicle is where it was said to be, and on its way with the speed it has."
  (for-each
   (lambda (k)
     (let ((carried (carry long-line (walk 100))))
       (expect (carrier-farthest-strayed (car carried)) is (below 1e-9))
       (expect (tally-of (cdr carried) 'refused) => 0)
       (expect (now) is (about 8.9 #:within .02))))
   (iota 3)))

(define-scenario ahead-it-goes-on
  "A look ahead sees the vehicle go on as it goes."
  (carry long-line (along '((0 0 -5) (0 12 -5)) 0.6))
  (let ((p (rov-position)))
    (expect (what-if (run 5) (rov-position))
            is (about (map + (array->list p) '(0 3. 0)) #:within .05))))

(define (winch-readings)
  (append-map (lambda (r) (list (make-reading (reading-time r) 'payout (+ 40 (* .5 (reading-time r)))) r))
              (along '((0 0 -5) (0 12 -5)) 0.6)))

(define-scenario the-counter-is-obeyed
  "The winch lets out what the counter says, tenfold the pace as well, of every kind of tether."
  (for-each
   (lambda (model factor)
     (let* ((world (with (find-world 'open-water) (line (length 60) (model dynamic))))
            (world (if (eq? model 'dynamic) world (with world (line (model v-shape)))))
            (readings (map (lambda (r)
                             (if (eq? 'payout (reading-quantity r))
                                 (make-reading (reading-time r) 'payout
                                               (+ 40 (* factor (- (reading-value r) 40))))
                                 r))
                           (winch-readings)))
            (carried (carry world readings)))
       (expect (tether-length) is (about (+ 40 (* factor .5 (- (reading-time (last readings)) .2))) #:within 1.5))
       (expect (tally-of (cdr carried) 'refused) => 0)))
   '(v-shape dynamic dynamic) '(1 1 10)))

(define round-the-pile '((6 -6 -5) (6 6 -5) (-6 6 -5) (-6 -5 -5) (6 -6 -5)))

(define (heard readings world)
  ;; What the alarm says of a dive that does what READINGS say.
  (let* ((tally (make-tally)) (c (make-carrier world tally)) (sieve (make-sieve #f #f tally))
         (alarm #f) (looked 0) (all '()))
    (for-each (lambda (r)
                (follow-reading! c (sift! sieve r))
                (when (carrier-dive c)
                  (unless alarm (set! alarm (make-alarm 'line (lambda () (> (carrier-speed c) .1)))))
                  (when (>= (- (now) looked) 1)
                    (set! looked (now))
                    (set! all (append all (alarms! alarm))))))
              readings)
    all))

(define-scenario round-a-pile
  "A vehicle that was flown round a pile has its tether about it; it is told before, as it happens, and what to do;
done again it has the same bits, and goes back."
  (let* ((world (find-world 'pile)) (readings (along round-the-pile 1.0))
         (said (heard readings world)) (hash (state-hash)))
    (expect (winding 'p1) => -1)
    (expect (any (lambda (line) (string-contains line "touched p1")) said))
    (expect (any (lambda (line) (string-prefix? "AHEAD: " line)) said))
    (expect (any (lambda (line) (string-prefix? "COACH: " line)) said))
    (heard readings world)
    (expect (state-hash) => hash)
    (let ((before (state-hash)))
      (rewind! 2)
      (expect (not (equal? before (state-hash)))))))

(define-scenario among-others
  "Beside a boat that moves and another vehicle's tether, with a vehicle that has mass in its world, the dive is where
the vehicle was, and its recording replays."
  (let* ((file (string-append (or (getenv "TMPDIR") "/tmp") "/bight-follow-" (number->string (getpid))))
         (others (world (sea (depth 40) (current 0.25 90)) (seabed)
                        (box (named boat) (size 2 2 2) (track (0 3 14 -12) (4 3 6 -5) (9 3 0 -5)))
                        (rov (named minnow) (type bluerov2-heavy) (at 0 6 -5)) (rov (named pike) (at 0 -6 -5))
                        (tether (named line) (type fathom) (wet-weight 0) (model dynamic) (from 0 0 -2) (to minnow)
                                (length 25))
                        (tether (named other) (type fathom) (wet-weight 0) (model dynamic) (from 0 0.5 -2) (to pike)
                                (length 25))))
         (readings (along '((0 6 -5) (0 14 -5)) 1.0)))
    (carry others (take readings 10))
    (record! file)
    (move! 'minnow '(0 14 -5) #:speed 1)
    (run 4)
    (stop-recording!)
    (expect (replay file) => 'identical)
    (delete-file file)
    (let ((carried (carry others readings)))
      (expect (carrier-farthest-strayed (car carried)) is (below 1e-9))
      (expect (parted? 'line) => #f))))

(define-scenario told-once
  "Of what happens again and again, to the same, is told once in ten seconds."
  (let ((alarm (make-alarm 'line (const #f))))
    (define (touch t object) (list 'touched t 'line object))
    (expect (fresh-events! alarm (list (touch 1. 'p1) (touch 2. 'p1) (touch 3. 'p2) (list 'left 3.5 'line 'p1)
                                       (list 'arrived 4. 'minnow)))
            => (list (touch 1. 'p1) (touch 3. 'p2) (list 'left 3.5 'line 'p1)))
    (expect (map second (fresh-events! alarm (map (lambda (t) (touch t 'p1)) (iota 30 4.5)))) => '(11.5 21.5 31.5))))

(define-scenario readings-as-they-are-come-to
  "Whoever wants the readings is shown each once, in order, at a time that the dive has come to."
  (let* ((seen '()) (tally (make-tally))
         (c (make-carrier long-line tally (lambda (r t)
                                            (expect (<= t (now)))
                                            (set! seen (cons (cons t (reading-quantity r)) seen)))))
         (readings (append-map (lambda (r) (list r (make-reading (+ .05 (reading-time r)) 'tension 9.)))
                               (along '((0 0 -5) (0 12 -5)) 0.6)))
         (sieve (make-sieve #f #f tally)))
    (for-each (lambda (r) (follow-reading! c (sift! sieve r))) readings)
    (expect (apply <= (reverse (map car seen))))
    (expect (count (lambda (s) (eq? 'position (cdr s))) seen) is (above 80))
    (expect (abs (- (length seen) (* 2 (count (lambda (s) (eq? 'position (cdr s))) seen)))) is (below 2))))

(define-scenario by-heading-and-speed
  "Without a position the vehicle goes where its heading and speed lead, from the place of the world's."
  (let ((carried (carry long-line (map (lambda (i) (make-reading (/ i 5.) 'course '(90 .5 -8))) (iota 100)))))
    (expect (rov-position) is (about (list (* .5 (- 19.8 5)) 15 -8) #:within 0.2))
    (expect (tally-of (cdr carried) 'reckoned) is (above 40))))

(define-scenario what-cannot-be-followed
  "No position, degrees without an origin, a place out of the tether's reach, a world without a vehicle: each is told."
  (expect (carry long-line (list (make-reading 0 'heading 3))) raises format)
  (expect (carry long-line (list (make-reading 0 'place '(54. 4. -3.)))) raises format)
  (expect (carry long-line (list (make-reading 0 'position '(500. 0. -3.)))) raises def)
  (expect (make-carrier (world (sea (depth 9))) (make-tally)) raises def)
  (expect (open-source "udp:192.0.2.1:14550" (make-tally)) raises domain)
  (expect (open-source "udp:0.0.0.0:14550" (make-tally)) raises domain)
  (expect (open-source "udp:x" (make-tally)) raises domain)
  (expect (open-source "/dev/zero" (make-tally)) raises io)
  (expect (open-source "/nowhere/at-all.csv" (make-tally)) raises io))

(define-scenario nothing-can-be-sent
  "The kernel refuses to send anything by the socket on which a vehicle is heard."
  (let* ((probe (socket PF_INET SOCK_DGRAM 0))
         (port (begin (bind probe AF_INET INADDR_LOOPBACK 0) (sockaddr:port (getsockname probe))))
         (source (begin (close-port probe) (open-source (string-append "udp:" (number->string port)) (make-tally)))))
    (expect (catch 'system-error
              (lambda () (sendto (source-port source) (string->utf8 "x") AF_INET INADDR_LOOPBACK port) 'sent)
              (lambda args (system-error-errno args)))
            => EPIPE)
    (close-source! source)))

(define-scenario a-track-out-of-a-log
  "follow! takes a log of MAVLink; one in degrees wants a world with an origin."
  (when here
    (enter! long-line)
    (expect (follow! (string-append here "others-1.tlog")) is (about 4 #:within 1e-6))
    (run 2)
    (expect (rov-position) is (about '(2 5 -4) #:within .02))
    (enter! (with long-line (origin 54 4)))
    (follow! (string-append here "others-1.tlog"))
    (expect (norm (rov-position)) is (about 4 #:within .01))
    (expect (follow! "/dev/zero.tlog") raises io)))
