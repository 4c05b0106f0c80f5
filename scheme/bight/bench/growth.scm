;;; (bight bench growth) --- how cost grows with size: plots of CPU time over a number, and the exponent that fits.
;;;
;;; Rows with a counter `n', what there are so many of, are drawn case by case, both axes logarithmic, with the line of
;;; least squares: its slope is the exponent, 1 where twice as many cost twice as much.  The slope of the last two sizes
;;; stands beside it, for what costs the same at any size hides the exponent of small ones.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench growth)
  #:use-module ((bight bench bars) #:select (counter-of))
  #:use-module ((bight bench plot) #:select (draw-line draw-on-decades draw-text tenth))
  #:use-module (bight bench row)
  #:use-module ((bight core markup) #:select (as-xml))
  #:use-module ((srfi srfi-1) #:hide (tenth))
  #:export (fit-exponent
            growth-of
            print-growth
            write-growth))

(define (mean numbers) (/ (apply + numbers) (length numbers)))

(define (fit-exponent points)
  "Return the exponent B and the factor A of A n^B, the least squares in logarithms through POINTS, pairs (N . COST)."
  (let* ((xs (map (lambda (p) (log (car p))) points)) (ys (map (lambda (p) (log (cdr p))) points))
         (mx (mean xs)) (my (mean ys))
         (b (/ (fold (lambda (x y sum) (+ sum (* (- x mx) (- y my)))) 0 xs ys)
               (fold (lambda (x sum) (+ sum (* (- x mx) (- x mx)))) 0 xs))))
    (values b (exp (- my (* b mx))))))

(define (points-of rows)
  ;; (N . CPU ns) of the ROWS, the smallest first.
  (sort (filter-map (lambda (row)
                      (let ((n (counter-of row "n")) (cpu (row-cpu row)))
                        (and n cpu (positive? n) (positive? cpu) (cons n cpu))))
                    rows)
        (lambda (a b) (< (car a) (car b)))))

(define (growth-of rows)
  "Return an alist from each case of ROWS that has three sizes or more to its points, pairs of a number and CPU time
in ns, the smallest first."
  (filter-map (lambda (name)
                (let ((points (points-of (filter (lambda (row) (string=? name (row-case row))) rows))))
                  (and (>= (length (delete-duplicates (map car points))) 3) (cons name points))))
              (delete-duplicates (map row-case rows))))

(define (hundredth x) (/ (round (* 100 x)) 100))

(define (last-two points)
  (list-tail points (- (length points) 2)))

(define (growth-sentence name points)
  (simple-format #f "~a, ~a to ~a: exponent ~a; of the last two sizes ~a" name (caar points) (car (last points))
                 (hundredth (fit-exponent points)) (hundredth (fit-exponent (last-two points)))))

(define (growth-svg name points)
  (draw-on-decades name (map car points) (map cdr points) "so many" "CPU time, ns"
    (lambda (port x y)
      (call-with-values (lambda () (fit-exponent points))
        (lambda (b a)
          (define (fitted n) (y (* a (expt n b))))
          (let ((from (caar points)) (to (car (last points))))
            (draw-line port (x from) (fitted from) (x to) (fitted to) "stroke='#57606a' stroke-dasharray='4 3'")
            (draw-text port (+ (x to) 8) (fitted to) (simple-format #f "exponent ~a" (hundredth b))))
          (for-each (lambda (p)
                      (simple-format port "<circle cx='~a' cy='~a' r='4' fill='#1f6feb'><title>~a: ~a ns</title></circle>~%"
                                     (tenth (x (car p))) (tenth (y (cdr p))) (car p) (cdr p)))
                    points))))))

(define (print-growth port rows)
  "Print to PORT the exponents of ROWS, a line a case."
  (for-each (lambda (entry) (simple-format port "~a~%" (growth-sentence (car entry) (cdr entry))))
            (growth-of rows)))

(define (write-growth port rows)
  "Write to PORT, as HTML, the plots of ROWS with their exponents."
  (for-each (lambda (entry)
              (simple-format port "<figure>~a<figcaption>~a</figcaption></figure>~%"
                             (growth-svg (car entry) (cdr entry)) (as-xml (growth-sentence (car entry) (cdr entry)))))
            (growth-of rows)))
