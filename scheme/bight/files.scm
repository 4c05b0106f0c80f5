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
            find-beside))


;;; Where.

(define (source-folder w)
  ;; The folder of the file that W was written in, or #f.
  (let ((file (world-file w)))
    (and file
         (let ((found (if (file-exists? file) file (%search-load-path file))))
           (and found (dirname found))))))

(define (folders w)
  ;; Where a file that W names is looked for, in this order.
  (delete-duplicates
   (append (let ((own (source-folder w))) (if own (list own) '()))
           (list ".")
           (worlds-path))))

(define (find-beside proc w name)
  "Return the path of the file NAME that the world W names: beside W's own file, in the current folder, or
among the worlds.  Raise a &bight-error from PROC when there is none."
  (if (absolute-file-name? name)
      (if (file-exists? name)
          name
          (bight-raise 'io proc "there is no file ~s" name))
      (let ((places (folders w)))
        (or (find file-exists? (map (lambda (folder) (string-append folder "/" name)) places))
            (bight-raise 'io proc "there is no file ~s; it was looked for in ~a" name
                         (string-join places ", "))))))


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

(define (engine-parts proc w)
  "Return what the engine makes a dive in the world W from: as `world->parts' has it, with what is in the
files of meshes and grids.  Raise a &bight-error from PROC when one is missing or wrong."
  (map (lambda (part) (read-part proc w part)) (world->parts w)))
