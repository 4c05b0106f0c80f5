;;; What the tests of imported text files share: a file of its own for a text, a text with a place changed, whether
;;; an import is refused, and texts damaged at random.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (rnrs exceptions))


(define (written text)
  ;; A file of its own: scenarios are tried side by side.
  (let* ((port (mkstemp (string-append (scratch-file "text-") "XXXXXX"))) (file (port-filename port)))
    (set-port-encoding! port "UTF-8")
    (display text port)
    (close-port port)
    file))

(define (changed text from to)
  (let ((k (string-contains text from)))
    (string-append (substring text 0 k) to (substring text (+ k (string-length from))))))

(define (says-one-line? error)
  (not (string-index (bight-error-message error) #\newline)))

(define (import-refused? import kind text)
  (guard (e ((bight-error? e) (and (eq? kind (bight-error-kind e)) (says-one-line? e))))
    (import (written text))
    #f))

(define (import-survives? import text letters dice)
  ;; #t if TEXT with up to four letters replaced by some of LETTERS, one time in three with its end lost, is
  ;; imported or refused with one line; DICE is a random state.
  (let ((damaged (string-copy text)) (n (string-length text)))
    (do ((k (random 4 dice) (- k 1))) ((< k 0))
      (string-set! damaged (random n dice) (string-ref letters (random (string-length letters) dice))))
    (guard (e ((bight-error? e) (says-one-line? e)))
      (import (written (substring damaged 0 (- n (if (zero? (random 3 dice)) (random n dice) 0)))))
      #t)))
