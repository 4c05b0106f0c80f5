;;; (bight lesson groups) --- groups of pupils compared, with intervals.
;;;
;;; Of each pupil counts one number: the total of his first time in a lesson, or the difference of two.  Every
;;; pair of groups is compared by Welch's interval, and all pairs together hold with 95 %, by Bonferroni's rule.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson groups)
  #:use-module (bight core decimal)
  #:use-module (bight core interval)
  #:use-module ((bight lesson log) #:select (earlier?))
  #:use-module ((bight study risk) #:select (wilson-interval))
  #:use-module (srfi srfi-1)
  #:export (compare-lines
            group-lines
            first-results
            number-told))

(define confidence 0.95)

(define (number-told x)
  "Return the number X with one decimal, a string; - for #f."
  (if x (fixed x 1) "-"))

(define (interval-told interval)
  (simple-format #f "~a (~a to ~a)" (string-pad (number-told (first interval)) 6)
                 (number-told (second interval)) (number-told (third interval))))

(define (pairs items)
  ;; Every item with each after it.
  (if (null? items)
      '()
      (append (map (lambda (b) (list (car items) b)) (cdr items)) (pairs (cdr items)))))

(define (width groups)
  (apply max 5 (map (lambda (g) (string-length (car g))) groups)))

(define (group-line group w)
  (simple-format #f "  ~a  n ~a  mean ~a" (string-pad-right (car group) w)
                 (string-pad (number->string (length (cdr group))) 3)
                 (interval-told (mean-interval (cdr group) confidence))))

(define (pair-line a b each w)
  (simple-format #f "  ~a ~a" (string-pad-right (string-append (car a) " - " (car b)) (+ w w 4))
                 (interval-told (difference-interval (cdr a) (cdr b) each))))

(define (compare-lines groups)
  "Return lines that compare GROUPS, an alist from names to numbers, one of each pupil: the mean of each with
its interval of 95 %, and each difference, with intervals that hold all together with 95 %."
  (let* ((w (width groups)) (all (pairs groups))
         (each (- 1 (/ (- 1 confidence) (max 1 (length all))))))
    (append (map (lambda (g) (group-line g w)) groups)
            (map (lambda (p) (pair-line (first p) (second p) each w)) all))))


;;; The logbook's groups, lesson by lesson.

(define (of key) (lambda (result) (assq-ref result key)))

(define (first-results results)
  "Return of RESULTS, in one lesson, the first of each pupil."
  (delete-duplicates (sort results earlier?)
                     (lambda (a b) (equal? ((of 'who) a) ((of 'who) b)))))

(define (by-group results)
  ;; An alist from groups, sorted, to their results.
  (map (lambda (name) (cons name (filter (lambda (r) (equal? name ((of 'group) r))) results)))
       (sort (delete-duplicates (filter string? (map (of 'group) results))) string<?)))

(define (passed-line group w)
  (let* ((n (length (cdr group))) (hits (count (of 'passed?) (cdr group)))
         (interval (map (lambda (x) (* 100 x)) (wilson-interval hits n))))
    (simple-format #f "  ~a  passed ~a of ~a (~a to ~a %)" (string-pad-right (car group) w) hits n
                   (number-told (first interval)) (number-told (second interval)))))

(define (lesson-lines name results)
  (let ((groups (by-group (first-results results))))
    (if (< (length groups) 2)
        '()
        (append (list (simple-format #f "~a: marks of each pupil's first time" name))
                (compare-lines (map (lambda (g) (cons (car g) (map (of 'total) (cdr g)))) groups))
                (map (lambda (g) (passed-line g (width groups))) groups)))))

(define (group-lines results)
  "Return lines that compare the groups in RESULTS of the logbook, in each lesson that several groups took."
  (let* ((results (filter (lambda (r) (real? ((of 'total) r))) results))
         (names (delete-duplicates (map (of 'lesson) results)))
         (lines (append-map (lambda (name)
                              (lesson-lines name (filter (lambda (r) (eq? name ((of 'lesson) r))) results)))
                            names)))
    (if (null? lines)
        '("No lesson was taken by pupils of two groups yet: bight lesson NAME --group G says in which one is.")
        (append lines
                '("Means with intervals of 95 %; differences with intervals that hold all together with 95 %.")
                (if (any (lambda (line) (string-contains line "(- to -)")) lines)
                    '("- : one pupil alone, or pupils with the same marks, give no interval.")
                    '())
                (simulated-lines results)))))

(define (simulated-lines results)
  (let ((n (length (delete-duplicates (map (of 'who) (filter (of 'simulated) results))))))
    (if (zero? n)
        '()
        (list (simple-format #f "~a of these pupils were simulated: of them nobody was measured." n)))))
