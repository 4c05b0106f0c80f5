;;; The instrument itself: rows, fronts, reports, exact tests, verdicts; its programs played by scripts.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight bench)
             (bight bench bars)
             (bight bench compare)
             (bight bench growth)
             (bight core json)
             (bight bench plot)
             (bight bench report)
             (bight bench row)
             (bight bench where)
             (bight core errors)
             (ice-9 exceptions)
             ((ice-9 ftw) #:select (scandir))
             (ice-9 textual-ports)
             (srfi srfi-1))

(define (in-scratch . words)
  (scratch-file (string-concatenate words)))

(define (text-of file)
  (call-with-input-file file get-string-all #:encoding "UTF-8"))

(define header
  "case,model,setting,metric,error,reference,reference_uncertainty,cpu_ns,calibration_ratio,counters")

(define (rows-from . lines)
  (read-csv (cons header lines)))

(define (gather . rounds)
  (gather-rows (map (lambda (rows) (list (cons "play" rows))) rounds)))

(define (write-program! folder name . lines)
  ;; A bench called NAME in FOLDER that prints LINES.
  (unless (file-exists? (in-scratch folder)) (mkdir (in-scratch folder)))
  (let ((file (in-scratch folder "/bight-bench-" name)))
    (call-with-output-file file
      (lambda (port)
        (simple-format port "#!/bin/sh~%cat <<'END'~%~a~%END~%" (string-join lines "\n"))))
    (chmod file #o755)))

(define (status-and-words . arguments)
  ;; What bight bench with ARGUMENTS exits with, and what it says.
  (let* ((status #f)
         (words (with-output-to-string (lambda () (set! status (bench-command arguments))))))
    (cons status words)))

(define (call-with-programs folder thunk)
  (let ((before (getenv "BIGHT_LIBEXEC")))
    (dynamic-wind
      (lambda () (setenv "BIGHT_LIBEXEC" (in-scratch folder)))
      thunk
      (lambda () (if before (setenv "BIGHT_LIBEXEC" before) (unsetenv "BIGHT_LIBEXEC"))))))

(define-scenario programs-may-be-absent
  "They are a Debian package of their own, whose name is told."
  (mkdir (in-scratch "empty"))
  (call-with-programs "empty"
    (lambda ()
      (expect (bench-command '("statics")) raises unsupported))))

(define-scenario rows-are-read
  "Cells may hold commas and quotes; empty ones are no numbers; costs are medians over the rounds."
  (let ((row (first (gather (rows-from "a,\"m,\"\"1\"\"\",s,e,0.5,r,,100,2,k=1")
                            (rows-from "a,\"m,\"\"1\"\"\",s,e,0.5,r,,300,6,k=2")
                            (rows-from "a,\"m,\"\"1\"\"\",s,e,0.5,r,,110,3,k=3")))))
    (expect (row-model row) => "m,\"1\"")
    (expect (row-error row) => 0.5)
    (expect (row-uncertainty row) => #f)
    (expect (row-cpu row) => 110)
    (expect (row-ratios row) => '(2 6 3))
    (expect (row-ratio row) => 3)
    (expect (row-counters row) => "k=1")
    (expect (row-key row) => '("play" "a" "m,\"1\"" "s" "e"))))

(define-scenario fronts-are-marked
  "On the front is what nothing as cheap beats; where all are equally wrong there is none."
  (let ((rows (gather (rows-from "a,m,1,e,1e-1,r,,1,1," "a,m,2,e,1e-2,r,,2,2," "a,m,3,e,5e-2,r,,3,3,"
                                 "a,m,4,e,1e-3,r,,4,4," "a,m,5,e,,r,,5,5," "b,m,1,e,0,r,,1,1,"
                                 "b,m,2,e,0,r,,2,2,"))))
    (expect (map row-setting (filter row-front? rows)) => '("1" "2" "4"))
    (expect (delete-duplicates (map row-case (filter row-front? rows))) => '("a"))
    (let ((plots (plots-of rows)))
      (expect (length plots) => 1)
      (expect (plot-file (caar plots)) => "play-a-e.svg")
      (expect (string-prefix? "<svg" (cdar plots))))))

(define-scenario plots-are-alike
  "A model has one colour and shape in all plots, however many there are; no error stands on the axis of decades,
but in its strip; each plot says in words what it shows."
  (let* ((names (map (lambda (i) (string-append "m" (number->string i))) (iota 20)))
         (lines (append (map (lambda (name i) (simple-format #f "a,~a,1,e,~a,r,,1,~a," name (+ 0.1 i) (+ i 1)))
                             names (iota 20))
                        (map (lambda (name i) (simple-format #f "b,~a,1,e,~a,r,,1,~a," name i (+ i 1)))
                             (reverse names) (iota 20))))
         (rows (gather (apply rows-from lines)))
         (plots (plots-of rows)))
    (define (marks svg)
      ;; (MODEL . LOOKS): the element without its place, of what is titled after it.
      (filter-map (lambda (line)
                    (let ((title (string-contains line "<title>")) (fill (string-contains line "fill='#")))
                      (and title fill
                           (let ((end (string-index line #\, title)))
                             (and end
                                  (list (substring line (+ title 7) end)
                                        (substring line 1 5)
                                        (and=> (string-contains line "rotate(") (lambda (i) (substring line i (+ i 9))))
                                        (substring line fill (+ fill 14))))))))
                  (string-split svg #\newline)))
    (expect (length plots) => 2)
    (let ((a (marks (cdr (first plots)))) (b (marks (cdr (second plots)))))
      (expect (length a) => 20)
      (expect (lset-xor equal? a b) => '())
      (expect (length (delete-duplicates (map cdr a))) => 20))
    (expect (->bool (string-contains (cdr (first plots)) ">exact<")) => #f)
    (expect (->bool (string-contains (cdr (second plots)) ">exact<")) => #t)
    (expect (->bool (string-contains (cdr (second plots)) "1e-17")) => #f)
    (for-each (lambda (plot) (expect (> (string-length (plot-sentence (car plot))) 40))) plots)))

(define-scenario json-comes-back
  "What is written is read again; what is no JSON is refused."
  (let ((value `(("a" . #(1 2.5 -0.25 1e-17 null)) ("b" . "x\"\\\n\u00e9") ("c" . #t) ("d" . #f))))
    (expect (call-with-input-string (call-with-output-string (lambda (port) (write-json value port)))
              read-json)
            => value))
  (expect (call-with-input-string "{\"a\":" read-json) raises format)
  (expect (call-with-input-string "[1 2]" read-json) raises format))

(define-scenario tests-are-exact
  "Chances as the tables have them, ties with mean ranks."
  (expect (rank-sum-chance '(1 2 3 4) '(5 6 7 8)) is (about (/ 2. 70) #:within 1e-12))
  (expect (rank-sum-chance '(1 3 5 7) '(2 4 6 8)) is (about 0.685714285714 #:within 1e-12))
  (expect (rank-sum-chance '(1 1 2) '(1 2 2 3)) is (about 0.571428571429 #:within 1e-12))
  (expect (signed-rank-chance '(1 2 3 4 5 6)) is (about (/ 2. 64) #:within 1e-12))
  (expect (signed-rank-chance '(-1 2 -3 4)) is (about 0.875 #:within 1e-12))
  (expect (signed-rank-chance '(0 0)) => 1.0))

(define (play ratios error)
  ;; A report with one row of these RATIOS.
  (make-report "quick" (length ratios) '()
               (apply gather (map (lambda (ratio)
                                    (rows-from (simple-format #f "a,m,s,e,~a,r,,1,~a," error ratio)))
                                  ratios))))

(define (verdict old new)
  (with-output-to-string (lambda () (compare-reports old new))))

(define-scenario verdicts-are-careful
  "Better and worse only beyond chance and the usual stray; few rounds tell nothing."
  (let ((old (play '(1.00 1.01 0.99 1.005) 0.1)))
    (expect (string-contains (verdict old (play '(2.00 2.01 1.99 2.02) 0.1)) "0 better, 1 worse"))
    (expect (string-contains (verdict old (play '(0.50 0.51 0.49 0.52) 0.1)) "1 better, 0 worse"))
    (expect (string-contains (verdict old (play '(1.02 1.03 1.021 1.025) 0.1)) "1 noise"))
    (expect (string-contains (verdict old (play '(0.5 2 1.1 0.8) 0.1)) "1 noise"))
    (expect (string-contains (verdict old (play '(3 3) 0.1)) "1 untold"))))

(define-scenario errors-that-grow-are-a-failure
  "The verdict on errors knows no noise but a percent."
  (let ((old (play '(1 1 1 1) 0.1)) (answer #f))
    (define (good? error)
      (with-output-to-string (lambda () (set! answer (compare-reports old (play '(1 1 1 1) error)))))
      answer)
    (expect (good? 0.1))
    (expect (good? 0.1005))
    (expect (good? 0.05))
    (expect (good? 0.11) => #f)
    (expect (good? "inf") => #f)
    (expect (good? "") => #f)))

(define-scenario the-command-reports-and-compares
  "Scripts play the programs: files are written, a worse error is status 1, a failure does not hide."
  (write-program! "old" "statics" header "a,m,s,e,0.1,r,,100,1," "a,m,t,e,0.01,r,,300,3,")
  (write-program! "new" "statics" header "a,m,s,e,0.2,r,,100,1," "a,m,t,e,0.01,r,,300,3,")
  (write-program! "half" "statics" header "a,m,s,e,0.1,r,,100,1,")
  (write-program! "half" "contact" "no rows")
  (call-with-programs "old"
    (lambda ()
      (expect (car (status-and-words "--rounds" "4" "-o" (in-scratch "out"))) => 0)
      (expect (string-contains (text-of (in-scratch "out/report.html")) "<svg"))
      (expect (string-contains (text-of (in-scratch "out/report.csv")) "statics,a,m,s,e,0.1"))
      (expect (file-exists? (in-scratch "out/statics-a-e.svg")))
      (expect (length (report-rows (read-report (in-scratch "out/report.json")))) => 2)
      (expect (car (status-and-words "--compare" (in-scratch "out/report.json") "-o" (in-scratch "out2")))
              => 0)
      (expect (bench-command '("staticks")) raises name)
      (expect (bench-command '("--sideways")) raises domain)
      (expect (bench-command (list "-o" (in-scratch "out/report.csv"))) raises io)))
  (call-with-programs "new"
    (lambda ()
      (let ((said (status-and-words "--compare" (in-scratch "out/report.json") "-o" (in-scratch "out3"))))
        (expect (car said) => 1)
        (expect (string-contains (cdr said) "Errors: 1 grew")))
      (let ((said (status-and-words "--compare" (in-scratch "old") "--rounds" "6" "-o" (in-scratch "out4"))))
        (expect (car said) => 1)
        (expect (string-contains (cdr said) "signed rank")))
      (expect (car (status-and-words "--compare" (in-scratch "out/report.json")
                                     (in-scratch "out3/report.json")))
              => 1)))
  (call-with-programs "half"
    (lambda ()
      (let ((said #f))
        (with-error-to-string
          (lambda () (set! said (status-and-words "--rounds" "1" "-o" (in-scratch "out5")))))
        (expect (car said) => 1)))))

;;; Where the time goes.

(define where-rows
  (rows-from "dive,cable,,cpu,,,,750,1,share_percent=75;give_or_take=4.3;samples=75"
             "dive,sea,,cpu,,,,250,1,share_percent=25;give_or_take=4.3;samples=25"
             "other dive,cable,,cpu,,,,,,share_percent=0;give_or_take=0;samples=0"
             "other dive,sea,,cpu,,,,1000,1,share_percent=100;give_or_take=0;samples=50"))

(define-scenario bars-are-as-long-as-their-shares
  "A dive is a bar; its pieces are as long as the parts' shares of CPU time, and none is drawn of a part without."
  (let* ((rows (gather-rows (list (list (cons "where" where-rows)))))
         (svg (bars-svg rows))
         (pieces (filter (lambda (line) (and (string-contains line "<title>") (string-contains line "width="))) 
                         (string-split svg #\newline)))
         (width (lambda (line)
                  (let ((from (+ 7 (string-contains line "width='"))))
                    (string->number (substring line from (string-index line #\' from)))))))
    (expect (map width pieces) => '(480.0 160.0 640.0))
    (expect (call-with-output-string (lambda (port) (print-where port rows)))
            => "dive, 0.0 s of CPU, in percent, give or take 4.3: cable 75, sea 25
other dive, 0.0 s of CPU, in percent, give or take 0: sea 100\n")))

(define (engine-sources)
  ;; "FOLDER/FILE.c" of all that a dive can run.
  (let ((src (string-append (or (getenv "top_srcdir") "..") "/src")))
    (append-map (lambda (folder)
                  (map (lambda (file) (string-append folder "/" file))
                       (or (scandir (string-append src "/" folder) (lambda (file) (string-suffix? ".c" file))) '())))
                '("aware" "base" "collide" "contact" "guile" "live" "math" "model" "sea" "sim" "tether" "vehicle" "world"))))

(define-scenario every-source-has-a-part
  "Functions of the engine belong to a part, or to whoever calls them; the name of the file decides, for a hash that of
the function."
  (let ((sources (engine-sources)))
    (when (null? sources) (skip "no sources here"))
    (expect (filter (lambda (file) (equal? "other" (part-of-function (string-append file " f")))) sources) => '()))
  (expect (part-of-function "tether/dynamic_solve.c bt__dynamic_solve") => "cable")
  (expect (part-of-function "contact/line_guard.c bt__guard") => "ccd")
  (expect (part-of-function "collide/pair.c bt__pair") => #f)
  (expect (part-of-function "world/layout.c bt__hash_state") => "recording")
  (expect (part-of-function "world/layout.c bt__level") => "copy"))

(define (samples-of thunk)
  ;; The samples of THUNK, called until there are some.
  (let loop ((sum '()))
    (if (>= (fold + 0 (map cdr sum)) 40)
        sum
        (loop (map (lambda (entry) (cons (car entry) (+ (cdr entry) (or (assoc-ref sum (car entry)) 0))))
                   (where-time-goes thunk))))))

(define (largest samples)
  (car (fold (lambda (entry most) (if (> (cdr entry) (cdr most)) entry most)) '("none" . 0) samples)))

(define (of-one-line nodes)
  (world (sea (depth 60)) (rov (at 0 12 -20)) (tether (from -1 -12 0) (length 40) (nodes nodes) (model dynamic))))

(define-scenario time-is-found-where-it-goes
  "A dive of nothing but a moving line spends most of its time on the cable, one of a long line that is hashed on recording,
a count on Scheme."
  (in (of-one-line 100))
  (drive! #:surge 0.3)
  (guard (e ((and (bight-error? e) (eq? 'unsupported (bight-error-kind e))) (skip (bight-error-message e))))
    (where-time-goes (lambda () (run 10))))
  (expect (largest (samples-of (lambda () (run 10)))) => "cable")
  (in (of-one-line 2000))
  (expect (largest (samples-of (lambda () (do ((i 0 (+ i 1))) ((= i 3000)) (state-hash))))) => "recording")
  (expect (largest (samples-of (lambda () (let loop ((i 0)) (when (< i 3000000) (loop (+ i 1))))))) => "scheme"))


;;; Growth.

(define-scenario exponents-are-fitted
  "The exponent of a power is found, that of what has a fixed cost too is below that of its last sizes; cases without
three sizes have none."
  (let ((of (lambda (f sizes) (map (lambda (n) (cons n (f n))) sizes))))
    (expect (fit-exponent (of (lambda (n) (* 3 (expt n 1.5))) '(1 10 100))) is (about 1.5 #:within 1e-9))
    (expect (fit-exponent (of (lambda (n) (+ 1000 n)) '(1 10 100 1000 10000))) is (below 0.9)))
  (let ((rows (gather-rows (list (list (cons "scale" (rows-from "nodes,d,a,cpu,,,,100,1,n=10;solves=1"
                                                                "nodes,d,b,cpu,,,,10000,1,solves=1;n=1000"
                                                                "nodes,d,c,cpu,,,,1000,1,n=100"
                                                                "piles,d,d,cpu,,,,100,1,n=10"
                                                                "piles,d,e,cpu,,,,100,1,n=20"
                                                                "threads,d,f,cpu,,,,100,1,speed_up=2")))))))
    (expect (growth-of rows) => '(("nodes" (10 . 100) (100 . 1000) (1000 . 10000))))
    (expect (call-with-output-string (lambda (port) (print-growth port rows)))
            => "nodes, 10 to 1000: exponent 1.0; of the last two sizes 1.0\n")))
