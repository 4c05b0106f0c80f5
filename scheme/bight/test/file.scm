;;; (bight test file) --- files of scenarios: finding them, loading one, and running what it holds.
;;;
;;; Every file is loaded in a fresh module that has the language.  What is run here runs in a process of
;;; its own, from (bight core crew), and tells of itself in plain data: numbers, strings, lists.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test file)
  #:use-module ((bight shell program) #:select (evaluate-file program-error? program-error-text))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module ((bight core here) #:select (afresh))
  #:use-module (bight core record)
  #:use-module ((bight core folders) #:select (ensure-folder!))
  #:use-module ((bight core fork) #:select (await-signal-thread!))
  #:use-module (bight core told)
  #:use-module (bight dive)
  #:use-module ((bight dive flight) #:select (keep-flight! flown-seconds))
  #:use-module ((bight dive time) #:select (now))
  #:use-module (bight language)
  #:use-module (bight test expect)
  #:use-module ((bight test memory) #:select (flight-file))
  #:use-module (bight test property)
  #:use-module (bight test scenario)
  #:use-module ((bight test trial) #:select (flight-keeper to-the-millisecond))
  #:use-module ((bight view) #:select (look))
  #:use-module (ice-9 ftw)
  #:use-module (srfi srfi-1)
  #:export (files-at
            settings
            settings?
            settings-seed
            settings-cases
            settings-limit
            settings-catalogue
            load-tests
            load-world-tests))

(define-record <settings>
  (settings seed cases limit reproducers catalogue)
  settings?
  (seed settings-seed)
  (cases settings-cases)                ; of every property, or #f: as each says
  (limit settings-limit)                ; s of processor time, or #f
  (reproducers settings-reproducers)    ; a folder, or #f
  (catalogue settings-catalogue))       ; a folder for pictures, or #f: no views are wanted

(document
 (settings "Return how tests are run: the seed, how many cases, the limit, and folders or #f.")
 (settings-seed "Return what random things begin with in SETTINGS.")
 (settings-cases "Return how many cases of every property SETTINGS want, or #f.")
 (settings-limit "Return the limit in seconds of processor time of SETTINGS, or #f.")
 (settings-catalogue "Return the folder for pictures of SETTINGS, or #f."))


;;; Finding the files.

(define (scheme-file? name)
  (and (string-suffix? ".scm" name)
       (not (string-prefix? "." name))))

