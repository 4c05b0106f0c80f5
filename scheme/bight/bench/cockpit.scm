;;; (bight bench cockpit) --- `bight bench cockpit': what a frame of the cockpit costs, with a lesson's overlay.
;;;
;;; A dive is flown; between steps a frame is drawn as for a terminal, picture, map, figures, forecast, panel of a
;;; lesson with targets, and the bytes of it, and its CPU time taken, that of the drawing's threads with it.  Nothing
;;; is written.  Times come beside that of the picture alone: the renderer draws in software where there is no graphics
;;; card.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight bench cockpit)
  #:use-module (bight cockpit)
  #:use-module (bight cockpit cells)
  #:use-module (bight cockpit state)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core units)
  #:use-module (bight dive)
  #:use-module (bight dive command)
  #:use-module (bight dive time)
  #:use-module (bight engine)
  #:use-module (bight lesson flying)
  #:use-module (srfi srfi-1)
  #:export (run-cockpit))

(define help "bight bench cockpit: what a frame of the cockpit costs, with a lesson's overlay
  --frames N    of each view, 300 when left out, 60 with --quick
  --world W     where is flown; jacket when left out
")

(define (read-options arguments)
  (let loop ((rest arguments) (found '()))
    (cond ((null? rest) found)
          ((member (car rest) '("--quick" "--help")) (loop (cdr rest) (acons (car rest) #t found)))
          ((and (member (car rest) '("--frames" "--world")) (pair? (cdr rest)))
           (loop (cddr rest) (acons (car rest) (cadr rest) found)))
          (else (bight-raise 'domain 'bench "the bench cockpit has --frames N, --world W, --quick, not ~a" (car rest))))))

(define (cpu) (/ (get-internal-run-time) (exact->inexact internal-time-units-per-second)))

(define (ms-of thunk)
  (let ((begun (cpu)))
    (thunk)
    (* 1000 (- (cpu) begun))))

(define (places)
  (list (target "the far leg" (vec 10 10 -12)) (target "home" (vec 0 -20 -3))))

(define (overlay)
  (lesson-panel "Go round the far leg, keeping the line clear of the braces, and come home the way you went."
                '((#xffd84a . "Coach: your line lies round leg A2.") (#xffffff . "Tender: ten metres out."))
                (map target-line (places) (iota 2))
                '("0:42  touches 3  hints 1")))

(define (new-flight view palette)
  (let ((c (new-cockpit palette view 'plain)))
    (board! c (current-dive))
    (set-targets! c places)
    (set-panel! c (lambda (put columns rows) ((overlay) put columns rows)))
    (fit-to-size! c '(120 . 40))
    c))

(define (frame! c)
  (compose-frame! c "e hint  u back  p pause")
  (%screen-bytes (cockpit-screen c) #f))

(define frame-steps 2)                  ; of 1/60 s

(define (fly view palette n)
  ;; The ms of N frames, and of the picture in each: two lists.
  (let ((c (new-flight view palette)) (engine (engine-of (current-dive))))
    (frame! c)                          ; shaders are compiled, questions asked for the first time
    (unzip2
     (map (lambda (i)
            (%step-dive! engine frame-steps)
            (let ((all (ms-of (lambda () (frame! c)))))
              (list all (ms-of (lambda ()
                                 (frame-pixels engine view 'plain '(120 . 40) '() #f))))))
          (iota n)))))

(define (quantile ms share)
  (let ((sorted (sort ms <)))
    (/ (round (* 100 (list-ref sorted (inexact->exact (floor (* share (- (length sorted) 1))))))) 100)))

(define (mean ms) (/ (round (* 100 (/ (apply + ms) (length ms)))) 100))

(define (say-row view palette n)
  (call-with-values (lambda () (fly view palette n))
    (lambda (all picture)
      (simple-format #t "~a,~a,~a,~a,~a,~a,~a,~a,~a~%" view palette n (quantile all 0) (quantile all 0.5) (mean all) (quantile all 0.95)
                     (quantile picture 0.5) (mean (map - all picture)))
      (force-output))))

(define (run-cockpit arguments)
  "Do what ARGUMENTS of `bight bench cockpit' ask for, and return the exit status."
  (let* ((options (read-options arguments))
         (n (text->number (or (assoc-ref options "--frames") (if (assoc-ref options "--quick") "60" "300")))))
    (cond ((assoc-ref options "--help") (display help))
          ((not (and (exact-integer? n) (> n 1))) (bight-raise 'domain 'bench "--frames takes a whole number above 1"))
          (else
           (enter! (string->symbol (or (assoc-ref options "--world") "jacket")))
           (drive! #:surge 0.4 #:yaw 0.1)
           (display "view,palette,frames,least ms,median ms,mean ms,ms of 95 %,median ms of the picture,mean ms beside it\n")
           (for-each (lambda (row) (say-row (car row) (cdr row) n))
                     '((chase . true) (pilot . true) (top . true) (overview . true) (chase . many) (chase . few)
                       (chase . none)))))
    0))
