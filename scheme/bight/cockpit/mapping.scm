;;; (bight cockpit mapping) --- what the axes and buttons of a controller do.
;;;
;;; A mapping is a list of clauses, each for controllers whose name has a certain part, and each a list of bindings: of a
;;; control to a stick, by a scale and a dead zone, or to a key.  A button drives a stick too, as an axis that is 0
;;; or 1; an axis that passes its half presses a key.  In a file:
;;;
;;;   (bight-mapping 1)
;;;   (dead-zone 0.1)                       of every axis that says nothing else
;;;   (controller "extreme 3d"              part of a name, in any case; "" is part of every name
;;;     (surge "axis1" -1) (sway "axis0") (yaw "axis2" 0.8 0.2)     STICK CONTROL [SCALE [DEAD-ZONE]]
;;;     (heave "hat0up" 0.5) (heave "hat0down" -0.5)
;;;     (key "button0" "space"))                                    CONTROL KEY
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit mapping)
  #:use-module (bight core datum)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (srfi srfi-1)
  #:export (usual-mapping read-mapping bindings-for without-dead-zone
            binding? binding-control binding-stick binding-scale binding-dead binding-key stick-names))

(define-record <binding>
  (make-binding control stick scale dead key)
  binding?
  (control binding-control)             ; a name, such as "lefty" or "button3"
  (stick binding-stick)                 ; its number, or #f
  (scale binding-scale)
  (dead binding-dead)                   ; a share of the axis
  (key binding-key))                    ; as (bight cockpit keys) has it, or #f

(define stick-names '(surge sway heave yaw))
(define usual-dead 0.12)

(define key-words
  '(("space" . #\space) ("enter" . #\return) ("escape" . escape) ("up" . up) ("down" . down) ("left" . left)
    ("right" . right)))

(define (bad text . values)
  (apply bight-raise 'format 'controller text values))

(define (word->key word)
  (cond ((assoc-ref key-words word))
        ((and (= 1 (string-length word)) (char<? #\space (string-ref word 0) #\delete)) (string-ref word 0))
        (else (bad "a key is one character, or ~a, not ~s" (string-join (map car key-words) ", ") word))))

(define (number-within x low high what form)
  (if (and (real? x) (<= low x high))
      (exact->inexact x)
      (bad "~a is a number from ~a to ~a, not ~s, in ~s" what low high x form)))

(define (stick-binding form dead)
  ;; (STICK CONTROL [SCALE [DEAD-ZONE]])
  (let ((size (length form)))
    (make-binding (second form) (list-index (lambda (name) (eq? name (first form))) stick-names)
                  (if (> size 2) (number-within (third form) -4 4 "a scale" form) 1.0)
                  (if (> size 3) (number-within (fourth form) 0 0.9 "a dead zone" form) dead)
                  #f)))

(define (form->binding form dead)
  (cond ((not (and (list? form) (<= 2 (length form) 4) (symbol? (first form)) (string? (second form))))
         (bad "a controller has (STICK CONTROL [SCALE [DEAD-ZONE]]) and (key CONTROL KEY), not ~s" form))
        ((eq? 'key (first form))
         (if (and (= 3 (length form)) (string? (third form)))
             (make-binding (second form) #f 1.0 0.5 (word->key (third form)))
             (bad "a key is told as (key CONTROL KEY), not ~s" form)))
        ((memq (first form) stick-names) (stick-binding form dead))
        (else (unknown-name 'controller "a controller" (first form) (cons 'key stick-names) "clause"))))

(define (form->clause form dead)
  (if (and (pair? form) (list? form) (eq? 'controller (car form)) (pair? (cdr form)) (string? (cadr form)))
      (cons (cadr form) (map (lambda (f) (form->binding f dead)) (cddr form)))
      (bad "a mapping has (dead-zone SHARE) and (controller NAME ...), not ~s" form)))

(define (forms->mapping forms)
  (let loop ((rest forms) (dead usual-dead) (clauses '()))
    (cond ((null? rest) (reverse clauses))
          ((and (list? (car rest)) (= 2 (length (car rest))) (eq? 'dead-zone (caar rest)))
           (loop (cdr rest) (number-within (cadar rest) 0 0.9 "a dead zone" (car rest)) clauses))
          (else (loop (cdr rest) dead (cons (form->clause (car rest) dead) clauses))))))

(define (read-mapping file)
  "Return the mapping in FILE, or raise a &bight-error that says what is wrong with it."
  (forms->mapping (read-forms 'controller file '(bight-mapping 1) "mapping")))

;; As ArduSub's usual one: the left stick rises and turns, the right one goes ahead and aside.
(define usual-pad
  (forms->mapping
   '((controller ""
       (heave "lefty" -1) (yaw "leftx") (surge "righty" -1) (sway "rightx")
       (key "lefttrigger" "[") (key "righttrigger" "]") (key "leftshoulder" "{") (key "rightshoulder" "}")
       (key "a" "space") (key "b" "m") (key "x" "b") (key "y" "h") (key "start" "p") (key "back" "u")
       (key "leftstick" "y") (key "rightstick" "v") (key "guide" "?")
       (key "dpup" "f") (key "dpright" "e") (key "dpdown" "z") (key "dpleft" "g")))))

;; A throttle lever does not come back by itself, so that the hat rises and sinks.
(define usual-stick
  (forms->mapping
   '((controller ""
       (surge "axis1" -1) (sway "axis0") (yaw "axis2") (heave "hat0up" 1) (heave "hat0down" -1)
       (key "button0" "space") (key "button1" "m") (key "button2" "[") (key "button3" "]") (key "button4" "h")
       (key "button5" "b") (key "button6" "v") (key "button7" "p") (key "hat0left" "e")))))

(define (usual-mapping known?)
  "Return the mapping of a controller for which no file says anything; KNOWN? says whether SDL knows its axes."
  (if known? usual-pad usual-stick))

(define (bindings-for mapping name known?)
  "Return the bindings for a controller called NAME: of the first clause of MAPPING whose part NAME has, else the usual
ones; KNOWN? says whether SDL knows its axes."
  (or (any (lambda (clause) (and (string-contains-ci name (car clause)) (cdr clause))) mapping)
      (cdar (usual-mapping known?))))

(define (without-dead-zone value dead)
  "Return the share that VALUE, of an axis from -1 to 1, is beyond the dead zone DEAD about its middle: it begins at 0
and ends at 1."
  (if (<= (abs value) dead)
      0.0
      (* (if (negative? value) -1.0 1.0) (/ (- (min 1 (abs value)) dead) (- 1 dead)))))
