;;; (bight dive story) --- the text in which dives are saved and recorded.
;;;
;;; A story is Scheme data, one a line.  It begins with what it is and its version, and tells the world
;;; part by part as one would write it, the files that world names with their checksums, the tracks that
;;; were followed, and the state it begins with.  Lines that end in a checksum vouch for all bytes before
;;; them, so that one can tell what was written from what was altered or cut off.
;;;
;;;   (bight-recording 1)
;;;   (engine "0.1.0")
;;;   (world NAME "What it is." "worlds/pile.scm")
;;;   (part HEAD (named N) (FIELD VALUE) ...)
;;;   (file "wreck.obj" BYTES "CHECKSUM")
;;;   (track #f64(...))
;;;   (state STEP "HASH" BYTES "TEXT")          ; or (fresh "HASH")
;;;   (begin STEP "CHECKSUM")
;;;
;;; Nothing that is read is evaluated.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive story)
  #:use-module (bight assembly)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (why-not))
  #:use-module (bight core files)
  #:use-module (bight core record)
  #:use-module (bight core schema)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module (bight world)
  #:use-module (bight world data)
  #:use-module (ice-9 exceptions)
  #:use-module ((ice-9 binary-ports) #:select (get-bytevector-all put-bytevector))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (make-teller
            tell-datum! tell-text! tell-with-checksum! tell-bytes-with-checksum!
            teller-flush! teller-sync! teller-close!
            tell-beginning!
            hex unhex
            teller? story?
            read-story
            story-lines story-cut?
            begin-story
            port-teller
            check-dive
            state-line
            restore-line!
            catching-io))

(define version 1)


;;; Writing.

(define-record <teller>
  (%make-teller port sum)
  teller?
  (port teller-port)
  (sum teller-sum set-teller-sum!))     ; the checksum of all that was told

