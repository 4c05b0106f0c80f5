;;; Random dives in random worlds of any parts, judged by laws that know no solver; and the same dive moved,
;;; turned, mirrored, scaled, laid whole or paid out.  `bight bench stability --family worlds' flies more.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight any-dive)
             (bight any-flight)
             (bight any-world)
             ((bight generator) #:select (draw expression))
             (bight metamorphosis)
             (bight schema)
             (bight soundness)
             (bight watched)
             ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?))))

(define (told findings)
  ;; The scripts of FINDINGS, to be read in a report.
  (map third findings))

(define-scenario (any-dive-is-sound wild?)
  "Whatever the world and the orders, no law is broken, no process dies and none hangs."
  #:for ((wild? #f #t))
  (expect (told (unsound-dives (iota (if wild? 12 24)) #:wild? wild?)) => '()))


;;; The grammar knows all that the schema knows.

(define (words-in datum)
  ;; The symbols of DATUM that lead a list, each in the list that holds it: (HEAD . FIELD), too.
  (define (look datum outer found)
    (cond ((not (pair? datum)) found)
          ((and (list? datum) (symbol? (car datum)))
           (fold (lambda (item found) (look item (car datum) found))
                 (cons* (car datum) (cons outer (car datum)) found) (cdr datum)))
          (else found)))
  (delete-duplicates (look datum #f '())))

(define-scenario every-part-and-field-is-drawn
  "Each kind of part, each thing inside one and each field of the schema is drawn sooner or later."
  (define drawn (make-hash-table))
  (define dice (seed->random-state 3))
  (define worlds (any-world #:wild? #t))
  (do ((i 0 (+ i 1))) ((= i 250))
    (for-each (lambda (word) (hash-set! drawn word #t))
              (words-in (expression worlds (draw worlds dice)))))
  (define heads (append (part-heads) (append-map inner-heads (part-heads))))
  (expect (remove (lambda (head) (hash-ref drawn head)) heads) => '())
  (expect (append-map (lambda (head)
                        (filter (lambda (name) (not (hash-ref drawn (cons head name))))
                                (map field-name (remove (lambda (f) (eq? 'named (field-name f)))
                                                        (head-fields head)))))
                      heads)
          => '()))

(define-scenario every-kind-of-order-is-given
  "Each verb that changes a dive is ordered sooner or later, and nothing but what the language has."
  (define dice (seed->random-state 4))
  (define flights (any-flight #:wild? #t))
  (define given
    (delete-duplicates
     (append-map (lambda (i) (filter symbol? (words-in (cons 'flight (expression flights (draw flights dice))))))
                 (iota 300))))
  (for-each (lambda (verb) (expect (memq verb given)))
            '(drive! fly-to! move! place! hold-depth! release! follow! pay-out! haul-in! cut-tether!
              tether-model! accuracy! current! alter! fault! mend! threads! what-if restore! rewind!
              same-when-loaded!)))

(define-scenario most-worlds-can-be-entered
  "At least half of the random worlds are not refused, so that there is something to fly in."
  (define entered 0)
  (unsound-dives (iota 30) #:seed 5 #:hear (lambda (n outcome)
                                             (unless (eq? 'refused (car outcome)) (set! entered (+ entered 1)))))
  (expect entered is (above 14)))


;;; The laws notice.

(define (changing key change)
  ;; A hook that changes what a tether answers to KEY.
  (lambda (answers)
    (map (lambda (entry) (if (eq? key (car entry)) (cons key (change (cdr entry))) entry)) answers)))

(define (stretch-third points)
  (append (take points 3) (list (vec+ (fourth points) '(0 0 5))) (drop points 4)))

(define-scenario each-law-is-noticed
  "A dive is sound; with one of its answers falsified it is not, and the law that is broken says so."
  (in open-water)
  (tether-model! 'dynamic)
  (define (noticed? key change words)
    (let ((wrong (parameterize ((as-told (changing key change))) (watched (run 1/30)))))
      (and (pair? wrong) (string-contains (car wrong) words) #t)))
  (expect (watched (run 1/30)) => '())
  (expect (noticed? 'points stretch-third "do not explain"))
  (expect (noticed? 'anchor (lambda (held) (cons (vec+ (car held) '(0 0.01 0)) (cdr held))) "not at its anchor"))
  (expect (noticed? 'far-end (lambda (held) (cons (vec+ (car held) '(0 0.01 0)) (cdr held))) "made fast"))
  (expect (noticed? 'max-tension (lambda (t) (- t 1)) "largest tension"))
  (expect (noticed? 'tensions (lambda (t) (cons +nan.0 (cdr t))) "a tension is"))
  (expect (noticed? 'length (lambda (l) 0) "of it are out"))
  (expect (noticed? 'drum (lambda (l) 20) "on the drum")))

(define-scenario orders-are-judged
  "An error that is none of bight's, and a refusal after which the state is another, are noticed."
  (in open-water)
  (expect (watched (pay-out! -1)) => '())
  (expect (watched (car '())) is pair?)
  (expect (watched (begin (drive! #:surge 1) (pay-out! -1))) is pair?))

(define-scenario what-a-file-forgets-is-noticed
  "What runs between the steps is in no file: a dive that depends on it goes on otherwise when it is loaded."
  (in open-water)
  (expect (watched (same-when-loaded! 10)) => '())
  (every 1/60 (drive! #:surge 1))
  (expect (watched (same-when-loaded! 10)) is pair?))

(define-scenario other-laws-are-noticed
  "A line that is swept along is not in balance; one that is wound is not free."
  (in open-water)
  (tether-model! 'dynamic)
  (current! 1 0)
  (expect (imbalance 'line) is (above 0.2))
  (expect (wound-though-free 'line #t '((p1 . 0) (p2 . -1))) is string?)
  (expect (wound-though-free 'line #f '((p2 . -1))) => #f))

(define-scenario a-crash-is-told
  "A dive whose process dies is a finding, and is made simpler."
  (define world '(world (sea) (rov (at 0 5 -5)) (tether (from 0 0 -5) (length 9) (model catenary))))
  (expect (finding? (fly-in-child (list world '(run 1)))) => #f)
  (expect (fly-in-child (list world '(kill (getpid) SIGSEGV))) => (list 'died SIGSEGV))
  (expect (car (fly-in-child (list world '(let loop () (loop))) #:seconds 1)) => 'died))


;;; The same dive elsewhere.

(define (as-datum generator)
  ;; What GENERATOR draws, to be evaluated by the test.
  (made-of (lambda (expression) (list 'quote expression)) generator))

(define (or-no-case thunk)
  ;; What THUNK returns; the case is given up when it is refused.
  (let ((value (with-exception-handler (lambda (e) (if (bight-error? e) e (raise-exception e)))
                 thunk
                 #:unwind? #t)))
    (assume (not (bight-error? value)))
    value))

(define (world-of-case expression)
  (or-no-case (lambda () (evaluated expression))))

(define (in-random world)
  (or-no-case (lambda () (enter! world))))

(define (do-order order)
  ;; Do ORDER, which may be refused.
  (with-exception-handler (lambda (e) (unless (bight-error? e) (raise-exception e)))
    (lambda () (evaluated order))
    #:unwind? #t))

(define (answers)
  (map tether-answers (tether-names)))

(define (span name)
  ;; How far the ends of the tether NAME are from each other as seen from above, m.
  (let ((way (vec- (point-at name (tether-length name)) (point-at name 0))))
    (norm (vec (x way) (y way) 0))))

(define (flown world orders)
  ;; The answers when ORDERS were given.  A line whose ends lie one above the other may hang in any plane:
  ;; such a case is given up.
  (in-random world)
  (assume (all? (lambda (name) (> (span name) 1)) (tether-names)))
  (for-each do-order orders)
  (answers))

(define (changed-or-none change world)
  ;; WORLD after CHANGE; the case is given up if it cannot be changed so.
  (with-exception-handler
      (lambda (e)
        (assume (not (and (bight-error? e) (eq? 'unsupported (bight-error-kind e)))))
        (raise-exception e))
    (lambda () (changed-world change world))))

(define (apart change before after)
  ;; How far two answers about a tether are from each other, m.
  (apply max (map (lambda (p q) (distance (changed-point change p) q))
                  (assq-ref before 'points) (assq-ref after 'points))))

(define (stated answers)
  ;; The error in position that a tether states, m; what rounding does to a place a kilometre off.
  (max 1e-6 (or (assq-ref answers 'error) 0)))

(define (same-after? change before after)
  (all? (lambda (a b)
          (<= (apart change a b)
              (+ (* (changed-number change "m" 1) (stated a)) (stated b))))
        before after))

(define one-tether (as-datum (any-world #:obstacles 0 #:vehicles 1 #:tethers 1)))
(define some-parts (as-datum (any-world #:obstacles 2 #:vehicles 1 #:tethers 2)))

(define ways
  ;; Changes under which a dive stays what it is, whatever its models.
  (list (moved (vec 1000 -500 0)) (turned 1) (turned 2) mirrored))

(define statics '(rubber-band v-shape catenary elastic steady))

(define (all-of-rest? world)
  ;; Are all tethers of WORLD of models that take no time?
  (all? (lambda (part)
          (or (not (eq? 'tether (part-head part)))
              (memq (assq-ref (part-all-fields part) 'model) statics)))
        (world-parts world)))

(define-property what-rests-is-the-same-elsewhere
  "Among obstacles, models of rest give the same dive where it is moved, turned or mirrored."
  #:for ((world some-parts)
         (orders (as-datum (any-flight #:most 4 #:kinds '(drive fly move pay-out haul-in current))))
         (way (integer 0 3)))
  #:cases 10
  (define change (list-ref ways way))
  (define here (world-of-case world))
  (assume (all-of-rest? here))
  (define there (changed-or-none change here))
  (define before (flown here orders))
  (define after (flown there (map (lambda (order) (changed-order change order)) orders)))
  (expect (same-after? change before after)))

(define-property a-moving-line-is-the-same-elsewhere
  "In open water the moving line does so within the error that it states, if it is not slack in a heap."
  #:for ((world one-tether)
         (orders (as-datum (any-flight #:most 3 #:kinds '(drive fly move pay-out current))))
         (way (integer 0 3)))
  #:cases 6
  (define change (list-ref ways way))
  (define here (with (world-of-case world) (t1 (model dynamic) (nodes 16))))
  (define there (changed-or-none change here))
  (define before (flown here orders))
  (assume (null? (events)))
  (define after (flown there (map (lambda (order) (changed-order change order)) orders)))
  (expect (same-after? change before after)))

(define-property froude
  "A line at rest that is so many times as large, in water so much faster, has the same shape."
  #:for ((world one-tether) (by (one-of 2 4 1/4)))
  #:cases 10
  (define change (scaled by))
  (define here (world-of-case world))
  (assume (all-of-rest? here))
  (define there (changed-or-none change here))
  (define before (flown here '()))
  (define tension (max-tension 't1))
  (define after (flown there '()))
  (expect (same-after? change before after))
  (expect (max-tension 't1) is (about (changed-number change "N" tension)
                                      #:within (* 1e-6 (+ 1 (changed-number change "N" tension))))))

(define (within-accuracy? before after)
  ;; Among obstacles a model of rest lays its nodes along its curve; each line says how exact it is meant to be.
  (all? (lambda (a b)
          (<= (apart (moved (vec 0 0 0)) a b)
              (+ (stated a) (stated b) (assq-ref (assq-ref a 'fields) 'accuracy))))
        before after))

(define-property what-is-far-away-does-not-matter
  "Something a kilometre off changes nothing but what the nodes of a line are laid along."
  #:for ((world one-tether)
         (orders (as-datum (any-flight #:most 3 #:kinds '(drive fly move pay-out current)))))
  #:cases 6
  (define here (with (world-of-case world) (t1 (nodes 64) (accuracy 0.05))))
  (define before (flown here orders))
  (define after (flown (extend here (sphere (named far) (at 1000 1000 -8) (radius 2))) orders))
  (expect (within-accuracy? before after)))


(define-scenario another-place-is-another-dive
  "What is moved, or scaled, is not the same as what is not."
  (define (of change)
    (enter! (changed-world change (find-world 'open-water)))
    (answers))
  (define stays (moved (vec 0 0 0)))
  (define before (of stays))
  (expect (same-after? (moved (vec 0 9 0)) before (of (moved (vec 0 9 0)))))
  (expect (not (same-after? stays before (of (moved (vec 0 1 0))))))
  (expect (not (same-after? (turned 1) before (of (turned 2)))))
  (expect (not (same-after? (scaled 2) before (of (scaled 3))))))


;;; Two models of one world; what rests is in balance.

(define (given? part field)
  (assq-ref (part-all-fields part) field))

(define (bare? world)
  ;; Is there nothing on the line t1, and nothing that would move it?
  (let ((sea (world-part world 'sea)) (line (world-part world 't1)))
    (not (or (given? line 'clump) (given? line 'float) (given? sea 'waves)
             (positive? (or (given? (world-part world 'r1) 'mass) 0))
             (memq (car (or (given? sea 'current) '(still))) '(tide grid))))))

(define-property at-rest-all-models-are-one
  "A moving line begun where it rests stays there, in balance, within the errors that both have."
  #:for ((world one-tether))
  #:cases 6
  (define here (with (world-of-case world) (t1 (model steady) (nodes 64))))
  (assume (bare? here))
  (in-random here)
  (assume (< (z (point-at 't1 (/ (tether-length 't1) 2))) -1))
  (define rest (car (answers)))
  (expect (imbalance 't1) is (below (+ 0.01 (/ 1 64)))) ; no nearer than the load of one interval
  (tether-model! 't1 'dynamic)
  (run 3)
  (expect (apart (moved (vec 0 0 0)) rest (car (answers))) is (below (* 2 (stated (car (answers))))))
  (tether-model! 't1 'auto)
  (run 1)
  (expect (apart (moved (vec 0 0 0)) rest (car (answers))) is (below (* 2 (stated (car (answers)))))))

(define-property laid-whole-or-paid-out
  "A line at rest does not know how it came to be so long."
  #:for ((world one-tether) (share (uniform 0.1 0.9)))
  #:cases 6
  (define whole (with (world-of-case world) (t1 (model steady) (drum none))))
  (in-random whole)
  (assume (> (span 't1) 1))
  (define laid (car (answers)))
  (define length (tether-length 't1))
  (define least (straight-distance 't1))
  (define begun (+ least (* share (- length least))))
  (in-random (with whole (t1 (length begun))))
  (pay-out! 't1 (- length begun) #:rate (- length begun))
  (run 2)
  (assume (= least (straight-distance 't1)))
  (expect (tether-length 't1) is (about length #:within 1e-9))
  (expect (apart (moved (vec 0 0 0)) laid (car (answers))) is (below 1e-3)))


;;; Energy.

(define (total-energy)
  (apply + (map cdr (energy))))

(define (work-of thunk)
  ;; Let THUNK pass time: what the vehicle does to the line meanwhile, J, and how much to and fro.
  (let ((work 0) (all 0) (place (rov-position)) (force (tether-force)))
    (define (add!)
      (let* ((w (* -1/2 (apply + (map * (f64vector->list (vec+ force (tether-force)))
                                      (f64vector->list (vec- (rov-position) place)))))))
        (set! work (+ work w))
        (set! all (+ all (abs w)))
        (set! place (rov-position))
        (set! force (tether-force))))
    (always (begin (add!) #t) (thunk))
    (cons work all)))

(define-property energy-is-work-done-less-what-is-lost
  "In still water a moving line gains no more energy than its vehicle gives it."
  #:for ((world one-tether)
         (orders (as-datum (any-flight #:most 3 #:kinds '(drive fly move)))))
  #:cases 6
  (define here (with (world-of-case world) (t1 (model dynamic) (nodes 16)) (current still)))
  (assume (bare? here))
  (in-random here)
  (define before (total-energy))
  (define work (work-of (lambda () (for-each do-order orders) (run 1/2))))
  (expect (- (total-energy) before) is (below (+ (car work) (* 0.05 (cdr work)) 0.01))))

(define-scenario energy-without-work-is-noticed
  "A vehicle that lifts a heavy line gives it energy: without the work the law would be broken."
  (in (with open-water (current still) (line (model dynamic) (nodes 16) (wet-weight 1))))
  (define before (total-energy))
  (move! '(0 15 -2) #:speed 1)
  (define work (work-of (lambda () (run 4))))
  (expect (- (total-energy) before) is (above 1))
  (expect (car work) is (above 1)))


;;; Awareness.

(define-property nothing-winds-in-the-free-class
  "Where nothing needs to be unwound, no object is wound about."
  #:for ((world some-parts)
         (orders (as-datum (any-flight #:most 4 #:kinds '(fly move pay-out)))))
  #:cases 8
  (in-random (world-of-case world))
  (for-each do-order orders)
  (for-each (lambda (name) (expect (free-class-unwound name) => #f)) (tether-names)))


;;; What `help' says.

