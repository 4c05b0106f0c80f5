;;; (bight topics) --- the names of the language by what they are about.
;;;
;;; A topic is a few modules; whatever they give to the language belongs to it.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight topics)
  #:use-module (srfi srfi-1)
  #:export (topics
            topic-names
            topic-called
            topic-of))

(define table
  '((begin "begin a dive, and help" dive doc describe)
    (worlds "worlds, parts and types" world atlas types build)
    (time "let time pass, and what runs meanwhile" time task pilot live threads)
    (fly "fly, spool, change the sea" command homing)
    (ask "ask of the vehicle, the sea and the tether" query instruments)
    (touch "contact, wear and clearance" contact)
    (aware "what a tether is doing: caught, fouled, the way home" aware foresight in-words probe coach)
    (moments "time as a value: checkpoints, forks, files" checkpoint saving recording frames export moordyn orcaflex)
    (see "see it: panels, pictures, plots, films" view picture pilot-view film plot)
    (points "points and units" units)
    (test "scenarios, properties and what they claim"
          scenario property generator random-dive invariant scratch test-command)
    (teach "lessons and the logbook" lesson lesson-file logbook)
    (study "studies of many dives" study study-case risk)
    (errors "mistakes, and the names themselves" errors)))

(define (modules-of entry)
  (map (lambda (name) (list 'bight name)) (cddr entry)))

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
