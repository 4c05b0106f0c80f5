;;; Pictures: files of the size asked for, errors that teach, nothing loaded before it is used.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight errors)
             (bight picture)
             (ice-9 exceptions)
             (ice-9 ftw)
             (ice-9 textual-ports)
             (ice-9 binary-ports)
             (rnrs bytevectors)
             (srfi srfi-1))

(define (maps)
  "Return the text of /proc/self/maps, or the empty string."
  (if (file-exists? "/proc/self/maps")
      (call-with-input-file "/proc/self/maps" get-string-all)
      ""))

(define (loaded? library)
  "Return true if LIBRARY is in this process."
  (and (string-contains (maps) library) #t))

;; Asked before anything here could have drawn.
(define loaded-at-first
  (filter loaded? '("libOSMesa" "libEGL" "libcairo" "libchafa" "bight-render")))

(define-syntax-rule (raised expression)
  ;; (KIND . MESSAGE) of what EXPRESSION raises, or #f.
  (guard (e ((bight-error? e) (cons (bight-error-kind e) (bight-error-message e))))
    expression
    #f))

(define why-not
  ;; Why there are no pictures, or #f.  To ask is to load.
  (delay (raised (renderer-name))))

(define scratch
  (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-picture-XXXXXX")))

(define (in-scratch name)
  (string-append scratch "/" name))

(define (file-bytes name)
  (call-with-input-file (in-scratch name) get-bytevector-all #:binary #t))

(define (png-size name)
  "Return (WIDTH HEIGHT) of the PNG called NAME, or #f if it is none."
  (let ((bytes (file-bytes name)))
    (and (> (bytevector-length bytes) 24)
         (equal? '(137 80 78 71 13 10 26 10) (map (lambda (i) (bytevector-u8-ref bytes i)) (iota 8)))
         (list (bytevector-u32-ref bytes 16 (endianness big))
               (bytevector-u32-ref bytes 20 (endianness big))))))

(define (shown value)
  (call-with-output-string (lambda (port) (write value port))))

(define-syntax-rule (with-pictures body ...)
  ;; Only where there are any.
  (if (force why-not)
      (skip (cdr (force why-not)))
      (let () body ...)))

(define-scenario nothing-loaded-at-first
  "A dive loads no graphics library, and a plan needs none."
  (in open-water)
  (run 0.1)
  (expect loaded-at-first => '())
  (let ((missing (raised (snapshot (in-scratch "plan.png") #:view 'plan #:size '(320 200)))))
    (if missing
        (skip (cdr missing))
        (begin
          (expect (png-size "plan.png") => '(320 200))
          (expect (or (loaded? "libOSMesa") (loaded? "libEGL")) => #f)))))

(define-scenario a-picture-is-written
  "A snapshot writes a PNG of the size asked for and says so."
  (in open-water)
  (with-pictures
   (expect (shown (snapshot (in-scratch "a.png") #:size '(160 90))) =>
           (string-append (in-scratch "a.png") ", 160 x 90 pixels, overview"))
   (expect (png-size "a.png") => '(160 90))
   (expect (or (loaded? "libOSMesa") (loaded? "libEGL")) => #t)
   (for-each (lambda (view)
               (snapshot (in-scratch "v.png") #:view view #:size '(96 64))
               (expect (png-size "v.png") => '(96 64)))
             '(chase pilot top side north east plan (look (5 -5 -3) (0 5 -5))))
   (for-each (lambda (paint)
               (snapshot (in-scratch "p.png") #:paint paint #:size '(96 64))
               (expect (png-size "p.png") => '(96 64)))
             '(plain tension curvature model))
   (snapshot (in-scratch "s.png") #:view '(top side chase) #:size '(300 200))
   (expect (png-size "s.png") => '(300 200))
   (snapshot (in-scratch "t.png") #:transparent #t #:size '(96 64))
   (expect (png-size "t.png") => '(96 64))))

(define-scenario a-picture-leaves-the-dive-alone
  "Drawing changes nothing, and the same dive gives the same bytes."
  (in cross-current)
  (run 0.5)
  (with-pictures
   (let ((before (state-hash)))
     (snapshot (in-scratch "one.png") #:size '(160 120) #:paint 'tension)
     (snapshot (in-scratch "two.png") #:size '(160 120) #:paint 'tension)
     (expect (state-hash) => before)
     (expect (equal? (file-bytes "one.png") (file-bytes "two.png")) => #t)
     (snapshot (in-scratch "two.png") #:size '(160 120) #:paint 'curvature)
     (expect (equal? (file-bytes "one.png") (file-bytes "two.png")) => #f))))

(define-scenario obstacles-are-seen
  "A pile between the camera and the tether changes the picture; so does where it stands."
  (in open-water)
  (with-pictures
   (define (draw-with name . parts)
     (enter! (extend (find-world 'open-water) (splice parts)))
     (snapshot (in-scratch name) #:size '(120 90) #:view '(look (20 5 -6) (0 5 -6)) #:overlay 'none)
     (file-bytes name))
   (let ((bare (draw-with "o0.png"))
         (one (draw-with "o1.png" (part cylinder (named p) (from 8 5 0) (to 8 5 -40) (radius 0.5))))
         (other (draw-with "o2.png" (part box (named p) (at 8 9 -5) (size 2 2 2)))))
     (expect (equal? bare one) => #f)
     (expect (equal? bare other) => #f)
     (expect (equal? one other) => #f))))

(define-scenario mistakes-teach
  "What is wrong with a call is said before anything is drawn, with what is allowed."
  (in open-water)
  (expect (snapshot "x.png" #:view 'topp) raises name)
  (expect (->bool (string-contains (cdr (raised (snapshot "x.png" #:view 'topp)))
                                   "chase, pilot, top, side, north, east, overview or plan"))
          => #t)
  (expect (->bool (string-contains (cdr (raised (snapshot "x.png" #:view 'topp))) "`top'")) => #t)
  (expect (snapshot "x.png" #:view '(look (0 0 0))) raises domain)
  (expect (snapshot "x.png" #:view '()) raises domain)
  (expect (snapshot "x.png" #:paint 'tensions) raises name)
  (expect (snapshot "x.png" #:size '(0 0)) raises domain)
  (expect (snapshot "x.png" #:size '(8193 100)) raises domain)
  (expect (snapshot "x.png" #:size '(100000 100000)) raises domain)
  (expect (snapshot "x.png" #:size 100) raises domain)
  (expect (snapshot "x.jpg") raises domain)
  (expect (snapshot 'x) raises domain)
  (expect (snapshot "x.png" #:vieuw 'top) raises name)
  (expect (snapshot scratch) raises io)
  (expect (show #:as 'telepathy) raises name)
  (expect (file-exists? "x.png") => #f))

(define-scenario files-that-cannot-be-written
  "A file that cannot be written is one clear line, and nothing is left behind."
  (in open-water)
  (with-pictures
   (expect (snapshot "/nowhere/at/all.png" #:size '(64 64)) raises io)
   (expect (snapshot (in-scratch "none/x.png") #:size '(64 64)) raises io)
   (expect (filter (lambda (file) (string-suffix? ".part" file)) (scandir scratch)) => '())
   (expect (raised (snapshot (in-scratch "l.png") #:view '(look (1 1 1) (1 1 1)))) =>
           (cons 'domain "a camera looks from one point at another, not at itself"))))

(define-scenario shown-in-a-terminal
  "What is no terminal gets plain characters; symbols and sixels are made when asked for."
  (in open-water)
  (let ((plain (with-output-to-string (lambda () (show)))))
    (expect (->bool (string-contains plain "A")) => #t)
    (expect (string-index plain #\esc) => #f))
  (cond ((force why-not) (skip (cdr (force why-not))))
        ((raised (with-output-to-string (lambda () (show #:as 'symbols #:size '(20 8)))))
         => (lambda (reason) (skip (cdr reason))))
        (else
         (let ((text (with-output-to-string (lambda () (show #:as 'symbols #:size '(20 8))))))
           (expect (string-count text #\newline) => 8)
           (expect (->bool (string-index text #\esc)) => #t))
         (let ((text (with-output-to-string (lambda () (show #:as 'sixel #:size '(20 8))))))
           (expect (->bool (string-contains text "\x1bP")) => #t)))))
