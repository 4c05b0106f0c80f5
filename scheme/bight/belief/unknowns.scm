;;; (bight belief unknowns) --- which fields of a world are uncertain, and how.
;;;
;;; Every unknown has one or more latent numbers, each standard normal and independent of the others before
;;; anything is observed; the unknown's values follow from them.  So one update of Gaussian numbers serves any
;;; distribution, and no value leaves the range of its own.
;;;
;;; The current's error is a Gaussian process over the height: at two levels d metres apart it is correlated by
;;; exp (-d / CORRELATION), east and north each by itself.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief unknowns)
  #:use-module (bight core argument)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core schema)
  #:use-module (bight dive)
  #:use-module ((bight dive command) #:select (alter!))
  #:use-module ((bight dive query) #:select (part-to-alter parts))
  #:use-module (bight engine)
  #:use-module (bight study sweep-design)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (unknown? read-unknowns
            unknowns-size
            unknown-names
            unknown-values
            latent-draws
            settle-unknowns!
            counter-error
            moved-current
            current-error-at))

(define-record <unknown>
  (make-unknown kind label part field draw levels root)
  unknown?
  (kind unknown-kind)                   ; field, payout or current
  (label unknown-label)                 ; a symbol, as it is told: line.cdn
  (part unknown-part)
  (field unknown-field)
  (draw unknown-draw)                   ; of a field, and of payout
  (levels unknown-levels)               ; of the current: heights, m
  (root unknown-root))                  ; of the current: rows of the Cholesky factor of its covariance, m/s


;;; Shares of the standard normal distribution.

(define (normal-share x)
  ;; Marsaglia's series (Journal of Statistical Software 11, 4, 2004).
  (let ((x (max -8.0 (min 8.0 x))))
    (let loop ((term x) (sum x) (k 3))
      (let ((next (/ (* term x x) k)))
        (if (< (abs next) 1e-17)
            (max 1e-15 (min (- 1 1e-15)
                            (+ 0.5 (* sum (exp (* -0.5 x x)) (/ 1 (sqrt (* 4 (acos 0))))))))
            (loop next (+ sum next) (+ k 2)))))))


;;; Reading clauses: (PART (FIELD (DISTRIBUTION NUMBER ...)) ...), (payout (DISTRIBUTION NUMBER ...)) and
;;; (current (error SD) (levels Z ...) (correlation METRES)).

(define usage
  "(PART (FIELD (normal MEAN DEVIATION)) ...), (payout (normal 0 DEVIATION)) or (current (error DEVIATION) (levels \
Z ...) (correlation METRES))")

(define (wrong-clause clause)
  (bight-raise 'def 'believe! "what is uncertain is written ~a, not ~s" usage clause))

