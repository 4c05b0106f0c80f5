;;; (bight world build) --- structures as lists of parts: jackets, piers, wrecks and what else one dives at.
;;;
;;; Each builder returns a list that `splice' puts into a world: one group, its members named
;;; NAME/MEMBER, drawn about its own origin and then put AT a place and turned to a HEADING.  Sizes are
;;; those usual for such structures, not those of a particular one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world build)
  #:use-module (bight assembly)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (make-jacket make-pier make-wreck make-hull make-net-pen make-pipeline
            make-ice-hole make-tunnel make-wellhead make-rigging))

(define origin (f64vector 0 0 0))

;; Wider than any structure there is, and yet so that no call takes longer than a blink.

(define-argument-type (metres value)
  "a number of metres from 0.01 to 5000"
  (if (and (real? value) (<= 0.01 value 5000)) (exact->inexact value) refused))

(define-argument-type (radius-of-tube value)
  "a radius from 0.0005 to 100 m"
  (if (and (real? value) (<= 0.0005 value 100)) (exact->inexact value) refused))

(define-argument-type (many value)
  "a whole number from 1 to 100"
  (if (and (exact-integer? value) (<= 1 value 100)) value refused))

(define-argument-type (side-count value)
  "a whole number from 4 to 100"
  (if (and (exact-integer? value) (<= 4 value 100)) value refused))

(define (check proc holds? . message)
  (unless holds?
    (apply bight-raise 'domain proc message)))

(define (group name at heading members)
  ;; The list of the one group that MEMBERS, data of parts, make.
  (list (data->part `(group (named ,name) (at ,at) (heading ,heading) ,@members))))

(define (numbered stem . numbers)
  ;; leg-1, brace-2-3
  (string->symbol (string-join (cons (symbol->string stem) (map number->string numbers)) "-")))

(define (tube name from to radius . fields)
  `(capsule (named ,name) (from ,@from) (to ,@to) (radius ,radius) ,@fields))

(define (pile name from to radius)
  `(cylinder (named ,name) (from ,@from) (to ,@to) (radius ,radius)))

