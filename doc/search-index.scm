;;; The index that the manual's pages are searched by: `bight search-index.scm FOLDER >FILE', of its pages.
;;;
;;; A page is (FILE TITLE TEXT), without what is on every page.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight core json) #:select (write-json))
             (ice-9 ftw)
             (ice-9 regex)
             (ice-9 textual-ports)
             (srfi srfi-1))

(define folder (cadr (command-line)))

(define (page-text file)
  (call-with-input-file (string-append folder "/" file) get-string-all #:encoding "UTF-8"))

;; Regular expressions would begin each match with a copy of all text that is left: minutes for the manual.

(define entities
  '(("&lt;" . "<") ("&gt;" . ">") ("&quot;" . "\"") ("&rsquo;" . "'") ("&lsquo;" . "'") ("&nbsp;" . " ") ("&amp;" . "&")))

(define mark (char-set #\< #\&))

(define (meaning html i)
  ;; What stands in HTML at I, a mark: its text, and where it ends.
  (let ((end (and (char=? (string-ref html i) #\<) (string-index html #\> i)))
        (entity (find (lambda (entity) (string-prefix? (car entity) html 0 (string-length (car entity)) i)) entities)))
    (cond (end (values " " (+ end 1)))
          (entity (values (cdr entity) (+ i (string-length (car entity)))))
          (else (values (string (string-ref html i)) (+ i 1))))))

(define (plain html)
  ;; The words of HTML.
  (let loop ((from 0) (pieces '()))
    (let ((i (string-index html mark from)))
      (if i
          (call-with-values (lambda () (meaning html i))
            (lambda (text end)
              (loop end (cons* text (substring html from i) pieces))))
          (string-join (string-tokenize (string-concatenate-reverse pieces (substring html from))))))))

(define (without-name title)
  ;; TITLE without the manual's name at its end.
  (regexp-substitute #f (string-match "( \\(bight[^)]*\\))?$" title) 'pre))

(define (part text from to)
  ;; What is between FROM and TO in TEXT, or the empty string.
  (let* ((a (string-contains text from)) (b (and a (string-contains text to a))))
    (if b (substring text (+ a (string-length from)) b) "")))

(define (without-headers html)
  ;; HTML without the lines that lead to the pages beside it.
  (let ((i (string-contains html "<div class=\"header\">")))
    (if i
        (let ((end (string-contains html "</div>" i)))
          (string-append (substring html 0 i) (without-headers (substring html (or end (string-length html))))))
        html)))

(define (page file)
  (let ((text (page-text file)))
    (vector file
            (without-name (plain (part text "<title>" "</title>")))
            ;; The tag is cut through at its beginning, for attributes may follow.
            (plain (string-append "<" (without-headers (part text "<body" "</body>")))))))

(display "window.bightPages = ")
(write-json (list->vector (map page (sort (filter (lambda (f) (string-suffix? ".html" f)) (scandir folder)) string<?)))
            (current-output-port))
(display ";\n")
