;;; (bight dive any-flight) --- random orders to a dive in a random world.
;;;
;;; The orders speak of parts by the names that (bight world any-world) gives: o1, r1, t1, ...  An order to a part
;;; that a world does not have is refused, as any order may be.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive any-flight)
  #:use-module (bight core schema)
  #:use-module (bight test generator)
  #:use-module (bight world field-values)
  #:use-module (srfi srfi-1)
  #:export (any-flight
            order-kinds))

(define (verb name . generators)
  ;; (NAME VALUE ...) of what GENERATORS draw.
  (apply made-of (lambda values (cons name values)) generators))

(define a-vehicle (one-of 'r1 'r1 'r1 'r2 'r3))
(define a-tether (one-of 't1 't1 't1 't2 't3 't4))
(define an-obstacle (one-of 'o1 'o2 'o3 'o4))

(define stick (uniform -1 1))
(define a-model (apply one-of (field-words (head-field 'tether 'model))))

(define (a-point wild?)
  ;; Among or beside what stands in the water; in a wild flight also far off and above the water.
  (let ((near (made-of (lambda (p) `(vec ,@p)) any-place))
        (across (made-of (lambda (x y z) `(vec ,x ,y ,z))
                         (uniform -6 10) (uniform -9 9) (uniform -12 -1))))
    (if wild?
        (any-of across across near (one-as-it-is '(vec 1000 0 -20) '(vec 0 0 5) '(vec 3 2 -9000)))
        (any-of across across near))))


;;; What may be altered: all that the schema says is live.

(define (as-argument values)
  (let ((value (if (null? (cdr values)) (car values) values)))
    (if (or (symbol? value) (pair? value)) (list 'quote value) value)))

(define (alterations head part wild?)
  ;; Generators of (alter! PART #:FIELD VALUE), one for each live field of parts with HEAD.
  (map (lambda (field)
         (made-of (lambda (name values)
                    `(alter! ,name ,(symbol->keyword (field-name field)) ,(as-argument values)))
                  part (field-value head field wild?)))
       (filter field-live? (head-fields head))))

(define (any-alteration wild?)
  (apply any-of
         (append-map (lambda (head)
                       (alterations head
                                    (case head
                                      ((sea) (one-of 'sea))
                                      ((rov) a-vehicle)
                                      ((tether) a-tether)
                                      ((seabed) (one-of 'seabed))
                                      (else an-obstacle))
                                    wild?))
                     (delete 'group (part-heads)))))


;;; Kinds of orders.

(define (paid-out wild?)
  ;; As a share of what is out now: up to 50 times as much in a wild flight, in two seconds or slowly.
  (made-of (lambda (t share seconds)
             `(pay-out! ,t (* ,share (tether-length ,t)) #:rate (/ (* ,share (tether-length ,t)) ,seconds)))
           a-tether
           (if wild? (any-of (magnitudes 1/10 2) (magnitudes 2 49)) (magnitudes 1/50 1))
           (magnitudes 1 20)))

(define (plain-orders wild?)
  ;; alist, kind -> generator of one order
  (let ((point (a-point wild?)) (speed (if wild? (magnitudes 1/10 50) (uniform 1/2 3))))
    `((drive . ,(made-of (lambda (v a b c d) `(drive! ,v #:surge ,a #:sway ,b #:heave ,c #:yaw ,d))
                         a-vehicle stick stick stick stick))
      (fly . ,(made-of (lambda (v p s) `(fly-to! ,v ,p #:speed ,s)) a-vehicle point speed))
      (move . ,(made-of (lambda (v p s) `(move! ,v ,p #:speed ,s)) a-vehicle point speed))
      (place . ,(verb 'place! a-vehicle point))
      (fresh . ,(made-of (lambda (v p) `(place! ,v ,p #:fresh #t)) a-vehicle point))
      (hold . ,(any-of (verb 'hold-position! a-vehicle) (verb 'hold-depth! a-vehicle (uniform 0 12))
                       (verb 'hold-altitude! a-vehicle (uniform 0 5))
                       (verb 'hold-heading! a-vehicle bearing) (verb 'release! a-vehicle)))
      (follow . ,(made-of (lambda (v a b) `(follow! ,v (list (cons 0 (list ,@a)) (cons 4 (list ,@b)))))
                          a-vehicle any-place any-place))
      (pay-out . ,(paid-out wild?))
      (haul-in . ,(made-of (lambda (t share rate) `(haul-in! ,t (* ,share (tether-length ,t)) #:rate ,rate))
                           a-tether (uniform 0 1) speed))
      (cut . ,(made-of (lambda (t share) `(cut-tether! ,t #:at (* ,share (tether-length ,t))))
                       a-tether (uniform 0 1)))
      (model . ,(verb 'tether-model! a-tether a-model))
      (accuracy . ,(verb 'accuracy! a-tether (magnitudes 1/50 1)))
      (current . ,(made-of (lambda (speed toward) `(current! ,speed ,toward)) (uniform 0 1) bearing))
      (alter . ,(any-alteration wild?))
      (fault . ,(made-of (lambda (do v what) `(,do ,v ',what))
                         (any-of (one-as-it-is 'fault! 'mend!)) a-vehicle
                         (one-as-it-is 'compass 'depth 'speed 'altitude 'tension 'telemetry 'thruster)))
      (threads . ,(verb 'threads! (integer 1 3))))))

(define (one-as-it-is . expressions)
  ;; As `one-of', but of expressions that stand in the order as they are, unquoted.
  (made-of cadr (apply one-of expressions)))

(define (timed order)
  ;; An order, and then some seconds.
  (made-of (lambda (order seconds) (list order `(run ,seconds))) order (uniform 0 2)))

(define (nested-orders wild?)
  ;; alist, kind -> generator of a list of orders that hold other orders
  (let ((inner (list-of (timed (apply any-of (map cdr (plain-orders wild?))))
                        #:least 1 #:most 3 #:make concatenate)))
    `((fork . ,(made-of (lambda (orders) `((what-if ,@orders))) inner))
      ;; Gone back to by force: an order that is refused halfway leaves nothing of those before it.
      (restore . ,(made-of (lambda (orders)
                             `((let ((here (checkpoint)))
                                 (dynamic-wind (const #f) (lambda () ,@orders) (lambda () (restore! here))))))
                           inner))
      (rewind . ,(made-of (lambda (s) `((rewind! ,s))) (uniform 0 4)))
      (save . ,(made-of (lambda (n) `((same-when-loaded! ,n))) (integer 0 60))))))

(define order-kinds
  (append (map car (plain-orders #f)) (map car (nested-orders #f))))

(define usual '(drive fly move pay-out haul-in model))

(define* (any-flight #:key wild? (most 8) (kinds (append order-kinds usual usual)))
  "Return a generator of flights: lists of orders, at most MOST of them with the seconds that each is given,
of KINDS, which may name a kind twice.  In a WILD? one numbers come from all that is allowed."
  (let ((plain (plain-orders wild?)) (nested (nested-orders wild?)))
    (list-of (apply any-of (map (lambda (kind)
                                  (or (and=> (assq-ref plain kind) timed) (assq-ref nested kind)))
                                kinds))
             #:most most #:make concatenate)))
