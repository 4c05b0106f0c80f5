;;; (bight dive past) --- what a dive remembers of itself, so that it can be taken back in time.
;;;
;;; Now and then a dive keeps its state, a moment; between moments it keeps what was done to it and how
;;; the tasks between its steps stood.  To go back means to restore the last moment before, and to do
;;; and step again what followed: the same bits come out.  A past is a value that shares what it can
;;; with the one it came from, so that a checkpoint holds its own and a fork goes on with its origin's.
;;;
;;; A moment a second is kept for two minutes; of older ones those go first whose gap is smallest beside
;;; their age.  Of a dive that runs fast fewer are kept: where there is little to do again.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive past)
  #:use-module (bight core record)
  #:use-module (bight engine)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (new-past
            past-with-moment
            past-with-moments
            past-with-tasks
            past-oldest past-oldest-bytes past-oldest-serial
            go-back!
            past? moment? mark?
            entry-serial entry-step entry-operation entry-subject entry-numbers))

(define most-moments 256)
(define most-bytes (* 64 1024 1024))
(define most-noted 50000)               ; operations, and changes of tasks
(define recent (* 120 60))              ; steps: two minutes
(define second 60)                      ; steps
(define longest-gap (* 60 60))          ; steps: a minute
(define worth-keeping                   ; what it must take to do again, in clock ticks: 10 ms
  (quotient internal-time-units-per-second 100))

;; The journal's entries, as (bight engine) makes them.
(define (entry-serial entry)
  "Return the number of ENTRY, higher for what was done later."
  (vector-ref entry 0))
(define (entry-step entry)
  "Return the step at which ENTRY was done."
  (vector-ref entry 1))
(define (entry-operation entry)
  "Return the operation of ENTRY, a symbol."
  (vector-ref entry 2))
(define (entry-subject entry)
  "Return the index of the part that ENTRY is about."
  (vector-ref entry 3))
(define (entry-numbers entry)
  "Return the numbers of ENTRY, an f64vector."
  (vector-ref entry 4))

