;;; (bight lesson report) --- what came of a lesson: marks, what was said, each measure over time.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson report)
  #:use-module (bight core record)
  #:use-module (bight core verb)
  #:use-module (bight lesson score)
  #:use-module (bight lesson shelf)
  #:use-module (srfi srfi-1)
  #:use-module ((srfi srfi-9 gnu) #:select (set-record-type-printer!))
  #:export (make-report
            report? report-who report-seed report-level report-total report-passed? report-marks
            report-said report-text report-hash report-coached report-hints report-rewinds
            report-seconds report-instructed report-lost report-tasks report-lesson))

(define-record <report>
  (make-report lesson who seed level marks total passed? seconds hints rewinds said charts coached hash lost tasks)
  report-record?
  (lesson report-lesson)
  (who report-who)                      ; the name of the pilot or the pupil
  (seed report-seed)
  (level report-level)
  (marks report-mark-list)
  (total %report-total)
  (passed? %report-passed?)
  (seconds %report-seconds)             ; of the dive
  (hints %report-hints)
  (rewinds %report-rewinds)
  (said %report-said)                   ; (TIME KIND TEXT), in order
  (charts report-charts)                ; lines
  (coached %report-coached)
  (hash %report-hash)
  (lost report-lost)                    ; as `lost-marks' returns them
  (tasks report-tasks))                 ; as they were set, the last first

(define-argument-type (report value)
  "a report, as `run-lesson' returns"
  (if (report-record? value) value refused))

(define-verb (report? (object any))
  "Return #t if OBJECT is the report of a lesson."
  (report-record? object))

(define-verb (report-total (r report)) "Return the marks of the report R out of 100." (%report-total r))
(define-verb (report-passed? (r report))
  "Return #t if all tasks of the report R were done and its total is at least 70."
  (%report-passed? r))
(define-verb (report-marks (r report))
  "Return the marks of the report R: lists of label, credit from 0 to 1, whether it is what was asked, and
how it came about."
  (map (lambda (m) (list (mark-label m) (mark-credit m) (mark-passed? m) (mark-detail m)))
       (report-mark-list r)))
(define-verb (report-said (r report))
  "Return what was said in the lesson of the report R, in order: lists of time, kind and text."
  (%report-said r))
(define-verb (report-hash (r report)) "Return the hash of the dive as the lesson left it, or #f."
  (%report-hash r))
(define-verb (report-coached (r report))
  "Return what the coach said in the lesson of the report R: lists of time, rule and words."
  (%report-coached r))
(define-verb (report-hints (r report)) "Return how many hints were given." (%report-hints r))
(define-verb (report-rewinds (r report)) "Return how often the pupil went back." (%report-rewinds r))
(define-verb (report-seconds (r report)) "Return how long the lesson's dives lasted, s."
  (%report-seconds r))

(define (mark-lines m width)
  ;; How the mark M, its name on WIDTH columns, came about, and, if anything of it was lost, what it teaches.
  (cons (mark-line m width)
        (if (or (mark-passed? m) (not (mark-why m)))
            '()
            (list (string-append (make-string 8 #\space) (mark-why m))))))

(define (mark-line m width)
  (string-append (if (mark-passed? m) "  [x] " "  [ ] ")
                 (string-pad-right (mark-label m) width) " "
                 (string-pad (number->string (inexact->exact (round (* 100 (mark-credit m))))) 4)
                 "  " (mark-detail m)))

(define-verb (report-instructed (r report))
  "Return what an instructor handed in during the lesson of the report R: lists of time and text."
  (filter-map (lambda (line) (and (eq? 'instructor (second line)) (list (first line) (third line))))
              (%report-said r)))

(define (instructor-lines r)
  ;; Marks beside which an instructor stood say so.
  (map (lambda (line) (string-append "  at " (figure (first line)) " s the instructor: " (second line)))
       (report-instructed r)))

(define (counted n one many)
  (simple-format #f "~a ~a" n (if (= n 1) one many)))

(define (report-lines r)
  ;; The marks are last: in a small terminal that is what is seen.
  (append
   (report-charts r)
   (list (simple-format #f "~a: ~a out of 100, ~a" (lesson-name (report-lesson r)) (%report-total r)
                        (if (%report-passed? r) "passed" "not passed yet")))
   (let ((width (fold (lambda (m most) (max most (string-length (mark-label m)))) 0 (report-mark-list r))))
     (append-map (lambda (m) (mark-lines m width)) (report-mark-list r)))
   (list (simple-format #f "  ~a s under water, ~a, ~a" (figure (%report-seconds r))
                        (counted (%report-hints r) "hint" "hints") (counted (%report-rewinds r) "step back" "steps back")))
   (instructor-lines r)))

(define-verb (report-text (r report))
  "Return the report R as a person reads it: each measure over time, then the marks."
  (string-join (report-lines r) "\n"))

(set-record-type-printer! <report>
  (lambda (r port) (display (report-text r) port)))
