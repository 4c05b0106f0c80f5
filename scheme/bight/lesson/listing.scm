;;; (bight lesson listing) --- bight lessons: which there are, how far one has come, a group, CSV.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson listing)
  #:use-module ((bight core markup) #:select (csv-line))
  #:use-module ((bight core options) #:select (bad-usage))
  #:use-module (bight lesson advice)
  #:use-module (bight lesson file)
  #:use-module (bight lesson groups)
  #:use-module (bight lesson journal)
  #:use-module (bight lesson log)
  #:use-module (bight lesson order)
  #:use-module (bight lesson path)
  #:use-module (srfi srfi-1)
  #:export (lessons-command))

(define (best results name)
  ;; The best total among RESULTS in the lesson NAME, or #f.
  (let ((totals (filter-map (lambda (e) (and (eq? name (assq-ref e 'lesson)) (assq-ref e 'total)))
                            results)))
    (and (pair? totals) (apply max totals))))

(define (begun? file given)
  (let ((journal (journal-file (make-order file #f given))))
    (and journal (file-exists? journal))))

;; How a pupil stands to a lesson: what he made of it, else whether he has shown what it needs.
(define (standing file place places results given)
  (let ((total (best results (place-name place))))
    (define (with-marks word) (string-append word " " (number->string total)))
    (cond ((passed? results place) (with-marks "passed"))
          ((begun? file given) "begun")
          ((not total) (if (ready? results places place) "ready" "later"))
          ((any (lambda (r) (assq-ref r 'passed?)) (results-in results (place-name place))) (with-marks "easy"))
          (else (with-marks "tried")))))

(define (lesson-row number name standing title)
  (string-trim-right
   (string-append (string-pad-right number 4) (string-pad-right name 23) (string-pad-right standing 12) title)))

(define (list-lessons given)
  ;; A table of 80 columns at most, by grades.
  (let* ((results (logged-results (who-of given))) (files (lesson-files)) (places (catalogue))
         (rows (map (lambda (file place)
                      (cons (place-grade place)
                            (lesson-row (substring (basename file) 0 2) (symbol->string (place-name place))
                                        (standing file place places results given) (place-title place))))
                    files places)))
    (for-each (lambda (grade)
                (print-line (lesson-row "" (simple-format #f "Grade ~a" grade) "you" ""))
                (for-each (lambda (row) (when (= grade (car row)) (print-line (cdr row)))) rows))
              (sort (delete-duplicates (map car rows)) <))
    (print-line "\nready: you have shown what it needs.  `bight lesson NAME' takes one,
`bight lesson' proposes the next, `bight lessons --skills' says which skills
each trains and needs.")))

(define (print-line text)
  (display text)
  (newline))

(define (results-of given)
  ;; The results that are meant: those of a group, or of one pupil.
  (let ((group (option given "--group" #f)))
    (if group
        (filter (lambda (result) (if (eq? #t group) (assq-ref result 'group) (equal? group (assq-ref result 'group))))
                (logged-results #f))
        (logged-results (who-of given)))))

(define (list-group given)
  ;; A line for each pupil of the group: the best total of each lesson taken; else which groups there are.
  (let* ((results (results-of given))
         (known (delete-duplicates (filter-map (lambda (r) (assq-ref r 'group)) (logged-results #f))))
         (pupils (sort (delete-duplicates (map (lambda (r) (assq-ref r 'who)) results)) string<?)))
    (for-each
     (lambda (who)
       (let ((own (filter (lambda (r) (equal? who (assq-ref r 'who))) results)))
         (simple-format #t "~a ~a~%" (string-pad-right who 16)
                        (string-join
                         (map (lambda (name)
                                (simple-format #f "~a ~a" name (best own name)))
                              (delete-duplicates (map (lambda (r) (assq-ref r 'lesson)) own)))
                         ", "))))
     pupils)
    (when (null? pupils)
      (simple-format #t "Nobody of the group ~a is in the logbook, in which ~a.~%" (option given "--group" #f)
                     (if (null? known)
                         "no group is"
                         (string-append "there are " (string-join (sort known string<?) ", ")))))))

(define columns '(who group lesson level seed total passed? seconds hints rewinds))

(define (compare-groups)
  (for-each print-line (group-lines (logged-results #f))))

(define (csv-value value)
  (cond ((eq? value #t) 1)
        ((or (not value) (number? value)) value)
        (else (simple-format #f "~a" value))))

(define (list-csv given)
  (simple-format #t "~a~%" (string-join (map symbol->string columns) ","))
  (for-each (lambda (result)
              (simple-format #t "~a~%"
                             (csv-line (map (lambda (c) (csv-value (assq-ref result c))) columns))))
            (results-of given)))

(define (entries n)
  (simple-format #f "~a entr~a" n (if (= n 1) "y" "ies")))

(define (merge file)
  ;; (bight lesson logbook) is loaded when it is needed: it needs SQLite.
  (let* ((interface (resolve-interface '(bight lesson logbook)))
         (n ((module-ref interface 'merge-logbook!) file)) (ahead ((module-ref interface 'entries-ahead))))
    (simple-format #t "~a taken over from ~a~%" (entries n) file)
    (when (positive? ahead)
      (simple-format #t "~a of the logbook: dated in the future by this machine's clock.  Where clocks differ, what was \
done first may be told wrongly.~%" (entries ahead)))))

(define (lessons-command words)
  "Do what `bight lessons WORDS' asks, and return the exit status."
  (call-with-values (lambda () (read-words "lessons" words))
    (lambda (plain given)
      (unless (null? plain)
        (bad-usage "lessons: only lists; `bight lesson ~a' takes one" (car plain)))
      (cond ((option given "--merge" #f) => merge)
            ((option given "--skills" #f) (list-skills given))
            ((option given "--csv" #f) (list-csv given))
            ((eq? #t (option given "--group" #f)) (compare-groups))
            ((option given "--group" #f) (list-group given))
            (else (list-lessons given)))
      0)))
