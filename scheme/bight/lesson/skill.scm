;;; (bight lesson skill) --- what lessons train: the skills of a pilot who knows where his tether is.
;;;
;;; A lesson says (trains SKILL ...) and (needs SKILL ...); (bight lesson ability) estimates how well a pupil has each,
;;; and (bight lesson path) proposes the next lesson by that.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight lesson skill)
  #:use-module (bight core errors)
  #:export (skills
            skill-sentence
            check-skill
            grades))

(define table
  '((bow . "knowing where a current lays the tether")
    (slack . "giving just enough tether")
    (turns . "counting turns, and taking off what was put on")
    (handling . "flying with a tether that pulls")
    (route . "choosing the side, and coming home by it")
    (unwrapping . "noticing what the tether is caught on, and flying it free without pulling")
    (trim . "what to hang on a tether, and where")
    (crew . "saying to others what they must know")
    (blind . "flying by instruments and by the pull when nothing is seen")
    (tide . "foreseeing what the water will do, and leaving in time")))

(define grades '(1 2 3 4))

(define (skills)
  "Return the names of the skills that lessons train."
  (map car table))

(define (skill-sentence skill)
  "Return what SKILL is, in words."
  (cdr (assq skill table)))

(define (check-skill skill)
  "Raise a &bight-error if SKILL is none."
  (unless (assq skill table)
    (unknown-name 'define-lesson "the list of skills" skill (skills) "skill")))
