;;; (bight study sweep-result) --- what a sweep found, in one SQLite file that anybody can query.
;;;
;;;   study   name, value: the study's name, sentence, text, world, version, variables, measures, kinds, ...
;;;   cases   number, key, status (done, failed, timed out), error, message, cpu (s), hash, version, and a
;;;           column for each variable and each measure
;;;   legs    key (of the case), leg (1, 2, ...), name, x, y, z, and a column for each measure
;;;
;;; True and false are 1 and 0; which measures are true or false, numbers or words, stands in `kinds'.  A case is
;;; in the table when it has an outcome, and then in one transaction with its legs: what is not there is to be
;;; flown.  As in: select U, avg(fouled) from cases where status = 'done' group by U;
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight study sweep-result)
  #:use-module (bight core database)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (file-meant))
  #:use-module ((bight core programs) #:select (check-writable))
  #:use-module (bight core sqlite)
  #:use-module (bight study sweep-design)
  #:use-module (bight study sweep-plan)
  #:use-module (srfi srfi-1)
  #:export (open-result
            open-found
            close-result!
            found-plan
            known-keys
            add-case!
            number-cases!
            forget-cases!
            case-rows
            leg-rows
            count-by-status
            any-interrupted?
            result-fingerprint
            merge-result!))

(define kind #x42474853)                ; "BGHS"
(define version 1)


;;; Tables.

(define (column name)
  ;; NAME, a symbol, as SQL has it.
  (string-append "\"" (string-join (string-split (symbol->string name) #\") "\"\"") "\""))

(define (columns names)
  (string-concatenate (map (lambda (name) (string-append ", " (column name))) names)))

(define (outcome-columns plan)
  (append (plan-fact plan 'variables) (plan-fact plan 'measures)))

(define (tables plan)
  (list "create table study (name text primary key, value text not null)"
        (string-append "create table cases (number integer not null, key text primary key,
status text not null, error text, message text, cpu real, hash text, version text not null"
                       (columns (outcome-columns plan)) ")")
        (string-append "create table legs (key text not null, leg integer not null, name text not null,
x real, y real, z real" (columns (plan-fact plan 'measures)) ", primary key (key, leg))")
        "create index cases_in_order on cases (number)"))

(define (write-plan! database plan)
  (%insert database "insert or replace into study values (?, ?)"
           (map (lambda (fact) (list (car fact) (object->string (cdr fact)))) (plan-facts plan))))

(define (names? value)
  (and (list? value) (every symbol? value)))

(define (size? value)
  (and (exact-integer? value) (<= 0 value 1000000000)))

(define (kinds? value)
  (or (not value)                       ; an older bight tells none
      (and (list? value)
           (every (lambda (entry) (and (pair? entry) (memq (cdr entry) '(boolean number text)))) value))))

(define shapes                          ; what is built upon, and must be what it was written as
  `((name . ,symbol?) (file . ,string?) (version . ,string?) (variables . ,names?) (measures . ,names?)
    (legs . ,list?) (cases . ,size?) (kinds . ,kinds?)))

(define (check-shapes plan)
  (for-each (lambda (shape)
              (let ((value (plan-fact plan (car shape))))
                (unless ((cdr shape) value)
                  (bight-raise 'format 'sweep "this result says of its study that its ~a is ~s, which no study has"
                               (car shape) value))))
            shapes)
  plan)

