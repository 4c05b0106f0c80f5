;;; (bight dive replay) --- doing again what was recorded, and the first step that comes out otherwise.
;;;
;;; A recording is read as (bight dive recording) wrote it; the quantities of a second tell what differs.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight dive replay)
  #:use-module ((bight core datum) #:select (text->datum))
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive entry)
  #:use-module (bight dive story)
  #:use-module (bight engine)
  #:use-module (ice-9 exceptions)
  #:use-module ((rnrs bytevectors) #:select (utf8->string))
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (replay replay-file
            after-beginning                ; for (bight dive reel)
            difference? difference-step difference-time difference-quantities))

(define-record <difference>
  (make-difference step time quantities)
  is-difference?
  (step the-step)
  (time the-time)
  (quantities the-quantities))

(set-record-type-printer!
 <difference>
 (lambda (d port)
   (simple-format port "#<difference from step ~a (~a s) on: ~a>" (the-step d) (the-time d)
                  (string-join (the-quantities d) "; "))))

(define-argument-type (difference value)
  "a difference, as `replay' returns"
  (if (is-difference? value) value refused))

(define-verb (difference? (object any))
  "Return #t if OBJECT is a difference that `replay' found."
  (is-difference? object))

(define-verb (difference-step (d difference))
  "Return the first step whose state differs from the recorded one."
  (the-step d))

(define-verb (difference-time (d difference))
  "Return the time of that step, s."
  (the-time d))

(define-verb (difference-quantities (d difference))
  "Return what differs, a list of strings, as it was recorded at the end of that second."
  (the-quantities d))

