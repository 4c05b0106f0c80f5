;;; (bight lesson logbook) --- who dived, took which lesson, and knew what the tether did.
;;;
;;; One SQLite file under XDG_STATE_HOME (bight/logbook.db), for all trainees of this account; BIGHT_LOGBOOK
;;; names another.  Every entry is one transaction: many may write at a time, and what was written survives
;;; whatever happens to the process.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson logbook)
  #:use-module (bight core database)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module ((bight core folders) #:select (ensure-folder! state-folder))
  #:use-module (bight core record)
  #:use-module (bight core sqlite)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight world)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:use-module (srfi srfi-19)
  #:export (log-dive! log-lesson! log-probe!
            logbook logbook-file merge-logbook! entries-ahead
            log-entry? log-entry-kind log-entry-when log-entry-trainee log-entry-what log-entry-score
            log-entry-data))

(define kind #x4247484c)                ; "BGHL"
(define version 1)

(define tables
  '("create table entries (id integer primary key, kind text not null, time text not null,
trainee text not null, what text not null, score real, data text not null)"
    "create index entries_of on entries (trainee, kind)"))

(define-verb (logbook-file)
  "Return the name of the file that the logbook is in."
  (or (getenv "BIGHT_LOGBOOK")
      (string-append (or (state-folder) "/tmp/.local/state/bight") "/logbook.db")))

