;;; (bight study sweep-slurm) --- a study flown as an array of Slurm jobs, and put together by a job that comes after.
;;;
;;; Task I of the array flies the I-th of N parts into a file of its own, RESULT.I-of-N.db without the .db of
;;; RESULT, as `bight sweep --shard I/N' does.  N belongs to the result and is kept beside it, with the numbers
;;; of the jobs, in RESULT.slurm: what is submitted later are those parts that lack something, whatever became
;;; of their tasks.  A task that Slurm starts again, on whatever node, goes on with its file, and waits while
;;; one that was given up for lost still writes it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-slurm)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core errors)
  #:use-module ((bight core programs) #:select (last-line program-output program? temporary-file write-bytes))
  #:use-module (bight core record)
  #:use-module (bight study case)
  #:use-module (bight study sweep)
  #:use-module (bight study sweep-design)
  #:use-module (bight study sweep-file)
  #:use-module (bight study sweep-plan)
  #:use-module (bight study sweep-result)
  #:use-module (bight study sweep-watch)
  #:use-module ((ice-9 textual-ports) #:select (get-string-all))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (submit-sweep
            submission?
            submission-jobs
            submission-parts
            submission-begun
            ranges
            follow-sweep
            part-log))

(define usual-tasks 16)
(define most-tasks 100000)
(define patience 86400)                 ; s that a task waits for another that still writes its part


;;; Files.

(define (without-ending result)
  (if (string-suffix? ".db" result) (string-drop-right result 3) result))

(define (part-file result i n)
  (simple-format #f "~a.~a-of-~a.db" (without-ending result) i n))

(define (part-log result i n)
  "Return the name of the file that holds what was said by the task that flew the part I of N of RESULT."
  (simple-format #f "~a.~a-of-~a.log" (without-ending result) i n))

(define (merge-log result) (string-append (without-ending result) ".merge.log"))


;;; The note beside the result.

(define (note-file result) (string-append (without-ending result) ".slurm"))

(define (job? value)
  (and (string? value) (not (string-null? value)) (string-every char-numeric? value)))

(define (note? datum)
  (and (list? datum) (every pair? datum)
       (let ((parts (assq-ref datum 'parts)) (jobs (assq-ref datum 'jobs)))
         (and (exact-integer? parts) (<= 1 parts most-tasks) (list? jobs) (every job? jobs)))))

(define (read-note result)
  ;; What is noted of RESULT, an alist of parts and jobs, or #f.
  (let ((file (note-file result)))
    (and (file-exists? file)
         (let ((datum (text->datum (call-with-input-file file get-string-all #:encoding "UTF-8"))))
           (if (note? datum)
               datum
               (bight-raise 'format 'sweep "~s is not what a sweep notes of its jobs; move it away" file))))))

(define (write-note! result parts jobs)
  (write-bytes 'sweep
               (string->utf8 (string-append (object->string `((parts . ,parts) (jobs . ,jobs))) "\n"))
               (note-file result)))


;;; Slurm's programs.

