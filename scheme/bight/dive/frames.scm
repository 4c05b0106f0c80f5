;;; (bight dive frames) --- what a dive looked like, in tables a person can query.
;;;
;;;   frames    frame, time, step
;;;   vehicles  frame, name, x, y, z, heading (degrees), speed
;;;   tethers   frame, name, length, anchor_tension, end_tension, max_tension
;;;   points    frame, tether, node, x, y, z, tension
;;;
;;; Metres, seconds, newtons.  As in: select time, max(tension) from points natural join frames group by
;;; frame;
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive frames)
  #:use-module (bight core database)
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module ((bight core markup) #:select (csv-line))
  #:use-module (bight core sqlite)
  #:use-module (bight core verb)
  #:use-module (bight engine)
  #:use-module ((ice-9 textual-ports) #:select (get-string-n))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (open-frames
            frame-of
            write-frames!
            close-frames!
            query-frames
            export-csv))

(define kind #x42474846)                ; "BGHF"
(define version 1)

(define tables
  '("create table frames (frame integer primary key, time real not null, step integer not null)"
    "create table vehicles (frame integer not null, name text not null, x real, y real, z real,
heading real, speed real)"
    "create table tethers (frame integer not null, name text not null, length real, anchor_tension real,
end_tension real, max_tension real)"
    "create table points (frame integer not null, tether text not null, node integer not null, x real,
y real, z real, tension real)"
    "create index points_of on points (frame, tether)"))

(define (open-frames proc file)
  "Return the database FILE for frames, made anew."
  (when (file-exists? file)
    (close-frames! (open-tables proc file kind version tables)) ; only what is ours is written over
    (delete-file file))
  (open-tables proc file kind version tables))

(define (close-frames! database)
  "Close DATABASE."
  (close-tables! database))

(define (norm v)
  (sqrt (fold (lambda (x sum) (+ sum (* x x))) 0.0 (f64vector->list v))))

(define (vehicle-row engine name i)
  (let ((v (%vehicle engine i)))
    `(,name ,@(f64vector->list (assq-ref v 'position)) ,(assq-ref v 'heading)
            ,(norm (assq-ref v 'velocity)))))

(define (tether-row engine name i)
  (let ((t (%tether engine i)))
    (cons name (map (lambda (key) (assq-ref t key)) '(length tension-anchor tension-end tension-max)))))

(define (tensions-of engine i n)
  ;; Models without tensions have none in the table.
  (catch 'bight-error
    (lambda () (f64vector->list (%tether-tensions engine i 0)))
    (lambda args (make-list n #f))))

(define (point-rows engine name i)
  (let ((points (array->list (%tether-points engine i 0))))
    (map (lambda (node point tension) `(,name ,node ,@point ,tension))
         (iota (length points)) points (tensions-of engine i (length points)))))

(define (of-each engine head row)
  (map (lambda (name i) (row engine name i)) (%names engine head)
       (iota (length (%names engine head)))))

(define (frame-of engine)
  "Return what ENGINE looks like now, to be written later: (TIME STEP VEHICLES TETHERS POINTS)."
  (list (%dive-time engine) (%dive-steps engine)
        (of-each engine 'rov vehicle-row)
        (of-each engine 'tether tether-row)
        (append-map (lambda (name i) (point-rows engine name i)) (%names engine 'tether)
                    (iota (length (%names engine 'tether))))))

(define (write-frame! database frame)
  (%insert database "insert into frames (time, step) values (?, ?)" (list (take frame 2)))
  (let ((number (caar (%query database "select last_insert_rowid()" '()))))
    (define (insert! sql rows)
      (%insert database sql (map (lambda (row) (cons number row)) rows)))
    (insert! "insert into vehicles values (?, ?, ?, ?, ?, ?, ?)" (third frame))
    (insert! "insert into tethers values (?, ?, ?, ?, ?, ?)" (fourth frame))
    (insert! "insert into points values (?, ?, ?, ?, ?, ?, ?)" (fifth frame))))

(define (write-frames! database frames)
  "Write FRAMES, from `frame-of', into DATABASE, in one transaction."
  (unless (null? frames)
    (in-transaction database
      (lambda () (for-each (lambda (frame) (write-frame! database frame)) frames)))))


;;; For other programs.

(define (begins-as-sqlite? file)
  (let ((head (call-with-input-file file (lambda (port) (get-string-n port 6)) #:encoding "ISO-8859-1")))
    (and (string? head) (string=? "SQLite" head))))

(define (check-frames proc file)
  ;; A file that is there is SQLite's: the text of the recording is easily given instead.
  (unless (file-exists? file)
    (bight-raise 'io proc "there is no file ~s~a" file (file-meant file)))
  (when (file-is-directory? file)
    (bight-raise 'io proc "~s is a folder, not the frames of a recording" file))
  (unless (and (eq? 'regular (stat:type (stat file))) (begins-as-sqlite? file))
    (bight-raise 'format proc "~s is not a database of frames; (record! FILE #:frames NAME) writes one to NAME"
                 file)))

(define (query-frames proc file queries)
  "Return what the database FILE of frames answers to each of QUERIES, lists of rows."
  (check-frames proc file)
  (let* ((database (open-tables proc file kind version tables))
         (answers (map (lambda (sql) (%query database sql '())) queries)))
    (close-tables! database)
    answers))

(define-verb (export-csv (frames string) (file string))
  "Write the FRAMES of a recording, the file that `record!' was given, to FILE, comma-separated: time,
part, node, x, y, z, tension; a vehicle has neither node nor tension.  Return how many lines there are."
  (let ((rows (first (query-frames 'export-csv frames
                                   '("select time, name, null, x, y, z, null from vehicles natural join frames
union all select time, tether, node, x, y, z, tension from points natural join frames
order by 1, 2, 3")))))
    (catch 'system-error
      (lambda ()
        (call-with-output-file file
          (lambda (port)
            (display "time,part,node,x,y,z,tension\n" port)
            (for-each (lambda (row) (display (csv-line row) port) (newline port)) rows))))
      (lambda args
        (bight-raise 'io 'export-csv "~s: ~a" file (strerror (system-error-errno args)))))
    (length rows)))
