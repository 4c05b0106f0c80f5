;;; Properties found from measurements: truths that are known are found again from what a line of them did, in this
;;; engine's own steps and in a dive; intervals hold them as often as they say; and what cannot be found is said.
;;; BIGHT_LONG=1 draws 400 lines instead of 10 for the intervals, and tells how near real lines are.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight identify flight)
             (bight identify measured)
             (ice-9 format)
             (ice-9 match)
             ((ice-9 textual-ports) #:select (get-string-all))
             (srfi srfi-1)
             (srfi srfi-4))

(define (truth-of known name) (second (assq name known)))

(define (print-row values)
  (format #t "~{~,7f~^,~}~%" values))

;; A run is made of a list of rows (T ANCHOR END [OUT]) of times, places of the ends and line that is out.

(define (swung-row k)
  ;; The far end goes about as a vehicle does in a pool.
  (let ((t (* .05 k)))
    (list t '(0. 0. 0.)
          (list (+ 1.6 (* .5 (sin (* 2.1 t)))) (* .4 (sin (* 1.3 t))) (+ -.5 (* .3 (sin (* 1.7 t))))))))

(define swung (map swung-row (iota 60)))

(define (write-ends file rows)
  (with-output-to-file file
    (lambda ()
      (display "t,anchor_x,anchor_y,anchor_z,end_x,end_y,end_z,out,end_tension\n")
      (for-each (lambda (row)
                  (print-row (append (list (first row)) (second row) (third row)
                                     (list (if (null? (cdddr row)) 2.5 (fourth row)) 0.))))
                rows))))

(define* (fly-truth rows places known #:key (length 2.5) (clamped? #f) (density 1000.) (floor #f) (intervals 20)
                    (step .05))
  ;; What a line of the fields KNOWN does whose ends go through ROWS: (PLACES . PULLS).
  (let ((file (scratch-file "ends.csv")))
    (write-ends file rows)
    (let ((run (read-run 'test file))
          (setting (make-setting (map (lambda (clause)
                                     (if (pair? (second clause))
                                         (cons 'set (map (lambda (entry) (cons (first entry) (second entry))) (cdr clause)))
                                         (cons (first clause) (second clause))))
                                   known)
                                 length places 1 clamped? #f intervals step density 9.80665 floor)))
      (first (fly-all (list (make-flight setting '() (f64vector) run 0 (f64vector-length (run-times run)))))))))

(define* (write-run file rows flown n noise dice #:key (out? #f) (tension? #f) (late 0) (spoil? (const #f)))
  ;; FILE has the ends of ROWS, and of FLOWN, of N markers, what is LATE rows later with NOISE, m.
  (with-output-to-file file
    (lambda ()
      (format #t "t,anchor_x,anchor_y,anchor_z,end_x,end_y,end_z~a~a~a~%" (if out? ",out" "") (if tension? ",end_tension_n" "")
              (string-concatenate (map (lambda (k) (format #f ",m~a_x,m~:*~a_y,m~:*~a_z" (+ k 1))) (iota n))))
      (for-each
       (lambda (row k)
         (define from (max 0 (- k late)))
         (print-row
          (append (list (first row)) (second row) (third row) (if out? (list (fourth row)) '())
                  (if tension?
                      (list (+ (* noise 3 (random:normal dice))
                               (sqrt (apply + (map (lambda (a) (expt (f64vector-ref (cdr flown) (+ a 3 (* 6 from))) 2))
                                                   '(0 1 2))))))
                      '())
                  (map (lambda (i)
                         (+ (f64vector-ref (car flown) (+ i (* 3 n from))) (* noise (random:normal dice))
                            (if (spoil?) 1. 0.)))
                       (iota (* 3 n))))))
       rows (iota (length rows))))))

(define rope '((diameter .004) (mass .03) (wet-weight .15) (ea 1e4) (cdn 1.4) (cdt .02) (ca 1) (ba 1)))

(define (but known . changes)
  (append changes (remove (lambda (clause) (assq (first clause) changes)) known)))

(define marks '(.4 .9 1.4 1.9 2.3))

(define* (measured-swing known noise seed #:key (rows swung) (places marks) (late 0) (tension? #f) (spoil? (const #f))
                         (floor #f))
  (let ((file (scratch-file "swing.csv")))
    (write-run file rows (fly-truth rows places known #:floor floor) (length places) noise (seed->random-state seed)
               #:late late #:tension? tension? #:spoil? spoil?)
    file))

(define (find-in file unknown known . more)
  (apply identify file #:unknown unknown #:known `((length 2.5) ,@known) #:places marks #:intervals 20 #:step .05 more))

(define (found i name) (second (assq name (identified i))))

(define (holds? i name truth)
  (let ((row (assq name (identified i))))
    (<= (third row) truth (fourth row))))

(define wrong (but rope '(cdn .8) '(wet-weight .3)))
(define near (but rope '(cdn .8)))


;;; Truths.

(define-scenario drag-and-weight
  "Drag and wet weight of a line are found to a thousandth from what it did, and all of it held out is as near."
  (let ((i (find-in (measured-swing rope 0 1) '(cn weight) wrong)))
    (expect (found i 'cdn) is (about 1.4 #:within .002))
    (expect (found i 'wet-weight) is (about .15 #:within .0005))
    (expect (assq-ref (identified-score i) 'held-out) is (below 1e-4))
    (expect (assq-ref (identified-score i) 'before-held-out) is (above 5e-3))
    (expect (length (identified i)) => 2)))

(define-scenario clock-of-a-camera
  "How late a camera is against the ends is found."
  (let ((i (find-in (measured-swing rope 1e-4 2 #:late 3) '(cdn clock) near)))
    (expect (found i 'clock) is (about .15 #:within .005))
    (expect (found i 'cdn) is (about 1.4 #:within .05))))

(define (leaning-file file angle)
  ;; A copy of FILE, of cameras whose frame is turned by ANGLE about its second axis.
  (let* ((lines (remove string-null? (string-split (call-with-input-file file get-string-all) #\newline)))
         (c (cos angle)) (s (sin angle)) (to (scratch-file "leaning.csv")))
    (define (turn row)
      (match row
        (() '())
        ((x y z . rest) (cons* (- (* c x) (* s z)) y (+ (* s x) (* c z)) (turn rest)))))
    (with-output-to-file to
      (lambda ()
        (display (car lines))
        (newline)
        (for-each (lambda (line)
                    (let ((row (map string->number (string-split line #\,))))
                      (print-row (cons (car row) (turn (cdr row))))))
                  (cdr lines))))
    to))

(define-scenario upright-of-a-camera
  "How the frame of the cameras leans is found from how the line hangs in it, with its drag; unknown to the search it is
taken for drag, and the line is farther off."
  (let* ((file (leaning-file (measured-swing rope 1e-4 2) .04))
         (i (find-in file '(cdn vertical) near)) (blind (find-in file '(cdn) near)))
    (expect (found i 'vertical-east) is (about -.04 #:within .002))
    (expect (found i 'vertical-north) is (about 0 #:within .002))
    (expect (found i 'cdn) is (about 1.4 #:within .02))
    (expect (assq-ref (identified-score i) 'held-out) is (below 4e-4))
    (expect (assq-ref (identified-score blind) 'held-out) is (above 4e-3))))

(define-scenario places-of-markers
  "A marker that sits elsewhere than it was said to is found where it is."
  (let ((i (find-in (measured-swing rope 0 3 #:places '(.4 .9 1.46 1.9 2.3)) '(places) rope)))
    (expect (found i 'place-3) is (about 1.46 #:within .003))
    (expect (found i 'place-2) is (about .9 #:within .003))))

(define-scenario paid-out-and-pulled
  "A tension tells weight and mass of a line apart, which places alone do not; line is paid out meanwhile."
  (define rows (map (lambda (row) (append row (list (+ 2.4 (* .1 (first row)))))) swung))
  (define (fit tension?)
    (let ((file (scratch-file "paid.csv")))
      (write-run file rows (fly-truth rows '(.4 .9 1.4 1.9) rope) 4 2e-4 (seed->random-state 5)
                 #:out? #t #:tension? tension?)
      (identify file #:unknown '(mass wet-weight cdn) #:known (but rope '(mass .05) '(wet-weight .2))
                #:places '(.4 .9 1.4 1.9) #:intervals 20 #:step .05)))
  (define (told-apart? i) (not (any (lambda (text) (string-contains text "apart")) (identified-warnings i))))
  (let ((with (fit #t)) (without (fit #f)))
    (expect (found with 'wet-weight) is (about .15 #:within .01))
    (expect (told-apart? with) => #t)
    (expect (told-apart? without) => #f)))

(define-scenario friction-of-a-floor
  "Friction is found from how a line is dragged over a floor."
  (define dragged
    (map (lambda (k)
           (let ((t (* .05 k)))
             (list t '(0. 0. -.9) (list (+ 1.2 (* .25 t)) (* .5 (sin t)) -.9))))
         (iota 60)))
  (let* ((known (but rope '(friction .6)))
         (i (identify (measured-swing known 1e-4 4 #:rows dragged #:floor -1.) #:unknown '(friction)
                      #:known `((length 2.5) ,@(but known '(friction .2))) #:places marks #:intervals 20 #:step .05
                      #:floor -1.)))
    (expect (found i 'friction) is (about .6 #:within .06))))

(define-scenario robust
  "A robust loss takes no harm of markers that are a metre off now and then; least squares do."
  (define dice (seed->random-state 8))
  (define file (measured-swing rope 1e-3 6 #:spoil? (lambda () (< (random 1. dice) .04))))
  (define (off loss) (abs (- 1.4 (found (find-in file '(cdn) near #:loss loss #:hold-out 0) 'cdn))))
  (expect (off 'cauchy) is (below .05))
  (expect (< (off 'cauchy) (off 'squares)) => #t))

(define pool
  (world (sea (depth 3) (density 1000))
         (rov (named rov) (at 1.6 0 -1))
         (tether (named line) (from 0 0 -.2) (to rov) (length 2.5) (model dynamic) (nodes 40)
                 (diameter .004) (mass .03) (wet-weight .15) (ea 1e4) (cdn 1.4) (cdt .02))))

(define (record-dive file seconds)
  (with-output-to-file file
    (lambda ()
      (format #t "t_ms,anchor_x,anchor_y,anchor_z,rov_x,rov_y,rov_z~{~a~}~%"
              (map (lambda (k) (format #f ",m~a_x_mm,m~:*~a_y_mm,m~:*~a_z_mm" k)) '(1 2 3 4 5)))
      (do ((k 0 (+ k 1))) ((> k (* 20 seconds)))
        (print-row (append (list (* 1000. (now)) 0. 0. -.2) (f64vector->list (rov-position))
                           (append-map (lambda (s) (map (lambda (x) (* 1000 x)) (f64vector->list (point-at s)))) marks)))
        (run 1/20)))))

(define-scenario from-a-dive
  "The drag of a line in a dive is found from its places, and the type that is made of it flies."
  (in pool)
  (settle! #:at-most 60)
  (define start (now))
  (every 1.5 (if (even? (inexact->exact (round (/ (- (now) start) 1.5))))
                 (drive! #:surge .6 #:sway .3 #:heave .2)
                 (drive! #:surge -.6 #:sway -.3 #:heave -.2)))
  (define file (scratch-file "dive.csv"))
  (record-dive file 4)
  (let ((i (identify file #:unknown '(cdn) #:known `((length 2.5) ,@near) #:places marks)) (user (make-fresh-user-module)))
    (expect (found i 'cdn) is (about 1.4 #:within .07))
    (module-use! user (resolve-interface '(bight)))
    (eval (identified-type i 'pool-cord) user)
    (enter! (world (sea (density 1000)) (rov (at 1.6 0 -1))
                   (tether (type pool-cord) (model dynamic) (from 0 0 -.2) (length 2.5))))
    (drive! #:surge .5)
    (run 1)
    (expect (tether-length) => 2.5)))

(define-scenario what-the-winch-has-hauled-in
  "A marker that has been hauled in, or cut off, is not seen, the dive goes on, and what was seen is measured."
  (in pool)
  (define file (scratch-file "hauled.csv"))
  (measure! file #:at '(.5 1 2.2) #:seconds .1)
  (haul-in! 1 #:rate .5)
  (run 3)
  (cut-tether! #:at .7)
  (run 1)
  (let ((rows (map (lambda (line) (string-split line #\,))
                   (string-split (string-trim-right (call-with-input-file file get-string-all)) #\newline))))
    (define (seen row) (map (lambda (k) (not (string=? "nan" (list-ref (list-ref rows row) k)))) '(8 11 14)))
    (expect (length rows) => 42)
    (expect (map seen '(1 31 32 41)) => '((#t #t #t) (#t #t #f) (#t #f #f) (#t #f #f)))))


(define cable '((diameter .008) (mass .06) (ea 1e4) (ei 2e-3) (bending-damping 1e-4) (cdt 0) (ca 0) (ba 0)))

(define-scenario a-set-that-a-drum-left
  "The natural curvature of a line that is swung in air is found with its stiffness, and the type that is made has it."
  (let* ((truth `(,@cable (set (curvature 2.5) (plane 30))))
         (rows (list-head swung 30))
         (file (scratch-file "coiled.csv"))
         (known `((length 2.5) ,@(but cable '(ei 1e-3)))))
    (write-run file rows (fly-truth rows marks truth #:density 1.2) 5 1e-4 (seed->random-state 3))
    (let* ((i (identify file #:unknown '(ei set) #:known known #:places marks #:intervals 20 #:step .05 #:density 1.2))
           (type (identified-type i 'coiled)) (set (cdr (assq 'set (filter pair? type)))))
      ;; Ends that are not clamped tell how much it is bent, not to which side.
      (expect (second (assq 'curvature set)) is (about 2.5 #:within .05))
      (expect (found i 'ei) is (about 2e-3 #:within 1e-4))
      (let ((user (make-fresh-user-module)))
        (module-use! user (resolve-interface '(bight)))
        (eval type user))
      (expect (string-contains (format #f "~a" (describe 'coiled)) "curvature 2.") is identity)))
  (expect (identify (measured-swing rope 0 1) #:unknown '(set) #:known `((length 2.5) ,@rope) #:places marks)
          raises def))

(define (swung-in-air file truth)
  ;; FILE has what a line of the fields TRUTH does in air.
  (let ((rows (list-head swung 30)))
    (write-run file rows (fly-truth rows marks truth #:density 1.2) 5 1e-4 (seed->random-state 3))
    file))

(define (find-in-air file unknown known)
  (identify file #:unknown unknown #:known `((length 2.5) ,@known) #:places marks #:intervals 20 #:step .05 #:density 1.2))

(define-scenario torsion-of-a-line-with-sets
  "The torsional stiffness of a line is found from how its sets, toward two sides, turn each other."
  (let* ((line `(,@cable (set (at .6) (span 1.2) (curvature 3)) (set (at 1.9) (span 1.2) (curvature 3) (plane 90))))
         (i (find-in-air (swung-in-air (scratch-file "kinked.csv") `(,@line (gj 1.5e-3))) '(torsion) `(,@line (gj 4e-4)))))
    (expect (found i 'gj) is (about 1.5e-3 #:within 1e-4))
    (expect (assq 'gj (filter pair? (identified-type i 'kinked))) is identity)))

(define-scenario layers-of-a-cable
  "So are how stiff the layers of a cable are that stick, and the curvature at which they slip."
  (let* ((line (but cable '(ei-stuck 8e-3) '(slip-curvature .4)))
         (i (find-in-air (swung-in-air (scratch-file "armoured.csv") line) '(ei-stuck slip-curvature)
                         (but cable '(ei-stuck 4e-3) '(slip-curvature .2)))))
    (expect (found i 'ei-stuck) is (about 8e-3 #:within 1e-3))
    (expect (found i 'slip-curvature) is (about .4 #:within .05))))

(define-scenario what-cannot-twist-or-slip
  "Torsion is sought of a line that is clamped or has a set, layers of one without a set."
  (define file (swung-in-air (scratch-file "plain.csv") cable))
  (expect (find-in-air file '(gj) cable) raises def)
  (expect (find-in-air file '(ei-stuck) cable) raises def)
  (expect (find-in-air file '(slip-curvature) `(,@cable (ei-stuck 8e-3) (set (curvature 1)))) raises def))

;;; Intervals.

(define long? (equal? "1" (getenv "BIGHT_LONG")))
(define lines (if long? 400 10))

(define short-swing (list-head swung 40))

(define-scenario coverage
  "Of intervals of 90 % about what is found from noise, nine in ten hold the truth."
  (define flown (fly-truth short-swing '(.9 1.6 2.2) rope #:intervals 10))
  (define (holding seed)
    (let ((file (scratch-file "drawn.csv")))
      (write-run file short-swing flown 3 2e-3 (seed->random-state seed))
      (let ((i (identify file #:unknown '(cdn wet-weight) #:known `((length 2.5) ,@wrong) #:places '(.9 1.6 2.2)
                         #:intervals 10 #:step .05 #:hold-out 0)))
        (map (lambda (name truth) (holds? i name truth)) '(cdn wet-weight) '(1.4 .15)))))
  (let* ((all (append-map holding (iota lines 1)))
         (share (/ (count identity all) (length all))))
    (format #t "# ~a of ~a intervals of 90 % hold the truth: ~,1f %~%" (count identity all) (length all) (* 100. share))
    ;; Of 20 with the chance .9 fewer than 15 hold the truth once in 90 times; the seeds are always the same.
    (expect share is (if long? (between .86 .94) (above .70)))))


;;; What is wrong.

(define (say-in-file text)
  (let ((file (scratch-file "bad.csv")))
    (with-output-to-file file (lambda () (display text)))
    file))

(define (said thunk)
  (with-exception-handler bight-error-message thunk #:unwind? #t #:unwind-for-type &bight-error))

(define-scenario errors-teach
  "What cannot be identified is said, with what is wanted and what was meant."
  (define good (measured-swing rope 0 1))
  (expect (string-contains (said (lambda () (find-in good '(cdnn) rope))) "cdn") is identity)
  (expect (find-in good '(drag-of-it) rope) raises name)
  (expect (find-in good '(friction) rope) raises def)
  (expect (find-in good '(cdn) '((weigth 3))) raises name)
  (expect (identify good #:unknown '(cdn) #:known '((length 2.5)) #:places '(.4 .9)) raises domain)
  (expect (identify good #:unknown '(cdn) #:known '((length 1.)) #:places marks) raises domain)
  (expect (identify "no-such.csv") raises io)
  (expect (identify (say-in-file "t,end_x,end_y,end_z,m1_x,m1_y\n0,1,1,1,0,0\n")) raises format)
  (expect (string-contains (said (lambda () (identify (say-in-file "t,speed\n0,1\n1,2\n")))) "anchor_x") is identity)
  (expect (string-contains
           (said (lambda () (identify (say-in-file "t,m1_x,m1_y,m1_z,m2_x,m2_y,m2_z,m3_x,m3_y,m3_z\n0,0,0,0,1,0,0,2,0,0\n"))))
           "rows")
          is identity)
  (expect (identify (say-in-file (string-append "t,m1_x,m1_y,m1_z,m2_x,m2_y,m2_z,m3_x,m3_y,m3_z\n"
                                                (string-concatenate (make-list 9 "0,0,0,0,1,0,0,2,0,0\n")))))
          raises format))


;;; Real lines.

(define folder
  (or (getenv "BIGHT_REFERENCE_DATA")
      (string-append (or (getenv "top_srcdir") "..") "/../shared/data")))

(define tank-file (string-append folder "/real/toulon_cable6_surge_0p6_0031.csv"))

(define-scenario rope-in-a-tank
  "The drag of a leaded rope in a tank, which its measurers took for 1.3, is found again (Filliung et al. 2024)."
  (unless (file-exists? tank-file)
    (skip "the reference data are not here"))
  (let ((i (identify tank-file #:unknown '(cdn) #:sigma "e_tg_mm" #:held 'all-over #:loss 'squares
                     #:known '((length 2.85) (diameter .0035) (mass .0517) (wet-weight .4) (ea 1e4) (cdt .01) (cdn .9))
                     #:places (map (lambda (k) (min 2.85 (+ .05 (* .2 k)))) (iota 15)) #:intervals 20 #:step .03)))
    (format #t "# cdn ~,3f; held out ~,1f mm~%" (found i 'cdn) (* 1000 (assq-ref (identified-score i) 'held-out)))
    (expect (found i 'cdn) is (about 1.3 #:within .1))))

;;; The long form: figures that bench/README.md tells.

(define (read-rows file)
  (call-with-input-file file
    (lambda (port)
      (filter-map (lambda (line)
                    (let ((cells (string-split line #\,)))
                      (and (string->number (first cells)) (map string->number cells))))
                  (string-split (get-string-all port) #\newline)))))

(define (mean numbers) (/ (apply + numbers) (length numbers)))

(define (tank-means i)
  ;; mm over the 16 markers, both ends among them: moving frames, those that are sure to 20 mm, and at rest.
  (let ((off (map (lambda (row) (* 1000 15/16 (second row))) (cdr (first (residuals-in-time i))))))
    (map (lambda (in?)
           (mean (filter-map (lambda (row d) (and (in? (list-ref row 11) (list-ref row 10)) d)) (read-rows tank-file) off)))
         (list (lambda (plain doubt) (> plain 20)) (lambda (plain doubt) (and (> plain 20) (< doubt 20)))
               (lambda (plain doubt) (<= plain 20))))))

(define (tank-fit unknown)
  (identify tank-file #:unknown unknown #:sigma "e_tg_mm" #:held 'all-over #:loss 'squares #:gravity 9.81
            #:known '((length 2.85) (diameter .0035) (mass .0517) (wet-weight .4) (ea 1e4) (cdt .01) (ca 1) (cdn 1.3))
            #:places (map (lambda (k) (min 2.85 (+ .05 (* .2 k)))) (iota 15)) #:intervals 57 #:step .03))

(define-scenario what-the-tank-lacks
  "With a vertical that leans by less than a degree, or with water that drifts by some centimetres a second, and no less,
a rope in a tank is as near as its measurers are sure; the vertical alone does it, with the drag that they tell."
  (unless long? (skip "long: BIGHT_LONG=1"))
  (unless (file-exists? tank-file) (skip "the reference data are not here"))
  (let ((means (map (lambda (unknown)
                      (let ((m (tank-means (tank-fit unknown))))
                        (format #t "# ~a: moving ~,1f, sure ~,2f, at rest ~,1f mm~%" unknown (first m) (second m) (third m))
                        m))
                    '((cdn) (cdn ei bending-damping clock) (cdn current) (cdn cdt ca current clock) (cdn vertical)))))
    (expect (second (list-ref means 3)) is (below 9.5))
    (expect (first (list-ref means 3)) is (below 36))
    (expect (first (list-ref means 4)) is (below 36))
    (expect (second (list-ref means 4)) is (below 9))
    (expect (third (list-ref means 4)) is (below 4))
    (expect (second (first means)) is (above 10))))

(define swung-cables
  '("deform_dlo1_eval55" "deform_dlo2_eval104" "deform_dlo3_eval106" "deform_dlo4_eval35" "deform_dlo5_eval18"))

(define* (cable-off name unknown #:key (held 'last) (step .0025) (intervals 40))
  ;; mm, on the rows that were not looked at, a half.
  (let ((i (identify (string-append folder "/real/" name ".csv") #:unknown unknown #:clamped #t
                     #:start 'moving #:density 1.2 #:gravity 9.81 #:step step #:intervals intervals #:loss 'squares
                     #:held held #:known '((diameter .01) (mass .05) (ea 1e4) (ba 0) (cdt 0) (ca 0) (ei 1e-3) (bending-damping 1e-4)))))
    (format #t "# ~a: held out ~,1f mm, ~a~%" name (* 1000 (assq-ref (identified-score i) 'held-out))
            (map (lambda (row) (list-head row 2)) (identified i)))
    (* 1000 (assq-ref (identified-score i) 'held-out))))

(define (most-off unknown)
  ;; mm
  (cond ((memq 'places unknown) 20) ((memq 'tilt unknown) 21) (else 28)))

(define-scenario (cables-swung-in-air unknown)
  "Of five cables swung in air (Chen et al. 2024) stiffness, its damping and length are found on half of a swing; and
by how much they leave their clamps beside two markers that are 2 cm apart, which is worth more than anything else."
  #:for ((unknown '(ei bending-damping length) '(ei bending-damping length tilt)
                  '(ei bending-damping length tilt places)))
  (unless long? (skip "long: BIGHT_LONG=1"))
  (unless (file-exists? tank-file) (skip "the reference data are not here"))
  (let ((off (mean (map (lambda (name) (cable-off name unknown)) swung-cables))))
    (format #t "# ~a: mean ~,1f mm~%" unknown off)
    (expect off is (below (most-off unknown)))))

(define-scenario (cables-looked-at-all-over unknown)
  "Looked at in the first half of each tenth of a swing, so that what is fitted has motions as fast as what is held out, the
same cables are nearer; a set is worth a millimetre there."
  #:for ((unknown '(ei bending-damping length tilt) '(ei bending-damping length tilt set)))
  (unless long? (skip "long: BIGHT_LONG=1"))
  (unless (file-exists? tank-file) (skip "the reference data are not here"))
  (let ((off (mean (map (lambda (name) (cable-off name unknown #:held 'all-over #:step .005 #:intervals 24))
                        swung-cables))))
    (format #t "# ~a, all over: mean ~,1f mm~%" unknown off)
    (expect off is (below (if (memq 'set unknown) 17.6 18.5)))))
