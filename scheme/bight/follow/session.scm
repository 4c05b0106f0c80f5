;;; (bight follow session) --- a source, what sifts and what carries its readings, and who is told.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight follow session)
  #:use-module (bight core errors)
  #:use-module (bight core files)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight dive query)
  #:use-module (bight dive recording)
  #:use-module (bight dive time)
  #:use-module (bight follow alarm)
  #:use-module (bight follow belief)
  #:use-module (bight follow carrier)
  #:use-module (bight telemetry sieve)
  #:use-module (bight telemetry reading)
  #:use-module (bight telemetry source)
  #:use-module (srfi srfi-1)
  #:export (begin-session session? session-carrier session-source session-tally session-ended?
            session-time session-watch listen! end-session! session-lines))

(define-record <session>
  (%make-session source keep sieve carrier watch tally record tell alarm looked queue ended? limit)
  session?
  (source session-source)
  (keep session-keep)                   ; a port that receives what comes, or #f
  (sieve session-sieve)
  (carrier session-carrier)
  (watch session-watch)                 ; of a belief, or #f
  (tally session-tally)
  (record session-record)               ; the file of a recording, or #f
  (tell session-tell)                   ; called with each alarm, a string
  (alarm session-alarm set-session-alarm!) ; or #f: the dive has not begun
  (looked session-looked set-session-looked!) ; s of the dive: when the alarm looked last
  (queue session-queue set-session-queue!) ; readings that came and were not followed yet
  (ended? session-ended? set-session-ended!)
  (limit session-limit))                ; s of the dive at most, or #f

(define (carried-by world tally belief)
  ;; Two values: what carries readings, and what watches the belief that BELIEF, (TEXT MEMBERS NOISE) or #f, tells of.
  (let* ((watch #f)
         (carrier (make-carrier world tally (lambda (reading time) (when watch (watch-sees! watch reading time))))))
    (when belief
      (set! watch (apply make-watch world (carrier-tether carrier) belief)))
    (values carrier watch)))

(define* (begin-session name world #:key keep record from-start? limit belief tell)
  "Open the telemetry NAME for a dive in WORLD.  KEEP and RECORD are names of files, or #f: of all that comes, and of
a recording.  With FROM-START? the first position is taken for the place of the world's vehicle.
BELIEF, a list of a text as `make-watch' takes it, how many tethers and a noise, has a belief go by what comes; with #f
there is none.  TELL is called with each alarm.  After LIMIT seconds of the dive, if not #f, it ends."
  (let ((tally (make-tally)) (origin (world-origin 'follow world)))
    (call-with-values (lambda () (carried-by world tally belief))
      (lambda (carrier watch)
        (let ((port (and keep (open-keep keep)))
              (start (and from-start? (take (carrier-start carrier) 2))))
          (%make-session (open-source name tally port) port (make-sieve (and (not from-start?) origin) start tally)
                         carrier watch tally record tell #f 0 '() #f limit))))))

(define (open-keep file)
  (catch 'system-error
    (lambda () (open-file file "wb"))
    (lambda args
      (bight-raise 'io 'follow "cannot write ~s: ~a" file (strerror (system-error-errno args))))))

(define (session-time s)
  "Return the time of the dive of S, s, or #f: it has not begun."
  (and (session-alarm s) (now)))

(define (dive-begun! s)
  (set-session-alarm! s (make-alarm (carrier-tether (session-carrier s))
                                   (lambda () (> (carrier-speed (session-carrier s)) 0.1))))
  (when (session-watch s)
    (watch-begins! (session-watch s)))
  (when (session-record s)
    (record! (session-record s))))

(define (look! s)
  ;; Once in a second of the dive.
  (when (and (not (session-alarm s)) (carrier-dive (session-carrier s)))
    (dive-begun! s))
  (when (and (session-alarm s) (>= (- (now) (session-looked s)) 1))
    (set-session-looked! s (now))
    (for-each (session-tell s) (alarms! (session-alarm s)))
    (when (session-watch s)
      (for-each (session-tell s) (watch-alarms! (session-watch s))))))

(define (over? s)
  (and (session-limit s) (session-alarm s) (>= (now) (session-limit s))))

(define (follow-one! s reading)
  (let ((good (sift! (session-sieve s) reading)))
    (when good
      (follow-reading! (session-carrier s) good)
      (look! s)
      (when (over? s)
        (set-session-ended! s #t)))))

(define (come! s seconds)
  ;; Take what comes within SECONDS; return #f if nothing did.
  (let ((readings (source-readings! (session-source s) seconds)))
    (cond ((not readings)
           (set-session-ended! s #t)
           (end-readings! (session-carrier s))
           (look! s)
           #f)
          ((eq? 'nothing readings) #f)
          (else (set-session-queue! s readings) #t))))

(define (listen! s seconds until)
  "Follow what has come to S, waiting SECONDS for more, until UNTIL, a thunk, returns true or nothing is left."
  (let loop ((wait seconds))
    (cond ((or (session-ended? s) (until)) #f)
          ((pair? (session-queue s))
           (let ((reading (car (session-queue s))))
             (set-session-queue! s (cdr (session-queue s)))
             (follow-one! s reading)
             (loop 0)))
          ((come! s wait) (loop 0)))))

(define (end-session! s)
  "Read no more, and close what is written."
  (close-source! (session-source s))
  (when (session-keep s) (close-port (session-keep s)))
  (when (and (session-alarm s) (session-record s)) (stop-recording!)))


;;; In words.

(define (said x)
  (let* ((n (inexact->exact (round (* 100 (abs x)))))
         (hundredths (remainder n 100)))
    (string-append (if (and (< x 0) (> n 0)) "-" "") (number->string (quotient n 100)) "."
                   (if (< hundredths 10) "0" "") (number->string hundredths))))

(define (measured s quantity words unit)
  (let ((value (carrier-latest (session-carrier s) quantity)))
    (and value (string-append words " " (said value) unit))))

(define (session-lines s)
  "Return what S is about, a list of strings: what came, what was measured, what was wrong."
  (let* ((tally (session-tally s)) (c (session-carrier s)))
    (filter identity
            (list
             (simple-format #f "~a: ~a readings from ~a ~a" (source-name (session-source s)) (tally-of tally 'readings)
                            (max (tally-of tally 'frames) (tally-of tally 'rows))
                            (if (> (tally-of tally 'frames) 0) "frames" "lines"))
             (let ((parts (filter identity (list (measured s 'payout "payout" " m") (measured s 'tension "tension" " N")
                                                 (measured s 'turns "turns" "") (measured s 'voltage "battery" " V")))))
               (and (pair? parts) (string-append "measured: " (string-join parts ", "))))
             (and (session-watch s) (watch-line (session-watch s)))
             (and (session-alarm s)
                  (string-append (said (carrier-strayed c)) " m from where it says it is, "
                                 (said (carrier-farthest-strayed c)) " m at most"))
             (let ((troubles (tally-troubles tally)))
               (and (pair? troubles)
                    (string-join (map (lambda (trouble) (simple-format #f "~a ~a" (first trouble) (second trouble)))
                                      troubles)
                                 ", ")))))))
