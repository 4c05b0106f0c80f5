;;; Files from outside: a save or a recording whose checksums are right is still believed in nothing.
;;;
;;; The state itself is spoilt in ../unit/state.c; here is what stands around it: the world, files and
;;; tracks it names, orders and steps of a recording, and what would take all memory to read.
;;;
;;; BIGHT_RUNS: how many forged files.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core datum)
             ((bight engine) #:select (%checksum))
             (ice-9 exceptions)
             (ice-9 textual-ports)
             (rnrs bytevectors)
             (srfi srfi-1))

(define kinds '(format version def domain name io limit unsupported))

(define (kind-of thunk)
  ;; The kind of the &bight-error that THUNK raises, or #f.  Whatever else is raised goes on.
  (guard (e ((bight-error? e) (bight-error-kind e)))
    (thunk)
    #f))

(define (known? kind)
  (and (memq kind kinds) #t))


;;; Text that costs more to read than its length.

(define-scenario plain-text
  "Text that names a size, nests or spells a number without end is not read at all."
  (for-each (lambda (text) (expect (plain-text? text) => #f))
            (list "(track #2f64:100000:100000((1)))" "#2f64@-5:5((1))" "#100000000f64(1)" "#e1e300" "#x10"
                  "#.(exit 1)" "#!eof" "#*01" "#0=(1)" "#|x|#" "#;(1) 2" "'a" "`a" ",a"
                  (make-string 101 #\() (make-string 101 #\[) (make-string 2000 #\9)
                  (string-append "(a #:" (make-string 3000 #\a) ")")))
  (for-each (lambda (datum)
              (expect (text->datum (object->string datum)) => datum))
            (list '(part box (named b) (at 1 -2.5 1e300)) "a \"b\" \\ (((((" '#(1 2) #f64(1.5 +inf.0) '()
                  (make-typed-array 'f64 1.5 2 3) #vu8(1 2) 'a (string->symbol "a b (") #:key #t #f #\a #\(
                  (make-string 5000 #\9) 2/3 -inf.0))
  (expect (text->datum "(1 2") => #f)
  (expect (text->datum "(1 2" 'none) => 'none)
  (expect (text->datum "#f" 'none) => #f))


;;; Forging: the lines of a story as data, changed, with all checksums made anew.

(define (datums-of file)
  (call-with-input-file file
    (lambda (port)
      (let loop ((all '()))
        (let ((line (get-line port)))
          (if (eof-object? line)
              (reverse all)
              (loop (cons (call-with-input-string line read) all))))))))

(define (hex n)
  (string-pad (number->string n 16) 16 #\0))

(define (write-forged! file datums)
  (define sum 0)
  (define (put! text port)
    (set! sum (%checksum (string->utf8 text) sum))
    (put-string port text))
  (define (put-vouching! datum port)
    (let ((text (object->string datum)))
      (put! (string-drop-right text 1) port)
      (put! (string-append " \"" (hex sum) "\")\n") port)))
  (call-with-output-file file
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (for-each (lambda (datum)
                  (if (and (pair? datum) (memq (car datum) '(begin second end)))
                      (put-vouching! (drop-right datum 1) port)
                      (put! (string-append (object->string datum) "\n") port)))
                datums))))

(define (forged datums)
  (let ((file (scratch-file "forged")))
    (write-forged! file datums)
    file))

(define (with-line datums head line)
  ;; DATUMS with LINE in place of the first that begins with HEAD.
  (let ((at (list-index (lambda (datum) (eq? head (car datum))) datums)))
    (append (take datums at) (list line) (drop datums (+ at 1)))))

(define (with-line-before datums head line)
  (let ((at (list-index (lambda (datum) (eq? head (car datum))) datums)))
    (append (take datums at) (list line) (drop datums at))))

(define (a-save)
  (let ((file (scratch-file "whole.dive")))
    (run 0.5)
    (save! file)
    (datums-of file)))

(define (a-recording)
  (let ((file (scratch-file "whole.rec")))
    (record! file)
    (drive! #:surge 0.5)
    (run 1.5)
    (drive! #:surge 0)
    (run 1)
    (stop-recording!)
    (datums-of file)))

(define-scenario forging-works
  "What is only written again, with its checksums made anew, is loaded and replayed."
  (in tank)
  (let ((save (a-save)) (hash (state-hash)))
    (load-dive (forged save))
    (expect (state-hash) => hash))
  (expect (replay (forged (a-recording))) => 'identical))

(define-scenario forged-saves
  "A save that names what is not there, or what never ends, is refused; the dive stays."
  (in tank)
  (let* ((save (a-save)) (dive (current-dive)) (hash (state-hash)))
    (for-each
     (lambda (datums)
       (expect (kind-of (lambda () (load-dive (forged datums)))) is known?)
       (expect (eq? dive (current-dive)) => #t)
       (expect (state-hash) => hash))
     (append
      (map (lambda (line) (with-line-before save 'fresh line))
           '((track "abcdefgh") (track #u8(1 2 3 4 5 6 7 8)) (track #f32(1 2 3 4 5 6 7 8)) (track (1 2 3))
             (track #f64(0 0 0 0)) (track #f64(0 0 0 0 +nan.0 1 1 1)) (track)
             (file "/dev/zero" 10 "0") (file "/dev/zero" 0 "0") (file 5 5 5) (file)
             (part tether) (part) (part 5) (part mesh (named m) (file "/dev/zero"))
             (part seabed (grid "/etc/passwd")) (part box (named b) (at 0 0 +inf.0) (size 1 1 1))
             (part tether (named many) (from 1 1 0) (to 2 2 -2) (length 9) (nodes 1000000000))))
      (map (lambda (line) (with-line save 'state line))
           '((state) (state 5) (state 5 "0" -1 "") (state 5 "0" 1e30 "") (state 5 "0" 100000000000 "AAAA")
             (state 5 "0" 10 (1 2)) (state 5 "0" "10" "AAAA")))
      (map (lambda (line) (with-line save 'fresh line)) '((fresh) (fresh 5) (fresh "zz")))
      (map (lambda (line) (with-line save 'world line)) '((world) (world 5 6 7) (world "a" b c)))))))

(define-scenario forged-recordings
  "Orders that mean nothing, and steps that no life is long enough for, end a replay."
  (in tank)
  (let ((recording (a-recording)) (hash (state-hash)))
    (for-each
     (lambda (line)
       (let ((found (guard (e ((bight-error? e) (bight-error-kind e)))
                      (replay (forged (with-line recording 'do line))))))
         (expect (or (eq? 'format found) (difference? found)) => #t)))
     '((do) (do 0) (do 0 drive) (do 0 drive minnow) (do 0 drive nobody 1 1 1 1) (do 0 drive minnow 9 9 9 9)
       (do 0 drive minnow "a" b c d) (do 0 drive minnow +inf.0 0 0 0) (do 0 no-such minnow 1)
       (do 0 "drive" minnow 1 1 1 1) (do 0 5 minnow 1) (do -5 drive minnow 1 1 1 1)
       (do +inf.0 drive minnow 1 1 1 1) (do +nan.0 drive minnow 1 1 1 1) (do 0.5 drive minnow 1 1 1 1)
       (do 1000000000000000000 drive minnow 1 1 1 1) (do 99999999999999999999999999 drive minnow 1 1 1 1)
       (do 0 alter) (do 0 alter line) (do 0 alter line model 1e300) (do 0 alter line nodes 5)
       (do 0 alter nobody model 6) (do 0 alter line length +nan.0) (do 0 current 99999999999 1 2 3 4 5 6 7 8)
       (do 0 current 0 1e300 0 0 0 0 0 0 0) (do 0 waves 0 2 1e300 1e300 0 0 0 0 0) (do 0 collide 0 1e30 0 0)
       (do 0 collide 0 2 1e300 0) (do 0 collide 1000000 1 0 0) (do 0 follow minnow 1 2 3)
       (do 0 fault minnow 1e300 1 0) (do 0 fault minnow 64 1 1e300) (do 0 cut-tether line -1)
       (do 0 pay-out line 1e300 1)))
    (for-each
     (lambda (line)
       (expect (kind-of (lambda () (replay (forged (with-line recording 'second line))))) => 'format))
     '((second +inf.0 "0" "0") (second 1000000000000 "0" "0") (second a "0" "0")))
    (expect (state-hash) => hash)))


;;; Forging at random.

(define odd-values
  `(0 1 -1 2 1e300 -1e300 +nan.0 +inf.0 -inf.0 1e-320 0.5 100000000000 ,(expt 10 30) 1/3 "" "x" a #t #f () (1 2)
    #(1) #f64(1 2 3) #u8(1 2) #:key minnow line "/dev/zero" "/etc/passwd"))

(define (change datum state)
  ;; DATUM with something else in one place.
  (if (and (pair? datum) (list? datum) (positive? (random 4 state)))
      (let ((at (random (length datum) state)))
        (case (random 8 state)
          ((0) (append (take datum at) (drop datum (+ at 1))))
          ((1) (append (take datum at) (list (list-ref datum at)) (drop datum at)))
          (else (append (take datum at) (list (change (list-ref datum at) state))
                        (drop datum (+ at 1))))))
      (list-ref odd-values (random (length odd-values) state))))

(define (change-a-line datums state)
  (let* ((at (+ 1 (random (- (length datums) 1) state))) (line (list-ref datums at)))
    (case (random 6 state)
      ((0) (append (take datums at) (drop datums (+ at 1))))
      ((1) (append (take datums at) (list (list-ref datums (+ 1 (random (- (length datums) 1) state))))
                   (drop datums at)))
      (else (append (take datums at)
                    (list (let ((other (change line state))) (if (pair? other) other (list other))))
                    (drop datums (+ at 1)))))))

(define (runs)
  (or (and=> (getenv "BIGHT_RUNS") string->number) 150))

(define-scenario forged-at-random
  "Whatever is changed in a save or a recording, it is loaded or refused, and what is loaded can be flown."
  (in tank)
  (let ((state (seed->random-state 11)) (save (a-save)) (recording (a-recording)) (dive (current-dive)))
    (for-each
     (lambda (i)
       (let ((kind (kind-of
                    (lambda ()
                      (load-dive (forged (change-a-line save state)))
                      (run 0.1)
                      (with-output-to-string status)
                      (save! (scratch-file "again"))))))
         (expect (or (not kind) (known? kind)) => #t)
         (current-dive dive))
       (kind-of (lambda () (replay (forged (change-a-line recording state))))))
     (iota (runs)))
    (expect (eq? dive (current-dive)) => #t)))
