;;; (bight shell listen) --- sockets of one's own, and a prompt on one for an editor to talk to.
;;;
;;; Never on a network: the socket is a file that its owner alone can open, in a folder that he alone can
;;; enter.  Each client has a thread of its own, so that an endless loop typed there holds up nothing
;;; else.  A session is about the dive of the house, the one that the prompt or the pilot flies, as long
;;; as it is live: then what it does goes through the dive's queue, and what it asks is answered from a
;;; copy of its own.  Else it starts dives of its own.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell listen)
  #:use-module (bight core errors)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:use-module ((bight outlet) #:select (outlet))
  #:use-module ((ice-9 threads) #:select (call-with-new-thread current-thread))
  #:use-module ((bight shell repl) #:select (set-manners!))
  #:use-module ((system repl server) #:select (make-unix-domain-server-socket))
  #:use-module ((system repl repl) #:select (start-repl))
  #:export (start-listening!
            start-serving!
            stop-listening!))

(define the-sockets '())                ; their files, while there are any

(define (own-folder folder)
  ;; Make FOLDER for its owner alone, or raise.
  (unless (file-exists? folder)
    (mkdir folder #o700))
  (let ((s (lstat folder)))
    (unless (and (eq? 'directory (stat:type s)) (= (stat:uid s) (getuid))
                 (zero? (logand #o077 (stat:perms s))))
      (bight-raise 'io 'listen "the folder ~s must be yours alone (mode 700)" folder))
    folder))

(define (runtime-folder)
  (let ((runtime (getenv "XDG_RUNTIME_DIR")))
    (if (and runtime (string-prefix? "/" runtime) (file-exists? runtime))
        (string-append runtime "/bight")
        (string-append (or (getenv "TMPDIR") "/tmp") "/bight-" (number->string (getuid))))))

(define (usual-socket ending)
  ;; The file of the socket when none is named.
  (string-append (own-folder (runtime-folder)) "/" (number->string (getpid)) ending))

(define longest-name 107)               ; bytes of a socket's address

(define (answers? file)
  ;; #t if somebody listens at FILE.
  (let ((s (socket PF_UNIX SOCK_STREAM 0)))
    (dynamic-wind
      (const #f)
      (lambda () (false-if-exception (begin (connect s AF_UNIX file) #t)))
      (lambda () (close-port s)))))

(define (make-way! file)
  ;; A socket that nobody listens at is left from a process that was killed.
  (when (false-if-exception (lstat file))
    (cond ((not (eq? 'socket (stat:type (lstat file))))
           (bight-raise 'io 'listen "~s is there, and is no socket" file))
          ((answers? file)
           (bight-raise 'io 'listen "somebody listens at ~s already" file))
          (else (delete-file file)))))

(define (open-socket file)
  (when (> (string-length file) longest-name)
    (bight-raise 'io 'listen "the name of a socket has ~a letters at most: ~s" longest-name file))
  (make-way! file)
  (let ((mask (umask #o177)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (catch 'system-error
          (lambda () (make-unix-domain-server-socket #:path file))
          (lambda (key . arguments)
            (bight-raise 'io 'listen "cannot listen at ~s: ~a" file
                         (strerror (system-error-errno (cons key arguments)))))))
      (lambda () (umask mask)))))

;;; The dive of a session.

(define guests (make-weak-key-hash-table)) ; of threads: (HOST . GUEST)

(define (guest-of-house proc)
  ;; This thread's own handle of the house's dive.
  (let ((host (house-dive)) (known (hashq-ref guests (current-thread))))
    (cond ((not host) #f)
          ((and known (eq? host (car known)) (%live? (engine-of (cdr known)))) (cdr known))
          ((%live? (engine-of host))
           (let ((guest (guest-dive host)))
             (hashq-set! guests (current-thread) (cons host guest))
             guest))
          (else
           (bight-raise 'def proc
                        "the dive of the house stands still, so it is not shared; enter! one here")))))

(define (call-in-session thunk)
  (parameterize ((served? #t) (current-dive #f) (session-dive guest-of-house))
    (thunk)))


;;; Listening.

;; Guile's own server of prompts complains on the terminal whenever a client leaves.

(define (serve-prompt client)
  (let ((out (outlet client)))
    (parameterize ((current-input-port client) (current-output-port out)
                   (current-error-port out) (current-warning-port out))
      (with-fluids ((*repl-stack* '()))
        (start-repl)))
    (close-port out)))

(define (serve-or-forget serve client)
  ;; Whatever ends a session is its client's affair.
  (catch #t (lambda () (serve client)) (const #f))
  (false-if-exception (close-port client)))

(define (serve-all serve socket)
  (let loop ()
    (let ((client (false-if-exception
                   (begin
                     (select (list socket) '() '())
                     (car (accept socket))))))
      (if client
          (call-with-new-thread (lambda () (serve-or-forget serve client)))
          (sleep 1))
      (loop))))

(define (start-serving! file ending serve)
  "Listen at FILE, a socket made now, or at the usual one with ENDING for #f, until this process ends, and call
SERVE with the port of each client, in a thread of its own.  Return the file's name."
  (let* ((file (or file (usual-socket ending))) (socket (open-socket file)))
    (when (null? the-sockets)
      (set-manners!)
      (sigaction SIGPIPE SIG_IGN)       ; a client that goes is no end of ours
      (add-hook! exit-hook stop-listening!))
    (set! the-sockets (cons file the-sockets))
    (listen socket 5)
    (call-in-session
     (lambda () (call-with-new-thread (lambda () (serve-all serve socket)))))
    file))

(define (start-listening! file)
  "Serve a prompt at FILE, a socket made now, or at the usual one for #f, until this process ends.  Return the
file's name."
  (start-serving! file "" serve-prompt))

(define (stop-listening!)
  "Stop what `start-serving!' and `start-listening!' began."
  (for-each (lambda (file) (false-if-exception (delete-file file))) the-sockets)
  (set! the-sockets '()))
