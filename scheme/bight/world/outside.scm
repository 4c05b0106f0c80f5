;;; (bight world outside) --- a world from a file that is not trusted.
;;;
;;; The file is read by another process, (bight world child), which is enclosed first and answers with the
;;; world as data.  These are checked as any parts are, and nothing of them is evaluated here.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world outside)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core errors)
  #:use-module ((bight core files) #:select (check-files-beside))
  #:use-module ((bight core sandbox) #:select (ending-text))
  #:use-module (bight world data)
  #:use-module (ice-9 popen)
  #:use-module ((ice-9 binary-ports) #:select (get-bytevector-n))
  #:use-module ((rnrs bytevectors) #:select (bytevector? utf8->string))
  #:use-module (srfi srfi-1)
  #:export (read-world-outside))

(define (interpreter)
  ;; This program again, whose search paths its children have; or guile, in a program of another name.
  (let ((self (false-if-exception (readlink "/proc/self/exe"))))
    (if (and self (or (string=? "bight" (basename self)) (string-prefix? "guile" (basename self))))
        self
        "guile")))

(define most-bytes (* 64 1024 1024))

(define (answer-of file)
  ;; What the child says of FILE, a datum or an object for the end of a file; and the status it ends with.
  (let* ((port (open-pipe* OPEN_READ (interpreter) "-c"
                           (simple-format #f "((@ (bight world child) tell-world) ~s)" file)))
         (bytes (get-bytevector-n port most-bytes))
         (status (close-pipe port)))
    (values (text->datum (or (and (bytevector? bytes) (false-if-exception (utf8->string bytes))) ""))
            status)))

(define (silent-end proc file status)
  ;; The child ended without a word.
  (let ((signal (status:term-sig status)))
    (raise-engine-error (if signal 'limit 'io) proc
                        (string-append file ": "
                                       (if signal
                                           (ending-text signal)
                                           "the process that was to read it did not do so")
                                       "; --trust, or #:trust #t, reads it without limits"))))

(define (read-world-outside proc file)
  "Return the last world that FILE, which is not trusted, defines.  Raise a &bight-error from PROC when
there is none, when it does what only a trusted file may, and for whatever goes wrong in it."
  (call-with-values (lambda () (answer-of file))
    (lambda (answer status)
      (cond ((and (list? answer) (= 4 (length answer)) (eq? 'world (first answer)))
             (let ((world (data->world (second answer) (third answer) file (fourth answer))))
               (check-files-beside proc world)
               world))
            ((and (list? answer) (= 3 (length answer)) (memq (second answer) bight-error-kinds))
             (raise-engine-error (second answer) proc (third answer)))
            (else (silent-end proc file status))))))
