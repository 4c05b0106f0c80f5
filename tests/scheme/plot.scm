;;; Plots and films: files whole or not at all, programs that are there, missing, or fail.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core errors)
             (bight view picture)
             (bight core programs)
             (ice-9 exceptions)
             (ice-9 ftw)
             (ice-9 textual-ports)
             (srfi srfi-1))

(define (files)
  (scandir (dirname (scratch-file "x")) (lambda (name) (not (string-prefix? "." name)))))

(define (said thunk)
  "Return the message of what THUNK raises, or #f."
  (guard (e ((bight-error? e) (bight-error-message e)))
    (thunk)
    #f))

(define (call-with-path path thunk)
  (let ((before (getenv "PATH")))
    (dynamic-wind
      (lambda () (setenv "PATH" path))
      thunk
      (lambda () (setenv "PATH" before)))))

(define-syntax-rule (with-gnuplot body ...)
  (if (program? "gnuplot") (let () body ...) (skip "there is no gnuplot")))

(define no-picture
  ;; Why there are no pictures, or #f.
  (said (lambda () (renderer-name))))

(define-syntax-rule (with-pictures body ...)
  (if no-picture (skip no-picture) (let () body ...)))

(define (make-program! name . lines)
  "Make a shell script NAME in a folder of its own, and return the folder."
  (let ((folder (scratch-file "bin")))
    (unless (file-exists? folder) (mkdir folder))
    (call-with-output-file (string-append folder "/" name)
      (lambda (port) (display (string-join (cons "#!/bin/sh" lines) "\n") port)))
    (chmod (string-append folder "/" name) #o755)
    folder))

(define-scenario samples-are-plotted
  "What was gathered while the dive ran becomes an SVG, a PNG, and characters."
  (in cross-current)
  (define s (sample! 0.5 (max-tension) (rov-depth) (string-length "no number of seconds")))
  (run 2)
  (expect (length (samples-rows s)) => 5)
  (expect (map car (samples-rows s)) is (about '(0 0.5 1 1.5 2) #:within 0.02))
  (with-gnuplot
   (plot s #:to (scratch-file "a.svg") #:title "It's <it>")
   (let ((text (call-with-input-file (scratch-file "a.svg") get-string-all)))
     (expect (string-prefix? "<?xml" text) => #t)
     (expect (->bool (string-contains text "max-tension")) => #t)
     (expect (->bool (string-contains text "s &lt;it")) => #t))
   (plot s #:to (scratch-file "b.svg") #:title "It's <it>")
   (expect (equal? (call-with-input-file (scratch-file "a.svg") get-string-all)
                   (call-with-input-file (scratch-file "b.svg") get-string-all))
           => #t)
   (plot s #:to (scratch-file "a.png") #:size '(200 150))
   (expect (> (stat:size (stat (scratch-file "a.png"))) 500) => #t)
   (expect (->bool (string-contains (object->string (plot s #:size '(60 15))) "max-tension")) => #t)))

(define-scenario a-tether-is-plotted-along-its-length
  "Tension, depth and curvature; the file of a bench; numbers of one's own."
  (in cross-current)
  (with-gnuplot
   (for-each (lambda (what)
               (expect (->bool (string-contains (object->string (plot what)) "arc length")) => #t))
             '(tension depth curvature))
   (call-with-output-file (scratch-file "bench.csv")
     (lambda (port)
       (display "case,model,setting,metric,error,reference,reference_uncertainty,cpu_ns\n" port)
       (display "c,m,n=1,rms,1e-3,none,0,1000\nc,m,n=2,rms,1e-5,none,0,5000\nc,m,n=3,rms,0,none,0,5\n"
                port)))
   (let ((drawn (object->string (plot (scratch-file "bench.csv")))))
     (expect (->bool (string-contains drawn "CPU, s")) => #t)
     (expect (->bool (string-contains drawn "without 1 row of 0")) => #t))
   (expect (string-contains (object->string (plot (scratch-file "bench.csv") #:log 'x)) "without") => #f)
   (expect (->bool (string-contains (object->string (plot '((up (0 0) (1 1)) (down (0 1) (1 0))))) "down"))
           => #t)))

(define-scenario plots-that-cannot-be
  "Each failure is one clear line, and leaves no file."
  (in cross-current)
  (expect (plot 'tension #:to (scratch-file "x.pdf")) raises domain)
  (expect (plot 'tension #:to (scratch-file "no/x.svg")) raises io)
  (expect (plot 'colour) raises domain)
  (expect (plot (scratch-file "missing.csv")) raises io)
  (expect (plot '()) raises domain)
  (expect (plot '((1 2) (2 0)) #:log 'y #:to (scratch-file "x.svg")) raises domain)
  (expect (plot '((0 2) (2 1)) #:log 'xy #:to (scratch-file "x.svg")) raises domain)
  (expect (->bool (string-contains (said (lambda () (plot '((a (1 2) (2 0))) #:log 'y))) "no place for the row (2 0) of \"a\""))
          => #t)
  (expect (call-with-path (scratch-file "nowhere") (lambda () (plot 'tension))) raises unsupported)
  (let ((bin (make-program! "gnuplot" "echo 'line 1: it hurts' >&2" "exit 1")))
    (expect (said (lambda ()
                    (call-with-path (string-append bin ":" (getenv "PATH"))
                                    (lambda () (plot 'tension #:to (scratch-file "x.svg"))))))
            => "gnuplot failed: line 1: it hurts"))
  (expect (file-exists? (scratch-file "x.svg")) => #f)
  (with-gnuplot
   (symlink "/dev/full" (scratch-file "full.svg"))
   (expect (->bool (string-contains (said (lambda () (plot 'tension #:to (scratch-file "full.svg"))))
                                    "No space left"))
           => #t)))

(define-scenario films-are-poured-into-ffmpeg
  "Frame by frame, whole or not at all; time passes."
  (in open-water)
  (with-pictures
   (let ((bin (make-program! "ffmpeg" "for last; do :; done" "exec cat >\"$last\"")))
     (call-with-path (string-append bin ":" (getenv "PATH"))
                     (lambda () (film (scratch-file "f.mp4") #:for 0.2 #:size '(64 48) #:rate 10)))
     (expect (stat:size (stat (scratch-file "f.mp4"))) => (* 2 4 64 48))
     (expect (now) is (about 0.2 #:within 0.02)))
   (let ((bin (make-program! "ffmpeg" "echo 'Unknown encoder' >&2" "exit 1")))
     (expect (said (lambda ()
                     (call-with-path (string-append bin ":" (getenv "PATH"))
                                     (lambda ()
                                       (film (scratch-file "g.mp4") #:for 1 #:size '(640 480) #:rate 10)))))
             => (string-append "cannot write \"" (scratch-file "g.mp4") "\": Unknown encoder"))
     (expect (filter (lambda (name) (string-prefix? "g" name)) (files)) => '()))))

(define-scenario films-without-ffmpeg
  "Become numbered pictures."
  (in open-water)
  (with-pictures
   (film (scratch-file "h.png") #:for 0.3 #:size '(32 32) #:rate 10)
   (expect (filter (lambda (name) (string-prefix? "h" name)) (files))
           => '("h-00001.png" "h-00002.png" "h-00003.png"))
   (expect (film (scratch-file "no/h.png") #:for 1) raises io)
   (expect (film (scratch-file "h.png") #:for 0) raises domain)))

(define-scenario an-axis-for-each-unit
  "Curves of one unit share an axis, others have their own; events are marks; several dives are told apart."
  (in pile)
  (define s (sample! 1 (max-tension) (rov-depth) (rov-tension)))
  (drive! #:surge 1)
  (run 20)
  (define (script what)
    ;; What gnuplot would read.
    (call-with-output-string
      (lambda (port) ((@@ (bight view chart) print-script) ((@@ (bight view plot) chart-of) what #f #f) 'svg '(800 . 600) port))))
  (define (times word text) (- (length (string-split* text word)) 1))
  (let ((one (script s)) (two (script (list (cons 'a s) (cons 'b s)))))
    (expect (times "plot '-'" one) => 2)
    (expect (->bool (string-contains one "set ylabel 'N'")) => #t)
    (expect (->bool (string-contains one "set ylabel '(rov-depth), m'")) => #t)
    (expect (->bool (string-contains one "set title")) => #f)
    (expect (->bool (string-contains one "title 'pile'")) => #t)
    (expect (times "\nset arrow" one) => (* 2 (length (filter (lambda (e) (<= (second e) 20)) (events)))))
    (expect (>= (length (events)) 1))
    ;; Of several dives each event says whose it is.
    (expect (times "\nset arrow" two) => (* 2 (times "\nset arrow" one)))
    (expect (->bool (string-contains two (string-append "set label 'a: " (symbol->string (first (car (events))))))) => #t)
    (expect (times "'a (max-tension)'" two) => 1)
    (expect (times "'b (max-tension)'" two) => 1)
    ;; A dive has one colour in all panels.
    (expect (delete-duplicates
             (filter-map (lambda (line)
                           (and=> (string-contains line "title 'b (rov-depth)'")
                                  (lambda (i) (substring line (string-contains line "#" i)
                                                         (+ 7 (string-contains line "#" i))))))
                         (string-split two #\newline)))
            => '("#d55e00"))))

(define (string-split* text word)
  ;; TEXT between the places where WORD is.
  (let ((i (string-contains text word)))
    (if i
        (cons (substring text 0 i) (string-split* (substring text (+ i (string-length word))) word))
        (list text))))