(define (differing-nodes name recorded found)
  (let ((count (quotient (string-length recorded) 4)))
    (if (not (= (string-length recorded) (string-length found)))
        (list (simple-format #f "~a has ~a nodes, not ~a" name (quotient (string-length found) 4) count))
        (let ((odd (filter (lambda (i)
                             (not (string=? (substring recorded (* 4 i) (* 4 (+ i 1)))
                                            (substring found (* 4 i) (* 4 (+ i 1))))))
                           (iota count))))
          (if (null? odd)
              '()
              (list (simple-format #f "~a of ~a nodes of ~a, node ~a the first" (length odd) count name
                                   (car odd))))))))

(define quantity-names
  '((rov "x" "y" "z" "heading")
    (tether "length" "tension at the anchor" "tension at the end" "")))

(define (differing recorded found)
  ;; What differs between two quantities of one part.
  (let ((name (cadr recorded)))
    (append-map (lambda (what a b)
                  (cond ((equal? a b) '())
                        ((and (string? a) (string? b)) (differing-nodes name a b))
                        (else (list (simple-format #f "~a of ~a: ~a, not ~a" what name b a)))))
                (assq-ref quantity-names (car recorded)) (cddr recorded) (cddr found))))

(define (found-quantities engine)
  (text->datum (string-append "(" (utf8->string (quantities engine (quantity-heads engine))) ")")))

(define (differences recorded found)
  (let ((odd (if (= (length recorded) (length found))
                 (append-map differing recorded found)
                 '())))
    (if (null? odd) '("something that is not recorded by itself") odd)))

(define (first-odd-step steps hashes otherwise)
  ;; STEPS, the line (steps FIRST HASHES) or #f; HASHES, (STEP . HASH) as found.
  (define (recorded step)
    (let ((i (and steps (- step (second steps)))))
      (and i (<= 0 i) (<= (* 8 (+ i 1)) (string-length (third steps)))
           (substring (third steps) (* 8 i) (* 8 (+ i 1))))))
  (let ((odd (find (lambda (entry)
                     (let ((text (recorded (car entry))))
                       (and text (not (string=? text (digits (cdr entry) 8))))))
                   (reverse hashes))))
    (if odd (car odd) otherwise)))

(define most-steps 1000000)             ; that a recording takes without telling what came of them

(define (check-step n last)
  ;; Nothing vouches for N steps that follow LAST but the file: it could ask for more than a life has.
  (unless (and (exact-integer? n) (<= 0 n (+ last most-steps)))
    (bight-raise 'format 'replay "a line of the recording is at step ~s; from ~a it goes on to ~a at most"
                 n last (+ last most-steps))))

(define (replay-lines engine world lines)
  ;; Go through LINES; return #f, or the first difference.
  (let ((hashes '()) (steps #f) (told (%dive-steps engine)))
    (define (step-to! n)
      (check-step n told)
      (let loop ()
        (when (< (%dive-steps engine) n)
          (%step-dive! engine 1)
          (set! hashes (acons (%dive-steps engine) (short-hash engine) hashes))
          (loop))))
    (define (forget!)
      ;; What came of the steps so far was told.
      (set! hashes '())
      (set! steps #f)
      (set! told (%dive-steps engine)))
    (define (difference step what)
      (let ((step (first-odd-step steps hashes step)))
        (make-difference step (* step (%dive-time-step engine)) what)))
    (define (redo line)
      (check-step (second line) told)
      (guard (e ((bight-error? e)
                 (difference (second line)
                             (list (simple-format #f "~a was done then and is refused now: ~a"
                                                  (third line) (bight-error-message e))))))
        (step-to! (second line))
        (redo-line! engine world line)
        #f))
    (define (compare line)
      (step-to! (second line))
      (let ((same? (eqv? (unhex (third line)) (%hash-dive engine)))
            (odd-step (first-odd-step steps hashes #f)))
        (cond ((or odd-step (not same?))
               (difference (second line)
                           (differences (filter pair? (cdddr line))
                                        (if (eq? 'end (car line)) '() (found-quantities engine)))))
              (else
               (forget!)
               #f))))
    (define (take-line line)
      (case (car line)
        ((do) (redo line))
        ((second end) (compare line))
        ((steps) (set! steps line) #f)
        ((state)
         (restore-line! 'replay engine line)
         (forget!)
         #f)
        (else #f)))
    (or-map take-line lines)))

(define (after-beginning story)
  (cdr (find-tail (lambda (line) (eq? 'begin (car line))) (map cdr (story-lines story)))))

(define (replay-story file story)
  ;; Two values: the dive as it is at the end, and the first difference or #f.
  (let ((dive (begin-story 'replay file story)))
    (values dive
            (guard (e ((and (exception? e) (not (bight-error? e)) (not (quit-exception? e)))
                       (bight-raise 'format 'replay "~s holds what no recording holds" file)))
              (replay-lines (engine-of dive) (dive-world dive) (after-beginning story))))))

(define-verb (replay (file string) #:key (enter flag #f) (salvage flag #f))
  "Do again what was recorded in FILE, and return `identical' when all comes out the same to the last bit,
else the first difference.  A recording that was cut off is replayed as far as it goes.  With ENTER, the
dive as it is at the end becomes the current one; with SALVAGE, a recording that was altered is replayed up
to there.  Raise io when FILE cannot be read, format when it is no recording or was altered, version when
it is of another version."
  (let ((story (read-story 'replay file 'bight-recording #:salvage? salvage)))
    (when enter (check-not-running 'replay (current-dive)))
    (call-with-values (lambda () (replay-story file story))
      (lambda (dive difference)
        (when enter (current-dive dive))
        (or difference 'identical)))))

(define (replay-file file)
  "Replay FILE for the command line: print what came of it, and return #t if all came out the same."
  (let ((story (read-story 'replay file 'bight-recording)))
    (call-with-values (lambda () (replay-story file story))
      (lambda (dive difference)
        (simple-format #t "~a: ~a~a~%" file
                       (if difference
                           difference
                           (simple-format #f "identical, ~a s" (%dive-time (engine-of dive))))
                       (if (story-cut? story) "; it is cut off after that" ""))
        (not difference)))))