(define (found-plan database)
  "Return the plan of the result DATABASE.  Raise format when it holds none."
  (check-shapes
   (make-plan (map (lambda (row)
                     (cons (string->symbol (first row)) (text->datum (second row))))
                   (%query database "select name, value from study order by rowid" '())))))

(define (open-named file statements alone?)
  ;; What SQLite says of a file does not name it.
  (with-exception-handler
      (lambda (e)
        (if (and (bight-error? e) (not (string-contains (bight-error-message e) file))
                 (not (eq? 'unsupported (bight-error-kind e))))
            (bight-raise (bight-error-kind e) 'sweep "~s: ~a" file (bight-error-message e))
            (raise-exception e)))
    (lambda () (open-tables 'sweep file kind version statements #:alone? alone?))
    #:unwind? #t))

(define (open-alone file statements patience)
  ;; The database FILE, for us alone; who has it is waited for, PATIENCE seconds at most, and #f if in vain.
  (or (open-named file statements #t)
      (and (positive? patience)
           (begin
             (sleep 1)
             (open-alone file statements (- patience 1))))))

(define* (open-result file plan #:key (patience 0))
  "Open the result FILE, made if there is none, for PLAN.  Raise a &bight-error of kind stale if it is of
another study, text, world or version.  Nobody else can write it until it is closed; who is
writing it is waited for, PATIENCE seconds at most."
  (check-writable 'sweep file)
  (let ((database (open-alone file (tables plan) patience)))
    (unless database
      (bight-raise 'io 'sweep "another sweep is writing ~s" file))
    (if (null? (%query database "select name from study limit 1" '()))
        (begin
          (write-kinds! database '())
          (write-plan! database plan))
        (check-same file plan (found-plan database)))
    database))

(define (check-found file)
  (unless (file-exists? file)
    (bight-raise 'io 'sweep "there is no file ~s~a" file (file-meant file)))
  (when (file-is-directory? file)
    (bight-raise 'io 'sweep "~s is a folder, not the result of a sweep" file))
  (when (zero? (stat:size (stat file)))
    (bight-raise 'format 'sweep "~s is empty, not the result of a sweep" file)))

(define (open-found file)
  "Open the result FILE, which must be there, to look into it: itself, or a copy of it as it is now while a
sweep is writing it."
  (check-found file)
  (or (open-named file '() #t)
      (let* ((copy (copy-of-database 'sweep file))
             (database (open-named copy '() #t)))
        (delete-database! copy)
        database)))

(define (call-with-settled file proc)
  ;; Call PROC with the name of a file that holds what FILE, a result, holds, and that nobody is writing.
  (let ((database (begin (check-found file) (open-named file '() #t))))
    (if database
        (begin
          (close-result! database)
          (proc file))
        (let ((copy (copy-of-database 'sweep file)))
          (dynamic-wind
            (const #f)
            (lambda () (proc copy))
            (lambda () (delete-database! copy)))))))

(define (close-result! database)
  "Close DATABASE.  What it holds is then in one file."
  (close-tables! database))


;;; Cases.

(define (known-keys database)
  "Return a table of the keys of the cases that DATABASE has an outcome of."
  (let ((table (make-hash-table)))
    (for-each (lambda (row) (hash-set! table (car row) #t))
              (%query database "select key from cases" '()))
    table))

(define (stored value)
  ;; VALUE as the database has it.
  (case value ((#t) 1) ((#f) 0) (else value)))

(define (marks n)
  (string-join (make-list n "?") ", "))

(define (insert! database table row)
  (%query database (simple-format #f "insert into ~a values (~a)" table (marks (length row))) row))

(define (measured plan measures)
  ;; The values of MEASURES, an alist, in the order of PLAN; none where there are none.
  (map (lambda (name) (let ((entry (assq name measures))) (and entry (stored (cdr entry)))))
       (plan-fact plan 'measures)))

(define (kind-of value)
  (cond ((boolean? value) 'boolean)
        ((number? value) 'number)
        (else 'text)))

(define (joined-kind a b)
  ;; The kind of values of which some are A and some B.
  (cond ((eq? a b) a)
        ((or (eq? a 'text) (eq? b 'text)) 'text)
        (else 'number)))

(define (join-kinds more kinds)
  ;; KINDS, an alist from measures, widened by MORE.
  (fold (lambda (entry kinds)
          (let ((known (assq-ref kinds (car entry))))
            (acons (car entry) (if known (joined-kind known (cdr entry)) (cdr entry))
                   (alist-delete (car entry) kinds eq?))))
        kinds more))

(define (write-kinds! database kinds)
  (%query database "insert or replace into study values ('kinds', ?)" (list (object->string kinds))))

(define (kinds-known database)
  ;; What `kinds' of DATABASE says, or #f.
  (let ((rows (%query database "select value from study where name = 'kinds'" '())))
    (and (pair? rows) (text->datum (caar rows)))))

(define (note-kinds! database more)
  ;; The kinds of DATABASE become wider by MORE; where none are told, older cases have unknown ones.
  (let* ((known (kinds-known database))
         (joined (and known (join-kinds more known))))
    (unless (or (not known) (lset= equal? known joined))
      (write-kinds! database joined))))

(define (kinds-in outcome)
  ;; Of all that was measured in OUTCOME, at the end and after the legs.
  (join-kinds (map (lambda (entry) (cons (car entry) (kind-of (cdr entry))))
                   (append (or (assq-ref outcome 'measures) '())
                           (append-map third (or (assq-ref outcome 'legs) '()))))
              '()))

(define (add-case! database plan number key values outcome)
  "Add to DATABASE the case NUMBER, from 1, with KEY and VALUES of the variables of PLAN.  OUTCOME is an alist
of status, error, message, cpu, hash, measures and legs."
  (define (of name) (assq-ref outcome name))
  (in-transaction database
    (lambda ()
      (insert! database "cases"
               `(,number ,key ,(of 'status) ,(of 'error) ,(of 'message) ,(of 'cpu) ,(of 'hash)
                         ,(plan-fact plan 'version)
                         ,@(map stored values) ,@(measured plan (or (of 'measures) '()))))
      (note-kinds! database (kinds-in outcome))
      (for-each (lambda (leg i)
                  (insert! database "legs"
                           `(,key ,i ,(first leg) ,@(second leg) ,@(measured plan (third leg)))))
                (or (of 'legs) '()) (iota (length (or (of 'legs) '())) 1)))))

(define (number-cases! database plan numbers)
  "See to it that DATABASE has no other cases than those of PLAN, where NUMBERS is a table from keys to
numbers, and number them so.  Raise a &bight-error if it has."
  (let* ((rows (%query database "select key, number from cases" '()))
         (lost (remove (lambda (row) (hash-ref numbers (first row))) rows)))
    (unless (null? lost)
      (bight-raise 'stale 'sweep "the result holds ~a ~a that the study does not ask for any more, and is \
not mixed: name another result with -o, or move that one away" (length lost)
                   (if (= 1 (length lost)) "case" "cases")))
    (in-transaction database
      (lambda ()
        (%insert database "update cases set number = ? where key = ?"
                 (filter-map (lambda (row)
                               (let ((number (hash-ref numbers (first row))))
                                 (and (not (= number (second row))) (list number (first row)))))
                             rows))
        (write-plan! database plan)))))

(define (forget-cases! database which)
  "Take cases from DATABASE, so that they are flown again: the `unfinished', which failed or were timed out,
or of these the `interrupted' alone, which were ended from outside."
  (let ((those (if (eq? which 'interrupted) "error = 'interrupted'" "status <> 'done'")))
    (in-transaction database
      (lambda ()
        (%query database
                (string-append "delete from legs where key in (select key from cases where " those ")")
                '())
        (%query database (string-append "delete from cases where " those) '())))))


;;; Reading.

(define (case-rows database plan)
  "Return the cases of DATABASE in order, each a list: number, status, error, message, then the variables and
measures of PLAN."
  (%query database
          (string-append "select number, status, error, message" (columns (outcome-columns plan))
                         " from cases order by number")
          '()))

(define (leg-rows database plan)
  "Return the legs of the cases of DATABASE that are done, in order, each a list: the number of the case, leg,
name, x, y, z, then the variables and measures of PLAN."
  (%query database
          (string-append "select number, leg, legs.name, x, y, z"
                         (columns (plan-fact plan 'variables))
                         (string-concatenate
                          (map (lambda (m) (string-append ", legs." (column m)))
                               (plan-fact plan 'measures)))
                         " from legs join cases using (key) where status = 'done' order by number, leg")
          '()))

(define (count-by-status database)
  "Return an alist of status and how many cases of DATABASE have it."
  (map (lambda (row) (cons (first row) (second row)))
       (%query database "select status, count(*) from cases group by status order by status" '())))

(define (any-interrupted? database)
  "Return #t if a case of DATABASE was ended from outside: the next sweep flies it again."
  (pair? (%query database "select 1 from cases where error = 'interrupted' limit 1" '())))

(define (result-fingerprint database plan)
  "Return 16 digits by which all outcomes in DATABASE are known, whoever flew them, where and how fast."
  (fingerprint
   (object->string
    (list (%query database
                  (string-append "select key, status, error, message, hash"
                                 (columns (outcome-columns plan)) " from cases order by key")
                  '())
          (%query database
                  (string-append "select key, leg, name, x, y, z" (columns (plan-fact plan 'measures))
                                 " from legs order by key, leg")
                  '())))))


;;; Putting shards together.

(define (check-agreement database file)
  ;; The same case flown twice has come out in the same way, or bight is not what it says.
  (let ((apart (%query database "select c.number from cases c join shard.cases s using (key)
where c.status = 'done' and s.status = 'done' and c.hash is not s.hash limit 1" '())))
    (unless (null? apart)
      (bight-raise 'diverged 'sweep "case ~a came out in another way in ~s: the machines do not agree"
                   (caar apart) file))))

(define (copy! database)
  ;; What is done takes the place of what is not.
  (for-each
   (lambda (sql) (%query database sql '()))
   '("create temp table fresh as select s.key from shard.cases s left join main.cases c using (key)
where c.key is null or (c.status <> 'done' and s.status = 'done')"
     "delete from main.legs where key in (select key from fresh)"
     "delete from main.cases where key in (select key from fresh)"
     "insert into main.cases select * from shard.cases where key in (select key from fresh)"
     "insert into main.legs select * from shard.legs where key in (select key from fresh)"))
  (let ((n (caar (%query database "select count(*) from fresh" '()))))
    (%query database "drop table fresh" '())
    n))

(define (merge-result! database file shard-file)
  "Put into DATABASE, the result FILE, the cases that SHARD-FILE has and it has not.  Return how many."
  (let* ((shard (open-found shard-file))
         (theirs (found-plan shard))
         (ours (found-plan database)))
    (close-result! shard)
    (check-same shard-file ours theirs)
    (unless (equal? (plan-fact ours 'design) (plan-fact theirs 'design))
      (bight-raise 'stale 'sweep "~s was flown for other cases of ~a than ~s (~a, not ~a)" shard-file
                   (plan-name ours) file (plan-fact theirs 'cases) (plan-fact ours 'cases)))
    (call-with-settled shard-file
      (lambda (settled)
        (%query database "attach database ? as shard" (list settled))
        (dynamic-wind
          (const #f)
          (lambda ()
            (check-agreement database shard-file)
            (in-transaction database
              (lambda ()
                (if (plan-fact theirs 'kinds)
                    (note-kinds! database (plan-fact theirs 'kinds))
                    (%query database "delete from study where name = 'kinds'" '()))
                (copy! database))))
          (lambda () (%query database "detach database shard" '())))))))
