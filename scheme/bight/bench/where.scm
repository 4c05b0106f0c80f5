;;; (bight bench where) --- which part of bight has the CPU time of what is evaluated.
;;;
;;; While a procedure runs, a clock of CPU time notes each time which code is running and who called that code; see
;;; src/sampler/.  A sample belongs to the part of the nearest caller that is part of one: a sine, a copy of bytes or
;;; a distance is charged to whoever asked for it.  Parts are told by the source file of a function, which
;;; addr2line (of binutils) reads from the library's debugging information.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench where)
  #:use-module (bight bench sampler)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core scratch) #:select (call-with-scratch scratch-file))
  #:use-module (ice-9 popen)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (part-of-function
            where-time-goes
            say-where))


;;; Parts.

(define parts
  ;; Beginnings of "FOLDER/FILE.c FUNCTION"; the first that fits counts.
  '(("shared" "world/layout.c bt__walk_live") ; of whoever hashes, packs or counts
    ("recording" "world/layout.c bt__hash_state" "guile/times.c" "guile/sqlite.c")
    ("ccd" "contact/line_guard" "collide/cast.c" "collide/safe.c")
    ("contact" "contact/" "sim/contact_" "sim/stuck" "sim/chain_touch" "sim/chain_wear")
    ("cable" "tether/" "sim/chain" "sim/remesh" "sim/resolve" "sim/lay" "sim/afloat")
    ("vehicle" "vehicle/" "sim/bodies" "sim/kinematics" "sim/hull" "sim/pins" "sim/winch" "sim/reach" "sim/around"
     "sim/props" "world/hull" "world/predicted")
    ("sea" "sea/" "model/current")
    ("copy" "world/layout" "world/pack")
    ("awareness" "aware/" "world/aware" "world/watch" "world/ways" "sim/wound")
    ("scheme" "guile/" "outlet/" "prompt/")
    ("shared" "math/" "base/" "collide/") ; of whoever calls
    ("dive" "world/" "sim/" "model/" "live/")
    ("other" "")))

(define (part-of-function text)
  "Return the part that TEXT, \"FOLDER/FILE.c FUNCTION\", belongs to; #f where that is whoever calls the function."
  (let ((name (first (find (lambda (part) (any (lambda (start) (string-prefix? start text)) (cdr part))) parts))))
    (if (string=? name "shared") #f name)))

(define runtimes
  ;; Libraries in which time is spent for Scheme.
  '(("libguile" . "scheme") ("libgc." . "collector") ("libgmp" . "scheme")))


;;; Functions of addresses.

(define (read-function port)
  ;; The two lines of a function, "FOLDER/FILE.c FUNCTION", from the folder src/ on; #f for what has no file.
  (let* ((name (read-line port)) (file (read-line port)) (at (string-contains-right file "/src/")))
    (and at (string-append (car (string-split (substring file (+ at 5)) #\:)) " " name))))

(define (string-contains-right text part)
  (let loop ((found #f) (from 0))
    (let ((at (string-contains text part from)))
      (if at (loop at (+ at 1)) found))))

(define (read-functions port)
  ;; An alist from each address to its function, the one that others were made part of.
  (let loop ((found '()))
    (let ((char (peek-char port)))
      (cond ((eof-object? char) found)
            ((and (char=? char #\0)) (loop (acons (text->number (substring (read-line port) 2) 16) #f found)))
            (else
             (set-cdr! (car found) (read-function port))
             (loop found))))))

(define (functions-at library addresses)
  "Return an alist from each of ADDRESSES in LIBRARY, a file, to its function or #f.  Raise unsupported when that
cannot be read."
  (call-with-scratch
   (lambda ()
     (let ((file (scratch-file "addresses")))
       (call-with-output-file file
         (lambda (port) (for-each (lambda (a) (simple-format port "0x~a~%" (number->string a 16))) addresses)))
       (let* ((port (open-pipe* OPEN_READ "addr2line" "-a" "-f" "-i" "-e" library (string-append "@" file)))
              (found (read-functions port)))
         (unless (and (eqv? 0 (status:exit-val (close-pipe port))) (any cdr found))
           (bight-raise 'unsupported 'bench
                        "the functions of ~a cannot be told: that takes addr2line (Debian package binutils) and \
a library built with -g and not stripped" library))
         found)))))

(define (ours? library)
  (let ((name (basename library)))
    (or (string-prefix? "libbight" name) (string-prefix? "bight-" name))))

(define (function-table samples)
  ;; From (LIBRARY . ADDRESS) to a part, or #f.
  (let ((table (make-hash-table)) (libraries '()))
    (for-each (lambda (place)
                (when (and (car place) (ours? (car place)) (not (hash-get-handle table place)))
                  (hash-set! table place #f)
                  (set! libraries (lset-adjoin equal? libraries (car place)))))
              (concatenate samples))
    (for-each (lambda (library)
                (for-each (lambda (entry)
                            (when (cdr entry)
                              (hash-set! table (cons library (car entry)) (part-of-function (cdr entry)))))
                          (functions-at library (filter-map (lambda (place) (and (equal? library (car place)) (cdr place)))
                                                            (hash-map->list (lambda (place part) place) table)))))
              libraries)
    table))


;;; Samples.

(define (part-of-place table place)
  (let ((library (car place)))
    (cond ((not library) "scheme")      ; made by Guile at run time
          ((find (lambda (runtime) (string-prefix? (car runtime) (basename library))) runtimes) => cdr)
          (else (hash-ref table place)))))

(define (count-parts samples)
  (let ((table (function-table samples)) (counts (map (lambda (name) (cons name 0)) (part-names))))
    (for-each (lambda (sample)
                (let ((part (or (any (lambda (place) (part-of-place table place)) sample) "other")))
                  (assoc-set! counts part (+ 1 (assoc-ref counts part)))))
              samples)
    counts))

(define (part-names)
  (append (delete "shared" (map first parts)) '("collector")))

(define (where-time-goes thunk)
  "Call THUNK; return an alist from each part of bight, a string, to how many samples of CPU time it had."
  (let ((samples '()))
    (dynamic-wind
      %start-samples!
      thunk
      (lambda () (set! samples (%stop-samples!))))
    (count-parts samples)))

(define (say-where thunk)
  "Call THUNK, and print the CPU time that it took, in ns, and the samples of each part, a line each."
  (let* ((begun (get-internal-run-time))
         (ended begun)
         (counts (where-time-goes (lambda () (thunk) (set! ended (get-internal-run-time))))))
    (simple-format #t "~%cpu ~a~%" (quotient (* 1000000000 (- ended begun)) internal-time-units-per-second))
    (for-each (lambda (entry) (simple-format #t "~a ~a~%" (car entry) (cdr entry))) counts)))
