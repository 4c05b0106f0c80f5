;;; (bight core yaml) --- the part of YAML that OrcaFlex writes: mappings and sequences by indentation, lists in brackets,
;;; plain and quoted words, remarks.
;;;
;;; No anchors, no tags, no text over several lines.  A mapping is an alist of strings in its order, a sequence a
;;; vector, a word a string, `~' #f.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core yaml)
  #:use-module (bight core errors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-11)
  #:export (parse-yaml))

(define deepest 20)                     ; of mappings, sequences and lists within each other


;;; Lines: (NUMBER INDENTATION TEXT), without remarks and blank ones.

(define (without-remark text)
  ;; TEXT up to a # at its beginning or after a blank, outside quotes.
  (let loop ((i 0) (quoted #f))
    (cond ((= i (string-length text)) text)
          (quoted (loop (+ i 1) (if (char=? quoted (string-ref text i)) #f quoted)))
          ((memv (string-ref text i) '(#\" #\')) (loop (+ i 1) (string-ref text i)))
          ((and (char=? #\# (string-ref text i))
                (or (= i 0) (char-whitespace? (string-ref text (- i 1)))))
           (substring text 0 i))
          (else (loop (+ i 1) #f)))))

(define byte-order-mark #\xfeff)

(define (plain-lines entries)
  (filter-map (lambda (entry)
                (let* ((text (string-trim (cdr entry) byte-order-mark))
                       (kept (string-trim-right (without-remark text)))
                       (indent (or (string-skip kept #\space) 0)))
                  (and (not (string-null? kept))
                       (not (string-prefix? "%" kept)) (not (member kept '("---" "...")))
                       (list (car entry) indent (substring kept indent)))))
              entries))


;;; Words and lists.

(define (word text)
  (let ((n (string-length text)))
    (cond ((member text '("~" "" "null")) #f)
          ((and (>= n 2) (memv (string-ref text 0) '(#\" #\'))
                (char=? (string-ref text 0) (string-ref text (- n 1))))
           (substring text 1 (- n 1)))
          (else text))))

(define (split-list text)
  ;; The items of TEXT, what is between brackets, parted by its own commas.
  (let loop ((i 0) (from 0) (depth 0) (items '()))
    (cond ((= i (string-length text))
           (reverse (if (string-null? (string-trim-both (substring text from)))
                        items
                        (cons (string-trim-both (substring text from)) items))))
          ((char=? #\[ (string-ref text i)) (loop (+ i 1) from (+ depth 1) items))
          ((char=? #\] (string-ref text i)) (loop (+ i 1) from (- depth 1) items))
          ((and (char=? #\, (string-ref text i)) (= depth 0))
           (loop (+ i 1) (+ i 1) 0 (cons (string-trim-both (substring text from i)) items)))
          (else (loop (+ i 1) from depth items)))))

(define* (value text #:optional (room deepest))
  (let ((n (string-length text)))
    (if (and (>= n 2) (> room 0) (char=? #\[ (string-ref text 0)) (char=? #\] (string-ref text (- n 1))))
        (list->vector (map (lambda (item) (value item (- room 1))) (split-list (substring text 1 (- n 1)))))
        (word text))))


;;; Blocks.

(define (quoted-part text)
  ;; How much of TEXT, from its beginning, stands in quotes.
  (if (memv (string-ref text 0) '(#\" #\'))
      (or (string-index text (string-ref text 0) 1) 0)
      0))

(define (key-end text)
  ;; Where the colon of a key of TEXT is, or #f.
  (let loop ((from (quoted-part text)))
    (let ((colon (string-index text #\: from)))
      (cond ((or (not colon) (char=? #\[ (string-ref text 0))) #f)
            ((or (= (+ colon 1) (string-length text)) (char=? #\space (string-ref text (+ colon 1)))) colon)
            (else (loop (+ colon 1)))))))

(define (item? line) (or (string=? "-" (third line)) (string-prefix? "- " (third line))))

(define (opened line)
  ;; The LINE of an item without its hyphen, further in.
  (let* ((text (third line)) (skip (or (string-skip text #\space 1) (string-length text))))
    (list (first line) (+ (second line) skip) (substring text skip))))

(define (parse-yaml proc file lines)
  "Return what LINES of FILE, (NUMBER . TEXT), say.  Raise a &bight-error from PROC of kind format, which tells the line."
  (define (refuse line what)
    (bight-raise 'format proc "~a, line ~a: ~a" file (first line) what))
  (define (block lines room)
    ;; Two values: what the block at the beginning of LINES says, and the lines behind it.
    (when (= room 0) (refuse (car lines) "more within each other than is read"))
    (cond ((item? (car lines)) (sequence lines (second (car lines)) room '()))
          ((key-end (third (car lines))) (mapping lines (second (car lines)) room '()))
          (else (values (value (third (car lines))) (cdr lines)))))
  (define (sequence lines indent room items)
    (if (and (pair? lines) (= indent (second (car lines))) (item? (car lines)))
        (let*-values (((first-line) (opened (car lines)))
                      ((item rest) (if (string-null? (third first-line))
                                       (nested (cdr lines) indent room)
                                       (block (cons first-line (cdr lines)) (- room 1)))))
          (sequence rest indent room (cons item items)))
        (values (list->vector (reverse items)) lines)))
  (define (nested lines indent room)
    (if (and (pair? lines) (or (> (second (car lines)) indent)
                               (and (= (second (car lines)) indent) (item? (car lines)))))
        (block lines (- room 1))
        (values #f lines)))
  (define (mapping lines indent room entries)
    (cond ((or (null? lines) (< (second (car lines)) indent)) (values (reverse entries) lines))
          ((or (> (second (car lines)) indent) (item? (car lines)))
           (if (item? (car lines))
               (values (reverse entries) lines)
               (refuse (car lines) "further in than what is beside it")))
          (else
           (let* ((text (third (car lines))) (colon (key-end text)))
             (unless colon (refuse (car lines) "a name and a colon were expected"))
             (let ((key (word (string-trim-both (substring text 0 colon))))
                   (rest (string-trim-both (substring text (+ colon 1)))))
               (let*-values (((said behind) (if (string-null? rest)
                                                (nested (cdr lines) indent room)
                                                (values (value rest) (cdr lines)))))
                 (mapping behind indent room (acons (or key "") said entries))))))))
  (let ((lines (plain-lines lines)))
    (if (null? lines)
        '()
        (let-values (((all rest) (block lines deepest)))
          (unless (null? rest) (refuse (car rest) "it belongs to nothing before it"))
          all))))
