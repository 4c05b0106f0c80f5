;;; (bight dive command) --- the verbs that change a dive: sticks, autopilots, winch, sea.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive command)
  #:use-module (bight core allowance)
  #:use-module (bight core errors)
  #:use-module ((bight core files) #:select (world-origin))
  #:use-module (bight core schema)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module (bight dive task)
  #:use-module (bight engine)
  #:use-module (bight world current)
  #:use-module (bight world track)
  #:use-module (bight world waves)
  #:use-module (srfi srfi-4)
  #:export (drive! release! fly-to! fly-along! move! place! follow! arrived?
            stabilise! hold-heading! hold-depth! hold-altitude! hold-position!
            pay-out! haul-in! spooling? cut-tether!
            current! waves! drift! alter! tether-model! accuracy!))

(define degree (/ (acos -1) 180))

(define (operate! verb subject . numbers)
  (%operate! (this-engine verb) verb verb subject (list->f64vector numbers)))

(define (position-of vehicle)
  (assq-ref (%vehicle (this-engine 'rov-position) vehicle) 'position))


;;; Vehicles.

(define-argument-type (stick value)
  "a number from -1 to 1"
  (if (and (real? value) (<= -1 value 1)) (exact->inexact value) refused))

(define-verb (drive! #:subject (v vehicle)
                     #:key (surge stick +nan.0) (sway stick +nan.0) (heave stick +nan.0)
                     (yaw stick +nan.0))
  "Set sticks of the vehicle: SURGE ahead, SWAY to starboard, HEAVE up, YAW clockwise, each -1 to 1 and
held until changed; those not named stay.  Ends a flight to a place.  Return the sticks."
  (operate! 'drive! v surge sway heave yaw)
  (assq-ref (%vehicle (this-engine 'drive!) v) 'sticks))

(define-verb (release! #:subject (v vehicle))
  "Centre the sticks of the vehicle and switch its autopilots off.  Return the sticks."
  (operate! 'release! v)
  (assq-ref (%vehicle (this-engine 'release!) v) 'sticks))

(define (own-speed v)
  ;; What the vehicle does at full stick is its cruising speed.
  (max 1e-6 (assq-ref (%vehicle (this-engine 'fly-to!) v) 'surge-speed)))

(define-verb (fly-to! #:subject (v vehicle) (p point) #:key (speed positive (own-speed v)))
  "Fly the vehicle to the point P at SPEED m/s (its full surge when left out), facing it.  Time passes in
`run'; `arrived?' tells.  Return P."
  (operate! 'fly-to! v (f64vector-ref p 0) (f64vector-ref p 1) (f64vector-ref p 2) speed)
  p)

(define (row-of polyline i)
  (f64vector (array-ref polyline i 0) (array-ref polyline i 1) (array-ref polyline i 2)))

(define round-corner 0.1)               ; m: so near to a corner a vehicle with mass turns to the next,
(define look-ahead 0.5)                 ; and so near if it misses the corner by no more than
(define cut-corner 0.05)                ; on the straight way to the next: it need not slow down

(define (off-line p a b)
  ;; How far P is from the line from A to B, m (Heron).
  (let* ((x (distance p a)) (y (distance p b)) (z (distance a b)) (s (/ (+ x y z) 2)))
    (if (zero? z) x (/ (* 2 (sqrt (max 0 (* s (- s x) (- s y) (- s z))))) z))))

(define (is-rounded? place points)
  ;; Is it time to turn to the second of POINTS?
  (let ((off (distance place (car points))))
    (or (<= off round-corner)
        (and (<= off look-ahead)
             (<= (off-line (car points) place (cadr points)) cut-corner)))))

(define (fly-on task v speed)
  ;; The state of the task is the points that are left, the one he flies to first.
  (let* ((engine (this-engine 'fly-along!))
         (view (%vehicle engine v))
         (points (task-state task)))
    (cond ((and (pair? (cdr points)) (is-rounded? (assq-ref view 'position) points))
           (set-task-state! task (cdr points))
           (move-to engine v (cadr points) speed))
          ((assq-ref view 'arrived?)    ; there, or told something else
           (remove-task! (this-dive 'fly-along!) task)))))

(define (move-to engine v p speed)
  (%operate! engine 'move! 'fly-along! v
             (f64vector (f64vector-ref p 0) (f64vector-ref p 1) (f64vector-ref p 2) speed)))

(define (corners polyline)
  ;; The points of POLYLINE but those that lie within a centimetre of the way without them.
  (let loop ((i (min 1 (- (array-length polyline) 1))) (last (row-of polyline 0)) (kept '()))
    (let ((p (row-of polyline i)))
      (cond ((= i (- (array-length polyline) 1)) (reverse! (cons p kept)))
            ((straight? last p (row-of polyline (+ i 1))) (loop (+ i 1) last kept))
            (else (loop (+ i 1) p (cons p kept)))))))

(define (straight? a b c)
  ;; Is B on the way from A to C?
  (< (- (+ (distance a b) (distance b c)) (distance a c)) 1e-4))

;; The length of the way through POINTS, m.
(define (way-length points)
  (if (null? (cdr points))
      0
      (+ (distance (car points) (cadr points)) (way-length (cdr points)))))

(define-verb (fly-along! #:subject (v vehicle) (points points) #:key (speed positive (own-speed v)))
  "Fly the vehicle along the polyline POINTS at SPEED m/s, keeping its heading; time passes in `run', and
`arrived?' tells.  Sticks, or another place to go to, end it.  Return the length of the way, m."
  (let* ((engine (this-engine 'fly-along!))
         (way (corners points)))
    (move-to engine v (car way) speed)
    (add-task! 'fly-along! "fly along" (lambda (task) (fly-on task v speed)) way)
    (way-length (cons (position-of v) way))))

(define-verb (move! #:subject (v vehicle) (p point) #:key (speed positive (own-speed v)))
  "Move the vehicle along the straight line to the point P at SPEED m/s, keeping its heading.  Return P."
  (operate! 'move! v (f64vector-ref p 0) (f64vector-ref p 1) (f64vector-ref p 2) speed)
  p)

(define-verb (place! #:subject (v vehicle) (p point) #:key (fresh flag #f))
  "Sweep the vehicle to the point P at once, stopping where it is blocked; with FRESH, put it there and
lay the tether anew.  Return where it is now."
  (%operate! (this-engine 'place!) (if fresh 'lay! 'place!) 'place! v p)
  (position-of v))

(define-verb (follow! #:subject (v vehicle) (track track))
  "Let the vehicle follow a measured TRACK, a file with columns t x y z (s, m) or a list of such rows,
beginning now: where the track begins elsewhere, the vehicle is first placed there as by `place!'.  Columns
that a file names may be in any order, among others and in another unit: `time_min', `north (ft)', `depth'
in place of z; and `lat' and `lon' in place of x and y where the world has an origin.  A file NAME.tlog is a
log of MAVLink.  Return how many seconds it takes."
  (let ((rows (read-track 'follow! track (world-origin 'follow! (dive-world (current-dive))))))
    (%operate! (this-engine 'follow!) 'follow! 'follow! v rows)
    (- (f64vector-ref rows (- (f64vector-length rows) 4)) (f64vector-ref rows 0))))

(define-verb (arrived? #:subject (v vehicle))
  "Return #t unless the vehicle is still on its way to a place, along a track, or home by `fly-home!'.  One
with mass in a swell may be so for ever: ask `range-to' there."
  (let ((engine (this-engine 'arrived?)))
    (and (assq-ref (%vehicle engine v) 'arrived?)
         (not (steered? (list-ref (%names engine 'rov) v))))))

(define-verb (stabilise! #:subject (v vehicle) #:optional (on flag #t))
  "Keep a vehicle with mass level; its yaw stick then sets a rate.  So it is from the start; with ON #f
the sticks are forces and moments alone.  Return ON."
  (operate! 'stabilise! v (if on 1 0))
  on)

(define-verb (hold-heading! #:subject (v vehicle) (heading bearing))
  "Keep the vehicle's HEADING, compass degrees, until `release!'.  Return it."
  (operate! 'hold-heading! v (* heading degree))
  heading)

(define-verb (hold-depth! #:subject (v vehicle) (depth number))
  "Keep the vehicle's DEPTH in metres until `release!'.  Return it."
  (operate! 'hold-depth! v depth)
  depth)

(define-verb (hold-altitude! #:subject (v vehicle) (altitude non-negative))
  "Keep the vehicle ALTITUDE metres above what is below it, as `rov-altitude' tells it, until `release!'.
Return it."
  (operate! 'hold-altitude! v altitude)
  altitude)

(define-verb (hold-position! #:subject (v vehicle))
  "Keep the vehicle where it is: sticks centred, heading and depth held.  Return the point."
  (operate! 'hold-position! v)
  (position-of v))


;;; The winch.

(define-verb (pay-out! #:subject (t tether) (metres non-negative) #:key (rate positive 0.5))
  "Let METRES more of the tether out at RATE m/s, or as fast as its winch turns if that is less
(winch-rate); time passes in `run'.  Return the length out when the winch will stop, m."
  (operate! 'pay-out! t metres rate)
  (%target t))

(define-verb (haul-in! #:subject (t tether) (metres non-negative) #:key (rate positive 0.5))
  "Haul METRES of the tether in at RATE m/s, or as fast as its winch turns if that is less (winch-rate).
The winch stalls, and draws nothing more in, when the tether pulls as hard as it can (winch-pull).  Of a
cut tether no more comes in than is left: then its end hangs from the winch.  Return the length out when
the winch will stop, m."
  (operate! 'haul-in! t metres rate)
  (%target t))

(define (%length t)
  (assq-ref (%tether (this-engine 'tether-length) t) 'length))

(define (%target t)
  (assq-ref (%tether (this-engine 'tether-length) t) 'target))

(define-verb (spooling? #:subject (t tether))
  "Return #t while the tether's winch turns."
  (assq-ref (%tether (this-engine 'spooling?) t) 'spooling?))

(define-verb (cut-tether! #:subject (t tether) #:key (at non-negative (/ (%length t) 2)))
  "Cut the tether, moved by the model `dynamic', AT metres of arc length from its anchor (its middle when
left out); at its vehicle's end by (tether-length).  Both parts go on moving.  Of a tether that is cut already the part at the anchor is cut again, and
the piece between drifts off, out of the dive.  Return the length left at the anchor, m."
  (operate! 'cut-tether! t at)
  (%length t))


;;; The sea, and the parts' fields.

(define (set-current! proc current)
  (when (and (memq (car current) '(grid from)) (pair? (cdr current)))
    (bight-raise 'unsupported proc
                 "a dive has the file of its world, (current! '(grid)); another file needs another dive"))
  (%set-current! (this-engine proc) current))

(define-verb (current! #:rest (setting any))
  "Change the current: (current! SPEED TOWARD), or one of its other forms, quoted, as in
(current! '(profile (0 0.6 90) (-30 0.3 80))); or a procedure of position and time, which is slow.
Return the current at the surface, m/s."
  (let* ((engine (this-engine 'current!))
         (setting (if (= 1 (length setting)) (car setting) setting))
         (current (parse-current 'current! setting)))
    (set-current! 'current! current)
    (%current-at engine (f64vector 0 0 0))))

(set-procedure-property! current! 'more current-help)

(define-verb (waves! #:rest (setting any))
  "Change the waves, as in (waves! '(airy (height 1) (period 6) (toward 90))), (waves! '(jonswap (height
1.5) (period 7) (toward 90) (seed 3))) or (waves! 'none).  Return them as they are now."
  (set-waves! 'waves! (parse-waves 'waves! (if (= 1 (length setting)) (car setting) setting))))

(define (set-waves! proc waves)
  (%operate! (this-engine proc) 'waves! proc 0 (list->f64vector (waves->numbers waves)))
  waves)

;; As the engine has it for each axis.
(define-argument-type (drift-speed value)
  "a speed from 0 to 10 m/s"
  (if (and (real? value) (<= 0 value 10)) (exact->inexact value) refused))

(define-argument-type (drift-rise value)
  "a speed from -10 to 10 m/s"
  (if (and (real? value) (<= -10 value 10)) (exact->inexact value) refused))

(define (obstacle-index proc name)
  (call-with-values (lambda () (find-part proc name))
    (lambda (kind index)
      (if (eq? kind 'obstacle)
          index
          (bight-raise 'domain proc "~a is a ~a; what drifts is an obstacle" name kind)))))

(define-verb (drift! (obstacle name) (speed drift-speed) (toward bearing) #:key (rise drift-rise 0.0))
  "Set OBSTACLE, one that has a track in its world, adrift: from where it is it goes on at SPEED m/s toward the bearing
TOWARD, rising at RISE m/s, until told otherwise, and leaves its track for good.  Held back by what it would run into,
it goes on when that yields.  Return OBSTACLE."
  (let ((index (obstacle-index 'drift! obstacle)) (angle (* degree toward)))
    (operate! 'drift! index (* speed (sin angle)) (* speed (cos angle)) rise)
    obstacle))

(define (alter-field! proc head index field value)
  (when (memq field (inner-heads head))
    (bight-raise 'unsupported proc "each ~a of ~a stays as its world has it while the dive runs"
                 field (head-title head)))
  (when (map-field? (head-field head field))
    (bight-raise 'unsupported proc "`~a' of ~a stays as its world has it: it says how files are read" field
                 (head-title head)))
  (let ((value (check-field proc head field value)))
    (case field
      ((current) (set-current! proc value))
      ((waves) (set-waves! proc value))
      (else (%alter! (this-engine proc) head index field value)))))

(define (alter-fields! head index settings)
  (let loop ((rest settings))
    (cond ((null? rest) *unspecified*)
          ((not (and (keyword? (car rest)) (pair? (cdr rest))))
           (bight-raise 'domain 'alter! "after the part come fields as in #:cdn 1.4, not ~s"
                        (car rest)))
          (else
           (alter-field! 'alter! head index (keyword->symbol (car rest)) (cadr rest))
           (loop (cddr rest))))))

(define-verb (alter! (part name) #:rest (settings any))
  "Change fields of the vehicle, tether or obstacle named PART, or of the sea, while the dive runs, as in
(alter! 'line #:cdn 1.4 #:model 'catenary).  All are changed, or, when one is refused, none.  Return
PART."
  (let* ((engine (this-engine 'alter!))
         (before (and (not (%live? engine)) (%keep-dive engine)))
         (journal (%journal engine)))
    (with-exception-handler
     (lambda (e)
       (when before                     ; a live dive keeps those that went before
         (%restore-dive! engine before)
         (%set-journal! engine journal))
       (raise-exception e))
     (lambda ()
       (call-with-values (lambda () (part-to-alter 'alter! part))
         (lambda (head index)
           (alter-fields! head index settings)))
       part))))

(define-verb (tether-model! #:subject (t tether) (model name))
  "Choose the tether's MODEL: rubber-band v-shape catenary catenary-simplex elastic steady dynamic
auto.  Return it."
  (alter-field! 'tether-model! 'tether t 'model model)
  model)

(define-verb (accuracy! #:subject (t tether) (metres any))
  "Accept an error in position of METRES, or, with the word auto, of 2 cm or 0.2 % of what is paid out, whichever
is less: the model `auto' takes as many nodes as keep it.  Return METRES."
  (alter-field! 'accuracy! 'tether t 'accuracy metres)
  metres)
