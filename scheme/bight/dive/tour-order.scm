;;; (bight dive tour-order) --- the order in which places are visited on the shortest tour.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive tour-order)
  #:use-module (srfi srfi-1)
  #:export (best-order
            near-orders))

(define exact-most 9)                   ; places: 9 * 9 * 2^9 sums

(define (order-length order n cost)
  ;; Of the tour from -1 by ORDER to N.
  (let loop ((at -1) (left order) (sum 0))
    (if (null? left)
        (+ sum (cost at n))
        (loop (car left) (cdr left) (+ sum (cost at (car left)))))))


;;; Few places: the shortest way through each subset that ends at each of its members (M. Held and R. M. Karp
;;; 1962).  A subset is a number, a bit for each place.

(define (exact-order n cost)
  (define best (make-hash-table))       ; (SUBSET . LAST) -> (LENGTH . ORDER backwards)
  (define (bit k) (ash 1 k))
  (define (way subset last)
    (let ((rest (logand subset (lognot (bit last)))) (key (cons subset last)))
      (or (hash-ref best key)
          (let ((found (if (zero? rest)
                           (list (cost -1 last) last)
                           (shortest (map (lambda (k)
                                            (let ((w (way rest k)))
                                              (cons* (+ (car w) (cost k last)) last (cdr w))))
                                          (filter (lambda (k) (logbit? k rest)) (iota n)))))))
            (hash-set! best key found)
            found))))
  (define all (- (bit n) 1))
  (reverse (cdr (shortest (map (lambda (k)
                                 (let ((w (way all k)))
                                   (cons (+ (car w) (cost k n)) (cdr w))))
                               (iota n))))))

(define (shortest ways)
  (fold (lambda (w best) (if (< (car w) (car best)) w best)) (car ways) (cdr ways)))


;;; Many: each place put in where it costs least, then stretches turned round while that shortens the tour (G. A. Croes
;;; 1958).

(define (insertions order k)
  (map (lambda (i) (append (list-head order i) (list k) (list-tail order i)))
       (iota (+ 1 (length order)))))

(define (best-of orders n cost)
  (cdr (shortest (map (lambda (o) (cons (order-length o n cost) o)) orders))))

(define (inserted n cost)
  (fold (lambda (k order) (best-of (insertions order k) n cost)) '() (iota n)))

(define (turned order i j)
  ;; ORDER with its places I to J, J left out, in the other direction.
  (append (list-head order i)
          (reverse (list-head (list-tail order i) (- j i)))
          (list-tail order j)))

(define (improved order n cost)
  ;; A shorter order with one stretch turned round, or #f.
  (let ((length-now (order-length order n cost)))
    (let loop ((i 0) (j 2))
      (cond ((> i (- n 2)) #f)
            ((> j n) (loop (+ i 1) (+ i 3)))
            (else
             (let ((other (turned order i j)))
               (if (< (order-length other n cost) (- length-now 1e-9))
                   other
                   (loop i (+ j 1)))))))))

(define (exchanged order n cost)
  (let ((better (improved order n cost)))
    (if better (exchanged better n cost) order)))

(define (best-order n cost)
  "Return the places 0 to N - 1, a list, in the order of the shortest tour that begins at -1 and ends at N, if (COST I
J) is the length from I to J: exactly the shortest for a few places, for many one that turning a stretch of it
round does not shorten."
  (cond ((zero? n) '())
        ((<= n exact-most) (exact-order n cost))
        (else (exchanged (inserted n cost) n cost))))

(define (near-orders order)
  "Return ORDER, a list, and every other with one stretch of it turned round."
  (let ((n (length order)))
    (cons order (append-map (lambda (i) (map (lambda (j) (turned order i j)) (iota (max 0 (- n i 1)) (+ i 2))))
                            (iota n)))))
