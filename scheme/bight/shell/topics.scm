;;; (bight shell topics) --- the names of the language by what they are about.
;;;
;;; A topic is a few modules; whatever they give to the language belongs to it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell topics)
  #:use-module (srfi srfi-1)
  #:export (topics
            topic-names
            topic-called
            topic-of))

(define table
  '((begin "begin a dive, and help" dive (shell doc) (world describe))
    (worlds "worlds, parts and types" world (world atlas) (world types) (world build))
    (time "let time pass, and what runs meanwhile"
          (dive time) (dive task) (dive pilot) (dive live) (dive threads))
    (fly "fly, spool, change the sea" (dive command) (dive homing) (dive tour) (dive tour-flight) (belief tour))
    (ask "ask of the vehicle, the sea and the tether" (dive query) (dive instruments))
    (touch "contact, wear and clearance" (dive contact))
    (aware "what a tether is doing: caught, fouled, the way home"
           (dive aware) (dive figures) (dive foresight) (dive in-words) (dive probe) (cockpit coach))
    (belief "a tether as it may be: what is uncertain, and what is learnt" belief (belief answer) (belief advise) (belief keeping))
    (moments "time as a value: checkpoints, forks, files"
             (dive checkpoint) (dive saving) (dive recording) (dive replay) (dive flight) (dive frames) (dive export)
             (world moordyn) (world orcaflex))
    (see "see it: panels, pictures, plots, films"
         view (view status) (view picture) (cockpit view) (view film) (view plot))
    (points "points and units" (core units))
    (test "scenarios, properties and what they claim"
          (test scenario) (test property) (test generator) (world random-dive) (test invariant)
          (core scratch) (test command))
    (teach "lessons and the logbook" lesson (lesson file) (lesson logbook))
    (study "studies of many dives" study (study case) (study risk))
    (identify "the properties of a real line from measurements" identify (identify rehearse) (identify found))
    (errors "mistakes, and the names themselves" (core errors))))

(define (modules-of entry)
  (map (lambda (name) (cons 'bight (if (pair? name) name (list name)))) (cddr entry)))

(define (names-by-module)
  ((procedure-property (module-ref (resolve-interface '(bight)) 'language-names) 'by-module)))

(define (topics)
  "Return an alist from the names of the topics to their sentences."
  (map (lambda (entry) (cons (first entry) (second entry))) table))

(define (topic-called name)
  "Return NAME, a symbol, if it is that of a topic, else #f."
  (and (assq name table) name))

(define (sorted names)
  (sort names (lambda (a b) (string<? (symbol->string a) (symbol->string b)))))

(define (topic-names topic)
  "Return the names that belong to TOPIC, sorted."
  (let ((modules (modules-of (assq topic table))))
    (sorted (append-map (lambda (entry) (if (member (car entry) modules) (cdr entry) '()))
                        (names-by-module)))))

(define (topic-of name)
  "Return the topic that NAME belongs to, or #f."
  (let ((home (find (lambda (entry) (memq name (cdr entry))) (names-by-module))))
    (and home
         (and=> (find (lambda (entry) (member (car home) (modules-of entry))) table) first))))
