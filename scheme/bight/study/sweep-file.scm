;;; (bight study sweep-file) --- studies in files: finding one, reading it, and what its text is.
;;;
;;; A study that comes with bight lies in a folder of studies as NAME.scm.  Its text is what decides how a
;;; case comes out: all forms of the file but the sentence, and but which cases there are and how long one
;;; may take.  So remarks, more seeds or a wider grid leave the cases flown before as they are.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-file)
  #:use-module ((bight shell program) #:select (evaluate-file))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module (bight core folders)
  #:use-module ((bight engine) #:select (%worlds-folder))
  #:use-module (bight language)
  #:use-module (bight study)
  #:use-module ((bight study case) #:select (study-name))
  #:use-module (ice-9 ftw)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (srfi srfi-1)
  #:export (studies-path
            study-file
            load-study
            study-text))

(define (studies-path)
  "Return the list of folders where studies are looked for by name: those in the environment variable
BIGHT_STUDIES and bight's own."
  (search-path-of "BIGHT_STUDIES" (string-append (dirname (%worlds-folder)) "/studies")))

(define (names-in folder)
  (map (lambda (file) (basename file ".scm"))
       (or (scandir folder (lambda (file) (string-suffix? ".scm" file))) '())))

(define (study-file designator)
  "Return the file of the study that DESIGNATOR, a file's name or the name of a study, stands for."
  (cond ((and (file-exists? designator) (not (file-is-directory? designator))) designator)
        ((or (string-index designator #\/) (string-suffix? ".scm" designator))
         (bight-raise 'io 'sweep "there is no file ~s~a" designator (file-meant designator)))
        ((find file-exists? (map (lambda (folder) (string-append folder "/" designator ".scm"))
                                 (studies-path))))
        (else (unknown-name 'sweep "the list of studies" designator
                            (delete-duplicates (append-map names-in (studies-path)))))))

(define (load-study file)
  "Return the one study that FILE defines."
  (let ((found (collect-studies
                (lambda ()
                  (call-in-language (lambda () (evaluate-file file)))))))
    (case (length found)
      ((1) (car found))
      ((0) (bight-raise 'format 'sweep "~s defines no study: it says no (define-study NAME \"sentence\" ...)"
                        file))
      (else (bight-raise 'format 'sweep "~s defines ~a studies, ~a: put each into a file of its own" file
                         (length found) (words->string (map study-name found)))))))

(define (skip-first-line! port)
  ;; `#!/usr/bin/bight' would begin a comment.
  (let ((line (read-line port)))
    (unless (and (string? line) (string-prefix? "#!/" line))
      (seek port 0 SEEK_SET))))

(define (forms-of file)
  (call-with-input-file file
    (lambda (port)
      (skip-first-line! port)
      (let loop ((forms '()))
        (let ((form (read port)))
          (if (eof-object? form) (reverse forms) (loop (cons form forms))))))
    #:encoding "UTF-8"))

(define (essence form)
  ;; FORM without what says nothing of a case.
  (if (and (pair? form) (eq? 'define-study (car form)))
      (let* ((clauses (cdddr form))
             (clauses (if (and (pair? clauses) (eq? #:for (car clauses))) (cddr clauses) clauses)))
        (cons* 'define-study (cadr form)
               (remove (lambda (clause) (and (pair? clause) (memq (car clause) design-clauses)))
                       clauses)))
      form))

(define (study-text file)
  "Return the text of the study in FILE, a string."
  (object->string (map essence (forms-of file))))
