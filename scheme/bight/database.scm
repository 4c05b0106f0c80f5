;;; (bight database) --- databases with tables of our own.
;;;
;;; Loaded when the first is wanted: by frames of a recording, by the logbook.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight database)
  #:use-module (bight errors)
  #:use-module (bight sqlite)
  #:export (open-tables
            close-tables!
            in-transaction))

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

(define (open-tables proc file kind version statements)
  "Open the database FILE and see to it that it has the tables that STATEMENTS make.  It says of itself
that it is of KIND, a number, and VERSION.  Raise a &bight-error from PROC: format when it is something
else, version when it is of a later version."
  (unless there?
    (bight-raise 'unsupported proc "this bight was built without SQLite (Debian package: libsqlite3-dev)"))
  (let ((database (%open-database file)))
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
                              version))))))
    database))
