;;; Time as a value: going back, forks, files of dives, recordings, live dives, the logbook.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight core errors)
             ((bight core sqlite) #:select (there?))
             ((bight dive story) #:prefix story:)
             (ice-9 exceptions)
             (ice-9 textual-ports)
             ((ice-9 binary-ports) #:select (get-bytevector-all put-bytevector))
             (rnrs bytevectors)
             (srfi srfi-1))

(define (kind-of thunk)
  "Return the kind of the &bight-error that THUNK raises, or #f."
  (guard (e ((bight-error? e) (bight-error-kind e)))
    (thunk)
    #f))

(define (bytes-of file)
  (call-with-input-file file get-bytevector-all #:binary #t))

(define (write-bytes! file bytes n)
  "Write the first N of BYTES to FILE."
  (call-with-output-file file
    (lambda (port) (put-bytevector port bytes 0 n))
    #:binary #t))

(define-scenario rewinding
  "Going back leads to the state that was, and from there on all comes again."
  (in pile)
  (let ((start (state-hash)) (after #f) (later #f) (turns 0))
    (drive! #:surge 0.8 #:yaw 0.1)
    (run 3.3)
    (set! after (state-hash))
    (every 0.7 (set! turns (+ turns 1)) (drive! #:sway (* 0.1 (modulo (inexact->exact (round (now))) 5))))
    (run 2.2)
    (pay-out! 1)
    (run 2)
    (set! later (state-hash))
    (expect (rewind! 2) is (about 5.5 #:within 1e-9))
    (pay-out! 1)
    (run 2)
    (expect (state-hash) => later)
    (expect (what-if (rewind! 4.2) (state-hash)) => after)
    (expect (state-hash) => later)
    (rewind! 4.2)
    (expect (state-hash) => after)
    (let ((before turns))
      (run 2)
      (expect turns => before))         ; `every' was not yet said
    (rewind! (now))
    (expect (state-hash) => start)
    (expect (now) => 0.0)
    (expect (rewind! 1) raises domain)
    (expect (rewind! -1) raises domain)
    (expect (state-hash) => start)))

(define-scenario rewinding-tasks
  "What runs between the steps goes back too, and goes on from there; nothing within it may go back."
  (in open-water)
  (let ((log '()) (after #f))
    (every 0.7 (set! log (cons (now) log)) (drive! #:surge (/ (now) 10)))
    (run 2.8)                           ; not a whole second, where a state may have been kept
    (set! after (state-hash))
    (run 1.7)
    (rewind! 2.2)
    (set! log '())
    (run 2.2)
    (expect (map (lambda (t) (round (* 10 t))) log) => '(42.0 35.0 28.0))
    (rewind! 1.7)                       ; just after `every' had its turn
    (expect (state-hash) => after)
    (set! log '())
    (run 1.7)
    (expect (map (lambda (t) (round (* 10 t))) log) => '(42.0 35.0))
    (every 0.5 (rewind! 0.1))
    (expect (run 1) raises def)))

(define-pilot waiter
  "Turns every second, and counts."
  (drive! #:surge 0.5)
  (run 1)
  (drive! #:yaw 0.5)
  (run 1)
  (drive! #:yaw -0.5)
  (run 1)
  (release!))

(define-scenario rewinding-pilots
  "A pilot stands in his script where he stood; a fork has a pilot of its own."
  (in open-water)
  (with-pilot waiter
    (run 3.5)
    (let ((end (state-hash)))
      (rewind! 2)
      (expect (list-ref (array->list (sticks)) 3) => 0.5)
      (expect (what-if (run 2) (state-hash)) => end)
      (run 2)
      (expect (state-hash) => end))))

(define-scenario rewinding-checkpoints
  "A checkpoint brings its past along."
  (in pile)
  (run 1.5)
  (let ((here (checkpoint)) (hash (state-hash)))
    (drive! #:surge 1)
    (run 1)
    (restore! here)
    (expect (state-hash) => hash)
    (run 0.5)
    (rewind! 0.5)
    (expect (state-hash) => hash)
    (rewind! 1.5)
    (expect (now) => 0.0)))

(define (random-operation! random-state)
  (case (random 6 random-state)
    ((0) (drive! #:surge (- (random 2.0 random-state) 1)))
    ((1) (drive! #:yaw (- (random 2.0 random-state) 1)))
    ((2) (pay-out! (random 0.1 random-state)))
    ((3) (haul-in! (random 0.1 random-state)))
    ((4) (current! (random 0.5 random-state) (random 360.0 random-state)))
    (else (release!))))

(define (random-moves n random-state)
  "Do N things at random, and return how often a fork or going back did not lead where it should."
  (let ((known (list (cons 0.0 (state-hash)))) (wrong 0))
    (define (go-on!)
      (run (/ (random 40 random-state) 60))
      (unless (assv (now) known)        ; perhaps no whole step
        (set! known (acons (now) (state-hash) known))))
    (define (fork-and-compare!)
      (let* ((before (state-hash)) (old (list-ref known (random (length known) random-state)))
             (there (what-if (rewind! (- (now) (car old))) (state-hash))))
        (what-if (random-operation! random-state) (run 0.1))
        (unless (and (= before (state-hash)) (= there (cdr old)))
          (set! wrong (+ wrong 1)))))
    (define (go-back!)
      (let ((old (list-ref known (random (length known) random-state))))
        (rewind! (- (now) (car old)))
        (set! known (filter (lambda (k) (<= (car k) (+ 1e-9 (now)))) known))
        (unless (= (state-hash) (cdr old))
          (set! wrong (+ wrong 1)))))
    (do ((i 0 (+ i 1)))
        ((= i n) wrong)
      (case (random 8 random-state)
        ((0) (fork-and-compare!))
        ((1) (go-back!))
        ((2 3 4) (random-operation! random-state))
        (else (go-on!))))))

(define interleavings
  ;; BIGHT_INTERLEAVINGS=10000 for a long run.
  (string->number (or (getenv "BIGHT_INTERLEAVINGS") "400")))

(define-scenario (interleaved W)
  "Forks and going back are bit-equal, whatever is done between."
  #:for ((W 'open-water 'pile))
  (enter! W)
  (expect (random-moves interleavings (seed->random-state 20260101)) => 0))


;;; Files of dives.

(define-scenario (saved W)
  "A dive that was saved goes on as if nothing had been."
  #:for ((W 'open-water 'tank 'tide-profile 'pile 'pier 'rigging 'box 'wreck))
  (enter! W)
  (run 0.5)
  (let ((file (scratch-file "saved.dive")) (hash (state-hash)))
    (save! file)
    (run 0.5)
    (let ((later (state-hash)))
      (enter! 'tank)
      (load-dive file)
      (expect (state-hash) => hash)
      (run 0.5)
      (expect (state-hash) => later)
      (rewind! 0.5)
      (expect (state-hash) => hash)
      (expect (rewind! 0.5) raises domain))))

(define-scenario saved-track
  "The track that a vehicle follows is saved with the dive."
  (in (with 'open-water (minnow (type kinematic))))
  (follow! '((0 0 15 -8) (10 5 15 -8)))
  (run 2)
  (save! (scratch-file "track.dive"))
  (run 2)
  (let ((later (state-hash)))
    (load-dive (scratch-file "track.dive"))
    (run 2)
    (expect (state-hash) => later)))

(define-scenario not-saved
  "What is a procedure is in no file; a file that cannot be written says so."
  (in (with 'open-water (current (lambda (p t) (list 0.1 0 0)))))
  (expect (save! (scratch-file "no.dive")) raises unsupported)
  (expect (record! (scratch-file "no.rec")) raises unsupported)
  (expect (live!) raises unsupported)
  (enter! 'tank)
  (expect (save! "/nowhere/at/all.dive") raises io)
  (expect (load-dive "/nowhere/at/all.dive") raises io)
  (expect (record! "/nowhere/at/all.rec") raises io)
  (expect (file-exists? (scratch-file "no.dive")) => #f))

(define (write-text! file text)
  (call-with-output-file file (lambda (port) (put-string port text))))

(define-scenario foreign-files
  "Foreign, old and empty files are told apart, and leave the dive alone."
  (in tank)
  (let ((hash (state-hash)))
    (for-each (lambda (entry)
                (write-text! (scratch-file "foreign") (car entry))
                (expect (kind-of (lambda () (load-dive (scratch-file "foreign")))) => (cdr entry)))
              '(("" . format)
                ("hello" . format)
                ("(bight-recording 1)\n" . format)
                ("(bight-dive 0)\n" . version)
                ("(bight-dive 2)\n" . version)
                ("(bight-dive 1)\n" . format)
                ("(bight-dive 1)\n(begin 0 \"0\")\n" . format)))
    (expect (load-dive (dirname (scratch-file "folder"))) raises io)
    (expect (state-hash) => hash)))

(define* (damaged-kinds file load flips random-state #:optional (spared 0))
  "Return the kinds of what LOAD raises, or #f, when single bytes of FILE are altered, but for the last
SPARED."
  (let* ((bytes (bytes-of file)) (n (bytevector-length bytes)) (copy (scratch-file "damaged")))
    (delete-duplicates
     (map (lambda (i)
            (let* ((at (random (- n spared) random-state)) (was (bytevector-u8-ref bytes at)))
              (bytevector-u8-set! bytes at (logxor was (+ 1 (random 255 random-state))))
              (write-bytes! copy bytes n)
              (bytevector-u8-set! bytes at was)
              (kind-of (lambda () (load copy)))))
          (iota flips)))))

(define (cut-kinds file load cuts random-state)
  "Return the kinds of what LOAD raises, or #f, when FILE is cut off somewhere."
  (let* ((bytes (bytes-of file)) (n (bytevector-length bytes)) (copy (scratch-file "cut")))
    (delete-duplicates
     (map (lambda (i)
            (write-bytes! copy bytes (random n random-state))
            (kind-of (lambda () (load copy))))
          (iota cuts)))))

(define-scenario a-damaged-last-line
  "Each byte of the line with the checksum counts, also those between the checksum and what it vouches for."
  (in pile)
  (run 0.1)
  (let ((file (scratch-file "whole.dive")) (copy (scratch-file "damaged")))
    (save! file)
    (let* ((bytes (bytes-of file)) (n (bytevector-length bytes)))
      (do ((at (- n 40) (+ at 1))) ((= at n))
        (let ((was (bytevector-u8-ref bytes at)))
          (bytevector-u8-set! bytes at (logxor was 1))
          (write-bytes! copy bytes n)
          (bytevector-u8-set! bytes at was)
          (expect (kind-of (lambda () (load-dive copy))) => 'format))))))

(define-scenario damaged-dives
  "Of a file that was altered or cut off nothing is loaded."
  (in pile)
  (run 0.2)
  (let ((file (scratch-file "whole.dive")) (random-state (seed->random-state 7)))
    (save! file)
    (run 0.2)
    (let ((hash (state-hash)))
      (expect (lset-difference eq? (damaged-kinds file load-dive 200 random-state) '(format version))
              => '())
      (expect (cut-kinds file load-dive 60 random-state) => '(format))
      (expect (state-hash) => hash))))


;;; Recordings.

(define (record-something! file)
  "Record a dive with operations, tasks and going back in FILE, and return the hash of its end."
  (record! file)
  (drive! #:surge 0.8 #:yaw 0.1)
  (run 1.3)
  (every 0.7 (drive! #:sway 0.1))
  (alter! 'line #:cdn 1.4 #:friction 0.4)
  (guard (e ((bight-error? e) #f))
    (alter! 'line #:cdn 1.5 #:length 3)) ; all or none: not recorded
  (pay-out! 1)
  (run 2)
  (rewind! 0.8)
  (current! '(profile (0 0.3 45) (-10 0.1 90)))
  (run 1.4)
  (stop-recording!)
  (state-hash))

(define-scenario recorded
  "What was recorded comes out the same, without the code that ran between the steps."
  (in pile)
  (let* ((file (scratch-file "dive.rec")) (end (record-something! file)))
    (expect (recording?) => #f)
    (expect (stop-recording!) => #f)
    (expect (replay file) => 'identical)
    (expect (replay file #:enter #t) => 'identical)
    (expect (state-hash) => end)
    (rewind! 0)
    (expect (record! file) => file)
    (expect (record! file) raises def)
    (stop-recording!)))

(define-scenario recorded-from-the-middle
  "A recording may begin anywhere."
  (in pile)
  (drive! #:surge 0.5)
  (run 1.1)
  (let ((file (scratch-file "middle.rec")))
    (record! file)
    (run 1.1)
    (haul-in! 0.2)
    (run 1)
    (stop-recording!)
    (expect (replay file) => 'identical)))

(define-scenario recorded-quantities
  "A second of a recording is data that tells where the vehicle is, how the tether pulls and its nodes, to the last
bit, by names of any letters."
  (enter! (world (sea (depth 30))
                 (rov (named Möwe-2) (at 0 8 -5))
                 (tether (named ligne-ç) (from 0 0 0) (length 12) (nodes 20) (model dynamic))))
  (let ((file (scratch-file "quantities.rec")))
    (record! file)
    (drive! #:surge 0.5 #:yaw 0.3)
    (run 2)
    (stop-recording!)
    (let ((second (find (lambda (line) (and (eq? 'second (car line)) (eqv? 120 (cadr line))))
                        (call-with-input-file file
                          (lambda (port) (unfold eof-object? values (lambda (x) (read port)) (read port)))
                          #:encoding "UTF-8"))))
      (expect (list-ref second 3)
              => (cons* 'rov 'Möwe-2 (append (array->list (rov-position)) (list (rov-heading)))))
      (expect (list-head (list-ref second 4) 5)
              => (list 'tether 'ligne-ç (tether-length) (anchor-tension) (rov-tension)))
      (expect (string-length (list-ref (list-ref second 4) 5)) => (* 4 (array-length (tether-points)))))
    (expect (replay file) => 'identical)))

(define (retold file other change)
  "Write the story in FILE to OTHER with each line as CHANGE has it, and checksums that hold."
  (let ((teller (story:make-teller 'test other)))
    (call-with-input-file file
      (lambda (port)
        (let loop ((datum (read port)))
          (unless (eof-object? datum)
            (let ((datum (change datum)))
              (if (memq (car datum) '(begin second end))
                  (apply story:tell-with-checksum! teller (drop-right datum 1))
                  (story:tell-datum! teller datum)))
            (loop (read port))))))
    (story:teller-close! teller)))

(define-scenario otherwise
  "The first step and the quantities that come out otherwise are named."
  (in pile)
  (let ((file (scratch-file "one.rec")) (other (scratch-file "other.rec")))
    (record! file)
    (run 1.5)
    (drive! #:surge 0.8)
    (run 1)
    (stop-recording!)
    (retold file other (lambda (datum) datum))
    (expect (replay other) => 'identical)
    (retold file other
            (lambda (datum)
              (if (and (eq? 'do (car datum)) (eq? 'drive (third datum)))
                  '(do 90 drive minnow 0.7 +nan.0 +nan.0 +nan.0)
                  datum)))
    (let ((found (replay other)))
      (expect (difference? found))
      (expect (difference-step found) => 91)
      (expect (difference-time found) is (about 91/60 #:within 1e-9))
      (expect (any (lambda (text) (string-contains text "y of minnow")) (difference-quantities found)))
      (expect (any (lambda (text) (string-contains text "nodes of line")) (difference-quantities found))))
    (retold file other
            (lambda (datum)
              (if (eq? 'do (car datum)) '(do 90 pay-out line -4.0 0.5) datum)))
    (expect (difference-step (replay other)) => 90)))

(define-scenario damaged-recordings
  "A recording that was altered says where; one that was cut off is replayed as far as it goes."
  (in pile)
  (let ((file (scratch-file "damage.rec")) (random-state (seed->random-state 11)))
    (record-something! file)
    ;; A last line that is altered is taken for one that was cut off.
    (expect (lset-difference eq? (damaged-kinds file replay 60 random-state 80) '(format version))
            => '())
    (expect (lset-difference eq? (cut-kinds file replay 20 random-state) '(format #f)) => '())
    (let* ((bytes (bytes-of file)) (n (bytevector-length bytes)))
      (write-bytes! (scratch-file "short.rec") bytes (- n 5))
      (expect (replay (scratch-file "short.rec")) => 'identical)
      (bytevector-u8-set! bytes (- n 60) 64)
      (write-bytes! (scratch-file "short.rec") bytes n)
      (expect (replay (scratch-file "short.rec")) raises format)
      (expect (replay (scratch-file "short.rec") #:salvage #t) => 'identical))))

(define-scenario framed
  "Frames are in a database and in a table for other programs."
  (unless there? (skip "built without SQLite"))
  (enter! 'pile)
  (let ((file (scratch-file "frames.db")))
    (record! (scratch-file "framed.rec") #:frames file)
    (drive! #:surge 0.5)
    (run 2)
    (stop-recording!)
    (let ((lines (export-csv file (scratch-file "frames.csv"))))
      ;; 21 frames: the first, then ten a second.
      (expect lines => (* 21 (+ 1 (car (array-dimensions (tether-points)))))))
    (expect (export-csv (scratch-file "framed.rec") (scratch-file "frames.csv")) raises format)
    (expect (export-csv "/nowhere.db" (scratch-file "frames.csv")) raises io)
    (expect (record! (scratch-file "framed.rec") #:frames "/nowhere/frames.db") raises io)))


;;; Live.

(define-scenario living
  "A live dive goes on while Scheme does not let time pass, obeys, answers, and is replayed to the bit."
  (in pile)
  (let ((file (scratch-file "live.rec")))
    (record! file)
    (expect (live?) => #f)
    (live! #:pace 4)
    (expect (live?))
    (drive! #:surge 0.8)
    (expect (array->list (sticks)) => '(0.8 0.0 0.0 0.0))
    (let ((before (now)) (place (rov-position)))
      (let wait ()
        (unless (and (> (- (now) before) 0.3) (> (distance place (rov-position)) 0.1))
          (usleep 10000)
          (wait)))
      (expect (- (now) before) is (above 0.3)))
    (expect (drive! #:surge 2) raises domain)
    (expect (current! (lambda (p t) '(0 0 0))) raises unsupported)
    (expect (what-if (run 1) (live?)) => #f)
    (run 2)
    (pay-out! 0.5)
    ;; Who is let run late sees the dive beyond where it went back to: he goes back once more.
    (expect (any (lambda (try)
                   (let ((before (now)))
                     (rewind! 1)
                     (< (now) before)))
                 (iota 100)))
    (expect (live?))
    (run 1)
    (freeze!)
    (let ((still (now)))
      (usleep 50000)
      (expect (now) => still))
    (expect (freeze!) => (now))
    (run 0.5)
    (stop-recording!)
    (expect (replay file) => 'identical)))

(define-scenario living-tasks
  "What runs between the steps runs while one waits for a live dive."
  (in open-water)
  (let ((times '()))
    (every 0.5 (set! times (cons (now) times)))
    (live! #:pace 10)
    (let wait ()
      (when (< (length times) 5)
        (run 0.5)
        (wait)))
    (freeze!)
    (expect (apply > times))))


;;; The logbook.

(define-scenario logging
  "The logbook holds dives, lessons and probes of each trainee."
  (unless there? (skip "built without SQLite"))
  (setenv "BIGHT_LOGBOOK" (scratch-file "state/logbook.db"))
  (enter! 'pile)
  (run 1)
  (expect (logbook) => '())
  (expect (log-dive! #:trainee "ada" #:score 0.5) => 1)
  (expect (log-lesson! 'one-pile #:trainee "ada" #:score 12) => 2)
  (expect (log-probe! "Where is the middle?" #:trainee "grace" #:data '((truth 3.5) (answer "north"))) => 3)
  (expect (map log-entry-kind (logbook)) => '(dive lesson probe))
  (expect (map log-entry-what (logbook #:trainee "ada")) => '("pile" "one-pile"))
  (expect (map log-entry-score (logbook #:kind 'lesson)) => '(12.0))
  (expect (log-entry-data (car (logbook #:trainee "grace"))) => '((truth 3.5) (answer "north")))
  (expect (log-entry-data (car (logbook))) => '((seconds . 1.0)))
  (expect (logbook #:trainee "x' or 1=1; --") => '())
  (expect (log-probe! "?" #:data (list car)) raises domain)
  (write-text! (scratch-file "no.db") "this is text, and long enough to be taken for a database or something else")
  (setenv "BIGHT_LOGBOOK" (scratch-file "no.db"))
  (expect (logbook) raises format)
  (setenv "BIGHT_LOGBOOK" "/dev/null/logbook.db")
  (expect (logbook) raises io))

(define (fly-on! seconds)
  (drive! #:surge 0.6 #:yaw 0.15)
  (run seconds)
  (state-hash))

(define-scenario (forks-are-made-in-the-memory-of-forks place)
  "What comes of a fork does not depend on what was flown before in its memory: contacts, winches, static lines, waves."
  #:for ((place 'jacket 'pile 'open-water 'wreck))
  (in (with place (sea (waves (airy (height 1) (period 6) (toward 90))))))
  (run 1)
  (let* ((here (state-hash)) (first (what-if (fly-on! 3))))
    (what-if (pay-out! 2) (drive! #:surge -1 #:heave -0.5) (run 5))
    (what-if (expect (state-hash) => here) (what-if (fly-on! 2)) (expect (state-hash) => here))
    (expect (what-if (fly-on! 3)) => first)
    (expect (state-hash) => here)
    (expect (fly-on! 3) => first)))

(define-scenario a-fork-that-rests-can-be-asked
  "Whoever keeps a fork beyond its what-if finds the fork as it was left, also while another fork is flown in its
memory: state, remainder of time, journal; and it goes on as if it had never rested."
  (in pile)
  (run 1)
  (let* ((kept '()) (keep! (lambda () (set! kept (cons (current-dive) kept)) (state-hash)))
         (left (what-if (fly-on! 2) (run 0.01) (keep!)))
         (other (what-if (drive! #:sway 1) (run 1) (keep!)))
         (gone-on (what-if (fly-on! 2) (run 0.01) (run 0.01) (fly-on! 1))))
    (what-if
     (run 0.5)
     (let ((mine (state-hash)))
       (expect (map (lambda (dive) (with-dive dive (state-hash))) kept) => (list other left))
       (expect (state-hash) => mine)))
    (with-dive (second kept)
      (run 0.01)
      (expect (fly-on! 1) => gone-on)
      (expect (what-if (run 1) (rewind! 1) (state-hash)) => (state-hash)))
    (expect (now) is (about 1 #:within 1e-9))))

(define-scenario forks-that-are-more-than-a-state-do-not-rest
  "A fork with a track of its own, or with threads, is kept as it is."
  (in open-water)
  (let ((kept #f))
    (what-if (follow! '((0 0 15 -8) (10 5 15 -8))) (threads! 2) (run 1) (set! kept (current-dive)))
    (let ((here (with-dive kept (state-hash))) (next (what-if (run 3) (state-hash))))
      (expect (with-dive kept (threads)) => 2)
      (expect (with-dive kept (state-hash)) => here)
      (with-dive kept (run 1))
      (run 3)
      (expect (state-hash) => next))))
