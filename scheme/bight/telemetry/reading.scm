;;; (bight telemetry reading) --- what a vehicle's telemetry says, and a tally of what was wrong with it.
;;;
;;; A reading is one quantity at one time of the source's own clock:
;;;
;;;   position  (X Y Z), m in the source's local frame: east, north, up
;;;   place     (LATITUDE LONGITUDE Z), degrees and m up
;;;   course    (HEADING SPEED Z): where a vehicle without a position goes, degrees, m/s, m up
;;;   heading pitch roll            degrees
;;;   payout tension turns          m out, N at the winch, turns of the vehicle
;;;   pressure temperature voltage current remaining
;;;                                 Pa, degrees Celsius, V, A, percent
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight telemetry reading)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (make-reading reading? reading-time reading-quantity reading-value
            make-tally tally! tally-of tally-troubles))

(define-record <reading>
  (make-reading time quantity value)
  reading?
  (time reading-time)                   ; s
  (quantity reading-quantity)           ; a symbol
  (value reading-value))                ; a number, or a list of numbers

;;; A tally: how often each thing happened, by its name.

(define (make-tally)
  "Return a tally of nothing."
  (make-hash-table))

(define* (tally! tally what #:optional (n 1))
  "Count N more of WHAT, a symbol, in TALLY."
  (hashq-set! tally what (+ n (tally-of tally what))))

(define (tally-of tally what)
  "Return how many of WHAT are in TALLY."
  (hashq-ref tally what 0))

(define troubles
  ;; (NAME WORDS): what may be wrong with telemetry, in the order in which the words are told.
  '((wrong "frames with a bad checksum") (noise "bytes that belong to no frame")
    (truncated "frames cut off at the end") (lost "frames missing by their numbers")
    (foreign "frames of other systems") (strangers "datagrams of other users' programs")
    (unreadable "lines without the numbers they should have") (untimely "readings at impossible times")
    (jumps "jumps of the clock") (late "positions that came late") (absurd "readings beyond all bounds")
    (outliers "positions too far off to be reached") (resets "moves of the whole track")
    (homeless "places in degrees, of no use in a world without an origin")
    (reckoned "positions by dead reckoning") (refused "orders that the dive refused")))

(define (tally-troubles tally)
  "Return what was wrong by TALLY: a list of (NUMBER WORDS), nothing of what never happened."
  (filter-map (lambda (trouble)
                (let ((n (tally-of tally (first trouble))))
                  (and (> n 0) (list n (second trouble)))))
              troubles))
