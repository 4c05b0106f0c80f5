;;; (bight bench) --- bight bench: the programs that measure, run in rounds and reported.
;;;
;;; Each bench is a program bight-bench-NAME that prints rows of CSV and knows --quick.  Without a name all
;;; families are run in their quick form, one after another and round after round, as many rounds as fit
;;; into the time; so what disturbs the machine for a while disturbs a round of everything, and not all
;;; rounds of one thing.  A name gives the whole of one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench)
  #:use-module (bight bench compare)
  #:use-module ((bight bench in-time) #:select (say-progress))
  #:use-module ((bight bench plot) #:select (plots-of))
  #:use-module (bight bench report)
  #:use-module (bight bench row)
  #:use-module (bight bench validation)
  #:use-module (bight core clock)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core folders) #:select (ensure-folder!))
  #:use-module ((bight engine) #:select (%programs-folder))
  #:use-module ((ice-9 ftw) #:select (scandir))
  #:use-module (ice-9 popen)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (benches bench-command))

(define prefix "bight-bench-")

;; What a report without names is of, in its order; other benches run only by name.
(define families '("statics" "dynamics" "collision" "contact" "dive" "awareness" "render" "startup" "where"
                   "skip" "scale"))

(define (program-of folder name)
  (string-append folder "/" prefix name))

