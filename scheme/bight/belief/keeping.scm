;;; (bight belief keeping) --- a belief in a file, with its dive.
;;;
;;; The file is a story (bight dive story) of the dive as it is, after which come what is uncertain, what was done to the
;;; dive since the belief began, what was read, and of each member its latent numbers, its weights and two states: where it
;;; is, and where it is flown again from.  So a belief that is loaded goes on as the one that was saved, to the last bit.
;;;
;;; What is read is judged line by line and field by field, and its states by the engine; nothing of it is evaluated.
;;; Operations are numbered from the last one back, which is 0: those of the dive that goes on come after.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight belief keeping)
  #:use-module (bight belief cloud)
  #:use-module (bight belief readings)
  #:use-module (bight belief unknowns)
  #:use-module (bight core errors)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive past)
  #:use-module (bight dive story)
  #:use-module (bight engine)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (save-belief! load-belief))


;;; Writing.

(define (last-serial belief)
  (let ((applied (belief-applied belief)))
    (if (pair? applied) (entry-serial (car applied)) 0)))

(define (entry-line entry last)
  (list 'entry (- (entry-serial entry) last) (entry-step entry) (entry-operation entry) (entry-subject entry)
        (entry-numbers entry)))

(define (reading-line head r last . more)
  (append (list head (reading-step r) (- (reading-serial r) last) (reading-kind r) (reading-value r) (reading-noise r)
                (reading-part r) (reading-scalars r) (reading-done? r) (reading-predictions r))
          more))

(define (state-text head bytes)
  (list head (bytevector-length bytes) (%bytes->text bytes)))

(define (member-line m origins)
  (list 'member (member-latent m) (member-weight m) (member-event-weight m) (member-lost? m)
        (member-origin-error m) (list-index (lambda (o) (bytevector=? o (member-origin m))) origins)
        (%bytes->text (%save-dive (member-engine m)))))

