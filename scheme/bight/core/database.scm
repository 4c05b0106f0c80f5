;;; (bight core database) --- databases with tables of our own.
;;;
;;; Loaded when the first is wanted: by frames of a recording, by the logbook, by sweeps.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core database)
  #:use-module (bight core errors)
  #:use-module ((bight core programs) #:select (temporary-file))
  #:use-module (bight core sqlite)
  #:use-module ((ice-9 binary-ports) #:select (get-bytevector-n))
  #:export (open-tables
            close-tables!
            in-transaction
            copy-of-database
            delete-database!))

(define (close-tables! database)
  "Close DATABASE."
  (%close-database database))

(define (in-transaction database thunk)
  "Call THUNK within one transaction of DATABASE: all that it does is done, or, when it raises something,
nothing.  Return what it returns."
  (%query database "begin immediate" '())
  (let ((result (with-exception-handler
                    (lambda (e)
                      (%query database "rollback" '())
                      (raise-exception e))
                  thunk
                  #:unwind? #t)))
    (%query database "commit" '())
    result))

(define* (open-tables proc file kind version statements #:key (alone? #f))
  "Open the database FILE and see to it that it has the tables that STATEMENTS make.  It says of itself
that it is of KIND, a number, and VERSION.  If ALONE?, no other process can open it until it is closed;
return #f when another has it now.  Raise a &bight-error from PROC: format when it is something else,
version when it is of a later version."
  (unless there?
    (bight-raise 'unsupported proc "this bight was built without SQLite (Debian package: libsqlite3-dev)"))
  (let ((database (%open-database file alone?)))
    (and database (ours-or-raise proc database file kind version statements))))

(define (ours-or-raise proc database file kind version statements)
  ;; DATABASE, opened from FILE, if it is of KIND and VERSION, or new; else it is closed.
  (with-exception-handler
      (lambda (e)
        (close-tables! database)
        (raise-exception e))
    (lambda ()
      (check-tables proc database file kind version statements)
      database)
    #:unwind? #t))

(define (check-tables proc database file kind version statements)
  (in-transaction database
    (lambda ()
      (let ((found-kind (caar (%query database "pragma application_id" '())))
            (found (caar (%query database "pragma user_version" '())))
            (tables (caar (%query database "select count(*) from sqlite_master" '()))))
        (cond ((zero? tables)
               (for-each (lambda (sql) (%query database sql '())) statements)
               (%query database (simple-format #f "pragma application_id=~a" kind) '())
               (%query database (simple-format #f "pragma user_version=~a" version) '()))
              ((not (= kind found-kind))
               (bight-raise 'format proc "~s is another kind of database" file))
              ((not (= version found))
               (bight-raise 'version proc "~s is of version ~a; this bight knows ~a" file found
                            version)))))))


;;; Looking at a database that another process keeps for itself.
;;;
;;; What is committed stands in its file and, after that, in the log FILE-wal.  SQLite moves the log into the
;;; file from time to time, and only then begins the log anew, with another head.  So when neither the file nor
;;; the head of the log changed while both were copied, the copies belong together; a line of the log that was
;;; being written is known by its check sum, and left out.

(define head-of-log 32)                 ; bytes

(define (head file)
  (and (file-exists? file)
       (call-with-input-file file (lambda (port) (get-bytevector-n port head-of-log)) #:binary #t)))

(define (signs file log)
  ;; What changes when the log is moved into FILE; #f when that may just have happened.
  (let ((s (stat file)))
    (and (> (abs (- (current-time) (stat:mtime s))) 1)
         (list (stat:mtime s) (stat:mtimensec s) (stat:size s) (head log)))))

(define (copied-whole? file copy)
  (let* ((log (string-append file "-wal"))
         (log-copy (string-append copy "-wal"))
         (before (signs file log)))
    (copy-file file copy)
    (if (file-exists? log)
        (copy-file log log-copy)
        (false-if-exception (delete-file log-copy)))
    (and before (equal? before (signs file log)))))

(define (delete-database! file)
  "Delete the database FILE with its log.  Whoever has it open may go on; nothing is left when it is closed."
  (for-each (lambda (suffix) (false-if-exception (delete-file (string-append file suffix)))) '("" "-wal" "-shm")))

(define (copy-of-database proc file)
  "Return the name of a new file that holds what is committed in the database FILE now, whoever has it open.
Raise a &bight-error from PROC if it changes faster than it can be copied."
  (let ((copy (or (false-if-exception (temporary-file))
                  (bight-raise 'io proc "no temporary file can be made for a copy of ~s" file))))
    (let try ((n 100))
      (cond ((false-if-exception (copied-whole? file copy)))
            ((zero? n)
             (bight-raise 'io proc "~s is being written without a pause: look at it later" file))
            (else
             (usleep 100000)
             (try (- n 1)))))
    ;; The log becomes part of the copy.
    (let ((database (%open-database copy #t)))
      (%query database "pragma journal_mode=delete" '())
      (%close-database database))
    copy))
