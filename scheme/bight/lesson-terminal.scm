;;; (bight lesson-terminal) --- taking a lesson: a person behind the guide.
;;;
;;; All a pupil does is an input, a datum such as (pass 60), (stick surge 0.25), (form "(run 5)") or
;;; (answer 40), also that time passed.  Inputs go into a journal as they come; since a dive is
;;; deterministic the journal, played again, leads to the same point: so one resumes.  With a terminal
;;; the dive goes on by itself and is flown by keys; with a pipe, or when asked for, lines are typed and
;;; time passes only as they say.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson-terminal)
  #:use-module (bight command)
  #:use-module (bight dive)
  #:use-module (bight errors)
  #:use-module (bight lesson-play)
  #:use-module (bight lesson-score)
  #:use-module (bight lesson-tally)
  #:use-module (bight query)
  #:use-module (bight task)
  #:use-module (bight terminal)
  #:use-module (bight time)
  #:use-module (bight view)
  #:use-module ((bight expect) #:select (exception->line))
  #:use-module ((ice-9 control) #:select (call/ec))
  #:use-module (ice-9 rdelim)
  #:use-module (srfi srfi-1)
  #:export (person-guide))


;;; Inputs: from the journal while there is any, then from the person.

(define replay (make-parameter #f))     ; a variable with the inputs to come, or #f
(define journal (make-parameter noop))  ; called with each new input

;; True while the last input of the journal is done.
(define silent? (make-parameter #f))

(define (replaying?)
  (and (replay) (pair? (variable-ref (replay)))))

(define (quiet?) (or (silent?) (replaying?)))

(define (next-input ask)
  ;; The next input: out of the journal, or what ASK, a thunk, returns.
  ((breathing) #t)
  (if (replaying?)
      (let ((all (variable-ref (replay))))
        (variable-set! (replay) (cdr all))
        (car all))
      (let ((input (ask)))
        (unless (memq (car input) '(form nothing))
          ((journal) input))
        input)))

(define (print . parts)
  (unless (quiet?)
    (for-each display parts)
    (newline)
    (force-output)))


;;; What inputs do.

(define (pupil-module)
  (let ((module (make-fresh-user-module)))
    (module-use! module (resolve-interface '(bight)))
    module))

(define module (make-parameter #f))

(define (evaluate-text text)
  ;; Evaluate the forms in TEXT; return the lines their values print as.
  (call-with-input-string text
    (lambda (port)
      (let loop ((lines '()))
        (let ((form (read port)))
          (if (eof-object? form)
              (reverse lines)
              (let ((value (eval form (module))))
                (loop (if (unspecified? value)
                          lines
                          (append (reverse (string-split (show-value value) #\newline)) lines))))))))))

(define (show-value value)
  (if (picture? value)
      (string-join (picture-lines value) "\n")
      (call-with-output-string (lambda (port) (write value port)))))

(define (steps-now) (inexact->exact (round (/ (now) (time-step)))))

(define (call-for-steps n thunk)
  ;; Call THUNK, but leave it when N steps have passed.
  (let ((end (+ (steps-now) n)))
    (call/ec
     (lambda (leave)
       (let ((watch (lambda () (when (>= (steps-now) end) (leave '())))))
         (dynamic-wind
           (lambda () (add-step-watcher! watch))
           thunk
           (lambda () (remove-step-watcher! watch))))))))

(define (guarded-dive thunk)
  ;; A form may not leave the dive of the lesson.
  (let ((dive (current-dive)))
    (dynamic-wind
      noop
      thunk
      (lambda () (unless (eq? dive (current-dive)) (current-dive dive))))))

(define (catching thunk)
  ;; The lines that THUNK returns, or the line of what it raises.
  (with-exception-handler
      (lambda (e)
        (if (eq? 'quit (exception-kind e))
            '("q leaves the lesson")
            (list (exception->line e))))
    (lambda () (guarded-dive thunk))
    #:unwind? #t))

(define (interrupted? e)
  (and (exception? e) (eq? 'signal (exception-kind e))))

(define (evaluate-noting text)
  ;; Evaluate TEXT; note it in the journal, with how far it came if ^C ended it or the task did.
  (let ((begun (steps-now)) (noted? #f))
    (define (note! input)
      (unless noted?
        (set! noted? #t)
        ((journal) input)))
    (dynamic-wind
      noop
      (lambda ()
        (let ((lines (catching
                      (lambda ()
                        (with-exception-handler
                            (lambda (e)
                              (when (interrupted? e)
                                (note! (list 'broken text (- (steps-now) begun))))
                              (raise-exception e))
                          (lambda () (evaluate-text text)))))))
          (note! (list 'form text))
          lines))
      (lambda () (note! (list 'form text))))))

(define (stick! which by)
  (let* ((names '(surge sway heave yaw))
         (old (list-ref (array->list (sticks)) (list-index (lambda (n) (eq? n which)) names)))
         (new (max -1 (min 1 (/ (round (* 20 (+ old by))) 20)))))
    (case which
      ((surge) (drive! #:surge new))
      ((sway) (drive! #:sway new))
      ((heave) (drive! #:heave new))
      (else (drive! #:yaw new)))))

(define (winch! metres)
  (if (positive? metres) (pay-out! metres) (haul-in! (- metres))))

(define (apply-input! input)
  ;; Do what INPUT says; return lines to show.
  (case (car input)
    ((pass) (run (* (second input) (time-step))) '())
    ((stick) (catching (lambda () (stick! (second input) (third input)) '())))
    ((release) (catching (lambda () (release!) '())))
    ((winch) (catching (lambda () (winch! (second input)) '())))
    ((hint) (if (ask-for-hint!) '() '("There is no further hint.")))
    ((back) (go-back! 10) (list (string-append "Back at " (figure (now)) " s.")))
    ((tell) (tell! 'tender (second input)) '())
    ((form) (if (replaying-form? input)
                (catching (lambda () (evaluate-text (second input))))
                (evaluate-noting (second input))))
    ((broken) (catching (lambda ()
                          (if (positive? (third input))
                              (call-for-steps (third input) (lambda () (evaluate-text (second input))))
                              '()))))
    (else '())))

(define (replaying-form? input) (memq 'again input))


;;; Lines: a pipe, or a terminal whose owner types.

(define (prompt text)
  (unless (replaying?)
    (display text)
    (force-output)))

(define (ask-line text)
  ;; The next line, or an eof object; ^C asks anew.
  (let loop ()
    (prompt text)
    ((breathing) #f)
    (let ((line (with-exception-handler
                    (lambda (e) (if (interrupted? e) #f (raise-exception e)))
                  (lambda () (read-line))
                  #:unwind? #t)))
      ((breathing) #t)
      (cond (line line)
            (else (newline) (loop))))))

(define quit (make-parameter #f))       ; called with nothing: leaves the lesson, which can be resumed

(define line-help
  "  a line is Scheme, as (drive! #:surge 0.5) (run 5), or one of
  h a hint   l look   s status   u back ten seconds   + - one metre of tether out, in
  t TEXT tell the tender   an empty line lets a second pass   q leave, to go on later")

(define (whole-form text)
  ;; TEXT, and further lines while it is an unfinished form.
  (let loop ((text text) (n 0))
    (if (and (< n 50) (unfinished? text))
        (let ((more (ask-line "     > ")))
          (if (eof-object? more) text (loop (string-append text "\n" more) (+ n 1))))
        text)))

(define (unfinished? text)
  (call-with-input-string text
    (lambda (port)
      (catch #t
        (lambda () (let loop () (unless (eof-object? (read port)) (loop))) #f)
        (lambda (key . arguments)
          (and (eq? key 'read-error)
               (string-contains (simple-format #f "~s" arguments) "end of file")
               #t))))))

(define (line->input line)
  (let ((word (string-trim-both line)))
    (cond ((eof-object? line) ((quit)))
          ((string=? word "") (list 'pass 60))
          ((string=? word "h") '(hint))
          ((string=? word "u") '(back))
          ((string=? word "+") '(winch 1))
          ((string=? word "-") '(winch -1))
          ((string=? word "q") ((quit)))
          ((string=? word "l") (print (show-value (look))) '(nothing))
          ((string=? word "s") (print (show-value (status))) '(nothing))
          ((member word '("?" "help")) (print line-help) '(nothing))
          ((string-prefix? "t " word) (list 'tell (substring word 2)))
          (else (list 'form (whole-form line))))))

(define (ask-input)
  (let ((line (ask-line (string-append (figure (now)) " s> "))))
    (if (eof-object? line) ((quit)) (line->input line))))

(define (marked-as-replayed input)
  (if (eq? 'form (car input)) (append input '(again)) input))

(define (catch-up!)
  ;; Do what is left of the journal, and say where that has led.
  (when (replaying?)
    (let loop ()
      (when (replaying?)
        (let* ((last? (null? (cdr (variable-ref (replay)))))
               (input (marked-as-replayed (next-input noop))))
          (parameterize ((silent? #t))
            (apply-input! input))
          (unless last? (loop)))))
    (for-each print (wrap (string-append "TASK: " (task-text)) 78))))

(define (fly-by-lines n seconds)
  (catch-up!)
  (let loop ()
    (for-each print (apply-input! (next-input ask-input)))
    (loop)))


;;; Keys: the dive goes on, ten times a second.

(define frame 6)                        ; steps between looks at the keys
(define key-help
  "w s ahead  a d turn  z c aside  r f up down  space stop  + - tether  : Scheme")
(define more-help
  "h hint  p pause  u back 10 s  t tell tender  v figures  q leave, to go on later")

(define (key->input key)
  ;; The input that KEY stands for, or #f.
  (case key
    ((#\w up) '(stick surge 0.2)) ((#\s down) '(stick surge -0.2))
    ((#\a left) '(stick yaw -0.2)) ((#\d right) '(stick yaw 0.2))
    ((#\z) '(stick sway -0.2)) ((#\c) '(stick sway 0.2))
    ((#\r) '(stick heave 0.2)) ((#\f) '(stick heave -0.2))
    ((#\space) '(release))
    ((#\+ #\=) '(winch 1)) ((#\-) '(winch -1))
    ((#\h) '(hint)) ((#\u) '(back))
    (else #f)))

(define heard '())                      ; what was said last, for the screen

(define (hear! text)
  (set! heard (take (append (reverse (wrap text 78)) heard)
                    (min 6 (+ (length heard) (length (wrap text 78)))))))

(define (wrap text width)
  ;; TEXT as lines of at most WIDTH characters.
  (let loop ((words (string-tokenize text)) (line "") (lines '()))
    (cond ((null? words) (reverse (if (string-null? line) lines (cons line lines))))
          ((string-null? line) (loop (cdr words) (car words) lines))
          ((<= (+ 1 (string-length line) (string-length (car words))) width)
           (loop (cdr words) (string-append line " " (car words)) lines))
          (else (loop (cdr words) (car words) (cons line lines))))))

(define (blank-row? line)
  (string-every (char-set #\space #\|) line))

(define (fitted lines rows)
  ;; LINES of a picture with blank rows left out until there are at most ROWS.
  (let loop ((rest lines) (excess (- (length lines) rows)) (kept '()))
    (cond ((null? rest) (take (reverse kept) (min (length kept) rows)))
          ((and (positive? excess) (blank-row? (car rest))) (loop (cdr rest) (- excess 1) kept))
          (else (loop (cdr rest) excess (cons (car rest) kept))))))

(define (signed x) (string-append (if (negative? x) "" "+") (figure x)))

(define (answer-or-dash thunk)
  (let ((x (with-exception-handler (const #f) thunk #:unwind? #t)))
    (if (real? x) (figure x) "-")))

(define (panel paused?)
  (let ((s (map signed (array->list (sticks)))))
    (list
     (string-append (if paused? "PAUSED  " "") (figure (now)) " s   heading "
                    (answer-or-dash rov-heading) "   depth " (answer-or-dash rov-depth)
                    "   speed " (answer-or-dash rov-speed) "   turns " (answer-or-dash net-turns))
     (string-append "tether " (answer-or-dash tether-length) " m, slack "
                    (answer-or-dash (lambda () (* 100 (slack)))) " %, pull "
                    (answer-or-dash rov-tension) " N   sticks " (string-join s " ")))))

(define (draw-screen! paused?)
  (let* ((size (terminal-size)) (rows (car size)) (columns (cdr size))
         (below (append (panel paused?) (reverse heard) (list key-help more-help)))
         (task (wrap (task-text) (- columns 1)))
         (room (- rows (length below) (length task) 1))
         (picture (if (and (> room 5) (not (eq? 'hard (session-level (this-session 'look)))))
                      (fitted (picture-lines (look #:columns (max 40 (min 160 (- columns 1))))) room)
                      '())))
    (display "\x1b[H")
    (for-each (lambda (line)
                (display (if (> (string-length line) (- columns 1))
                             (substring line 0 (- columns 1))
                             line))
                (display "\x1b[K\r\n"))
              (append task picture below))
    (display "\x1b[J")
    (force-output)))

(define-syntax-rule (in-cooked-mode state body ...)
  (let ((raw (terminal-state)))
    (dynamic-wind
      (lambda () (restore-terminal! state) (display "\x1b[?25h\r\n"))
      (lambda () body ...)
      (lambda () (display "\x1b[?25l") (force-output) (restore-terminal! raw)))))

(define (type-line state text)
  (in-cooked-mode state
    (let ((line (ask-line text)))
      (if (eof-object? line) "" line))))

(define (clock) (/ (get-internal-real-time) (exact->inexact internal-time-units-per-second)))

(define (keys-asker state)
  ;; A procedure that returns the next input of a person at the keys.
  (let ((paused? #f) (due (clock)) (drawn 0.0))
    (define (draw!)
      (set! drawn (clock))
      (draw-screen! paused?))
    (define (resume!) (set! due (clock)))
    (define (typed text make)
      (let ((line (type-line state text)))
        (resume!)
        (if (string-null? (string-trim-both line)) '(nothing) (make line))))
    (define (handle key)
      (cond ((eof-object? key) ((quit)))
            ((memv key '(#\q #\x04)) ((quit)))
            ((memv key '(#\p #\x03)) (set! paused? (not paused?)) (resume!) (draw!) '(nothing))
            ((memv key '(#\: #\())
             (typed (if (eqv? key #\() "scheme> (" "scheme> ")
                    (lambda (line)
                      (list 'form (if (eqv? key #\() (string-append "(" line) line)))))
            ((eqv? key #\t) (typed "to the tender> " (lambda (line) (list 'tell line))))
            ((eqv? key #\v) (for-each hear! (picture-lines (status))) (draw!) '(nothing))
            ((key->input key) => identity)
            (else (hear! (string-append key-help "  " more-help)) '(nothing))))
    (lambda ()
      (when (> (- (clock) drawn) 0.25) (draw!))
      (let ((key (read-key (if paused? 0.25 (max 0.0 (- due (clock)))))))
        (cond (key (handle key))
              (paused? '(nothing))
              (else
               (set! due (max (+ due (* frame (time-step))) (- (clock) 0.5)))
               (list 'pass frame)))))))

(define (fly-by-keys n seconds)
  (let ((state (terminal-state)))
    (catch-up!)
    (call-with-keys
     (lambda ()
       (let ((ask (keys-asker state)))
         (let loop ()
           (for-each hear! (apply-input! (next-input ask)))
           (loop)))))))


;;; Asking and telling.

(define titles
  '((task . "TASK: ") (hint . "Hint: ") (coach . "Coach: ") (fault . "! ") (done . "") (failed . "")
    (right . "Right: ") (wrong . "Not quite: ") (say . "")))

(define (say kind text)
  (let ((line (string-append (or (assq-ref titles kind) "") text)))
    (unless (quiet?)
      (if (eq? kind 'task)
          (set! heard '())              ; the screen has it at the top
          (hear! line))
      (unless (and (memq kind '(hint coach fault)) (keys?))
        (newline)
        (for-each (lambda (line) (print line)) (wrap line 78))))))

(define keys? (make-parameter #f))

(define (read-answer text choices)
  ;; The answer in TEXT, or #f if it is none.
  (let ((word (string-trim-both text)))
    (if choices
        (or (find (lambda (c) (string=? word (simple-format #f "~a" c))) choices)
            (let ((begun (filter (lambda (c) (string-prefix? word (simple-format #f "~a" c))) choices)))
              (and (not (string-null? word)) (= 1 (length begun)) (car begun))))
        (let ((n (string->number word)))
          (and (real? n) (finite? n) n)))))

(define (ask-answer question choices)
  (for-each print (wrap (string-append "? " question) 78))
  (let loop ()
    (let ((line (ask-line (if choices
                              (string-append "  " (words->string choices) "> ")
                              "  a number> "))))
      (cond ((eof-object? line) ((quit)))
            ((string=? "q" (string-trim-both line)) ((quit)))
            ((read-answer line choices) => (lambda (answer) (list 'answer answer)))
            (else (print (if choices "  one of these words" "  a number, such as 45") "; q leaves.")
                  (loop))))))

(define (probe question truth choices)
  (second (next-input (lambda () (ask-answer question choices)))))

(define (ask-what-next)
  (print "u go back ten seconds, a begin the task again, e end the lesson, q leave and go on later")
  (let loop ()
    (let* ((line (ask-line "u, a, e or q> "))
           (word (if (eof-object? line) "q" (string-trim-both line))))
      (cond ((string=? word "u") '(failed back))
            ((string=? word "a") '(failed again))
            ((string=? word "e") '(failed end))
            ((string=? word "q") ((quit)))
            (else (loop))))))

(define (failed text)
  (second (next-input ask-what-next)))

(define (picture thunk)
  (unless (replaying?)
    (let ((value (thunk)))
      (print (if (or (picture? value) (not (string? value))) (show-value value) value)))))

(define (wait-for-enter)
  ;; Before the keys take the screen there is time to read.
  (ask-line "(Enter begins) "))

(define (person-guide keep inputs leave by-keys?)
  "Return a guide for a person at standard input and output, and a procedure that calls a thunk as that
guide wants it.  KEEP is called with each input, for a journal; INPUTS are those of a journal to begin
with; LEAVE is called when the person leaves; BY-KEYS? says whether keys are read one by one."
  (define (fly n seconds)
    (if by-keys?
        (begin
          (unless (replaying?) (wait-for-enter))
          (fly-by-keys n seconds))
        (fly-by-lines n seconds)))
  (values (make-guide say picture probe fly failed #t)
          (lambda (thunk)
            (parameterize ((replay (make-variable inputs)) (journal keep) (quit leave)
                           (module (pupil-module)) (keys? by-keys?))
              (thunk)))))
