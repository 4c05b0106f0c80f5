;;; Track files: what a column is says its name, not its place; what no name says is refused.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight world track) (rnrs exceptions) (srfi srfi-1) (srfi srfi-4))

(define random-numbers (seed->random-state (or (and=> (getenv "BIGHT_SEED") string->number) 11)))

(define (one-of list)
  (list-ref list (random (length list) random-numbers)))

(define (shuffled list)
  (map cdr (sort (map (lambda (item) (cons (random:uniform random-numbers) item)) list)
                 (lambda (a b) (< (car a) (car b))))))

(define rows '((0 1.5 -2 -3.25) (2 2.5 -1 -4) (7 4 0 -5.5) (9.5 4 1 -5)))

;;; Names of each of the four, with what a number of the file is of the track's.

(define spellings
  '((("t" 1) ("time" 1) ("Time (s)" 1) ("time_ms" 1/1000) ("elapsed [min]" 60))
    (("x" 1) ("East" 1) ("rov_x" 1) ("easting (km)" 1000) ("pos.x [cm]" 1/100))
    (("y" 1) ("north" 1) ("rov_y" 1) ("Northing_m" 1) ("y_ft" 0.3048))
    (("z" 1) ("up" 1) ("depth" -1) ("Depth (ft)" -0.3048) ("rov_depth_m" -1))))

(define strangers '("heading" "roll" "note" "vel_x" "m00x" "battery_V" "lat" "latitude"))

(define (write-table header parted rows)
  ;; The name of a file with HEADER, a list of names or #f, and ROWS.
  (let* ((port (mkstemp (string-append (scratch-file "track-") "XXXXXX")))
         (file (port-filename port)))
    (define (line cells) (simple-format port "~a~%" (string-join cells parted)))
    (when header (line header))
    (for-each (lambda (row) (line (map number->string row))) rows)
    (close-port port)
    file))

(define (track-of header parted rows)
  (let ((file (write-table header parted rows)))
    (dynamic-wind (const #t) (lambda () (read-track 'follow! file)) (lambda () (delete-file file)))))

(define-scenario any-order-any-unit
  "Columns shuffled, among others, under other names and in other units are the same track."
  (for-each
   (lambda (k)
     (let* ((parted (one-of '(", " ";" "\t")))
            (chosen (map one-of spellings))
            (extra (map (lambda (name) (list name (lambda (row) 99)))
                        (take (shuffled strangers) (random 4 random-numbers))))
            (columns (shuffled
                      (append extra
                              (map (lambda (i spelling)
                                     (list (car spelling)
                                           (lambda (row) (/ (list-ref row i) (cadr spelling) 1.0))))
                                   (iota 4) chosen))))
            (got (track-of (map car columns) parted
                           (map (lambda (row) (map (lambda (c) ((cadr c) row)) columns)) rows))))
       (expect (apply max (map (lambda (a b) (abs (- a b))) (f64vector->list got) (concatenate rows)))
               is (below 1e-9))))
   (iota 200)))

(define-scenario without-names
  "Numbers alone are t x y z, and a remark is a remark."
  (expect (track-of #f " " rows) => (list->f64vector (concatenate rows)))
  (expect (track-of '("#" "a" "remark" "of" "four") " " rows)
          => (list->f64vector (concatenate rows)))
  (expect (track-of '("#" "y" "x" "z" "t") " " '((1 2 3 0) (1 2 4 1)))
          => #f64(0 2 1 3 1 2 1 4)))

(define-scenario what-no-name-says
  "One of the four left out, there twice, in degrees or under a name that says nothing is refused, and the
error quotes no word that is not one of ours."
  (define four '("t" "x" "y" "z"))
  (define (refused? header)
    (guard (e ((bight-error? e)
               (and (eq? 'format (bight-error-kind e))
                    (not (string-contains (bight-error-message e) "secret")))))
      (track-of header "," (map (lambda (row) (list-head (append row row row) (length header))) rows))
      #f))
  (for-each (lambda (name)
              (expect (refused? (delete name (append four '("secret" "heading")))))
              (expect (refused? (map (lambda (n) (if (equal? n name) "secret" n)) four)))
              (expect (refused? (append (delete name four)
                                        (list (string-append "rov_" name) (string-append "nav_" name))))))
            four)
  (for-each (lambda (header) (expect (refused? header)))
            '(("time" "latitude" "longitude" "altitude") ("lat" "lon" "alt" "secret")
              ("t" "vel_x" "vel_y" "vel_z") ("t" "x (furlong)" "y" "z") ("secret" "secret" "secret" "secret")))
  (expect (track-of '("# t" "latitude" "longitude" "altitude") " " rows) raises format)
  (expect (track-of '("t" "x" "y" "z") "," '((0 1 2 3) (1 1 2))) raises format))
