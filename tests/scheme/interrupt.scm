;;; ^C during calls of the engine that would last for hours: each ends at once with what the handler of the
;;; signal throws, the dive is as it was, and whoever watches was told how far it was.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight dive)
             (bight engine)
             ((srfi srfi-1) #:select (append-map))
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


;;; Each call that lasts.

(define (cpu-seconds)
  ;; Without those of the kernel: how long it takes to clear the pages of a new dive is the machine's affair.
  (/ (tms:utime (times)) 1.0 internal-time-units-per-second))

(define most-seconds 0.25)              ; of this process's work between two looks, on any machine

(define (pressed k thunk)
  ;; What became of THUNK when ^C is pressed at the K-th look whether somebody waits: a list of `interrupted' or
  ;; `ended', and the most seconds of work between two looks.
  (let ((last (cpu-seconds)) (worst 0) (looks 0))
    (define (look!)
      (let ((now (cpu-seconds)))
        (set! worst (max worst (- now last)))
        (set! last now)))
    (%set-reporter! (lambda (share)
                      (look!)
                      (when share
                        (set! looks (+ looks 1))
                        (when (= looks k) (throw 'too-long)))))
    (let ((end (catch 'too-long (lambda () (thunk) 'ended) (lambda _ 'interrupted))))
      (look!)
      (%set-reporter! (const #f))
      (list end worst))))

(define-syntax-rule (check-pressed what thunk again)
  ;; THUNK yields to ^C wherever it is pressed, leaves the dive as it was, and AGAIN is then answered as ever.
  (for-each (lambda (k)
              (let* ((before (state-hash)) (expected (what-if again)) (said (pressed k thunk)))
                (expect (list what k (car said)) => (list what k 'interrupted))
                (expect (cadr said) is (below most-seconds))
                (expect (state-hash) => before)
                (expect (equal? (what-if again) expected))))
            '(1 2 3)))

(define (one-line metres nodes model)
  (world (sea (depth 600) (current 0.3 90))
         (rov (named r) (at 30 0 -40))
         (tether (named t) (from 0 0 0) (to r) (length metres) (nodes nodes) (model ,model))))

(define (frames n)
  ;; N by N piles in the ground, with bars from each to the next ones: a grid of rings.
  (define (name letter i j)
    (string->symbol (simple-format #f "~a~a-~a" letter i j)))
  (append-map
   (lambda (i)
     (append-map
      (lambda (j)
        (let ((x (* 4 i)) (y (* 4 j)))
          (list (part cylinder (named ,(name 'pile i j)) (from x y -60) (to x y 0) (radius 0.2))
                (part cylinder (named ,(name 'east i j)) (from x y -20) (to (+ x 4) y -20) (radius 0.1))
                (part cylinder (named ,(name 'north i j)) (from x y -40) (to x (+ y 4) -40) (radius 0.1)))))
      (iota n)))
   (iota n)))

(define (among-frames n)
  (world (sea (depth 60) (current 0.3 90)) (seabed) (splice (frames n))
         (rov (named r) (at 22 22 -30))
         (tether (named t) (from 2 22 -3) (to r) (length 60) (nodes 100) (model dynamic))))

(define-scenario equilibria-and-operations
  "Equilibria of a line of many nodes, whoever looks for them."
  (enter! (one-line 2000 8000 'steady))
  (check-pressed 'equilibria (lambda () (equilibria)) (rov-tension))
  (check-pressed 'current! (lambda () (current! 0.5 10)) (begin (drive! #:surge 0.1) (now)))
  (enter! (one-line 2000 8000 'dynamic))
  (check-pressed 'place! (lambda () (place! '(60 40 -60))) (begin (run 0.05) (state-hash)))
  (check-pressed 'tether-model! (lambda () (tether-model! 'steady)) (begin (run 0.05) (state-hash)))
  (check-pressed 'haul-trial (lambda () (haul-trial)) (state-hash)))

(define-scenario within-a-step
  "A step that is left is not made: time stands at a step that was."
  (enter! (one-line 2000 8000 'steady))
  (let* ((fork-of (lambda (seconds) (what-if (drive! #:surge 0.5) (run seconds) (state-hash))))
         (known (map (lambda (n) (fork-of (* n (time-step)))) (iota 16))))
    (drive! #:surge 0.5)
    (for-each (lambda (k)
                (let ((said (pressed k (lambda () (run (* 3 (time-step)))))))
                  (expect (cadr said) is (below most-seconds))
                  (expect (->bool (member (state-hash) known)))))
              '(1 2 3 4 5))))

(define-scenario charts
  "What a question makes of the world once, such as the words of many members, is left as well."
  (enter! (among-frames 10))
  (check-pressed 'homotopy-class (lambda () (homotopy-class)) (free-length)))

(define-scenario too-many-members
  "Where members are too many to tell classes by, that is said in good time."
  (enter! (among-frames 20))
  (let ((begun (cpu-seconds)))
    (expect (homotopy-class) raises limit)
    (expect (- (cpu-seconds) begun) is (below 20))))

(define-scenario entering
  "A world that is refused its building leaves the dive that was."
  (enter-with! 40)
  (let ((big (world (sea (depth 60))
                    (seabed (grid (lambda (x y) (+ -50 (/ (modulo (inexact->exact (round (+ x (* 3 y)))) 7) 10)))
                                  (from 0 0) (to 700 700) (spacing 1)))
                    (rov (named r) (at 350 350 -20))
                    (tether (named t) (from 340 350 0) (to r) (length 40) (model dynamic)))))
    (check-pressed 'enter! (lambda () (enter! big)) (begin (run 0.05) (state-hash)))))

(define-scenario live
  "A live dive's caller waits no longer than it likes, and its thread leaves what it was at."
  (enter-with! 100000)
  (live! #:pace 1000)
  (expect (car (pressed 3 (lambda () (place! '(100000 0 -20))))) => 'interrupted)
  (expect (live?))
  (let ((t (now)))
    (expect (car (pressed 3 (lambda () (place! '(100000 0 -20))))) => 'interrupted)
    (run 1)
    (expect (> (now) t)))
  (freeze!)
  (expect (x (rov-position)) is (below 1000)))
