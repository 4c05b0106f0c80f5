;;; (bight command) --- the verbs that change a dive: sticks, autopilots, winch, sea.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight command)
  #:use-module (bight allowance)
  #:use-module (bight current)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight query)
  #:use-module (bight schema)
  #:use-module (bight track)
  #:use-module (bight verb)
  #:use-module ((bight world) #:select (part-head world-part))
  #:use-module (srfi srfi-4)
  #:export (drive! release! fly-to! move! place! follow! arrived?
            hold-heading! hold-depth! hold-altitude! hold-position!
            pay-out! haul-in! spooling? cut-tether!
            current! alter! tether-model! accuracy!))

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
beginning now.  Return how many seconds it takes."
  (let ((rows (read-track 'follow! track)))
    (%operate! (this-engine 'follow!) 'follow! 'follow! v rows)
    (- (f64vector-ref rows (- (f64vector-length rows) 4)) (f64vector-ref rows 0))))

(define-verb (arrived? #:subject (v vehicle))
  "Return #t unless the vehicle is still on its way to a place or along a track."
  (assq-ref (%vehicle (this-engine 'arrived?) v) 'arrived?))

(define-verb (hold-heading! #:subject (v vehicle) (heading bearing))
  "Keep the vehicle's HEADING, compass degrees, until `release!'.  Return it."
  (operate! 'hold-heading! v (* heading degree))
  heading)

(define-verb (hold-depth! #:subject (v vehicle) (depth number))
  "Keep the vehicle's DEPTH in metres until `release!'.  Return it."
  (operate! 'hold-depth! v depth)
  depth)

(define-verb (hold-altitude! #:subject (v vehicle) (altitude non-negative))
  "Keep the vehicle ALTITUDE metres above the bottom until `release!'.  Return it."
  (operate! 'hold-altitude! v altitude)
  altitude)

(define-verb (hold-position! #:subject (v vehicle))
  "Keep the vehicle where it is: sticks centred, heading and depth held.  Return the point."
  (operate! 'hold-position! v)
  (position-of v))


;;; The winch.

(define-verb (pay-out! #:subject (t tether) (metres non-negative) #:key (rate positive 0.5))
  "Let METRES more of the tether out at RATE m/s; time passes in `run'.  Return the length out when the
winch will stop, m."
  (operate! 'pay-out! t metres rate)
  (+ (%length t) metres))

(define-verb (haul-in! #:subject (t tether) (metres non-negative) #:key (rate positive 0.5))
  "Haul METRES of the tether in at RATE m/s; the winch stalls on a taut tether.  Return the length out
when the winch will stop, m."
  (operate! 'haul-in! t metres rate)
  (- (%length t) metres))

(define (%length t)
  (assq-ref (%tether (this-engine 'tether-length) t) 'length))

(define-verb (spooling? #:subject (t tether))
  "Return #t while the tether's winch turns."
  (assq-ref (%tether (this-engine 'spooling?) t) 'spooling?))

(define-verb (cut-tether! #:subject (t tether) #:key (at non-negative (/ (%length t) 2)))
  "Cut the tether, moved by the model `dynamic', AT metres of arc length from its anchor (its middle when
left out).  Both parts go on moving.  Return the length left at the anchor, m."
  (operate! 'cut-tether! t at)
  (%length t))


;;; The sea, and the parts' fields.

(define-verb (current! #:rest (setting any))
  "Change the current: (current! SPEED TOWARD), or one of its other forms, quoted, as in
(current! '(profile (0 0.6 90) (-30 0.3 80))); or a procedure of position and time, which is slow.
Return the current at the surface, m/s."
  (let* ((engine (this-engine 'current!))
         (setting (if (= 1 (length setting)) (car setting) setting))
         (current (parse-current 'current! setting)))
    (%set-current! engine current)
    (%current-at engine (f64vector 0 0 0))))

(define (alter-field! proc head index field value)
  (when (memq field (inner-heads head))
    (bight-raise 'unsupported proc "each ~a of ~a stays as its world has it while the dive runs"
                 field (head-title head)))
  (let ((value (check-field proc head field value)))
    (if (eq? field 'current)
        (%set-current! (this-engine proc) value)
        (%alter! (this-engine proc) head index field value))))

(define (alter-fields! head index settings)
  (let loop ((rest settings))
    (cond ((null? rest) *unspecified*)
          ((not (and (keyword? (car rest)) (pair? (cdr rest))))
           (bight-raise 'domain 'alter! "after the part come fields as in #:cdn 1.4, not ~s"
                        (car rest)))
          (else
           (alter-field! 'alter! head index (keyword->symbol (car rest)) (cadr rest))
           (loop (cddr rest))))))

(define (part-to-alter name)
  ;; The head and the index of the part called NAME.
  (if (eq? name 'sea)
      (values 'sea 0)
      (call-with-values (lambda () (find-part 'alter! name))
        (lambda (kind index)
          (values (case kind
                    ((vehicle) 'rov)
                    ((obstacle) (part-head (world-part (dive-world (this-dive 'alter!)) name)))
                    (else kind))
                  index)))))

(define-verb (alter! (part name) #:rest (settings any))
  "Change fields of the vehicle, tether or obstacle named PART, or of the sea, while the dive runs, as in
(alter! 'line #:cdn 1.4 #:model 'catenary).  All are changed, or, when one is refused, none.  Return
PART."
  (let* ((engine (this-engine 'alter!))
         (before (and (not (%live? engine)) (%save-dive engine)))
         (journal (%journal engine)))
    (with-exception-handler
     (lambda (e)
       (when before                     ; a live dive keeps those that went before
         (%restore-dive! engine before)
         (%set-journal! engine journal))
       (raise-exception e))
     (lambda ()
       (call-with-values (lambda () (part-to-alter part))
         (lambda (head index)
           (alter-fields! head index settings)))
       part))))

(define-verb (tether-model! #:subject (t tether) (model name))
  "Choose the tether's MODEL: rubber-band v-shape catenary catenary-simplex elastic steady dynamic
auto.  Return it."
  (alter-field! 'tether-model! 'tether t 'model model)
  model)

(define-verb (accuracy! #:subject (t tether) (metres positive))
  "Accept an error in position of METRES: the model `auto' takes as many nodes as keep it.  Return METRES."
  (alter-field! 'accuracy! 'tether t 'accuracy metres)
  metres)
