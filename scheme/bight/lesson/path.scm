;;; (bight lesson path) --- which lesson a pupil takes next, and why.
;;;
;;; All results of the logbook, of all pupils, are gone through in the order of time, so that what is believed
;;; of a lesson's difficulty comes from everybody who took it; (bight lesson ability) has the model.  Nothing is kept
;;; besides the results: a logbook that was merged with another's gives what one logbook would have given.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson path)
  #:use-module (bight core record)
  #:use-module (bight lesson ability)
  #:use-module (bight lesson file)
  #:use-module ((bight lesson log) #:select (earlier?))
  #:use-module (bight lesson skill)
  #:use-module (srfi srfi-1)
  #:export (catalogue make-place place? place-name place-title place-grade place-trains place-needs
            beliefs-from skill-belief chance-to-pass
            results-in passed? ready?
            proposal proposal-lines skill-lines training-lines))


;;; What lessons there are.

(define-record <place>
  (make-place name title grade trains needs)
  place?
  (name place-name)
  (title place-title)
  (grade place-grade)
  (trains place-trains)
  (needs place-needs))

(define (file-place file)
  (let ((grade (lesson-file-clause file 'grade)))
    (make-place (lesson-file-name file) (lesson-file-title file) (if (pair? grade) (car grade) 1)
                (lesson-file-clause file 'trains) (lesson-file-clause file 'needs))))

(define (catalogue)
  "Return the places on the path of the lessons that are known by name."
  (map file-place (lesson-files)))


;;; What is believed: a table from (WHO SKILL) and (LESSON LEVEL) to beliefs.

(define (lesson-belief beliefs place level)
  (hash-ref beliefs (list (place-name place) level) (lesson-prior (place-grade place) level)))

(define (skill-belief beliefs who skill)
  "Return what BELIEFS hold of the SKILL of WHO."
  (hash-ref beliefs (list who skill) skill-prior))

(define (chance-to-pass beliefs who place level)
  "Return the chance by BELIEFS that WHO passes the lesson at PLACE at LEVEL."
  (if (null? (place-trains place))
      1/2
      (chance 2 (map (lambda (s) (skill-belief beliefs who s)) (place-trains place))
              (lesson-belief beliefs place level))))

(define (learn-from! beliefs result places)
  (let* ((get (lambda (key) (assq-ref result key)))
         (place (find (lambda (p) (eq? (get 'lesson) (place-name p))) places))
         (level (or (get 'level) 'normal)))
    (when (and place (pair? (place-trains place)) (real? (get 'total)))
      (call-with-values
          (lambda ()
            (learn (grade-reached (get 'total) (get 'passed?))
                   (map (lambda (s) (skill-belief beliefs (get 'who) s)) (place-trains place))
                   (lesson-belief beliefs place level)))
        (lambda (skills lesson)
          (for-each (lambda (s belief) (hash-set! beliefs (list (get 'who) s) belief))
                    (place-trains place) skills)
          (hash-set! beliefs (list (place-name place) level) lesson))))))

(define (beliefs-from results places)
  "Return what is believed after RESULTS, as `logged-results' returns them, of lessons at PLACES."
  (let ((beliefs (make-hash-table)))
    (for-each (lambda (result) (learn-from! beliefs result places)) (sort results earlier?))
    beliefs))


;;; The next lesson.

(define wanted-chance 0.7)              ; of passing: neither idle nor hopeless
(define least-chance 0.35)

(define (results-in results name)
  "Return those of RESULTS that are of the lesson NAME."
  (filter (lambda (r) (eq? name (assq-ref r 'lesson))) results))

(define (passed? results place)
  "Return #t if one of RESULTS passes the lesson at PLACE at more than the level easy."
  (any (lambda (r) (and (assq-ref r 'passed?) (not (eq? 'easy (assq-ref r 'level)))))
       (results-in results (place-name place))))

(define (shown-in results places skill)
  ;; The place of a lesson that trains SKILL and was passed, or #f.
  (find (lambda (p) (and (memq skill (place-trains p)) (passed? results p))) places))

(define (ready? results places place)
  "Return #t if every skill that the lesson at PLACE needs was shown by RESULTS in another lesson at PLACES, as far as
another trains it."
  (every (lambda (skill)
           (let ((others (filter (lambda (p) (and (not (eq? p place)) (memq skill (place-trains p)))) places)))
             (or (null? others) (shown-in results others skill))))
         (place-needs place)))

(define (before? a b)
  ;; Of two lists (PLACE CHANCE): the lower grade first, then the chance nearer to what is wanted.
  (let ((ga (place-grade (first a))) (gb (place-grade (first b))))
    (if (= ga gb)
        (< (abs (- (second a) wanted-chance)) (abs (- (second b) wanted-chance)))
        (< ga gb))))

(define (least-of before? items)
  ;; The first of ITEMS that no other comes before.
  (fold (lambda (item best) (if (before? item best) item best)) (car items) (cdr items)))

(define (with-chances beliefs who places)
  (map (lambda (p) (list p (chance-to-pass beliefs who p 'normal))) places))

(define (proposal beliefs who results places)
  "Return what WHO, with his RESULTS, takes next of PLACES: a list of its place, the level, the chance of
passing it, and why it was chosen: new, again (all were passed), or early (nothing else is left)."
  (let* ((left (remove (lambda (p) (passed? results p)) places))
         (ready (filter (lambda (p) (ready? results places p)) left))
         (chosen (lambda (why from)
                   (let* ((best (least-of before? (with-chances beliefs who from)))
                          (easy (chance-to-pass beliefs who (first best) 'easy)))
                     (if (and (< (second best) least-chance) (> easy (second best)))
                         (list (first best) 'easy easy why)
                         (list (first best) 'normal (second best) why))))))
    (cond ((pair? ready) (chosen 'new ready))
          ((pair? left) (chosen 'early left))
          (else
           (let ((weakest (least-of (lambda (a b) (< (second a) (second b)))
                                    (with-chances beliefs who places))))
             (list (first weakest) 'hard (chance-to-pass beliefs who (first weakest) 'hard) 'again))))))


;;; In words.

(define (percent x)
  (number->string (inexact->exact (round (* 100 x)))))

;; A skill is told as the chance to pass a lesson of the second grade that trains it alone.
(define yardstick (make-belief (belief-mean (lesson-prior 2 'normal)) 1e-9))

(define (chance-at mean)
  (chance 2 (list (make-belief mean 1e-9)) yardstick))

(define (skill-line beliefs who skill)
  (let* ((b (skill-belief beliefs who skill)) (interval (belief-interval b)))
    (string-append (string-pad-right (symbol->string skill) 11)
                   (string-pad (percent (chance-at (belief-mean b))) 4) " %  ("
                   (percent (chance-at (first interval))) " to " (percent (chance-at (second interval)))
                   " %)  " (skill-sentence skill))))

(define (skill-lines beliefs who)
  "Return lines that tell how well WHO has each skill."
  (cons "Chance to pass a lesson of grade 2 that trains the skill alone, with the interval of 90 %:"
        (map (lambda (skill) (string-append "  " (skill-line beliefs who skill))) (skills))))

(define (words symbols)
  (string-join (map symbol->string symbols) " "))

(define (training-row name trains needs)
  (string-trim-right
   (string-append "  " (string-pad-right name 23) (string-pad-right trains 18) needs)))

(define (training-lines places)
  "Return lines that tell which skills the lessons at PLACES train and need."
  (cons (training-row "Lesson" "trains" "needs")
        (map (lambda (place)
               (training-row (symbol->string (place-name place)) (words (place-trains place)) (words (place-needs place))))
             places)))

(define (need-line results places place skill)
  (let ((shown (shown-in results (delq place places) skill)))
    (if shown
        (simple-format #f "needs ~a, which you showed in ~a" skill (place-name shown))
        (simple-format #f "needs ~a, which you have not shown yet" skill))))

(define (history-line results place)
  (let ((totals (filter-map (lambda (r) (assq-ref r 'total)) (results-in results (place-name place)))))
    (if (null? totals)
        "you have not taken it yet"
        (simple-format #f "you took it ~a time~a, with ~a marks at best" (length totals)
                       (if (= 1 (length totals)) "" "s") (apply max totals)))))

(define (proposal-lines chosen results places)
  "Return lines that tell what CHOSEN, as `proposal' returns it, is, and why."
  (let ((place (first chosen)) (level (second chosen)))
    (append
     (list (simple-format #f "Next: ~a, ~a (grade ~a)" (place-name place) (place-title place)
                          (place-grade place))
           (string-append "  " (case (fourth chosen)
                                 ((again) "you have passed every lesson; this is your least sure one, at hard")
                                 ((early) "nothing that you have all the skills for is left; it is the nearest")
                                 (else "the lowest grade that is left, and near seven chances of ten"))))
     (map (lambda (s) (simple-format #f "  trains ~a: ~a" s (skill-sentence s))) (place-trains place))
     (map (lambda (s) (string-append "  " (need-line results places place s))) (place-needs place))
     (list (string-append "  " (history-line results place))
           (simple-format #f "  your chance of passing it~a: ~a %"
                          (if (eq? 'normal level) "" (simple-format #f " at ~a" level)) (percent (third chosen)))
           (simple-format #f "bight lesson ~a~a" (place-name place)
                          (if (eq? 'normal level) "" (simple-format #f " --level ~a" level)))))))
