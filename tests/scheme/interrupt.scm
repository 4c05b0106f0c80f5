;;; ^C during calls of the engine that would last for hours: each ends at once with what the handler of the
;;; signal throws, the dive is as it was, and whoever watches was told how far it was.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight dive)
             (bight engine)
             (srfi srfi-4))

(define-syntax-rule (enter-with! metres)
  (enter! (world (sea (depth 100))
                 (sphere (named ball) (at 4 -2 -23) (radius 0.27))
                 (rov (named r) (at 2 -5 -26))
                 (tether (named t) (from -8 -1 -17) (to r) (length metres) (model dynamic) (nodes 24)))))

(define shares '())

(define (call-interrupted thunk)
  ;; What became of THUNK when an alarm throws some time after it began: `interrupted', or `ended'.
  (set! shares '())
  (%set-reporter! (lambda (share) (set! shares (cons share shares))))
  (let ((old #f))
    (dynamic-wind
      (lambda ()
        (set! old (sigaction SIGALRM (lambda (signal) (throw 'too-long))))
        (setitimer ITIMER_REAL 0 0 0 200000))
      (lambda () (catch 'too-long (lambda () (thunk) 'ended) (lambda _ 'interrupted)))
      (lambda ()
        (setitimer ITIMER_REAL 0 0 0 0)
        (sigaction SIGALRM (car old) (cdr old))))))

(define (told-how-far?)
  ;; Was whoever watches told how far the call was, and then that it was over?
  (and (pair? shares)
       (not (car shares))
       (pair? (cdr shares))
       (and-map (lambda (share) (and (real? share) (<= 0 share 1))) (cdr shares))))

(define (done)
  (length (%journal (engine-of (this-dive 'test)))))

(define-scenario far-away
  "A vehicle put a hundred kilometres away among obstacles is dragged there until ^C."
  (enter-with! 100000)
  (let ((before (state-hash)) (had-done (done)))
    (expect (call-interrupted (lambda () (place! '(100000 0 -20)))) => 'interrupted)
    (expect (told-how-far?))
    (expect (state-hash) => before)
    (expect (done) => had-done)
    (expect (call-interrupted (lambda () (what-if (place! '(100000 0 -20))))) => 'interrupted)
    (expect (state-hash) => before)
    (run 1)
    (expect (> (now) 0.9))))

(define-scenario long-runs
  "Time that passes, and hauls on forks, end by ^C too."
  (enter-with! 400)
  (expect (call-interrupted (lambda () (run 1e8))) => 'interrupted)
  (expect (call-interrupted
           (lambda () (let loop () (free-to-haul? #:pull 100 #:rate 0.01) (loop))))
          => 'interrupted))
