;;; (bight telemetry source) --- where telemetry comes from: a file, a pipe, a socket of one's own, UDP on loopback.
;;;
;;; A source is only read.  A socket's writing half is shut before the first datagram, so that the kernel itself
;;; would refuse to send: a vehicle that is listened to never hears of bight.
;;;
;;; Who may be listened to follows the rules of (bight shell listen): a socket that is a file belongs to the user
;;; or to root; a datagram on loopback comes from a program of the user or of root, as /proc/net/udp tells of the
;;; port that it was sent from.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight telemetry source)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module ((bight core missing) #:select (why-not))
  #:use-module (bight core record)
  #:use-module (bight telemetry mavlink)
  #:use-module (bight telemetry reading)
  #:use-module (bight telemetry rows)
  #:use-module (ice-9 binary-ports)
  #:use-module (ice-9 rdelim)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:export (open-source source? close-source! source-readings! source-name source-live? source-port))

(define-record <source>
  (make-source name port live? take)
  source?
  (name source-name)
  (port source-port)
  (live? source-live?)                  ; does it come as it happens, not from a file
  (take source-take))                   ; (TAKE): readings, or #f at the end


;;; UDP.

(define (loopback-port name)
  ;; The port of NAME, udp:PORT or udp:ADDRESS:PORT, or raise.
  (let* ((parts (cdr (string-split name #\:)))
         (port (text->number (last parts)))
         (address (if (= 2 (length parts)) (first parts) "127.0.0.1")))
    (unless (and (<= 1 (length parts) 2) (exact-integer? port) (< 0 port 65536))
      (bight-raise 'domain 'follow "a vehicle on UDP is udp:PORT, a port from 1 to 65535, not ~s" name))
    (unless (member address '("127.0.0.1" "localhost"))
      (bight-raise 'domain 'follow "bight listens on this machine alone: udp:~a, not ~s; let a router of telemetry \
such as MAVProxy send it there" port name))
    port))

(define (deaf-mute socket)
  ;; SOCKET, from which from now on nothing can be sent.  The kernel says that it has no peer, and obeys.
  (catch 'system-error
    (lambda () (shutdown socket 1))
    (const #f))
  socket)

(define (listening-socket port)
  (let ((s (socket PF_INET (logior SOCK_DGRAM SOCK_CLOEXEC) 0)))
    (catch 'system-error
      (lambda ()
        (setsockopt s SOL_SOCKET SO_RCVBUF 1048576)
        (bind s AF_INET INADDR_LOOPBACK port))
      (lambda args
        (close-port s)
        (bight-raise 'io 'follow "cannot listen at port ~a of this machine: ~a" port
                     (strerror (system-error-errno args)))))
    (deaf-mute s)))

(define (hex text) (text->number text 16))

(define (owners-of-port port table)
  ;; The users who have a socket at PORT, by TABLE of the kernel, or #f where there is none.
  (and (file-exists? table)
       (call-with-input-file table
         (lambda (in)
           (let loop ((owners '()))
             (let ((line (read-line in)))
               (if (eof-object? line)
                   owners
                   (let ((words (string-tokenize line)))
                     (loop (if (and (> (length words) 7) (string-index (second words) #\:)
                                    (eqv? port (hex (last (string-split (second words) #\:)))))
                               (cons (text->number (list-ref words 7)) owners)
                               owners))))))))))

(define (trusted-port? port)
  ;; Is PORT held by the user or root, and by nobody else?  Where no kernel tells, nobody is asked.
  (let ((owners (filter identity (list (owners-of-port port "/proc/net/udp")
                                       (owners-of-port port "/proc/net/udp6")))))
    (or (null? owners)
        (let ((owners (concatenate owners)))
          (and (pair? owners)
               (every (lambda (owner) (or (eqv? owner 0) (eqv? owner (getuid)))) owners))))))

(define (sender-judge)
  ;; A procedure that tells whether a datagram from PORT may be listened to; it remembers whom it let in.
  (let ((known '()))
    (lambda (port)
      (or (and (memv port known) #t)
          (and (trusted-port? port)
               (begin (set! known (take (cons port known) (min 16 (+ 1 (length known))))) #t))))))

(define longest-datagram 65536)

(define (open-udp name tally keep)
  (let ((socket (listening-socket (loopback-port name)))
        (frames (make-frames 0 tally keep))
        (buffer (make-bytevector longest-datagram))
        (trusted? (sender-judge)))
    (make-source
     name socket #t
     (lambda ()
       (let* ((got (recvfrom! socket buffer)) (bytes (make-bytevector (car got))))
         (bytevector-copy! buffer 0 bytes 0 (car got))
         (cond ((trusted? (sockaddr:port (cdr got)))
                (let ((readings (take-frames! frames bytes)))
                  (append readings (end-frames! frames))))
               (else (tally! tally 'strangers) '())))))))


;;; Files, pipes and sockets that are files.

(define (from-port name port live? take end keep)
  (setvbuf port 'block 65536)
  (make-source
   name port live?
   (let ((ended? #f))
     (lambda ()
       (let ((bytes (if ended? (eof-object) (get-bytevector-some port))))
         (cond (ended? #f)
               ((eof-object? bytes) (set! ended? #t) (end))
               (else
                (when keep (keep bytes 0 (bytevector-length bytes)))
                (take bytes))))))))

(define (own-socket file)
  (let ((owner (stat:uid (stat file))))
    (unless (memv owner (list 0 (getuid)))
      (bight-raise 'io 'follow "the socket ~s belongs to somebody else" file))
    (let ((s (socket PF_UNIX (logior SOCK_STREAM SOCK_CLOEXEC) 0)))
      (connect s AF_UNIX file)
      (shutdown s 1)
      s)))

(define (port-of name)
  ;; A port that reads NAME, and whether what it reads is happening now.
  (catch 'system-error
    (lambda ()
      (if (string=? name "-")
          (values (fdes->inport 0) #t)
          (case (stat:type (stat name))
            ((regular) (values (open-file name "rb") #f))
            ((fifo) (values (open-file name "rb") #t))
            ((socket) (values (own-socket name) #t))
            (else (bight-raise 'io 'follow "~s is a ~a: telemetry comes from a file, a pipe or a socket" name
                               (stat:type (stat name)))))))
    (lambda args
      (bight-raise 'io 'follow "cannot read ~s: ~a" name (why-not name args)))))

(define (open-stream name tally keep)
  (call-with-values (lambda () (port-of name))
    (lambda (port live?)
      (if (tlog-name? name)
          (let ((frames (make-frames stamp-size tally)))
            (from-port name port live?
                       (lambda (bytes) (take-frames! frames bytes)) (lambda () (end-frames! frames)) keep))
          (let ((rows (make-rows name tally)))
            (from-port name port live?
                       (lambda (bytes) (take-rows! rows bytes)) (lambda () (end-rows! rows)) keep))))))

(define (stamped write-bytes)
  ;; A keeper of frames that writes each after its time, as a .tlog has it.
  (lambda (bytes start end)
    (let ((stamp (make-bytevector stamp-size)) (t (gettimeofday)))
      (bytevector-u64-set! stamp 0 (+ (* 1000000 (car t)) (cdr t)) (endianness big))
      (write-bytes stamp 0 stamp-size)
      (write-bytes bytes start end))))

(define* (open-source name tally #:optional (keep #f))
  "Open the telemetry NAME: udp:PORT, the file or pipe of a .tlog, or of a table with named columns, `-' for the
standard input, or a socket that is a file.  Count in TALLY what is wrong.  KEEP, a port, receives all that comes
from there, frames as a .tlog.  Raise a &bight-error of kind io or domain."
  (let ((write-bytes (and keep (lambda (bytes start end) (put-bytevector keep bytes start (- end start))))))
    (if (string-prefix? "udp:" name)
        (open-udp name tally (and write-bytes (stamped write-bytes)))
        (open-stream name tally write-bytes))))

(define (source-readings! source seconds)
  "Return the readings that come from SOURCE within SECONDS, a list; `nothing' if nothing came, #f at its end."
  (if (null? (first (select (list (source-port source)) '() '() seconds)))
      'nothing
      ((source-take source))))

(define (close-source! source)
  "Read no more from SOURCE."
  (close-port (source-port source)))
