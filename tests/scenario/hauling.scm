;;; Hauling a dead vehicle among piles, braces and blocks drawn by seed: the answer at once, the haul on a
;;; fork, and the fork with twice the nodes.  BIGHT_LONG=1 draws 200 scenes instead of 8.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (srfi srfi-1) ((bight assembly) #:select (data->part)))

(define scenes (if (getenv "BIGHT_LONG") 200 8))

(define (between* dice low high)
  (+ low (* (random:uniform dice) (- high low))))

(define (point* dice)
  (list (between* dice -8 8) (between* dice -8 8) (between* dice -14 -4)))

(define (obstacle dice kind i)
  (let ((name (string->symbol (simple-format #f "o~a" i)))
        (p (point* dice)) (q (point* dice)))
    (case kind
      ((piles) `(cylinder (named ,name) (from ,(first p) ,(second p) 1) (to ,(first p) ,(second p) -20)
                          (radius ,(between* dice 0.2 0.6))))
      ((braces) `(capsule (named ,name) (from ,@p) (to ,@q) (radius ,(between* dice 0.1 0.3))))
      (else `(box (named ,name) (at ,@p) (size ,@(list-tabulate 3 (lambda (i) (between* dice 1 3)))))))))

(define (length-of points)
  (if (null? (cdr points))
      0
      (+ (distance (apply vec (car points)) (apply vec (cadr points))) (length-of (cdr points)))))

(define (scene seed nodes)
  ;; A world, or #f when the lay that was drawn meets something.
  (let* ((dice (seed->random-state (+ 77000 seed)))
         (kind (list-ref '(piles braces boxes) (modulo seed 3)))
         (parts (list-tabulate 7 (lambda (i) (obstacle dice kind i))))
         (way (append (list (list -11 0 -9)) (list-tabulate 5 (lambda (i) (point* dice)))))
         (end (last way)))
    (with-exception-handler
     (lambda (e) #f)
     (lambda ()
       (world (sea (depth 20)) (seabed)
              (splice (map data->part parts))
              (splice (data->part `(rov (named minnow) (type bluerov2-heavy) (at ,@end))))
              (splice (data->part `(tether (named line) (type fathom) (wet-weight 0) (from ,@(car way))
                                           (to minnow) (length ,(* 1.1 (length-of way))) (nodes ,nodes)
                                           (via ,@(drop-right (cdr way) 1)) (model dynamic))))))
     #:unwind? #t)))

(define (enter seed nodes)
  ;; A dive in the scene, or #f.
  (let ((w (scene seed nodes)))
    (and w
         (with-exception-handler (lambda (e) #f) (lambda () (enter! w)) #:unwind? #t))))

(define (judge seed)
  ;; (INSTANT FORK FINER) of the scene, or #f.
  (and (enter seed 64)
       (let ((instant (haul-prospect)) (fork (free-to-haul?)))
         (enter seed 128)
         (list instant fork (free-to-haul?)))))

(define (share n all)
  (if (null? all) 0 (/ n (length all))))

(define-scenario hauling
  "The fork agrees with one of twice the nodes; the answer at once does not cry wolf too often.  What it
misses is printed in the long form."
  (define all
    (let loop ((seed 1) (n 0) (all '()))
      (if (= n scenes)
          all
          (let ((j (judge seed)))
            (loop (+ seed 1) (if j (+ n 1) n) (if j (cons j all) all))))))
  (define (bad? j) (not (second j)))
  (define (warned? j) (not (and (memq (first (first j)) '(yes unsure)) (eq? 'clear (second (first j))))))
  (define stuck (filter bad? all))
  (define free (remove bad? all))
  (define missed (count (lambda (j) (not (warned? j))) stuck))
  (define false-alarms (count warned? free))
  (define agreed (count (lambda (j) (eq? (second j) (third j))) all))
  (when (getenv "BIGHT_LONG")
    (simple-format #t "# ~a scenes: ~a stuck, ~a missed; ~a false alarms; ~a agreed\n" (length all)
                   (length stuck) missed false-alarms agreed))
  (expect (share agreed all) is (between 3/4 1))
  (expect (share false-alarms free) is (between 0 1/2)))

(define-scenario nothing-hangs-from-a-winch
  "Of a line that was cut each question about its haul says that nothing hangs from its winch."
  (enter! (world (sea (depth 30)) (rov (named r1) (at 0 10 -5))
                 (tether (named t1) (from 0 0 -5) (to r1) (length 20) (model dynamic))))
  (expect (car (haul-prospect)) => 'yes)
  (cut-tether! #:at 10)
  (expect (haul-prospect) raises unsupported)
  (expect (haul-trial) raises unsupported)
  (expect (free-to-haul?) raises unsupported))
