;;; (bight core landlock) --- letting the kernel refuse a process paths, programs and ports, for good.
;;;
;;; Landlock is in Linux since 5.13, where its administrator has not turned it off; it takes no rights to
;;; use.  What is taken away cannot be had back, by this process or by those it starts.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core landlock)
  #:use-module (rnrs bytevectors)
  #:use-module (system foreign)
  #:export (close-paths!))

(define (foreign name return arguments)
  (let ((address (false-if-exception (dynamic-func name (dynamic-link)))))
    (and address (pointer->procedure return address arguments))))

;; The numbers of Landlock's system calls are the same on all machines.
(define create-ruleset 444)
(define add-rule 445)
(define restrict-self 446)
(define beneath-path 1)
(define no-new-privileges 38)
(define path-only #o10000000)           ; O_PATH

(define start-programs 1)
(define read-files-and-folders 12)
(define (write-paths version)
  ;; To write a file; to remove, to make; to refer to one in another folder; to truncate.
  (logior 2 (ash #x1ff 4)
          (if (>= version 2) (ash 1 13) 0)
          (if (>= version 3) (ash 1 14) 0)))

(define ports 3)                        ; to bind one, to connect to one: from version 4 on

(define (word bytes n value)
  (bytevector-u64-native-set! bytes (* 8 n) value))

(define (allow-beneath! syscall rules folder access)
  ;; Of a file, as of a null device, only what can be done to a file.
  (let* ((port (open folder path-only))
         (rule (make-bytevector 12 0))
         (folder? (eq? 'directory (stat:type (stat folder)))))
    (word rule 0 (if folder? access (logand access (logior 6 (ash 1 14)))))
    (bytevector-s32-native-set! rule 8 (fileno port))
    (let ((status (syscall add-rule rules beneath-path (pointer-address (bytevector->pointer rule)) 0)))
      (close-port port)
      (zero? status))))

(define (allow-all! syscall rules paths access)
  (and-map (lambda (path) (allow-beneath! syscall rules path access)) paths))

(define* (close-paths! #:key (but '()) reading (programs? #f))
  "Let the kernel refuse this process, from now on, to write, make, move or remove anything but what lies in
the folders or is one of the files of the list BUT, to bind or reach a port, and, unless PROGRAMS?, to start
a program.  If READING is a list of folders and files, refuse to read all others.  Return #t if it does."
  (let ((syscall (foreign "syscall" long (list long uintptr_t size_t uintptr_t uint32)))
        (prctl (foreign "prctl" int (list int unsigned-long unsigned-long unsigned-long unsigned-long)))
        (attributes (make-bytevector 16 0)))
    (and syscall prctl
         (let ((version (syscall create-ruleset 0 0 1 0)))
           (and (>= version 1)
                (let ((writing (write-paths version)))
                  (word attributes 0 (logior writing
                                             (if programs? 0 start-programs)
                                             (if reading read-files-and-folders 0)))
                  (word attributes 1 (if (>= version 4) ports 0))
                  (let ((rules (syscall create-ruleset (pointer-address (bytevector->pointer attributes))
                                        (if (>= version 4) 16 8) 0 0)))
                    (and (>= rules 0)
                         (allow-all! syscall rules but
                                     (if reading (logior writing read-files-and-folders) writing))
                         (allow-all! syscall rules (or reading '()) read-files-and-folders)
                         (zero? (prctl no-new-privileges 1 0 0 0))
                         (zero? (syscall restrict-self rules 0 0 0))))))))))
