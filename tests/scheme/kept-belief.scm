;;; A belief in a file: it goes on as it would have, and a file that was forged is believed in nothing.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight engine) #:select (%checksum)) (ice-9 exceptions) (ice-9 textual-ports) (rnrs bytevectors)
             ((srfi srfi-1) #:renamer (lambda (name) (if (eq? name 'every) 'every1 name))) (srfi srfi-4))

(define slack-water
  (find-world (string-append (dirname (dirname (dirname (current-filename)))) "/testbed/worlds/beside-a-post.scm")
              #:trust #t))

(define (begin-belief! by)
  ;; A belief that was told, doubted and touched something, in a dive that was ordered and altered.
  (run 0.5)
  (let ((b (believe! (current (error 0.1) (levels 0 -20)) (line (cdn (uniform 1 1.6))) (payout (normal 0 0.1))
                     #:members 8 #:by by)))
    (drive! #:surge 0.2) (run 0.1)
    (move! '(5 9 -8) #:speed 0.5) (run 1)
    (observe! b 'winch-tension 0.5 #:noise 0.5)
    (observe! b 'transponder (point-at 8) #:on 8)
    (observe! b 'winch-tension 1e6)
    (alter! 'line #:cdn 1.5) (pay-out! 1 #:rate 1) (run 1)
    (observe! b 'touched '(not post) #:noise 0.4)
    b))

(define (go-on! b)
  ;; All that a belief does from then on: it is flown, told, mended, and flown again from its origin.
  (move! '(4 11 -8) #:speed 0.5) (run 1)
  (observe! b 'rov-tension 0.4 #:noise 0.3)
  (mend-belief! b)
  (run 0.5)
  (list (belief-hash b) (belief-about b) (belief-doubts b) (state-hash)))

(define-scenario (goes-on-to-the-last-bit by)
  "A belief that was saved and loaded, with its dive, is the one that was saved, and goes on as that one does; twice saved it
is the same file."
  #:for ((by 'smoother 'particles))
  (in slack-water)
  (let* ((b (begin-belief! by)) (hash (belief-hash b)) (file (save-belief! (scratch-file "a.belief") b))
         (first-time (go-on! b)) (loaded (load-belief file)))
    (expect (eq? loaded (current-belief)) => #t)
    (expect (belief-hash loaded) => hash)
    (save-belief! (scratch-file "b.belief"))
    (expect (call-with-input-file file get-string-all)
            => (call-with-input-file (scratch-file "b.belief") get-string-all))
    (expect (go-on! loaded) => first-time)
    (current-belief #f)))

(define-scenario a-loaded-dive-goes-back
  "The dive of a loaded belief goes back to where it was loaded, and its belief with it; not to before."
  (in slack-water)
  (let* ((b (begin-belief! 'smoother)) (loaded (load-belief (save-belief! (scratch-file "a.belief") b)))
         (hash (belief-hash loaded)) (start (checkpoint)))
    (move! '(4 11 -8) #:speed 0.5) (run 1)
    (ask-belief loaded slack)
    (rewind! 0.5)
    (restore! start)
    (expect (belief-hash loaded) => hash)
    (current-belief #f)))


;;; Forged files: lines changed, with all checksums made anew.

(define (datums-of file)
  (call-with-input-file file
    (lambda (port)
      (let loop ((all '()))
        (let ((line (get-line port)))
          (if (eof-object? line) (reverse all) (loop (cons (call-with-input-string line read) all))))))))

(define (write-forged! file datums)
  (define sum 0)
  (define (put! text port) (set! sum (%checksum (string->utf8 text) sum)) (put-string port text))
  (call-with-output-file file
    (lambda (port)
      (for-each (lambda (datum)
                  (if (memq (car datum) '(begin end))
                      (let ((text (object->string (drop-right datum 1))))
                        (put! (string-drop-right text 1) port)
                        (put! (string-append " \"" (string-pad (number->string sum 16) 16 #\0) "\")\n") port))
                      (put! (string-append (object->string datum) "\n") port)))
                datums)))
  file)

(define (kind-of thunk)
  (guard (e ((bight-error? e) (bight-error-kind e))) (thunk) #f))

(define (spoilt datum k value)
  ;; DATUM with VALUE for its element K.
  (append (take datum k) (list value) (drop datum (+ k 1))))

(define nonsense (list -1 1e300 'nowhere '(1 2) #f64(+nan.0) #f64()))

(define-scenario forged-files
  "Every field of every line that a belief adds is judged: whatever else stands there, the file is refused, or what it
says can be; dive and belief stay as they are."
  (in slack-water)
  (let* ((b (begin-belief! 'smoother)) (hash (belief-hash b)) (dive (current-dive)) (heads '())
         (datums (datums-of (save-belief! (scratch-file "a.belief") b))) (file (scratch-file "forged")))
    (expect (kind-of (lambda () (load-belief (write-forged! file datums)))) => #f)
    (for-each
     (lambda (line)
       (when (and (memq (car line) '(belief clauses entry reading doubt origin member)) (not (memq (car line) heads)))
         (set! heads (cons (car line) heads))
         (for-each
          (lambda (k)
            (for-each
             (lambda (value)
               (current-dive dive) (current-belief b)
               (let ((kind (kind-of (lambda ()
                                      (load-belief
                                       (write-forged! file (map (lambda (d) (if (eq? d line) (spoilt line k value) d))
                                                                datums)))))))
                 (if kind
                     (expect (and (eq? dive (current-dive)) (eq? b (current-belief))) => #t)
                     (begin
                       (expect (number? (belief-hash)) => #t)
                       (when (eq? 'entry (car line)) ; flown again with it: refused, or done
                         (kind-of mend-belief!))))))
             nonsense))
          (iota (- (length line) 1) 1))))
     datums)
    (current-dive dive) (current-belief b)
    (expect (length heads) => 7)
    (expect (kind-of (lambda () (load-belief (write-forged! file (delete (find (lambda (d) (eq? 'member (car d))) datums) datums))))) => 'format)
    (expect (kind-of (lambda () (load-belief (scratch-file "none")))) => 'io)
    (expect (kind-of (lambda () (load-dive (save-belief! (scratch-file "a.belief") b)))) => 'format)
    (expect (belief-hash b) => hash)
    (current-belief #f)))
