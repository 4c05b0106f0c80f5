;;; (bight dive aware) --- what a tether is doing: how wound, how fouled, how it comes free.
;;;
;;; Every answer comes of the present state alone and is worked out when asked: a step costs nothing for
;;; it.  Several questions about one state share one taut string.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive aware)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive contact)
  #:use-module ((bight dive figures) #:select (refuse-parted))
  #:use-module (bight dive plain-words)
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-11) #:select (let-values))
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (winding turns wrap-angle capstan-lock
            homotopy-class homotopy-class? class-decided? class-free?
            knotted? fouled? foul-reason
            free-to-haul? haul-trial haul-prospect
            way-home way-home-preview unwind-plan slack-to-reach
            follow-string
            windings
            ;; For (bight dive homing).
            unwind-said
            ;; For (bight dive tour).
            members-of
            ;; For panels.
            windings->strings))

(define degree (/ (acos -1) 180))


;;; Turns.

(define (members-of name)
  ;; The numbers of the members of the structure NAME; of the obstacle NAME, if it is one.
  (let* ((names (%names (this-engine 'winding) 'obstacle))
         (members (if (memq name names)
                      '()
                      (filter-map (lambda (other i) (and other (eq? name (structure-of other)) i))
                                  names (iota (length names))))))
    (if (null? members) (list (obstacle-index 'winding name)) members)))

(define (in-all turns)
  ;; Of the TURNS about the members of a structure: how many, with the sign of most, of the first if both
  ;; signs are as many.  0 only if all are.
  (let* ((turns (filter (negate zero?) turns)) (sum (fold + 0 turns)))
    (if (null? turns)
        0
        (* (fold + 0 (map abs turns)) (if (negative? (if (zero? sum) (car turns) sum)) -1 1)))))

(define-verb (winding #:subject (t tether) (object name))
  "Return how many whole turns the tether is caught about OBJECT: how often the line that goes out along the
tether, drawn tight, and home by the free way goes about it and cannot be drawn off.  Clockwise looking along
the object's axis, from its `from' to its `to' (down, for what has no axis), is positive.  It is 0 wherever
the class is the free way, for a line that merely passes, and for what ends in the water, since a line can be
drawn off its end.  Where members meet in joints it is the fewest turns that stand for the class.  OBJECT may
be a structure, such as the group `tower' of tower/leg-1: then it is how many turns there are about its
members, with the sign of most.  `turns' is the raw angle."
  (let ((engine (this-engine 'winding)))
    (in-all (map (lambda (i) (%winding engine t i)) (members-of object)))))

(define-verb (turns #:subject (t tether) (object name))
  "Return the signed turns of the tether about OBJECT from its anchor to its end, a number that grows
steadily as the vehicle goes round; clockwise, as for `winding', is positive.  The object's axis is taken to
have no ends: a line that passes above a stub turns about it too.  `winding' says what is caught."
  (%turns (this-engine 'turns) t (obstacle-index 'turns object)))

(define-verb (wrap-angle #:subject (t tether) (object name))
  "Return the degrees of contact by which the tether, drawn tight, bends round OBJECT."
  (/ (%wrap-angle (this-engine 'wrap-angle) t (obstacle-index 'wrap-angle object)) degree))

(define-verb (capstan-lock #:subject (t tether))
  "Return by how much friction multiplies a pull along the tether, drawn tight: the product of exp (mu
theta) over all it bends round; 1 when it touches nothing."
  (%capstan-lock (this-engine 'capstan-lock) t))

(define-verb (windings #:subject (t tether))
  "Return what the tether is caught on, an alist from the name of the object to its `winding', which is not
0.  A structure comes before its members.  The prompt says it in words."
  (let ((entries (%windings (this-engine 'windings) t)))
    (with-words 'windings (with-structures entries) (lambda () (windings-said entries)))))

(define (with-structures entries)
  (append-map (lambda (group)
                (if (car group)
                    (acons (car group) (in-all (map cdr (cdr group))) (cdr group))
                    (cdr group)))
              (by-structure entries)))

(define (by-structure windings)
  ;; ((STRUCTURE ENTRY ...) ...) of the entries of WINDINGS in their order; what is no member alone, under #f.
  (let loop ((left windings) (groups '()))
    (if (null? left)
        (reverse! groups)
        (let ((structure (structure-of (caar left))))
          (if structure
              (let-values (((members others)
                            (partition (lambda (e) (eq? structure (structure-of (car e)))) left)))
                (loop others (cons (cons structure members) groups)))
              (loop (cdr left) (cons (list #f (car left)) groups)))))))

(define most-members 3)

(define (signed n)
  (string-append (if (positive? n) "+" "") (number->string n)))

(define (members->string structure members)
  (define (own-name name)
    (substring (symbol->string name) (+ 1 (string-length (symbol->string structure)))))
  (let ((more (- (length members) most-members)))
    (string-append
     (symbol->string structure) ": "
     (string-join (map (lambda (e) (string-append (own-name (car e)) " " (signed (cdr e))))
                       (if (positive? more) (take members most-members) members))
                  ", ")
     (if (positive? more) (simple-format #f " and ~a more" more) ""))))

(define (windings->strings t)
  "Return what tether number T is caught on, in words: a string for each object and each structure."
  (map (lambda (group)
         (if (car group)
             (members->string (car group) (cdr group))
             (string-append (symbol->string (caadr group)) " " (signed (cdadr group)))))
       (by-structure (%windings (this-engine 'windings) t))))


;;; Classes.

(define-record <class>
  (make-class world letters objects decided? stamp)
  class?
  (letters class-letters)
  (objects class-objects)
  (decided? %decided?)
  (stamp class-stamp))                  ; of a class that is not known: it equals that of its state alone

(define (times n)
  (case n ((1) "once") ((2) "twice") (else (string-append (number->string n) " times"))))

(define (runs letters objects)
  ;; Lists (OBJECT SIGN COUNT) of letters in a row that are the same.
  (let loop ((letters letters) (objects objects) (all '()))
    (cond ((null? letters) (reverse! all))
          ((and (pair? all) (equal? (caar all) (abs (car letters)))
                (= (caddar all) (if (positive? (car letters)) 1 -1)))
           (let ((run (car all)))
             (loop (cdr letters) (cdr objects)
                   (cons (list (first run) (second run) (third run) (+ 1 (fourth run))) (cdr all)))))
          (else
           (loop (cdr letters) (cdr objects)
                 (cons (list (abs (car letters)) (car objects)
                             (if (positive? (car letters)) 1 -1) 1)
                       all))))))

(define (run->string run)
  (string-append "round " (if (second run) (symbol->string (second run)) "something")
                 " " (times (fourth run))
                 (if (negative? (third run)) " the other way" "")))

(define most-told 4)

(define (class->string c)
  (let* ((all (runs (class-letters c) (class-objects c)))
         (told (if (> (length all) most-told) (take all most-told) all))
         (more (- (length all) (length told))))
    (cond ((class-stamp c) "cannot be followed")
          ((null? all) "as the free way")
          (else
           (string-append (string-join (map run->string told) ", then ")
                          (if (zero? more) "" (string-append ", and " (number->string more) " more")))))))

(set-record-type-printer!
 <class>
 (lambda (c port)
   (simple-format port "#<class: ~a; ~a>" (class->string c)
                  (if (%decided? c) "decided" "not decided"))))

(define-argument-type (homotopy-class value)
  "what `homotopy-class' returned"
  (if (class? value) value refused))

(define-verb (homotopy-class #:subject (t tether))
  "Return the homotopy class of the tether, a value: two tethers with the same ends have `equal?' classes
when they can be moved into each other.  It prints what must be undone to come back to the free way.  A
class is not decided where the group of the scene was not shown free: then equal classes still mean so,
unequal ones need not.  A level bed or a ball in open water holds no line: the class is that of the free
way."
  (let* ((engine (this-engine 'homotopy-class))
         (v (%class engine t))
         (lost? (vector-ref v 4))
         (c (make-class (vector-ref v 0) (vector-ref v 1) (vector-ref v 2)
                        (and (vector-ref v 3) (not lost?))
                        (and lost? (%hash-dive engine)))))
    (with-words 'homotopy-class c
                (lambda () (class-said (class-objects c) lost? (%decided? c))))))

(define-verb (homotopy-class? (object any))
  "Return #t if OBJECT is a homotopy class."
  (class? object))

(define-verb (class-decided? (c homotopy-class))
  "Return #t if the class C is decided: what is unequal to it cannot be moved into it."
  (%decided? c))

(define-verb (class-free? (c homotopy-class))
  "Return #t if C is the class of the free way: nothing needs to be unwound."
  (and (null? (class-letters c)) (not (class-stamp c))))

(define-verb (knotted? #:subject (t tether))
  "Return #t if the line itself has a knot, told by its Alexander polynomial; the smallest knots that does
not tell have 11 crossings."
  (%knotted? (this-engine 'knotted?) t))


;;; Fouled.

(define-verb (foul-reason #:subject (t tether))
  "Return why the tether is fouled: `wound' when nothing but the vehicle going back round frees it, `hung'
when it may slip off or be lifted off; #f when it is not fouled."
  (%fouled (this-engine 'foul-reason) t))

(define-verb (fouled? #:subject (t tether))
  "Return #t if the tether, drawn tight, is longer than the free way by more than 1 m and more than 5 %."
  (and (%fouled (this-engine 'fouled?) t) #t))


;;; Hauling.

(define-verb (haul-trial #:subject (t tether) #:key (rate positive 0.4) (pull positive 150.0)
                         (at-most positive 600.0))
  "Haul the tether in on a fork, its vehicle dead, at RATE m/s with no more than PULL newtons, for AT-MOST
seconds.  Return an alist: home?, seconds, left (m still out), object and hull? (what holds it, and whether
by the vehicle's hull), at (where the vehicle came to), parted? (whether the tether broke), pull (N at the winch
in the end: where it stalled, what the line held against it)."
  (let ((v (%haul (this-engine 'haul-trial) t rate pull at-most)))
    (map cons '(home? seconds left object hull? at parted? pull) (vector->list v))))

(define-verb (free-to-haul? #:subject (t tether) #:key (rate positive 0.4) (pull positive 150.0))
  "Return #t if the dead vehicle comes home when the tether is hauled at RATE m/s with no more than PULL
newtons: a fork of the dive hauls it.  `haul-trial' of the same haul says why not: what held it, where, or that
the tether parted.  `haul-prospect' answers at once, by rules; where the two differ the haul is right, for it knows
slack, current, the bed, and a body that rolls off."
  (let ((v (%haul (this-engine 'free-to-haul?) t rate pull 600.0)))
    (with-words 'free-to-haul? (vector-ref v 0)
                (lambda ()
                  (apply (lambda (home? seconds left object hull? at parted? pull)
                           (haul-said home? seconds left object hull? parted? pull))
                         (vector->list v))))))

(define-argument-type (share value)
  "a share above 0 and at most 1"
  (if (and (real? value) (< 0 value) (<= value 1)) (exact->inexact value) refused))

(define-verb (haul-prospect #:subject (t tether) #:key (pull positive 150.0) (grip share 0.75))
  "Return at once what hauling the tether with PULL newtons promises, by rules about the taut string: a list
(ANSWER REASON OBJECT); ANSWER yes, no or unsure (the rules then name what may hold it, and `free-to-haul?' or
`haul-trial' decides), REASON clear, locked (by friction, or by the vehicle's own
weight or buoyancy), hung (the vehicle's body on it) or wedged, OBJECT a name or #f.  Friction says no only where
GRIP of the angle by which the string bends would hold too: a line that is hauled unwinds from its end on.  The
0.75 is not derived: twice round a pile no haul that was tried came home where it says no."
  (let ((v (%haul-prospect (this-engine 'haul-prospect) t pull grip)))
    (let ((answer (vector-ref v 0)) (reason (vector-ref v 1)) (object (vector-ref v 2)))
      (with-words 'haul-prospect (list answer reason object)
                  (lambda () (prospect-said answer reason object pull))))))


;;; Ways.

(define (why-not v)
  ;; Why the route V is not feasible, a sentence, or #f.
  (let ((clearance (vector-ref v 4)) (object (vector-ref v 5)))
    (cond ((vector-ref v 2) #f)
          ((zero? (vector-ref v 3)) "no way was found")
          (object (simple-format #f "it comes within ~a of ~a, or the tether does not allow it"
                                 (metres (max 0 clearance)) (objects-said (list object))))
          (else "the tether does not allow it"))))

(define (preview v)
  (list (cons 'needed? (vector-ref v 1))
        (cons 'feasible? (vector-ref v 2))
        (cons 'why-not (why-not v))
        (cons 'length (vector-ref v 3))
        (cons 'clearance (vector-ref v 4))
        (cons 'nearest (vector-ref v 5))
        (cons 'longest (vector-ref v 6))
        (cons 'left (vector-ref v 7))))

(define corner-within 0.3)              ; m: what a way is told to

(define (marked-corners engine t points)
  ;; The corners of the way along POINTS but for its ends, each with what is nearest: (POINT OBJECT NEAREST).
  (let ((corners (corners-of points corner-within)))
    (filter-map (lambda (p)
                  (let ((near (%point-clearance engine t p)))
                    (and near (list p (second near) (fourth near)))))
                (if (> (length corners) 2) (drop-right (cdr corners) 1) '()))))

(define (points-of way)
  (map list->f64vector (array->list way)))

(define (with-way-home engine t v)
  ;; What V, of `%way-home', says of the water and of what is passed is of now.
  (let* ((points (points-of (vector-ref v 0)))
         (corners (marked-corners engine t points))
         (to (last points))
         (from (if (null? corners) (first points) (first (last corners))))
         (current (%current-at engine (vec* 0.5 (vec+ from to))))
         (spare (- (vector-ref v 3) (assq-ref (%tether engine t) 'length)))
         (why (why-not v)))
    (with-words 'way-home (vector-ref v 0)
                (lambda () (way-said corners from to current spare why)))))

(define-verb (way-home #:subject (t tether))
  "Return the way that retraces the tether, drawn tight, from the vehicle to the anchor: a polyline that
`fly-along!' can fly.  The prompt says it in words: what is passed on which side, and the last leg.  A slack line
may hook where its string does not: `fly-home!' tries before it flies."
  (let ((engine (this-engine 'way-home)))
    (with-way-home engine t (%way-home engine t))))

(define-verb (way-home-preview #:subject (t tether))
  "Return what is known of the way home before it is flown, an alist: feasible?, why-not, length, clearance,
nearest."
  (preview (%way-home (this-engine 'way-home-preview) t)))

(define (with-loop engine t v)
  (let ((corners (marked-corners engine t (points-of (vector-ref v 0))))
        (spare (- (vector-ref v 6) (assq-ref (%tether engine t) 'length)))
        (why (why-not v)))
    (with-words 'unwind-plan (vector-ref v 0)
                (lambda () (unwind-said-plainly corners (vector-ref v 3) spare why)))))

(define-verb (unwind-plan #:subject (t tether))
  "Return the loop that the vehicle must fly to free its tether, a polyline back to where it is, or #f when
nothing needs to be unwound.  The prompt says it in words.  `unwind-preview' says whether it can be flown."
  (let* ((engine (this-engine 'unwind-plan)) (v (%unwind-plan engine t)))
    (if (vector-ref v 0)
        (with-loop engine t v)
        (with-words 'unwind-plan #f (const "Nothing needs to be unwound.")))))

(define (unwind-said t)
  "Return what the string says of the unwinding loop of tether number T, an alist, see `unwind-preview'."
  (preview (%unwind-plan (this-engine 'unwind-preview) t)))


;;; How far the tether reaches.

(define (rounded-by engine t points)
  ;; The names of what the string along POINTS goes round.
  (delete-duplicates (map second (marked-corners engine t points))))

(define-verb (slack-to-reach #:subject (t tether) (p point))
  "Return what a straight flight to the point P takes of the tether by the way it would then lie, drawn tight
round what it lies against: an alist with free? (whether nothing is in the way), needed (m of tether), out (m now),
more (m to be paid out, 0 or more), enough? (whether the drum has them), round (names) and blocked (the name of what
is in the way, or #f).  The prompt says it in words.  A current that bows the line takes more."
  (refuse-parted 'slack-to-reach t)
  (let* ((engine (this-engine 'slack-to-reach))
         (found (%taut-to engine t p))
         (out (assq-ref (%tether engine t) 'length))
         (drum (let ((most (assq-ref (tether-properties t) 'drum))) (if (real? most) most +inf.0)))
         (needed (and (pair? found) (car found)))
         (objects (if needed (rounded-by engine t (points-of (cdr found))) '()))
         (blocked (and (not needed) found)))
    (with-words 'slack-to-reach
                `((free? . ,(and needed #t)) (needed . ,needed) (out . ,out)
                  (more . ,(and needed (max 0.0 (- needed out))))
                  (enough? . ,(and needed (<= needed drum)))
                  (round . ,objects) (blocked . ,blocked))
                (lambda () (reach-said p needed out drum objects blocked)))))

(define-verb (follow-string #:subject (t tether))
  "Return the length of the taut string as it is led along from one call to the next, m: for a live view,
which asks in every frame.  It depends on the calls before; `taut-length' does not."
  (car (%follow-string (this-engine 'follow-string) t)))