(define-syntax-rule (catching-io proc file body body* ...)
  "Evaluate the body; an error of the system becomes a &bight-error of kind io from PROC about FILE."
  (catch 'system-error
    (lambda () body body* ...)
    (lambda args
      (bight-raise 'io proc "~s: ~a" file (why-not file args)))))

(define (make-teller proc file)
  "Return a teller that writes FILE anew, or raise io from PROC."
  (catching-io proc file
    (let ((port (open file (logior O_WRONLY O_CREAT O_TRUNC))))
      (set-port-encoding! port "UTF-8")
      (setvbuf port 'block 65536)
      (%make-teller port 0))))

(define (port-teller port)
  "Return a teller that writes to PORT, which is somebody else's."
  (%make-teller port 0))

(define (hex n)
  "Return the whole number N as 16 hexadecimal digits."
  (let ((digits (number->string n 16)))
    (string-append (make-string (max 0 (- 16 (string-length digits))) #\0) digits)))

(define (unhex text)
  "Return the number that TEXT, hexadecimal digits, stands for, or #f."
  (and (string? text) (text->number text 16)))

;; `write' looks at each character of a string and takes a port: too long for what is told each second.
(define plain-characters (string->char-set "abcdefghijklmnopqrstuvwxyz0123456789-"))

(define (plain? text)
  ;; Is TEXT, of a string or a symbol, written as it is?
  (and (not (string-null? text)) (string-every plain-characters text)
       (char-set-contains? char-set:letter (string-ref text 0))))

(define (datum->text datum)
  ;; DATUM as `write' has it.
  (cond ((and (pair? datum) (list? datum))
         (string-append "(" (string-join (map datum->text datum)) ")"))
        ((number? datum) (number->string datum))
        ((string? datum)
         (if (string-every plain-characters datum)
             (string-append "\"" datum "\"")
             (object->string datum)))
        ((and (symbol? datum) (plain? (symbol->string datum))) (symbol->string datum))
        (else (object->string datum))))

(define (datum->line datum)
  (string-append (datum->text datum) "\n"))

(define (tell-datum! teller datum)
  "Write DATUM on a line of its own."
  (tell-text! teller (datum->line datum)))

(define (tell-text! teller text)
  "Write TEXT as it is."
  (put-bytes! teller (string->utf8 text)))

(define (put-bytes! teller bytes)
  (set-teller-sum! teller (%checksum bytes (teller-sum teller)))
  (put-bytevector (teller-port teller) bytes))

(define (tell-with-checksum! teller . datum)
  "Write the list DATUM, and at its end the checksum of all that was written before."
  (let ((text (datum->text datum)))
    (tell-text! teller (substring text 0 (- (string-length text) 1)))
    (tell-text! teller (closing (teller-sum teller)))))

(define (tell-bytes-with-checksum! teller text bytes)
  "The same of a line that begins with TEXT and goes on with BYTES, UTF-8, both as they are written."
  (tell-text! teller text)
  (put-bytes! teller bytes)
  (tell-text! teller (closing (teller-sum teller))))

(define (closing sum)
  ;; The end of a line that ends in the checksum SUM.
  (string-append " \"" (hex sum) "\")\n"))

(define (teller-flush! teller)
  "Hand what was written to the system."
  (force-output (teller-port teller)))

(define (teller-sync! teller)
  "See to it that what was written is on the disk."
  (teller-flush! teller)
  (fsync (teller-port teller)))

(define (teller-close! teller)
  "Write what is left and close the file."
  (teller-sync! teller)
  (close-port (teller-port teller)))


;;; The world as text.

(define (check-tellable proc world)
  ;; What cannot be written as data, or does not come back as it was, is not saved at all.
  (let ((name (part-by-procedure world)))
    (when name
      (bight-raise 'unsupported proc "~a of the world is given by a procedure, which no file can hold" name))
    (unless (comes-back? world)
      (bight-raise 'unsupported proc "this world cannot be written as data"))))

(define most-bytes (* 1024 1024 1024))  ; of a file that is read whole

(define (check-readable proc name path)
  ;; A device may have no end, and a pipe no beginning.
  (let ((status (stat path)))
    (case (stat:type status)
      ((regular)
       (when (> (stat:size status) most-bytes)
         (bight-raise 'limit proc "~s has ~a bytes; at most ~a are read" name (stat:size status)
                      most-bytes)))
      ((directory) (bight-raise 'io proc "~s is a folder" name))
      (else (bight-raise 'io proc "~s is a device, not a file" name)))))

(define (file-bytes path)
  (let ((bytes (call-with-input-file path get-bytevector-all #:binary #t)))
    (if (eof-object? bytes) (make-bytevector 0) bytes)))

(define (file-line proc world name)
  (let ((bytes (file-bytes (find-beside proc world name))))
    (list 'file name (bytevector-length bytes) (hex (%checksum bytes 0)))))

(define (absolute file)
  (if (or (not file) (absolute-file-name? file) (not (file-exists? file)))
      file
      (canonicalize-path file)))


;;; How a story begins.

(define (state-line engine)
  "Return the line that holds the state of ENGINE."
  (let ((bytes (%save-dive engine)))
    (list 'state (%dive-steps engine) (hex (%hash-dive engine))
          (bytevector-length bytes) (%bytes->text bytes))))

(define (fresh-hash proc world)
  ;; The hash of a dive that begins in WORLD.
  (%hash-dive (%make-dive (engine-parts proc world))))

(define (tell-beginning! proc teller kind dive)
  "Write how a story of KIND, a symbol, about DIVE begins.  Raise unsupported from PROC when a file cannot
hold it."
  (let* ((engine (engine-of dive)) (world (dive-world dive)) (fresh (fresh-hash proc world)))
    (tell-datum! teller (list kind version))
    (tell-datum! teller (list 'engine (%version)))
    (tell-datum! teller (list 'world (world-name world) (world-documentation world)
                        (absolute (world-file world))))
    (for-each (lambda (datum) (tell-datum! teller datum)) (world->data world))
    (for-each (lambda (name) (tell-datum! teller (file-line proc world name))) (named-files world))
    (for-each (lambda (rows) (tell-datum! teller (list 'track rows))) (%tracks engine))
    (tell-datum! teller (list 'fresh (hex fresh)))
    (unless (= fresh (%hash-dive engine))
      (tell-datum! teller (state-line engine)))
    (tell-with-checksum! teller 'begin (%dive-steps engine))))

(define (check-dive proc dive)
  "Raise unsupported from PROC when no file can hold DIVE."
  (when (%asks? (engine-of dive))
    (bight-raise 'unsupported proc "the current is a procedure's answer, which no file can hold"))
  (check-tellable proc (dive-world dive)))


;;; Reading.

(define-record <story>
  (make-story lines cut?)
  story?
  (lines story-lines)                   ; (NUMBER . DATUM) as far as a checksum vouches for them
  (cut? story-cut?))                    ; something followed that none vouches for

(define (line-bounds bytes)
  ;; (START . END) of each line that ends in a newline.
  (let ((n (bytevector-length bytes)))
    (let loop ((i 0) (start 0) (found '()))
      (cond ((= i n) (reverse! found))
            ((= 10 (bytevector-u8-ref bytes i))
             (loop (+ i 1) (+ i 1) (acons start (+ i 1) found)))
            (else (loop (+ i 1) start found))))))

(define (slice bytes bounds)
  (let* ((n (- (cdr bounds) (car bounds))) (part (make-bytevector n)))
    (bytevector-copy! bytes (car bounds) part 0 n)
    part))

(define (noop number) #f)

(define (parse bytes)
  ;; The datum of a line, or #f.
  (let ((datum (guard (e (#t #f)) (text->datum (utf8->string bytes)))))
    (and (pair? datum) (list? datum) (symbol? (car datum)) datum)))

(define (vouching? datum)
  ;; Does DATUM end in a checksum?
  (memq (car datum) '(begin second end)))

(define closing-length (string-length (closing 0)))

(define (holds? line sum)
  ;; Does LINE end in its checksum, to the letter, if SUM is that of all before LINE?
  (let* ((n (bytevector-length line)) (vouched (- n closing-length)))
    (and (> vouched 0)
         (bytevector=? (slice line (cons vouched n))
                       (string->utf8 (closing (%checksum (slice line (cons 0 vouched)) sum)))))))

(define (corrupt proc file number)
  (bight-raise 'format proc "line ~a of ~s is not as it was written" number file))

(define (first-datum proc file kind bytes)
  (define head (string-append "(" (symbol->string kind) " "))
  (let* ((n (bytevector-length bytes))
         (start (make-bytevector (min n (string-length head)))))
    (bytevector-copy! bytes 0 start 0 (bytevector-length start))
    (unless (bytevector=? start (string->utf8 head))
      (bight-raise 'format proc "~s is no file of this kind: it does not begin with `~a'" file head))
    (let* ((bounds (line-bounds bytes))
           (datum (and (pair? bounds) (parse (slice bytes (car bounds))))))
      (unless (and datum (= 2 (length datum)) (exact-integer? (second datum)))
        (corrupt proc file 1))
      (unless (= version (second datum))
        (bight-raise 'version proc "~s is of version ~a; this bight reads version ~a" file
                     (second datum) version)))))

(define (checked-lines bytes wrong)
  ;; Two values: (NUMBER . DATUM) up to the last checksum, and #t if more follows.  A checksum that does
  ;; not hold means that something before it was altered: call WRONG with the line's number.
  (let loop ((bounds (line-bounds bytes)) (number 1) (sum 0) (open '()) (vouched '()))
    (if (null? bounds)
        (values (reverse vouched)
                (or (pair? open)
                    (not (= (bytevector-length bytes)
                            (fold (lambda (b end) (cdr b)) 0 (line-bounds bytes))))))
        (let* ((line (slice bytes (car bounds)))
               (datum (parse line))
               (next (%checksum line sum)))
          (cond ((not datum)
                 (if (null? (cdr bounds))
                     (values (reverse vouched) #t)
                     (begin
                       (wrong number)
                       (values (reverse vouched) #t))))
                ((and (vouching? datum) (not (holds? line sum)))
                 (wrong number)
                 (values (reverse vouched) #t))
                ((vouching? datum)
                 (loop (cdr bounds) (+ number 1) next '()
                       (cons (cons number datum) (append open vouched))))
                (else
                 (loop (cdr bounds) (+ number 1) next (acons number datum open) vouched)))))))

(define* (read-story proc file kind #:key salvage?)
  "Return the story of KIND in FILE, as far as it vouches for itself.  Raise a &bight-error from PROC: io
when it cannot be read, format when it is something else, cut off before it begins, or, unless SALVAGE?,
altered, version when it is of another version."
  (let ((bytes (catching-io proc file
                 (begin
                   (check-readable proc file file)
                   (file-bytes file)))))
    (first-datum proc file kind bytes)
    (call-with-values
        (lambda ()
          (checked-lines bytes (if salvage? noop (lambda (number) (corrupt proc file number)))))
      (lambda (lines cut?)
        (unless (find (lambda (line) (eq? 'begin (cadr line))) lines)
          (bight-raise 'format proc "~s is cut off before it begins" file))
        (make-story lines cut?)))))

(define (lines-of story head)
  (filter (lambda (datum) (eq? head (car datum))) (map cdr (beginning story))))

(define (beginning story)
  (take-while (lambda (line) (not (eq? 'begin (cadr line)))) (story-lines story)))

(define (check-file proc world name size sum)
  ;; It is read only if it has the size it had.
  (let ((path (find-beside proc world name)))
    (catching-io proc name (check-readable proc name path))
    (unless (and (eqv? size (stat:size (stat path)))
                 (equal? sum (hex (%checksum (file-bytes path) 0))))
      (bight-raise 'version proc "~s is not the file it was then" name))))

(define (check-told proc story world)
  ;; A file of which the story tells no checksum would be believed whatever it is, or never end.
  (let ((told (map cadr (lines-of story 'file))))
    (for-each (lambda (name)
                (unless (member name told)
                  (bight-raise 'format proc "it names the file ~s, and tells no checksum of it" name)))
              (named-files world))))

(define (the-line story head)
  ;; What follows HEAD in the only line of STORY's beginning that it leads.
  (cdr (first (lines-of story head))))

(define (check-head proc told)
  ;; The name of a world, what it is, and its file, each of which there may be none of.
  (unless (and (= 3 (length told)) (every (lambda (is? value) (or (not value) (is? value)))
                                          (list symbol? string? string?) told))
    (bight-raise 'format proc "a world is told by its name, what it is and its file, not by ~s" told)))

(define (told-world proc story)
  (let ((told (the-line story 'world)))
    (check-head proc told)
    (let ((world (data->world (first told) (second told) (third told) (lines-of story 'part))))
      (check-told proc story world)
      (for-each (lambda (line) (apply check-file proc world (cdr line))) (lines-of story 'file))
      world)))

(define (check-fresh proc story engine)
  ;; The same world must begin as it began then.
  (unless (eqv? (unhex (first (the-line story 'fresh))) (%hash-dive engine))
    (bight-raise 'version proc
                 "it was written by bight ~a on a system where this world begins otherwise than here, by bight ~a"
                 (first (the-line story 'engine)) (%version))))

(define (restore-line! proc engine line)
  "Restore ENGINE to the state in LINE, from `state-line', or raise a &bight-error from PROC."
  (let* ((size (fourth line))
         (bytes (and (eqv? size (bytevector-length (%save-dive engine)))
                     (%text->bytes (fifth line) size))))
    (unless bytes
      (bight-raise 'version proc "its states are not those of bight ~a" (%version)))
    (guard (e ((bight-error? e)
               (bight-raise 'format proc "it holds no state that a dive can be in: ~a"
                            (bight-error-message e))))
      (%restore-dive! engine bytes))))

(define (begin-story proc file story)
  "Return the dive that STORY, of FILE, begins with."
  (guard (e ((and (exception? e) (not (bight-error? e)))
             (bight-raise 'format proc "~s does not say how it begins" file)))
    (let* ((world (told-world proc story))
           (engine (%make-dive (engine-parts proc world))))
      (check-fresh proc story engine)
      (for-each (lambda (line) (%add-track! engine (cadr line))) (lines-of story 'track))
      (for-each (lambda (line) (restore-line! proc engine line)) (lines-of story 'state))
      (begin-dive engine world))))
