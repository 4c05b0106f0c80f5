;;; (bight core npz) --- arrays of numbers in one file, as NumPy reads them.
;;;
;;; An .npz is a ZIP archive of .npy files, one for each array, here stored as they are (APPNOTE.TXT 6.3.3; NumPy
;;; Enhancement Proposal 1).  Nothing in it tells of the time or the machine: the same arrays are the same bytes.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core npz)
  #:use-module ((ice-9 binary-ports) #:select (open-bytevector-output-port put-bytevector))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (npz-bytes plain-names))


;;; Names.

(define (plain-name text)
  ;; TEXT as the name of a file in any archive: letters, digits, - _ and . within.
  (let ((name (string-trim-both
               (string-map (lambda (c)
                             (if (or (char-alphabetic? c) (char-numeric? c) (memv c '(#\- #\_ #\.))) c #\_))
                           text)
               (char-set #\_ #\.))))
    (cond ((string-null? name) "value")
          ((> (string-length name) 200) (substring name 0 200))
          (else name))))

(define (plain-names texts)
  "Return a name for each of TEXTS, strings, that any archive can hold; no two are the same."
  (reverse
   (fold (lambda (text names)
           (let ((name (plain-name text)))
             (let loop ((i 1))
               (let ((candidate (if (= i 1) name (simple-format #f "~a-~a" name i))))
                 (if (member candidate names)
                     (loop (+ i 1))
                     (cons candidate names))))))
         '() texts)))


;;; CRC-32.

(define crc-table
  (let ((table (make-u32vector 256)))
    (do ((n 0 (+ n 1)))
        ((= n 256) table)
      (u32vector-set! table n
                      (let loop ((c n) (k 0))
                        (cond ((= k 8) c)
                              ((odd? c) (loop (logxor #xedb88320 (ash c -1)) (+ k 1)))
                              (else (loop (ash c -1) (+ k 1)))))))))

(define (crc-32 bytes)
  (let ((n (bytevector-length bytes)))
    (let loop ((i 0) (c #xffffffff))
      (if (= i n)
          (logxor c #xffffffff)
          (loop (+ i 1)
                (logxor (u32vector-ref crc-table (logand #xff (logxor c (bytevector-u8-ref bytes i))))
                        (ash c -8)))))))


;;; Arrays.

(define (little value size)
  (let ((bytes (make-bytevector size)))
    (bytevector-uint-set! bytes 0 value (endianness little) size)
    bytes))

(define (joined parts)
  (call-with-values open-bytevector-output-port
    (lambda (port get)
      (for-each (lambda (part) (put-bytevector port part)) parts)
      (get))))

(define order (if (eq? 'little (native-endianness)) "<" ">"))

(define (npy-bytes shape numbers)
  ;; NUMBERS, an f64vector, as an array of SHAPE, a list of sizes.
  (let* ((text (simple-format #f "{'descr': '~af8', 'fortran_order': False, 'shape': (~a), }" order
                              (string-concatenate
                               (map (lambda (n) (simple-format #f "~a, " n)) shape))))
         (size (* 64 (ceiling-quotient (+ 11 (string-length text)) 64)))
         (head (string-append text (make-string (- size 11 (string-length text)) #\space) "\n")))
    (joined (list #vu8(#x93 78 85 77 80 89 1 0) (little (string-length head) 2) (string->utf8 head) numbers))))


;;; The archive.

(define (entry-facts name bytes)
  ;; What the archive says of an entry, before it and at its end.
  (joined (list (little 20 2) (little #x800 2) (little 0 2) (little 0 2) (little 33 2) ; 1980-01-01
                (little (crc-32 bytes) 4) (little (bytevector-length bytes) 4)
                (little (bytevector-length bytes) 4) (little (bytevector-length name) 2) (little 0 2))))

(define (local-entry name facts bytes)
  (joined (list (little #x04034b50 4) facts name bytes)))

(define (central-entry name facts offset)
  (joined (list (little #x02014b50 4) (little 20 2) facts (little 0 2) (little 0 2) (little 0 2) (little 0 4)
                (little offset 4) name)))

(define (npz-bytes arrays)
  "Return the bytes of an .npz file with ARRAYS, lists (NAME SHAPE NUMBERS): NAME a string as `plain-names'
returns, SHAPE a list of sizes, NUMBERS an f64vector.  All of it is smaller than 4 GB."
  (let loop ((rest arrays) (offset 0) (entries '()) (index '()))
    (if (null? rest)
        (let ((index (joined (reverse index))) (n (length arrays)))
          (joined (append (reverse entries)
                          (list index (little #x06054b50 4) (little 0 2) (little 0 2) (little n 2) (little n 2)
                                (little (bytevector-length index) 4) (little offset 4) (little 0 2)))))
        (let* ((name (string->utf8 (string-append (first (car rest)) ".npy")))
               (bytes (npy-bytes (second (car rest)) (third (car rest))))
               (facts (entry-facts name bytes))
               (entry (local-entry name facts bytes)))
          (loop (cdr rest) (+ offset (bytevector-length entry)) (cons entry entries)
                (cons (central-entry name facts offset) index))))))
