;;; Lines of OrcaFlex's text data files as worlds: units, ends, what is refused, and damage.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight assembly) (srfi srfi-1) (srfi srfi-4))

(primitive-load (string-append (dirname (dirname (current-filename))) "/imported-text.scm"))

;; As OrcaFlex 11 writes it, with what is not read among the rest; the line is the elastic catenary of Irvine (1981) that
;; MoorDyn's test has: 100 m of 0.12 kg/m between points 60 m apart.
(define model
  "\ufeff%YAML 1.1
# Type: Model
---
General:
  UnitsSystem: SI
  StageDuration:
    - 8
    - ~
Environment:
  SeabedType: Flat
  WaterDepth: 1000
  Density: 1.025   # te/m^3
Vessels:
  - Name: 'Ship: one'
    InitialPosition: [10, 20, 0]
    InitialHeading: 90
LineTypes:
  - Name: Wire
    Category: General
    OD: 0.01
    ID: 0
    MassPerUnitLength: 0.12e-3
    EI: [0, ~]
    EA: 200
    Cd: [1.2, ~, 0.02]
    Ca: [1, ~, 0]
Lines:
  - Name: Hanging
    IncludeTorsion: No
    Connection, ConnectionX, ConnectionY, ConnectionZ, ConnectionAzimuth, ConnectionzRelativeTo:
      - [Fixed, 0, 0, -100, 0, ~]
      - [Fixed, 60, 0, -100, 0, ~]
    LineType, Length, TargetSegmentLength:
      - [Wire, 40, 2]
      - [Wire, 60, 2]
  - Name: Led
    Connection, ConnectionX, ConnectionY, ConnectionZ:
    - [Anchored, 30, 0, 5]
    - ['Ship: one', 3, 1, -4]
    LineType, Length, TargetSegmentLength:
    - [Wire, 1200, ~]
")

(define (parts w head)
  (filter (lambda (part) (eq? head (part-head-of part))) (world-parts-of w)))

(define-scenario tonnes-and-kilonewtons
  "Units, sections, ends: each arrives in its field."
  (let* ((w (import-orcaflex (written model)))
         (lines (map all-fields (parts w 'tether))))
    (define (values-of line . names) (map (lambda (name) (assq-ref line name)) names))
    (expect (values-of (first lines) 'diameter 'ea 'ei 'cdn 'cdt 'ca 'length 'nodes)
            => '(0.01 2e5 0. 1.2 0.02 1. 100. 50))
    (expect (assq-ref (first lines) 'mass) is (about 0.12 #:within 1e-12))
    (expect (assq-ref (second lines) 'from) => #f64(30 0 -995))
    (expect (assq-ref (second lines) 'to) => 'end-b2)
    (expect (assq-ref (all-fields (car (parts w 'rov))) 'at) is (about #f64(9 23 -4) #:within 1e-12))
    (expect (assq-ref (all-fields (car (parts w 'sea))) 'depth) => 1000.)))

(define-scenario the-catenary
  "The line is the system it describes: its equilibrium in closed form has 20.378 N at its ends (g = 9.81)."
  (enter! (with (without (import-orcaflex (written model)) 'line-2 'end-b2) (gravity 9.81) (line-1 (model elastic))))
  (expect (anchor-tension) is (about 20.378394681400 #:within 1e-6)))

(define (refused? kind text)
  (import-refused? import-orcaflex kind text))

(define-scenario what-has-no-counterpart
  "It is refused by name."
  (expect (refused? 'unsupported (changed model "UnitsSystem: SI" "UnitsSystem: US")) => #t)
  (expect (refused? 'unsupported (changed model "[Fixed, 60" "[Hanging, 60")) => #t)
  (expect (refused? 'unsupported (changed model "[Wire, 60" "[Chain, 60")) => #t)
  (expect (refused? 'format (changed model "    EA: 200\n" "")) => #t)
  (expect (refused? 'format (changed model "Name: Wire" "Name: Rope")) => #t)
  (expect (refused? 'format "just: words\n") => #t)
  (expect (refused? 'format (string-append "Lines: " (make-string 3000 #\[) (make-string 3000 #\]))) => #t)
  (expect (refused? 'format (string-concatenate (map (lambda (i) (string-append (make-string i #\space) "a:\n")) (iota 60))))
          => #t)
  (expect (import-orcaflex "/nowhere/model.yml") raises io))

(define random-numbers (seed->random-state 6))

(define-scenario damaged
  "A model with letters lost or others is a world all the same, or is refused with one line."
  (do ((i 0 (+ i 1))) ((= i 300))
    (expect (import-survives? import-orcaflex model "0-9. :\n[],'~#e" random-numbers) => #t)))