(define (block name at size . fields)
  `(box (named ,name) (at ,@at) (size ,@size) ,@fields))

(define (spread n from to)
  ;; N numbers from FROM to TO, both included.
  (if (= n 1)
      (list (/ (+ from to) 2))
      (map (lambda (i) (+ from (/ (* i (- to from)) (- n 1)))) (iota n))))

(define (around n radius z)
  ;; N points on a level circle.
  (map (lambda (i)
         (let ((angle (* i (/ (* 2 (acos -1)) n))))
           (list (* radius (sin angle)) (* radius (cos angle)) z)))
       (iota n)))

(define (each-pair f points)
  ;; F of each point and the next, round in a ring, and the number of the pair.
  (map f points (append (cdr points) (list (car points))) (iota (length points) 1)))


;;; Offshore.

(define (leg-name i)
  ;; a1 a2 b2 b1, round the jacket.
  (list-ref '(leg-a1 leg-a2 leg-b2 leg-b1) i))

(define (corners half z)
  (list (list (- half) half z) (list half half z) (list half (- half) z) (list (- half) (- half) z)))

(define (leg-at half batter z)
  ;; The four legs at height Z, spreading by BATTER below the surface.
  (corners (+ half (* batter (- z))) z))

(define (cross-braces level low high radius)
  (append-map (lambda (i)
                (let ((j (modulo (+ i 1) 4)))
                  (list (tube (numbered 'brace level (+ i 1) 1) (list-ref low i) (list-ref high j) radius)
                        (tube (numbered 'brace level (+ i 1) 2) (list-ref low j) (list-ref high i)
                              radius))))
              (iota 4)))

(define (horizontals level points radius)
  (each-pair (lambda (a b i) (tube (numbered 'level level i) a b radius)) points))

(define-verb (make-jacket #:key (name name 'jacket) (at point origin) (heading bearing 0)
                          (depth metres 60) (spacing metres 12) (bays many 3)
                          (leg-radius radius-of-tube 0.6) (brace-radius radius-of-tube 0.25)
                          (batter (between 0 1) 0) (top (between -5000 1000) 0))
  "Return the parts of a jacket of four legs, SPACING metres apart at the surface and spreading by BATTER
to every metre down, from TOP to DEPTH, with levels and X braces in BAYS bays: legs leg-a1 leg-a2 leg-b2
leg-b1, clockwise from the north-west."
  (check 'make-jacket (> top (- depth)) "a jacket reaches from its top down to its depth, not from ~a to ~a"
         top (- depth))
  (let* ((levels (spread (+ bays 1) top (- depth)))
         (rings (map (lambda (z) (leg-at (/ spacing 2) batter z)) levels)))
    (group name at heading
           (append
            (map (lambda (i)
                   (pile (leg-name i) (list-ref (first rings) i) (list-ref (last rings) i)
                         leg-radius))
                 (iota 4))
            (append-map (lambda (ring i) (horizontals i ring brace-radius)) rings
                        (iota (length rings)))
            (append-map (lambda (high low i) (cross-braces i low high (* 0.8 brace-radius)))
                        rings (cdr rings) (iota bays 1))))))

(define-verb (make-pipeline #:key (name name 'pipeline) (at point origin) (heading bearing 0)
                            (length metres 30) (radius radius-of-tube 0.3) (span (between 0 1000) 0.8)
                            (supports many 3))
  "Return the parts of a pipeline LENGTH metres long to the north and south, its lower side SPAN metres
above the level of AT on SUPPORTS concrete blocks."
  (let ((z (+ span radius)) (half (/ length 2)))
    (group name at heading
           (cons (pile 'pipe (list 0 (- half) z) (list 0 half z) radius)
                 (if (zero? span)
                     '()
                     (map (lambda (y i)
                            (block (numbered 'support i) (list 0 y (/ span 2)) (list 3 1 span)))
                          (spread supports (* -0.8 half) (* 0.8 half))
                          (iota supports 1)))))))

(define-verb (make-wellhead #:key (name name 'wellhead) (at point origin) (heading bearing 0)
                            (height metres 12) (riser metres 30))
  "Return the parts of a wellhead standing on the level of AT: guide base with four posts, a blow-out
preventer up to HEIGHT metres, a panel on its front, choke and kill hoses, and RISER metres of riser."
  (let ((top (+ 1 height)))
    (group name at heading
           (append
            (list (block 'base '(0 0 0.5) '(4 4 1))
                  (block 'stack (list 0 0 (+ 1 (/ height 2))) (list 3.2 3.2 height))
                  (block 'panel (list 0 1.8 (+ 1 (/ height 3))) '(0.8 0.36 0.5))
                  (pile 'riser (list 0 0 top) (list 0 0 (+ top riser)) 0.27)
                  (tube 'choke (list 0.9 0 top) (list 0.45 0 (+ top riser)) 0.05)
                  (tube 'kill (list -0.9 0 top) (list -0.45 0 (+ top riser)) 0.05))
            (map (lambda (corner i)
                   (tube (numbered 'post i) corner (list (first corner) (second corner) 4) 0.1))
                 (corners 1.8 1) (iota 4 1))))))


;;; Harbours and ships.

(define-verb (make-pier #:key (name name 'pier) (at point origin) (heading bearing 0)
                        (depth metres 10) (rows many 2) (columns many 5) (spacing metres 4)
                        (radius radius-of-tube 0.3) (deck flag #t))
  "Return the parts of a pier: COLUMNS by ROWS piles SPACING metres apart, down to DEPTH, beams along the
rows a metre above the water, and a DECK on them: piles pile-ROW-COLUMN."
  (let* ((xs (spread columns (* -1/2 spacing (- columns 1)) (* 1/2 spacing (- columns 1))))
         (ys (spread rows (* -1/2 spacing (- rows 1)) (* 1/2 spacing (- rows 1))))
         (long (+ spacing (* spacing (- columns 1))))
         (wide (+ spacing (* spacing (- rows 1)))))
    (group name at heading
           (append
            (append-map (lambda (y row)
                          (map (lambda (x column)
                                 (pile (numbered 'pile row column) (list x y 1) (list x y (- depth))
                                       radius))
                               xs (iota columns 1)))
                        ys (iota rows 1))
            (map (lambda (y row) (block (numbered 'beam row) (list 0 y 1.25) (list long 0.5 0.5)))
                 ys (iota rows 1))
            (if deck (list (block 'deck '(0 0 1.75) (list long wide 0.5))) '())))))

(define (hull-points length beam draught bow)
  ;; Half a ship: keel, bilge and deck edge at stations from stern to bow, and their mirror.
  (let* ((half (/ length 2))
         (stations (list (list (- half) 0.7) (list (* -0.6 half) 1) (list (* 0.6 half) 1)))
         (sections (append-map
                    (lambda (station)
                      (let ((y (first station)) (b (* 1/2 beam (second station))))
                        (list (list (* 0.6 b) y (- draught)) (list b y (* -0.5 draught)) (list b y 1.5)
                              (list (* -0.6 b) y (- draught)) (list (- b) y (* -0.5 draught))
                              (list (- b) y 1.5))))
                    stations)))
    (append sections (list (list 0 (* bow half) (- draught)) (list 0 half 1.5)))))

(define-verb (make-hull #:key (name name 'ship) (at point origin) (heading bearing 0)
                        (length metres 60) (beam metres 12) (draught metres 4))
  "Return the parts of a ship's hull afloat, its bow to the north: the hull, bilge keels, rudder and
propeller shaft, and an anchor chain from the bow."
  (let ((half (/ length 2)))
    (group name at heading
           (list `(convex (named hull) (points ,@(hull-points length beam draught 0.85)))
                 (block 'bilge-keel-port (list (* -0.5 beam) 0 (* -0.7 draught))
                        (list 0.8 (* 0.4 length) 0.1) '(roll -30))
                 (block 'bilge-keel-starboard (list (* 0.5 beam) 0 (* -0.7 draught))
                        (list 0.8 (* 0.4 length) 0.1) '(roll 30))
                 (block 'rudder (list 0 (- (+ half 1.5)) (* -0.6 draught))
                        (list 0.3 1.6 (* 0.7 draught)))
                 (tube 'shaft (list 0 (- half) (* -0.7 draught))
                       (list 0 (- (+ half 0.5)) (* -0.7 draught)) 0.2)
                 (tube 'chain (list 0 (+ half 0.3) 1) (list 0 (+ half 12) -15) 0.06)))))

(define-verb (make-rigging #:key (name name 'rigging) (at point origin) (heading bearing 0)
                           (masts many 2) (height metres 12) (spacing metres 10)
                           (beam metres 6) (wire radius-of-tube 0.01))
  "Return the parts of rigging that stands on the level of AT: MASTS masts in a row to the north, each
with a yard and two shrouds to either side, and stays between their tops, of wire with radius WIRE."
  (let* ((ys (spread masts (* -1/2 spacing (- masts 1)) (* 1/2 spacing (- masts 1))))
         (numbers (iota masts 1))
         (half (/ beam 2)))
    (group name at heading
           (append
            (map (lambda (y i) (tube (numbered 'mast i) (list 0 y 0) (list 0 y height) 0.2)) ys numbers)
            (map (lambda (y i)
                   (tube (numbered 'yard i) (list (- half) y (* 0.7 height))
                         (list half y (* 0.7 height)) 0.08))
                 ys numbers)
            (append-map
             (lambda (y i)
               (append-map
                (lambda (side word)
                  (map (lambda (aft k)
                         (tube (numbered (symbol-append 'shroud- word) i k)
                               (list (* side half) (+ y aft) 0) (list 0 y (* 0.9 height)) wire))
                       '(-1 1) '(1 2)))
                '(-1 1) '(port starboard)))
             ys numbers)
            (map (lambda (a b i)
                   (tube (numbered 'stay i) (list 0 a height) (list 0 b height) wire))
                 ys (append (cdr ys) '()) (iota (max 0 (- masts 1)) 1))))))

(define-verb (make-wreck #:key (name name 'wreck) (at point origin) (heading bearing 0)
                         (length metres 30) (beam metres 7) (height metres 4)
                         (list-angle bearing 20))
  "Return the parts of a wreck on the level of AT, lying over by LIST-ANGLE degrees: sides and decks with
an open hatch one may swim into, a deckhouse, masts and stays."
  (let* ((half (/ length 2))
         (tilt `(roll ,list-angle))
         (lean (* list-angle (/ (acos -1) 180)))
         (tilted (lambda (x y z)
                   (list (+ (* x (cos lean)) (* z (sin lean))) y
                         (+ (- (* z (cos lean)) (* x (sin lean))) (* 1/2 beam (sin (abs lean)))))))
         (plank (lambda (name x y z size) (block name (tilted x y z) size tilt)))
         (mast (lambda (name y tall)
                 (tube name (tilted 0 y height) (tilted 0 y (+ height tall)) 0.2)))
         (stay (lambda (name y1 z1 y2 z2) (tube name (tilted 0 y1 z1) (tilted 0 y2 z2) 0.01))))
    (group name at heading
           (list (plank 'port (- (/ beam 2)) 0 (/ height 2) (list 0.3 length height))
                 (plank 'starboard (/ beam 2) 0 (/ height 2) (list 0.3 length height))
                 (plank 'keel 0 0 0.15 (list beam length 0.3))
                 (plank 'transom 0 (- half) (/ height 2) (list beam 0.3 height))
                 (plank 'stem 0 half (/ height 2) (list (* 0.5 beam) 0.3 height))
                 (plank 'fore-deck 0 (* 0.6 half) height (list beam (* 0.8 half) 0.2))
                 (plank 'after-deck 0 (* -0.65 half) height (list beam (* 0.7 half) 0.2))
                 (plank 'house 0 (* -0.7 half) (+ height 1.5) (list (* 0.6 beam) (* 0.3 half) 3))
                 (mast 'fore-mast (* 0.5 half) 9)
                 (mast 'main-mast (* -0.25 half) 11)
                 (stay 'stay-1 half height (* 0.5 half) (+ height 9))
                 (stay 'stay-2 (* 0.5 half) (+ height 9) (* -0.25 half) (+ height 11))
                 (stay 'stay-3 (* -0.25 half) (+ height 11) (- half) height)))))


;;; Farms, ice, tunnels.

(define-verb (make-net-pen #:key (name name 'pen) (at point origin) (heading bearing 0)
                           (radius metres 15) (depth metres 15) (sides side-count 16)
                           (mesh metres 3))
  "Return the parts of a net pen afloat: a collar of RADIUS metres with SIDES sides, the net's own lines
down to the sinker tube at DEPTH, level lines every MESH metres, and four bridles.  The cloth between the
lines is not modelled."
  (check 'make-net-pen (<= (/ depth mesh) 100)
         "a net of ~a m has level lines at least ~a m apart, not ~a" depth (/ depth 100) mesh)
  (let* ((collar (around sides radius 0))
         (sinker (around sides radius (- depth)))
         (levels (map (lambda (i) (- (* mesh (+ i 1))))
                      (iota (max 0 (- (inexact->exact (ceiling (/ depth mesh))) 1)))))
         (corner (lambda (i) (list-ref collar (quotient (* i sides) 4)))))
    (group name at heading
           (append
            (each-pair (lambda (a b i) (tube (numbered 'collar i) a b 0.15)) collar)
            (each-pair (lambda (a b i) (tube (numbered 'sinker i) a b 0.1)) sinker)
            (map (lambda (a b i) (tube (numbered 'line i) a b 0.01)) collar sinker (iota sides 1))
            (append-map
             (lambda (z level)
               (each-pair (lambda (a b i) (tube (numbered 'ring level i) a b 0.01))
                          (around sides radius z)))
             levels (iota (length levels) 1))
            (map (lambda (i)
                   (let ((c (corner i)))
                     (tube (numbered 'bridle (+ i 1)) c
                           (list (* 2 (first c)) (* 2 (second c)) (* -0.7 depth)) 0.03)))
                 (iota 4))))))

;; Of a keel of ice, m.
(define keel-breadth 1.5)

(define-verb (make-ice-hole #:key (name name 'ice) (at point origin) (heading bearing 0)
                            (hole metres 1) (thickness metres 2) (extent metres 60)
                            (keels many 3))
  "Return the parts of a sheet of ice, EXTENT metres wide and THICKNESS deep, with a square hole HOLE
metres wide in its middle and KEELS keels under it between its edges, but none under the hole."
  (check 'make-ice-hole (< hole extent) "a hole in ice ~a m wide is less wide, not ~a" extent hole)
  (let* ((half (/ extent 2)) (rim (/ hole 2)) (side (- half rim)) (z (* -1/2 thickness))
         (under-hole? (lambda (y) (< (abs y) (+ rim keel-breadth))))
         (places (remove under-hole? (spread (+ keels 2) (- half) half))))
    (group name at heading
           (append
            (list (block 'west (list (- (+ rim (/ side 2))) 0 z) (list side extent thickness))
                  (block 'east (list (+ rim (/ side 2)) 0 z) (list side extent thickness))
                  (block 'north (list 0 (+ rim (/ side 2)) z) (list hole side thickness))
                  (block 'south (list 0 (- (+ rim (/ side 2))) z) (list hole side thickness)))
            (map (lambda (y i)
                   (block (numbered 'keel i) (list 0 y (- (+ thickness 0.5)))
                          (list (* 0.7 extent) keel-breadth 3) '(pitch 20)))
                 places
                 (iota (length places)))))))

(define-verb (make-tunnel #:key (name name 'tunnel) (at point origin) (heading bearing 0)
                          (length metres 60) (width metres 3) (bend bearing 0) (bars flag #t))
  "Return the parts of a square tunnel WIDTH metres wide that runs LENGTH metres to the north and, half
way, turns by BEND degrees (at most 80 either way); with BARS a trash rack closes its far end but for a
gap."
  (unless (<= -80 bend 80)
    (bight-raise 'domain 'make-tunnel "a tunnel bends by -80 to 80 degrees, not ~a" bend))
  (let* ((half (/ length 2))
         (angle (* bend (/ (acos -1) 180)))
         (shell (lambda (stem x y turn long)
                  (let ((place (lambda (dx dz)
                                 (list (+ x (* dx (cos turn))) (- y (* dx (sin turn))) dz)))
                        (course `(heading ,(* turn (/ 180 (acos -1)))))
                        (off (+ (/ width 2) 0.25)))
                    (list (block (symbol-append stem '-left) (place (- off) 0)
                                 (list 0.5 long (+ width 1)) course)
                          (block (symbol-append stem '-right) (place off 0)
                                 (list 0.5 long (+ width 1)) course)
                          (block (symbol-append stem '-roof) (place 0 off)
                                 (list (+ width 1) long 0.5) course)
                          (block (symbol-append stem '-floor) (place 0 (- off))
                                 (list (+ width 1) long 0.5) course)))))
         (end (list (* half (sin angle)) (+ half (* half (cos angle))))))
    (group name at heading
           (append
            (shell 'first 0 (/ half 2) 0 half)
            (shell 'second (* 1/2 half (sin angle)) (+ half (* 1/2 half (cos angle))) angle half)
            (if bars
                (map (lambda (x i)
                       (tube (numbered 'bar i)
                             (list (+ (first end) (* x (cos angle))) (- (second end) (* x (sin angle)))
                                   (/ width -2))
                             (list (+ (first end) (* x (cos angle))) (- (second end) (* x (sin angle)))
                                   (/ width 2))
                             0.02))
                     (spread 5 (* -0.4 width) (* 0.2 width)) (iota 5 1))
                '())))))
