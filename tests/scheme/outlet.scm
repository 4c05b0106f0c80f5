;;; What a terminal obeys does not reach it by text of whatever origin.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight core markup) #:select (as-xml csv-line))
             ((bight outlet) #:select (behind control outlet shown))
             ((ice-9 binary-ports) #:select (put-bytevector))
             ((rnrs bytevectors) #:select (string->utf8 bytevector-length u8-list->bytevector))
             ((srfi srfi-1) #:select (iota remove)))

(define obeyed
  ;; Written anew, not taken from the engine: C0 but line feed and tabulator, DEL, C1, what turns lines.
  (append (remove (lambda (n) (memv n '(9 10))) (iota 32)) (list #x7f) (iota 32 #x80)
          '(#x61c #x200e #x200f #x2028 #x2029 #x202a #x202b #x202c #x202d #x202e #x2066 #x2067 #x2068 #x2069)))

(define harmless (append (iota 95 32) '(9 10 #xa0 #xe9 #x3b1 #x200d #x2027 #x2030 #x2580 #xffff #x1f41f)))

(define (obeyed? c) (memv (char->integer c) obeyed))

(define (random-string)
  (list->string
   (map (lambda (i)
          (integer->char (let ((from (if (zero? (random 2)) obeyed harmless)))
                           (list-ref from (random (length from))))))
        (iota (random 40)))))

(define (safe? text)
  ;; A carriage return before a line feed ends a line, no more.
  (let loop ((rest (string->list text)))
    (cond ((null? rest) #t)
          ((and (eqv? #\return (car rest)) (pair? (cdr rest)) (eqv? #\newline (cadr rest))) (loop (cddr rest)))
          ((obeyed? (car rest)) #f)
          (else (loop (cdr rest))))))

(define (sent-by proc)
  ;; What PROC, called with an outlet, sends through it, all flushed.
  (call-with-output-string
    (lambda (port)
      (set-port-encoding! port "UTF-8")
      (let ((out (outlet port)))
        (proc out)
        (display "." out)               ; what is held back goes out with it
        (force-output out)))))

(define (pieces text)
  (if (string-null? text)
      '()
      (let ((n (+ 1 (random (string-length text)))))
        (cons (substring text 0 n) (pieces (substring text n))))))

(define-scenario every-character
  "Of all characters there are, those alone are escaped that a terminal obeys, and none else is changed."
  (let loop ((n 0) (wrong '()))
    (cond ((> n #x10ffff) (expect wrong => '()))
          ((<= #xd800 n #xdfff) (loop #xe000 wrong))
          (else
           (let* ((text (string (integer->char n))) (right? (eq? (string=? text (shown text)) (not (memv n obeyed)))))
             (loop (+ n 1) (if right? wrong (cons n wrong))))))))

(define-scenario any-text
  "Any text is shown without what a terminal obeys, in whatever pieces it comes, and once is enough."
  (do ((i 0 (+ i 1))) ((= i 2000))
    (let* ((text (random-string)) (clean (shown text)))
      (require (safe? clean))
      (require (shown clean) => clean)
      (require (sent-by (lambda (out) (for-each (lambda (part) (display part out) (force-output out)) (pieces text))))
               => (shown (string-append text "."))))))

(define-scenario any-bytes
  "Bytes that are no text are shown too, cut wherever."
  (do ((i 0 (+ i 1))) ((= i 2000))
    (let ((bytes (map (lambda (i) (random 256)) (iota (random 40)))))
      (require (safe? (sent-by (lambda (out)
                                 (for-each (lambda (byte)
                                             (put-bytevector out (u8-list->bytevector (list byte)))
                                             (when (zero? (random 3)) (force-output out)))
                                           bytes))))))))

(define-scenario what-bight-sends
  "What is meant to be obeyed goes to the port behind, in its place among the text."
  (expect (call-with-output-string
            (lambda (port)
              (let ((out (outlet port)))
                (display "a\x1b" out)
                (control "\x1b[K" out)
                (display "b" out)
                (force-output out)
                (expect (behind out) is (lambda (p) (eq? p port))))))
          => "a\\x1b\x1b[Kb"))

(define-scenario closed
  "When the port behind is closed first, nothing is raised."
  (let* ((port (open-output-string)) (out (outlet port)))
    (display "late" out)
    (close-port port)
    (force-output out)
    (expect #t)))

(define-scenario within-formats
  "In XML and in CSV text is neither obeyed by a terminal nor by the format."
  (do ((i 0 (+ i 1))) ((= i 500))
    (let* ((text (random-string)) (xml (as-xml text)))
      (require (safe? xml))
      (require (not (string-any (char-set #\< #\> #\" #\' #\newline #\xffff) xml)))
      (require (safe? (csv-line (list text 1 #f))))))
  (expect (csv-line (list "a,b" "say \"x\"" 2 #f "c")) => "\"a,b\",\"say \"\"x\"\"\",2,,c")
  (expect (as-xml "a<b>&'\"\n") => "a&lt;b&gt;&amp;&#39;&quot;&#10;"))
