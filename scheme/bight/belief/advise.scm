;;; (bight belief advise) --- what to do now: a few things that can be done, each flown, with the probability that the
;;; tether is in trouble after it.
;;;
;;; What is flown are the tethers of the current belief, or, without one, a fork of the dive, whose probabilities are
;;; 0 and 1.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief advise)
  #:use-module (bight belief)
  #:use-module (bight belief answer)
  #:use-module (bight belief cloud)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core units)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (fouled? unwind-plan way-home))
  #:use-module ((bight dive figures) #:select (held-vehicle))
  #:use-module (bight dive command)
  #:use-module ((bight dive contact) #:select (stuck?))
  #:use-module ((bight dive homing) #:select (untold-fork))
  #:use-module (bight dive in-words)
  #:use-module (bight dive plain-words)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (advise advice? advice-action advice-chances))

(define-record <advice>
  (make-advice action sentence now chances seconds)
  is-advice?
  (action %action)                      ; a symbol
  (sentence %sentence)                  ; what to do, a string
  (now %now)                            ; probability of trouble before anything is done
  (chances %chances)                    ; alist, action -> probability of trouble
  (seconds %seconds))                   ; how far it was looked

(define-argument-type (advice value)
  "what `advise' returns"
  (if (is-advice? value) value refused))

(define-verb (advice? (value any))
  "Return #t if VALUE is advice."
  (is-advice? value))

(define-verb (advice-action (advice advice))
  "Return what is advised: go-on, stop, pay-out, haul-in, go-back or unwind."
  (%action advice))

(define-verb (advice-chances (advice advice))
  "Return an alist from what was tried to the probability that the tether is fouled, stuck or parted after it."
  (%chances advice))


;;; What can be done.

(define some-line 3)                    ; m, or less of a short tether
(define along-speed 0.35)               ; m/s
(define time-to-see 10)                 ; s after a way has been flown

;; An action, a list: its name; what it does with a tether and its vehicle, which returns how many seconds it takes; what
;; it is in words, of the tether.
(define make-action list)
(define action-name first)
(define action-act second)
(define action-sentence third)

(define (hold! vehicle)
  (release! vehicle)
  (drive! vehicle #:surge 0 #:sway 0 #:heave 0 #:yaw 0)
  0)

(define (fly-way! vehicle way)
  (/ (fly-along! vehicle way #:speed along-speed) along-speed))

(define (fly-back! tether vehicle)
  ;; Along the tether, the winch taking in what the flight leaves slack.
  (let ((seconds (fly-way! vehicle (way-home tether))))
    (haul-in! tether (min (* along-speed seconds) (* 0.9 (tether-length tether))) #:rate along-speed)
    seconds))

(define (some-of tether) (min some-line (* 0.5 (tether-length tether))))

(define actions
  (list
   (make-action 'go-on (lambda (tether vehicle) 0) (lambda (tether) "Go on."))
   (make-action 'stop (lambda (tether vehicle) (hold! vehicle)) (lambda (tether) "Stop."))
   (make-action 'pay-out (lambda (tether vehicle) (pay-out! tether some-line) 0)
                (lambda (tether) (simple-format #f "Pay out ~a." (metres some-line))))
   (make-action 'haul-in
                (lambda (tether vehicle) (haul-in! tether (some-of tether)) 0)
                (lambda (tether) (simple-format #f "Haul in ~a." (metres (some-of tether)))))
   (make-action 'go-back fly-back!
                (lambda (tether) (string-append "Go back along the tether.  " (in-words tether 'way-home))))
   (make-action 'unwind
                (lambda (tether vehicle)
                  (let ((way (unwind-plan tether)))
                    (if way (fly-way! vehicle way) (hold! vehicle))))
                (lambda (tether) (string-append "Go round by the other side.  " (in-words tether 'unwind-plan))))))


;;; How it ends.

(define home-within 1)                  ; m of the anchor, where a vehicle cannot go on and is in no trouble

(define (trouble? tether)
  (or (parted? tether)
      (fouled? tether)
      (and (stuck? tether) (> (straight-distance tether) home-within))))

(define (ends-badly? action tether vehicle seconds)
  ;; Is TETHER in trouble after ACTION and SECONDS more, in the present dive?  One that refuses, as where the tether has
  ;; parted, is.
  (unless-refused
   (lambda ()
     (untold-fork
      (lambda ()
        (let ((on-the-way ((action-act action) tether vehicle)))
          (run (max seconds (if (positive? on-the-way) (+ on-the-way time-to-see) 0)))
          (trouble? tether)))))
   (const #t)))

(define (chance ask)
  ;; The probability that ASK returns true in the tethers of the belief of the present dive, or in the dive itself.
  (if (and (current-belief) (eq? (belief-host (current-belief)) (this-dive 'advise)))
      (answer-probability (ask-belief #f ask))
      (if (ask) 1.0 0.0)))

(define not-worth 0.02)                 ; of probability: a change for less is none

(define (best-of chances)
  ;; The name of the first of CHANCES that none is better than by what is worth while.
  (let ((least (apply min (map cdr chances))))
    (car (find (lambda (entry) (<= (cdr entry) (+ least not-worth))) chances))))

(define (advice-about tether vehicle seconds)
  (let* ((chances (map (lambda (action)
                         (cons (action-name action) (chance (lambda () (ends-badly? action tether vehicle seconds)))))
                       actions))
         (best (best-of chances))
         (action (find (lambda (action) (eq? best (action-name action))) actions)))
    (make-advice best ((action-sentence action) tether) (chance (lambda () (trouble? tether))) chances seconds)))

(define-verb (advise #:subject (t tether) #:key (seconds positive 30.0))
  "Return what to do now: go on, stop, pay out, haul in, go back along the tether or round by the other side, the
first of these after which the tether is least likely fouled, stuck or parted SECONDS later, or ten seconds after a
way has been flown.  Each is flown on the tethers of the current belief, or, without one of this dive, on a fork.  The
prompt says it in words, with the probability of trouble now, after it, and after going on."
  (let* ((tether (list-ref (%names (this-engine 'advise) 'tether) t))
         (vehicle (held-vehicle 'advise t)))
    (advice-about tether vehicle seconds)))


;;; In words.

(define (advice-said advice)
  (let ((on (percent-said (assq-ref (%chances advice) 'go-on)))
        (after (percent-said (assq-ref (%chances advice) (%action advice))))
        (now (percent-said (%now advice))))
    (string-append
     (%sentence advice)
     (if (eq? 'go-on (%action advice))
         (simple-format #f "  Trouble: ~a now, ~a in ~a." now on (seconds-said (%seconds advice)))
         (simple-format #f "  Trouble: ~a now, ~a after it, ~a going on." now after on)))))

(set-record-type-printer!
 <advice> (lambda (advice port) (simple-format port "#<advice: ~a>" (advice-said advice))))
