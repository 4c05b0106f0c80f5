;;; (bight view text) --- pictures that are text, numbers as people read them.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view text)
  #:use-module ((bight core decimal) #:select (fixed text->number))
  #:use-module (bight core record)
  #:use-module ((bight outlet) #:select (watched?))
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (picture?
            picture-lines
            lines->picture
            terminal-columns
            bearing->string
            bearing-of
            current->string
            radian))


;;; Pictures: text that prints as itself.

(define-record <picture>
  (make-picture lines)
  picture?
  (lines picture-lines))

(set-record-type-printer! <picture>
  (lambda (picture port)
    (display (string-join (picture-lines picture) "\n") port)))

(define (lines->picture lines)
  "Return the picture whose text is LINES, a list of strings."
  (make-picture (map (lambda (line) (string-trim-right line #\space)) lines)))

(define (stty-columns)
  ;; The width that the terminal itself reports, or #f.
  (and (watched? (current-output-port))
       (false-if-exception
        (let* ((open (module-ref (resolve-interface '(ice-9 popen)) 'open-input-pipe))
               (close (module-ref (resolve-interface '(ice-9 popen)) 'close-pipe))
               (pipe (open "stty size < /dev/tty 2> /dev/null"))
               (rows (read pipe))
               (columns (read pipe)))
          (close pipe)
          (and (integer? rows) (integer? columns) columns)))))

(define (terminal-columns)
  "Return the number of columns of the terminal: from the variable COLUMNS, from the terminal, or 80."
  (let ((columns (or (and=> (getenv "COLUMNS") text->number) (stty-columns))))
    (if (and columns (exact-integer? columns) (> columns 0)) columns 80)))


;;; Numbers as people read them.

(define (bearing->string degrees)
  (string-pad (number->string (modulo (inexact->exact (round degrees)) 360)) 3 #\0))

(define radian (/ (acos -1) 180))

(define (bearing-of x y)
  (let ((degrees (/ (atan x y) radian)))
    (if (negative? degrees) (+ 360 degrees) degrees)))

(define (horizontal-speed v)
  (sqrt (+ (expt (first v) 2) (expt (second v) 2))))

(define (current->string v)
  ;; A current, a list of its components, as speed, arrow and bearing.
  (let* ((speed (horizontal-speed v))
         (toward (bearing-of (first v) (second v))))
    (if (< speed 0.005)
        "none"
        (string-append (fixed speed 2) " m/s " (arrow toward) " " (bearing->string toward)))))

(define (arrow bearing)
  (vector-ref #("^" "^>" "-->" "v>" "v" "<v" "<--" "<^")
              (modulo (inexact->exact (round (/ bearing 45))) 8)))