(define (check-slurm)
  (for-each (lambda (name)
              (unless (program? name)
                (bight-raise 'unsupported 'sweep "there is no program ~a here: --slurm needs Slurm (Debian \
package: slurm-client)" name)))
            '("sbatch" "squeue")))

(define (said-by program . arguments)
  ;; What PROGRAM wrote, a string; what it complains about is raised.
  (let ((log (temporary-file)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (let ((bytes (apply program-output log program arguments)))
          (if bytes
              (utf8->string bytes)
              (bight-raise 'io 'sweep "~a: ~a" program (or (last-line log) "it failed without a word")))))
      (lambda () (delete-file log)))))

(define (quoted text)
  ;; TEXT as one word of a shell.
  (string-append "'" (string-join (string-split text #\') "'\\''") "'"))

(define (submit options script)
  ;; Submit SCRIPT, lines, with OPTIONS; return the number of the job, a string.
  (let ((file (temporary-file)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (call-with-output-file file
          (lambda (port)
            (for-each (lambda (line) (display line port) (newline port)) (cons "#!/bin/sh" script)))
          #:encoding "UTF-8")
        (let* ((said (apply said-by "sbatch" "--parsable" (append options (list file))))
               (job (car (string-split (string-trim-both said) #\;)))) ; JOB;CLUSTER
          (if (job? job)
              job
              (bight-raise 'io 'sweep "sbatch does not tell the number of a job, but ~s" said))))
      (lambda () (delete-file file)))))

(define (queued jobs)
  ;; The states, strings, of those of JOBS, or of their tasks, that Slurm has not done with.
  (filter-map (lambda (line)
                (let ((words (string-tokenize line)))
                  (and (= 2 (length words)) (member (first words) jobs) (second words))))
              (string-split (said-by "squeue" "--noheader" "--array" "--me" "--format=%F %T") #\newline)))


;;; What is to be submitted.

;; A part is (NUMBER DONE FAILED LACKING?): how many of its cases are done or failed, and whether there is
;; something to fly.
(define part-number first)
(define part-done second)
(define part-failed third)
(define part-lacking? fourth)

(define (call-with-found file proc)
  (let* ((database (open-found file))
         (value (proc database)))
    (close-result! database)
    value))

(define (standing result plan again? i n)
  ;; The part I of N of RESULT as it is now.
  (let ((file (part-file result i n)) (size (shard-size plan (cons i n))))
    (if (and (file-exists? file) (positive? (stat:size (stat file))))
        (call-with-found file
          (lambda (database)
            (let ((theirs (found-plan database)) (counts (count-by-status database)))
              (check-same file plan theirs)
              (let* ((done (or (assoc-ref counts "done") 0))
                     (failed (- (apply + (map cdr counts)) done)))
                (list i done failed
                      (or (not (equal? (plan-fact plan 'design) (plan-fact theirs 'design)))
                          (< (+ done failed) size)
                          (any-interrupted? database)
                          (and again? (positive? failed))))))))
        (list i 0 0 (positive? size)))))

(define (standings result plan again? n)
  (map (lambda (i) (standing result plan again? (+ i 1) n)) (iota n)))

(define (ranges numbers)
  "Return NUMBERS, ascending, as Slurm has them: \"1-3,7\"."
  (define (range->string range)
    (if (= (car range) (cdr range))
        (number->string (car range))
        (simple-format #f "~a-~a" (car range) (cdr range))))
  (string-join
   (map range->string
        (reverse (fold (lambda (n ranges)
                         (if (and (pair? ranges) (= n (+ 1 (cdar ranges))))
                             (cons (cons (caar ranges) n) (cdr ranges))
                             (cons (cons n n) ranges)))
                       '() numbers)))
   ","))

(define (parts-of result note under-way? asked size)
  ;; How many parts RESULT has: as NOTE says if its jobs are UNDER-WAY? or any of its files is there, else as
  ;; ASKED, or the usual number.
  (let* ((noted (and note (assq-ref note 'parts)))
         (begun? (and noted
                      (or under-way?
                          (any (lambda (i) (file-exists? (part-file result (+ i 1) noted))) (iota noted))))))
    (cond ((and begun? asked (not (= asked noted)))
           (bight-raise 'stale 'sweep "~s is being flown in ~a parts: leave --tasks out, or name another result \
with -o" result noted))
          (begun? noted)
          (asked (min asked size))
          (else (min usual-tasks size)))))


;;; Jobs.

(define (program)
  ;; This program, as a job finds it.
  (let ((name (car (program-arguments))))
    (if (string-index name #\/) (canonicalize-path name) "bight")))

(define (escaped name)
  ;; The file NAME as --output has it, where % begins a pattern.
  (string-join (string-split name #\%) "%%"))

(define (common-options name more)
  (append (list (string-append "--job-name=" name) "--requeue" "--open-mode=append") more))

(define (submit-array file result n parts jobs again? more)
  ;; A task for each of PARTS, numbers of the N, JOBS dives at a time each.
  (submit (append (common-options (string-append "bight-" (basename file ".scm")) more)
                  (list (string-append "--array=" (ranges parts))
                        (simple-format #f "--cpus-per-task=~a" jobs)
                        (string-append "--output=" (escaped (without-ending result))
                                       (simple-format #f ".%a-of-~a.log" n))))
          (list (simple-format #f "exec ~a sweep ~a -j ~a --patience ~a~a \\" (quoted (program))
                               (quoted (canonicalize-path file)) jobs patience (if again? " --again" ""))
                (simple-format #f "  -o ~a.\"$SLURM_ARRAY_TASK_ID\"-of-~a.db --shard \"$SLURM_ARRAY_TASK_ID\"/~a"
                               (quoted (without-ending result)) n n))))

(define (submit-merge file result n after more)
  ;; What puts the parts together when the job AFTER is over, however it ended.
  (submit (append (common-options (string-append "bight-" (basename file ".scm") "-merge") more)
                  (list (string-append "--dependency=afterany:" after)
                        (string-append "--output=" (escaped (merge-log result)))))
          (list (simple-format #f "exec ~a sweep --merge ~a ~a.*-of-~a.db" (quoted (program)) (quoted result)
                               (quoted (without-ending result)) n))))

(define-record <submission>
  (make-submission plan parts jobs begun)
  submission?
  (plan submission-plan)
  (parts submission-parts)              ; how many the result has
  (jobs submission-jobs)                ; strings; none when there is nothing to fly
  (begun submission-begun))             ; the numbers of the parts submitted now

(define (submit-all! file result plan n lacking jobs again? more)
  (let ((array (submit-array file result n lacking jobs again? more)))
    (write-note! result n (list array))
    (let ((all (list array (submit-merge file result n array more))))
      (write-note! result n all)
      (make-submission plan n all lacking))))

(define (submit-sweep file result jobs tasks again? more)
  "Submit what RESULT lacks of the study in FILE to Slurm, in TASKS parts (#f for the usual number) each of which
flies JOBS dives at a time, with MORE options of sbatch, strings; what is under way already is not submitted
again.  AGAIN? also flies what failed.  Return a submission."
  (check-slurm)
  (let* ((study (load-study file))
         (plan (plan-of study file #f))
         (note (read-note result))
         (known (if note (assq-ref note 'jobs) '()))
         (under-way? (and (pair? known) (pair? (queued known))))
         (n (parts-of result note under-way? tasks (design-size (study-design study)))))
    (if under-way?
        (make-submission plan n known '())
        (let ((lacking (map part-number (filter part-lacking? (standings result plan again? n)))))
          (if (null? lacking)
              (make-submission plan n '() '())
              (submit-all! file result plan n lacking jobs again? more))))))


;;; Following it.

(define (signs file)
  (define (sign file)
    (let ((s (stat file #f)))
      (and s (list (stat:mtime s) (stat:mtimensec s) (stat:size s)))))
  (list (sign file) (sign (string-append file "-wal"))))

(define (part-looker result plan n)
  ;; A procedure that returns the parts as they are, each looked at anew only if its file has changed.
  (let ((seen (make-hash-table)))
    (lambda ()
      (map (lambda (i)
             (let* ((signs (signs (part-file result i n))) (known (hashv-ref seen i)))
               (if (and known (equal? signs (car known)))
                   (cdr known)
                   (let ((part (standing result plan #f i n)))
                     (hashv-set! seen i (cons signs part))
                     part))))
           (iota n 1)))))

(define (total proc parts) (apply + (map proc parts)))

(define (follow-sweep result submission tell)
  "Call TELL, show how far the jobs of SUBMISSION are, until they are over or ^C is typed, and put together what
is in no result yet.
Return the tally of RESULT and the numbers of the parts that lack something, or #f and none if it was stopped."
  (let* ((plan (submission-plan submission)) (n (submission-parts submission))
         (jobs (submission-jobs submission))
         (look (part-looker result plan n)) (show (progress-shower)))
    (define (wait)
      (cond ((stop-asked?) #f)
            ((null? (queued jobs)) #t)
            (else
             (let ((parts (look)))
               (show (+ (total part-done parts) (total part-failed parts)) (plan-fact plan 'cases)
                     (total part-failed parts)))
             (sleep 2)
             (wait))))
    (let ((over? (call-with-stop
                  (lambda ()
                    (tell)
                    (or (null? jobs) (wait))))))
      (show #f)
      (if over?
          (let ((parts (look)))
            (values (merge-parts result n)
                    (map part-number (filter part-lacking? parts))))
          (values #f '())))))

(define (merge-parts result n)
  (let ((files (filter file-exists? (map (lambda (i) (part-file result i n)) (iota n 1)))))
    (when (null? files)
      (let ((log (find file-exists? (map (lambda (i) (part-log result i n)) (iota n 1)))))
        (bight-raise 'io 'sweep "no task has written a result~a"
                     (if log (simple-format #f "; ~a ends with: ~a" log (or (last-line log) "nothing")) ""))))
    (merge-shards result files)))
