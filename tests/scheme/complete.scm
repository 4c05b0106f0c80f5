;;; What Tab offers is what may stand there, whatever was typed before.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight shell complete)
             (bight shell cursor)
             (bight core schema)
             ((bight core errors) #:select (nearest))
             ((bight engine) #:select (%worlds-folder))
             ((bight core verb) #:select (verb-arguments verb? verb-usage))
             (ice-9 textual-ports)
             ((srfi srfi-1) #:hide (every))
             ((srfi srfi-1) #:select ((every . all?))))

(define here (current-module))

(define (words-after text)
  "Return the words offered after TEXT."
  (save-module-excursion
   (lambda ()
     (set-current-module here)
     (map candidate-word (candidates-after text)))))

(define (verbs)
  (filter-map (lambda (name)
                (let ((value (module-ref (resolve-interface '(bight)) name)))
                  (and (verb? value) (cons name value))))
              (language-names)))

(define (keywords verb)
  (filter-map (lambda (row) (and (eq? 'key (first row)) (simple-format #f "~s" (second row))))
              (verb-arguments verb)))

(define-scenario keywords-of-this-verb
  "After #: there are the keywords of the verb, all of them and no others; those that are given already are not
offered again."
  (expect (length (verbs)) is (above 200))
  (expect (filter-map (lambda (entry)
                        (let ((offered (words-after (simple-format #f "(list (~a #:" (car entry)))))
                          (and (not (eq? (car entry) 'alter!))
                               (not (equal? offered (keywords (cdr entry))))
                               (list (car entry) offered))))
                      (verbs))
          => '())
  (expect (words-after "(drive! #:surge 0.5 #:") => '("#:sway" "#:heave" "#:yaw"))
  (expect (words-after "(drive! #:s") => '("#:surge" "#:sway")))

(define-scenario names-of-this-kind
  "After a quote there are names of the kind that the verb asks for."
  (in (extend 'pile
              (sphere (named far) (at 40 0 -5) (radius 1))
              (sphere (named by) (at 0 -9 -4) (radius 1))))
  (expect (words-after "(winding '") is (lambda (words) (equal? (last words) "line")))
  (let ((objects (drop-right (words-after "(winding '") 1)))
    (expect (lset= string=? objects '("p1" "far" "by")) => #t)
    (expect (apply <= (map (lambda (name) (clearance (string->symbol name))) objects)) => #t))
  (expect (words-after "(winding 'line '") => (drop-right (words-after "(winding '") 1))
  (expect (words-after "(enter! '") => (map symbol->string (worlds)))
  (expect (words-after "(enter! 'pil") => '("pile"))
  (expect (words-after "(snapshot \"x.png\" #:paint '") => '("plain" "tension" "curvature" "model"))
  (expect (words-after "(place! '(1 2 3) #:fresh #t) (tether-model! 'dyn") => '("dynamic"))
  (expect (words-after "(on 'tou") => '("touched"))
  (expect (words-after "(alter! 'line #:cd") => '("#:cdn" "#:cdt"))
  (expect (words-after "(alter! 'sea #:dens") => '("#:density")))

(define-scenario fields-of-this-part
  "In a world there are the kinds of parts, the fields of the part, the words of the field."
  (expect (words-after "(world (") => (map symbol->string (part-heads)))
  (expect (filter-map (lambda (head)
                        (let ((offered (words-after (simple-format #f "(world (sea (depth 3)) (~a (" head))))
                          (and (not (equal? offered (map symbol->string (head-names head))))
                               (list head offered))))
                      (delete 'group (part-heads)))
          => '())
  (expect (words-after "(define-world w \"(\" (tether (model ca") => '("catenary" "catenary-simplex"))
  (expect (words-after "(world (rov (type falc") => '("falcon")))

(define (meanings-after text)
  "Return the choices after TEXT with their meanings."
  (save-module-excursion
   (lambda ()
     (set-current-module here)
     (map (lambda (c) (cons (candidate-word c) (candidate-meaning c))) (candidates-after text)))))

(define-scenario meanings
  "Whatever is offered has a meaning in one line: of a verb its first sentence, of a keyword what it takes and
what stands for it when it is left out."
  (in pile)
  (expect (filter (lambda (entry) (or (string-null? (cdr entry)) (string-index (cdr entry) #\newline)))
                  (append-map meanings-after '("(ha" "(enter! '" "(world (tether (" "(world (" "(winding '")))
          => '())
  (expect (meanings-after "(pay-out! 3 #:") => '(("#:rate" . "m/s; a number above 0 and at most 1e12; 0.5 when left out")))
  (expect (assoc-ref (meanings-after "(haul-i") "haul-in!") is (lambda (text) (string-prefix? "Haul METRES" text))))

(define (all-text folder)
  (string-concatenate
   (map (lambda (file) (call-with-input-file (string-append folder "/" file) get-string-all))
        ((@ (ice-9 ftw) scandir) folder (lambda (file) (string-suffix? ".scm" file))))))

(define-scenario whatever-was-typed
  "The cursor is known after any beginning of any text, also a spoilt one, and as deep as its parentheses are."
  (let* ((text (substring (all-text (%worlds-folder)) 0 3000))
         (spoilt (string-map (lambda (c) (if (zero? (random 7)) (string-ref "()'\"#;\\ " (random 8)) c)) text)))
    (for-each (lambda (text)
                (do ((i 0 (+ i 13)))
                    ((>= i (string-length text)))
                  (let ((cursor (cursor-after (substring text 0 i))))
                    (require (string? (cursor-word cursor)))
                    (require (>= (indentation-after (substring text 0 i)) 0)))))
              (list text spoilt))
    (do ((i 0 (+ i 101)))
        ((>= i (string-length spoilt)))
      (require (list? (words-after (substring spoilt 0 i))))))
  (expect (length (cursor-frames (cursor-after "(a (b \"(\" ; (\n (c #\\( "))) => 3)
  (expect (cursor-mark (cursor-after "(load \"fi")) => #\")
  (expect (cursor-word (cursor-after "(load \"fi")) => "fi")
  (expect (words-after "(run 3) ; (wind") => '()))

(define-scenario indentation
  "A line is indented below the first argument, by two in the body of a form that has one, else by one."
  (expect (indentation-after "(run 3)\n") => 0)
  (expect (indentation-after "(define (f x)\n") => 2)
  (expect (indentation-after "(list 1\n") => 6)
  (expect (indentation-after "(list (list 1 2)\n") => 6)
  (expect (indentation-after "(world\n  (tether (length 3)\n") => 10)
  (expect (indentation-after "(\n") => 1))

(define-scenario members-by-their-own-names
  "What belongs to a group is found by its name in the group, too; the whole name, with its slash, goes on."
  (in pier)
  (expect (words-after "(winding 'pile-2-5") => '("pier/pile-2-5"))
  (expect (words-after "(winding 'pier/pile-2-5") => '("pier/pile-2-5"))
  (expect (sort (words-after "(winding 'beam") string<?) => '("pier/beam-1" "pier/beam-2"))
  (expect (nearest 'pile-2-5 '(pier/pile-2-4 pier/pile-2-5 line)) => 'pier/pile-2-5)
  (expect (nearest 'piel-2-5 '(pier/pile-2-4 pier/pile-2-5 line)) => 'pier/pile-2-5)
  (expect (nearest 'line '(pier/line line)) => 'line))

(define (hint text)
  (save-module-excursion (lambda () (set-current-module here) (hint-after text))))

(define-scenario hints-while-typing
  "Below the line stands what is expected there: the argument with its unit and default, or the field of a part."
  (in pier)
  (let ((begins? (lambda (text) (lambda (told) (and told (string-prefix? text told))))))
    (expect (hint "(run 2") is (begins? "SECONDS: s; "))
    (expect (hint "(pay-out! 'line ") is (begins? "METRES: m; "))
    (expect (hint "(pay-out! 5 #:rate ") is (begins? "RATE: m/s; "))
    (expect (hint "(pay-out! 5 #:rate ") is (lambda (told) (string-contains told "0.5 when left out")))
    (expect (hint "(world (tether (length ") is (begins? "length: m; "))
    (expect (hint "(drive! #:sur") => (verb-usage drive!)))
  (expect (hint "") => #f)
  (expect (hint "(car ") => #f)
  (expect (filter-map (lambda (entry)
                        (and (not (hint (simple-format #f "(~a " (car entry)))) (car entry)))
                      (verbs))
          => '()))

(define-scenario types-of-errors-are-asked-for
  "The types of errors are completed for those alone who begin with their mark."
  (expect (filter (lambda (word) (string-prefix? "&" word)) (map candidate-word (candidates-after "("))) => '())
  (expect (map candidate-word (candidates-after "(&bight")) => '("&bight-error")))
