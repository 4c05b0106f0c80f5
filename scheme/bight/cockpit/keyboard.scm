;;; (bight cockpit keyboard) --- the keys of the terminal that was taken, and what is pasted there.
;;;
;;; What is pasted is a text, not keys: a line that is typed takes it, whatever stands in it, and nothing else does.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit keyboard)
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit sequences)
  #:use-module (srfi srfi-1)
  #:export (keys-within gather-pasted))

(define pasting? #f)                    ; the end of what is pasted is still to come

(define (text-of keys)
  ;; The characters among KEYS on one line.
  (list->string (map (lambda (c) (if (char<=? #\space c #\~) c #\space)) (filter char? keys))))

(define (ends-paste? key)
  ;; ^C does too, so that nobody is locked out by an end that never comes.
  (memv key '(pasted #\etx)))

(define (gather-pasted keys within?)
  "Return two values: KEYS, as `bytes->keys' returns them, with (pasted TEXT) for what was pasted among them; and whether
more of that is to come.  WITHIN? says whether they begin with what was pasted."
  (let loop ((keys keys) (within? within?) (all '()))
    (call-with-values (lambda () (break (if within? ends-paste? (lambda (key) (eq? 'paste key))) keys))
      (lambda (some rest)
        (let ((all (append all (if (and within? (pair? some)) (list (list 'pasted (text-of some))) some))))
          (if (null? rest)
              (values all within?)
              (loop (cdr rest) (not within?) all)))))))

(define (keys-within seconds)
  "Return the keys that are pressed within SECONDS, as `gather-pasted' does; #f if the terminal is gone."
  (let ((bytes (%terminal-keys (max 0 seconds))))
    (and bytes
         (call-with-values (lambda () (gather-pasted (bytes->keys bytes) pasting?))
           (lambda (keys more?)
             (set! pasting? more?)
             keys)))))
