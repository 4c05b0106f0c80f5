;;; (bight shell manual) --- the sections of the manual, as Info has them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell manual)
  #:use-module ((bight engine) #:select (%manual-file))
  #:use-module (ice-9 popen)
  #:use-module (ice-9 textual-ports)
  #:use-module (srfi srfi-1)
  #:export (manual-sections
            sections-about))

(define (text-of file)
  ;; What is in FILE, or in FILE.gz, as packages have it; the empty string if there is neither.
  (cond ((file-exists? file)
         (call-with-input-file file
           (lambda (port) (set-port-encoding! port "UTF-8") (get-string-all port))))
        ((file-exists? (string-append file ".gz"))
         (let* ((port (open-pipe* OPEN_READ "gzip" "-dc" (string-append file ".gz")))
                (text (begin (set-port-encoding! port "UTF-8") (get-string-all port))))
           (close-pipe port)
           text))
        (else "")))

(define (node-name text)
  ;; The name of the node that TEXT, which begins with its header line, is, or #f.
  (let* ((end (or (string-index text #\newline) (string-length text)))
         (from (string-contains text "Node: " 0 end))
         (to (and from (string-index text #\, from end))))
    (and to (substring text (+ from 6) to))))

(define the-sections #f)

(define (read-sections)
  (filter-map (lambda (text)
                (let* ((text (string-trim text #\newline)) (name (node-name text)))
                  (and name (cons name text))))
              (string-split (or (false-if-exception (text-of (%manual-file))) "") #\x1f)))

(define (manual-sections)
  "Return an alist from the names of the manual's sections, as `info bight' has them, to their texts; empty where
there is no manual."
  (unless the-sections (set! the-sections (read-sections)))
  the-sections)

(define (times word text)
  ;; How often WORD, which is not empty, stands in TEXT.
  (let loop ((from 0) (n 0))
    (let ((at (string-contains-ci text word from)))
      (if at (loop (+ at (string-length word)) (+ n 1)) n))))

(define (lists-names? name)
  ;; Those that are made of the docstrings, which are searched themselves.
  (member name '("Names" "Functions" "Index" "Top")))

(define (sections-about word)
  "Return pairs (SECTION . TIMES) of the sections of the manual that have WORD, the one that has it most often
first."
  (sort (filter-map (lambda (section)
                      (let ((n (times word (cdr section))))
                        (and (positive? n) (not (lists-names? (car section))) (cons (car section) n))))
                    (manual-sections))
        (lambda (a b) (> (cdr a) (cdr b)))))
