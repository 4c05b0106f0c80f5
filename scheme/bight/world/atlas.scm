;;; (bight world atlas) --- worlds by name: those defined here, those in files.
;;;
;;; What lies in the folders where worlds are looked for by name is the user's own, and so is what he calls
;;; trusted: it is evaluated in full.  Any other file is read in an enclosed process, (bight world outside).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world atlas)
  #:use-module (bight assembly)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module (bight core folders)
  #:use-module (bight core verb)
  #:use-module ((bight engine) #:select (%worlds-folder))
  #:use-module (bight language)
  #:use-module ((bight view looks) #:select (with-sentences))
  #:use-module (srfi srfi-1)
  #:export (remember-world!
            last-remembered
            worlds-path
            worlds
            find-world
            world-text
            world-called
            the-world
            type:the-world))

(define known-worlds (make-hash-table))  ; symbol -> world

(define current-rememberer
  ;; What to do with a world just defined.
  (make-parameter (lambda (w) (hashq-set! known-worlds (world-name-of w) w))))

(define (remember-world! w)
  "Make the world W known by its name; return it."
  ((current-rememberer) w)
  w)

(define (last-remembered thunk)
  "Call THUNK; return the last world that was defined meanwhile, or #f.  It is not made known."
  (let ((found #f))
    (parameterize ((current-rememberer (lambda (w) (set! found w))))
      (thunk))
    found))

(define (worlds-path)
  "Return the list of folders where worlds are looked for by name: those in the environment variable
BIGHT_WORLDS, worlds/ here, and bight's own."
  (search-path-of "BIGHT_WORLDS" "worlds" (%worlds-folder)))

(define (folder-worlds folder)
  (map (lambda (file) (string->symbol (string-drop-right file (string-length ".scm"))))
       (or (scandir* folder) '())))

(define (scandir* folder)
  ;; The .scm files in FOLDER, or #f.
  (let ((port (false-if-exception (opendir folder))))
    (and port
         (let loop ((files '()))
           (let ((file (readdir port)))
             (cond ((eof-object? file) (closedir port) files)
                   ((and (string-suffix? ".scm" file) (not (string-prefix? "." file)))
                    (loop (cons file files)))
                   (else (loop files))))))))

(define-verb (worlds)
  "Return the sorted names of the worlds that can be entered by name: those defined here and those in
files.  At the prompt each comes with its sentence."
  (with-sentences
   (sort (delete-duplicates
          (append (hash-map->list (lambda (name w) name) known-worlds)
                  (append-map folder-worlds (worlds-path)))
          eq?)
         (lambda (a b) (string<? (symbol->string a) (symbol->string b))))
   world-text))

(define (plain-name? text)
  (not (or (string-null? text) (string-index text #\/) (string-prefix? "." text)
           (string-index text #\nul))))

(define (world-file-named text)
  ;; The file of the world called TEXT on the path, or #f.
  (and (plain-name? text)
       (find file-exists?
             (map (lambda (folder) (string-append folder "/" text ".scm")) (worlds-path)))))

(define (text-in file)
  ;; The sentence of the last world that FILE defines, found without running it, or #f.
  (call-with-input-file file
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (let loop ((text #f))
        (let ((form (read port)))
          (cond ((eof-object? form) text)
                ((and (list? form) (> (length form) 2) (eq? 'define-world (car form)) (string? (third form)))
                 (loop (third form)))
                (else (loop text))))))))

(define (world-text name)
  "Return the sentence of the world NAME, a symbol, that was defined here or lies in a file, or #f."
  (let ((known (hashq-ref known-worlds name)))
    (if known
        (world-documentation-of known)
        (and=> (world-file-named (symbol->string name))
               (lambda (file) (false-if-exception (text-in file)))))))

(define (refuse-file proc file exception)
  ;; Raise what EXCEPTION says, after its place; an error of the reader tells that itself.
  (let ((kind (exception-kind exception))
        (text ((from (bight core told) exception->placed-line) exception)))
    (when (memq kind '(quit signal user-interrupt))
      (raise-exception exception))
    (raise-engine-error (cond ((bight-error? exception) (bight-error-kind exception))
                              ((eq? kind 'system-error) 'io)
                              (else 'format))
                        proc
                        (if (or ((from (bight core told) raised-at) exception)
                                (string-prefix? (string-append file ":") text))
                            text
                            (string-append file ": " text)))))

(define own-worlds (make-hash-table))   ; file of a world that comes with bight -> (VERSION . WORLD)

(define (version-of file)
  (let ((s (stat file)))
    (list (stat:mtime s) (stat:mtimensec s) (stat:size s))))

(define (comes-with-bight? file)
  ;; Where BIGHT_WORLDS names a folder of the user's, that stands for bight's own, but for the tree as built.
  (and (string=? (%worlds-folder) (dirname file))
       (or (not (getenv "BIGHT_WORLDS")) (getenv "BIGHT_UNINSTALLED"))))

(define (load-world proc file)
  ;; The last world that FILE defines; it is not made known, so that a changed file is read again.  Those that come with
  ;; bight depend on nothing but their text: read once, they are kept.
  (if (comes-with-bight? file)
      (let ((version (version-of file)) (kept (hash-ref own-worlds file '(#f))))
        (unless (equal? version (car kept))
          (set! kept (cons version (read-world proc file)))
          (hash-set! own-worlds file kept))
        (cdr kept))
      (read-world proc file)))

(define (read-world proc file)
  (or (last-remembered
       (lambda ()
         (with-exception-handler
             (lambda (exception) (refuse-file proc file exception))
           (lambda ()
             (call-in-language (lambda () ((from (bight core place) load-marked) file))))
           #:unwind? #t)))
      (bight-raise 'format proc "~a defines no world" file)))

(define (regular-file? text)
  ;; A device such as /dev/zero has no end.
  (and (file-exists? text) (eq? 'regular (stat:type (stat text)))))

(define (canonical folder)
  (false-if-exception (canonicalize-path folder)))

(define (on-the-path? file)
  ;; Does FILE lie in one of the folders where worlds are looked for by name?
  (let ((folder (canonical (dirname file))))
    (and folder (member folder (filter-map canonical (worlds-path))) #t)))

(define (file-world proc text trust?)
  (cond ((string-index text #\nul) (bight-raise 'io proc "no file is called ~s" text))
        ((regular-file? text)
         (if (or trust? (on-the-path? text))
             (load-world proc text)
             ((module-ref (resolve-interface '(bight world outside)) 'read-world-outside) proc text)))
        ((world-file-named (if (string-suffix? ".scm" text) (string-drop-right text 4) text))
         => (lambda (file) (load-world proc file)))
        ((nearest text (worlds))
         => (lambda (near) (bight-raise 'io proc "there is no file ~s; did you mean '~a?" text near)))
        (else (let ((meant (file-meant text)))
                (bight-raise 'io proc "there is no file ~s~a" text
                             (if (string-null? meant)
                                 (string-append "; known worlds are " (words->string (worlds)))
                                 meant))))))

(define-argument-type (world-designator value)
  "a world, the name of one as in 'open-water, or a file name"
  (if (or (is-world? value) (symbol? value) (string? value)) value refused))

(define* (world-called proc designator #:optional trust?)
  "Return the world that DESIGNATOR, a world, a symbol or a file name, stands for; PROC asks.  A file from
elsewhere than the folders of worlds is enclosed unless TRUST?."
  (cond ((is-world? designator) designator)
        ((string? designator) (file-world proc designator trust?))
        ((hashq-ref known-worlds designator))
        ((world-file-named (symbol->string designator))
         => (lambda (file) (load-world proc file)))
        (else (unknown-name proc "the list of worlds" designator (worlds)))))

(define-verb (find-world (designator world-designator) #:key (trust flag #f))
  "Return the world DESIGNATOR stands for: a world, the name of one defined here or in a file NAME.scm in
a folder of worlds, or the name of a file.  A file in none of those folders is enclosed: it has the
language of worlds and cannot touch anything; with TRUST it may do all that you may.  Raise a &bight-error
when there is none, or the file is wrong."
  (world-called 'find-world designator trust))

(define-argument-type (the-world value)
  "a world, or the name of one, as in 'open-water"
  (cond ((is-world? value) value)
        ((symbol? value) (find-world value))
        (else refused)))

(define (the-world proc value)
  "Return the world that VALUE, a world or the name of one, stands for; PROC asks."
  (check-argument proc 'world type:the-world value))