(define (bench-files folder)
  (define (bench-file? file)
    (and (string-prefix? prefix file)
         (not (string-index file #\.))
         (access? (string-append folder "/" file) X_OK)))
  (map (lambda (file) (substring file (string-length prefix)))
       (or (scandir folder bench-file?) '())))

(define (benches)
  "Return the names of the benches there are."
  (sort (append (map first in-the-language) (bench-files (%programs-folder))) string<?))

;; Benches that are no programs, each loaded when it is asked for: name, purpose, and a thunk for what runs it.
(define in-the-language
  `(("belief" "How often beliefs are right, and what they cost." ,(lambda () (@ (bight bench belief) run-belief)))
    ("cases" "How many short dives a second of CPU a sweep flies." ,(lambda () (@ (bight bench cases) run-cases)))
    ("cockpit" "What a frame of the cockpit costs, with a lesson's overlay."
     ,(lambda () (@ (bight bench cockpit) run-cockpit)))
    ("tours" "How often tours come home, how long they are, how soon they are planned."
     ,(lambda () (@ (bight bench tours) run-tours)))))

(define (check-name name)
  (let ((known (benches)))
    (unless (member name known)
      (when (null? (bench-files (%programs-folder)))
        (bight-raise 'unsupported 'bench "there are no programs here that measure (Debian package: bight-bench)"))
      (unknown-name 'bench "the list of benches" name known))))


;;; Running a program.

(define (read-lines port)
  (let loop ((lines '()))
    (let ((line (read-line port)))
      (if (eof-object? line) (reverse lines) (loop (cons line lines))))))

(define (output-of program . arguments)
  ;; Its lines, or #f when it failed.
  (let* ((port (apply open-pipe* OPEN_READ program arguments))
         (lines (read-lines port)))
    (and (eqv? 0 (status:exit-val (close-pipe port)))
         lines)))

(define (csv? lines)
  (and (pair? lines) (string-prefix? "case," (car lines))))

(define (measure folder name arguments)
  ;; The lines that the bench NAME prints.
  (let ((lines (apply output-of (program-of folder name) arguments)))
    (cond ((not lines) (bight-raise 'io 'bench "~a~a failed" prefix name))
          ((null? lines) (bight-raise 'format 'bench "~a~a measured nothing" prefix name))
          (else lines))))

(define (rows-in name lines)
  (unless (csv? lines)
    (bight-raise 'format 'bench "~a~a printed no rows but ~s" prefix name (car lines)))
  (read-csv lines))

(define (about folder)
  ;; The compiler and its flags, two lines.
  (let ((lines (and (member "statics" (bench-files folder))
                    (output-of (program-of folder "statics") "--about"))))
    (if (and lines (= 2 (length lines))) lines '("compiler not known" ""))))

(define (purpose name)
  ;; The second line of its help.
  (let ((lines (if (assoc name in-the-language)
                   (assoc name in-the-language)
                   (or (output-of (program-of (%programs-folder) name) "--help") '()))))
    (if (> (length lines) 1) (second lines) "")))

(define (list-benches)
  (for-each (lambda (name)
              (simple-format #t "~a ~a ~a~%" (string-pad-right name 12)
                             (if (member name families) "*" " ") (purpose name)))
            (benches))
  (display "* in the report of bight bench without a name\n")
  0)


;;; Rounds.

(define (minutes-and-seconds seconds)
  (let ((s (inexact->exact (round seconds))))
    (simple-format #f "~a:~a" (quotient s 60) (string-pad (number->string (remainder s 60)) 2 #\0))))

(define (rows-or-none folder name arguments)
  ;; One bench that fails does not take the others' minutes with it; the status tells.
  (with-exception-handler
      (lambda (e)
        (unless (bight-error? e) (raise-exception e))
        (simple-format (current-error-port) "bight: left out: ~a~%" (bight-error-message e))
        '())
    (lambda () (rows-in name (measure folder name arguments)))
    #:unwind? #t))

(define (run-round folder names arguments begun round)
  ;; An alist of NAMES and their rows.
  (map (lambda (name)
         (say-progress "~a, round ~a: ~a" (minutes-and-seconds (- (clock) begun)) round name)
         (cons name (rows-or-none folder name arguments)))
       names))

(define (run-rounds run-one least most seconds)
  ;; What RUN-ONE returns for rounds 1, 2 ...: LEAST of them, and on to MOST while the next one fits into
  ;; SECONDS.
  (let ((begun (clock)))
    (let loop ((k 1) (done '()))
      (let* ((started (clock))
             (done (cons (run-one k begun) done))
             (now (clock)))
        (if (and (< k most)
                 (or (< k least) (< (+ (- now begun) (- now started)) seconds)))
            (loop (+ k 1) done)
            (begin
              (say-progress "")
              (reverse done)))))))

(define (make-report-of surroundings form rounds)
  (make-report form (length rounds) surroundings (gather-rows rounds)))

(define (surroundings folder)
  ;; As they are before the machine is busy with us.
  (apply environment (about folder)))

(define (run-report plan)
  ;; The report that PLAN asks for.
  (let* ((folder (%programs-folder)) (where (surroundings folder)))
    (make-report-of where (plan-form plan)
                    (run-rounds (lambda (k begun)
                                  (run-round folder (plan-ref plan 'names) (plan-ref plan 'arguments)
                                             begun k))
                                (plan-ref plan 'least) (plan-ref plan 'most) (plan-ref plan 'seconds)))))

(define (run-two-reports plan other)
  ;; The reports of the programs in OTHER and of ours, run by turns.
  (let* ((ours (%programs-folder))
         (where (map surroundings (list other ours)))
         (names (filter (lambda (name) (member name (bench-files other))) (plan-ref plan 'names)))
         (run-one (lambda (folder name k begun)
                    (car (run-round folder (list name) (plan-ref plan 'arguments) begun k))))
         (rounds (run-rounds (lambda (k begun)
                               (map (lambda (name)
                                      ;; Who goes first changes from round to round.
                                      (if (even? k)
                                          (let ((new (run-one ours name k begun)))
                                            (cons (run-one other name k begun) new))
                                          (let ((old (run-one other name k begun)))
                                            (cons old (run-one ours name k begun)))))
                                    names))
                             (max 6 (plan-ref plan 'least)) (max 6 (plan-ref plan 'most))
                             (plan-ref plan 'seconds)))
         (report (lambda (where pick)
                   (make-report-of where (plan-form plan)
                                   (map (lambda (round) (map pick round)) rounds)))))
    (values (report (first where) car) (report (second where) cdr))))


;;; The command line.  What is not ours goes to the one bench that is named.

(define ours '("-o" "--rounds" "--minutes" "--compare"))
(define flags '("--quick" "--list"))

;; What follows these of a program's options belongs to them, though a bench may be called so.
(define valued '("--family" "--data" "--log" "--replay"))

(define (plan-ref plan key)
  (assq-ref plan key))

(define (plan-form plan)
  (if (member "--quick" (plan-ref plan 'arguments)) "quick" "whole"))

(define (split-equals argument)
  ;; --NAME=VALUE of ours as (NAME . VALUE), else #f.
  (let ((i (string-index argument #\=)))
    (and i (member (substring argument 0 i) ours)
         (cons (substring argument 0 i) (substring argument (+ i 1))))))

(define (bad text . values)
  (apply bight-raise 'domain 'bench text values))

(define (split-arguments arguments)
  ;; As names, an alist of our options, and what is for a program.
  (let loop ((rest arguments) (names '()) (options '()) (passed '()))
    (cond ((null? rest) (values (reverse names) options (reverse passed)))
          ((member (car rest) flags)
           (loop (cdr rest) names (acons (car rest) #t options) passed))
          ((split-equals (car rest))
           => (lambda (option) (loop (cdr rest) names (cons option options) passed)))
          ((member (car rest) ours)
           (when (null? (cdr rest)) (bad "~a needs a value after it" (car rest)))
           (loop (cddr rest) names (acons (car rest) (cadr rest) options) passed))
          ((and (member (car rest) valued) (pair? (cdr rest)))
           (loop (cddr rest) names options (cons* (cadr rest) (car rest) passed)))
          ((string-prefix? "-" (car rest))
           (call-with-values (lambda () (span option-value? (cdr rest)))
             (lambda (values rest-of)
               (loop rest-of names options (append (reverse (cons (car rest) values)) passed)))))
          (else (loop (cdr rest) (cons (car rest) names) options passed)))))

(define (option->words option)
  ;; OPTION, of ours, as it was written.
  (if (string? (cdr option)) (list (car option) (cdr option)) (list (car option))))

(define (option-value? word)
  ;; Does WORD follow an option rather than name a bench or a file of ours?
  (not (or (string-prefix? "-" word) (member word (benches)))))

(define (number-option options name least)
  (let ((text (assoc-ref options name)))
    (and text
         (let ((x (text->number text)))
           (if (and (real? x) (>= x least)) x (bad "~a takes a number from ~a on, not ~a" name least text))))))

(define (make-plan names options passed)
  ;; What is to be run: an alist.
  (let* ((all? (null? names))
         (names (if (and (equal? names '("where")) (null? passed)) '("where" "skip") names)) ; one page
         (rounds (number-option options "--rounds" 1))
         (quick? (or all? (assoc-ref options "--quick")))
         (minutes (or (number-option options "--minutes" 0.1) 5)))
    `((names . ,(if all? (filter (lambda (name) (member name (benches))) families) names))
      (arguments . ,(append (if quick? '("--quick") '()) passed))
      (least . ,(or rounds (if all? 2 1)))
      (most . ,(or rounds (if (or all? (assoc-ref options "--minutes")) 100 1)))
      (seconds . ,(* 60 minutes)))))

(define (prepare-folder! folder)
  ;; Before minutes are spent on what cannot be kept.
  (catch 'system-error
    (lambda () (ensure-folder! folder))
    (lambda _ (bight-raise 'io 'bench "the folder ~s cannot be made" folder)))
  (unless (and (file-is-directory? folder) (access? folder W_OK))
    (bight-raise 'io 'bench "~s is no folder that can be written to" folder)))

(define (status-of good?)
  (if good? 0 1))

(define (run-and-write plan folder brief?)
  (prepare-folder! folder)
  (let ((report (run-report plan)))
    (write-report folder report)
    (print-head (current-output-port) report)
    (if brief?
        (print-fronts (current-output-port) report)
        (for-each (lambda (bench)
                    (simple-format #t "~%~a~%" bench)
                    (print-bench (current-output-port) report bench))
                  (report-benches report)))
    (simple-format #t "~%All rows and plots: ~a/report.html, .txt, .csv, .json~%" folder)
    (status-of (every (lambda (name) (pair? (rows-of report name))) (plan-ref plan 'names)))))

;; The bench validation has a page of its own, and needs data to be held against.

(define (validation? names)
  (member "validation" names))

(define (check-data arguments)
  ;; Do ARGUMENTS name the folder of the data?
  (let ((folder (let loop ((rest arguments))
                  (cond ((null? rest) #f)
                        ((string-prefix? "--data=" (car rest)) (substring (car rest) 7))
                        ((string=? "--data" (car rest)) (and (pair? (cdr rest)) (cadr rest)))
                        (else (loop (cdr rest)))))))
    (cond ((not folder) (bad "validation needs --data DIR, the folder of the reference data"))
          ((not (file-exists? folder)) (bight-raise 'io 'bench "there is no folder ~s of reference data" folder))
          ((not (file-is-directory? folder)) (bight-raise 'io 'bench "~s is no folder" folder)))))

(define (validate plan folder)
  (prepare-folder! folder)
  (let* ((curves (list "--curves" (string-append folder "/curves.csv")))
         (with-curves (assq-set! (alist-copy plan) 'arguments (append (plan-ref plan 'arguments) curves)))
         (report (run-report with-curves))
         (rows (rows-of report "validation")))
    (when (pair? rows)
      (write-report folder report)
      (write-validation folder report (plots-of rows))
      (simple-format #t "~%The page: ~a/validation.html; all rows: ~a/report.csv, .json~%" folder folder))
    (status-of (pair? rows))))

;; A family of the bench stability is flown in the language; it is loaded when it is asked for.
(define (worlds? names passed)
  (and (equal? names '("stability")) ((@ (bight bench worlds) worlds-asked?) passed)))

;; So is what stands among `in-the-language'.
(define (told-by-itself names)
  (and (= 1 (length names)) (assoc-ref in-the-language (car names))))

(define (words? plan)
  ;; Is the one bench asked for something else than rows?
  (let ((passed (plan-ref plan 'arguments)))
    (and (= 1 (length (plan-ref plan 'names)))
         (any (lambda (word) (member word passed)) '("--help" "--summary" "--about" "--replay")))))

(define (print-words plan)
  (for-each (lambda (line) (display line) (newline))
            (measure (%programs-folder) (car (plan-ref plan 'names)) (plan-ref plan 'arguments)))
  0)

(define (plan-like report names options passed)
  ;; To run again what REPORT is of.
  (make-plan (if (null? names) (report-benches report) names)
             (append (if (equal? "quick" (report-form report)) '(("--quick" . #t)) '())
                     (if (or (assoc "--rounds" options) (assoc "--minutes" options))
                         options
                         (acons "--rounds" (number->string (max 4 (report-rounds report))) options)))
             passed))

(define (compare old files names options passed folder)
  (cond ((pair? files)
         (status-of (compare-reports (read-report old) (read-report (car files)))))
        ((file-is-directory? old)
         (prepare-folder! folder)
         (call-with-values (lambda () (run-two-reports (make-plan names options passed) old))
           (lambda (before now)
             (write-report folder now)
             (status-of (compare-reports before now #:paired? #t)))))
        (else
         (prepare-folder! folder)
         (let* ((before (read-report old)) (now (run-report (plan-like before names options passed))))
           (write-report folder now)
           (status-of (compare-reports before now))))))

(define (bench-command arguments)
  "Do what the command line ARGUMENTS of bight bench, a list of strings, ask for, and return the exit status."
  (call-with-values (lambda () (split-arguments arguments))
    (lambda (words options passed)
      (let* ((old (assoc-ref options "--compare"))
             (folder (or (assoc-ref options "-o") "bight-bench"))
             (file? (lambda (word) (and old (string-suffix? ".json" word))))
             (files (filter file? words))
             (names (remove file? words)))
        (for-each check-name names)
        (when (and old (not (file-exists? old))) (bad "there is no ~a to compare with" old))
        (when (and (pair? passed) (not (= 1 (length names))))
          (bad "there is no option ~a, unless one bench is named that has it~a" (car passed)
               (did-you-mean (car passed) (append ours flags '("--data")))))
        (cond ((assoc-ref options "--list") (list-benches))
              (old (compare old files names options passed folder))
              ((told-by-itself names)
               => (lambda (entry)
                    (((second entry)) (append (append-map option->words options) passed))))
              (else
               (let ((plan (make-plan names options passed)))
                 (cond ((worlds? names passed)
                        ((@ (bight bench worlds) run-worlds)
                         (append (if (assoc-ref options "--quick") '("--quick") '()) passed)))
                       ((words? plan) (print-words plan))
                       ((validation? names)
                        (check-data passed)
                        (validate plan folder))
                       (else (run-and-write plan folder (null? names)))))))))))
