;;; (bight dive plain-words) --- what is known of a tether, said in sentences a pilot can fly by.
;;;
;;; A sentence is made of plain data that whoever asks the engine hands over; nothing here asks anything.
;;; Numbers are rounded to what can be flown, at most three figures; members of a structure are told under
;;; the structure.
;;;
;;; An answer keeps its words beside it: what `way-home' returns is a polyline, to which a sentence belongs.
;;; They are made at the first look, of what was known when the question was put.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive plain-words)
  #:use-module (bight core units)
  #:use-module (srfi srfi-1)
  #:export (with-words words-of words-of-answer
            figure-said metres seconds-said percent-said structure-of own-name objects-said
            heading-said sentence
            corners-of
            class-said windings-said prospect-said haul-said way-said unwind-said-plainly reach-said
            foresight-said foresights-said))


;;; Answers and their words.

(define words (make-object-property))

;; What cannot carry a property, #t, #f or (), carries its words only until the next such answer:
;; (QUESTION ANSWER . THUNK).
(define last-answer #f)

(define (immediate? value)
  (or (boolean? value) (null? value)))

(define (with-words question value thunk)
  "Return VALUE, the answer to QUESTION, a symbol, which THUNK says in words."
  (let ((once (let ((text #f)) (lambda () (unless text (set! text (thunk))) text))))
    (if (immediate? value)
        (set! last-answer (cons* question value once))
        (set! (words value) once))
    value))

(define (carried value)
  (and (not (immediate? value)) (not (number? value)) (not (symbol? value)) (words value)))

(define (words-of value)
  "Return the sentences of VALUE, a string, or #f if it has none: those that it carries, or those of the last answer
that was just #t, #f or ()."
  (cond ((carried value) => (lambda (thunk) (thunk)))
        ((and last-answer (immediate? value) (eq? value (cadr last-answer))) ((cddr last-answer)))
        (else #f)))

(define (words-of-answer question value)
  "Return the sentences of VALUE, the answer to QUESTION; #f if it carries none and no such question was asked last."
  (and (or (carried value) (and last-answer (eq? question (car last-answer))))
       (words-of value)))


;;; Figures.

(define (figure-said x)
  "Return the number X, a string of at most three figures, whole from ten on."
  (let ((size (abs x)))
    (cond ((or (nan? size) (inf? size)) "no end of")
          ((>= size 1000)
           (let ((unit (expt 10 (- (string-length (number->string (inexact->exact (round size)))) 3))))
             (number->string (* unit (inexact->exact (round (/ x unit)))))))
          ((>= size 9.95) (number->string (inexact->exact (round x))))
          (else
           (let ((tenths (inexact->exact (round (* 10 x)))))
             (if (zero? (remainder tenths 10))
                 (number->string (quotient tenths 10))
                 (string-append (if (negative? tenths) "-" "")
                                (number->string (quotient (abs tenths) 10)) "."
                                (number->string (remainder (abs tenths) 10)))))))))

(define (metres x) (string-append (figure-said x) " m"))
(define (percent-said p)
  "Return the probability P in words."
  (simple-format #f "~a %" (inexact->exact (round (* 100 p)))))

(define (seconds-said x) (string-append (figure-said x) " s"))

(define (up-to x)
  ;; X metres, rounded up: what is to be paid out must be enough.
  (metres (if (< x 9) (/ (ceiling (* 10 x)) 10) (ceiling x))))

(define points '("north" "north-east" "east" "south-east" "south" "south-west" "west" "north-west"))

(define (compass-said dx dy)
  (list-ref points (modulo (inexact->exact (round (/ (* 180 (/ (atan dx dy) (acos -1))) 45))) 8)))

(define (heading-said from to)
  "Return the way from the point FROM to the point TO in a word: north, ..., up or down."
  (let* ((way (vec- to from)) (level (sqrt (+ (* (x way) (x way)) (* (y way) (y way))))))
    (cond ((> (abs (z way)) (* 1.5 level)) (if (positive? (z way)) "up" "down"))
          (else (compass-said (x way) (y way))))))

(define (sentence text)
  "Return TEXT with a capital and a full stop."
  (string-append (string-upcase (substring text 0 1)) (substring text 1)
                 (if (memv (string-ref text (- (string-length text) 1)) '(#\. #\? #\!)) "" ".")))


;;; Names.

(define (structure-of name)
  "Return the structure that the obstacle NAME is a member of, `tower' of tower/leg-1; or #f."
  (let* ((text (symbol->string name)) (slash (string-index text #\/)))
    (and slash (string->symbol (substring text 0 slash)))))

(define (own-name name)
  "Return what the obstacle NAME is called within its structure, a string: leg-1 of tower/leg-1."
  (let* ((text (symbol->string name)) (slash (string-index text #\/)))
    (if slash (substring text (+ slash 1)) text)))

(define (listed texts)
  ;; "a", "a and b", "a, b and c"
  (cond ((null? texts) "nothing")
        ((null? (cdr texts)) (car texts))
        (else (string-append (string-join (drop-right texts 1) ", ") " and " (last texts)))))

(define most-members 3)

(define (members-said structure names)
  (let ((more (- (length names) most-members)))
    (string-append
     (if (positive? more)
         (string-append (string-join (map own-name (take names most-members)) ", ")
                        " and " (number->string more) " more parts")
         (listed (map own-name names)))
     " of " (symbol->string structure))))

(define (by-structure names)
  ;; ((STRUCTURE NAME ...) ...), what is no member alone under #f, in order of the first of each.
  (let loop ((left names) (groups '()))
    (if (null? left)
        (reverse! groups)
        (let ((structure (structure-of (car left))))
          (if structure
              (call-with-values (lambda () (partition (lambda (n) (eq? structure (structure-of n))) left))
                (lambda (members others) (loop others (cons (cons structure members) groups))))
              (loop (cdr left) (cons (list #f (car left)) groups)))))))

(define (objects-said names)
  "Return the NAMES of obstacles as a text, those of one structure under it: leg-1 and leg-2 of tower."
  (listed (map (lambda (group)
                 (if (car group) (members-said (car group) (cdr group)) (symbol->string (cadr group))))
               (by-structure (delete-duplicates (filter identity names))))))

(define (object-said name)
  (if name (objects-said (list name)) "something"))


;;; Classes and windings.

(define (times n)
  (case n ((1) "once") ((2) "twice") (else (string-append (number->string n) " times"))))

(define (class-said objects lost? decided?)
  "Return what a class means whose letters go round OBJECTS, names or #f; it is LOST? where the line cannot be
followed, and DECIDED? if what differs from it is another class for sure."
  (cond (lost? "The tether squeezes through where it cannot be followed: how it lies is not known.")
        ((null? objects) "The tether lies as the free way: nothing needs to be unwound.")
        (else
         (string-append "The tether does not lie as the free way: it goes round "
                        (if (any identity objects) (objects-said objects) "something")
                        (if decided? "." "; whether it can be drawn off is not decided.")))))

(define (turned-said run)
  ;; RUN is ((WAY . TIMES) NAME ...).
  (let ((way (car (car run))) (n (cdr (car run))))
    (string-append way (if (= n 1) "" (string-append " " (times n))) " round " (objects-said (cdr run)))))

(define (by-turn entries)
  ;; The names of ENTRIES by which way and how often: (((WAY . TIMES) NAME ...) ...).
  (fold-right (lambda (entry runs)
                (let* ((key (cons (if (positive? (cdr entry)) "clockwise" "anticlockwise") (abs (cdr entry))))
                       (run (assoc key runs)))
                  (if run
                      (cons (cons* key (car entry) (cdr run)) (delq run runs))
                      (cons (list key (car entry)) runs))))
              '() entries))

(define (windings-said entries)
  "Return what ENTRIES, an alist from the names of obstacles to whole turns, mean."
  (if (null? entries)
      "The tether is caught on nothing."
      (string-append "The tether is caught " (string-join (map turned-said (by-turn entries)) ", and ") ".")))


;;; Hauling.

(define (reason-said reason object)
  (case reason
    ((locked) (string-append "friction round " (object-said object) " holds the line"))
    ((hung) (string-append "the vehicle hangs on " (object-said object)))
    ((wedged) (string-append "the vehicle does not fit through at " (object-said object)))
    (else "nothing holds it")))

(define (prospect-said answer reason object pull)
  "Return what hauling with PULL newtons promises: ANSWER yes, no or unsure, for REASON at OBJECT."
  (let ((why (if (and (eq? reason 'locked) (not object))
                 "its own weight or buoyancy holds the vehicle"
                 (reason-said reason object)))
        (with (string-append " hauled with " (figure-said pull) " N")))
    (case answer
      ((yes) (string-append "Yes: the vehicle comes home when" with "; " why "."))
      ((no) (string-append "No: the vehicle does not come home when" with "; " why "."))
      (else (string-append "Not sure:" with ", "
                           (if (eq? reason 'clear) "the line may hold where it bends" (string-append "it may be that " why))
                           "; free-to-haul? tries.")))))

(define (haul-said home? seconds left object hull? parted? pull)
  "Return what came of a haul on a fork: the arguments as `haul-trial' tells them."
  (cond (home? (string-append "Yes: hauled, the vehicle comes home in " (seconds-said seconds) "."))
        (parted? (string-append "No: the tether parts after " (seconds-said seconds) "."))
        (else
         (string-append "No: "
                        (cond ((not object) "the vehicle does not come home")
                              (hull? (string-append "the vehicle's body hangs on " (object-said object)))
                              (else (string-append "the line is held at " (object-said object))))
                        " with " (metres left) " still out, pulled with " (figure-said pull) " N."))))


;;; Ways.

(define (off-chord p a b)
  ;; The distance of the point P from the segment from A to B.
  (let* ((leg (vec- b a)) (to (vec- p a))
         (square (+ (* (x leg) (x leg)) (* (y leg) (y leg)) (* (z leg) (z leg))))
         (s (if (zero? square)
                0
                (max 0 (min 1 (/ (+ (* (x leg) (x to)) (* (y leg) (y to)) (* (z leg) (z to))) square))))))
    (distance p (vec+ a (vec* s leg)))))

(define (farthest way from to)
  ;; The index of what is farthest of the points of WAY, a vector, between two, and how far it is off.
  (let loop ((i (+ from 1)) (best #f) (off 0))
    (if (>= i to)
        (values best off)
        (let ((d (off-chord (vector-ref way i) (vector-ref way from) (vector-ref way to))))
          (if (> d off) (loop (+ i 1) i d) (loop (+ i 1) best off))))))

(define (corners-of way within)
  "Return the points of WAY, a list of points, that a line within WITHIN metres of it needs, its ends included."
  (let ((all (list->vector way)))
    (let between ((from 0) (to (- (vector-length all) 1)) (rest (list (last way))))
      (call-with-values (lambda () (farthest all from to))
        (lambda (i off)
          (if (and i (> off within))
              (between from i (between i to rest))
              (cons (vector-ref all from) rest)))))))

(define (side-said corner)
  ;; CORNER is (POINT OBJECT NEAREST): by which side of the object the way goes.
  (let ((way (vec- (first corner) (third corner))))
    (cond ((zero? (norm way)) "")
          (else
           (let ((word (heading-said (third corner) (first corner))))
             (cond ((string=? word "up") "over")
                   ((string=? word "down") "under")
                   (else (string-append word " round"))))))))

(define (passes corners)
  ;; What is passed along CORNERS, ((SIDES NAME ...) ...): one thing by several sides, or several of one structure
  ;; by the same.
  (define (same-side? run side name)
    (and (equal? (list side) (car run)) (eq? (structure-of name) (structure-of (cadr run)))))
  (define (same-thing? run name)
    (equal? (list name) (cdr run)))
  (fold-right (lambda (corner runs)
                (let ((side (side-said corner)) (name (second corner)) (run (and (pair? runs) (car runs))))
                  (cond ((and run (same-side? run side name))
                         (cons (cons (list side) (cons name (delq name (cdr run)))) (cdr runs)))
                        ((and run (same-thing? run name))
                         (cons (cons (cons side (delete side (car run))) (cdr run)) (cdr runs)))
                        (else (cons (list (list side) name) runs)))))
              '() corners))

(define (sides-said sides)
  ;; "north and east round", "over", "over, east round"
  (let ((round (map (lambda (s) (substring s 0 (- (string-length s) 6)))
                    (filter (lambda (s) (string-suffix? " round" s)) sides)))
        (others (filter (lambda (s) (not (or (string-null? s) (string-suffix? " round" s)))) sides)))
    (string-join (append others (if (null? round) '() (list (string-append (listed round) " round"))))
                 " and ")))

(define (pass-said run)
  (let ((sides (sides-said (car run))))
    (string-append (if (string-null? sides) "past" sides) " " (objects-said (cdr run)))))

(define most-passes 4)

(define (passes-said corners)
  ;; The texts of the first passes along CORNERS.
  (let* ((all (passes corners)) (more (- (length all) most-passes)))
    (append (map pass-said (if (positive? more) (take all most-passes) all))
            (if (positive? more) (list (string-append "round " (number->string more) " more")) '()))))

(define still 0.03)                     ; m/s: a current that nobody feels

(define (against-current from to current)
  ;; How the leg lies in CURRENT, a vector, a text to put behind it.
  (let* ((way (vec- to from)) (along (* (norm way) (norm current)))
         (share (if (zero? along)
                    0
                    (/ (+ (* (x way) (x current)) (* (y way) (y current)) (* (z way) (z current))) along))))
    (cond ((< (norm current) still) "")
          ((> share 0.7) ", down-current")
          ((< share -0.7) ", up-current")
          (else ", across the current"))))

(define (leg-said from to current)
  (if (< (distance from to) 0.05)
      "you are there"
      (string-append "straight " (heading-said from to) " " (metres (distance from to))
                     (against-current from to current))))

(define (warned why-not)
  (if why-not (string-append "; but " why-not) ""))

(define (paid-out spare)
  (if (> spare 0.05) (string-append "; pay out " (up-to spare) " first") ""))

(define (way-said corners from to current spare why-not)
  "Return the way home in words: past CORNERS, lists (POINT OBJECT NEAREST), the last leg FROM a point TO the
anchor in CURRENT.  SPARE is how much longer the way is than what is out, m; WHY-NOT says why it cannot be flown,
or #f."
  (string-append "Home: "
                 (string-join (append (passes-said corners) (list (leg-said from to current))) ", then ")
                 (paid-out spare) (warned why-not) "."))

(define (unwind-said-plainly corners length spare why-not)
  "Return the loop that frees the tether in words, as `way-said'; LENGTH is its own."
  (string-append "To unwind: "
                 (string-join (append (passes-said corners) (list "back to where you are")) ", then ")
                 ", " (metres length) " in all"
                 (paid-out spare) (warned why-not) "."))

(define (place-said p)
  (string-append "(" (string-join (map figure-said (list (x p) (y p) (z p))) " ") ")"))

(define (reach-said p needed out drum objects blocked)
  "Return what a flight to the point P takes: NEEDED metres of tether round OBJECTS, names, with OUT metres out of
the DRUM's, infinite if it has no end; or BLOCKED, the name of what is in the way."
  (if (not needed)
      (string-append "The straight way to " (place-said p) " is not free: " (object-said blocked)
                     " is in it.")
      (let ((more (- needed out)))
        (string-append "A flight to " (place-said p) " takes " (metres needed) " of tether"
                       (if (null? objects) "" (string-append ", round " (objects-said objects)))
                       (cond ((<= more 0) (string-append ": " (metres out) " are out, enough"))
                             ((<= needed drum)
                              (string-append ": pay out " (up-to more) " more"
                                             (if (inf? drum) "" (string-append "; the drum has "
                                                                               (metres (- drum out)) " left"))))
                             (else (string-append ": the drum is short by " (up-to (- needed drum)))))
                       "."))))


;;; What is to come.

(define (happening kind object turns)
  (case kind
    ((touch) (string-append "the tether touches " (object-said object)))
    ((turn) (string-append "the tether is " (figure-said (abs (or turns 0))) " turns about "
                           (object-said object)))
    ((taut) "the tether is taut")
    ((bump) (string-append "the vehicle meets " (object-said object)))
    ((stuck) (string-append "the vehicle is stuck" (if object (string-append " at " (object-said object)) "")))
    ((snapped) "the tether snaps taut")
    (else (string-append "the tether is " (symbol->string kind)))))

(define (foresight-said kind object seconds turns sure?)
  "Return what will happen, a text without a full stop."
  (string-append "in " (seconds-said seconds) " " (happening kind object turns)
                 (if sure? "" ", perhaps")))

(define most-foreseen 4)

(define (foresights-said texts seconds)
  "Return the TEXTS of `foresight-said' for the next SECONDS as a sentence."
  (let ((more (- (length texts) most-foreseen)))
    (if (null? texts)
        (string-append "As the sticks are, nothing happens to the tether within " (seconds-said seconds) ".")
        (sentence (string-append (string-join (if (positive? more) (take texts most-foreseen) texts) "; ")
                                 (if (positive? more)
                                     (string-append "; and " (number->string more) " things more")
                                     ""))))))
