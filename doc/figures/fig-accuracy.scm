;;; Mesh and steps of a line of model `auto' over a dive: it lies on the bed, is flown off, runs taut, and is
;;; drawn round a post.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (ice-9 popen)
             (srfi srfi-1))

(enter! (world (sea (depth 12) (current 0.1 90))
               (seabed (friction 0.4))
               (cylinder (named post) (from 8 3 -12) (to 8 3 0) (radius 0.15))
               (rov (named minnow) (type kinematic) (at 13 0 -11.5) (pull 2000) (surge-speed 2))
               (tether (named line) (wet-weight 0.2) (model auto) (accuracy 0.05) (nodes 32) (from 0 0 -5)
                       (to minnow) (length 22))))

(define rows '())                       ; time, nodes, steps for a second, tension, newest first

(define (taken)
  (let ((p (profile)))
    (+ (assq-ref p 'chain-steps) (assq-ref p 'chain-parts))))

(define (watch! seconds)
  "Run, and note twice a second."
  (do ((k 0 (+ k 1))) ((>= k (* 2 seconds)))
    (let ((before (taken)))
      (run 0.5)
      (set! rows (cons (list (now) (car (array-dimensions (tether-points 'line))) (* 2 (- (taken) before))
                             (max 1 (rov-tension 'line)))
                       rows)))))

(define marks                           ; when each part began
  (map (lambda (name part)
         (let ((begun (now)))
           (part)
           (cons name begun)))
       '("lies" "flies" "snaps" "touches")
       (list (lambda () (watch! 30))
             (lambda () (fly-to! '(15 -11 -5) #:speed 0.5) (watch! 30))
             (lambda () (fly-to! '(24 -18 -5) #:speed 1.2) (watch! 10))
             (lambda ()
               (fly-to! '(14 6 -6) #:speed 0.8)
               (watch! 30)
               (fly-to! '(1 14 -6) #:speed 0.5)
               (watch! 40)))))

(define (lines port column)
  (for-each (lambda (row) (simple-format port "~a ~a\n" (first row) (list-ref row column))) (reverse rows))
  (display "e\n" port))

(let ((port (open-pipe* OPEN_WRITE "gnuplot")))
  (display "set terminal pngcairo size 960,600 font 'DejaVu Sans,11'\nset output 'fig-accuracy.png'\nunset key\n" port)
  (display "set multiplot layout 3,1 margins 0.1,0.98,0.09,0.94 spacing 0.02\nset xrange [0:140]\nset grid\n" port)
  (for-each (lambda (mark)
              (simple-format port "set arrow from ~a, graph 0 to ~a, graph 1 nohead dt 2\n" (cdr mark) (cdr mark)))
            marks)
  (for-each (lambda (column name setting)
              (simple-format port "set ylabel '~a'\n~a\n" name setting)
              (when (= column 1)
                (for-each (lambda (mark)
                            (simple-format port "set label '~a' at ~a, graph 1.05\n" (car mark) (+ (cdr mark) 0.5)))
                          marks))
              (simple-format port "plot '-' using 1:2 with ~a lw 2\n" (if (= column 2) "impulses" "lines"))
              (lines port column)
              (display "unset label\n" port))
            '(1 2 3)
            '("nodes" "steps a second" "tension, N")
            '("set format x ''" "set logscale y; set yrange [1:*]" "set format x '%g'; set xlabel 'time, s'; set yrange [1:*]"))
  (close-pipe port))
