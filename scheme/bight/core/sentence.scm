;;; (bight core sentence) --- what a name means, in a sentence: a verb, a part, a world, a lesson, an event.
;;;
;;; The sentences of worlds and lessons in files are read, not run.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core sentence)
  #:use-module (bight core part)
  #:use-module (bight core schema)
  #:use-module ((bight dive) #:select (current-dive dive-world))
  #:use-module ((bight world atlas) #:select (world-text))
  #:use-module (srfi srfi-1)
  #:export (first-sentence
            sentence-of-variable
            sentence-of-name
            sentence-of-lesson
            event-sentence))

(define (first-sentence text)
  "Return the first sentence of TEXT on one line."
  (let* ((line (string-join (string-tokenize text)))
         (end (string-contains line ". ")))
    (if end (substring line 0 (+ end 1)) line)))

(define (sentence-of-variable name)
  "Return the first sentence about the variable NAME of the present module, or the empty string."
  (let* ((variable (module-variable (current-module) name))
         (value (and variable (variable-bound? variable) (variable-ref variable))))
    (or (and value
             (or (procedure? value) (macro? value))
             (and=> ((@ (bight shell doc) docstring-of) value) first-sentence))
        "")))

(define (sentence-of-lesson name)
  "Return the title of the lesson NAME, or the empty string."
  (or (false-if-exception ((@ (bight lesson file) lesson-file-title)
                           ((@ (bight lesson file) lesson-file) (symbol->string name))))
      ""))

(define event-sentences
  '((taut . "A tether lost its slack.")
    (slack . "A tether that was taut has slack again.")
    (arrived . "A vehicle reached where it was sent.")
    (spooled . "A winch has paid out or hauled in what was ordered.")
    (stalled . "A winch stopped before that, on a taut tether.")
    (parted . "A tether broke, or was cut.")
    (snapped . "A slack tether came taut with a jerk.")
    (hockled . "Its twist threw a loop into a tether.")
    (kinked . "A tether was bent more tightly than it may be.")
    (touched . "A tether or a vehicle met an obstacle.")
    (left . "What had met an obstacle has been away from it for half a second.")
    (stuck . "A tether has held fast for 5 s against a pull.")
    (pinched . "A moving obstacle was held back by what it would run into.")
    (prop-danger . "A tether has come near to a thruster of a vehicle that turns.")
    (worn . "An obstacle has worn a tether's jacket to its limit.")
    (wrapped . "A tether is wound about an obstacle once more.")
    (freed . "A tether is not wound about an obstacle any more.")))

(define (event-sentence name)
  "Return what the event NAME says, a sentence, or the empty string."
  (or (assq-ref event-sentences name) ""))

(define (here-part name)
  (let ((world (and (current-dive) (dive-world (current-dive)))))
    (and world (find-part (world-parts-of world) name))))

(define (part-sentence part)
  (let ((type (assq-ref (part-fields-of part) 'type)))
    (if type (part-type-sentence type) (head-title (part-head-of part)))))

(define (types-sentence types)
  (string-join (map part-type-sentence types) " "))

(define (sentence-of-name name)
  "Return what the quoted NAME stands for in the present dive or the language, or the empty string."
  (cond ((here-part name) => part-sentence)
        ((world-text name))
        ((part-head? name) (head-sentence name))
        ((pair? (types-called name)) (types-sentence (types-called name)))
        ((assq-ref event-sentences name))
        (else (sentence-of-lesson name))))
