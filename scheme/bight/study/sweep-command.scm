;;; (bight study sweep-command) --- bight sweep.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-command)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core options) #:select (bad-usage))
  #:use-module ((bight core sqlite) #:select (there?))
  #:use-module (bight study case)
  #:use-module (bight study risk)
  #:use-module (bight study risk-map)
  #:use-module (bight study sweep)
  #:use-module (bight study sweep-file)
  #:use-module (bight study sweep-plan)
  #:use-module (bight study sweep-result)
  #:use-module (bight study sweep-slurm)
  #:use-module ((ice-9 threads) #:select (current-processor-count))
  #:use-module (srfi srfi-1)
  #:export (sweep-command))

(define (complain text . values)
  (force-output)
  (display (string-append "bight: sweep: " (apply simple-format #f text values) "\n")
           (current-error-port)))


;;; What was asked.

(define (option options name) (assoc-ref options name))

(define most-jobs 1024)

(define (whole-number text low high)
  ;; The number that TEXT, a string, is, if it is whole and within bounds, else #f.
  (let ((n (text->number text)))
    (and (exact-integer? n) (<= low n high) n)))

(define (jobs options otherwise)
  (let ((text (option options "-j")))
    (if text
        (or (whole-number text 1 most-jobs)
            (bad-usage "sweep: -j needs how many dives to fly at a time, 1 or more, not ~a" text))
        otherwise)))

(define (seconds-to-wait options)
  (let ((text (option options "--patience")))
    (if text
        (or (whole-number text 0 10000000)
            (bad-usage "sweep: --patience needs seconds, 0 or more, not ~a" text))
        0)))

(define (shard options)
  ;; (I . N), or #f.
  (let ((text (option options "--shard")))
    (and text
         (let* ((words (string-split text #\/))
                (n (and (= 2 (length words)) (whole-number (second words) 1 1000000)))
                (i (and n (whole-number (first words) 1 n))))
           (if i
               (cons i n)
               (bad-usage "sweep: --shard needs I/N, the I-th of N parts, as in --shard 1/8, not ~a"
                          text))))))

(define (result-name file options)
  ;; Where the result of the study in FILE goes: here, under the study's name.
  (let ((part (shard options)))
    (or (option options "-o")
        (string-append (basename file ".scm")
                       (if part (simple-format #f ".~a-of-~a" (car part) (cdr part)) "")
                       ".db"))))

(define (the-one words what)
  (if (= 1 (length words))
      (car words)
      (bad-usage "sweep: name one ~a" what)))


;;; What is found.

(define (call-with-result file proc)
  (let* ((database (open-found file))
         (value (proc database)))
    (close-result! database)
    value))

(define (tell-summary file)
  (let ((rows (call-with-result file risk-summary)))
    (unless (null? rows)
      (print-columns rows))))


;;; Flying.

(define (times n one many)
  (simple-format #f "~a ~a" n (if (= n 1) one many)))

(define (tell-tally result tally)
  (let ((missing (- (tally-cases tally) (tally-done tally) (tally-failed tally))))
    (simple-format #t "~a: ~a: ~a done~a~a (~a now), fingerprint ~a~%" result
                   (times (tally-cases tally) "case" "cases") (tally-done tally)
                   (if (zero? (tally-failed tally)) "" (simple-format #f ", ~a failed" (tally-failed tally)))
                   (if (positive? missing) (simple-format #f ", ~a missing" missing) "")
                   (tally-flown tally) (tally-fingerprint tally))))

(define (status-of tally how-to-go-on)
  ;; The exit status; what is not well is told.
  (cond ((tally-stopped? tally)
         (complain "stopped; ~a goes on" how-to-go-on)
         1)
        ((positive? (tally-failed tally))
         (complain "~a failed; the first, case ~a: ~a" (times (tally-failed tally) "case" "cases")
                   (first (tally-first-failure tally)) (second (tally-first-failure tally)))
         1)
        (else 0)))

(define (same-again word options)
  ;; The command that goes on with this one.
  (string-join
   (append (list "`bight sweep" word)
           (append-map (lambda (name)
                         (let ((value (option options name)))
                           (cond ((not value) '())
                                 ((string? value) (list name value))
                                 (else (list name)))))
                       '("--slurm" "--tasks" "-j" "-o" "--shard")))
   " " 'infix))

(define (fly word options)
  (let* ((file (study-file word))
         (result (result-name file options))
         (tally (sweep file result (jobs options (current-processor-count)) (shard options)
                       (option options "--again") #:patience (seconds-to-wait options))))
    (tell-tally result tally)
    (tell-summary result)
    (status-of tally (string-append (same-again word options) "'"))))

(define (show-case word options)
  ;; One case, here, with all it prints, and in no result.
  (let* ((study (load-study (study-file word)))
         (number (or (whole-number (option options "--case") 1 (study-cases study))
                     (bad-usage "sweep: --case needs a number from 1 to ~a, not ~a" (study-cases study)
                                (option options "--case")))))
    (for-each (lambda (entry)
                (if (eq? 'legs (car entry))
                    (for-each (lambda (leg) (simple-format #t "leg ~a: ~s~%" (car leg) (cdr leg)))
                              (cdr entry))
                    (simple-format #t "~a: ~s~%" (car entry) (cdr entry))))
              (run-case study number))
    0))

(define (merge words options)
  (when (or (null? words) (null? (cdr words)))
    (bad-usage "sweep: say what goes into which, as in bight sweep --merge RESULT.db SHARD.db ..."))
  (let ((tally (merge-shards (car words) (cdr words))))
    (tell-tally (car words) tally)
    (tell-summary (car words))
    (status-of tally "the same")))


;;; With Slurm.

(define (tasks options)
  (let ((text (option options "--tasks")))
    (and text
         (or (whole-number text 1 100000)
             (bad-usage "sweep: --tasks needs how many parts to fly, 1 or more, not ~a" text)))))

(define (tell-submission result submission)
  (let ((jobs (string-join (submission-jobs submission) " and ")) (n (submission-parts submission)))
    (cond ((null? (submission-jobs submission)))
          ((null? (submission-begun submission))
           (simple-format #t "~a: jobs ~a are under way~%" result jobs))
          (else
           (simple-format #t "~a: jobs ~a fly ~a ~a of ~a and put them together~%" result jobs
                          (if (= 1 (length (submission-begun submission))) "part" "parts")
                          (ranges (submission-begun submission)) n)))
    (force-output)))

(define (status-of-jobs result submission word options)
  ;; Wait for the jobs of SUBMISSION; the exit status.
  (call-with-values
      (lambda () (follow-sweep result submission (lambda () (tell-submission result submission))))
    (lambda (tally lacking)
      (define again (string-append (same-again word options) "'"))
      (cond ((not tally)
             (complain "jobs ~a go on without us: `scancel' ends them, ~a looks at them again"
                       (string-join (submission-jobs submission) " and ") again)
             1)
            (else
             (tell-tally result tally)
             (tell-summary result)
             (unless (null? lacking)
               (complain "of ~a parts ~a lack something (what was said is in ~a and so on); ~a flies that"
                         (submission-parts submission) (ranges lacking)
                         (part-log result (first lacking) (submission-parts submission)) again))
             (max (status-of tally again) (if (null? lacking) 0 1)))))))

(define (fly-with-slurm word options)
  (when (option options "--shard")
    (bad-usage "sweep: --slurm makes the shards itself: say how many with --tasks, not --shard"))
  (let* ((file (study-file word))
         (result (result-name file options))
         (submission (submit-sweep file result (jobs options 1) (tasks options) (option options "--again")
                                   (string-tokenize (or (option options "--sbatch") "")))))
    (if (and (option options "--detach") (pair? (submission-jobs submission)))
        (begin
          (tell-submission result submission)
          0)
        (status-of-jobs result submission word options))))


;;; Looking.

(define (print-rows rows csv?)
  (if csv? (print-csv rows) (print-columns rows)))

(define (table file options)
  (print-rows (call-with-result file
                (lambda (database) (risk-table database (option options "--by") (option options "--csv"))))
              (option options "--csv"))
  0)

(define (cell value)
  (cond ((not value) "")
        ((number? value) (number->string value))
        (else value)))

(define (rows file options)
  (print-csv
   (call-with-result file
     (lambda (database)
       (let ((plan (found-plan database)))
         (cons (append '("number" "status" "error" "message")
                       (map symbol->string
                            (append (plan-fact plan 'variables) (plan-fact plan 'measures))))
               (map (lambda (row) (map cell row)) (case-rows database plan)))))))
  0)

(define (draw-map file options)
  (let ((map-of (call-with-result file
                  (lambda (database)
                    (risk-map database
                              (and=> (option options "--of") string->symbol)
                              (option options "--by"))))))
    (if (option options "-o")
        (simple-format #t "~a, ~a bytes~%" (option options "-o")
                       (draw-risk-map map-of (option options "-o")))
        (print-rows (risk-map-cells map-of (option options "--csv")) (option options "--csv"))))
  0)


;;; Choosing.

(define modes
  `(("--merge" . ,merge)
    ("--table" . ,(lambda (words options) (table (the-one words "result, a .db") options)))
    ("--rows" . ,(lambda (words options) (rows (the-one words "result, a .db") options)))
    ("--map" . ,(lambda (words options) (draw-map (the-one words "result, a .db") options)))))

(define (sweep-command words options)
  "Do what `bight sweep' asks with WORDS and OPTIONS, an alist; return the exit status."
  (let ((asked (filter (lambda (mode) (option options (car mode))) modes)))
    (when (> (length asked) 1)
      (bad-usage "sweep: ~a and ~a are two things: ask for one" (car (first asked)) (car (second asked))))
    (cond ((option options "--case")
           (show-case (the-one words "study, as in bight sweep STUDY.scm --case 1") options))
          ((not there?)
           (bight-raise 'unsupported 'sweep
                        "this bight was built without SQLite (Debian package: libsqlite3-dev)"))
          ((pair? asked) ((cdr (first asked)) words options))
          ((option options "--slurm")
           (fly-with-slurm (the-one words "study, as in bight sweep STUDY.scm --slurm") options))
          (else (fly (the-one words "study, as in bight sweep STUDY.scm") options)))))
