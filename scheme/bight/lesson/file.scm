;;; (bight lesson file) --- lessons in files: which there are, and reading one.
;;;
;;; A lesson that comes with bight lies in a folder of lessons as NN-NAME.scm and is called NAME, or NN.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson file)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module ((bight shell program) #:select (evaluate-file))
  #:use-module (bight core errors)
  #:use-module (bight core folders)
  #:use-module (bight core verb)
  #:use-module ((bight engine) #:select (%worlds-folder))
  #:use-module (bight language)
  #:use-module (bight lesson)
  #:use-module ((bight view looks) #:select (with-sentences))
  #:use-module (ice-9 ftw)
  #:use-module (srfi srfi-1)
  #:export (lessons
            lessons-path
            lesson-files
            lesson-file
            lesson-file-name
            lesson-file-title
            lesson-file-clause
            load-lesson
            read-lessons))

(define (lessons-path)
  "Return the list of folders where lessons are looked for by name: those in the environment variable
BIGHT_LESSONS and bight's own."
  (search-path-of "BIGHT_LESSONS" (string-append (dirname (%worlds-folder)) "/lessons")))

(define (numbered? file)
  (and (string-suffix? ".scm" file)
       (> (string-length file) 7)
       (string-every char-numeric? (substring file 0 2))
       (char=? #\- (string-ref file 2))))

(define (lesson-files)
  "Return the files of the lessons that are known by name, in order."
  (delete-duplicates
   (append-map (lambda (folder)
                 (map (lambda (file) (string-append folder "/" file))
                      (or (scandir folder numbered? string<?) '())))
               (lessons-path))
   (lambda (a b) (string=? (basename a) (basename b)))))

(define (lesson-file-name file)
  "Return the name, a symbol, of the lesson in FILE, one of `lesson-files'."
  (string->symbol (substring (basename file ".scm") 3)))

(define-verb (lessons)
  "Return the names of the lessons that come with bight, in order; at the prompt each comes with its title.
`bight lesson NAME' takes one."
  (with-sentences (map lesson-file-name (lesson-files))
                  (lambda (name) (lesson-file-title (lesson-file (symbol->string name))))))

(define (lesson-form file)
  ;; The form (define-lesson NAME "title" CLAUSE ...) in FILE, found without running it, or #f.
  (call-with-input-file file
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (let loop ()
        (let ((form (read port)))
          (cond ((eof-object? form) #f)
                ((and (list? form) (> (length form) 2) (eq? 'define-lesson (car form))
                      (string? (third form)))
                 form)
                (else (loop))))))))

(define (lesson-file-title file)
  "Return the title of the lesson in FILE, found without running it."
  (let ((form (lesson-form file)))
    (if form (third form) "")))

(define (lesson-file-clause file head)
  "Return what stands in the clause HEAD of the lesson in FILE, a list, empty without one; it is not run."
  (let ((clause (find (lambda (c) (and (list? c) (pair? c) (eq? head (car c))))
                      (cdddr (or (lesson-form file) '(#f #f #f))))))
    (if clause (cdr clause) '())))

(define (lesson-file designator)
  "Return the file of the lesson that DESIGNATOR, a string, names: by name or number.  Raise a &bight-error
of kind name when there is none."
  (let* ((files (lesson-files))
         (number (text->number designator)))
    (or (find (lambda (file)
                (or (string=? designator (symbol->string (lesson-file-name file)))
                    (eqv? number (text->number (substring (basename file) 0 2)))))
              files)
        (if number
            (bight-raise 'name 'lesson "there are lessons from 1 to ~a, not ~a; `bight lessons' lists them"
                         (length files) designator)
            (unknown-name 'lesson "the list of lessons" designator (lessons))))))

(define (read-lessons file)
  "Return the lessons that FILE, which is trusted, defines."
  (collect-lessons
   (lambda ()
     (call-in-language (lambda () (evaluate-file file))))))

(define* (load-lesson file #:optional (read read-lessons))
  "Return the lesson in FILE as READ reads it; the last when there are more."
  (let ((found (read file)))
    (when (null? found)
      (bight-raise 'format 'lesson "~a defines no lesson: it says no (define-lesson NAME \"title\" ...)" file))
    (last found)))
