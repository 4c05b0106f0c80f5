;;; (bight dive probe) --- what one asks a trainee, the true answer, and how far off an answer is.
;;;
;;; Three levels, after Endsley: what is there, what it means, what will happen.  The truth comes of the
;;; state.  A probe is to be put only where the truth is stable: the same half a second and a second
;;; later, and with the vehicle moved by 0.3 m to any side, so that no answer is right or wrong by chance.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive probe)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive aware)
  #:use-module (bight dive foresight)
  #:use-module (bight dive query)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (awareness-probes probe-question probe-level probe-truth probe-stable? probe-error
            probe-score))

(define-record <kind>
  (make-kind name level question truth scale within)
  kind?
  (name kind-name)
  (level kind-level)                    ; 1 to 3
  (question kind-question)
  (truth kind-truth)                    ; a procedure of no arguments
  (scale kind-scale)                    ; bearing, ratio, number, choice
  (within kind-within))                 ; an error that still passes


;;; The truths.

(define (bearing-at s)
  (bearing-to (point-at (max 0.0 (min s (tether-length))))))

(define (object-names)
  (%names (this-engine 'probe-truth) 'obstacle))

(define (most-wound)
  ;; The object with the largest turn about it, and the turn; or #f.
  (fold (lambda (name best)
          (let ((n (false-if-exception (turns name))))
            (if (and n (or (not best) (> (abs n) (abs (cdr best))))) (cons name n) best)))
        #f (object-names)))

(define plain-turn (/ 20 360))          ; less goes by neither side

(define (side-of-most-wound)
  (let ((best (most-wound)))
    (cond ((or (not best) (< (abs (cdr best)) plain-turn)) 'neither)
          ((positive? (cdr best)) 'clockwise)
          (else 'anticlockwise))))

(define (first-of kind)
  ;; What the string does first within a minute: a foresight of KIND, or #f.
  (find (lambda (f) (eq? kind (foresight-kind f))) (foresee 60 #:quick #t)))

(define (first-touch)
  (or (and=> (first-of 'touch) foresight-object) 'nothing))

(define (seconds-to-taut)
  (and=> (first-of 'taut) foresight-seconds))

(define (yes-no x)
  (if x 'yes 'no))

(define kinds
  (list
   (make-kind 'tether-at-vehicle 1 "Point at your tether where it leaves you."
              (lambda () (bearing-at (- (tether-length) 2))) 'bearing 25)
   (make-kind 'tether-middle 1 "Point at the middle of your tether."
              (lambda () (bearing-at (/ (tether-length) 2))) 'bearing 25)
   (make-kind 'anchor 1 "Point at the anchor of your tether."
              (lambda () (bearing-at 0)) 'bearing 25)
   (make-kind 'metres-out 1 "How many metres of tether are out?" (lambda () (tether-length)) 'ratio 0.15)
   (make-kind 'turns-on-you 2 "How many turns have you made, clockwise positive?"
              (lambda () (net-turns)) 'number 0.25)
   (make-kind 'turns-on-it 2 "How many turns has your tether about what it goes round most?"
              (lambda () (let ((best (most-wound))) (if best (cdr best) 0.0))) 'number 0.25)
   (make-kind 'which-way-round 2 "Which way does it go round that: clockwise, anticlockwise, neither?"
              side-of-most-wound 'choice 0)
   (make-kind 'fouled 2 "Is your tether fouled: yes or no?" (lambda () (yes-no (fouled?))) 'choice 0)
   (make-kind 'free-to-haul 2 "Dead in the water: could you be hauled home, yes or no?"
              (lambda () (yes-no (free-to-haul?))) 'choice 0)
   (make-kind 'first-touch 3 "What does your tether touch next if you carry on?" first-touch 'choice 0)
   (make-kind 'seconds-to-taut 3 "In how many seconds is your tether taut if you carry on?"
              seconds-to-taut 'ratio (log 2))))

(define-argument-type (probe value)
  "the name of a probe, one of those of `awareness-probes'"
  (if (kind? value)                     ; already found
      value
      (or (find (lambda (kind) (eq? (kind-name kind) value)) kinds) refused)))


;;; Asking.

(define-verb (awareness-probes)
  "Return the names of the probes."
  (map kind-name kinds))

(define-verb (probe-question (name probe))
  "Return the question of the probe NAME."
  (kind-question name))

(define-verb (probe-level (name probe))
  "Return the level of the probe NAME: 1 what is there, 2 what it means, 3 what will happen."
  (kind-level name))

(define (truth-of kind)
  ;; The true answer, or #f where there is none.
  (with-exception-handler
   (lambda (e) (if (bight-error? e) #f (raise-exception e)))
   (lambda () ((kind-truth kind)))
   #:unwind? #t))

(define-verb (probe-truth (name probe))
  "Return the true answer to the probe NAME in the present dive: degrees, a number or a symbol; #f where the
question has none."
  (truth-of name))

(define turn 360)

(define (off-bearing a b)
  (let ((d (modulo* (- a b) turn)))
    (if (> d 180) (- d turn) d)))

(define (modulo* x n)
  (- x (* n (floor (/ x n)))))

(define (error-of kind answer truth)
  (case (kind-scale kind)
    ((bearing) (off-bearing answer truth))
    ((ratio) (if (and (positive? answer) (positive? truth)) (log (/ answer truth)) +inf.0))
    ((number) (- answer truth))
    (else (if (eqv? answer truth) 0 1))))

(define (agree? kind a b)
  (if (and a b) (<= (abs (error-of kind a b)) (* 1/2 (kind-within kind))) (eqv? a b)))

(define-argument-type (answer value)
  "a number or a symbol"
  (if (or (symbol? value) (real? value)) value refused))

(define-verb (probe-error (name probe) (given answer) (truth answer))
  "Return how far the answer GIVEN to the probe NAME is off the TRUTH: signed degrees, the logarithm of the
ratio, the difference, or 0 and 1 for right and wrong."
  (unless (eq? (symbol? given) (eq? 'choice (kind-scale name)))
    (bight-raise 'domain 'probe-error "the probe `~a' takes ~a, not ~s" (kind-name name)
                 (if (symbol? given) "a number" "a symbol") given))
  (error-of name given truth))

(define-verb (probe-score (name probe) (given answer) (truth answer))
  "Return the credit for the answer GIVEN to the probe NAME, 0 to 1: for a bearing 1 less the error over 90
degrees; for a number 1 within what passes, else 0; for a choice 1 when right."
  (let ((e (abs (probe-error name given truth))))
    (case (kind-scale name)
      ((bearing) (max 0 (- 1 (/ e 90))))
      (else (if (<= e (kind-within name)) 1 0)))))


;;; Is the truth stable?

(define shift 0.3)                      ; m
(define shifts
  (map (lambda (v) (apply f64vector (map (lambda (x) (* shift x)) v)))
       '((1 0 0) (-1 0 0) (0 1 0) (0 -1 0) (0 0 1) (0 0 -1))))

(define half-a-second 30)               ; steps

(define (on-fork change kind)
  ;; The truth on a fork on which CHANGE, a procedure of its engine, was made; #f if it cannot be.
  (let ((fork (fork-dive (this-dive 'probe-stable?))))
    (parameterize ((current-dive fork))
      (and (false-if-exception (begin (change (engine-of fork)) #t))
           (truth-of kind)))))

(define (moved by)
  (lambda (engine)
    (let ((p (assq-ref (%vehicle engine 0) 'position)))
      (%operate! engine 'place! 'place! 0 (vec+ p by)))))

(define (later n)
  (lambda (engine) (%step-dive! engine n)))

(define-verb (probe-stable? (name probe))
  "Return #t if the probe NAME has a true answer in the present dive that would be the same half a second and
a second later and with the vehicle moved by 0.3 m: only then is it fair to ask."
  (let ((truth (truth-of name)))
    (and truth
         (every (lambda (change) (agree? name truth (on-fork change name)))
                (append (map later (list half-a-second (* 2 half-a-second)))
                        (map moved shifts))))))
