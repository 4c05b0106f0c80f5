;;; Answers in plain words: a sentence for each, with names that exist, figures that mean something, and what the
;;; answer holds.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight dive) #:select (this-engine))
             ((bight engine) #:select (%names))
             ((bight view looks) #:select (value->lines with-sentences))
             ((bight dive plain-words) #:select (figure-said corners-of own-name objects-said))
             (ice-9 regex)
             ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?)))
             (srfi srfi-4))


;;; What any sentence must be.

(define questions '(way-home unwind-plan haul-prospect homotopy-class windings))

(define (words-in text)
  (map (lambda (word) (string-trim-both word (string->char-set ",.;:()")))
       (string-tokenize text)))

(define hyphened
  '("north-east" "south-east" "south-west" "north-west" "up-current" "down-current" "free-to-haul?"))

(define (name-like? word)
  ;; Names of these worlds have a digit, a hyphen or a slash in them; nothing else said has.
  (and (string-index word char-set:letter)
       (string-index word (string->char-set "-/0123456789"))
       (not (member word hyphened))))

(define (names-here)
  (append-map (lambda (kind) (map symbol->string (%names (this-engine 'test) kind))) '(obstacle rov tether)))

(define (known-name? word)
  (let ((names (names-here)))
    (or (member word names)
        (member word (map (lambda (name) (own-name (string->symbol name))) names))
        (any (lambda (name) (string-prefix? (string-append word "/") name)) names))))

(define (figures-of number)
  ;; The significant digits of NUMBER, a text.
  (string-length (string-trim-both (string-delete #\. (string-trim number (string->char-set "-0.")))
                                   #\0)))

(define (numbers-in text)
  (filter string->number (words-in text)))

(define (well-said? text)
  (and (string? text)
       (not (char-lower-case? (string-ref text 0)))
       (string-suffix? "." text)
       (not (string-contains text "#"))
       (not (string-contains text "  "))
       (all? (lambda (number) (<= (figures-of number) 3)) (numbers-in text))
       (all? known-name? (filter name-like? (words-in text)))))

(define (tethers) (%names (this-engine 'test) 'tether))

(define (outcome thunk)
  ;; What THUNK returns, or the error that a question may raise, such as one about a vehicle that is not there.
  (with-exception-handler (lambda (e) (if (bight-error? e) e (raise-exception e))) thunk #:unwind? #t))

(define-property every-answer-has-its-sentence
  "Whatever the world and the flight: each answer is said, in names that exist and figures of three digits at most."
  #:for ((scene (random-world))
         (pilot (random-pilot #:seconds 4 #:does '(drive fly fly pay-out haul-in current))))
  #:cases 10
  (in scene)
  (pilot)
  (for-each
   (lambda (tether)
     (for-each
      (lambda (question)
        (let ((text (outcome (lambda () (in-words tether question)))))
          (unless (bight-error? text)
            (require text is well-said?))))
      questions)
     (require (in-words (foresee tether 20 #:quick #t)) is well-said?)
     (let ((text (outcome (lambda ()
                            (in-words (slack-to-reach tether (vec (- (random 16.0) 6) (- (random 16.0) 8)
                                                                  (- -1 (random 9.0)))))))))
       (unless (bight-error? text)
         (require text is well-said?))))
   (tethers)))

(define-scenario figures-have-three-digits
  "Of whatever size, and near what they stand for."
  (do ((i 0 (+ i 1)))
      ((= i 500))
    (let* ((x (* (if (odd? i) -1 1) (expt 10. (- (random 8.0) 2)))) (text (figure-said x)))
      (require (figures-of text) is (between 0 3))
      (require (abs (- (string->number text) x)) is (below (max 0.0501 (* 0.051 (abs x)))))))
  (expect (map figure-said '(12.34 9.96 9.94 0.04 -0.26 1234.5 0 100)) => '("12" "10" "9.9" "0" "-0.3" "1230" "0" "100")))


;;; What they say.

(define (pile-world . more)
  (world (sea (depth 30) (current 0.3 180))
         (cylinder (named p1) (from 0 0 1) (to 0 0 -30) (radius 0.4) (friction 0.3))
         (splice more)
         (rov (named minnow) (at 6 -6 -5) (type kinematic))
         (tether (named line) (wet-weight 0) (from -6 -6 -5) (to minnow) (length 30) (drum 60)
                 (model dynamic))))

(define (fly . points)
  (for-each (lambda (p) (move! p #:speed 2) (run-until arrived? #:at-most 60)) points)
  (run 1))

(define-scenario the-way-home-says-the-side
  "What is passed is told with its side, and the last leg with its length and the current."
  (in (pile-world))
  (expect (in-words (way-home)) => "Home: straight west 12 m, across the current.")
  (expect (in-words 'homotopy-class) => "The tether lies as the free way: nothing needs to be unwound.")
  (fly '(3 6 -5) '(-3 6 -5) '(-6 0 -5))
  (expect (in-words (homotopy-class))
          => "The tether does not lie as the free way: it goes round p1.")
  (expect (in-words (windings)) => "The tether is caught anticlockwise round p1.")
  (expect (in-words (way-home)) is (lambda (text) (string-match "^Home: .*east round p1, .*then straight .* m" text)))
  (expect (in-words (unwind-plan)) is (lambda (text) (string-prefix? "To unwind: " text))))

(define-scenario members-are-their-structure-s
  "Members of a structure are told under it; of many a few and how many more there are."
  (in (pile-world))
  (expect (objects-said '(jacket/leg-a1 jacket/leg-a2)) => "leg-a1 and leg-a2 of jacket")
  (expect (objects-said '(p1 jacket/leg-a1 jacket/leg-a1 #f)) => "p1 and leg-a1 of jacket")
  (expect (objects-said '(j/b-1 j/b-2 j/b-3 j/b-4 j/b-5)) => "b-1, b-2, b-3 and 2 more parts of j"))

(define-scenario answers-stay-what-they-are
  "Words change no answer: lists, polylines and #t are taken apart as before, and an answer keeps the words of its time."
  (in (pile-world))
  (let ((way (way-home)))
    (expect (array-dimensions way) => '(2 3))
    (expect (value->lines way) => '("Home: straight west 12 m, across the current."))
    (expect (haul-prospect) => '(yes clear #f))
    (expect (windings) => '())
    (expect (unwind-plan) => #f)
    (expect (in-words (unwind-plan)) => "Nothing needs to be unwound.")
    (expect (value->lines #f) => '("#f"))
    (expect (eq? #t (free-to-haul?)))
    (expect (value->lines #t 'free-to-haul?) is (lambda (lines) (string-prefix? "#t: Yes: hauled" (car lines))))
    (expect (value->lines #t 'taut?) => '("#t"))
    (let ((lines (value->lines (slack-to-reach '(74.123 -6.4561 -5.55)))))
      (expect (string-join lines) => (in-words (slack-to-reach '(74.123 -6.4561 -5.55))))
      (expect (all? (lambda (line) (<= (string-length line) 78)) lines)))
    (fly '(6 0 -5))
    (expect (in-words way) => "Home: straight west 12 m, across the current.")
    (expect (in-words 'nonsense) raises name)
    (expect (in-words 7) raises domain)))


;;; How far the tether reaches.

(define (round-an-upright p q radius)
  ;; The way from P to Q round the far side of an upright of RADIUS at the origin: a helix and two tangents, unrolled.
  (let* ((d (lambda (a) (sqrt (+ (* (x a) (x a)) (* (y a) (y a))))))
         (tangent (lambda (a) (sqrt (- (* (d a) (d a)) (* radius radius)))))
         (between (- (* 2 (acos -1)) (acos (/ (+ (* (x p) (x q)) (* (y p) (y q))) (d p) (d q)))))
         (arc (- between (acos (/ radius (d p))) (acos (/ radius (d q))))))
    (sqrt (+ (expt (+ (tangent p) (tangent q) (* radius arc)) 2) (expt (- (z p) (z q)) 2)))))

(define-scenario a-flight-takes-the-way-round
  "Round a pile it is two tangents and an arc; flown, the string is as long; what is out is enough, or the drum's."
  (in (pile-world))
  (fly '(6 6 -5))
  (let* ((p (vec -5 2 -7)) (reach (slack-to-reach p)) (needed (assq-ref reach 'needed)))
    (expect (assq-ref reach 'free?))
    (expect needed is (about (round-an-upright (vec -6 -6 -5) p 0.402) #:within 0.15))
    (expect (assq-ref reach 'more) => 0.0)
    (fly p)
    (expect (taut-length) is (about needed #:within 0.1)))
  (expect (assq-ref (slack-to-reach (rov-position)) 'needed) is (about (taut-length) #:within 0.02)))

(define-scenario what-is-wanting-is-told
  "More than is out is to be paid out, as far as the drum has it; what is in the way is named."
  (in (pile-world))
  (let ((reach (slack-to-reach '(34 -6 -5))))
    (expect (assq-ref reach 'needed) is (about 40 #:within 0.01))
    (expect (assq-ref reach 'more) is (about 10 #:within 0.01))
    (expect (assq-ref reach 'enough?))
    (expect (in-words reach)
            => "A flight to (34 -6 -5) takes 40 m of tether: pay out 10 m more; the drum has 30 m left."))
  (let ((reach (slack-to-reach '(74 -6 -5))))
    (expect (assq-ref reach 'enough?) => #f)
    (expect (in-words reach) => "A flight to (74 -6 -5) takes 80 m of tether: the drum is short by 20 m."))
  (let ((reach (slack-to-reach '(-6 6 -5))))
    (expect (assq-ref reach 'free?) => #f)
    (expect (assq-ref reach 'blocked) => 'p1)
    (expect (in-words reach) => "The straight way to (-6 6 -5) is not free: p1 is in it."))
  (expect (slack-to-reach '(+nan.0 0 0)) raises domain))

(define-property no-flight-takes-less-than-the-way
  "A flight takes no less than the straight line from the anchor, and no more than the string and the flight together."
  #:for ((scene (random-world #:models '(dynamic)))
         (east (uniform -4 8)) (north (uniform -7 7)) (up (uniform -10 -2)))
  #:cases 10
  (in scene)
  (run 1)
  (for-each
   (lambda (tether)
     (let* ((p (vec east north up))
            (needed (assq-ref (slack-to-reach tether p) 'needed)))
       (when needed
         (expect needed is (between (- (distance (point-at tether 0) p) 0.02)
                                    (+ (taut-length tether) 0.02
                                       (distance p (point-at tether (tether-length tether)))))))))
   (tethers)))

(define-scenario sentences-go-on-below-their-column
  "A sentence beside a name that is too long for the terminal goes on below where it began."
  (let ((columns (getenv "COLUMNS")))
    (setenv "COLUMNS" "60")
    (let ((lines (value->lines (with-sentences '(pile wreck) (lambda (name) (if (eq? name 'pile) "One." (string-join (make-list 20 "water"))))))))
      (setenv "COLUMNS" columns)
      (expect (list-head lines 2) => (list "  pile   One." "  wreck  water water water water water water water water"))
      (expect (length lines) => 4)
      (expect (list-tail lines 3) => (list "         water water water water")))))
