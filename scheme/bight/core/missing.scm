;;; (bight core missing) --- what is said of a file that is not there: the file beside it that was meant.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core missing)
  #:use-module ((bight core errors) #:select (nearest))
  #:export (file-meant
            why-not))

(define (files-in folder)
  (let ((port (false-if-exception (opendir folder))))
    (if port
        (let loop ((names '()))
          (let ((name (readdir port)))
            (cond ((eof-object? name) (closedir port) (sort names string<?))
                  ((string-prefix? "." name) (loop names))
                  (else (loop (cons name names))))))
        '())))

(define (file-meant file)
  "Return \"; did you mean `OTHER'?\" about the file beside FILE, of which there is none, that is spelt most like
FILE, or the empty string."
  (let ((near (nearest (basename file) (files-in (dirname file)))))
    (if near
        (simple-format #f "; did you mean `~a'?"
                       (if (string-index file #\/) (string-append (dirname file) "/" near) near))
        "")))

(define (why-not file arguments)
  "Return why the system refused FILE with ARGUMENTS, those of a `system-error', and the file that was meant where
FILE is missing."
  (let ((errno (system-error-errno arguments)))
    (string-append (strerror errno) (if (= ENOENT errno) (file-meant file) ""))))