(define (belief-lines belief)
  (let ((last (last-serial belief))
        (origins (delete-duplicates (map member-origin (belief-members belief)) bytevector=?)))
    (append
     (list (list 'belief (belief-kind belief) (belief-seed belief) (length (belief-members belief))
                 (belief-origin-step belief) (belief-origin-current belief) (belief-current belief))
           (list 'clauses (belief-clauses belief)))
     (map (lambda (e) (entry-line e last)) (entries-since (belief-applied belief) (belief-origin-journal belief)))
     (map (lambda (r) (reading-line 'reading r last)) (belief-readings belief))
     (map (lambda (d) (reading-line 'doubt (first d) last (second d) (third d))) (belief-doubted belief))
     (map (lambda (round) (cons 'round round)) (belief-rounds belief))
     (map (lambda (o) (state-text 'origin o)) origins)
     (map (lambda (m) (member-line m origins)) (belief-members belief)))))

(define (write-belief! teller belief)
  (tell-beginning! 'save-belief! teller 'bight-belief (belief-host belief))
  (for-each (lambda (line) (tell-datum! teller line)) (belief-lines belief))
  (tell-with-checksum! teller 'end (%dive-steps (engine-of (belief-host belief)))
                       (hex (%hash-dive (engine-of (belief-host belief)))))
  (teller-close! teller))

(define-argument-type (maybe-belief value)
  "a belief, as `believe!' returns, or #f for the current one"
  (if (or (not value) (is-belief? value)) value refused))

(define-verb (save-belief! (file string) #:optional (belief maybe-belief #f))
  "Save BELIEF, or the current one, in FILE with its dive as it is: what is uncertain, what was read, and every tether.
Raise unsupported when a part of the dive is a procedure, io when the file cannot be written.  Return FILE."
  (let ((belief (or belief (this-belief 'save-belief!))) (new (string-append file ".new")))
    (catch-up! 'save-belief! belief)
    (check-dive 'save-belief! (belief-host belief))
    (let ((teller (make-teller 'save-belief! new)))
      (catching-io 'save-belief! file
        (write-belief! teller belief)
        (rename-file new file)))
    file))


;;; Judging.  A field is as `fields' has it, or the file is refused.

(define (wrong what . arguments)
  (bight-raise 'format 'load-belief "it holds ~a" (apply simple-format #f what arguments)))

(define (finite-number? x) (and (real? x) (finite? x)))
(define (whole? x) (and (exact-integer? x) (<= 0 x (expt 2 53))))
(define (finite-vector? v) (and (f64vector? v) (every finite? (f64vector->list v))))

(define (fields line . kinds)
  ;; What follows the head of LINE, as many fields as KINDS, each of which it must be.
  (unless (and (= (length line) (+ 1 (length kinds)))
               (every (lambda (kind? value) (kind? value)) kinds (cdr line)))
    (wrong "a line `~a' that is none" (car line)))
  (cdr line))

(define (led-by lines head) (filter (lambda (line) (eq? head (car line))) lines))

(define (only lines head)
  (let ((found (led-by lines head)))
    (unless (= 1 (length found)) (wrong "~a lines `~a', not one" (length found) head))
    (car found)))

(define (any? x) #t)

(define (count-of engine operation)
  ;; How many parts OPERATION, a symbol, may be about; #f: there is none of that name.
  (let ((entry (assq operation (%operations))))
    (and entry (if (cdr entry) (length (%names engine (cdr entry))) 1))))

(define (told-entry engine line first-step last-step)
  (let* ((told (fields line (lambda (n) (and (exact-integer? n) (<= (- (expt 2 53)) n 0))) whole? symbol? whole?
                       f64vector?))     ; judged by the engine when it is done again
         (parts (count-of engine (third told))))
    (unless (and parts (< (fourth told) parts) (<= first-step (second told) last-step))
      (wrong "an operation ~a at step ~a that cannot be" (third told) (second told)))
    (list->vector told)))

(define (in-order? numbers) (or (null? numbers) (apply <= numbers)))

(define (told-entries engine lines first-step last-step)
  ;; The journal that LINES, the oldest first, tell.
  (let ((entries (map (lambda (line) (told-entry engine line first-step last-step)) (led-by lines 'entry))))
    (unless (and (in-order? (map entry-step entries)) (in-order? (map entry-serial entries)))
      (wrong "operations out of order"))
    (reverse entries)))

(define (told-part engine kind part)
  (unless (and (list? part) (= (length part) (if (eq? kind 'transponder) 2 1))
               (memq (car part) (%names engine (if (of-vehicle? kind) 'rov 'tether)))
               (every (lambda (x) (and (real? x) (finite? x) (>= x 0))) (cdr part)))
    (wrong "a reading of ~s, which is none of this dive" part))
  part)

(define (foretold? scalars lost? prediction)
  ;; Is PREDICTION what a member may have foretold: as many numbers as were read, of an event one; #f if it is lost?
  (or (and (not prediction) lost?)
      (and (finite-vector? prediction)
           (= (f64vector-length prediction) (if scalars (f64vector-length scalars) 1)))))

(define (told-reading engine told losses steps)
  ;; LOSSES tells of each member whose prediction it has whether it is lost.
  (let ((kind (third told)) (scalars (seventh told)))
    (unless (and (memq kind reading-kinds) (<= (car steps) (first told) (cdr steps))
                 (eq? (not scalars) (and (event? kind) #t)))
      (wrong "a reading ~a at step ~a that cannot be" kind (first told)))
    (let ((value (check-reading kind (if (and (eq? kind 'touched) (pair? (fourth told)))
                                         (if (cdr (fourth told)) (car (fourth told)) (list 'not (car (fourth told))))
                                         (one-or-all (fourth told))))))
      (unless (or (not scalars) (equal? value scalars)) (wrong "a reading ~a that contradicts itself" kind))
      (unless (and (= (length (ninth told)) (length losses))
                   (every (lambda (lost? p) (foretold? scalars lost? p)) losses (ninth told)))
        (wrong "a reading ~a that members foretold otherwise than numbers are" kind))
      (make-reading (first told) (second told) kind value (fifth told) (told-part engine kind (sixth told)) scalars
                    (ninth told) (eighth told)))))

(define reading-fields
  (list whole? exact-integer? symbol? any? (lambda (x) (and (finite-number? x) (> x 0))) list?
        (lambda (s) (or (not s) (finite-vector? s))) boolean? list?))

(define (told-readings engine lines losses steps)
  (map (lambda (line) (told-reading engine (apply fields line reading-fields) losses steps)) (led-by lines 'reading)))

(define (told-doubts engine lines steps)
  (map (lambda (line)
         (let ((told (apply fields line (append reading-fields (list finite-number? finite-number?)))))
           (list (told-reading engine (take told 9) '() (cons 0 (cdr steps))) (list-ref told 9) (list-ref told 10))))
       (led-by lines 'doubt)))

(define (told-state engine text)
  ;; The state in TEXT, a bytevector that the engine has restored.
  (let* ((size (bytevector-length (%save-dive engine))) (bytes (%text->bytes text size)))
    (unless bytes (wrong "a tether's state that is none of this dive"))
    (%restore-dive! engine bytes)
    bytes))

(define (at-step! engine step)
  (unless (= step (%dive-steps engine)) (wrong "a tether at step ~a, not ~a" (%dive-steps engine) step)))

(define (told-member host line unknowns origins origin-step)
  (let* ((told (fields line (lambda (z) (and (finite-vector? z) (= (f64vector-length z) (unknowns-size unknowns))))
                       finite-number? finite-number? boolean? finite-number?
                       (lambda (k) (and (whole? k) (< k (length origins)))) string?))
         (fork (bare-fork host)) (engine (engine-of fork)) (origin (list-ref origins (sixth told))))
    (%restore-dive! engine origin)
    (at-step! engine origin-step)
    (told-state engine (seventh told))
    (unless (fourth told) (at-step! engine (%dive-steps (engine-of host))))
    (make-member fork (first told) (second told) (third told) (fourth told) origin (fifth told))))

(define (told-origin scratch line)
  (told-state (engine-of scratch) (second (fields line whole? string?))))

(define (told-belief host lines)
  (let* ((engine (engine-of host)) (step (%dive-steps engine))
         (current? (lambda (v) (and (finite-vector? v) (> (f64vector-length v) 0))))
         (told (fields (only lines 'belief) (lambda (k) (memq k '(smoother particles))) whole?
                       (lambda (n) (and (whole? n) (<= 8 n 4096))) (lambda (s) (and (whole? s) (<= s step)))
                       current? current?))
         (clauses (first (fields (only lines 'clauses) list?)))
         (unknowns (call-with-dive host (lambda () (read-unknowns clauses))))
         (size (third told)) (origin-step (fourth told)) (steps (cons origin-step step))
         (scratch (bare-fork host))
         (journal (told-entries engine lines origin-step step))
         (origins (map (lambda (line) (told-origin scratch line)) (led-by lines 'origin)))
         (members (map (lambda (line) (told-member host line unknowns origins origin-step)) (led-by lines 'member)))
         (rounds (map (lambda (line) (fields line symbol? whole? whole?)) (led-by lines 'round))))
    (unless (= size (length members)) (wrong "~a tethers, not ~a" (length members) size))
    (%set-journal! engine journal)
    (make-belief-record host clauses unknowns (second told) (first told) members step origin-step '() (fifth told)
                        journal (sixth told)
                        (call-with-dive host (lambda () (told-readings engine lines (map member-lost? members) steps)))
                        (call-with-dive host (lambda () (told-doubts engine lines steps)))
                        rounds (belief-processors))))

(define-verb (load-belief (file string))
  "Go on with the belief that was saved in FILE, and its dive: both become the current ones.  Return the belief.  Raise
io when the file cannot be read, format when it is no saved belief or was altered, version when another version of bight
wrote it or a file that its world names has changed."
  (check-not-running 'load-belief (current-dive))
  (let* ((story (read-story 'load-belief file 'bight-belief)) (lines (map cdr (story-lines story))))
    (unless (and (eq? 'end (car (last lines))) (not (story-cut? story)))
      (bight-raise 'format 'load-belief "~s is cut off" file))
    (let ((host (begin-story 'load-belief file story)))
      (unless (equal? (third (last lines)) (hex (%hash-dive (engine-of host))))
        (bight-raise 'format 'load-belief "~s does not hold the state it speaks of" file))
      (let ((belief (told-belief host (after-beginning lines))))
        (current-dive host)
        (current-belief belief)
        belief))))

(define (after-beginning lines)
  (cdr (find-tail (lambda (line) (eq? 'begin (car line))) lines)))
