;;; (bight core told) --- what an exception says, and where a form was written, each on one line.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core told)
  #:use-module (bight core errors)
  #:use-module ((bight core here) #:select (place-of chain-of))
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (source-location
            location->string
            source-line
            frame->line
            chain->string
            chain-suffix
            code->string
            raised-kind
            raised-at
            syntax-error->line
            exception->line
            exception->placed-line))


;;; Where a form was written: a pair (FILE . LINE), or #f for what was typed at the prompt.

(define-syntax source-location
  (lambda (stx)
    "(source-location FORM): the constant (FILE . LINE) at which FORM was written, or #f."
    (syntax-case stx ()
      ((_ form)
       (let* ((source (or (syntax-source #'form) '()))
              (file (assq-ref source 'filename))
              (line (assq-ref source 'line)))
         (datum->syntax #'form (and file line (list 'quote (cons file (+ 1 line))))))))))

(define (near-name file)
  ;; FILE as seen from the present folder, if it is below it.
  (let ((here (string-append (getcwd) "/")))
    (if (string-prefix? here file)
        (substring file (string-length here))
        file)))

(define (location->string location)
  "Return LOCATION, a pair (FILE . LINE) or #f, as FILE:LINE."
  (if location
      (string-append (near-name (car location)) ":" (number->string (cdr location)))
      "at the prompt"))

(define (source-line place)
  "Return the line of the file at PLACE, (FILE . LINE), without the blanks about it; \"\" if it cannot be read."
  (or (false-if-exception
       (call-with-input-file (car place)
         (lambda (port)
           (do ((i 1 (+ i 1)))
               ((= i (cdr place)) (string-trim-both (read-line port)))
             (read-line port)))))
      ""))

(define* (frame->line frame #:optional (source-line source-line))
  "Return where the call of FRAME stands, and the source there, which SOURCE-LINE reads, as a line."
  (simple-format #f "  ~a~a: ~a" (location->string (car frame))
                 (if (cdr frame) (simple-format #f " in ~a" (cdr frame)) "")
                 (source-line (car frame))))

(define (frame->string frame)
  (string-append "called from " (location->string (car frame))
                 (if (cdr frame) (simple-format #f " in ~a" (cdr frame)) "")))

(define (chain->string frames)
  "Return FRAMES, as (bight core here) tells them, in words: \"in F, called from FILE:LINE in G, called from FILE:LINE\";
nothing for a call outside of all procedures."
  (if (null? frames)
      ""
      (string-join (append (if (cdr (car frames)) (list (simple-format #f "in ~a" (cdr (car frames)))) '())
                           (map frame->string (cdr frames)))
                   ", ")))

(define (chain-suffix exception)
  "Return what led to EXCEPTION, in parentheses, to follow what it says on its line, or nothing."
  (let ((text (chain->string (chain-of exception))))
    (if (string-null? text) "" (string-append " (" text ")"))))

(define quote-marks '((quote . "'") (quasiquote . "`") (unquote . ",") (unquote-splicing . ",@")))

(define (code->string code)
  "Return CODE, a datum, written on one line as a person would type it."
  (cond ((and (pair? code) (assq (car code) quote-marks) (pair? (cdr code)) (null? (cddr code)))
         (string-append (assq-ref quote-marks (car code)) (code->string (cadr code))))
        ((list? code)
         (string-append "(" (string-join (map code->string code) " ") ")"))
        ((pair? code)
         (string-append "(" (code->string (car code)) " . " (code->string (cdr code)) ")"))
        (else (simple-format #f "~s" code))))


;;; What an exception says, on one line.

;; Guile has none for what is raised by (/ 1 0).
(set-exception-printer! 'numerical-overflow
  (lambda (port key args default)
    (simple-format port "~a: a division by zero" (first args))))

(define (raised-kind exception)
  "Return the kind of EXCEPTION, a symbol: a bight kind such as domain, or Guile's own key."
  (if (bight-error? exception)
      (bight-error-kind exception)
      (exception-kind exception)))

(define (tidy-line line)
  (let ((line (string-trim-both line)))
    (cond ((string=? line "ERROR:") "")
          ((string-prefix? "ERROR: " line) (tidy-line (substring line 7)))
          ((string-prefix? "In procedure fport_write: " line)
           (string-append "cannot write: " (substring line 26)))
          ((string-prefix? "In procedure " line) (substring line 13))
          (else line))))

(define (source->location source)
  (let ((file (assq-ref source 'filename))
        (line (assq-ref source 'line)))
    (and file line (cons file (+ 1 line)))))

(define (raised-at exception)
  "Return the place (FILE . LINE) that EXCEPTION itself tells of, as errors of syntax and failed
expectations do, or where it was raised, or #f."
  (let ((arguments (exception-args exception)))
    (case (exception-kind exception)
      ((syntax-error) (source->location (or (third arguments) '())))
      ((failed-expectation) (second arguments))
      (else (place-of exception)))))

(define (usage-of-macro form)
  ;; How the macro that FORM uses is used, or #f.
  (and (pair? form) (symbol? (car form))
       (false-if-exception ((@ (bight shell doc) usage-of) (car form)))))

(define (syntax-error->line who what where form subform)
  (let ((usage (and (string-prefix? "source expression failed to match" what) (usage-of-macro form))))
    (if usage
        (simple-format #f "~a: it is used as ~a, not ~a" (car form) usage (code->string (abbreviate form)))
        (string-append (if who (simple-format #f "~a: " who) "")
                       what
                       (if subform (string-append " " (brief subform)) "")
                       (if form (string-append " in " (brief form)) "")))))

(define (exception->line exception)
  "Return what EXCEPTION says on one line: PROCEDURE: MESSAGE."
  (case (exception-kind exception)
    ((syntax-error) (apply syntax-error->line (exception-args exception)))
    ((out-of-memory) "Out of memory")   ; Guile's printer needs memory
    ((stack-overflow) "Stack overflow")
    (else (printed-exception exception))))

(define (exception->placed-line exception)
  "Return what EXCEPTION says on one line, after its place, if that is known: FILE:LINE: PROCEDURE: MESSAGE."
  (let ((place (raised-at exception)))
    (string-append (if place (string-append (location->string place) ": ") "")
                   (exception->line exception)
                   (chain-suffix exception))))

(define (printed-exception exception)
  (let ((text (call-with-output-string
               (lambda (port)
                 ;; Guile's printer goes down into circular and deep irritants for ever.
                 (print-exception port #f (exception-kind exception)
                                  (map abbreviate (whole-args (exception-args exception))))))))
    (string-join (remove string-null? (map tidy-line (string-split text #\newline))) " ")))
