;;; (bight follow command) --- bight follow: a real vehicle's telemetry drives a dive, live or from its log.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight follow command)
  #:use-module (bight belief clauses)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight dive checkpoint)
  #:use-module (bight dive query)
  #:use-module (bight dive time)
  #:use-module (bight follow belief)
  #:use-module (bight follow carrier)
  #:use-module (bight follow session)
  #:use-module ((bight outlet) #:select (watched?))
  #:use-module ((bight world atlas) #:select (world-called))
  #:use-module (srfi srfi-1)
  #:export (follow-source))

(define (seconds-of name text)
  (let ((s (and text (text->number text))))
    (cond ((not text) #f)
          ((and (real? s) (finite? s) (> s 0)) s)
          (else (bight-raise 'domain 'follow "~a is seconds, more than 0, not ~s" name text)))))

(define (say text)
  (display text)
  (newline)
  (force-output))

(define (hundredths x) (/ (round (* 100 x)) 100))

(define (where-now session)
  ;; A line of where the vehicle is, and how much line is out.
  (let* ((vehicle (carrier-vehicle (session-carrier session))) (tether (carrier-tether (session-carrier session)))
         (p (map hundredths (array->list (rov-position vehicle)))))
    (simple-format #f "~a s  at (~a ~a ~a) heading ~a~a"
                   (string-pad (number->string (hundredths (now))) 10) (first p) (second p) (third p)
                   (inexact->exact (round (rov-heading vehicle)))
                   (if tether
                       (simple-format #f ", ~a m out" (hundredths (tether-length tether)))
                       ""))))

(define (between-lines text)
  (or (seconds-of "--every" text) 10))

(define (follow-plainly session every stop?)
  ;; A line every so many seconds of the dive, and each alarm as it comes.
  (let loop ((due 0))
    (listen! session 1 (lambda () (or (stop?) (let ((t (session-time session))) (and t (>= t due))))))
    (let* ((t (session-time session)) (due? (and t (>= t due))))
      (when due? (say (where-now session)))
      (unless (or (session-ended? session) (stop?))
        (loop (if due? (+ due (* every (ceiling (/ (+ (- t due) 1e-9) every)))) due))))))

(define (tell-end session)
  (when (session-time session)
    (say (where-now session)))
  (for-each say (session-lines session))
  (when (session-time session)
    (say (string-append "state " (number->string (state-hash) 16))))
  (let ((hash (and=> (session-watch session) watch-hash)))
    (when hash
      (say (string-append "belief " (number->string hash 16))))))

(define (stopper)
  ;; A thunk that returns true once ^C or a request to end has come.
  (let ((stop? #f))
    (for-each (lambda (signal) (sigaction signal (lambda (signal) (set! stop? #t)))) (list SIGINT SIGTERM SIGHUP))
    (lambda () stop?)))

(define (newtons-of text default)
  (let ((n (if text (text->number text) default)))
    (unless (and (real? n) (finite? n) (> n 0))
      (bight-raise 'domain 'follow "--tension-noise is newtons, more than 0, not ~s" text))
    n))

(define (belief-of options)
  ;; What the session is to believe: (TEXT MEMBERS NOISE), or #f.
  (let ((text (assoc-ref options "--belief")))
    (and text
         (list text (tethers-from 'follow (assoc-ref options "--tethers"))
               (newtons-of (assoc-ref options "--tension-noise") 1.0)))))

(define (session-of name options tell)
  (begin-session name
                 (world-called 'follow (world-word (or (assoc-ref options "--in") "open-water"))
                               (assoc-ref options "--trust"))
                 #:keep (assoc-ref options "--keep") #:record (assoc-ref options "--record")
                 #:from-start? (assoc-ref options "--from-start")
                 #:limit (seconds-of "--for" (assoc-ref options "--for"))
                 #:belief (belief-of options)
                 #:tell tell))

(define (world-word text)
  (if (or (string-index text #\/) (string-suffix? ".scm" text) (file-exists? text)) text (string->symbol text)))

(define (at-terminal? options)
  (and (watched? (current-output-port)) (isatty? (fdes->inport 0)) (not (assoc-ref options "--plain"))))

(define (follow-source name options)
  "Follow the telemetry NAME with OPTIONS of the command line, an alist: in the cockpit at a terminal, else in lines."
  (let* ((tell say) (stop? (stopper))
         (session (session-of name options (lambda (text) (tell text)))))
    (dynamic-wind
      (const #f)
      (lambda ()
        (if (at-terminal? options)
            ((module-ref (resolve-interface '(bight cockpit follow)) 'follow-in-cockpit)
             session (lambda (new) (set! tell new)) stop? options)
            (follow-plainly session (between-lines (assoc-ref options "--every")) stop?)))
      (lambda () (end-session! session)))
    (tell-end session)))
