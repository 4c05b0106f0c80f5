;;; (bight lesson check) --- proving a lesson before a pupil meets it.
;;;
;;; Its own demonstration pilot must pass it, and so must an expert, while a careless one must not: else its
;;; conditions and marks do not tell who has learnt it.  No pilot may break down.  Flown again it must come
;;; out the same to the last bit; each hint must be heard by a pilot who does nothing, and no task may be done
;;; by doing nothing; nothing in it may ask the machine for the time or for chance, and its pilots may not see
;;; what it hides from a pupil.  No text may be shown with a ~a that nothing fills, no row of its score may be named by
;;; code, and no name may be used, in whatever branch, that nobody defines.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson check)
  #:use-module (bight core errors)
  #:use-module ((bight core here) #:select (noting-places))
  #:use-module (bight lesson)
  #:use-module ((bight lesson score) #:select (words-of-measure))
  #:use-module (ice-9 regex)
  #:use-module (srfi srfi-1)
  #:export (check-lesson
            demonstration
            file-words))

;; What depends on the machine rather than on the dive.
(define machine-words
  '(current-time gettimeofday get-internal-real-time get-internal-run-time times localtime gmtime
    strftime random random-state-from-platform sleep usleep getpid getenv system))

;; What is random in a lesson must not decide it.
(define seeds '(1 2))

(define (demonstration lesson)
  "Return the name of the pilot who shows LESSON: `demonstration', `expert', or the first."
  (let ((names (lesson-pilots lesson)))
    (cond ((memq 'demonstration names) 'demonstration)
          ((memq 'expert names) 'expert)
          ((pair? names) (car names))
          (else (bight-raise 'def 'lesson
                             "the lesson ~a has no pilot to show it: say (pilot expert \"...\" (flies ...))"
                             (lesson-name lesson))))))

(define (words-in code)
  ;; All symbols in CODE, a datum.
  (cond ((symbol? code) (list code))
        ((pair? code) (append (words-in (car code)) (words-in (cdr code))))
        (else '())))

(define (file-words file)
  "Return all symbols in the forms of FILE."
  (call-with-input-file file
    (lambda (port)
      (let loop ((all '()))
        (let ((form (read port)))
          (if (eof-object? form)
              (delete-duplicates all eq?)
              (loop (append (words-in form) all))))))))

(define (clauses-in kind code)
  ;; All lists in CODE that begin with KIND.
  (cond ((not (pair? code)) '())
        ((and (eq? kind (car code)) (list? code)) (list code))
        (else (append (clauses-in kind (car code)) (clauses-in kind (cdr code))))))

(define (hints-of lesson)
  (filter-map (lambda (c) (and (<= 3 (length c)) (third c)))
              (clauses-in 'hint-after (lesson-code lesson))))

(define (fly lesson idle)
  (take-lesson lesson (scripted-guide (pilot-named lesson (demonstration lesson)) #:idle-in idle)
               #:who (demonstration lesson) #:seed (car seeds)))

(define (texts kind report)
  (filter-map (lambda (line) (and (eq? kind (second line)) (third line))) (report-said report)))

(define (tasks-of report)
  (length (texts 'task report)))

(define (check-demonstration report)
  (if (report-passed? report)
      '()
      (list (string-append "its demonstration does not pass it:\n" (report-text report)))))

(define (check-same report again)
  (if (and (equal? (report-said report) (report-said again))
           (equal? (report-hash report) (report-hash again))
           (equal? (report-marks report) (report-marks again)))
      '()
      '("flown twice, it does not come out the same")))

(define (idle-reports lesson report)
  (map (lambda (n) (fly lesson n)) (iota (tasks-of report) 1)))

(define (check-hints lesson report idles)
  (let ((heard (append-map (lambda (r) (texts 'hint r)) (cons report idles))))
    (map (lambda (hint) (string-append "nobody can hear the hint: " hint))
         (remove (lambda (hint) (any (lambda (text) (string-prefix? hint text)) heard)) (hints-of lesson)))))

(define (check-idle idles)
  (filter-map (lambda (report n)
                (and (> (length (texts 'task report)) n)
                     (simple-format #f "task ~a is done by doing nothing" n)))
              idles (iota (length idles) 1)))

(define (report-of lesson name seed)
  ;; How the pilot NAME flies LESSON, or the sentence that tells why it cannot.
  (with-exception-handler
      (lambda (e)
        (if (memq (exception-kind e) '(quit signal))
            (raise-exception e)
            (simple-format #f "its pilot ~a breaks down (seed ~a): ~a" name seed
                           ((module-ref (resolve-interface '(bight core told)) 'exception->placed-line) e))))
    (lambda ()
      (noting-places
       (lambda ()
         (take-lesson lesson (scripted-guide (pilot-named lesson name)) #:who name #:seed seed))))
    #:unwind? #t))

(define (judged-flight lesson name seed shown told)
  ;; What is wrong with that, a sentence, or #f; SHOWN is the report of the demonstration with the first seed.
  (let ((report (if (and (eq? name (report-who shown)) (eqv? seed (report-seed shown)))
                    shown
                    (report-of lesson name seed))))
    (unless (string? report) (told name seed report))
    (cond ((string? report) report)
          ((and (eq? 'careless name) (report-passed? report))
           (simple-format #f "its careless pilot passes it (seed ~a): what it does wrong is not marked:\n~a"
                          seed (report-text report)))
          ((and (memq name '(expert demonstration)) (not (report-passed? report)))
           (simple-format #f "its pilot ~a does not pass it (seed ~a):\n~a" name seed (report-text report)))
          (else #f))))

(define (check-pilots lesson shown told)
  (filter-map (lambda (name) (any (lambda (seed) (judged-flight lesson name seed shown told)) seeds))
              (lesson-pilots lesson)))

(define (check-machine words)
  (map (lambda (word) (simple-format #f "it asks the machine: ~a" word))
       (filter (lambda (word) (memq word machine-words)) words)))

(define (check-hidden lesson)
  (let ((hidden (append-map cdr (clauses-in 'hides (lesson-code lesson))))
        (flown (words-in (clauses-in 'flies (lesson-code lesson)))))
    (map (lambda (verb) (simple-format #f "its pilots see what it hides from the pupil: ~a" verb))
         (filter (lambda (verb) (memq verb flown)) hidden))))

;; Of `simple-format'.  A word may begin with ~, which is about, where no values follow.
(define for-value (make-regexp "~[as]" regexp/icase))
(define left-over (make-regexp "~([as]([^a-z]|$)|[%~])" regexp/icase))

(define (unfilled? text)
  (->bool (regexp-exec left-over text)))

(define (unfilled code)
  ;; The texts in CODE, a datum, with directives of `format' that nothing fills, or with more values than these.
  (cond ((string? code) (if (unfilled? code) (list code) '()))
        ((not (pair? code)) '())
        ((memq (car code) '(format simple-format))
         (append-map unfilled (if (list? code) (remove string? (cdr code)) '())))
        ((and (eq? 'say (car code)) (list? code) (> (length code) 2) (string? (second code)))
         (append (if (= (length (list-matches for-value (second code))) (length (cddr code))) '() (list (second code)))
                 (append-map unfilled (cddr code))))
        (else (append (unfilled (car code)) (unfilled (cdr code))))))

(define (said-unfilled reports)
  ;; What was said in REPORTS with a directive left in it, whoever made it.
  (filter unfilled?
          (append-map (lambda (r) (filter string? (map third (report-said r)))) reports)))

(define (check-texts lesson reports)
  (map (lambda (text) (simple-format #f "the directives of a text and its values are not as many: ~s" text))
       (delete-duplicates (append (unfilled (lesson-code lesson)) (said-unfilled reports)))))

(define (told-in-code row)
  ;; A sentence about ROW, a datum, if a pupil would read code for its name, else #f.
  (and (pair? row) (not (memq #:as row)) (not (words-of-measure (car row)))
       (simple-format #f "a row of the score is told in code; say #:as \"words\" of it: ~s" (car row))))

(define (check-rows lesson)
  (filter-map told-in-code (append-map cdr (clauses-in 'score (lesson-code lesson)))))

(define (check-names unbound)
  (map (lambda (name) (simple-format #f "nobody defines ~a" name)) unbound))

(define* (check-lesson lesson #:optional (words (words-in (lesson-code lesson))) #:key (unbound '()) (told noop))
  "Return what is wrong with LESSON, a list of sentences, empty if it is proved.  WORDS are the symbols of
the file it is in, UNBOUND those of them that it uses and nobody defines.  TOLD is called with each pilot's name, the
seed and the report of that flight."
  (let* ((report (fly lesson #f))
         (again (fly lesson #f))
         (idles (idle-reports lesson report)))
    (append (check-demonstration report)
            (check-pilots lesson report told)
            (check-same report again)
            (check-hints lesson report idles)
            (check-idle idles)
            (check-machine words)
            (check-hidden lesson)
            (check-texts lesson (cons report idles))
            (check-rows lesson)
            (check-names unbound))))
