;;; (bight follow carrier) --- a dive that does what readings say: its vehicle goes where the real one was.
;;;
;;; `follow-reading!' takes one sifted reading after another; nothing else drives the dive, so whoever wants the
;;; readings for something more, such as a belief, is handed them there too.
;;;
;;; From one position to the next the vehicle moves in a straight line, and on in that direction until the
;;; next one comes: so a look ahead, on a fork, sees it go on as it does.  The winch turns as the counter of the
;;; real one says.  All of it are operations of the dive, so that it is recorded and replayed like any other.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight follow carrier)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive command)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight telemetry sieve)
  #:use-module (bight telemetry reading)
  #:use-module ((bight assembly) #:select (change-world))
  #:use-module (bight world)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (make-carrier carrier? follow-reading! end-readings! carrier-dive carrier-latest carrier-strayed
            carrier-farthest-strayed carrier-speed carrier-start
            carrier-vehicle carrier-tether))

(define patience 1)                     ; s of readings before the dive begins
(define between 0.2)                    ; s at least from one position to the next that are flown
(define unplaced 5)                     ; s without a position until speed and heading tell one
(define ahead 30)                       ; s that the vehicle goes on by itself,
(define slowest 0.05)                   ; if it goes faster than so many m/s

(define-record <carrier>
  (%make-carrier world vehicle tether tally see dive first latest place told waiting flown strayed farthest speed)
  carrier?
  (world carrier-world)
  (vehicle carrier-vehicle)             ; a name
  (tether carrier-tether)               ; a name, or #f
  (tally carrier-tally)
  (see carrier-see)                     ; called with each reading and its time in the dive, which has come there
  (dive carrier-dive set-carrier-dive!) ; or #f: it has not begun
  (first carrier-first set-carrier-first!) ; s: time at which the dive began, or of the first reading
  (latest %carrier-latest set-carrier-latest!) ; an alist of quantities and their last reading
  (place carrier-place set-carrier-place!) ; (TIME . POINT) last told or reckoned, or #f
  (told carrier-told set-carrier-told!) ; s: when a position was last told, or #f
  (waiting carrier-waiting set-carrier-waiting!) ; readings that the dive has not come to, the last first
  (flown carrier-flown set-carrier-flown!) ; s: time of the last position that was flown to
  (strayed carrier-strayed set-strayed!) ; m from where the vehicle is to where it says it is
  (farthest carrier-farthest-strayed set-farthest!) ; the most of that, m
  (speed carrier-speed set-carrier-speed!)) ; m/s of the last flight


;;; The world, with a vehicle that goes where it is told.

(define (first-of world head)
  (find (lambda (part) (eq? head (part-head part))) (world-parts world)))

(define (tether-of world vehicle)
  ;; The name of the first tether that VEHICLE pulls, or #f.
  (let ((part (find (lambda (part)
                      (and (eq? 'tether (part-head part))
                           (equal? vehicle (assq-ref (part-all-fields part) 'to))))
                    (world-parts world))))
    (and part (part-name part))))

(define* (make-carrier world tally #:optional (see (lambda (reading time) #f)))
  "Return what will carry readings to a dive in WORLD, and count in TALLY.  SEE is called with each reading and its
time in the dive, once the dive has come there."
  (let ((vehicle (first-of world 'rov)))
    (unless vehicle
      (bight-raise 'def 'follow "the world ~a has no vehicle to follow with" (or (world-name world) "without a name")))
    (%make-carrier world (part-name vehicle) (tether-of world (part-name vehicle)) tally see
                   #f #f '() #f #f '() 0 0 0 0)))

(define (carrier-start c)
  "Return where the vehicle of the world that C began with is, a list."
  (let ((at (assq-ref (part-all-fields (world-part (carrier-world c) (carrier-vehicle c))) 'at)))
    (if at (array->list at) '(0 0 0))))

(define (carrier-latest c quantity)
  "Return the value of the last reading of QUANTITY, or #f."
  (and=> (assq-ref (%carrier-latest c) quantity) reading-value))

(define (world-to-begin c p)
  ;; The world with the vehicle at P, as it was read to be.
  (let ((heading (carrier-latest c 'heading)) (payout (carrier-latest c 'payout)))
    (change-world
     (carrier-world c)
     (cons `(,(carrier-vehicle c) (mass 0) (at ,@p) ,@(if heading `((heading ,heading)) '()))
           (if (and payout (> payout 0) (carrier-tether c))
               `((,(carrier-tether c) (length ,payout)))
               '())))))

(define (begin-at! c time p)
  (with-exception-handler
      (lambda (e)
        (if (bight-error? e)
            (bight-raise (bight-error-kind e) 'follow "the dive cannot begin where the vehicle is read to be, at \
(~a ~a ~a): ~a" (tenth (first p)) (tenth (second p)) (tenth (third p)) (bight-error-message e))
            (raise-exception e)))
    (lambda ()
      (set-carrier-dive! c (enter! (world-to-begin c p))))
    #:unwind? #t)
  (set-carrier-first! c time)
  (set-carrier-flown! c time))

(define (tenth x) (/ (round (* 10 x)) 10))


;;; Flying.

(define-syntax-rule (ordering c body ...)
  ;; Evaluate the body, orders to the dive; one that the dive refuses is counted.
  (with-exception-handler
      (lambda (e)
        (if (bight-error? e) (tally! (carrier-tally c) 'refused) (raise-exception e)))
    (lambda () body ...)
    #:unwind? #t))

(define (turn! c)
  (let ((heading (carrier-latest c 'heading)))
    (when heading
      (ordering c (hold-heading! (carrier-vehicle c) heading)))))

(define least-payout 0.01)              ; m

(define (wind-line! c seconds)
  ;; Let the winch have out in SECONDS what its counter says.
  (let ((payout (carrier-latest c 'payout)) (tether (carrier-tether c)))
    (when (and payout tether)
      (let ((more (- payout (tether-length tether))))
        (when (> (abs more) least-payout)
          (ordering c
            ((if (> more 0) pay-out! haul-in!) tether (abs more) #:rate (/ (abs more) seconds))))))))

(define (onward from to factor)
  ;; The point beyond TO as seen from FROM, so many times as far.
  (map (lambda (a b) (+ a (* factor (- b a)))) from to))

(define (move-toward! c p seconds)
  ;; Let the vehicle be at P in SECONDS, and go on if it is under way.
  (let* ((from (array->list (rov-position (carrier-vehicle c))))
         (speed (/ (distance from p) seconds)))
    (set-carrier-speed! c speed)
    (ordering c
      (if (> speed slowest)
          (move! (carrier-vehicle c) (onward from p (+ 1 (/ ahead seconds))) #:speed speed)
          (move! (carrier-vehicle c) p #:speed (max 1e-4 speed))))))

(define (distance p q)
  (sqrt (fold (lambda (a b sum) (+ sum (* (- a b) (- a b)))) 0 p q)))

(define (fly-on! c time p)
  ;; Let the dive come to TIME, when the vehicle is at P.
  (let* ((steps (inexact->exact (round (/ (- time (carrier-first c) (now)) (time-step)))))
         (seconds (* steps (time-step))))
    (when (> steps 0)
      (turn! c)
      (wind-line! c seconds)
      (move-toward! c p seconds)
      (run seconds)
      (hand-on! c)
      (set-carrier-flown! c time)
      (set-strayed! c (distance (array->list (rov-position (carrier-vehicle c))) p))
      (set-farthest! c (max (carrier-farthest-strayed c) (carrier-strayed c))))))

(define (hand-on! c)
  ;; Show the readings to whose time the dive has come, the first first.
  (let ((come? (lambda (reading) (<= (- (reading-time reading) (carrier-first c)) (+ (now) (/ (time-step) 2))))))
    (call-with-values (lambda () (partition come? (carrier-waiting c)))
      (lambda (come waiting)
        (set-carrier-waiting! c waiting)
        (for-each (lambda (reading)
                    ((carrier-see c) reading (min (now) (max 0 (- (reading-time reading) (carrier-first c))))))
                  (reverse come))))))

(define (take-place! c time p)
  (set-carrier-place! c (cons time p))
  (cond ((carrier-dive c)
         (when (>= (- time (carrier-flown c)) between)
           (fly-on! c time p)))
        ((>= (- time (carrier-first c)) patience) (begin-at! c time p))))


;;; Dead reckoning: heading, speed and depth, where no position has come for a while.

(define degree (/ (acos -1) 180))

(define (reckoned c time course)
  ;; Where the vehicle is at TIME by its COURSE since it was placed last.
  (let* ((last (or (carrier-place c) (cons time (carrier-start c))))
         (way (* (second course) (- time (car last)))) (heading (* degree (first course))))
    (list (+ (second last) (* way (sin heading)))
          (+ (third last) (* way (cos heading)))
          (third course))))

(define (check-places c)
  ;; Nobody reckons where there are places, which only the world has no use for.
  (when (> (tally-of (carrier-tally c) 'homeless) 0)
    (bight-raise 'format 'follow "the vehicle tells places in degrees, and the world has no origin: say \
(origin LATITUDE LONGITUDE) of its sea or seabed, or --from-start")))

(define (take-course! c time course)
  (let ((since (or (carrier-told c) (carrier-first c))))
    (when (> (- time since) unplaced)
      (check-places c)
      (tally! (carrier-tally c) 'reckoned)
      (take-place! c time (reckoned c time course)))))


;;; Readings.

(define (note! c reading)
  (set-carrier-latest! c (cons (cons (reading-quantity reading) reading)
                               (alist-delete (reading-quantity reading) (%carrier-latest c) eq?))))

(define (follow-reading! c reading)
  "Let the dive of C do what READING, from a sieve, says."
  (let ((time (reading-time reading)))
    (unless (carrier-first c)
      (set-carrier-first! c time))
    (note! c reading)
    (when (carrier-dive c)
      (set-carrier-waiting! c (cons reading (carrier-waiting c))))
    (tally! (carrier-tally c) 'readings)
    (case (reading-quantity reading)
      ((position)
       (set-carrier-told! c time)
       (take-place! c time (reading-value reading)))
      ((course) (take-course! c time (reading-value reading))))))

(define (end-readings! c)
  "Nothing more comes: a dive that has waited for its first second begins now if it can, and comes to its last position."
  (let ((place (carrier-place c)))
    (cond ((and place (carrier-dive c)) (fly-on! c (car place) (cdr place)))
          (place (begin-at! c (car place) (cdr place)))
          (else
           (check-places c)
           (bight-raise 'format 'follow "nothing in it says where the vehicle is")))))
