;;; What is dropped is freed: whatever makes dives, made again and again, takes no more memory than at first.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

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
