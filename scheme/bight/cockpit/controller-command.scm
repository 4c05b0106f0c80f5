;;; (bight cockpit controller-command) --- `bight controller': which controllers there are, what they do, and a record of it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit controller-command)
  #:use-module (bight cockpit controller)
  #:use-module (bight cockpit mapping)
  #:use-module (bight cockpit state)
  #:use-module (bight core decimal)
  #:use-module (bight core errors)
  #:use-module ((bight core programs) #:select (check-writable))
  #:use-module (srfi srfi-1)
  #:export (controller-command binding-line event-line))

(define (key->word key)
  (if (eqv? key #\space) "space" (simple-format #f "~a" key)))

(define (binding-line b)
  "Return in words what the binding B does."
  (if (binding-key b)
      (simple-format #f "  ~a: key ~a" (binding-control b) (key->word (binding-key b)))
      (simple-format #f "  ~a: ~a ~a, dead zone ~a" (binding-control b) (list-ref stick-names (binding-stick b))
                     (fixed-with-sign (binding-scale b) 2) (fixed (binding-dead b) 2))))

(define (event-line event all)
  "Return EVENT in words, and where ALL, the controllers, want the sticks after it."
  (simple-format #f "~a ~a ~a   ~a" (second event) (third event)
                 (if (real? (fourth event)) (fixed-with-sign (fourth event) 2) (if (fourth event) "down" "up"))
                 (string-join (map (lambda (name x) (simple-format #f "~a ~a" name (fixed-with-sign x 2)))
                                   stick-names (controller-sticks all)))))

(define (print . parts)
  (for-each display parts)
  (newline)
  (force-output))

(define (print-event event all)
  (case (first event)
    ((plugged)
     (print (second event) " " (third event) (if (fourth event) "" ", unknown to SDL: axes and buttons by number"))
     (for-each (lambda (b) (print (binding-line b))) (bindings-for (controllers-mapping all) (third event) (fourth event))))
    ((lost) (print (second event) " is lost"))
    (else (print (event-line event all)))))

(define (note! event all port seconds)
  (note-event! all event)
  (print-event event all)
  (when port
    (write (cons seconds event) port)
    (newline port)
    (force-output port)))

(define (follow all port limit)
  (let ((begun (clock)))
    (let loop ()
      (let ((seconds (/ (round (* 1000 (- (clock) begun))) 1000)))
        (for-each (lambda (event) (note! event all port seconds)) (poll-events! all (clock)))
        (when (< seconds limit)
          (usleep 10000)
          (loop))))))

(define (limit-of text)
  (let ((s (and text (text->number text))))
    (cond ((not text) +inf.0)
          ((and s (real? s) (>= s 0)) s)
          (else (bight-raise 'domain 'controller "--for is seconds, 0 or more, not ~s" text)))))

(define (open-record file)
  (check-writable 'controller file)
  (open-output-file file))

(define (controller-command options)
  "Show what the controllers do, with OPTIONS of the command line, an alist: of what is plugged in, or of a stream."
  (let* ((record (assoc-ref options "--record"))
         (limit (limit-of (assoc-ref options "--for")))
         (all (open-controllers (or (assoc-ref options "--stream") "any") (assoc-ref options "--mapping")))
         (port (and record (open-record record))))
    (when port
      (print "what is done goes to " record " until C-c")
      (display "(bight-events 1)\n" port)
      (force-output port))
    (unless (assoc-ref options "--stream")
      (print "What is moved on a controller is shown, also on one that is plugged in later; C-c ends."))
    (follow all port limit)))
