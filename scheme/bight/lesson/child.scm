;;; (bight lesson child) --- the process in which a lesson is taken, proved or shown.
;;;
;;; It tells its parent, through a pipe, lines of data: each input, and the report.  A lesson from outside
;;; is enclosed before it is read.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson child)
  #:use-module (bight cockpit coach)
  #:use-module ((bight core options) #:select (bad-usage))
  #:use-module ((bight cockpit controller) #:select (call-with-controllers))
  #:use-module ((bight cockpit orders) #:select (call-with-desk))
  #:use-module ((bight core errors) #:select (words->string))
  #:use-module (bight core sandbox)
  #:use-module (bight core terminal)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson)
  #:use-module (bight lesson check)
  #:use-module (bight lesson file)
  #:use-module (bight lesson journal)
  #:use-module (bight lesson log)
  #:use-module (bight lesson order)
  #:use-module (bight lesson terminal)
  #:use-module ((bight outlet) #:select (watched?))
  #:use-module (srfi srfi-1)
  #:export (in-child telling))

(define (telling port)
  "Return a procedure that tells the parent behind PORT a datum; without a parent the lesson ends."
  (lambda (datum)
    (catch 'system-error
      (lambda () (write-datum! datum port))
      (lambda arguments (throw 'quit 1)))))

(define (merging-passes tell)
  ;; A keeper of inputs that tells stretches of time as one; called with #f it tells what it still has.
  (let ((steps 0))
    (lambda (input)
      (define (flush!)
        (when (positive? steps)
          (tell (list 'input (list 'pass steps)))
          (set! steps 0)))
      (if (and input (eq? 'pass (car input)))
          (begin
            (set! steps (+ steps (second input)))
            (when (>= steps 60) (flush!)))
          (begin
            (flush!)
            (when input (tell (list 'input input))))))))

(define (report-entry report lesson given)
  `((lesson . ,(lesson-name lesson)) (title . ,(lesson-title lesson))
    (who . ,(who-of given)) (group . ,(option given "--group" #f))
    (seed . ,(seed-of given)) (level . ,(level-of given)) (display . ,(display-of given))
    (total . ,(report-total report)) (passed? . ,(report-passed? report))
    (seconds . ,(report-seconds report)) (hints . ,(report-hints report))
    (rewinds . ,(report-rewinds report))
    (marks . ,(map (lambda (m) (list (first m) (exact->inexact (second m)) (third m) (fourth m)))
                   (report-marks report)))
    (coached . ,(report-coached report))
    (instructed . ,(report-instructed report))))

(define (print-banner lesson order)
  (simple-format #t "~%~a~%~a~%" (lesson-title lesson)
                 (make-string (string-length (lesson-title lesson)) #\=))
  (display "(? tells what may be typed)\n")
  (force-output))

(define (cockpit-wanted? given)
  (and (terminal-state) (watched? (current-output-port))
       (not (option given "--typed" #f))
       (not (member (getenv "TERM") '(#f "" "dumb")))))

(define (competence given)
  ;; What the pupil has shown before: the mean of his last three results.
  (let* ((all (reverse (logged-results (who-of given))))
         (last-three (take all (min 3 (length all)))))
    (if (null? last-three)
        0
        (min 1 (/ (apply + (map (lambda (e) (or (assq-ref e 'total) 0)) last-three))
                  (* 100 (length last-three)))))))

(define (instructor-socket order)
  ;; Where an instructor may connect, or #f if none was asked for.
  (let ((socket (option (order-given order) "--instructor" #f)))
    (when socket
      (cond ((order-outside? order) (bad-usage "lesson: a lesson from outside is enclosed, and lets no instructor in"))
            ((not (cockpit-wanted? (order-given order)))
             (bad-usage "lesson: --instructor is for lessons in the cockpit, at a terminal"))))
    socket))

(define (call-as-asked order thunk)
  ;; Call THUNK with the instructor's socket and the controllers that ORDER asks for.
  (let* ((given (order-given order)) (controller (option given "--controller" #f)))
    (when (and controller (order-outside? order))
      (bad-usage "lesson: a lesson from outside is enclosed, and reads no controllers"))
    (call-with-desk (instructor-socket order)
      (lambda () (call-with-controllers controller (option given "--mapping" #f) thunk)))))

(define (take-by-person lesson order inputs shown-before tell)
  (let* ((given (order-given order))
         (cockpit? (cockpit-wanted? given))
         (keep (merging-passes tell)))
    (define (leave)
      (keep #f)
      (tell '(left))
      (throw 'quit 0))
    (unless cockpit?
      (print-banner lesson order)
      (unless (null? inputs)
        (display "Going on where you left.\n")))
    ;; No graphics library is let into the enclosure of a lesson from outside.
    (call-with-values (lambda () (person-guide keep inputs leave cockpit? #:plain? (order-outside? order)))
      (lambda (guide call)
        (let ((report (call (lambda ()
                              (take-lesson lesson guide #:seed (seed-of given) #:level (level-of given)
                                           #:display (display-of given)
                                           #:coach (and (not (option given "--quiet" #f))
                                                        (make-coach #:competence shown-before)))))))
          (keep #f)
          (newline)
          (display (report-text report))
          (newline)
          report)))))

(define (show-flight lesson given tell)
  ;; Let the lesson's own pilot fly, and print what is said.
  (define (say kind text)
    (simple-format #t "~a: ~a~%" kind text))
  (let* ((name (string->symbol (option given "--pilot" "expert")))
         (report (take-lesson lesson (scripted-guide (pilot-named lesson name) #:say say)
                              #:who name #:seed (seed-of given) #:level (level-of given))))
    (display (report-text report))
    (newline)
    0))

(define (print-flight name seed report)
  (simple-format #t "~a, seed ~a: ~a out of 100, ~a~%" name seed (report-total report)
                 (if (report-passed? report) "passed" "not passed"))
  (force-output))

(define (print-check lesson file trusted?)
  ;; Who is trusted may use more than the language of lessons.
  (let ((wrong (check-lesson lesson (file-words file) #:unbound (if trusted? '() (unbound-inside file))
                             #:told print-flight)))
    (for-each (lambda (text) (simple-format #t "not ok: ~a~%" text)) wrong)
    (if (null? wrong)
        (begin
          (simple-format #t "ok: ~a, ~a: flown by ~a, the same twice, every hint heard~%"
                         (lesson-name lesson) (lesson-title lesson)
                         (words->string (lesson-pilots lesson)))
          0)
        1)))

(define (call-with-interrupts thunk)
  ;; ^C ends what is running, and what was asked is asked again.
  (sigaction SIGINT
    (lambda (signal) (scm-error 'signal #f "interrupted" '() (list signal))))
  (thunk))

(define (in-child order journal tell)
  "Read the lesson and do what ORDER asks, with JOURNAL to begin with; TELL the parent.  Return the
exit status."
  ;; The logbook is read before nothing but the lesson's own can be.
  (define shown-before (competence (order-given order)))
  (when (order-outside? order)
    (enclose! #:reading (readable-paths (order-file order)))
    (breathing breathe!))
  (let* ((given (order-given order))
         (lesson (load-lesson (order-file order)
                              (if (order-outside? order) read-lessons-inside read-lessons))))
    (cond ((option given "--check" #f) (print-check lesson (order-file order) (option given "--trust" #f)))
          ((option given "--pilot" #f) (show-flight lesson given tell))
          (else
           (call-with-interrupts
            (lambda ()
              (let ((report (call-as-asked order
                              (lambda () (take-by-person lesson order journal shown-before tell)))))
                (tell (list 'report (report-entry report lesson given)))
                0)))))))
