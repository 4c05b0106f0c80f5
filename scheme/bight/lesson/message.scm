;;; (bight lesson message) --- messages between pilot and tender.
;;;
;;; They are kept in the tally, so that a step back unsays them.  What is for the pilot is said to the
;;; pupil; what is for anybody else may be limited in number, by the clause (message-limit N).
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson message)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core verb)
  #:use-module ((bight lesson guide) #:select (say-as))
  #:use-module (bight lesson tally)
  #:use-module (srfi srfi-1)
  #:export (tell! told messages messages-left number-in))

(define (for-pilot? whom) (eq? 'pilot whom))

(define (limit)
  ;; How many messages may be sent to others than the pilot, or #f.
  (assq-ref (session-limits (this-session 'tell!)) 'messages))

(define (sent)
  (count (lambda (m) (not (for-pilot? (car m)))) (tally-ref 'messages '())))

(define-verb (messages-left)
  "Return how many messages the pilot may still send in this lesson: +inf.0 when there is no limit."
  (if (limit) (max 0 (- (limit) (sent))) +inf.0))

(define (line-to whom text)
  (string-append "to the " (symbol->string whom) ": " text))

(define (deliver! whom text)
  (if (for-pilot? whom)
      (say-as 'message text)
      (log-line! 'message (line-to whom text)))
  (tally-set! 'messages (append (tally-ref 'messages '()) (list (cons whom text))))
  (length (tally-ref 'messages)))

(define-verb (tell! (whom name) (text string))
  "Send WHOM, such as the tender, the message TEXT; the tender answers the pilot so.  Return how many
messages were sent so far, or #f when the lesson allows no more: then it was not sent."
  (if (or (for-pilot? whom) (positive? (messages-left)))
      (deliver! whom text)
      (begin
        (say-as 'fault "Nobody hears you: your messages are used up.")
        #f)))

(define-verb (told (whom name))
  "Return the oldest message to WHOM that was not read yet, a string, or #f; then it is read."
  (let* ((read (tally-ref 'read '()))
         (n (or (assq-ref read whom) 0))
         (mine (filter (lambda (m) (eq? whom (car m))) (tally-ref 'messages '()))))
    (and (< n (length mine))
         (begin
           (tally-set! 'read (acons whom (+ n 1) (alist-delete whom read eq?)))
           (cdr (list-ref mine n))))))

(define-verb (messages)
  "Return the messages sent in this lesson so far, in order: pairs of whom and text."
  (tally-ref 'messages '()))


;;; What a tender understands.

(define most-digits 12)

(define (word->number word)
  ;; Plain ones only: 1e300000 would be a number too.
  (and (<= (string-length word) most-digits)
       (string-every (string->char-set "+-.0123456789") word)
       (let ((n (text->number word)))
         (and (real? n) n))))

(define-verb (number-in (text string))
  "Return the first word of the message TEXT that is a number, as that number, or #f: 5 for \"give 5\"."
  (any word->number (string-tokenize text)))
