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

(define (without pattern text)
  (regexp-substitute/global #f pattern text 'pre " " 'post))

(define (replaced text pairs)
  (fold (lambda (pair text) (regexp-substitute/global #f (car pair) text 'pre (cdr pair) 'post)) text pairs))

(define (plain html)
  ;; The words of HTML.
  (string-join
   (string-tokenize
    (replaced (without "<[^>]*>" (without "<script[^>]*>|^[^>]*>" html))
              '(("&lt;" . "<") ("&gt;" . ">") ("&quot;" . "\"") ("&rsquo;|&lsquo;" . "'") ("&nbsp;" . " ")
                ("&amp;" . "&"))))))

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
            (replaced (plain (part text "<title>" "</title>")) '((" \\(bight[^)]*\\)$" . "")))
            (plain (without-headers (part text "<body" "</body>"))))))

(display "window.bightPages = ")
(write-json (list->vector (map page (sort (filter (lambda (f) (string-suffix? ".html" f)) (scandir folder)) string<?)))
            (current-output-port))
(display ";\n")
