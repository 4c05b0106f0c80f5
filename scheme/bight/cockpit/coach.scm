;;; (bight cockpit coach) --- a few words at the right moment.
;;;
;;; Each rule that pilots are taught is one rule here: a name, how urgent it is, when it applies, and what
;;; to say, milder words after a warning.  The coach speaks at most six times in fifteen minutes, never
;;; within ten seconds of itself, never twice by the same rule, and less to those who do well: for a pupil
;;; whose competence is known only what is urgent is said.  Time is the dive's.  Everything said is noted
;;; with its reason.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit coach)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive contact)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (srfi srfi-1)
  #:export (make-coach
            coach-rule?
            coach-looks!
            coach-log
            coach-rules
            define-coach-rule
            pushed-unseen?))

(define most-words 6)                   ; in so many seconds:
(define window 900)
(define silence 10)                     ; seconds between two utterances


;;; Rules.

(define-record <rule>
  (make-rule name urgency lasting applies? words)
  coach-rule?
  (name rule-name)                      ; a symbol
  (urgency rule-urgency)                ; 1 good to know, 2 a warning, 3 do something now
  (lasting rule-lasting)                ; seconds for which it must apply
  (applies? rule-applies?)
  (words rule-words))

(define rules '())                      ; in order of definition

(define (add-rule! rule)
  (set! rules (append (remove (lambda (r) (eq? (rule-name r) (rule-name rule))) rules)
                      (list rule))))

(define-syntax-rule (define-coach-rule name #:urgency urgency #:lasting seconds words applies?)
  "Let the coach say WORDS when the expression APPLIES? has been true for SECONDS; URGENCY is 1 to 3."
  (add-rule! (make-rule 'name urgency seconds (lambda () applies?) words)))

(define-verb (coach-rules)
  "Return the rules by which the coach speaks: lists of name, urgency and words."
  (map (lambda (r) (list (rule-name r) (rule-urgency r) (rule-words r))) rules))

(define pushed-unseen?
  ;; A thunk: does a vehicle push whose sticks nobody sees, as one that is followed?
  (make-parameter (const #f)))

(define (thrusting?)
  (or (> (norm-of (list-of-sticks)) 0.3) ((pushed-unseen?))))

(define (list-of-sticks)
  (let ((s (array->list (sticks)))) (list (first s) (second s) (third s))))

(define (norm-of xs) (sqrt (apply + (map (lambda (x) (* x x)) xs))))

(define (yawing?)
  (> (abs (fourth (array->list (sticks)))) 0.2))

(define (cross-flow)
  ;; The angle in degrees between where the vehicle heads and where the current comes from, or 180 in
  ;; still water.
  (let* ((c (array->list (current-at (rov-position))))
         (speed (norm-of (take c 2))))
    (if (< speed 0.05)
        180
        (let* ((from (* (/ 180 (acos -1)) (atan (- (first c)) (- (second c)))))
               (d (- (rov-heading) from)))
          (abs (- d (* 360 (round (/ d 360)))))))))

(define-coach-rule never-pull-on-a-snag #:urgency 3 #:lasting 2
  "Your tether is held by what it touches: do not pull. Give slack, and go back along it."
  (and (pair? (contacts)) (thrusting?) (or (stuck?) (and (taut?) (< (rov-speed) 0.1)))))

(define-coach-rule no-yaw-into-the-current-when-taut #:urgency 3 #:lasting 1
  "The tether is taut: back up for slack before you turn into the current."
  (and (taut?) (yawing?) (< (cross-flow) 120)))

(define-coach-rule end-of-the-tether #:urgency 2 #:lasting 3
  "You are at the end of your tether: it flies you now. Come back, or ask for more."
  (and (null? (contacts)) (taut?) (thrusting?)))

(define-coach-rule tension-too-high #:urgency 3 #:lasting 2
  "The tension is high. Ease off, and look where the tether is held."
  (> (max-tension) 150))

(define-coach-rule touching #:urgency 2 #:lasting 3
  "Your tether touches something. Note on which side you came, and go back the same way."
  (pair? (contacts)))

(define-coach-rule too-many-turns #:urgency 2 #:lasting 2
  "Your turns are more than one. Take them off before you go on."
  (> (abs (net-turns)) 1.05))

(define-coach-rule too-much-slack #:urgency 1 #:lasting 20
  "There is much loose tether behind you: it drifts, drags and snags. Have some taken in."
  (and (> (tether-length) 10) (> (slack) 0.45)))

(define-coach-rule too-little-slack #:urgency 1 #:lasting 8
  "The tether is nearly straight: ask for a little more before it stops you."
  (and (not (taut?)) (< (slack) 0.02) (thrusting?)))

(define-coach-rule shape-uncertain #:urgency 1 #:lasting 10
  "Where your tether lies is known less exactly than this world asks: keep farther off what it could touch."
  (not (accurate?)))

(define-coach-rule down-current-of-what-you-pass #:urgency 1 #:lasting 4
  "You are close. Come up to it from down-current, so that the water carries your tether clear."
  (< (rov-clearance) 0.5))


;;; One coach.

(define-record <coach>
  (%make-coach competence said since log)
  coach?
  (competence coach-competence)         ; 0 to 1: what the pupil has shown so far
  (said coach-said set-coach-said!)     ; names of the rules that have spoken
  (since coach-since set-coach-since!)  ; an alist: since when a rule applies
  (log %coach-log set-coach-log!))      ; (TIME RULE WORDS), the last first

(define-argument-type (share value)
  "a number from 0 to 1"
  (if (and (real? value) (<= 0 value 1)) value refused))

(define-argument-type (coach value)
  "a coach, as `make-coach' returns"
  (if (coach? value) value refused))

(define-verb (make-coach #:key (competence share 0))
  "Return a coach for a pupil of COMPETENCE: 0 for a beginner; from 0.5 on only warnings are spoken, from
0.8 on only what cannot wait."
  (%make-coach competence '() '() '()))

(define-verb (coach-log (c coach))
  "Return what the coach C has said, oldest first: lists of time, name of the rule and words."
  (reverse (%coach-log c)))

(define (least-urgency c)
  (let ((x (coach-competence c)))
    (cond ((>= x 0.8) 3) ((>= x 0.5) 2) (else 1))))

(define (applies-now? rule)
  ;; A rule that asks what this dive cannot tell does not apply.
  (with-exception-handler
      (lambda (e) (if (bight-error? e) #f (raise-exception e)))
    (rule-applies? rule)
    #:unwind? #t))

(define (note-since! c)
  ;; Since when each rule applies: a dive that went back begins anew.
  (set-coach-since!
   c
   (filter-map (lambda (rule)
                 (and (applies-now? rule)
                      (let ((before (assq-ref (coach-since c) (rule-name rule))))
                        (cons (rule-name rule) (if before (min before (now)) (now))))))
               rules)))

(define (lasted? c rule)
  (let ((since (assq-ref (coach-since c) (rule-name rule))))
    (and since (>= (- (now) since) (rule-lasting rule)))))

(define (may-speak? c)
  (let ((times (map first (%coach-log c))))
    (and (every (lambda (t) (>= (abs (- (now) t)) silence)) times)
         (< (count (lambda (t) (< (abs (- (now) t)) window)) times) most-words))))

(define (choose c)
  ;; The most urgent rule that may speak now, or #f.
  (let ((ready (filter (lambda (rule)
                         (and (not (memq (rule-name rule) (coach-said c)))
                              (>= (rule-urgency rule) (least-urgency c))
                              (lasted? c rule)))
                       rules)))
    (and (pair? ready)
         (fold (lambda (rule best) (if (> (rule-urgency rule) (rule-urgency best)) rule best))
               (car ready) (cdr ready)))))

(define-verb (coach-looks! (c coach))
  "Let the coach C look at the dive, as it should about once a second.  Return its words, or #f."
  (note-since! c)
  (let ((rule (and (may-speak? c) (choose c))))
    (and rule
         (begin
           (set-coach-said! c (cons (rule-name rule) (coach-said c)))
           (set-coach-log! c (cons (list (now) (rule-name rule) (rule-words rule)) (%coach-log c)))
           (rule-words rule)))))
