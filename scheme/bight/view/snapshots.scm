;;; (bight view snapshots) --- pictures of worlds and times, as the command line asks for them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view snapshots)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight core errors) #:select (bight-raise))
  #:use-module ((bight core folders) #:select (ensure-folder!))
  #:use-module ((bight dive) #:select (enter!))
  #:use-module ((bight dive time) #:select (run))
  #:use-module ((bight view picture) #:select (snapshot))
  #:use-module (srfi srfi-1)
  #:export (snapshot-worlds))

(define (option->symbol text)
  (string->symbol text))

(define (refuse-option name example text)
  (bight-raise 'domain 'snapshot "~a is written as in ~a ~a, not ~s" name name example text))

(define (option->size text)
  ;; "1280x720" as (1280 720).
  (let ((numbers (map text->number (string-split text #\x))))
    (if (and (= 2 (length numbers)) (every identity numbers))
        numbers
        (refuse-option "--size" "1280x720, pixels across and down" text))))

(define (option->views text)
  (let ((views (map option->symbol (string-split text #\,))))
    (if (null? (cdr views)) (car views) views)))

(define (number-option name example)
  (lambda (text) (or (text->number text) (refuse-option name example text))))

(define (option->point text)
  ;; "0,6,-9" as (0 6 -9).
  (let ((numbers (map text->number (string-split text #\,))))
    (if (and (= 3 (length numbers)) (every identity numbers))
        numbers
        (refuse-option "--at" "0,6,-9, metres east, north and up" text))))

(define (option->overlay text)
  (map option->symbol (string-split text #\,)))

(define command-options
  ;; What of the command line becomes which keyword, and how.
  `(("--view" #:view ,option->views)
    ("--size" #:size ,option->size)
    ("--paint" #:paint ,option->symbol)
    ("--overlay" #:overlay ,option->overlay)
    ("--at" #:at ,option->point)
    ("--extent" #:extent ,(number-option "--extent" "30, metres across"))
    ("--zoom" #:zoom ,(number-option "--zoom" "2, times nearer"))
    ("--visibility" #:visibility ,(number-option "--visibility" "4, metres"))
    ("--lights" #:lights ,option->symbol)))

(define (option->times text)
  ;; "10,20" as (10 20): the seconds into the dive of each picture, in order.
  (let ((times (map text->number (string-split text #\,))))
    (unless (and (every (lambda (t) (and (real? t) (>= t 0))) times) (apply <= times))
      (bight-raise 'domain 'snapshot
                   "--run must be seconds, such as 60 or, for several pictures, 10,20,60, not ~s" text))
    times))

(define (file-for folder world time)
  ;; Where the picture of WORLD at TIME, or of its beginning for #f, goes in FOLDER.
  (string-append folder "/" (basename (if (symbol? world) (symbol->string world) world) ".scm")
                 (if time (string-append "-" (number->string time) "s") "") ".png"))

(define (have-folder folder)
  (catch 'system-error
    (lambda () (ensure-folder! folder))
    (lambda details
      (bight-raise 'io 'snapshot "cannot make the folder ~s: ~a" folder
                   (strerror (system-error-errno details)))))
  (unless (file-is-directory? folder)
    (bight-raise 'io 'snapshot "several pictures go into a folder, and ~s is a file" folder)))

(define (keywords-of options)
  (append-map (lambda (entry)
                (let ((text (assoc-ref options (first entry))))
                  (if text (list (second entry) ((third entry) text)) '())))
              command-options))

(define (snapshots-of world times name-file options)
  ;; Write a picture of WORLD at each of TIMES, numbers or one #f, to what NAME-FILE makes of the time.
  (enter! world #:trust (assoc-ref options "--trust"))
  (let loop ((now 0) (times times) (done '()))
    (if (null? times)
        (reverse done)
        (let ((time (car times)))
          (when (and time (> time now))
            (run (- time now)))
          (loop (or time now) (cdr times)
                (cons (apply snapshot (name-file time) (keywords-of options)) done))))))

(define (snapshot-worlds worlds to options)
  "Start a dive in each of WORLDS, names or files, let it run as OPTIONS say, an alist of the command line,
and write pictures: one to the file TO, several into the folder TO.  Return what `snapshot' returns of each."
  (let* ((run (assoc-ref options "--run"))
         (times (if run (option->times run) '(#f))))
    (if (and (null? (cdr worlds)) (null? (cdr times)))
        (snapshots-of (car worlds) times (const to) options)
        (begin
          (have-folder to)
          (append-map (lambda (world)
                        (snapshots-of world times (lambda (time) (file-for to world (and run time))) options))
                      worlds)))))