(define (make-folder folder)
  (catch 'system-error
    (lambda () (ensure-folder! folder #o700))
    (lambda arguments
      (bight-raise 'io 'logbook "~s: ~a" folder (strerror (system-error-errno arguments))))))

(define (call-with-logbook proc use)
  (let ((file (logbook-file)))
    (make-folder (dirname file))
    (let* ((database (open-tables proc file kind version tables))
           (result (use database)))
      (close-tables! database)
      result)))

(define (user-name)
  (or (getenv "USER")
      (catch #t (lambda () (passwd:name (getpwuid (getuid)))) (lambda args "somebody"))))

(define (universal time)
  (date->string (time-utc->date time 0) "~4"))

(define (present)
  (universal (current-time time-utc)))

(define (log! proc kind trainee what score data)
  (call-with-logbook proc
    (lambda (database)
      (in-transaction database
        (lambda ()
          (%query database
                  "insert into entries (kind, time, trainee, what, score, data) values (?, ?, ?, ?, ?, ?)"
                  (list kind (present) trainee what score
                        (with-output-to-string (lambda () (write data)))))
          (caar (%query database "select last_insert_rowid()" '())))))))


;;; Writing.

(define-argument-type (score value)
  "a number, or #f"
  (cond ((not value) value)
        ((and (real? value) (not (nan? value))) (exact->inexact value))
        (else refused)))

(define most-data 100000)

(define (room-after value room)
  ;; The room left when VALUE, which comes back as it was written, has taken its part of ROOM; else #f.
  (cond ((or (not room) (zero? room)) #f)
        ((pair? value) (room-after (cdr value) (room-after (car value) (- room 1))))
        ((or (null? value) (symbol? value) (string? value) (number? value) (boolean? value)) room)
        (else #f)))

(define-argument-type (data value)
  "a list of symbols, strings, numbers and such lists"
  (if (and (list? value) (room-after value most-data)) value refused))

(define (dive-world-name)
  (let ((name (and (current-dive) (world-name (dive-world (current-dive))))))
    (if name (symbol->string name) "")))

(define (dive-facts)
  (if (current-dive)
      (list (cons 'seconds (%dive-time (engine-of (current-dive)))))
      '()))

(define-verb (log-dive! #:key (trainee string (user-name)) (world string (dive-world-name))
                        (score score #f) (data data (dive-facts)))
  "Enter a dive in WORLD into the logbook: who dived, TRAINEE; a SCORE, if there is one; DATA, what else is
to be known.  What is left out is taken of the present dive.  Return the number of the entry."
  (log! 'log-dive! 'dive trainee world score data))

(define-verb (log-lesson! (lesson name) #:key (trainee string (user-name)) (score score #f)
                          (data data '()))
  "Enter that TRAINEE took LESSON, with its SCORE and DATA.  Return the number of the entry."
  (log! 'log-lesson! 'lesson trainee (symbol->string lesson) score data))

(define-verb (log-probe! (question string) #:key (trainee string (user-name)) (score score #f)
                         (data data '()))
  "Enter how TRAINEE answered QUESTION: SCORE, and in DATA, such as ((truth 3) (answer 2) (seconds 4.1)),
what else is to be known.  Return the number of the entry."
  (log! 'log-probe! 'probe trainee question score data))


;;; Merging.

(define (rows-of file)
  ;; The entries of the logbook FILE, which another process may have open.
  (unless (and (file-exists? file) (eq? 'regular (stat:type (stat file))))
    (bight-raise 'io 'merge-logbook! "there is no file ~s~a" file (file-meant file)))
  (let* ((copy (copy-of-database 'merge-logbook! file))
         (database (open-tables 'merge-logbook! copy kind version tables))
         (rows (%query database "select kind, time, trainee, what, score, data from entries order by id" '())))
    (close-tables! database)
    (delete-database! copy)
    rows))

(define (count-entries database)
  (caar (%query database "select count(*) from entries" '())))

(define (take-over! database rows)
  ;; Enter those of ROWS that are not there; return how many.
  (in-transaction database
    (lambda ()
      (let ((before (count-entries database)))
        (for-each
         (lambda (row)
           (%query database
                   "insert into entries (kind, time, trainee, what, score, data)
select ?1, ?2, ?3, ?4, ?5, ?6 where not exists (select 1 from entries where
kind = ?1 and time = ?2 and trainee = ?3 and what = ?4 and score is ?5 and data = ?6)"
                   row))
         rows)
        (- (count-entries database) before)))))

(define-verb (merge-logbook! (file string))
  "Take over what another logbook, in FILE, has and this one has not, as from another machine: entries are
the same when all that they say is, the time to the second among it.  Return how many were taken over.  In
whatever order logbooks are merged, and however often, the entries are the same in the end."
  (let ((rows (rows-of file)))
    (call-with-logbook 'merge-logbook!
      (lambda (database) (take-over! database rows)))))


(define small-difference 120)           ; s: clocks that differ by less tell the same time

(define* (entries-ahead #:optional (now (current-time time-utc)))
  "Return how many entries of the logbook are dated later than NOW, the time of this machine's clock."
  (let ((soon (universal (add-duration now (make-time time-duration 0 small-difference)))))
    (call-with-logbook 'logbook
      (lambda (database) (caar (%query database "select count(*) from entries where time > ?" (list soon)))))))


;;; Reading.

(define-record <log-entry>
  (make-log-entry id kind when trainee what score data)
  is-log-entry?
  (id log-entry-id)
  (kind entry-kind)
  (when entry-when)
  (trainee entry-trainee)
  (what entry-what)
  (score entry-score)
  (data entry-data))

(set-record-type-printer!
 <log-entry>
 (lambda (e port)
   (simple-format port "#<~a ~a, ~a: ~a~a ~a>" (entry-kind e) (log-entry-id e) (entry-trainee e)
                  (entry-what e)
                  (if (entry-score e) (simple-format #f ", ~a," (entry-score e)) "")
                  (entry-when e))))

(define-argument-type (log-entry value)
  "an entry of the logbook"
  (if (is-log-entry? value) value refused))

(define-syntax-rule (define-entry-question (name get) doc)
  (define-verb (name (entry log-entry)) doc (get entry)))

(define-verb (log-entry? (object any))
  "Return #t if OBJECT is an entry of the logbook."
  (is-log-entry? object))
(define-entry-question (log-entry-kind entry-kind)
  "Return the kind of ENTRY: dive, lesson or probe.")
(define-entry-question (log-entry-when entry-when)
  "Return when ENTRY was made, a string in universal time.")
(define-entry-question (log-entry-trainee entry-trainee)
  "Return whom ENTRY is about, a string.")
(define-entry-question (log-entry-what entry-what)
  "Return the world, the lesson or the question of ENTRY, a string.")
(define-entry-question (log-entry-score entry-score)
  "Return the score of ENTRY, or #f.")
(define-entry-question (log-entry-data entry-data)
  "Return the data of ENTRY.")

(define (row->entry row)
  (make-log-entry (first row) (string->symbol (second row)) (third row) (fourth row) (fifth row)
                  (sixth row)
                  (text->datum (seventh row))))

(define-verb (logbook #:key (trainee (or-false string) #f)
                      (kind (or-false (one-of dive lesson probe)) #f))
  "Return the entries of the logbook, the first first: of TRAINEE, of KIND, or all."
  (call-with-logbook 'logbook
    (lambda (database)
      (map row->entry
           (%query database
                   "select id, kind, time, trainee, what, score, data from entries
where (?1 is null or trainee = ?1) and (?2 is null or kind = ?2) order by id"
                   (list trainee kind))))))