(define (distribution name form)
  ;; The draw that FORM, (KIND NUMBER ...), describes.
  (unless (and (pair? form) (list? form) (symbol? (car form)))
    (bight-raise 'def 'believe! "~a needs a distribution, as in (normal 1.2 0.2), not ~s" name form))
  (unless (memq (car form) draw-names)
    (unknown-name 'believe! "a belief" (car form) draw-names "distribution"))
  (let ((draw (make-draw "" name (car form) (cdr form) 'believe!)))
    (unless (random? draw)
      (bight-raise 'def 'believe! "~a lists its values; a belief needs uniform, normal or one-of" (car form)))
    draw))

(define (check-number-field part head name)
  (let ((field (head-field head name)))
    (cond ((not field) (unknown-name 'believe! (head-title head) name (map field-name (head-fields head))))
          ((not (field-live? field))
           (bight-raise 'unsupported 'believe! "the ~a of ~a is fixed while it dives" name part))
          ((not (eq? 'number (field-kind field)))
           (bight-raise 'unsupported 'believe! "the ~a of ~a is no number" name part)))))

(define (field-unknown part head clause)
  (unless (and (list? clause) (= 2 (length clause)) (symbol? (car clause)))
    (wrong-clause (list part clause)))
  (check-number-field part head (car clause))
  (let ((name (symbol-append part (string->symbol ".") (car clause))))
    (make-unknown 'field name part (cons head (car clause)) (distribution name (cadr clause)) #f #f)))

(define (part-unknowns clause)
  (unless (memq (car clause) (cons 'sea (parts)))
    (unknown-name 'believe! "this dive" (car clause) (append (parts) '(current payout)) "part"))
  (call-with-values (lambda () (part-to-alter 'believe! (car clause)))
    (lambda (head index)
      (map (lambda (inner) (field-unknown (car clause) head inner)) (cdr clause)))))

(define (setting clauses name default)
  (let ((found (assq name clauses)))
    (if found (cdr found) default)))

(define (check what type value)
  (check-argument 'believe! what type value))

(define (cholesky levels error correlation)
  ;; Rows of the lower factor of the covariance of the errors at LEVELS.
  (let* ((n (length levels))
         (z (list->vector levels))
         (rows (make-vector n)))
    (do ((i 0 (+ i 1))) ((= i n) rows)
      (let ((row (make-f64vector n 0.0)))
        (vector-set! rows i row)
        (do ((j 0 (+ j 1))) ((> j i))
          (let* ((other (vector-ref rows j))
                 (covariance (* error error
                                (exp (- (/ (abs (- (vector-ref z i) (vector-ref z j))) correlation)))))
                 (rest (fold (lambda (k sum) (- sum (* (f64vector-ref row k) (f64vector-ref other k))))
                             covariance (iota j))))
            (f64vector-set! row j (if (= i j)
                                      (sqrt (max 0.0 rest))
                                      (/ rest (f64vector-ref other j))))))))))

(define most-levels 16)

(define (current-unknown clauses depth)
  (unless (every (lambda (c) (and (list? c) (pair? c) (symbol? (car c)))) clauses)
    (wrong-clause (cons 'current clauses)))
  (for-each (lambda (c)
              (unless (memq (car c) '(error levels correlation))
                (unknown-name 'believe! "the current of a belief" (car c) '(error levels correlation))))
            clauses)
  (unless (assq 'error clauses)
    (wrong-clause (cons 'current clauses)))
  (let* ((error (check 'error type:positive (car (setting clauses 'error '(#f)))))
         (levels (sort (map (lambda (z) (check 'levels type:number z))
                            (setting clauses 'levels (list 0.0 (- (/ depth 2)) (- depth))))
                       >))
         (correlation (check 'correlation type:positive (car (setting clauses 'correlation (list depth))))))
    (unless (and (<= 1 (length levels) most-levels)
                 (= (length levels) (length (delete-duplicates levels =))))
      (bight-raise 'domain 'believe! "(levels Z ...) takes 1 to ~a different heights, not ~s" most-levels levels))
    (make-unknown 'current 'current #f #f #f levels (cholesky levels error correlation))))

(define (steady? numbers)
  ;; Is the current with these NUMBERS the same at all times and linear between rows?
  (<= (f64vector-ref numbers 0) 2))

(define (check-current engine)
  (unless (steady? (%current-numbers engine))
    (bight-raise 'unsupported 'believe! "the current of this dive is neither even nor a profile: its error cannot \
be believed")))

(define (clause-unknowns clause engine)
  (unless (and (list? clause) (pair? clause) (symbol? (car clause)) (pair? (cdr clause)))
    (wrong-clause clause))
  (case (car clause)
    ((current)
     (check-current engine)
     (list (current-unknown (cdr clause) (assq-ref (%sea engine) 'depth))))
    ((payout)
     (unless (= 2 (length clause)) (wrong-clause clause))
     (list (make-unknown 'payout 'payout #f #f (distribution 'payout (cadr clause)) #f #f)))
    (else (part-unknowns clause))))

(define (read-unknowns clauses)
  "Return the unknowns that CLAUSES, a list of data, describe for the current dive.  Raise a &bight-error if one
is wrong, or if something is uncertain twice."
  (let* ((engine (this-engine 'believe!))
         (unknowns (append-map (lambda (clause) (clause-unknowns clause engine)) clauses))
         (names (map unknown-label unknowns)))
    (when (null? unknowns)
      (bight-raise 'def 'believe! "nothing is uncertain: say what is, ~a" usage))
    (unless (= (length names) (length (delete-duplicates names eq?)))
      (bight-raise 'def 'believe! "something is uncertain twice: ~a" (words->string names)))
    unknowns))


;;; Latent numbers.

(define (width unknown)
  (if (eq? 'current (unknown-kind unknown)) (* 2 (length (unknown-levels unknown))) 1))

(define (unknowns-size unknowns)
  "Return how many latent numbers UNKNOWNS have."
  (apply + (map width unknowns)))

(define (latent-draws unknowns n seed)
  "Return N f64vectors of latent numbers for UNKNOWNS, one from each of N equal slices of each number's
probability, drawn from SEED."
  (let ((columns (map (lambda (k)
                        (list->vector (shares 'latin-hypercube n seed (symbol-append 'latent- (number->symbol k)))))
                      (iota (unknowns-size unknowns)))))
    (list-tabulate n (lambda (i)
                       (list->f64vector
                        (map (lambda (column) (normal-quantile (vector-ref column i))) columns))))))

(define (number->symbol k) (string->symbol (number->string k)))

(define (for-each-unknown procedure unknowns)
  ;; Call PROCEDURE with each unknown and the place of its first latent number.
  (fold (lambda (unknown at) (procedure unknown at) (+ at (width unknown))) 0 unknowns))

(define (place-of unknowns kind)
  ;; The unknown of KIND and where its latent numbers begin, or #f and 0.
  (let loop ((rest unknowns) (at 0))
    (cond ((null? rest) (values #f 0))
          ((eq? kind (unknown-kind (car rest))) (values (car rest) at))
          (else (loop (cdr rest) (+ at (width (car rest))))))))

(define (within unknown value)
  ;; VALUE as far as the field of UNKNOWN may have it.
  (let* ((field (and (unknown-field unknown)
                     (head-field (car (unknown-field unknown)) (cdr (unknown-field unknown)))))
         (low (and field (if (field-above-min? field)
                             (+ (field-min field) 1e-9)
                             (field-min field)))))
    (if (and field (real? value)) (max low (min (field-max field) value)) value)))

(define (value-of unknown latent at)
  (within unknown (draw-at (unknown-draw unknown) (normal-share (f64vector-ref latent at)))))

(define (error-at-levels unknown latent at)
  ;; A list (Z EAST NORTH) for each level.
  (let ((n (length (unknown-levels unknown))))
    (map (lambda (i z)
           (let* ((row (vector-ref (unknown-root unknown) i))
                  (sum (lambda (from)
                         (fold (lambda (k sum)
                                 (+ sum (* (f64vector-ref row k) (f64vector-ref latent (+ from k)))))
                               0.0 (iota n)))))
             (list z (sum at) (sum (+ at n)))))
         (iota n) (unknown-levels unknown))))

(define (unknown-names unknowns)
  "Return the names of UNKNOWNS, symbols."
  (map unknown-label unknowns))

(define (unknown-values unknowns latent)
  "Return the alist of the values of UNKNOWNS by name for LATENT; the current's is a list (Z EAST NORTH) for each
level, m/s beyond the current of the dive."
  (let ((found '()))
    (for-each-unknown
     (lambda (unknown at)
       (set! found (acons (unknown-label unknown)
                          (if (eq? 'current (unknown-kind unknown))
                              (error-at-levels unknown latent at)
                              (value-of unknown latent at))
                          found)))
     unknowns)
    (reverse! found)))

(define (counter-error unknowns latent)
  "Return by how much the counter of the winch shows more than is out, m, for LATENT."
  (call-with-values (lambda () (place-of unknowns 'payout))
    (lambda (unknown at)
      (if unknown (value-of unknown latent at) 0.0))))


;;; Profiles of current.

(define (rows-of numbers)
  ;; (Z EAST NORTH) for each row of a steady current's NUMBERS.
  (if (zero? (f64vector-ref numbers 0))
      '((0.0 0.0 0.0))
      (map (lambda (i)
             (map (lambda (k) (f64vector-ref numbers (+ 4 (* 4 i) k))) '(0 1 2)))
           (iota (quotient (- (f64vector-length numbers) 4) 4)))))

(define (current-error-at rows z)
  "Return (EAST NORTH) at the height Z of a profile of ROWS, (Z EAST NORTH) from the top down: linear between
rows, constant beyond them."
  (cond ((or (null? (cdr rows)) (>= z (caar rows))) (cdar rows))
        ((>= z (caadr rows))
         (let ((share (/ (- z (caadr rows)) (- (caar rows) (caadr rows)))))
           (map (lambda (above below) (+ (* share above) (* (- 1 share) below)))
                (cdar rows) (cdadr rows))))
        (else (current-error-at (cdr rows) z))))

(define (moved-current unknowns latent numbers)
  "Return the NUMBERS of a current, with the error that LATENT gives it where the current is one of UNKNOWNS."
  (call-with-values (lambda () (place-of unknowns 'current))
    (lambda (unknown at)
      (if (not (and unknown (steady? numbers)))
          numbers
          (let* ((base (sort (rows-of numbers) (lambda (a b) (> (car a) (car b)))))
                 (error (error-at-levels unknown latent at))
                 (heights (sort (delete-duplicates (map car (append error (if (= 2 (f64vector-ref numbers 0)) base '())))
                                                   =)
                                >)))
            (list->f64vector
             (append '(2.0 0.0 0.0 0.0)
                     (append-map (lambda (z)
                                   (append (list z)
                                           (map + (current-error-at base z) (current-error-at error z))
                                           '(0.0)))
                                 heights))))))))

(define (settle-unknowns! unknowns latent)
  "Give the current dive the values of UNKNOWNS for LATENT, but those of its winch and its current."
  (for-each-unknown
   (lambda (unknown at)
     (when (eq? 'field (unknown-kind unknown))
       (alter! (unknown-part unknown) (symbol->keyword (cdr (unknown-field unknown)))
               (value-of unknown latent at))))
   unknowns))
