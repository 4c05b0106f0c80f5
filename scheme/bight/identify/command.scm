;;; (bight identify command) --- bight identify.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight identify command)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core options) #:select (bad-usage check-there))
  #:use-module ((bight core programs) #:select (check-writable write-bytes))
  #:use-module (bight identify)
  #:use-module (bight identify found)
  #:use-module ((bight view plot) #:select (plot))
  #:use-module (ice-9 pretty-print)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (identify-command))

(define (words text) (remove string-null? (map string-trim-both (string-split text #\,))))

(define (number name text)
  (let ((value (text->number text 10)))
    (if (real? value) value (bad-usage "identify: ~a needs a number, not ~a" name text))))

(define (clause text)
  ;; NAME=VALUE as (NAME VALUE).
  (let ((i (string-index text #\=)))
    (unless i (bad-usage "identify: --known needs NAME=VALUE,... as in diameter=0.004,mass=0.05, not ~a" text))
    (let ((value (substring text (+ i 1))))
      (list (string->symbol (substring text 0 i))
            (or (text->number value 10) (string->symbol value))))))

;; (OPTION KEYWORD MEANING): what `identify' takes besides.
(define meanings
  `(("--unknown" #:unknown ,(lambda (name text) (map string->symbol (words text))))
    ("--type" #:type ,(lambda (name text) (string->symbol text)))
    ("--known" #:known ,(lambda (name text) (map clause (words text))))
    ("--places" #:places ,(lambda (name text) (map (lambda (word) (number name word)) (words text))))
    ("--clamped" #:clamped ,(lambda (name value) #t))
    ("--start" #:start ,(lambda (name text) (string->symbol text)))
    ("--hold-out" #:hold-out ,number)
    ("--held" #:held ,(lambda (name text) (string->symbol text)))
    ("--loss" #:loss ,(lambda (name text) (string->symbol text)))
    ("--sigma" #:sigma ,(lambda (name text) text))
    ("--density" #:density ,number)
    ("--floor" #:floor ,number)
    ("--intervals" #:intervals ,number)
    ("--set-pieces" #:set-pieces ,number)
    ("--step" #:step ,number)))

(define (keywords options)
  (append-map (lambda (entry)
                (let ((given (assoc-ref options (first entry))))
                  (if given (list (second entry) ((third entry) (first entry) given)) '())))
              meanings))

(define (along-name file)
  ;; swim.svg becomes swim-along.svg.
  (let ((i (or (string-rindex file #\.) (string-length file))))
    (string-append (substring file 0 i) "-along" (substring file i))))

(define (draw i file)
  (display (plot (residuals-in-time i) #:to file #:title "How far off its markers the line is" #:x "time, s"
                 #:y "mean distance, m"))
  (newline)
  (display (plot (residuals-along i) #:to (along-name file) #:title "How far off, along the line"
                 #:x "from the anchor, m" #:y "mean distance, m"))
  (newline))

(define (form-text i name)
  (call-with-output-string
    (lambda (port)
      (pretty-print (identified-type i name) port #:width 100))))

(define (write-form i name file)
  (check-writable 'identify file)
  (write-bytes 'identify (string->utf8 (form-text i name)) file)
  (simple-format #t "wrote ~a: (type ~a)~%" file name))

(define (identify-command files options)
  "Do bight identify of FILES with OPTIONS, an alist; return the exit status."
  (when (null? files)
    (bad-usage "identify: name one file or more, as in bight identify RUN.csv --unknown ei,cdn"))
  (for-each check-there files)
  (unless (assoc-ref options "--unknown")
    (bad-usage "identify: --unknown says what is to be found, as in --unknown ei,cdn"))
  (let ((i (apply identify files (keywords options)))
        (name (string->symbol (or (assoc-ref options "--name") "identified"))))
    (display i)
    (newline)
    (when (assoc-ref options "--plot") (draw i (assoc-ref options "--plot")))
    (if (assoc-ref options "-o")
        (write-form i name (assoc-ref options "-o"))
        (display (form-text i name)))
    0))
