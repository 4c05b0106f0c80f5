;;; (bight cockpit believed) --- the belief of the dive that a cockpit shows: how probable it is that the tether is wound,
;;; and the tubes that hold the tether.
;;;
;;; In every frame the belief is flown on after its dive for a short while; once it is there, it is asked, about once a
;;; second.  A belief that costs more than there is time for stays behind; how old what is shown is, is told.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit believed)
  #:use-module (bight belief)
  #:use-module (bight belief answer)
  #:use-module (bight belief cloud)
  #:use-module (bight belief level)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit state)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module ((bight dive aware) #:select (fouled?))
  #:use-module (bight engine)
  #:use-module (bight view tube)
  #:use-module (srfi srfi-1)
  #:export (look-at-belief! toggle-belief! believed-drawing believed-lines belief-alarm! finding?))

(define flying 0.008)                   ; s of a frame in which the belief is flown on,
(define stretch 0.1)                    ; by so many s of the dive at once
(define period 1)                       ; s at least from question to question,
(define share 1/10)                     ; which take no more CPU time than this share
(define too-far 1.0)                    ; s behind its dive at which a belief is not asked

(define-record <finding>
  (make-finding belief steps chance drawing level alarm)
  finding?
  (belief finding-belief)
  (steps finding-steps)                 ; of the dive, then
  (chance finding-chance)               ; an answer: is the tether wound?
  (drawing finding-drawing)
  (level finding-level)                 ; as (bight belief level) counts
  (alarm finding-alarm set-finding-alarm!)) ; what is worth telling and was not told yet, or #f

(define (belief-here c)
  ;; The belief that C shows, or #f.
  (let ((belief (current-belief)))
    (and belief (cockpit-belief? c) (cockpit-tether c) (eq? (belief-host belief) (cockpit-dive c))
         (not ((unseen?) 'tether-points))
         belief)))

(define (found c)
  ;; What was found of the belief that is shown, or #f.
  (let ((belief (belief-here c)) (finding (cockpit-believed c)))
    (and belief finding (eq? belief (finding-belief finding)) finding)))

(define (engine-here c) (engine-of (cockpit-dive c)))

(define (behind c belief)
  ;; By how much BELIEF has yet to be flown, s.
  (* (%dive-time-step (engine-here c)) (- (%dive-steps (engine-here c)) (belief-step belief))))

(define (fly-on! c belief)
  (let ((until (+ (clock) flying))
        (steps (max 1 (inexact->exact (round (/ stretch (%dive-time-step (engine-here c))))))))
    (let loop ()
      (let ((now (%dive-steps (engine-here c))))
        (catch-up! 'pilot! belief (if (< now (belief-step belief)) now (min now (+ steps (belief-step belief)))))
        (when (and (> (behind c belief) 0) (< (clock) until))
          (loop))))))

(define (due? c belief)
  (let ((finding (found c)))
    (and (> (clock) (cockpit-believed-due c)) (< (behind c belief) too-far)
         (not (and finding (= (finding-steps finding) (%dive-steps (engine-here c))))))))

(define (cpu) (/ (get-internal-run-time) (exact->inexact internal-time-units-per-second)))

(define (ask! c belief)
  (let* ((begun (cpu)) (steps (%dive-steps (engine-here c)))
         (chance (ask-belief belief (lambda () (fouled? (cockpit-tether c)))))
         (p (answer-probability chance))
         (before (let ((last (found c))) (if last (finding-level last) 0)))
         (level (level-after before p)))
    (set-believed! c (make-finding belief steps chance (with-belief belief (read-drawing #:lines? #f)) level
                                   (level-said before level p)))
    (set-believed-due! c (+ (clock) (max period (/ (- (cpu) begun) share))))))

(define (show-no-more! c e)
  ;; Its belief has ended, or begins after where the dive is now.
  (set-belief?! c #f)
  (set-believed! c #f)
  (announce! c (bight-error-message e)))

(define (look-at-belief! c)
  "Fly the belief that C shows, if there is one, on after its dive, and ask it when that is due."
  (let ((belief (belief-here c)))
    (when belief
      (with-exception-handler
          (lambda (e)
            (unless (bight-error? e) (raise-exception e))
            (show-no-more! c e))
        (lambda ()
          (fly-on! c belief)
          (when (due? c belief)
            (ask! c belief)))
        #:unwind? #t))))

(define (toggle-belief! c)
  "Let C show the belief of its dive, or no more."
  (cond ((not (current-belief)) (announce! c "nothing is believed yet: bight pilot WORLD --belief B, or (believe! ...) at the prompt"))
        (else
         (set-belief?! c (not (cockpit-belief? c)))
         (set-believed-due! c 0)
         (announce! c (if (cockpit-belief? c) "the belief is shown" "the belief is not shown")))))

(define (believed-drawing c)
  "Return where the belief that C shows holds the tether to be, a drawing for `draw-over', or #f."
  (and=> (found c) finding-drawing))

(define (chance-said chance members)
  (let ((interval (answer-interval chance)))
    (simple-format #f "P(wound) ~a (~a to ~a) of ~a tethers" (hundredths (answer-probability chance))
                   (hundredths (first interval)) (hundredths (second interval)) members)))

(define old 2)                         ; s of the dive after which the age of what was found is told

(define (age c finding)
  (* (%dive-time-step (engine-here c)) (- (%dive-steps (engine-here c)) (finding-steps finding))))

(define (believed-lines c)
  "Return what the belief that C shows says, lines: none where there is no belief."
  (let ((finding (found c)))
    (if finding
        (let ((said (chance-said (finding-chance finding) (length (belief-members (finding-belief finding)))))
              (age (age c finding)))
          (list (if (< age old) said (simple-format #f "~a, ~a s ago" said (inexact->exact (round age))))))
        '())))

(define (belief-alarm! c)
  "Return what the belief that C shows gives cause to tell, a string, or #f; the same not twice."
  (let ((finding (found c)))
    (and finding (finding-alarm finding)
         (let ((said (finding-alarm finding)))
           (set-finding-alarm! finding #f)
           (string-append "BELIEF: " said)))))
