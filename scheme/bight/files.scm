;;; (bight files) --- the files that a world names: where they are, and what is in them.
;;;
;;; A mesh or a grid is read when a dive begins, and kept for the next one: a file is read again only
;;; when it has changed.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight files)
  #:use-module (bight atlas)
  #:use-module (bight engine)
  #:use-module (bight errors)
  #:use-module (bight schema)
  #:use-module (bight world)
  #:use-module (bight waves)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (engine-parts
            find-beside
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
  (bight-raise 'io proc "there is no file ~s~a~a" name looked-in
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

(define kept '())                       ; ((PATH TIME SIZE UP) . OBJECT), the last used first

(define (identity-of path up)
  (let ((status (stat path)))
    (list path (stat:mtime status) (stat:mtimensec status) (stat:size status) up)))

(define (read-once path up read)
  ;; What READ returns for PATH, or returned the last time.
  (let* ((key (identity-of path up))
         (object (or (assoc-ref kept key) (read)))
         (others (alist-delete key kept)))
    (set! kept (acons key object (take others (min (length others) (- most-kept 1)))))
    object))

(define (read-field proc w kind name up)
  (let ((path (find-beside proc w name)))
    (if (eq? kind 'mesh)
        (read-once path up (lambda () (%read-mesh path up)))
        (read-once path 'grid (lambda () (%read-heights path))))))

(define (read-flow proc w names)
  ;; The current in the one file of NAMES.
  (when (null? names)
    (bight-raise 'def proc "a world's (current (grid ...)) names its file"))
  (let ((path (find-beside proc w (car names))))
    (read-once path 'flow (lambda () (%read-current-grid path)))))

(define (read-part proc w part)
  ;; PART, (HEAD NAME FIELDS), with what is in its files.
  (let* ((head (first part)) (fields (third part)) (up (or (assq-ref fields 'up) 'z)))
    (define (read-entry entry)
      (let* ((field (head-field head (car entry))) (kind (and field (field-kind field))))
        (cond ((and (memq kind '(mesh grid)) (string? (cdr entry)))
               (cons (car entry) (read-field proc w kind (cdr entry) up)))
              ((and (eq? kind 'current) (pair? (cdr entry)) (eq? 'grid (cadr entry)))
               (list (car entry) 'grid (read-flow proc w (cddr entry))))
              ((eq? kind 'waves)
               (cons (car entry) (list->f64vector (waves->numbers (cdr entry)))))
              (else entry))))
    (list head (second part) (map read-entry (alist-delete 'up fields eq?)))))

(define (names-in part)
  ;; The files that PART, (HEAD NAME FIELDS), names.
  (filter-map (lambda (entry)
                (let* ((field (head-field (first part) (car entry)))
                       (kind (and field (field-kind field))))
                  (cond ((and (memq kind '(mesh grid)) (string? (cdr entry))) (cdr entry))
                        ((and (eq? kind 'current) (pair? (cdr entry)) (eq? 'grid (cadr entry))
                              (pair? (cddr entry)))
                         (caddr entry))
                        (else #f))))
              (third part)))

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
     (append-map names-in (world->parts w)))))

(define (engine-parts proc w)
  "Return what the engine makes a dive in the world W from: as `world->parts' has it, with what is in the
files of meshes and grids.  Raise a &bight-error from PROC when one is missing or wrong."
  (map (lambda (part) (read-part proc w part)) (world->parts w)))
