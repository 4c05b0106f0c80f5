;;; (bight core files) --- the files that a world names: where they are, and what is in them.
;;;
;;; A mesh or a grid is read when a dive begins, and kept for the next one: a file is read again only
;;; when it has changed.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core files)
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module (bight core schema)
  #:use-module (bight engine)
  #:use-module (bight world)
  #:use-module (bight world atlas)
  #:use-module (bight world earth)
  #:use-module (bight world flow-table)
  #:use-module (bight world waves)
  #:use-module (ice-9 binary-ports)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (engine-parts
            find-beside
            named-files
            world-origin
            limit-reading!
            check-files-beside))


;;; Where.

(define (source-folder w)
  ;; The folder of the file that W was written in, or #f.
  (let ((file (world-file w)))
    (and file
         (let ((found (if (file-exists? file) file (%search-load-path file))))
           (and found (dirname found))))))

(define (folders-beside w)
  (let ((own (source-folder w))) (if own (list own) '())))

(define (folders w)
  ;; Where a file that W names is looked for, in this order.
  (delete-duplicates
   (append (folders-beside w)
           (list ".")
           (worlds-path))))

;; What a process that is enclosed may read, folders and files; #f for all.
(define readable (make-parameter #f))

(define (limit-reading! paths)
  "From now on find no file but what lies beneath PATHS."
  (readable paths))

(define (beneath? path folder)
  (or (string=? path folder)
      (string-prefix? (string-append (string-trim-right folder #\/) "/") path)))

(define (there? path)
  ;; Is there a file PATH that may be read?  Links are followed first.
  (and (file-exists? path)
       (or (not (readable))
           (let ((true-path (false-if-exception (canonicalize-path path))))
             (and true-path
                  (any (lambda (folder)
                         (beneath? true-path (or (false-if-exception (canonicalize-path folder)) folder)))
                       (readable)))))))

(define (no-file proc name looked-in)
  (bight-raise 'io proc "there is no file ~s~a~a~a" name looked-in (if (readable) "" (file-meant name))
               (if (readable) "; what comes from outside reads what lies beside it" "")))

(define (find-beside proc w name)
  "Return the path of the file NAME that the world W names: beside W's own file, in the current folder, or
among the worlds.  Raise a &bight-error from PROC when there is none."
  (if (absolute-file-name? name)
      (if (there? name) name (no-file proc name ""))
      (let ((places (folders w)))
        (or (find there? (map (lambda (folder) (string-append folder "/" name)) places))
            (no-file proc name (string-append "; it was looked for in " (string-join places ", ")))))))


;;; What.

(define most-kept 8)

(define kept '())                       ; ((PATH TIME SIZE HOW) . OBJECT), the last used first

(define (identity-of path how)
  (let ((status (stat path)))
    (list path (stat:mtime status) (stat:mtimensec status) (stat:size status) how)))

(define (read-once path how read)
  ;; What READ returns for PATH, or returned the last time.
  (let* ((key (identity-of path how))
         (object (or (assoc-ref kept key) (read)))
         (others (alist-delete key kept)))
    (set! kept (acons key object (take others (min (length others) (- most-kept 1)))))
    object))

(define (world-origin proc w)
  "Return the origin of the world W, (LATITUDE LONGITUDE), or #f.  Raise a &bight-error from PROC if it has two."
  (origin-of-parts proc (map third (world->parts w))))

(define signatures
  ;; How files begin that are read in the coordinates of a map alone.
  (map (lambda (entry) (cons (u8-list->bytevector (car entry)) (cdr entry)))
       '(((73 73 42 0) . "GeoTIFF") ((77 77 0 42) . "GeoTIFF") ((73 73 43 0) . "GeoTIFF")
         ((67 68 70 1) . "NetCDF") ((67 68 70 2) . "NetCDF") ((67 68 70 5) . "NetCDF")
         ((137 72 68 70) . "NetCDF"))))

(define (signature-of path)
  ;; The name of the format that PATH begins as, or #f.
  (let ((bytes (false-if-exception
                (and (eq? 'regular (stat:type (stat path)))
                     (call-with-input-file path (lambda (port) (get-bytevector-n port 4)) #:binary #t)))))
    (and (bytevector? bytes) (assoc-ref signatures bytes))))

(define bed-only '(system variable positive reach))

(define (refuse-without-origin proc path fields)
  ;; What only a bed in the coordinates of a map can have.
  (let ((field (find (lambda (name) (assq name fields)) bed-only))
        (format (signature-of path)))
    (when (or field format)
      (bight-raise 'def proc "~a: ~a needs to know where the world's (0, 0) is: (origin LATITUDE LONGITUDE) of the \
sea or the seabed" path (if field (simple-format #f "(~a ...)" field) (simple-format #f "a ~a file" format))))))

(define (read-bed proc path fields origin)
  ;; The heights in PATH, for a bed with FIELDS in a world with ORIGIN.
  (define (given name) (assq-ref fields name))
  (cond ((and origin (not (equal? "local" (given 'system))))
         (let ((how (list origin (or (given 'reach) 0.) (given 'positive) (given 'system) (given 'variable))))
           (read-once path how (lambda () (apply %read-geo-heights path how)))))
        (else
         (refuse-without-origin proc path (if origin '() fields))
         (read-once path 'grid (lambda () (%read-heights path))))))

(define (read-flow proc w names)
  ;; The current in the one file of NAMES.
  (when (null? names)
    (bight-raise 'def proc "a world's (current (grid ...)) names its file"))
  (let ((path (find-beside proc w (car names))))
    (read-once path 'flow (lambda () (%read-current-grid path)))))

(define (read-column proc w file clauses origin)
  ;; The current in FILE, of an ocean model or an ADCP.
  (let* ((path (find-beside proc w file))
         (start (and=> (assq-ref clauses 'start) car))
         (at (or (and=> (assq-ref clauses 'at) car) origin)))
    (cond ((not (signature-of path))
           (read-once path (list 'table start) (lambda () (%current-of-rows (read-flow-table proc path start)))))
          ((not at)
           (bight-raise 'def proc "~a: a current of an ocean model is taken at a place: (at LATITUDE LONGITUDE) of \
the current, or (origin LATITUDE LONGITUDE) of the sea" path))
          (else
           (read-once path (list 'column at start) (lambda () (%read-geo-current path at start)))))))

(define (read-entry proc w head fields origin entry)
  ;; ENTRY of a part with HEAD and FIELDS, with what is in its file.
  (let* ((field (head-field head (car entry))) (kind (and field (field-kind field))))
    (cond ((and (eq? kind 'mesh) (string? (cdr entry)))
           (let ((path (find-beside proc w (cdr entry))) (up (or (assq-ref fields 'up) 'z)))
             (cons (car entry) (read-once path up (lambda () (%read-mesh path up))))))
          ((and (eq? kind 'grid) (string? (cdr entry)))
           (cons (car entry) (read-bed proc (find-beside proc w (cdr entry)) fields origin)))
          ((and (eq? kind 'current) (pair? (cdr entry)) (eq? 'grid (cadr entry)))
           (list (car entry) 'grid (read-flow proc w (cddr entry))))
          ((and (eq? kind 'current) (pair? (cdr entry)) (eq? 'from (cadr entry)))
           (list (car entry) 'grid (read-column proc w (caddr entry) (cdddr entry) origin)))
          ((eq? kind 'waves)
           (cons (car entry) (list->f64vector (waves->numbers (cdr entry)))))
          (else entry))))

(define (read-part proc w part origin)
  ;; PART, (HEAD NAME FIELDS), with what is in its files, and without what is the language's alone.
  (let ((head (first part)) (fields (third part)))
    (list head (second part)
          (filter-map (lambda (entry)
                        (and (not (eq? 'up (car entry)))
                             (not (map-field? (head-field head (car entry))))
                             (read-entry proc w head fields origin entry)))
                      fields))))

(define (named-files w)
  "Return the names of the files that the world W names."
  (define (names-in part)
    (filter-map (lambda (entry)
                  (let* ((field (head-field (first part) (car entry)))
                         (kind (and field (field-kind field))))
                    (cond ((and (memq kind '(mesh grid)) (string? (cdr entry))) (cdr entry))
                          ((and (eq? kind 'current) (pair? (cdr entry)) (memq (cadr entry) '(grid from))
                                (pair? (cddr entry)))
                           (caddr entry))
                          (else #f))))
                (third part)))
  (delete-duplicates (append-map names-in (world->parts w))))

(define (check-files-beside proc w)
  "Raise a &bight-error from PROC if the world W, which comes from outside, names a file that is there but
lies neither beside W's own file nor among the worlds."
  (let ((own (append (folders-beside w) (worlds-path))))
    (for-each
     (lambda (name)
       (let ((path (false-if-exception (find-beside proc w name))))
         (when path
           (parameterize ((readable own))
             (unless (there? path)
               (bight-raise 'unsupported proc
                            "~a: the file ~s lies elsewhere; --trust, or #:trust #t, reads it"
                            (or (world-file w) "a world") name))))))
     (named-files w))))

(define (engine-parts proc w)
  "Return what the engine makes a dive in the world W from: as `world->parts' has it, with what is in the
files of meshes and grids.  Raise a &bight-error from PROC when one is missing or wrong."
  (let ((origin (world-origin proc w)))
    (map (lambda (part) (read-part proc w part origin)) (world->parts w))))
