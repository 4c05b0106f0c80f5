;;; (bight core options) --- the words of a command line: what are options, and what files.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core options)
  #:use-module (bight core errors)
  #:export (bad-usage check-there split-arguments split-option without-value file-like?))

(define (bad-usage text . values)
  "Raise the &bight-error TEXT, filled with VALUES: the command line is written wrong."
  (apply bight-raise 'domain #f text values))

(define (check-there file)
  "Raise a &bight-error that names the file meant, unless there is FILE."
  (unless (file-exists? file)
    (bad-usage "there is no file ~s~a" file ((@ (bight core missing) file-meant) file))))

(define (split-arguments name known arguments)
  "Return two values: of ARGUMENTS what is no option, and an alist of those options that are KNOWN to the command
NAME; a flag's value is #t."
  (let ((names (map car known)))
    (let loop ((rest arguments) (others '()) (options '()))
      (cond ((null? rest) (values (reverse others) options))
            ((string=? (car rest) "--") (values (append (reverse others) (cdr rest)) options))
            ((split-option (car rest) known)
             => (lambda (option) (loop (cdr rest) others (cons option options))))
            ((and (assoc-ref known (car rest)) (pair? (cdr rest)))
             (loop (cddr rest) others (acons (car rest) (cadr rest) options)))
            ((assoc-ref known (car rest)) (bad-usage "~a: ~a needs a value after it" name (car rest)))
            ((member (car rest) names) (loop (cdr rest) others (acons (car rest) #t options)))
            ((and (string-prefix? "-" (car rest)) (> (string-length (car rest)) 1))
             (bad-usage "~a has no option ~a~a" name (car rest) (did-you-mean (without-value (car rest)) names)))
            (else (loop (cdr rest) (cons (car rest) others) options))))))

(define (split-option argument known)
  "Return (NAME . VALUE) of ARGUMENT, --NAME=VALUE or -nVALUE, if NAME is KNOWN to take one, else #f."
  (let* ((long? (string-prefix? "--" argument))
         (end (if long? (string-index argument #\=) (and (> (string-length argument) 2) 2))))
    (and end
         (string-prefix? "-" argument)
         (assoc-ref known (substring argument 0 end))
         (cons (substring argument 0 end) (substring argument (if long? (+ end 1) end))))))

(define (without-value option)
  "Return the --NAME of OPTION, --NAME=VALUE."
  (car (string-split option #\=)))

(define (file-like? word)
  "Return true if WORD means a file, whether or not the file is there."
  (or (string-index word #\/)
      (string-suffix? ".scm" word)
      (file-exists? word)))
