;;; (bight core markup) --- text of whatever origin within XML, HTML, SVG and CSV.
;;;
;;; What a terminal would obey is shown as (bight outlet) shows it, whoever reads the file; what the format
;;; itself would obey is written its own way.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core markup)
  #:use-module ((bight outlet) #:select (shown))
  #:export (as-xml csv-line))

(define no-letters (char-set #\xfffe #\xffff)) ; XML cannot hold them

(define (as-xml text)
  "Return TEXT as it stands in XML, in an attribute too."
  (string-concatenate
   (map (lambda (c)
          (case c
            ((#\&) "&amp;") ((#\<) "&lt;") ((#\>) "&gt;") ((#\") "&quot;") ((#\') "&#39;")
            ((#\newline) "&#10;") ((#\return) "&#13;")
            (else (if (char-set-contains? no-letters c) "?" (string c)))))
        (string->list (shown text)))))

(define special (char-set #\, #\" #\newline #\return))

(define (csv-cell value)
  (cond ((number? value) (number->string value))
        ((not value) "")
        ((string-any special value)
         (string-append "\"" (string-join (string-split (shown value) #\") "\"\"") "\""))
        (else (shown value))))

(define (csv-line cells)
  "Return CELLS, strings, numbers or #f, as a line of CSV, without its end."
  (string-join (map csv-cell cells) ","))
