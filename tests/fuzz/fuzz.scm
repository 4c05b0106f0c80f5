;;; A fuzzer of the language: whatever the arguments, a call succeeds or raises a &bight-error.
;;;
;;;   bight fuzz.scm [--seed S] [--sequences N] [--first K] [--limit SECONDS] [--trace] [--bait]
;;;
;;; A sequence is twenty calls of random names of the language in a random world, with arguments that
;;; fit, that nearly fit and that do not fit at all.  It depends on the seed and its own number alone, so
;;; `--seed S --first K --sequences 1 --trace' shows sequence K again, call by call.  A finding is
;;;
;;;   - anything raised but a &bight-error, save what the fuzzer's own procedures raise;
;;;   - an error of no known kind, without a sentence, or with one too long to read;
;;;   - a refused call after which `state-hash' is another, or the current dive is;
;;;   - a result that cannot be printed;
;;;   - a call that takes more than --limit seconds of processor time;
;;;   - the end or the silence of the process.
;;;
;;; The calls are made in a child process, in a folder that is removed afterwards; the parent watches.
;;; Exit status: 0 without findings, 1 with.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight)
             ((bight assembly) #:select (data->part build-world))
             ((bight core errors) #:select (abbreviate bight-error-kinds brief))
             ((bight core landlock) #:select (close-paths!))
             ((bight core schema) #:select (part-heads inner-heads head-fields field-name field-kind
                                       field-words field-live?))
             ((bight core verb) #:select (accepts? argument-type-name current-subject-lister))
             (ice-9 exceptions)
             (ice-9 getopt-long)
             (ice-9 rdelim)
             (srfi srfi-1)
             (srfi srfi-4))

(define enclosed? #f)                   ; does the kernel watch where this process writes?
(define calls-per-sequence 20)
(define longest-message 1500)
(define longest-run 0.25)               ; seconds of dive time


;;; What is left out.

(define not-called
  '((run-tests . "reads and runs whatever test files there are, this one's neighbours too")
    (haul-trial . "flies a dive for minutes, which may take seconds")
    (free-to-haul? . "the same")
    (home-trial . "the same")
    (fly-home! . "the same")
    (unwind-preview . "the same")
    (tour-trial . "the same")
    (advise . "the same, six times")
    (live! . "time then passes by the clock, and no two runs are the same")
    (film . "draws for as long as it is told to")
    (pilot! . "wants a terminal and somebody at its keys")))

;; Calls are made of what others gave, names of files among it.  These write where they are told, and are
;; only let loose where the kernel keeps them from whatever is not the fuzzer's.
(define writers '(record! save! export-csv export-npz export-vtk export-gltf snapshot plot))

;; These let time pass for as long as they are told: a run of 1e9 seconds is no mistake.  What the
;; fuzzer asks of them is kept below `longest-run', unless it is refused anyway.
(define long-by-request '(run run-until settle! foresee))

;; Not a procedure of ours: Guile's own parameter, whose count of arguments Guile itself checks.
(define parameters '(current-dive current-belief))


;;; Chance.

(define random-state #f)

(define (reseed! . seed)
  (set! random-state (seed->random-state (string-join (map object->string seed) "/"))))

(define (random-below n)
  (random n random-state))

(define (chance? p)
  (< (random 1.0 random-state) p))

(define (pick vector)
  (vector-ref vector (random-below (vector-length vector))))

(define (choose . items)
  (list-ref items (random-below (length items))))

(define (a-number low high)
  ;; A few digits, so that it is readable.
  (/ (round (* 1000 (+ low (* (random 1.0 random-state) (- high low))))) 1000))


;;; Values.  An argument is a pair of an expression, which the report prints, and its value.

(define (literal value)
  (cons (if (or (symbol? value) (pair? value) (null? value) (vector? value)) (list 'quote value) value)
        value))

(define-syntax-rule (expressions e ...)
  (list (cons 'e (lambda () e)) ...))

(define (circular)
  (let ((items (list 1 2 3)))
    (set-cdr! (cddr items) items)
    items))

(define (self-containing)
  (let ((items (list 1 2 3)))
    (set-car! items items)
    items))

(define (nested levels)
  (let loop ((n levels) (value '()))
    (if (zero? n) value (loop (- n 1) (list value)))))

(define long-list (make-list 100000 1))
(define deep-list (nested 100000))
(define long-string (make-string 100000 #\a))
(define long-symbol (string->symbol (make-string 3000 #\z)))
(define unnamed-symbol (make-symbol "minnow"))
(define huge (expt 10 400))
(define many-points (make-typed-array 'f64 1.5 30000 3))

(define (oops . arguments)
  ;; What the fuzzer's own procedures raise, and may come back.
  (throw 'fuzz-oops))

(define touched? #f)                    ; did one of the fuzzer's own procedures change the dive?

(define (meddle . arguments)
  (set! touched? #t)
  (false-if-exception (drive! #:surge 0.5))
  (false-if-exception (run 0.05))
  (false-if-exception (enter! 'open-water))
  #f)

(define (an-error)
  (guard (e (#t e)) (bearing-to "there")))

(define numbers
  (expressions
   0 1 2 3 5 10 16 90 100 359 -1 -5 -90 0.5 0.1 0.01 -0.5 1.5 2.5 7.25 1/3 -1/2 0.0 -0.0 1.0 20.0 1e-3 1e3
   1e-9 1e6 1e9 +nan.0 +inf.0 -inf.0 1e308 -1e308 1e-320 1e12 1e13 1e18 -1e12 huge (- huge)
   (/ 1 huge) (/ huge 3) 1+2i +nan.0+1.0i 2147483647 2147483648 -2147483649 4294967296
   9223372036854775807 9223372036854775808 -9223372036854775809 18446744073709551616))

(define lists
  (expressions
   '() '(1) '(1 2) '(1 2 3) '(1 2 3 4) '(0 0 -5) '(3 4 -5) '(0 0 0) '(1 2 . 3) '(1 . 2) '(1 2 +nan.0)
   '(1 2 +inf.0) '(1 2 1e8) '(1 2 1+2i) '("1" 2 3) '(a b c) '(#f #f #f) '((1 2 3)) '((0 0 0) (1 2 -3))
   '((0 0 0) (0 0 0)) '((1 2 3) (4 5)) '((1 2 3) . 4) '((1 2 3) x) '((0 0 0 -5) (1 1 0 -5) (2 1 1 -5))
   '((0 0 0 0) (0 1 1 1)) '((1 0 0 0) (0 1 1 1)) '((0 0 0 +nan.0) (1 1 1 1)) '((0 0 0) (1 1 1 1))
   '(quote minnow) '(0.5 90) '(knots 1) '(hours x) '(profile) '(profile (0 0.5 90) (-10 0.2 180))
   '(profile (0 0.5 90) (0 0.2 180)) '(profile (0 0.5)) '(profile . 3) '(profile (0 +nan.0 90))
   '(turning (speed 0.5) (toward 90) (degrees-per-metre -0.9)) '(turning (speed 0.5)) '(turning 1 2 3 4)
   '(tide (speed 0.6) (toward 90) (period (hours 12))) '(tide (speed 0.6) (towrad 90)) '(tide (speed . 1))
   '(power 0.5 90 (exponent 1/7)) '(power 0.5 90 (exponent -1)) '(power (speed (knots 1)) (toward 90))
   '(grid "c.csv") '(wake #t) '(uniform 0.5 90) '(still) '(function car) '(no-such 1 2)
   (circular) (self-containing) (list (circular) (circular)) (cons 'profile (circular))
   (list 'profile (circular)) long-list deep-list (list deep-list deep-list deep-list)
   (cons 'profile long-list) (list 1 2 long-list)))

(define texts
  (expressions
   "" "x" "." ".." "/" "null" "full" "no/such/file" "no-such.csv" "track.csv" "short.csv" "words.csv"
   "world.scm" "broken.scm" "loop.scm" "empty" "folder" "a\x00;b" "~a ~s ~" "Ωλ\n" "-1" "open-water"
   "minnow" long-string))

(define names
  (expressions
   'minnow 'line 'rope 'no-such 'minow 'linne 'sea 'rov 'tether 'fathom 'kinematic 'open-water 'tank
   'cross-current 'tide-profile 'opne-water 'still 'uniform 'profile 'taut 'slack 'arrived 'spooled 'tuat
   'crate 'tower 'tower/leg 'tower/sphere 'wreck 'box 'group 'mesh
   'rubber-band 'v-shape 'catenary 'catenary-simplex 'elastic 'steady 'dynamic 'auto 'stedy 'inextensible
   'x 'to 'd1 'd2 (string->symbol "") (string->symbol "a b") (string->symbol "~a") (string->symbol "a\x00;b")
   (string->symbol "../world") 'Ωλ long-symbol unnamed-symbol
   #:surge #:sway #:speed #:sped #:fresh #:at-most #:within #:rate #:degrees #:since #:cdn #:model
   #:length #:nonsense #:columns))

(define procedures
  (expressions
   car (lambda () #f) (lambda () #t) (lambda (x) x) (lambda (x) #t) (lambda (a b c) a) (lambda all all)
   (lambda () (> (now) 0.1)) (lambda (p t) '(0.1 0 0)) (lambda (p t) (vec 0.2 0.1 0))
   (lambda (p t) #(0.1 0.1 0)) (lambda (p t) (vec+ p '(0 0 0))) (lambda (p t) 'nonsense)
   (lambda (p t) '(1 2 x)) (lambda (p t) #(1 2 #f)) (lambda (p t) '(1 2)) (lambda (p t) '(1 2 . 3))
   (lambda (p t) (f64vector +nan.0 0 0)) (lambda (p t) (f64vector +inf.0 0 0)) (lambda (p t) '(1e300 0 0))
   (lambda (p t) (circular)) (lambda (p t) (values 1 2)) (lambda (p t) (values))
   oops meddle (lambda () (oops)) (lambda (p t) (if (> t 0.05) (oops) '(0.1 0 0)))
   state-hash run drive! (lambda () (step!)) current-dive))

(define others
  (expressions
   #t #t #f #f #\a (if #f #f) (call-with-input-string "" read) #() #(1 2 3) #(0 0 -5) #(1 2 a)
   #(#(1 2 3) #(4 5 6)) (vec 1 2 3) (vec 0 0 -5) (f64vector) (f64vector 1 2) (f64vector 1 +nan.0 3)
   (f64vector 1 2 +inf.0) (f32vector 1 2 3) (u8vector 1 2 3) (s64vector 0 0 -5) (make-typed-array 'c64 1.0 3)
   #vu8(1 2 3) #*101 (make-typed-array 'f64 0.5 2 3) (make-typed-array 'f64 +nan.0 2 3)
   (make-typed-array 'f64 0.0 0 3) (make-typed-array 'f64 0.0 3 0) (make-typed-array 'f64 1.0 2 4)
   (make-typed-array 'f64 1.0 2 3 2) (make-typed-array 'f64 1.0 '(5 7)) (make-array 'x '(1 3) '(2 4))
   (make-array 1 '(-1 1) '(-1 1)) (make-array 1) (make-shared-array (vec 1 2 3) (lambda (i) (list 0)) 3)
   (make-typed-array 'a #\x 3) many-points (make-hash-table) (current-module) (make-variable 1)
   (current-output-port) (delay (oops)) (make-parameter 1) (make-exception-with-message "m")
   (an-error) (an-error)
   (make-record-type 'r '(a)) (make-fluid) (make-string 0) (make-weak-key-hash-table)))

(define base-worlds
  ;; Worlds and parts are made once: they never change.
  (delay
    (let ((entries
           (expressions
            (with 'open-water (line (model rubber-band)))
            (with 'open-water (line (model v-shape)))
            (with 'open-water (line (model catenary)))
            (with 'cross-current (line (model catenary-simplex) (nodes 12)))
            (with 'cross-current (line (model elastic) (wet-weight 1)))
            (with 'tide-profile (line (model steady) (nodes 16)))
            (with 'open-water (line (model steady)) (current (lambda (p t) '(0.2 0 0))))
            (with 'tank (rope (length 20)))
            (with 'open-water (line (length 15.01)))
            (extend 'open-water (rov (named second) (at 3 3 -3)))
            (extend 'open-water (rov (named second) (at 3 3 -3))
                    (tether (named other) (from 1 1 0) (to second) (length 30)))
            (without 'open-water 'line)
            (world (sea (depth 10)))
            (extend 'open-water (seabed) (box (named crate) (at 30 0 -5) (size 1 2 3) (heading 30))
                    (group (named tower) (at -40 0 0)
                      (cylinder (named leg) (from 0 0 0) (to 0 0 -20) (radius 0.5))
                      (sphere (at 0 0 -5) (radius 1) (track (0 0 0 -5) (5 3 3 -5 90)))))
            (extend 'open-water
                    (seabed (grid (lambda (x y) (- -50 (* 0.1 x))) (from -20 -20) (to 20 20) (spacing 5))))
            (extend 'open-water (mesh (named wreck) (file "no-such.obj")))
            (part box (size 1 1 1))
            (part group (named frame) (capsule (from 9 9 0) (to 9 9 -9) (radius 0.2)))
            (world (rov (named d1) (at 0 0 -1)))
            (part rov (named d2) (at 4 4 -4))
            (part tether (named t2) (from 0 0 0) (to minnow) (length 30))
            (part sea (depth 5)))))
      (map (lambda (entry)
             (let ((value ((cdr entry))))
               (cons (car entry) (lambda () value))))
           entries))))

(define all-values #f)                  ; vector of (EXPRESSION . THUNK)
(define kinds-of-values #f)             ; vector of such vectors

(define (prepare-values!)
  (let ((kinds (list numbers lists texts names procedures others (force base-worlds))))
    (set! kinds-of-values (list->vector (map list->vector kinds)))
    (set! all-values (list->vector (concatenate kinds)))))

(define (value-of entry)
  (cons (car entry) ((cdr entry))))

(define results '())                    ; arguments: what earlier calls of the sequence returned

(define (junk)
  (if (and (pair? results) (chance? 0.15))
      (apply choose results)
      (value-of (pick (pick kinds-of-values)))))

(define (a-point)
  (let ((point (list (a-number -20 20) (a-number -20 20) (a-number -20 1))))
    (if (chance? 0.3)
        (cons (cons 'vec point) (apply vec point))
        (literal point))))

;; Of each type of argument, the values it accepts: asked once.
(define accepted (make-hash-table))

(define (accepts-quietly? type value)
  (false-if-exception (accepts? type value)))

(define (accepted-values type)
  (or (hashq-ref accepted type)
      (let ((fitting (filter (lambda (entry) (accepts-quietly? type ((cdr entry))))
                             (vector->list all-values))))
        (hashq-set! accepted type (list->vector fitting))
        (hashq-ref accepted type))))

(define (plausible type)
  "Return an argument that TYPE accepts, if there is one."
  (let ((mine (filter (lambda (result) (accepts-quietly? type (cdr result))) results))
        (known (accepted-values type)))
    (cond ((and (pair? mine) (or (zero? (vector-length known)) (chance? 0.3))) (apply choose mine))
          ((and (eq? 'point (argument-type-name type)) (chance? 0.7)) (a-point))
          ((and (accepts-quietly? type 0.123) (chance? 0.5)) (literal (a-number 0 5)))
          ((zero? (vector-length known)) (junk))
          (else (value-of (pick known))))))


;;; Calls.

;; How a verb's arguments are declared; what the language itself tells of them is for people.
(define signature-of (@@ (bight core signature) verb-signature))
(define signature-subject (@@ (bight core signature) signature-subject))
(define signature-required (@@ (bight core signature) signature-required))
(define signature-optional (@@ (bight core signature) signature-optional))
(define signature-keys (@@ (bight core signature) signature-keys))
(define signature-rest (@@ (bight core signature) signature-rest))

;; Verbs about the dive are called thrice as often as others.
(define (worth entry)
  (let ((signature (signature-of (cdr entry))))
    (if (or (string-suffix? "!" (symbol->string (car entry)))
            (and signature (signature-subject signature))
            (memq (car entry) long-by-request))
        (list entry entry entry)
        (list entry))))

;; With --bait these are among the names, ten times each: faults of every kind, which must be found.

(define unprintable
  (make-struct/no-tail (make-record-type 'unprintable '() (lambda (it port) (car '())))))

(define (refuse-something)
  (bearing-to "nowhere"))

(define baits
  `((bait-raw . ,(lambda all (car 'raw)))
    (bait-change . ,(lambda all
                      (false-if-exception (run 0.1))
                      (refuse-something)))
    (bait-slow . ,(lambda all (let loop () (loop))))
    (bait-unprintable . ,(lambda all unprintable))
    (bait-crash . ,(lambda all (kill (getpid) SIGKILL)))))

(define (procedures-to-call)
  (let ((interface (resolve-interface '(bight))))
    (append-map (lambda (name)
                  (let ((value (variable-ref (module-variable interface name))))
                    (if (and (procedure? value)
                             (not (assq name not-called))
                             (or enclosed? (not (memq name writers))))
                        (worth (cons name value))
                        '())))
                (language-names))))

;; What a symbol may usefully be, by verb.
(define apt-names
  '((tether-model! rubber-band v-shape catenary catenary-simplex elastic steady dynamic auto)
    (on taut slack arrived spooled)
    (alter! minnow line rope second crate tower/leg seabed)
    (describe minnow line crate tower tower/sphere seabed mesh group)
    (world-part sea minnow line crate tower/leg)
    (without minnow line crate tower)
    (enter! open-water tank cross-current tide-profile)))

(define (fit verb type share)
  ;; An argument that TYPE accepts, with a probability of SHARE.
  (cond ((not (chance? share)) (junk))
        ((and (assq-ref apt-names verb) (accepts-quietly? type 'minnow) (chance? 0.8))
         (literal (apply choose (assq-ref apt-names verb))))
        (else (plausible type))))

(define (subjects kind)
  (or (false-if-exception ((current-subject-lister) 'fuzz kind)) '()))

(define (a-subject kind share)
  (let ((known (subjects kind)))
    (cond ((and (pair? known) (chance? share))
           (if (and (null? (cdr known)) (chance? 0.7))
               '()
               (list (literal (apply choose known)))))
          ((chance? 0.5) '())
          (else (list (literal (choose 'no-such 'minow 'minnow 'line 'd2)))))))

(define (a-field-setting)
  (let* ((head (choose 'rov 'tether 'tether))
         (live (filter field-live? (head-fields head)))
         (field (apply choose (if (and (pair? live) (chance? 0.9)) live (head-fields head))))
         (keyword (symbol->keyword (field-name field))))
    (list (literal keyword)
          (cond ((chance? 0.2) (junk))
                ((and (pair? (field-words field)) (chance? 0.8))
                 (literal (apply choose (field-words field))))
                (else (literal (a-number 0 (choose 1 10 100))))))))

(define (a-current)
  (if (chance? 0.5)
      (list (literal (a-number 0 1)) (literal (a-number 0 360)))
      (list (value-of (apply choose (if (chance? 0.5) procedures lists))))))

(define special-rests
  ;; Verbs whose rest is of any type, and what fits there.
  `((alter! . ,(lambda () (concatenate (list-tabulate (random-below 3) (lambda (i) (a-field-setting))))))
    (current! . ,a-current)))

(define (rest-arguments name signature share)
  (let ((special (assq-ref special-rests name))
        (rest (signature-rest signature)))
    (cond ((not rest) '())
          ((and special (chance? share)) (special))
          (else (list-tabulate (random-below 4) (lambda (i) (fit name (cdr rest) share)))))))

(define (keyword-arguments name signature share)
  (append-map (lambda (key)
                (if (chance? 0.35)
                    (list (literal (car key)) (fit name (cdr key) share))
                    '()))
              (signature-keys signature)))

(define (spoil arguments)
  ;; ARGUMENTS with one left out, added, doubled or replaced.
  (let ((n (length arguments)))
    (if (zero? n)
        (list (junk))
        (let ((i (random-below n)))
          (case (random-below 4)
            ((0) (append (take arguments i) (drop arguments (+ i 1))))
            ((1) (append (take arguments i) (list (junk)) (drop arguments i)))
            ((2) (append arguments (drop arguments i)))
            (else (append (take arguments i) (list (junk)) (drop arguments (+ i 1)))))))))

(define (arguments-for name procedure)
  (let ((signature (signature-of procedure)))
    (cond ((memq name parameters)
           (list-tabulate (random-below 2) (lambda (i) (junk))))
          ((not signature)
           (list-tabulate (random-below 3) (lambda (i) (junk))))
          (else
           (let* ((share (choose 1.0 1.0 1.0 1.0 0.9 0.7 0.3 0.0))
                  (arguments
                   (append
                    (if (signature-subject signature)
                        (a-subject (signature-subject signature) share)
                        '())
                    (map (lambda (p) (fit name (cdr p) share)) (signature-required signature))
                    (append-map (lambda (p) (if (chance? 0.5) (list (fit name (cdr p) share)) '()))
                                (signature-optional signature))
                    (rest-arguments name signature share)
                    (keyword-arguments name signature share))))
             (if (or (= share 1.0) (chance? 0.7)) arguments (spoil arguments)))))))

(define (shorten name arguments)
  ;; ARGUMENTS without times that NAME would grant and that are long.
  (define (short argument)
    (let ((value (cdr argument)))
      (if (and (real? value) (< longest-run value) (<= value 1e9))
          (literal (a-number 0 longest-run))
          argument)))
  (if (memq name long-by-request)
      (let ((arguments (map short arguments)))
        (if (or (eq? name 'run) (member #:at-most (map cdr arguments)))
            arguments
            (append arguments (list (literal #:at-most) (literal (a-number 0 longest-run))))))
      arguments))

(define (a-call names)
  "Return a call: a pair of its form, for the report, and a thunk that makes it."
  (let* ((entry (pick names))
         (arguments (shorten (car entry) (arguments-for (car entry) (cdr entry)))))
    (cons (cons (car entry) (map car arguments))
          (lambda () (apply (cdr entry) (map cdr arguments))))))


;;; Forms, for `eval'.  Values reach them as variables, so that circular ones do no harm to the expander.

(define workshop #f)                    ; the module they are evaluated in
(define bindings '())                   ; (NAME EXPRESSION) of the form being made

(define (make-workshop!)
  (set! workshop (make-fresh-user-module))
  (module-use! workshop (resolve-interface '(bight))))

(define (variable! argument)
  ;; A fresh variable bound to the value of ARGUMENT.
  (let ((name (string->symbol (simple-format #f "v~a" (length bindings)))))
    (module-define! workshop name (cdr argument))
    (set! bindings (append bindings (list (list name (car argument)))))
    name))

(define (expression)
  (variable! (if (chance? 0.6) (value-of (apply choose numbers)) (junk))))

(define (body names)
  ;; A few calls as forms.
  (list-tabulate
   (+ 1 (random-below 2))
   (lambda (i)
     (let* ((entry (pick names))
            (arguments (shorten (car entry) (arguments-for (car entry) (cdr entry)))))
       (cons (car entry) (map variable! arguments))))))

(define (a-word)
  (choose 'minnow 'line 'd1 'd2 'no-such 'fathom 'kinematic 'steady 'catenary 'open-water 'x 'stil))

(define (a-clause head)
  (let ((inner (inner-heads head)))
    (if (and (pair? inner) (chance? 0.2))
        (a-thing (apply choose inner))
        (a-field head))))

(define (a-thing head)
  ;; Such as a clump, whole or not.
  (if (chance? 0.5)
      (cons head (map (lambda (field) (list (field-name field) (a-number 0 9))) (head-fields head)))
      (cons head (list-tabulate (random-below 4) (lambda (i) (a-clause head))))))

(define (a-field head)
  (let* ((field (apply choose (head-fields head)))
         (name (if (chance? 0.95) (field-name field) (choose 'lenght 'denstiy 'x))))
    (case (field-kind field)
      ((word name type) (list name (if (chance? 0.8) (a-word) (expression))))
      ((points) (cons name (rows 3)))
      ((track) (cons name (rows (choose 4 5))))
      ((grid) (cons* name (choose (expression) "no-such.asc" '(lambda (x y) -5))
                     (choose '() '((from -1 -1) (to 1 1) (spacing 1))
                             (list '(from -1 -1) (list 'to (expression) 1) '(spacing 1))
                             (list '(from 0 0) '(to 1 1) (list 'spacing (expression))))))
      ((mesh) (list name (choose "no-such.obj" "empty" "folder" (expression))))
      ((point end) (if (chance? 0.5)
                       (list name (a-number -9 9) (a-number -9 9) (a-number -9 0))
                       (list name (if (chance? 0.5) (a-word) (expression)))))
      ((current) (cons name (choose (list (expression) (expression))
                                    (list 'still)
                                    (list (list 'profile (list 0 (expression) 90) (list -9 0.2 (expression))))
                                    (list (list 'tide (list 'speed (expression)) (list 'toward 9)))
                                    (list (list 'power 0.5 90 (list 'exponent (expression)))))))
      (else (if (chance? 0.7)
                (list name (a-number 0 (choose 1 50)))
                (list name (expression)))))))

(define (rows width)
  ;; Some rows of WIDTH numbers, the first rising.
  (list-tabulate (random-below 6)
                 (lambda (i)
                   (cons i (list-tabulate (- width 1)
                                          (lambda (j)
                                            (if (chance? 0.95) (a-number -9 9) (expression))))))))

;; What a kind of obstacle cannot do without, so that some are made.
(define whole
  '((box (at 9 9 -9) (size 1 2 3))
    (sphere (at 9 9 -9) (radius 1))
    (cylinder (from 9 9 0) (to 9 9 -9) (radius 0.3))
    (capsule (from 9 9 0) (to 9 9 -9) (radius 0.3))
    (convex (at 9 9 -9) (points (0 0 0) (1 0 0) (0 1 0) (0 0 1)))
    (group (named d2) (heading 90) (box (size 1 1 1)))))

(define (a-part)
  (let ((known (apply choose whole)))
    (if (chance? 0.3)
        (append known (list-tabulate (random-below 2) (lambda (i) (a-member (car known)))))
        (any-part))))

(define (a-member head)
  (if (and (eq? head 'group) (chance? 0.7)) (a-part) (a-clause head)))

(define (any-part)
  (let ((head (if (chance? 0.97) (apply choose (part-heads)) 'rvo)))
    (append (list head)
            (if (and (eq? head 'tether) (chance? 0.8)) '((from 0 0 -1) (length 30)) '())
            (list-tabulate (random-below 4) (lambda (i) (a-member (if (eq? head 'rvo) 'rov head)))))))

(define (some-parts)
  (list-tabulate (+ 1 (random-below 3))
                 (lambda (i) (if (chance? 0.9) (a-part) (list 'splice (expression))))))

(define (a-world-expression)
  (choose ''open-water ''tide-profile ''no-such (expression) (list 'quote (a-word))))

(define (a-claim names)
  (let ((ask (car (body names))))
    (choose (list ask)
            (list ask '=> (expression))
            (list ask 'is (list (choose 'about 'above 'below) (expression)))
            (list ask 'is (expression))
            (list ask 'raises (choose 'domain 'name))
            (list (list '< (expression) (expression)))
            (list (expression) (expression)))))

(define form-makers
  (vector
   (lambda (names) (cons 'world (some-parts)))
   (lambda (names) `(define-world ,(choose 'd1 'd2) "Fuzzed." ,@(some-parts)))
   (lambda (names) `(enter! (world (rov (named minnow) (at 0 5 -5) ,(a-clause 'rov))
                                   (tether (named line) (from 0 0 -1) (length 9) ,(a-clause 'tether)))))
   (lambda (names) `(extend ,(a-world-expression) ,@(some-parts)))
   (lambda (names) `(with ,(a-world-expression) ,(a-clause 'sea) (line ,(a-clause 'tether))))
   (lambda (names) `(with ,(a-world-expression) (,(a-word) ,(expression)) ,(expression)))
   (lambda (names) (cons 'part (a-part)))
   (lambda (names) `(define-tether-type ,(choose 't1 't2) "Fuzzed." (like ,(choose 'fathom 't1 't3))
                                        ,(a-clause 'tether)))
   (lambda (names) `(define-vehicle ,(choose 'u1 'u2) "Fuzzed." ,(a-clause 'rov)))
   (lambda (names) `(what-if ,@(body names)))
   (lambda (names) `(with-dive ,(expression) ,@(body names)))
   (lambda (names) `(every ,(variable! (literal (a-number 0 0.2))) ,@(body names)))
   (lambda (names) `(every ,(expression) #t))
   (lambda (names) (cons 'expect (a-claim names)))
   (lambda (names) (cons 'require (a-claim names)))
   (lambda (names) `(,(choose 'always 'never 'eventually) ,(car (body names)) ,@(body names)))
   (lambda (names) `(run-scenario (define-scenario fuzzed "Fuzzed." (in ,(a-word)) ,@(body names)
                                    (expect ,@(a-claim names)))))
   (lambda (names) `(help ,(choose 'run 'world 'no-such (list 'quote (a-word)) "tension" "" 3)))
   (lambda (names) `(,(choose 'world 'with 'extend 'part 'define-world 'define-tether-type 'without)
                     ,@(list-tabulate (random-below 3) (lambda (i) (expression)))))))

(define (a-form names)
  "Return a form: a pair of what the report prints and a thunk that evaluates it."
  (set! bindings '())
  (let* ((form ((pick form-makers) names))
         (all bindings))
    (cons (if (null? all) form `(let ,all ,form))
          (lambda () (eval form workshop)))))


;;; One call, judged.

(define limit 1.0)
(define trace? #f)
(define report-port #f)
(define findings 0)
(define calls 0)
(define history '())                    ; the forms of the sequence so far, the last first
(define here #f)                        ; (SEED . SEQUENCE)

(define (say text . values)
  (display (apply simple-format #f text values) report-port)
  (newline report-port)
  (force-output report-port))

(define (written form)
  (let ((text (simple-format #f "~s" form)))
    (if (> (string-length text) 2000) (string-append (substring text 0 2000) "...") text)))

(define (finding! what)
  (set! findings (+ findings 1))
  (say "finding ~a (--seed ~a --first ~a --sequences 1), call ~a"
       (string-join (string-split what #\newline) " ")
       (car here) (cdr here) (length history))
  (for-each (lambda (form) (say "form   ~a" (written form)))
            (reverse history)))

(define (processor-seconds)
  (/ (get-internal-run-time) (exact->inexact internal-time-units-per-second)))

;; A timer looks at the call under way four times a second and, past the limit, ends it: if it lets ^C in.
(define call-began #f)

(define (look-at-clock signal)
  (when (and call-began (> (- (processor-seconds) call-began) limit))
    (set! call-began #f)
    (throw 'fuzz-too-long)))

(define (watch-time!)
  (sigaction SIGPROF look-at-clock)
  (setitimer ITIMER_PROF 0 250000 0 250000))

(define (one-line exception)
  (let ((key (exception-kind exception)))
    (simple-format #f "~a: ~a" key
                   (string-trim-both
                    (call-with-output-string
                      ;; Guile's printer dies of deep lists.
                      (lambda (port)
                        (print-exception port #f key (map abbreviate (exception-args exception)))))))))

(define (hash-now)
  (and (current-dive) (state-hash)))

;; Macros that judge a claim tell of a failed one in their own way, and of a malformed one as Guile does.
(define claims '(expect require always never eventually run-scenario help))

(define (head-of form)
  (if (eq? 'let (car form)) (car (third form)) (car form)))

(define (expected? form exception)
  ;; Whether FORM may end with EXCEPTION, which is no &bight-error.
  (memq (exception-kind exception)
        (if (memq (head-of form) claims)
            '(fuzz-oops failed-expectation syntax-error)
            '(fuzz-oops))))

;; Forms whose body may change the dive, or make another one current, before something is refused.
(define (has-body? form)
  (memq (head-of form) (cons* 'with-dive claims)))

(define (judge-error form exception)
  (cond ((bight-error? exception)
         (let ((text (bight-error-message exception)))
           (cond ((not (memq (bight-error-kind exception) bight-error-kinds))
                  (finding! (simple-format #f "kind ~s" (bight-error-kind exception))))
                 ((not (and (string? text) (< 0 (string-length text) longest-message)))
                  (finding! (simple-format #f "no readable message: ~a" (written text)))))
           (one-line exception)))
        ((eq? 'fuzz-too-long (exception-kind exception))
         (finding! (simple-format #f "ran longer than ~a s" limit)))
        ((not (expected? form exception))
         (finding! (simple-format #f "raised ~a" (written (one-line exception)))))))

(define (judge-state form before dive)
  ;; What was refused, and what only looks ahead, leaves the dive as it was.
  (unless (or touched? (has-body? form))
    (cond ((not (eq? dive (current-dive)))
           (finding! "another dive is current, though the call was refused or looked ahead"))
          ((not (eqv? before (hash-now)))
           (finding! "the dive changed, though the call was refused or looked ahead")))))

(define (judge-value value)
  (when (struct? value)
    (catch #t
      (lambda () (call-with-output-string (lambda (port) (write value port))))
      (lambda (key . arguments)
        (finding! (simple-format #f "its result cannot be printed: ~a" key))))))

(define (steps)
  (and (current-dive) (round (/ (now) (time-step)))))

(define (ends-midway? form before-steps)
  ;; Time passed before the error: what happened until then stays.
  (and (memq (car form) '(run run-until settle! step!))
       (not (eqv? before-steps (steps)))))

(define (attempt call)
  "Make CALL and judge it."
  (let* ((form (car call)) (dive (current-dive)) (before (hash-now)) (before-steps (steps))
         (began (processor-seconds)) (outcome #f))
    (set! history (cons form history))
    (set! calls (+ calls 1))
    (set! touched? #f)
    (when trace? (say "trace ~a" (written form)))
    (set! call-began began)
    (with-exception-handler
        (lambda (exception)
          (set! call-began #f)
          (set! outcome (judge-error form exception))
          (unless (ends-midway? form before-steps)
            (judge-state form before dive)))
      (lambda ()
        (call-with-values (cdr call)
          (lambda values
            (set! call-began #f)
            (for-each judge-value values)
            (when (eq? 'what-if (head-of form))
              (judge-state form before dive))
            (set! outcome values)
            (when (= 1 (length values))
              (set! results (cons (cons `(result ,(length history)) (car values)) results))))))
      #:unwind? #t)
    (set! call-began #f)
    (let ((took (- (processor-seconds) began)))
      (when trace? (say "trace   ~a s: ~a" took (brief outcome)))
      (when (> took (+ limit 0.5))
        (finding! (simple-format #f "took ~a s of processor time" took))))))


;;; A sequence, and a run of them: the child.

(define known-worlds (@@ (bight world atlas) known-worlds))
(define type-table (@@ (bight core schema) type-table))

(define (table->list table)
  (hash-map->list cons table))

(define (restore-table! table entries)
  (hash-clear! table)
  (for-each (lambda (entry) (hash-set! table (car entry) (cdr entry))) entries))

(define (enter-something)
  (let ((world (value-of (apply choose (force base-worlds)))))
    (attempt (cons `(enter! ,(car world)) (lambda () (enter! (cdr world)))))))

(define (run-sequence seed n names)
  (reseed! seed n)
  (set! here (cons seed n))
  (set! history '())
  (set! results '())
  (current-dive #f)
  (current-belief #f)
  (make-workshop!)
  (when (chance? 0.9)
    (enter-something))
  (let loop ()
    (when (< (length history) calls-per-sequence)
      (if (and (not (current-dive)) (chance? 0.3))
          (enter-something)
          (attempt (if (chance? 0.08) (a-form names) (a-call names))))
      (loop))))

(define (make-files!)
  ;; What the file names among the values stand for.
  (define (file name . lines)
    (call-with-output-file name
      (lambda (port) (for-each (lambda (line) (display line port) (newline port)) lines))))
  (file "track.csv" "t,x,y,z" "0,0,0,-5" "1,1,0,-5" "2,2,0,-5")
  (file "short.csv" "0 0 0 -5" "1 2")
  (file "words.csv" "nothing here" "is a number")
  (file "world.scm" "(define-world filed \"In a file.\" (rov (named minnow) (at 0 0 -3)))")
  (file "broken.scm" "(define-world filed (rov (at")
  (file "loop.scm" "(car '())")
  (file "empty")
  (mkdir "folder")
  (symlink "/dev/null" "null")
  (symlink "/dev/full" "full"))

(define (enclose!)
  ;; The folder above is ours as well; there lies the logbook: what is logged is no dive of anybody's.
  (setenv "XDG_STATE_HOME" (dirname (getcwd)))
  (unsetenv "BIGHT_LOGBOOK")
  (close-paths! #:but '(".." "/dev/null" "/dev/full") #:programs? #t))

(define (child seed first n bait?)
  (set! enclosed? (enclose!))
  (let ((names (list->vector (append (if bait? (apply append (make-list 10 baits)) '())
                                     (procedures-to-call))))
        (void (%make-void-port "w")))
    (set! report-port (current-output-port))
    (say "pid ~a" (getpid))
    (make-files!)
    (prepare-values!)
    (watch-time!)
    (parameterize ((current-output-port void) (current-error-port void) (current-warning-port void))
      (let ((types (table->list type-table)))
        (do ((i first (+ i 1)))
            ((= i (+ first n)))
          (say "at ~a" i)
          (restore-table! type-table types)
          (hash-clear! known-worlds)
          (run-sequence seed i names))))
    (say "done ~a ~a" calls findings)))


;;; The parent.

(define patience 30)                    ; seconds of silence that mean a hang

(define (remove-tree path)
  (if (eq? 'directory (stat:type (lstat path)))
      (begin
        (chmod path #o700)
        (let ((port (opendir path)))
          (let loop ((entry (readdir port)))
            (unless (eof-object? entry)
              (unless (member entry '("." ".."))
                (remove-tree (string-append path "/" entry)))
              (loop (readdir port))))
          (closedir port))
        (rmdir path))
      (delete-file path)))

(define (call-in-scratch procedure)
  ;; Call PROCEDURE in a new folder, two deep, so that ".." is ours as well.
  (let ((home (getcwd))
        (folder (mkdtemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-fuzz-XXXXXX"))))
    (dynamic-wind
      (lambda ()
        (mkdir (string-append folder "/work"))
        (chdir (string-append folder "/work")))
      procedure
      (lambda ()
        (chdir home)
        (remove-tree folder)))))

(define (start program arguments)
  ;; Start PROGRAM: its process and a port on what it says.
  (let* ((ends (pipe))
         (pid (primitive-fork)))
    (when (zero? pid)
      (close-port (car ends))
      (move->fdes (cdr ends) 1)
      (apply execlp program program arguments))
    (close-port (cdr ends))
    (cons pid (car ends))))

(define ticks-per-second 100)           ; of /proc, on every Linux

(define (usage pid)
  ;; What process PID is at, a letter, and the seconds of processor time it has used.
  (let* ((line (call-with-input-file (simple-format #f "/proc/~a/stat" pid) read-line))
         (fields (string-split (string-drop line (+ 2 (string-rindex line #\)))) #\space)))
    (cons (car fields)
          (/ (+ (string->number (list-ref fields 11)) (string->number (list-ref fields 12)))
             (exact->inexact ticks-per-second)))))

(define (next-line child)
  ;; The next line of CHILD; or, after a long silence, what it was at.  On a busy machine a child may be
  ;; silent for long: it is waited for while it gets on, and has not used as much time as it may.
  (let* ((pid (car child)) (port (cdr child)) (began (cdr (usage pid))))
    (let wait ((before began))
      (if (or (char-ready? port) (pair? (car (select (list port) '() '() patience))))
          (read-line port)
          (let* ((now (usage pid)) (used (- (cdr now) began)))
            (if (< before (cdr now) (+ began patience))
                (wait (cdr now))
                (list (car now) used)))))))

(define (watch file seed first n more)
  "Run N sequences from FIRST in a child and tell what it found.  Return the sequence it was in at its
end (#f if it came to the end), and the counts of calls and findings."
  (call-in-scratch
   (lambda ()
     (let* ((child (start "bight"
                          (append (list file "--child" "--seed" seed "--first" (number->string first)
                                        "--sequences" (number->string n))
                                  more)))
            (port (cdr child)))
       (let loop ((at first) (done #f) (found 0))
         (let* ((line (next-line child))
                (word (and (string? line) (car (string-split line #\space))))
                (rest (if word (string-drop line (min (string-length line) (+ 1 (string-length word)))) "")))
           (cond ((eof-object? line)
                  (let ((status (cdr (waitpid (car child)))))
                    (if (and done (eqv? 0 (status:exit-val status)))
                        (list #f done found)
                        (list at (simple-format #f "ended with ~a"
                                                (if (status:term-sig status)
                                                    (simple-format #f "signal ~a" (status:term-sig status))
                                                    (simple-format #f "status ~a" (status:exit-val status))))
                              found))))
                 ((pair? line)
                  (kill (car child) SIGKILL)
                  (waitpid (car child))
                  (list at
                        (simple-format #f "was silent, in state ~a after ~a s, and had to be killed"
                                       (car line) (cadr line))
                        found))
                 ((string=? word "at") (loop (string->number rest) done found))
                 ((string=? word "done")
                  (loop at (string->number (car (string-split rest #\space))) found))
                 ((string=? word "pid") (loop at done found))
                 (else
                  (display line) (newline)
                  (loop at done (if (string=? word "finding") (+ found 1) found))))))))))

(define (parent file seed first n more)
  ;; A child that dies is followed by a trace of the sequence it died in, and by another child.
  (let loop ((first first) (left n) (calls 0) (found 0))
    (let* ((result (watch file seed first left more))
           (at (car result)))
      (cond ((not at)
             (simple-format #t "fuzz: seed ~a: ~a sequences, ~a calls, ~a findings\n" seed n
                            (+ calls (cadr result)) (+ found (caddr result)))
             (exit (if (zero? (+ found (caddr result))) 0 1)))
            (else
             (simple-format #t "finding the process ~a (--seed ~a --first ~a --sequences 1)\n"
                            (cadr result) seed at)
             (unless (member "--trace" more)
               (watch file seed at 1 (cons "--trace" more)))
             (let ((left (- left (+ 1 (- at first)))))
               (if (or (zero? left) (> found 20))
                   (exit 1)
                   (loop (+ at 1) left
                         (+ calls (* calls-per-sequence (- at first)))
                         (+ found 1 (caddr result))))))))))

(define (main arguments)
  (let* ((options (getopt-long arguments '((seed (value #t)) (sequences (value #t)) (first (value #t))
                                           (limit (value #t)) (trace) (bait) (child))))
         (option (lambda (name default) (string->number (option-ref options name default))))
         (seed (option-ref options 'seed "1"))
         (first (option 'first "0"))
         (n (option 'sequences "5000"))
         (program (car arguments)))
    (set! limit (option 'limit "1"))
    (set! trace? (option-ref options 'trace #f))
    (if (option-ref options 'child #f)
        (child seed first n (option-ref options 'bait #f))
        (parent (if (string-prefix? "/" program) program (string-append (getcwd) "/" program))
                seed first n
                (append (list "--limit" (number->string limit))
                        (if trace? '("--trace") '())
                        (if (option-ref options 'bait #f) '("--bait") '()))))))

(main (command-line))
