;;; Measures of the house: guile -s tests/measures.scm [ROOT]
;;;
;;; How long functions are, how much of the code is comment, how many static functions share a name, how
;;; many words of long comment sentences only point at others ("it", "that", "which"), which of the words
;;; that HACKING.md's glossary replaced are left, how many internal functions have no caller in another file of
;;; src, which counts of lines in HACKING.md are stale, how many calls lead from the step of a dive to the line that
;;; applies friction, how many lines touching takes, how many constants are tuned, how large the rooms are.
;;; tests/house.sh holds the measures to their bounds.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (ice-9 format)
             (ice-9 ftw)
             (ice-9 regex)
             (ice-9 textual-ports)
             (srfi srfi-1)
             (srfi srfi-13)
             ((srfi srfi-43) #:select (vector-for-each)))

(define root (or (false-if-exception (cadr (program-arguments))) "."))

(define (files-below folder . endings)
  ;; The files below FOLDER that end with one of ENDINGS, in order.
  (define found '())
  (nftw (string-append root "/" folder)
        (lambda (name info flag base level)
          (when (and (eq? 'regular flag) (any (lambda (end) (string-suffix? end name)) endings))
            (set! found (cons name found)))
          #t))
  (sort found string<?))

(define (text-of file)
  (call-with-input-file file get-string-all #:encoding "UTF-8"))

(define (room-of file)
  (basename (dirname file)))

(define (percent part whole)
  (if (zero? whole) 0 (* 100. (/ part whole))))


;;; Functions.

;; The name of a function whose definition begins here, at the beginning of a line, and its first brace.
(define head (make-regexp "^([a-z_][A-Za-z0-9_]*) \\(.*$"))

(define (functions text)
  ;; Those that TEXT, laid out as .clang-format has it, defines: lists (NAME LINES STATIC? BODY), BODY being the
  ;; lines from the name on.  A definition is a line with its type, a line that begins with its name, more of its
  ;; arguments, a line `{' ... a line `}'.
  (define lines (list->vector (string-split text #\newline)))
  (define n (vector-length lines))
  (define (line i) (if (< i n) (vector-ref lines i) ""))
  (define (find-line i wanted)
    (cond ((>= i n) #f)
          ((string=? wanted (line i)) i)
          (else (find-line (+ i 1) wanted))))
  (define (opening i)
    ;; The line `{' of the definition whose name is on line I, or #f: it is none.
    (cond ((string=? "{" (line i)) i)
          ((or (>= i n) (string-index (line i) #\;) (string-null? (line i))) #f)
          (else (opening (+ i 1)))))
  (let loop ((i 1) (found '()))
    (if (>= i n)
        (reverse found)
        (let* ((m (regexp-exec head (line i)))
               (open (and m (opening i)))
               (close (and open (find-line open "}"))))
          (if close
              (loop (+ close 1)
                    (cons (list (match:substring m 1)
                                (- close open 1)
                                (string-prefix? "static " (line (- i 1)))
                                (map line (iota (- close i) i)))
                          found))
              (loop (+ i 1) found))))))


;;; Comments.

(define (comments text)
  ;; The comments /* ... */ of TEXT.
  (let loop ((from 0) (found '()))
    (let* ((start (string-contains text "/*" from))
           (end (and start (string-contains text "*/" start))))
      (if end
          (loop (+ end 2) (cons (substring text start (+ end 2)) found))
          (reverse found)))))

(define (lines-in text)
  (+ 1 (string-count text #\newline)))

(define pointing
  '("it" "its" "itself" "that" "this" "what" "which" "who" "whom" "whose" "one" "ones" "such" "there"
    "other" "others" "another" "former" "latter" "they" "them" "their" "those" "these" "so"))

(define (sentences comment)
  ;; Lists of the words of COMMENT, a list for each sentence.
  (define text (string-downcase (regexp-substitute/global #f "\\s*\n[ \t*]*" comment 'pre " " 'post)))
  (map (lambda (sentence) (map match:substring (list-matches "[a-z']+" sentence)))
       (string-split (regexp-substitute/global #f "([.;:?!]) +" text 'pre 1 "\n" 'post) #\newline)))

(define long-sentence 14)               ; words

(define (pointing-share comments)
  ;; Of the words of long sentences in COMMENTS, how many only point, per cent.
  (define words (concatenate (filter (lambda (s) (>= (length s) long-sentence))
                                     (append-map sentences comments))))
  (percent (count (lambda (word) (member word pointing)) words) (length words)))


;;; The measures.

(define texts (map (lambda (file) (cons file (text-of file))) (files-below "src" ".c" ".h")))
(define sources (filter (lambda (entry) (string-suffix? ".c" (car entry))) texts))

(define all-functions
  ;; (FILE NAME LINES STATIC? BODY)
  (append-map (lambda (entry) (map (lambda (f) (cons (car entry) f)) (functions (cdr entry)))) sources))

(define (quantile sorted share)
  (list-ref sorted (min (- (length sorted) 1) (inexact->exact (floor (* share (length sorted)))))))

(define static-names (make-hash-table))
(for-each (lambda (f)
            (when (fourth f)
              (hash-set! static-names (second f)
                         (lset-adjoin string=? (hash-ref static-names (second f) '()) (first f)))))
          all-functions)

(define (shared-names test)
  (sort (hash-map->list (lambda (name files) name)
                        (let ((some (make-hash-table)))
                          (hash-for-each (lambda (name files)
                                           (when (test files) (hash-set! some name files)))
                                         static-names)
                          some))
        string<?))

(define (in-two-files? files)
  (> (length files) 1))

(define (twice-in-a-room? files)
  (let ((rooms (map room-of files)))
    (< (length (delete-duplicates rooms)) (length rooms))))

;; Words that the field's replaced.
(define private-words
  '("bt__ghost" "bt__lane" "bt__shore" "gaze" "bt__drape" "bt__anchor" "bt__bends" "bt__dynamic_row"
    "nonzero" "Nonzero"))

(define (occurrences word text)
  (let loop ((from 0) (n 0))
    (let ((at (string-contains text word from)))
      (if at (loop (+ at 1) (+ n 1)) n))))

;; Words of the field, by which an engineer looks for a mechanism.
(define field-words '("constraint" "manifold" "broad phase" "time of impact" "closest point" "warm start"))

;;; Public functions that a comment speaks of.

(define public-declaration (make-regexp "^[a-z][^;]*[ *]bt_[a-z0-9_]+ \\(" regexp/extended))

(define public-functions
  ;; (COMMENTED? . LINE) of each function declared in src/bight: commented if a comment stands before it in the
  ;; paragraph of its declaration.
  (append-map
   (lambda (file)
     (append-map
      (lambda (paragraph)
        (filter-map (lambda (line)
                      (and (regexp-exec public-declaration line)
                           (let ((comment (string-contains paragraph "/*")))
                             (cons (and comment (< comment (string-contains paragraph line))) line))))
                    (string-split paragraph #\newline)))
      (map string-trim-both (string-split (regexp-substitute/global #f "\n\n" (text-of file) 'pre "\f" 'post)
                                          #\page))))
   (files-below "src/bight" ".h")))

;;; Internal functions that no other file of src names: dead, called by tests alone, or to be static.

(define (without-comments text)
  (let loop ((from 0) (parts '()))
    (let* ((start (string-contains text "/*" from))
           (end (and start (string-contains text "*/" start))))
      (if end
          (loop (+ end 2) (cons (substring text from start) parts))
          (string-concatenate-reverse (cons (substring text from) parts))))))

(define internal (make-regexp "bt__[a-z0-9_]+"))

(define namings
  ;; Of each internal name the files that name it, a file as often as it does.
  (let ((table (make-hash-table)))
    (for-each (lambda (file)
                (for-each (lambda (m)
                            (let ((name (match:substring m)))
                              (hash-set! table name (cons file (hash-ref table name '())))))
                          (list-matches internal (without-comments (text-of file)))))
              (files-below "src" ".c" ".h" ".cc"))
    table))

(define (lonely? file name)
  ;; True if no file of src but FILE calls NAME; a header that names it once declares it.
  (let ((others (delete file (hash-ref namings name '()))))
    (null? (filter (lambda (other)
                     (or (not (string-suffix? ".h" other)) (> (count (lambda (f) (string=? f other)) others) 1)))
                   others))))

(define lonely-functions
  (filter (lambda (f)
            (and (not (fourth f)) (string-prefix? "bt__" (second f)) (lonely? (first f) (second f))))
          all-functions))


;;; How far it is from the step of a dive to friction: the fewest calls, each named in the caller's text.

(define defined (make-hash-table))      ; name -> functions of that name
(for-each (lambda (f) (hash-set! defined (second f) (cons f (hash-ref defined (second f) '()))))
          all-functions)

(define word (make-regexp "[A-Za-z_][A-Za-z0-9_]*"))

(define (named-in f)
  ;; The functions that the text of F names: of the same file first, else those that are not static.
  (append-map
   (lambda (name)
     (let* ((all (hash-ref defined name '()))
            (near (filter (lambda (other) (string=? (first f) (first other))) all)))
       (if (pair? near) near (remove fourth all))))
   (delete-duplicates
    (append-map (lambda (line) (map match:substring (list-matches word line))) (cdr (fifth f))))))

(define (calls-between from to)
  ;; The functions from the one called FROM to the one called TO, by the fewest calls; () if there are none.
  (define seen (make-hash-table))
  (let loop ((ways (list (list (car (hash-ref defined from '((#f #f 0 #f ("")))))))))
    (cond ((null? ways) '())
          ((find (lambda (way) (equal? to (second (car way)))) ways) => reverse)
          (else
           (loop (append-map
                  (lambda (way)
                    (filter-map (lambda (next)
                                  (and (not (hashq-ref seen next))
                                       (begin (hashq-set! seen next #t) (cons next way))))
                                (named-in (car way))))
                  ways))))))

(define to-friction
  ;; The form of a tether is a table, by which bring_to_ends calls bt__step_chain.
  (append (calls-between "bt_dive_step" "bring_to_ends")
          (calls-between "bt__step_chain" "assemble_row")))


;;; What touching takes: contact, and what of collide and of the cable's solver is there for it alone.

(define touching
  (append-map (lambda (pattern)
                (filter (lambda (entry) (regexp-exec (make-regexp pattern regexp/extended) (car entry))) texts))
              '("/contact/" "/collide/(cast|safe|sweep|advance)" "/tether/dynamic_(contact|couple|pair|bent|hold)")))

;; A constant is tuned if a line of its own defines it, with a number that is no whole one.
(define tuned (make-regexp "^#define [A-Z_]+ +\\(?-?[0-9.]+(e-?[0-9]+)?\\)?( |$)" regexp/extended))
(define whole (make-regexp "^#define [A-Z_]+ +\\(?-?[0-9]+\\)?( |$)" regexp/extended))

(define (whole-lines text)
  ;; The lines of TEXT, of which some go on in the next.
  (string-split (regexp-substitute/global #f "\\\\\n" text 'pre 'post) #\newline))

(define tuning-constants
  (filter (lambda (line) (and (regexp-exec tuned line) (not (regexp-exec whole line))))
          (append-map (lambda (entry) (whole-lines (cdr entry))) touching)))


;;; Counts of lines in HACKING.md.

(define (source-named text)
  ;; The files that TEXT, a file or a folder of src or a Scheme module, names.
  (cond ((string-suffix? "/" text) (files-below (string-drop-right text 1) ".c" ".h"))
        ((string-index text #\/) (list (string-append root "/" text)))
        (else (filter (lambda (file) (string=? text (basename file))) (files-below "scheme" ".scm")))))

(define told-count (make-regexp "^ *\\| ([^|]*) \\(([^|)]*)\\) \\| ([0-9]+) \\|"))

(define (line-counts)
  ;; Lists (ROW TOLD COUNTED) of the rows of tables that tell how many lines the files have that they name.
  (filter-map
   (lambda (line)
     (let ((m (regexp-exec told-count line)))
       (and m
            (list (match:substring m 1)
                  (string->number (match:substring m 3))
                  (fold (lambda (name sum)
                          (fold (lambda (file sum) (+ sum (string-count (text-of file) #\newline)))
                                sum (source-named (match:substring name 1))))
                        0 (list-matches "`([^`]+)`" (match:substring m 2)))))))
   (string-split (text-of (string-append root "/HACKING.md")) #\newline)))

(define (stale? row)
  ;; True if a count is wrong by more than a tenth.
  (> (abs (- (second row) (third row))) (/ (third row) 10)))

(define lengths (sort (map third all-functions) <))
(define all-comments (append-map (lambda (entry) (comments (cdr entry))) texts))

(define (total f entries)
  (fold + 0 (map f entries)))

(define measures
  `((lines . ,(total (lambda (entry) (string-count (cdr entry) #\newline)) texts))
    (function-median . ,(quantile lengths 0.5))
    (function-95 . ,(quantile lengths 0.95))
    (function-longest . ,(last lengths))
    (comment-share . ,(percent (total (lambda (entry) (total lines-in (comments (cdr entry)))) sources)
                               (total (lambda (entry) (string-count (cdr entry) #\newline)) sources)))
    (public-functions . ,(length public-functions))
    (public-functions-commented . ,(percent (count car public-functions) (length public-functions)))
    (shared-static-names . ,(percent (length (shared-names in-two-files?))
                                     (hash-count (const #t) static-names)))
    (static-names-twice-in-a-room . ,(length (shared-names twice-in-a-room?)))
    (pointing-words . ,(pointing-share all-comments))
    (private-words . ,(total (lambda (word) (total (lambda (entry) (occurrences word (cdr entry))) texts))
                             private-words))
    (lonely-functions . ,(length lonely-functions))
    (calls-to-friction . ,(- (length to-friction) 1))
    (files-to-friction . ,(length (delete-duplicates (map first to-friction))))
    (lines-touching . ,(total (lambda (entry) (string-count (cdr entry) #\newline)) touching))
    (tuning-constants . ,(length tuning-constants))
    (line-counts . ,(length (line-counts)))
    (stale-line-counts . ,(count stale? (line-counts)))
    (flat-modules . ,(length (filter (lambda (name) (string-suffix? ".scm" name))
                                     (scandir (string-append root "/scheme/bight")))))))

(for-each (lambda (measure)
            (format #t "~a ~a~%" (car measure)
                    (let ((value (cdr measure)))
                      (if (exact? value) value (format #f "~,1f" value)))))
          measures)

(define (print-rooms)
  (define rooms (delete-duplicates (map (lambda (entry) (room-of (car entry))) texts)))
  (for-each (lambda (room)
              (format #t "room ~a ~a~%" room
                      (total (lambda (entry)
                               (if (string=? room (room-of (car entry)))
                                   (string-count (cdr entry) #\newline)
                                   0))
                             texts)))
            rooms))
(print-rooms)

(for-each (lambda (word)
            (format #t "word ~a: ~a~%" word
                    (total (lambda (entry) (occurrences word (string-downcase (cdr entry)))) texts)))
          field-words)
(format #t "friction ~a~%" (string-join (map second to-friction)))
(for-each (lambda (f) (format #t "lonely ~a ~a~%" (second f) (basename (first f)))) lonely-functions)
(for-each (lambda (row) (format #t "lines ~a: ~a told, ~a counted~%" (first row) (second row) (third row)))
          (filter stale? (line-counts)))
