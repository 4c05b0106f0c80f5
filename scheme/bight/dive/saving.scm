;;; (bight dive saving) --- a dive in a file.
;;;
;;; The file holds the world as text and the state as bytes, see (bight dive story).  It is written beside and
;;; then put in place, so that there is always a whole one.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive saving)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive story)
  #:use-module (bight engine)
  #:use-module (srfi srfi-1)
  #:export (save! load-dive))

(define (write-dive! teller dive)
  (tell-beginning! 'save! teller 'bight-dive dive)
  (tell-with-checksum! teller 'end (%dive-steps (engine-of dive)) (hex (%hash-dive (engine-of dive))))
  (teller-close! teller))

(define-verb (save! (file string))
  "Save the dive in FILE: its world, its state; not what runs between its steps.  Raise unsupported when a
part of it is a procedure, io when the file cannot be written.  Return FILE."
  (let ((dive (this-dive 'save!)) (new (string-append file ".new")))
    (check-dive 'save! dive)
    (let ((teller (make-teller 'save! new)))
      (catching-io 'save! file
        (write-dive! teller dive)
        (rename-file new file)))
    file))

(define (check-whole file story)
  (let ((end (cdr (last (story-lines story)))))
    (unless (and (eq? 'end (car end)) (not (story-cut? story)))
      (bight-raise 'format 'load-dive "~s is cut off" file))
    end))

(define-verb (load-dive (file string))
  "Start the dive that was saved in FILE, go on where it was, and return it; it becomes the current one.
Raise io when the file cannot be read, format when it is no saved dive or was altered or cut off, version
when another version of bight wrote it or a file that its world names has changed."
  (check-not-running 'load-dive (current-dive))
  (let ((story (read-story 'load-dive file 'bight-dive)))
    (let ((end (check-whole file story))
          (dive (begin-story 'load-dive file story)))
      (unless (eqv? (unhex (third end)) (%hash-dive (engine-of dive)))
        (bight-raise 'format 'load-dive "~s does not hold the state it speaks of" file))
      (current-dive dive)
      dive)))