(define-record <moment>
  (make-moment step bytes tasks serial)
  moment?
  (step moment-step)
  (bytes moment-bytes)
  (tasks moment-tasks)                  ; as `tasks-state' returns them
  (serial moment-serial))               ; of the last operation before it

;; After the tasks of STEP had run: how they stood, and the last operation there was.
(define-record <mark>
  (make-mark step tasks serial)
  mark?
  (step mark-step)
  (tasks mark-tasks)
  (serial mark-serial))

(define-record <past>
  (make-past moments marks noted clock)
  past?
  (moments past-moments)                ; the newest first; never empty
  (marks past-marks)                    ; the newest first
  (noted past-noted)                    ; how many they are
  (clock past-clock))                   ; when the newest moment was kept

(define (moment-now engine tasks)
  (make-moment (%dive-steps engine) (%keep-dive engine) tasks (%serial engine)))

(define (new-past engine tasks)
  "Return the past of a dive that begins now: ENGINE its handle, TASKS what runs between its steps."
  (make-past (list (moment-now engine tasks)) '() 0 (get-internal-real-time)))

(define (past-oldest past)
  "Return the first step that one can go back to."
  (moment-step (last (past-moments past))))

(define (past-oldest-bytes past)
  "Return the state at that step, a bytevector."
  (moment-bytes (last (past-moments past))))

(define (past-oldest-serial past)
  "Return the number of the last operation before that state."
  (moment-serial (last (past-moments past))))


;;; Remembering.

(define (same-tasks? a b)
  (or (and (null? a) (null? b))
      (and (pair? a) (pair? b)
           (eq? (caar a) (caar b))
           (eqv? (cdar a) (cdar b))
           (same-tasks? (cdr a) (cdr b)))))

(define (last-tasks past)
  (let ((moment (car (past-moments past))) (marks (past-marks past)))
    (if (and (pair? marks) (>= (mark-step (car marks)) (moment-step moment)))
        (mark-tasks (car marks))
        (moment-tasks moment))))

(define (past-with-tasks past engine step tasks)
  "Return PAST and what the TASKS of STEP, which have just run, left behind."
  (let* ((journal (%journal engine))
         (done? (and (pair? journal) (= step (entry-step (car journal))))))
    (if (and (not done?) (same-tasks? tasks (last-tasks past)))
        past
        (make-past (past-moments past)
                   (cons (make-mark step tasks (%serial engine)) (past-marks past))
                   (+ 1 (past-noted past))
                   (past-clock past)))))

(define (room-for size)
  (max 2 (min most-moments (quotient most-bytes (max 1 size)))))

(define (thinned moments now)
  ;; MOMENTS without the one that is missed least: neither the newest nor the oldest.
  (let loop ((rest moments) (least #f) (victim #f))
    (if (or (null? (cdr rest)) (null? (cddr rest)))
        (if victim (delq victim moments) moments)
        (let* ((gap (- (moment-step (car rest)) (moment-step (caddr rest))))
               (cost (/ gap (max recent (- now (moment-step (cadr rest)))))))
          (if (or (not least) (<= cost least))
              (loop (cdr rest) cost (cadr rest))
              (loop (cdr rest) least victim))))))

(define (bounded past engine)
  ;; PAST without its older half when too much was noted in it.
  (let* ((moments (past-moments past))
         (noted (+ (past-noted past)
                   (- (moment-serial (car moments)) (moment-serial (last moments))))))
    (if (or (<= noted most-noted) (null? (cdr moments)))
        past
        (let* ((kept (take moments (quotient (+ 1 (length moments)) 2)))
               (oldest (last kept))
               (marks (take-while (lambda (m) (>= (mark-step m) (moment-step oldest))) (past-marks past))))
          (%set-journal! engine
                         (take-while (lambda (e) (> (entry-serial e) (moment-serial oldest)))
                                     (%journal engine)))
          (make-past kept marks (length marks) (past-clock past))))))

(define (add-moment past moment)
  (let* ((moments (cons moment (past-moments past)))
         (room (room-for (bytevector-length (moment-bytes moment)))))
    (make-past (if (> (length moments) room) (thinned moments (moment-step moment)) moments)
               (past-marks past)
               (past-noted past)
               (get-internal-real-time))))

(define (due? past step)
  (let ((gap (- step (moment-step (car (past-moments past))))))
    (and (>= gap second)
         (or (>= gap longest-gap)
             (>= (- (get-internal-real-time) (past-clock past)) worth-keeping)))))

(define (past-with-moment past engine tasks)
  "Return PAST and, when that is due, the present moment: ENGINE with the TASKS between its steps, which
have run."
  (if (due? past (%dive-steps engine))
      (bounded (add-moment past (moment-now engine (tasks))) engine)
      past))

(define (serial-before journal step)
  ;; The number of the last operation before STEP was reached.
  (let ((entry (find (lambda (e) (< (entry-step e) step)) journal)))
    (if entry (entry-serial entry) 0)))

(define (past-with-moments past engine moments tasks)
  "Return PAST and MOMENTS, vectors #(step hash state), the oldest first, which a thread has kept."
  (fold (lambda (m past)
          (let ((step (vector-ref m 0)))
            (if (> step (moment-step (car (past-moments past))))
                (add-moment past
                            (make-moment step (vector-ref m 2) tasks
                                         (serial-before (%journal engine) step)))
                past)))
        past moments))


;;; Going back.

(define (find-mark past moment step)
  ;; The last mark from MOMENT to STEP, or #f.
  (find (lambda (m) (<= (moment-step moment) (mark-step m) step)) (past-marks past)))

(define (done-between journal moment step mark)
  ;; What was done after MOMENT up to when STEP was reached and its tasks had run; the oldest first.
  (define (before? entry)
    (or (< (entry-step entry) step)
        (and mark (= step (mark-step mark) (entry-step entry))
             (<= (entry-serial entry) (mark-serial mark)))))
  (reverse!
   (filter! before?
            (take-while (lambda (e) (> (entry-serial e) (moment-serial moment))) journal))))

(define (do-again! engine entries step)
  (define (step-to! n)
    (%step-dive! engine (max 0 (- n (%dive-steps engine)))))
  (for-each (lambda (e)
              (step-to! (entry-step e))
              (%redo! engine (entry-operation e) (entry-subject e) (entry-numbers e)))
            entries)
  (step-to! step))

(define (go-back! past engine step)
  "Bring ENGINE, whose past is PAST, back to when STEP was reached and its tasks had run, and return two
values: its past then, and how its tasks stood."
  (let* ((journal (%journal engine))
         (moments (drop-while (lambda (m) (> (moment-step m) step)) (past-moments past)))
         (moment (car moments))
         (mark (find-mark past moment step))
         (entries (done-between journal moment step mark))
         (serial (if (null? entries) (moment-serial moment) (entry-serial (last entries))))
         (marks (drop-while (lambda (m) (> (mark-step m) step)) (past-marks past))))
    (%restore-dive! engine (moment-bytes moment))
    (do-again! engine entries step)
    (%set-journal! engine (drop-while (lambda (e) (> (entry-serial e) serial)) journal))
    (values (make-past moments marks (length marks) (get-internal-real-time))
            (if mark (mark-tasks mark) (moment-tasks moment)))))
