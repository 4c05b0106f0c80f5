;;; Lines of MoorDyn as worlds: a case whose answer is known in closed form, the public case of a chain on a bed, what
;;; is refused, there and back, and damage.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight assembly) ((ice-9 textual-ports) #:select (get-string-all)) (srfi srfi-1) (srfi srfi-4))

(primitive-load (string-append (dirname (dirname (current-filename))) "/imported-text.scm"))

(define (deck types points lines options)
  (string-append "--- MoorDyn Input File ---\nwords of its own\n--- LINE TYPES ---
TypeName Diam Mass/m EA BA/-zeta EI Cd Ca CdAx CaAx\n(name) (m) (kg/m) (N) (N-s/-) (N-m^2) (-) (-) (-) (-)\n" types
"---- POINT PROPERTIES ----\nID Type X Y Z Mass Volume CdA Ca\n(#) (-) (m) (m) (m) (kg) (m^3) (m^2) (-)\n" points
"---- LINES ----\nID LineType AttachA AttachB UnstrLen NumSegs LineOutputs\n(#) (name) (#) (#) (m) (-) (-)\n" lines
"---- OPTIONS ----\n" options "---- need this line ----\n"))

;; The elastic catenary of 100 m between points 60 m apart on one level, solved for itself (Irvine 1981): H = 6.3214694 N.
(define hanging
  (deck "wire 0.01 0.12 2e5 50 0 1.2 1.0 0.02 0\n"
        "1 Fixed 0 0 -100 0 0 0 0\n2 Fixed 60 0 -100 0 0 0 0\n"
        "1 wire 1 2 100 50 -\n"
        "1025 WtrDnsty water density\n1000 WtrDpth depth\n9.81 g gravity\n0 WaveKin none\n"))

;; The chain of MoorDyn's own tests (WD0050_Chain, held to OrcaFlex there), with its damping as a share.
(define chain
  (deck "chain 0.252 390 1.674e9 -1.0 0 1.37 1.0 0.64 0.0\n"
        "1 Fixed 400 0.0 -50.0 0 0 0 0\n2 Vessel 0.0 0.0 0.0 0 0 0 0\n"
        "1 chain 1 2 410 82 -\n"
        "1025.0 WtrDnsty (kg/m^3)\n50 WtrDpth (m)\n0.5 FrictionCoefficient (-)\n1.0e5 kBot x\n2 writeLog x\n"))

(define (only w head)
  (find (lambda (part) (eq? head (part-head-of part))) (world-parts-of w)))

(define (fields w head)
  (all-fields (only w head)))

(define-scenario the-catenary
  "A deck is the system it describes: its equilibrium is the elastic catenary."
  (enter! (with (import-moordyn (written hanging)) (line-1 (model elastic))))
  (expect (anchor-tension) is (about 20.378394681400 #:within 1e-6))
  (expect (z (point-at 50)) is (about -136.281867789932 #:within 1e-6)))

(define-scenario the-chain
  "Each column arrives in its field; a negative damping is a share of the critical one of an element, L sqrt (EA m)."
  (let* ((w (import-moordyn (written chain))) (line (fields w 'tether)))
    (define (value name) (assq-ref line name))
    (expect (map value '(diameter mass ea ei cdn ca cdt length nodes friction))
            => '(0.252 390. 1.674e9 0. 1.37 1. 0.64 410. 82 0.5))
    (expect (value 'ba) is (about (* 5 (sqrt (* 1.674e9 390))) #:within 1e-3))
    (expect (value 'to) => 'point-2)
    (expect (value 'from) => #f64(400 0 -50))
    (expect (assq-ref (fields w 'sea) 'depth) => 50.)
    (expect (assq-ref (fields w 'rov) 'at) => #f64(0 0 0))))

(define published
  (string-append (or (getenv "BIGHT_REFERENCE_DATA")
                     (string-append (or (getenv "top_srcdir") "..") "/../shared/data"))
                 "/published/orcaflex_WD0050_case.txt"))

(define-scenario the-chain-as-published
  "The deck with which MoorDyn is held to OrcaFlex is the chain above, in half as many segments."
  (unless (file-exists? published)
    (skip "the reference data are not here"))
  (let* ((text (call-with-input-file published get-string-all))
         (deck (string-join (map (lambda (line) (if (string-prefix? "# " line) (substring line 2) line))
                                 (string-split text #\newline))
                            "\n"))
         (w (import-moordyn (written deck))) (own (import-moordyn (written chain))))
    (expect (assq-ref (fields w 'tether) 'nodes) => 41)
    (for-each (lambda (name) (expect (assq-ref (fields w 'tether) name) => (assq-ref (fields own 'tether) name)))
              '(diameter mass ea ei cdn ca cdt length friction from to))))

(define-scenario there-and-back
  "What is written is read as the same lines, to the last digit."
  (for-each
   (lambda (text)
     (let* ((w (import-moordyn (written text))) (copy (scratch-file "copy.txt")))
       (expect (export-moordyn w copy) => '())
       (let ((again (import-moordyn copy)))
         (for-each (lambda (name)
                     (expect (assq-ref (fields again 'tether) name) => (assq-ref (fields w 'tether) name)))
                   '(diameter mass ea ba ei cdn ca cdt length nodes friction from to))
         (expect (fields again 'sea) => (fields w 'sea)))))
   (list hanging chain))
  (expect (export-moordyn (find-world 'pile) (scratch-file "pile.txt")) => '(p1 current)))

(define (refused? kind text)
  (import-refused? import-moordyn kind text))

(define-scenario what-has-no-counterpart
  "It is refused by name."
  (expect (refused? 'unsupported (changed hanging "2 Fixed" "2 Free")) => #t)
  (expect (refused? 'unsupported (changed hanging "0 WaveKin" "3 WaveKin")) => #t)
  (expect (refused? 'format (changed hanging "2e5" "2e5|3e5")) => #t)
  (expect (refused? 'format (changed hanging "1 wire" "1 rope")) => #t)
  (expect (refused? 'format (changed hanging "1 2 100" "1 7 100")) => #t)
  (expect (refused? 'format "nothing of the kind\n") => #t)
  (expect (refused? 'unsupported
                    (changed chain "---- LINES" "---- RODS ----\nID RodType Xa\n(#) (name) (m)\n1 bar 3\n---- LINES"))
          => #t)
  (expect (import-moordyn "/nowhere/deck.txt") raises io))

(define random-numbers (seed->random-state 5))

(define-scenario damaged
  "A deck with words lost, doubled or of other letters is a world all the same, or is refused with one line."
  (do ((i 0 (+ i 1))) ((= i 300))
    (expect (import-survives? import-moordyn (if (even? i) chain hanging) "0-9. |\neXx(#" random-numbers) => #t)))
