;;; (bight world child) --- the process in which a world from a file that is not trusted is read.
;;;
;;; It is enclosed before it reads, and answers on its standard output with one datum:
;;; (world NAME DOCUMENTATION DATA), or (refused KIND TEXT).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world child)
  #:use-module (bight core errors)
  #:use-module (bight core part)
  #:use-module (bight core sandbox)
  #:use-module ((bight outlet) #:select (behind))
  #:use-module ((bight world atlas) #:select (last-remembered))
  #:use-module (bight world data)
  #:use-module (srfi srfi-1)
  #:export (tell-world))

(define (refuse file what)
  (raise-engine-error 'unsupported #f
                      (string-append file ": " what " does not leave its enclosure"
                                     "; --trust, or #:trust #t, reads it without")))

(define (portable world file)
  ;; The datum that stands for WORLD, if there is one.
  (unless world
    (bight-raise 'format #f "~a defines no world" file))
  (let ((name (part-by-procedure world)))
    (when name
      (refuse file (simple-format #f "`~a' is given by a procedure, which" name)))
    (unless (comes-back? world)
      (refuse file "this world"))
    (list 'world (world-name-of world) (world-documentation-of world) (world->data world))))

(define (read-enclosed port file)
  (let ((module (sandbox-module)))
    (enclose! #:reading (readable-paths file))
    (last-remembered (lambda () (evaluate-inside port file module noop))))) ; one breath for all of it

(define (answer file)
  ;; The datum to answer with.
  (with-exception-handler
      (lambda (e)
        (if (bight-error? e)
            (list 'refused (bight-error-kind e) (bight-error-message e))
            (list 'refused 'io ((module-ref (resolve-interface '(bight core told)) 'exception->line) e))))
    (lambda ()
      (call-with-input-file file
        (lambda (port)
          (set-port-encoding! port "UTF-8")
          (set-port-filename! port file)
          (portable (read-enclosed port file) file))))
    #:unwind? #t))

(define (tell-world file)
  "Read FILE, answer on the standard output, and end this process."
  (let ((nothing (open "/dev/null" O_RDWR)))
    (dup2 (fileno nothing) 0)
    (dup2 (fileno nothing) 2))
  ;; The parent reads data: nothing of them is to be escaped.
  (let ((out (behind (current-output-port))))
    (set-port-encoding! out "UTF-8")
    (write (answer file) out)
    (force-output out))
  (primitive-_exit 0))
