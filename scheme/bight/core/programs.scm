;;; (bight core programs) --- other programs that draw or film for us, and the files they make.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core programs)
  #:use-module ((bight core errors) #:select (bight-raise))
  #:use-module (bight core record)
  #:use-module ((ice-9 binary-ports) #:select (get-bytevector-all put-bytevector))
  #:use-module (ice-9 popen)
  #:use-module ((ice-9 rdelim) #:select (read-line))
  #:use-module (rnrs bytevectors)
  #:use-module ((srfi srfi-1) #:select (any))
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (program?
            temporary-file
            open-program-input
            program-output
            last-line
            check-writable
            rename-or-raise
            write-bytes
            written-note
            note?))

(define (program? name)
  "Return #t if there is a program NAME in the search path."
  (any (lambda (folder) (access? (string-append folder "/" name) X_OK))
       (string-split (or (getenv "PATH") "") #\:)))

(define (temporary-file)
  "Return the name of a new, empty file."
  (let* ((port (mkstemp (string-append (or (getenv "TMPDIR") "/tmp") "/bight-XXXXXX")))
         (name (port-filename port)))
    (close-port port)
    name))

;; A program's words of complaint go to a file, whose last line is what one is told.
(define with-log "log=$1; shift; exec \"$@\" 2>\"$log\"")

(define (open-program-input log program . arguments)
  "Start PROGRAM with ARGUMENTS and return a pipe to its standard input; what it complains about goes to the
file LOG.  Its standard output is ours no more."
  (apply open-pipe* OPEN_WRITE "sh" "-c" (string-append with-log " >/dev/null") "sh" log program
         arguments))

(define (program-output log program . arguments)
  "Run PROGRAM with ARGUMENTS and return the bytes of its standard output, or #f if it failed; what it
complains about goes to the file LOG."
  (let* ((port (apply open-pipe* OPEN_READ "sh" "-c" with-log "sh" log program arguments))
         (bytes (get-bytevector-all port))
         (status (close-pipe port)))
    (and (eqv? 0 (status:exit-val status))
         (if (eof-object? bytes) (make-bytevector 0) bytes))))

(define (last-line file)
  "Return the last line of FILE that is not blank, or #f."
  (false-if-exception
   (call-with-input-file file
     (lambda (port)
       (let loop ((last #f))
         (let ((line (read-line port)))
           (cond ((eof-object? line) last)
                 ((string-null? (string-trim-both line)) (loop last))
                 (else (loop (string-trim-both line))))))))))

(define (failed proc file errno)
  (bight-raise 'io proc "cannot write ~s: ~a" file (strerror errno)))

(define-syntax-rule (telling proc file body ...)
  ;; What the system refuses in BODY is one clear line.
  (catch 'system-error
    (lambda () body ...)
    (lambda arguments (failed proc file (system-error-errno arguments)))))

(define (check-writable proc file)
  "Raise a &bight-error from PROC unless FILE can be written where it is to be."
  (let ((folder (dirname file)))
    (cond ((and (file-exists? file) (file-is-directory? file))
           (bight-raise 'io proc "cannot write ~s: it is a folder" file))
          ((not (file-exists? folder))
           (bight-raise 'io proc "cannot write ~s: there is no folder ~s" file folder))
          ((not (access? (if (file-exists? file) file folder) W_OK))
           (bight-raise 'io proc "cannot write ~s: it is not allowed" file)))))

(define (rename-or-raise proc part file)
  "Give the file PART the name FILE, or raise a &bight-error from PROC."
  (telling proc file (rename-file part file)))

(define (device? file)
  (and (file-exists? file) (not (memq (stat:type (stat file)) '(regular directory)))))

(define (put-all bytes file)
  ;; Write and close by the system's own calls: a port that cannot be flushed complains twice.
  (let ((port (open file (logior O_WRONLY O_CREAT O_TRUNC) #o666)))
    (setvbuf port 'none)
    (dynamic-wind
      (const #f)
      (lambda () (put-bytevector port bytes))
      (lambda () (close-port port)))))

(define (write-bytes proc bytes file)
  "Write BYTES to FILE, whole or not at all, or raise a &bight-error from PROC."
  (let ((part (string-append file "." (number->string (getpid)) ".part")))
    (if (device? file)
        (telling proc file (put-all bytes file))
        (dynamic-wind
          (const #f)
          (lambda () (telling proc file (put-all bytes part) (rename-file part file)))
          (lambda () (false-if-exception (delete-file part)))))))


;;; What a verb that writes returns.

(define-record <note>
  (make-note text)
  note?
  (text note-text))

(set-record-type-printer! <note> (lambda (note port) (display (note-text note) port)))

(define (written-note . words)
  "Return a value that prints as WORDS, strings."
  (make-note (string-concatenate words)))