(define questions
  ;; Verbs that ask: all that these modules export and the language has.
  (append-map (lambda (module)
                (filter (lambda (name)
                          (and (memq name (language-names))
                               (not (string-suffix? "!" (symbol->string name)))))
                        (module-map (lambda (name variable) name) (resolve-interface module))))
              '((bight query) (bight contact) (bight aware) (bight instruments) (bight foresight))))

(define (says? text . words)
  (any (lambda (word) (string-contains text word)) words))

(define (first-sentence text)
  (let* ((text (string-join (string-tokenize text)))
         (end (string-contains text ". ")))
    (if end (substring text 0 end) text)))

(define (row-of-numbers? rank columns)
  (lambda (value) (and (array? value) (= rank (array-rank value))
                       (or (not columns) (= columns (last (array-dimensions value)))))))

;; What the words of a docstring promise, the first that fits: a predicate.
(define promises
  `((("Return #t if" "Return #t unless" "Return #t while") . ,boolean?)
    (("alist") . ,(lambda (value) (and (list? value) (all? pair? value))))
    (("polylines") . ,list?)
    (("polyline" "n x 3") . ,(row-of-numbers? 2 3))
    ((", a list" "list of" "lists (" "a list (") . ,list?)
    (("f64vector") . ,f64vector?)
    ((", a point" ", a vector") . ,(row-of-numbers? 1 3))
    ((", m" ", N" "degrees" "whole number" "share of") . ,real?)))

(define (promise-of text)
  ;; What TEXT, the first sentence of a docstring, promises; #f if nothing that is known.
  (and=> (find (lambda (entry) (apply says? text (car entry))) promises) cdr))

(define (as-told? text value)
  (let ((promise (promise-of text)))
    (or (not promise)
        (and (says? text "or #f") (not value))
        (promise value))))

(define (told-and-not-so name)
  ;; #f, or NAME, what it says and what it returns in the present dive.
  (let* ((verb (module-ref (resolve-interface '(bight)) name #f))
         (text (and (procedure? verb) (procedure-documentation verb)))
         (value (and text
                     (with-exception-handler
                         (lambda (e) (if (bight-error? e) e (raise-exception e)))
                       (lambda () (verb))
                       #:unwind? #t))))
    (and text (not (bight-error? value)) (not (as-told? (first-sentence text) value))
         (list name (first-sentence text) value))))

(define (promise-in name)
  ;; What the help of the question NAME promises.
  (let ((text (procedure-documentation (module-ref (resolve-interface '(bight)) name))))
    (and text (promise-of (first-sentence text)))))

(define-scenario (help-says-what-is-returned model)
  "Each question returns what the first sentence of its help says, or is refused, with every model."
  #:for ((model 'rubber-band 'steady 'dynamic))
  (in (with pile (line (model ,model) (nodes 16))))
  (run 1)
  (expect (length questions) is (above 80))
  (expect (length (filter promise-in questions)) is (above 70))
  (expect (as-told? "Return the depth of the vehicle, m." 'deep) => #f)
  (for-each (lambda (question) (expect (told-and-not-so question) => #f)) questions))
