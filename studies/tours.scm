;; Tours that `plan-tour' plans, flown in currents that the plan does not know, as `bight sweep tours' flies them: six
;; members of a structure of the catalogue, drawn by the seed, each seen from a metre off, in water that sets with up to
;; 0.3 m/s anywhere.  The vehicle comes home, or not; its tether is fouled then, or not.
;;
;;   bight sweep tours -o tours.db
;;   bight sweep --table tours.db --by place

(use-modules ((srfi srfi-1) #:select (filter list-head)))

(define visits 6)

(define (from-to low high)
  (+ low (* (random 1.0) (- high low))))

(define (member? part)
  (string-index (symbol->string part) #\/))

(define (drawn n all)
  ;; N of ALL, in the order in which they come out.
  (if (or (zero? n) (null? all))
      '()
      (let ((one (list-ref all (random (length all)))))
        (cons one (drawn (- n 1) (delq one all))))))

(define (processor-time)
  (/ (get-internal-run-time) internal-time-units-per-second 1.0))

(define (timed thunk)
  ;; What THUNK returns, and the seconds of processor time that it took: a pair.
  (let* ((start (processor-time)) (value (thunk)))
    (cons value (- (processor-time) start))))

(define-study tours
  "Do planned tours come home, their tether free, in currents the plan does not know?"
  #:for ((place (grid 'jacket 'pier 'wreck 'cage 'rigging 'net-pen))
         (seed (range 1 10 1)))
  (at-most 3000)
  (in (with place (current (from-to 0 0.3) (from-to 0 360))))
  (define planned (timed (lambda () (plan-tour (drawn visits (filter member? (parts))) #:line 80))))
  (define tour (car planned))
  (define flown (tour-trial tour))
  (measure (home (assq-ref flown 'home?))
           (fouled (assq-ref flown 'fouled?))
           (reached (assq-ref flown 'reached))
           (planned (length (tour-names tour)))
           (left-out (length (tour-left-out tour)))
           (length (tour-length tour))
           (line (tour-line-needed tour))
           (seconds (assq-ref flown 'seconds))
           (processor (cdr planned))))
