;;; (bight world random-dive) --- generators of obstacles, worlds and pilots, for properties of dives.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world random-dive)
  #:use-module (bight core verb)
  #:use-module (bight test generator)
  #:use-module (srfi srfi-1)
  #:export (random-parts random-world random-pilot))


;;; Obstacles, in a box of water 12 m wide; y is north.

(define west -4) (define east 8)
(define south -7) (define north 7)
(define top -1) (define bottom -11)
(define depth 12)

(define some-x (uniform west east))
(define some-y (uniform south north))
(define some-z (uniform bottom top))

(define obstacle-shapes
  `((pile . ,(made-of (lambda (x y r)
                        `(cylinder (from ,x ,y 1) (to ,x ,y ,(- (+ depth 1))) (radius ,r)))
                      some-x some-y (any-of (uniform 1/10 1) (one-of 1/200 1/50))))
    (brace . ,(made-of (lambda (x y z to-x to-y to-z r)
                         `(capsule (from ,x ,y ,z) (to ,to-x ,to-y ,to-z) (radius ,r)))
                       some-x some-y some-z some-x some-y some-z (uniform 1/20 1/2)))
    (block . ,(made-of (lambda (x y z a b c heading)
                         `(box (at ,x ,y ,z) (size ,a ,b ,c) (heading ,heading)))
                       some-x some-y some-z (uniform 1/2 4) (uniform 1/2 4) (uniform 1/2 4)
                       (integer 0 179)))
    (ball . ,(made-of (lambda (x y z r) `(sphere (at ,x ,y ,z) (radius ,r)))
                      some-x some-y some-z (uniform 1/5 2)))))

(define (obstacles most shapes make)
  (list-of (apply any-of (map (lambda (shape) (assq-ref obstacle-shapes shape)) shapes))
           #:most most #:make make))

(define-argument-type (shapes value)
  "a list of shapes among pile, brace, block and ball"
  (if (and (pair? value) (list? value) (every (lambda (s) (assq s obstacle-shapes)) value))
      value
      refused))

(define all-shapes (map car obstacle-shapes))

(define-verb (random-parts #:key (most count 6) (of shapes all-shapes))
  "Return a generator of lists of at most MOST obstacles, parts for (splice ...), of the shapes OF: pile brace
block ball.  They lie from 4 m west to 8 m east and 7 m south to 7 m north of the origin, down to 12 m."
  (obstacles most of (lambda (forms)
                       (cons 'list (map (lambda (form) (cons 'part form)) forms)))))


;;; Worlds.  Tether and vehicle begin west of all that is in the way.

(define statics '(rubber-band v-shape catenary catenary-simplex elastic steady))
(define all-models (append statics '(dynamic auto)))

;; The thesis' own search for the catenary finds none at times, and says so.
(define usual-models (delq 'catenary-simplex (list-copy all-models)))

(define-argument-type (models value)
  "a list of models, such as (dynamic catenary)"
  (if (and (pair? value) (list? value) (every (lambda (m) (memq m all-models)) value))
      value
      refused))

(define a-vehicle
  (any-of (made-of (lambda (speed) `((surge-speed ,speed))) (uniform 1/2 3))
          (one-of '((size 0.4 0.6 0.3)))
          (one-of '((type bluerov2-heavy)))))

(define (unquoted expression)
  ;; A list that a choice made, as it is.
  (if (eq? 'quote (car expression)) (cadr expression) expression))

(define a-tether
  (made-of (lambda (length weight nodes)
             `((length ,length) (wet-weight ,weight) (nodes ,nodes)))
           (uniform 17 36) (one-of 0 0.1 -0.05 0.5) (integer 8 32)))

(define-verb (random-world #:key (most count 6) (of shapes all-shapes) (models models usual-models))
  "Return a generator of worlds: at most MOST obstacles of the shapes OF in a current, with or without a bed,
the vehicle minnow, which has a mass or none, on the tether line, moved by one of MODELS, when left out any
but catenary-simplex."
  (made-of (lambda (speed toward bed obstacles vehicle tether model)
             `(world (sea (depth ,depth) (current ,speed ,toward))
                     ,@(unquoted bed)
                     ,@obstacles
                     (rov (named minnow) (at -7 8 -5) ,@(unquoted vehicle))
                     (tether (named line) (type fathom) (from -7 -8 -5) (to minnow) ,@tether
                             (model ,(unquoted model)))))
           (any-of (one-of 0) (uniform 0 1)) (integer 0 359)
           (one-of '() '((seabed)))
           (obstacles most of identity)
           a-vehicle a-tether
           (apply one-of models)))


;;; Pilots: what they do, each thing followed by some seconds.

(define a-stick (uniform -1 1))

(define acts
  `((drive . ,(made-of (lambda (surge sway heave yaw)
                         `(drive! #:surge ,surge #:sway ,sway #:heave ,heave #:yaw ,yaw))
                       a-stick a-stick a-stick a-stick))
    (fly . ,(made-of (lambda (x y z speed) `(fly-to! (vec ,x ,y ,z) #:speed ,speed))
                     (uniform -7 9) (uniform -9 9) (uniform -11 -1) (uniform 1/2 4)))
    (pay-out . ,(made-of (lambda (metres rate) `(pay-out! ,metres #:rate ,rate))
                         (uniform 0 10) (uniform 1/10 2)))
    (haul-in . ,(made-of (lambda (share rate) `(haul-in! (* ,share (tether-length)) #:rate ,rate))
                         (uniform 0 1/2) (uniform 1/10 2)))
    (current . ,(made-of (lambda (speed toward) `(current! ,speed ,toward))
                         (uniform 0 1) (integer 0 359)))
    (model . ,(made-of (lambda (model) `(tether-model! ,model)) (apply one-of usual-models)))
    (release . ,(one-of '(release!)))))

(define usual-acts '(drive drive fly fly pay-out haul-in current))

(define-argument-type (acts value)
  "a list of acts among drive, fly, pay-out, haul-in, current, model and release"
  (if (and (pair? value) (list? value) (every (lambda (a) (assq a acts)) value))
      value
      refused))

(define (act-then-wait act seconds)
  (list (unquoted act) `(run ,seconds)))

(define-verb (random-pilot #:key (most count 8) (seconds positive 4) (does acts usual-acts))
  "Return a generator of pilots, procedures of no arguments that do at most MOST things, each followed by at
most SECONDS.  DOES lists what they do: drive fly pay-out haul-in current model release; one that is named
twice is done twice as often."
  (list-of (made-of act-then-wait
                    (apply any-of (map (lambda (act) (assq-ref acts act)) does))
                    (uniform 0 seconds))
           #:most most
           #:make (lambda (acts) `(lambda () ,@(concatenate acts) *unspecified*))))
