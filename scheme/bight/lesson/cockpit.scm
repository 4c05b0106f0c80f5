;;; (bight lesson cockpit) --- a lesson taken in the cockpit, from its first words to its last task.
;;;
;;; What is said is gathered into pages over the picture; a probe is asked over what the vehicle's own camera
;;; sees, and how it was is shown once that gives nothing away; a task is flown with the keys of free flight.
;;; All that changes the dive is an input, (bight lesson input), so that a lesson can be left and gone on
;;; with: the loop here lets no time pass but by inputs.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson cockpit)
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit hud)
  #:use-module (bight cockpit palette)
  #:use-module (bight cockpit state)
  #:use-module (bight core record)
  #:use-module (bight dive plain-words)
  #:use-module (bight lesson flying)
  #:use-module (bight lesson guide)
  #:use-module (bight lesson how-it-was)
  #:use-module (bight lesson input)
  #:use-module (bight lesson lines)
  #:use-module (bight lesson report)
  #:use-module (bight lesson review)
  #:use-module (bight lesson seat)
  #:use-module (bight view)
  #:use-module (srfi srfi-1)
  #:export (call-in-cockpit say-in-cockpit picture-in-cockpit failed-in-cockpit))

(define* (call-in-cockpit thunk #:key (plain? #f))
  "Call THUNK while a lesson is taken in the cockpit, which takes the terminal and gives it back; PLAIN? wants plain
characters for a picture."
  (let ((c (new-cockpit (this-palette) 'chase 'plain)))
    (when plain? (set-plain! c #t))
    (parameterize ((the-seat (make-seat c '() 'chase '() '() #f '() #f)) (unseen? hidden-in-lesson?) (at-keys? #t))
      (dynamic-wind
        %terminal-enter!
        (lambda ()
          (let ((report (thunk)))
            (read-what-was-said!)
            (when (report? report) (review! report))
            report))
        %terminal-leave!))))


;;; What the guide does.

(define titles
  '((hint . "Hint: ") (coach . "Coach: ") (fault . "! ") (message . "Tender: ") (instructor . "Instructor: ")
    (right . "Right: ") (wrong . "Not quite: ")))

(define inks
  `((hint . ,yellow) (coach . ,yellow) (fault . #xff9060) (message . #xffffff) (instructor . ,yellow)))

(define (say-in-cockpit kind text)
  "Say TEXT of KIND to the pupil: while flying in a line of its own, else on the next page."
  (let* ((seat (the-seat)) (how (seat-pending seat))
         (line (string-append (or (assq-ref titles kind) "") text)))
    (unless (quiet?)
      (case kind
        ((task)
         (set-heard! seat '()))
        ((hint coach fault message instructor)
         (hear! (assq-ref inks kind) line))
        ((right wrong)
         (when how (set-verdict! how (cons line (how-verdict how)))))
        (else (set-texts! seat (cons line (seat-texts seat))))))))

(define (picture-in-cockpit thunk)
  "Show what THUNK returns; the dive itself, where that is all it would draw."
  (unless (replaying?)
    (keep-up!)
    (let* ((seat (the-seat)) (how (seat-pending seat))
           (texts (append (seat-texts seat) (if how (how-verdict how) '()))))
      (set-pending! seat #f)            ; this picture tells it
      (set-texts! seat '())
      (if (eq? thunk look)
          (with-look (or (one-view) 'overview) (labels-now)
                     (lambda ()
                       (show-page! (in-order texts) "Enter goes on   q leaves   v other views"))
                     #:map? (not (hard?)))
          (show-lines! (append (in-order texts) (value-lines (thunk))))))))

(define (value-lines value)
  (if (string? value) (string-split value #\newline) (shown-lines value)))

;;; A task that failed.

(define (ask-what-next)
  (turn-pages (in-order (append '("u: go back ten seconds    a: begin the task again    e: end the lesson")
                                (seat-texts (the-seat))))
              "u, a or e   q leaves, to go on later"
              (lambda (key)
                (case key
                  ((#\u) '(failed back))
                  ((#\a) '(failed again))
                  ((#\e) '(failed end))
                  ((#\q #\etx #\eot) ((leaving)))
                  (else (view-key-here! key) #f)))))

(define (failed-in-cockpit text)
  "Ask the pupil what to do after a task that ended by TEXT."
  (let ((choice (second (next-input ask-what-next))))
    (set-texts! (the-seat) '())
    choice))
