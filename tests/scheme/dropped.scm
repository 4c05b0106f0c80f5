;;; What is dropped is freed: whatever makes dives, made again and again, takes no more memory than at first.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight dive) #:select (fork-dive with-dive)))

(define scene
  (world (sea (depth 9) (current .3 90)) (seabed) (rov (named minnow) (at 3 2 -5))
         (tether (named line) (from 0 0 0) (to minnow) (length 10) (nodes 24) (model dynamic))))

(define (megabytes)
  "The memory that this process holds, 0 where the system does not tell."
  (if (file-exists? "/proc/self/statm")
      (* 4096e-6 (call-with-input-file "/proc/self/statm" (lambda (port) (read port) (read port))))
      0))

(define (peak n thunk)
  "The most that this process holds as THUNK is called N times: what is held at the end alone depends on when memory was
last collected, and on what of it could be given back."
  (let loop ((i 0) (most 0))
    (if (= i n)
        most
        (begin
          (thunk)
          (loop (+ i 1) (max most (megabytes)))))))

(define (growth n thunk)
  "By how many megabytes the peak of this process grows as THUNK is called N times, once it was called as often."
  (let ((before (peak n thunk)))
    (- (peak n thunk) before)))

(define (saved)
  (let ((file (scratch-file "dropped.dive")))
    (save! file)
    file))

(define-scenario what-is-dropped-is-freed
  "A world entered, a fork, a checkpoint, a dive loaded or begun anew: 200 dives of this size, kept, take 300 MB;
what is dropped is freed, so that memory grows by less than 30 MB."
  (enter! scene)
  (let ((file (saved)))
    (for-each
     (lambda (row)
       (let ((grown (growth 200 (cdr row))))
         (expect (list (car row) (if (< grown 30) 'freed grown)) => (list (car row) 'freed))))
     (list (cons 'enter! (lambda () (enter! scene)))
           (cons 'enter-and-ask (lambda () (enter! scene) (tether-points 33) (max-tension)))
           (cons 'enter-and-run (lambda () (enter! scene) (run 1/60)))
           (cons 'enter-and-checkpoint (lambda () (enter! scene) (restore! (checkpoint))))
           (cons 'fork (lambda () (what-if (run 1/60))))
           (cons 'load-dive (lambda () (load-dive file)))
           (cons 'alter! (lambda () (alter! 'line #:cdn 1.4)))))))

(define (collections n thunk)
  "How often memory is collected as THUNK is called N times."
  (gc)
  (let ((before (assq-ref (gc-stats) 'gc-times)))
    (do ((i 0 (+ i 1))) ((= i n)) (thunk))
    (- (assq-ref (gc-stats) 'gc-times) before)))

(define-scenario a-fork-counts-as-the-state-that-it-is
  "The collector hears of one state for a fork that is asked, and of another once the fork is flown: told of two for each,
forks that are asked had memory collected as often as those that are flown."
  (enter! (with scene (line (drum 4000) (accuracy 0.001))))
  (let* ((asked (collections 1500 (lambda () (with-dive (fork-dive (current-dive)) (now)))))
         (flown (collections 1500 flown-fork)))
    (expect flown is (above 5))
    (expect asked is (below (* 3/4 flown)))))

(define (flown-fork)
  (let ((fork (fork-dive (current-dive))))
    (with-dive fork (run 1/60))
    fork))

(define (keep-each-twentieth! forks)
  "Drop the other FORKS, a vector, and have what was dropped collected."
  (for-each (lambda (i)
              (unless (= 0 (modulo i 20))
                (vector-set! forks i #f)))
            (iota (vector-length forks)))
  (for-each (lambda (i) (gc) (flown-fork)) (iota 3)))

(define-scenario what-lies-between-what-is-kept-is-given-back
  "Of 800 flown forks each twentieth is kept: the system gets more than half of the memory back, though what is kept lies
between what is dropped."
  (when (= 0 (megabytes))
    (skip "the system does not tell what a process holds"))
  (enter! scene)
  (let* ((before (megabytes)) (forks (make-vector 800 #f)))
    (for-each (lambda (i) (vector-set! forks i (flown-fork))) (iota 800))
    (let ((most (- (megabytes) before)))
      (expect most is (above 50))
      (keep-each-twentieth! forks)
      (expect (- (megabytes) before) is (below (* 0.5 most)))
      (expect (vector-length forks) => 800))))
