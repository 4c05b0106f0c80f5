;;; (bight lesson journal) --- the journal of a lesson that is not finished, kept by the parent.
;;;
;;; It lies among the state of the user, and fits only the same file with the same seed and level.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson journal)
  #:use-module ((bight core datum) #:select (plain-text?))
  #:use-module ((bight core folders) #:select (ensure-folder! state-folder))
  #:use-module (bight lesson order)
  #:use-module ((ice-9 textual-ports) #:select (get-string-all))
  #:export (write-datum! the-end journal-file journal-inputs open-journal drop-journal!))

(define (write-datum! datum port)
  "Write DATUM as a line to PORT, so that it is there whatever comes."
  (write datum port)
  (newline port)
  (force-output port))

;; What reading past the last datum returns.
(define the-end (call-with-input-string "" read))

(define (journals-folder)
  ;; Made if need be; #f if there is no such place.
  (let ((folder (state-folder)))
    (and folder
         (false-if-exception
          (let ((folder (string-append folder "/lessons")))
            (ensure-folder! folder #o700)
            folder)))))

(define (safe-word text)
  (string-map (lambda (c) (if (or (char-alphabetic? c) (char-numeric? c) (memv c '(#\- #\_))) c #\_))
              text))

(define (journal-file order)
  "Return the file of the journal of ORDER, or #f when there is no place for it."
  (let ((folder (journals-folder)))
    (and folder
         (string-append folder "/" (safe-word (who-of (order-given order))) "-"
                        (safe-word (basename (order-file order) ".scm")) ".journal"))))

(define (header order)
  ;; What must be the same for a journal to fit.
  (list 'lesson (order-file order) (stat:mtime (stat (order-file order)))
        (stat:size (stat (order-file order)))
        (seed-of (order-given order)) (level-of (order-given order))))

(define (datums-of text)
  ;; As far as they are whole: the last may be cut off.
  (call-with-input-string text
    (lambda (port)
      (let loop ((all '()))
        (let ((datum (catch #t (lambda () (read port)) (const the-end))))
          (if (eof-object? datum)
              (reverse all)
              (loop (cons datum all))))))))

(define (read-all file)
  (let ((text (call-with-input-file file get-string-all #:encoding "UTF-8")))
    (if (plain-text? text) (datums-of text) '())))

(define (journal-inputs order)
  "Return the inputs of the journal that fits ORDER, or none."
  (let ((file (journal-file order)))
    (if (and file (file-exists? file) (not (option (order-given order) "--fresh" #f)))
        (let ((all (read-all file)))
          (if (and (pair? all) (equal? (car all) (header order)))
              (cdr all)
              '()))
        '())))

(define (open-journal order inputs)
  "Return a port that goes on with the journal of ORDER after INPUTS, or begins one; #f if there is no
place."
  (let ((file (journal-file order)))
    (and file
         (false-if-exception
          (let ((port (open-file file (if (null? inputs) "w" "a"))))
            (when (null? inputs) (write-datum! (header order) port))
            port)))))

(define (drop-journal! order)
  "Delete the journal of ORDER: the lesson is finished."
  (let ((file (journal-file order)))
    (when (and file (file-exists? file))
      (delete-file file))))