(define (files-at path)
  "Return the test files that PATH stands for: itself, or all *.scm of a folder, sorted."
  (cond ((not (file-exists? path))
         (bight-raise 'io 'run-tests "there is no file or folder ~s~a" path
                      (file-meant path)))
        ((file-is-directory? path)
         (map (lambda (name) (string-append (string-trim-right path #\/) "/" name))
              (or (scandir path scheme-file? string<?) '())))
        (else (list path))))


;;; Running one scenario.

(define (failure->data failure)
  (list (location->string (failure-location failure))
        (if (eq? (failure-form failure) '...) #f (code->string (failure-form failure)))
        (failure-expected failure)
        (failure-actual failure)
        (or (failure-remarks failure) '())))

(define (outcome->data outcome output view)
  `((status . ,(outcome-status outcome))
    (reason . ,(outcome-reason outcome))
    (claims . ,(outcome-claims outcome))
    (failures . ,(map failure->data (outcome-failures outcome)))
    (seconds . ,(outcome-seconds outcome))
    (output . ,output)
    (view . ,view)))

;; At the limit a timer stops the scenario, between two steps of Scheme; what does not come back from the
;; engine is killed so many seconds later.  (SIGXCPU, which tells of a soft limit, is the collector's.)
(define grace 5)

(define (processor-seconds)
  (let ((times (times)))
    (/ (+ (tms:utime times) (tms:stime times)) internal-time-units-per-second)))

(define (least-of a b)
  ;; Of two limits, each a number or #f for none.
  (cond ((not a) b) ((not b) a) (else (min a b))))

(define (limit-process! seconds)
  ;; A limit that is there already, of a test that runs tests, can only be lowered.
  (call-with-values (lambda () (getrlimit 'cpu))
    (lambda (soft hard)
      (let ((least (least-of hard (inexact->exact (ceiling (+ seconds grace (processor-seconds)))))))
        (setrlimit 'cpu least least)))))

(define (set-timer! seconds)
  (let* ((micros (inexact->exact (round (* 1e6 seconds)))))
    (setitimer ITIMER_PROF 0 0 (quotient micros 1000000) (remainder micros 1000000))))

(define (watch-time! seconds)
  (sigaction SIGPROF
    (lambda (signal)
      (stop-whole-trial! `(run-scenario #:limit ,seconds)
                         (simple-format #f "an end within ~a s of processor time" seconds)
                         "none: it was stopped")))
  (await-signal-thread!)                ; what is tested may fork
  (set-timer! seconds))

(define (picture-of where)
  ;; The present dive as a PNG, if there is a renderer.
  (false-if-exception
   (begin
     ((@ (bight view picture) snapshot) where #:size '(640 360))
     (basename where))))

(define (view-of-dive where)
  ;; (LINES PICTURE) of the present dive, for the catalogue.
  (draw-from-the-cache!)
  (and (current-dive)
       (list (string-split (string-trim-right
                            (or (false-if-exception (simple-format #f "~a" (look #:columns 78))) ""))
                           #\newline)
             (picture-of where))))

(define (file-word label)
  ;; LABEL as part of a file's name.
  (string-map (lambda (c) (if (or (char-alphabetic? c) (char-numeric? c)) c #\-)) label))

(define (keeper-in where)
  ;; A procedure for `flight-keeper': the flight that failed first is kept in the file WHERE.
  (let ((kept #f))
    (lambda ()
      (let ((place (cons (current-dive) (now))))
        (unless kept
          (false-if-exception
           (begin
             (ensure-folder! (dirname where) #o700)
             (keep-flight! where)
             (set! kept place))))
        (and (equal? place kept)
             (simple-format #f "watch it: bight watch ~a --at ~a" where
                            (to-the-millisecond (flown-seconds))))))))

(define (keeper-of scenario file)
  ;; What keeps the flight of SCENARIO, of FILE, should it fail; what was kept of it before is gone.
  (let ((where (flight-file file (scenario-label scenario))))
    (when where
      (false-if-exception (delete-file where)))
    (if (and where (not (scenario-cases scenario))) (keeper-in where) (const #f))))

(define (run-and-tell scenario file settings tell)
  (let* ((outcome #f) (view #f)
         (where (and (settings-catalogue settings)
                     (string-append (settings-catalogue settings) "/"
                                    (file-word (string-append (basename file ".scm") "-"
                                                              (scenario-label scenario)))
                                    ".png")))
         (output (with-output-to-string
                   (lambda ()
                     (parameterize ((epilogue (and where (lambda () (set! view (view-of-dive where)))))
                                    (flight-keeper (keeper-of scenario file)))
                       (set! outcome
                             (call-with-seed (settings-seed settings)
                                             (lambda () (run-scenario scenario)))))))))
    (tell (cons 'outcome (outcome->data outcome output view)))))

(define (run-order found file settings what tell)
  ;; WHAT is (run INDEX FROM END), of a property the cases from FROM to before END; or (show INDEX CASE).
  (let ((scenario (list-ref found (second what))) (limit (settings-limit settings)))
    (define (each-case n)
      (tell (list 'case n))
      (when limit (set-timer! limit)))
    (case (first what)
      ((show)
       (tell (list 'shown (call-with-seed (settings-seed settings)
                                          (lambda () (show-case scenario (third what)))))))
      ((run)
       (when limit
         (watch-time! limit)
         (unless (scenario-cases scenario)
           (limit-process! limit)))
       (call-with-cases (third what) (fourth what) (if (scenario-cases scenario) each-case (const #f))
                        (settings-reproducers settings)
                        (lambda () (run-and-tell scenario file settings tell)))))))


;;; Loading.

;; A process that has threads cannot be forked: nobody would wake the child's locks.  Mesa draws without
;; any when it is told to; a file that draws while it is loaded starts none then.
(define cache-setting (getenv "MESA_SHADER_CACHE_DISABLE"))

(define (draw-without-threads!)
  (setenv "LP_NUM_THREADS" "0")
  (setenv "MESA_SHADER_CACHE_DISABLE" "true"))

;; The picture of the catalogue is the last that a scenario's process does: nothing is forked any more, and what
;; Mesa has compiled for other pictures need not be compiled again.
(define (draw-from-the-cache!)
  (unless cache-setting
    (unsetenv "MESA_SHADER_CACHE_DISABLE")))

(define (load-scenarios file)
  ;; The list of the scenarios of FILE; raise &program-error.
  (collect-scenarios
   (lambda ()
     (afresh (lambda () (call-in-language (lambda () (evaluate-file file))))))))

(define (scenario->data scenario)
  `((label . ,(scenario-label scenario))
    (sentence . ,(scenario-sentence scenario))
    (location . ,(location->string (scenario-location scenario)))
    (cases . ,(scenario-cases scenario))))

(define (offer found file settings tell output)
  (tell (list 'scenarios output (map scenario->data found)))
  (lambda (what tell) (run-order found file settings what tell)))

(define (load-tests settings)
  "Return a procedure for `open-shops' that loads a file and tells (scenarios OUTPUT DATA) or (unreadable
OUTPUT WHY)."
  (lambda (file tell)
    (draw-without-threads!)
    (let* ((found #f) (why #f)
           (output (with-output-to-string
                     (lambda ()
                       (with-exception-handler
                           (lambda (exception)
                             (set! why (if (program-error? exception)
                                           (program-error-text exception)
                                           (exception->line exception))))
                         (lambda () (set! found (load-scenarios file)))
                         #:unwind? #t)))))
      (cond (found (offer found file settings tell output))
            (else
             (tell (list 'unreadable output why))
             #f)))))

(define (world-scenario name)
  (let ((world ((@ (bight world atlas) world-called) 'run-tests name)))
    (make-scenario name (or ((@ (bight world) world-documentation) world) "") '()
                   (lambda () (enter! world)) #f #f)))

(define (load-world-tests settings)
  "Return a procedure for `open-shops' that offers a scenario for each world there is: that it can be
entered."
  (lambda (name tell)
    (offer (map world-scenario ((@ (bight world) worlds))) name settings tell "")))
