;;; The gallery, as Texinfo: `bight gallery.scm' prints the worlds and lessons there are, with a picture and a
;;; sentence each; `bight gallery.scm --draw' draws the pictures of the worlds into the folder it runs in.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules ((bight lesson file) #:select (lesson-files lesson-file-name lesson-file-title)))

(define (say . parts)
  (for-each display parts)
  (newline))

(define (escaped text)
  (string-concatenate
   (map (lambda (c) (if (memv c '(#\@ #\{ #\})) (string #\@ c) (string c))) (string->list text))))

(define (picture-of world)
  (string-append "world-" (symbol->string world)))

(define (print-worlds)
  (say "@node Worlds to dive in")
  (say "@section Worlds to dive in")
  (say)
  (for-each (lambda (world)
              (say "@subheading " world)
              (say)
              (say (escaped (world-documentation world)))
              (say)
              (say "@picture{" (picture-of world) ", " world "}")
              (say))
            (worlds)))

(define (print-lessons)
  (say "@node Lessons to take")
  (say "@section Lessons to take")
  (say)
  (say "@command{bight lesson NAME} begins one, or goes on with it.")
  (say)
  (say "@table @code")
  (for-each (lambda (file)
              (say "@item " (lesson-file-name file))
              (say (escaped (lesson-file-title file)) "."))
            (lesson-files))
  (say "@end table"))

(define (print-gallery)
  (say "@menu")
  (say "* Worlds to dive in::           What each looks like at its beginning.")
  (say "* Lessons to take::             From reading a bow to a turning tide.")
  (say "@end menu")
  (say)
  (print-worlds)
  (print-lessons))

(define (draw)
  (for-each (lambda (world)
              (enter! world)
              (snapshot (string-append (picture-of world) ".png") #:size '(800 450)))
            (worlds)))

(if (equal? (cdr (command-line)) '("--draw"))
    (draw)
    (print-gallery))
