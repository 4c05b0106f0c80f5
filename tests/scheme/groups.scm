;;; Groups of pupils compared: quantiles against tables, intervals against samples drawn again and again.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core interval)
             (bight lesson groups)
             (srfi srfi-1))

(define-scenario quantiles-are-those-of-the-tables
  "Student's distribution, 97.5 %, as every textbook prints it."
  (for-each (lambda (row) (expect (t-quantile 0.975 (first row)) is (about (second row) #:within 0.001)))
            '((1 12.706) (2 4.303) (5 2.571) (10 2.228) (30 2.042) (120 1.980) (1e6 1.961))))

(define-scenario intervals-hold-what-they-say
  "Of small samples of unlike spread, drawn 400 times, about 95 % of the intervals hold the true difference."
  (let* ((dice (seed->random-state 7))
         (draw (lambda (n mean spread) (map (lambda (i) (+ mean (* spread (random:normal dice)))) (iota n))))
         (holds? (lambda (i)
                   (let ((d (difference-interval (draw 5 70 5) (draw 9 60 15))))
                     (<= (second d) 10 (third d))))))
    (expect (count holds? (iota 400)) is (between 368 392))))

(define (result who group lesson total minute)
  `((when . ,(simple-format #f "2026-01-01T00:~a:00Z" (+ 10 minute))) (who . ,who) (group . ,group)
    (lesson . ,lesson) (total . ,total) (passed? . ,(>= total 70))))

(define-scenario groups-are-compared
  "By each pupil's first time; a lesson that one group alone took is left out."
  (let ((text (string-join (group-lines (list (result "a" "plan" 'one-pile 80 1) (result "b" "plan" 'one-pile 90 1)
                                              (result "c" "none" 'one-pile 50 1) (result "d" "none" 'one-pile 60 1)
                                              (result "c" "none" 'one-pile 100 5)
                                              (result "a" "plan" 'wrong-side 80 1)))
                           "\n")))
    (expect (number? (string-contains text "one-pile: marks")))
    (expect (string-contains text "wrong-side") => #f)
    (expect (number? (string-contains text "none - plan")))
    (expect (number? (string-contains text "-30.0 (")))
    (expect (number? (string-contains text "plan   passed 2 of 2")))
    (expect (number? (string-contains (car (group-lines '())) "two groups yet")))))

(define-scenario one-pupil-gives-no-interval
  "A group of one is compared by its mean, and it is said why no interval stands beside it."
  (let ((one (group-lines (list (result "a" "plan" 'one-pile 80 1) (result "c" "none" 'one-pile 50 1))))
        (more (group-lines (list (result "a" "plan" 'one-pile 80 1) (result "b" "plan" 'one-pile 90 1)
                                 (result "c" "none" 'one-pile 50 1) (result "d" "none" 'one-pile 60 1))))
        (said? (lambda (lines) (any (lambda (line) (string-prefix? "- : one pupil alone" line)) lines))))
    (expect (said? one))
    (expect (said? more) => #f)))

(define-scenario results-of-one-second-have-an-order
  "Whichever logbook they were merged into, the first of them is the same."
  (let ((two (list (result "a" "plan" 'one-pile 80 1) (result "a" "plan" 'one-pile 20 1))))
    (expect (first-results two) => (first-results (reverse two)))
    (expect (length (first-results two)) => 1)))
