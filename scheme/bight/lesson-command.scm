;;; (bight lesson-command) --- bight lesson, bight lessons.
;;;
;;; A lesson is taken in a process of its own.  The parent only waits: it keeps the journal and the
;;; logbook, gives the terminal back as it was however the child ends, and so is what a lesson from
;;; outside cannot reach.  The child tells it, through a pipe, lines of data: each input, and the report.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson-command)
  #:use-module (bight coach)
  #:use-module (bight errors)
  #:use-module (bight lesson)
  #:use-module (bight lesson-check)
  #:use-module (bight lesson-file)
  #:use-module (bight lesson-log)
  #:use-module (bight lesson-play)
  #:use-module (bight lesson-tally)
  #:use-module (bight lesson-terminal)
  #:use-module (bight record)
  #:use-module (bight sandbox)
  #:use-module (bight terminal)
  #:use-module (srfi srfi-1)
  #:export (is-order?
            lesson-command
            lessons-command))


;;; The command line.

(define (bad-usage text . values)
  (apply bight-raise 'domain #f text values))

(define flags '("--check" "--typed" "--trust" "--fresh" "--quiet" "--csv"))
(define options '("--trainee" "--group" "--seed" "--level" "--pilot"))

(define (split-option word)
  (let ((i (string-index word #\=)))
    (and i (member (substring word 0 i) options)
         (cons (substring word 0 i) (substring word (+ i 1))))))

(define (read-words command words)
  ;; The plain words, and an alist of options; a flag has the value #t.
  (let loop ((rest words) (plain '()) (given '()))
    (cond ((null? rest) (values (reverse plain) given))
          ((member (car rest) flags) (loop (cdr rest) plain (acons (car rest) #t given)))
          ((split-option (car rest)) => (lambda (pair) (loop (cdr rest) plain (cons pair given))))
          ((member (car rest) options)
           (when (null? (cdr rest)) (bad-usage "~a: ~a needs a value after it" command (car rest)))
           (loop (cddr rest) plain (acons (car rest) (cadr rest) given)))
          ((string-prefix? "-" (car rest))
           (let ((near (nearest (car rest) (append flags options))))
             (bad-usage "~a has no option ~a~a" command (car rest)
                        (if near (string-append "; did you mean `" near "'?") ""))))
          (else (loop (cdr rest) (cons (car rest) plain) given)))))

(define (option given name default)
  (or (assoc-ref given name) default))

(define (seed-of given)
  (let ((text (option given "--seed" "1")))
    (or (let ((n (string->number text))) (and (exact-integer? n) n))
        (bad-usage "lesson: --seed needs a whole number, not ~a" text))))

(define (level-of given)
  (let ((level (string->symbol (option given "--level" "normal"))))
    (if (memq level levels)
        level
        (unknown-name 'lesson "a lesson" level levels "level"))))

(define (who-of given)
  (option given "--trainee"
          (or (getenv "BIGHT_TRAINEE") (getenv "LOGNAME") (getenv "USER") "pupil")))

(define (file-like? word)
  (or (string-index word #\/) (string-suffix? ".scm" word)))

(define (absolute file)
  (if (string-prefix? "/" file) file (string-append (getcwd) "/" file)))

(define-record <order>
  (make-order file outside? given)
  is-order?
  (file order-file)
  (outside? order-outside?)             ; it came from outside and is not trusted
  (given order-given))

(define (order-of words given)
  (unless (= 1 (length words))
    (bad-usage "lesson: name one lesson or file, as in bight lesson read-the-bow; `bight lessons' lists them"))
  (let ((word (car words)))
    (if (file-like? word)
        (begin
          (unless (and (file-exists? word) (eq? 'regular (stat:type (stat word))))
            (bad-usage "lesson: there is no file ~s" word))
          (make-order (absolute word) (not (option given "--trust" #f)) given))
        (make-order (lesson-file word) #f given))))


;;; The child.

(define (tell-parent port datum)
  (write datum port)
  (newline port)
  (force-output port))

(define (telling port)
  ;; A procedure that tells the parent a datum; without a parent the lesson ends.
  (lambda (datum)
    (catch 'system-error
      (lambda () (tell-parent port datum))
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
    (seed . ,(seed-of given)) (level . ,(level-of given))
    (total . ,(report-total report)) (passed? . ,(report-passed? report))
    (seconds . ,(report-seconds report)) (hints . ,(report-hints report))
    (rewinds . ,(report-rewinds report))
    (marks . ,(map (lambda (m) (list (first m) (exact->inexact (second m)) (third m) (fourth m)))
                   (report-marks report)))
    (coached . ,(report-coached report))))

(define (print-banner lesson order by-keys?)
  (simple-format #t "~%~a~%~a~%" (lesson-title lesson)
                 (make-string (string-length (lesson-title lesson)) #\=))
  (unless by-keys?
    (display "(? tells what may be typed)\n"))
  (force-output))

(define (competence given)
  ;; What the pupil has shown before: the mean of his last three results.
  (let* ((all (reverse (logged-results (who-of given))))
         (last-three (take all (min 3 (length all)))))
    (if (null? last-three)
        0
        (min 1 (/ (apply + (map (lambda (e) (or (assq-ref e 'total) 0)) last-three))
                  (* 100 (length last-three)))))))

(define (take-by-person lesson order inputs tell)
  (let* ((given (order-given order))
         (by-keys? (and (terminal-state) (isatty? (current-output-port))
                        (not (option given "--typed" #f))
                        (not (equal? "dumb" (getenv "TERM")))))
         (keep (merging-passes tell)))
    (define (leave)
      (keep #f)
      (tell '(left))
      (throw 'quit 0))
    (print-banner lesson order by-keys?)
    (unless (null? inputs)
      (display "Going on where you left.\n"))
    (call-with-values (lambda () (person-guide keep inputs leave by-keys?))
      (lambda (guide call)
        (let ((report (call (lambda ()
                              (take-lesson lesson guide #:seed (seed-of given) #:level (level-of given)
                                           #:coach (and (not (option given "--quiet" #f))
                                                        (make-coach #:competence (competence given))))))))
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

(define (print-check lesson file)
  (let ((wrong (check-lesson lesson (file-words file))))
    (for-each (lambda (text) (simple-format #t "not ok: ~a~%" text)) wrong)
    (if (null? wrong)
        (begin
          (simple-format #t "ok: ~a, ~a: flown by its demonstration, the same twice, every hint heard~%"
                         (lesson-name lesson) (lesson-title lesson))
          0)
        1)))

(define (call-with-interrupts thunk)
  ;; ^C ends what is running, and what was asked is asked again.
  (sigaction SIGINT
    (lambda (signal) (scm-error 'signal #f "interrupted" '() (list signal))))
  (thunk))

(define (in-child order journal tell)
  ;; Read the lesson and do what is asked; return the exit status.
  (when (order-outside? order)
    (enclose!)
    (breathing breathe!))
  (let* ((given (order-given order))
         (lesson (load-lesson (order-file order)
                              (if (order-outside? order) read-lessons-inside read-lessons))))
    (cond ((option given "--check" #f) (print-check lesson (order-file order)))
          ((option given "--pilot" #f) (show-flight lesson given tell))
          (else
           (call-with-interrupts
            (lambda ()
              (let ((report (take-by-person lesson order journal tell)))
                (tell (list 'report (report-entry report lesson given)))
                0)))))))


;;; The journal of a lesson that is not finished, kept by the parent.

(define (ensure-folder! folder)
  (unless (file-exists? folder)
    (ensure-folder! (dirname folder))
    (mkdir folder #o700)))

(define (state-folder)
  ;; By the XDG rules, or #f.
  (let* ((home (getenv "HOME"))
         (state (getenv "XDG_STATE_HOME"))
         (base (cond ((and state (string-prefix? "/" state)) state)
                     (home (string-append home "/.local/state"))
                     (else #f))))
    (and base
         (false-if-exception
          (let ((folder (string-append base "/bight/lessons")))
            (ensure-folder! folder)
            folder)))))

(define (safe-word text)
  (string-map (lambda (c) (if (or (char-alphabetic? c) (char-numeric? c) (memv c '(#\- #\_))) c #\_))
              text))

(define (journal-file order)
  (let ((folder (state-folder)))
    (and folder
         (string-append folder "/" (safe-word (who-of (order-given order))) "-"
                        (safe-word (basename (order-file order) ".scm")) ".journal"))))

(define (header order)
  ;; What must be the same for a journal to fit.
  (list 'lesson (order-file order) (stat:mtime (stat (order-file order)))
        (stat:size (stat (order-file order)))
        (seed-of (order-given order)) (level-of (order-given order))))

(define (read-all file)
  (call-with-input-file file
    (lambda (port)
      (let loop ((all '()))
        (let ((datum (catch 'read-error (lambda () (read port)) (const the-end))))
          (if (eof-object? datum)
              (reverse all)
              (loop (cons datum all))))))))

(define the-end (call-with-input-string "" read))

(define (journal-inputs order)
  ;; The inputs of the journal that fits ORDER, or none.
  (let ((file (journal-file order)))
    (if (and file (file-exists? file) (not (option (order-given order) "--fresh" #f)))
        (let ((all (read-all file)))
          (if (and (pair? all) (equal? (car all) (header order)))
              (cdr all)
              '()))
        '())))

(define (open-journal order inputs)
  ;; A port that goes on with the journal, or begins one; #f if there is no place for it.
  (let ((file (journal-file order)))
    (and file
         (false-if-exception
          (let ((port (open-file file (if (null? inputs) "w" "a"))))
            (when (null? inputs) (tell-parent port (header order)))
            port)))))

(define (drop-journal! order)
  (let ((file (journal-file order)))
    (when (and file (file-exists? file))
      (delete-file file))))


;;; The parent.

(define (note-line! datum order journal)
  ;; DATUM is what the child told.
  (case (and (pair? datum) (car datum))
    ((input) (when journal (tell-parent journal (second datum))))
    ((report)
     (drop-journal! order)
     (log-result! (second datum)))
    (else #f)))

(define (listen port order journal)
  (let loop ()
    (let ((datum (catch #t (lambda () (read port)) (const the-end))))
      (unless (eof-object? datum)
        (note-line! datum order journal)
        (loop)))))

(define (signal-text signal)
  (cond ((eqv? signal SIGPROF)
         (simple-format #f "it took more than ~a s of processor time at one stretch" breath))
        ((memv signal (list SIGABRT SIGSEGV SIGBUS SIGALRM))
         (simple-format #f "it broke down or hung, as one that wants more than ~a megabytes of memory does"
                        (quotient memory-limit (* 1024 1024))))
        ((eqv? signal SIGINT) "it was interrupted")
        (else (simple-format #f "it was ended by signal ~a" signal))))

(define (status->exit status order)
  (let ((signal (status:term-sig status)))
    (if signal
        (begin
          (force-output)
          (simple-format (current-error-port) "bight: lesson: ~a: ~a~%" (order-file order)
                         (signal-text signal))
          1)
        (or (status:exit-val status) 1))))

(define screen-back "\x1b[?25h\x1b[?1049l")

(define (complain exception)
  (force-output)
  (simple-format (current-error-port) "bight: ~a~%"
                 ((module-ref (resolve-interface '(bight expect)) 'exception->line) exception))
  1)

(define (run-child order inputs port)
  ;; In the child, for good.
  (primitive-exit
   (catch 'quit
     (lambda ()
       (with-exception-handler
           (lambda (e)
             (if (eq? 'quit (exception-kind e)) (raise-exception e) (complain e)))
         (lambda ()
           (sigaction SIGPIPE SIG_IGN)
           (in-child order inputs (telling port)))
         #:unwind? #t))
     (lambda (key . arguments)
       (if (and (pair? arguments) (exact-integer? (car arguments))) (car arguments) 0)))))

(define (end-with-child! pid state)
  ;; Whoever ends this process ends the child too, and finds the terminal as it was.
  (for-each (lambda (signal)
              (sigaction signal
                (lambda (signal)
                  (false-if-exception (kill pid SIGKILL))
                  (when state (display screen-back) (force-output))
                  (restore-terminal! state)
                  (primitive-exit (+ 128 signal)))))
            (list SIGTERM SIGHUP)))

(define (wait-for pid order port journal state)
  (sigaction SIGINT SIG_IGN)            ; ^C is for the child
  (end-with-child! pid state)
  (dynamic-wind
    (const #t)
    (lambda () (listen port order journal))
    (lambda ()
      (close-port port)
      (restore-terminal! state)))
  (let ((status (cdr (waitpid pid))))
    (when (and state (status:term-sig status))
      (display screen-back))
    (restore-terminal! state)
    (status->exit status order)))

(define (lesson-command words)
  "Do what `bight lesson WORDS' asks, and return the exit status."
  (call-with-values (lambda () (read-words "lesson" words))
    (lambda (plain given)
      (if (null? plain)
          (lessons-command words)
          (let ((order (order-of plain given)))
            (seed-of given)
            (level-of given)
            (run-order order))))))

(define (personal? order)
  (not (or (option (order-given order) "--check" #f) (option (order-given order) "--pilot" #f))))

(define (run-order order)
  (let* ((inputs (if (personal? order) (journal-inputs order) '()))
         (state (terminal-state))
         (ends (pipe)))
    (force-output)
    (let ((pid (primitive-fork)))
      (if (zero? pid)
          (begin
            (close-port (car ends))
            (run-child order inputs (cdr ends)))
          (begin
            (close-port (cdr ends))
            (wait-for pid order (car ends)
                      (and (personal? order) (open-journal order inputs))
                      state))))))


;;; bight lessons.

(define (best results name)
  ;; The best total among RESULTS in the lesson NAME, or #f.
  (let ((totals (filter-map (lambda (e) (and (eq? name (assq-ref e 'lesson)) (assq-ref e 'total)))
                            results)))
    (and (pair? totals) (apply max totals))))

(define (title-of file)
  ;; The title in FILE, found without running it.
  (call-with-input-file file
    (lambda (port)
      (let loop ()
        (let ((form (read port)))
          (cond ((eof-object? form) "")
                ((and (list? form) (> (length form) 2) (eq? 'define-lesson (car form))
                      (string? (third form)))
                 (third form))
                (else (loop))))))))

(define (begun? file given)
  (let ((journal (journal-file (make-order file #f given))))
    (and journal (file-exists? journal))))

(define (list-lessons given)
  (let ((results (logged-results (who-of given))))
    (for-each
     (lambda (file)
       (let* ((name (lesson-file-name file)) (total (best results name)))
         (simple-format #t "~a  ~a ~a  ~a~%"
                        (substring (basename file) 0 2)
                        (string-pad-right (symbol->string name) 26)
                        (string-pad (cond (total (number->string total))
                                          ((begun? file given) "begun")
                                          (else "-"))
                                    5)
                        (title-of file))))
     (lesson-files))))

(define (results-of given)
  ;; The results that are meant: those of a group, or of one pupil.
  (let ((group (option given "--group" #f)))
    (if group
        (filter (lambda (result) (equal? group (assq-ref result 'group))) (logged-results #f))
        (logged-results (who-of given)))))

(define (list-group given)
  ;; A line for each pupil of the group: the best total of each lesson taken.
  (let* ((results (results-of given))
         (pupils (sort (delete-duplicates (map (lambda (r) (assq-ref r 'who)) results)) string<?)))
    (for-each
     (lambda (who)
       (let ((own (filter (lambda (r) (equal? who (assq-ref r 'who))) results)))
         (simple-format #t "~a ~a~%" (string-pad-right who 16)
                        (string-join
                         (map (lambda (name)
                                (simple-format #f "~a ~a" name (best own name)))
                              (delete-duplicates (map (lambda (r) (assq-ref r 'lesson)) own)))
                         ", "))))
     pupils)))

(define columns '(who group lesson level seed total passed? seconds hints rewinds))

(define (csv-cell value)
  (let ((text (cond ((not value) "") ((eq? value #t) "1") (else (simple-format #f "~a" value)))))
    (if (string-any (char-set #\, #\" #\newline) text)
        (string-append "\"" (string-join (string-split text #\") "\"\"") "\"")
        text)))

(define (list-csv given)
  (simple-format #t "~a~%" (string-join (map symbol->string columns) ","))
  (for-each (lambda (result)
              (simple-format #t "~a~%"
                             (string-join (map (lambda (c) (csv-cell (assq-ref result c))) columns) ",")))
            (results-of given)))

(define (lessons-command words)
  "Do what `bight lessons WORDS' asks, and return the exit status."
  (call-with-values (lambda () (read-words "lessons" words))
    (lambda (plain given)
      (unless (null? plain)
        (bad-usage "lessons: only lists; `bight lesson ~a' takes one" (car plain)))
      (cond ((option given "--csv" #f) (list-csv given))
            ((option given "--group" #f) (list-group given))
            (else (list-lessons given)))
      0)))
