;;; (bight test command) --- running files of scenarios: `bight test' and (run-tests).
;;;
;;; The files are loaded and run in processes of their own, several at a time; the report comes in the order
;;; of the files whatever ends first.  What goes wrong never passes in silence: a file that cannot be loaded
;;; or holds no scenario, a process that died or was late, and a choice that leaves nothing to run, are
;;; failures of their own.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test command)
  #:use-module (bight core crew)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight test again)
  #:use-module (bight test entry)
  #:use-module (bight test file)
  #:use-module (bight test memory)
  #:use-module ((bight test reproducer) #:select (make-folder))
  #:use-module (bight test tap)
  #:use-module ((ice-9 threads) #:select (current-processor-count))
  #:use-module (srfi srfi-1)
  #:export (run-tests
            test-command))


;;; Loading.

(define (batch file told settings)
  ;; The entries of FILE, whose shop TOLD so.
  (define (only-failure sentence . details)
    (list (settled-entry (apply failed-point file sentence details))))
  (case (car told)
    ((scenarios)
     (print-comments (output-lines (second told)))
     (if (null? (third told))
         (only-failure "holds no scenario")
         (map (lambda (data index) (scenario-entry file index data (settings-cases settings)))
              (third told) (iota (length (third told))))))
    ((unreadable)
     (print-comments (output-lines (second told)))
     (only-failure "could not load" (third told)))
    (else (only-failure "could not load" (ending->string told settings)))))

(define (load-all crew paths wanted? settings)
  ;; The entries of all files of PATHS that are WANTED?.
  (let* ((groups (map (lambda (path) (cons path (files-at path))) paths))
         (files (filter wanted? (delete-duplicates (append-map cdr groups))))
         (batches (map (lambda (file told) (batch file told settings))
                       files (open-shops crew files (load-tests settings)))))
    (append (append-map (lambda (group)
                          (if (null? (cdr group))
                              (list (settled-entry (failed-point (car group) "holds no *.scm file")))
                              '()))
                        groups)
            (concatenate batches))))

(define (load-worlds crew settings)
  (let ((told (car (open-shops crew '("worlds") (load-world-tests settings)))))
    (batch "worlds" told settings)))


;;; Choosing.

(define (words->match text)
  ;; A predicate of entries for TEXT, words with `and', `or' and `not' between them: those whose file, name or
  ;; sentence has them.
  (define (has? entry word)
    (string-contains-ci (string-append (entry-file entry) " " (known entry 'label) " " (known entry 'sentence))
                        word))
  (define (split words at)
    (call-with-values (lambda () (break (lambda (word) (string-ci=? at word)) words))
      (lambda (before after) (if (null? after) (list before) (cons before (split (cdr after) at))))))
  (define (all? entry words)
    (let loop ((rest (delete "and" words)))
      (cond ((null? rest) #t)
            ((and (string-ci=? "not" (car rest)) (pair? (cdr rest)))
             (and (not (has? entry (cadr rest))) (loop (cddr rest))))
            (else (and (has? entry (car rest)) (loop (cdr rest)))))))
  (let ((ways (split (string-tokenize text) "or")))
    (lambda (entry) (any (lambda (words) (all? entry words)) ways))))

(define (chooser only match failed?)
  ;; A predicate of entries: the regular expression ONLY, the words MATCH, and, if FAILED?, the last run.
  (let ((by-words (if match (words->match match) (const #t))))
    (lambda (entry)
      (and (or (not only) (regexp-exec only (known entry 'label)))
           (by-words entry)
           (or (not failed?)
               (let ((failed (failed-before (entry-file entry))))
                 (or (member #f failed) (member (known entry 'label) failed))))))))

(define (choose wanted? all? entries)
  ;; Those of ENTRIES alone that are WANTED?; what failed to load stays.  ALL? says that nothing was asked for.
  (let ((chosen (filter (lambda (entry) (or (entry-point entry) (wanted? entry))) entries)))
    (if (and (not all?) (null? chosen))
        (list (settled-entry (failed-point "tests" "no scenario has a name that was asked for")))
        chosen)))

(define (print-list entries)
  (for-each (lambda (entry)
              (if (entry-point entry)
                  (simple-format #t "~a: ~a: ~a~%" (point-file (entry-point entry))
                                 (point-sentence (entry-point entry))
                                 (string-join (point-details (entry-point entry)) " "))
                  (simple-format #t "~a: ~a~a: ~a~%" (known entry 'location) (known entry 'label)
                                 (if (known entry 'cases)
                                     (simple-format #f " (~a cases)" (known entry 'cases))
                                     "")
                                 (string-join (string-tokenize (known entry 'sentence)) " "))))
            entries))


;;; Running.

(define (order entry part)
  (list (entry-file entry) (list 'run (entry-index entry) (part-from part) (part-end part)) entry part))

(define (lost-case entry)
  ;; The part of ENTRY, a property, that died in a case, if that is what will be told of it.
  (let ((part (find bad-part? (entry-parts entry))))
    (and part (not (part-outcome part)) (part-case part) (known entry 'cases) part)))

(define (show-lost-case crew entry)
  ;; The lines of the case in which a process died.
  (let ((part (lost-case entry)) (shown '()))
    (when part
      (do-orders crew
                 (list (list (entry-file entry) (list 'show (entry-index entry) (part-case part))))
                 (lambda (order told)
                   (when (eq? 'shown (car told)) (set! shown (second told))))))
    shown))

(define (note-told! part told)
  (case (car told)
    ((case) (set-part-case! part (second told)))
    ((outcome) (set-part-outcome! part (cdr told)))
    (else (set-part-ended! part told))))

(define (run-all crew entries settings report)
  ;; Run what is not settled; REPORT each entry, in order, as soon as it and all before it are.
  (let ((waiting entries))
    (define (report-those-ready!)
      (when (and (pair? waiting)
                 (or (entry-point (car waiting))
                     (and (every part-ended (entry-parts (car waiting)))
                          (not (lost-case (car waiting))))))
        (unless (entry-point (car waiting))
          (set-entry-point! (car waiting) (entry->point (car waiting) '() settings)))
        (report (car waiting))
        (set! waiting (cdr waiting))
        (report-those-ready!)))
    (define (heard order told)
      (note-told! (fourth order) told)
      (when (part-ended (fourth order)) (report-those-ready!)))
    (report-those-ready!)
    (do-orders crew
               (append-map (lambda (entry)
                             (if (entry-point entry)
                                 '()
                                 (map (lambda (part) (order entry part)) (entry-parts entry))))
                           entries)
               heard)
    ;; What died in a case is asked for that case when nothing else runs any more.
    (for-each (lambda (entry)
                (unless (entry-point entry)
                  (set-entry-point! entry
                                    (entry->point entry (show-lost-case crew entry) settings)))
                (report entry))
              waiting)))

(define (not-run entry)
  ;; What became of ENTRY, which comes after a failure.
  (make-point (entry-file entry) (known entry 'label) (known entry 'sentence) (known entry 'location)
              'skip "not run: one before it failed" '() 0. #f))

(define (failed? entry)
  (eq? 'fail (point-status (entry-point entry))))

(define (run-to-failure crew entries settings report at-once)
  ;; Run ENTRIES, so many AT-ONCE, until some failed; REPORT all.
  (let loop ((rest entries))
    (unless (null? rest)
      (let* ((n (min at-once (length rest))) (now (take rest n)) (later (drop rest n)))
        (run-all crew now settings report)
        (if (any failed? now)
            (for-each (lambda (entry)
                        (unless (entry-point entry) (set-entry-point! entry (not-run entry)))
                        (report entry))
                      later)
            (loop later))))))

(define (print-durations points n)
  ;; The N slowest of POINTS.
  (let ((slowest (sort points (lambda (a b) (> (point-seconds a) (point-seconds b))))))
    (print-comments
     (cons "the slowest:"
           (map (lambda (point)
                  (simple-format #f "  ~a s  ~a: ~a"
                                 (string-pad (number->string (/ (round (* 100 (point-seconds point))) 100)) 8)
                                 (point-file point) (or (point-label point) (point-sentence point))))
                (take slowest (min n (length slowest))))))))

(define (run-entries crew entries settings fail-fast at-once durations)
  ;; Run ENTRIES, print each point as it comes, and return the list of points.
  (print-plan (length entries))
  (let* ((number 0)
         (report (lambda (entry)
                   (set! number (+ number 1))
                   (print-point (entry-point entry) number))))
    (if fail-fast
        (run-to-failure crew entries settings report at-once)
        (run-all crew entries settings report)))
  (let ((points (map entry-point entries)))
    (when (positive? durations) (print-durations points durations))
    (print-summary points)
    points))


;;; All together.

(define-argument-type (paths value)
  "a file, a folder or a list of them"
  (cond ((string? value) (list value))
        ((and (pair? value) (list? value) (every string? value)) value)
        (else refused)))

(define-argument-type (regexp value)
  "a regular expression, a string"
  (or (and (string? value)
           (false-if-exception (make-regexp value)))
      refused))

(define (patience limit)
  ;; Real time in which a process says nothing: on a busy machine it may get little of the processor.
  (and limit (+ 300 (* 3 limit))))

(define (show-all folder points)
  (call-with-values (lambda () (partition (lambda (p) (equal? "worlds" (point-file p))) points))
    (lambda (worlds scenarios)
      ((@ (bight test catalogue) write-catalogue) folder worlds scenarios))))

(define (failed-files paths)
  ;; The files of PATHS that had failures the last time.
  (filter (lambda (file) (pair? (failed-before file))) (append-map files-at paths)))

(define-verb (run-tests (paths paths)
                        #:key (junit (or-false string)) (only (or-false regexp)) (match (or-false string))
                        (jobs (at-least 1) (current-processor-count)) (seed count 1)
                        (cases (or-false (at-least 1))) (limit non-negative 600)
                        (reproducers (or-false string)) (catalogue (or-false string)) (list flag #f)
                        (last-failed flag #f) (fail-fast flag #f) (durations count 0))
  "Run the scenarios of PATHS, a file, a folder whose *.scm files are meant, or a list of such, JOBS at a
time, and print what became of them as TAP.  #:junit FILE writes JUnit XML too; #:only RE runs the scenarios
alone whose name matches the regular expression RE, #:match WORDS those whose file, name or sentence has the
words, as in \"bow and not slow\"; #:last-failed #t those that failed when they were last run, or all if none did;
#:fail-fast #t none after one that failed; #:durations N tells the N slowest.  #:seed N is what their random
things begin with; #:cases N tries every property on N cases; LIMIT is how many seconds of processor time a
scenario may take, 0 for no limit; #:reproducers and #:catalogue name folders, for the simplest cases that fail
and for a page that shows all.  With #:list #t nothing is run: the scenarios are listed.  Return #t if nothing
failed."
  (let* ((limit (and (positive? limit) (inexact->exact limit)))
         (settings (settings seed cases limit reproducers catalogue))
         (failed (if last-failed (failed-files paths) '()))
         (wanted? (if (null? failed) (const #t) (lambda (file) (member file failed)))))
    (when catalogue (make-folder catalogue))
    (when (and last-failed (null? failed))
      (print-comments '("nothing failed the last time: all are run")))
    (call-with-crew jobs (patience limit)
      (lambda (crew)
        (let ((entries (choose (chooser only match (pair? failed))
                               (not (or only match (pair? failed)))
                               (append (load-all crew paths wanted? settings)
                                       (if catalogue (load-worlds crew settings) '())))))
          (if list
              (begin (print-list entries) #t)
              (let ((points (run-entries crew entries settings fail-fast jobs durations)))
                (remember-failures! points)
                (when junit (write-junit junit points))
                (when catalogue (show-all catalogue points))
                (zero? (count-of 'fail points)))))))))


;;; The command.

(define (number-of options name)
  ;; The number that the option NAME gives, #f if it is not there.
  (let ((text (assoc-ref options name)))
    (and text
         (or (text->number text)
             (bight-raise 'domain #f "test: ~a needs a number after it, not ~a" name text)))))

(define (keyword-arguments options)
  ;; The arguments of `run-tests' that OPTIONS, an alist, ask for.
  (append-map (lambda (keyword value) (if value (list keyword value) '()))
              '(#:junit #:only #:match #:jobs #:seed #:cases #:limit #:reproducers #:catalogue #:list
                #:last-failed #:fail-fast #:durations)
              (list (assoc-ref options "--junit") (assoc-ref options "--only") (assoc-ref options "-k")
                    (number-of options "-j") (number-of options "--seed")
                    (number-of options "--cases") (number-of options "--limit")
                    (assoc-ref options "--reproducers") (assoc-ref options "--catalogue")
                    (assoc-ref options "--list") (assoc-ref options "--last-failed")
                    (assoc-ref options "--fail-fast") (number-of options "--durations"))))

(define (test-command paths options)
  "Do `bight test PATHS' with OPTIONS, an alist; return the exit status."
  (define (run paths)
    (apply run-tests paths (keyword-arguments options)))
  (cond ((assoc-ref options "--watch") (run-again-and-again paths run))
        ((run paths) 0)
        (else 1)))
