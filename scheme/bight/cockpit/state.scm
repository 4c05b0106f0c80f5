;;; (bight cockpit state) --- what a cockpit knows: its dive, how that is looked at, and what is told meanwhile.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight cockpit state)
  #:use-module (bight cockpit keys)
  #:use-module (bight cockpit palette)
  #:use-module (bight core clock)
  #:use-module (bight core errors)
  #:use-module (bight core record)
  #:use-module (bight dive)
  #:use-module (bight engine)
  #:re-export (clock)
  #:export (cockpit? new-cockpit board! ask-anew! look-anew! announce! call-or-tell trying frame target
            cockpit-palette cockpit-ascii? cockpit-dive set-dive! cockpit-vehicle set-vehicle! cockpit-tether
            set-tether! cockpit-screen set-screen! cockpit-size set-size! cockpit-view set-view! cockpit-paint
            set-paint! cockpit-plain? set-plain! cockpit-lamp? set-lamp! help-lines turn-help! cockpit-words?
            set-words! cockpit-map? set-map! cockpit-sticks set-sticks! cockpit-message set-message!
            cockpit-message-until set-message-until! cockpit-slow set-slow! cockpit-slow-due set-slow-due!
            cockpit-ahead set-ahead! cockpit-words set-said! cockpit-ahead-due set-ahead-due! cockpit-plan
            set-plan! cockpit-plan-due set-plan-due! cockpit-paused? set-paused! cockpit-ghost set-ghost!
            cockpit-ghost-name set-ghost-name!
            cockpit-ghost-fork set-ghost-fork! cockpit-done? set-done! cockpit-times set-times! cockpit-targets
            set-targets! cockpit-labels set-labels! cockpit-panel set-panel! cockpit-dark? set-dark!
            cockpit-sent set-sent! cockpit-live? set-live! cockpit-stepped set-stepped! cockpit-orbit set-orbit!
            cockpit-held-at set-held-at! cockpit-releases? set-releases! cockpit-characters
            set-characters! cockpit-belief? set-belief?! cockpit-believed set-believed! cockpit-believed-due
            set-believed-due!))

(define frame 1/30)                     ; s


;;; What it knows.

(define-record <cockpit>
  (make-cockpit palette ascii? dive vehicle tether screen size view paint plain? lamp? help words? map? sticks
                message message-until slow slow-due ahead words ahead-due plan plan-due
                paused? ghost ghost-name ghost-fork done? times targets labels panel dark? orbit held-at releases? characters
                belief? believed believed-due sent live? stepped)
  cockpit?
  (palette cockpit-palette)
  (ascii? cockpit-ascii?)
  (dive cockpit-dive set-dive!)         ; or #f
  (vehicle cockpit-vehicle set-vehicle!) ; names, or #f
  (tether cockpit-tether set-tether!)
  (screen cockpit-screen set-screen!)
  (size cockpit-size set-size!)
  (view cockpit-view set-view!)
  (paint cockpit-paint set-paint!)
  (plain? cockpit-plain? set-plain!)    ; no picture
  (lamp? cockpit-lamp? set-lamp!)
  (help cockpit-help set-help!)         ; the page of the help that is shown, or #f
  (words? cockpit-words? set-words!)
  (map? cockpit-map? set-map!)
  (sticks cockpit-sticks set-sticks!)
  (message cockpit-message set-message!)
  (message-until cockpit-message-until set-message-until!)
  (slow cockpit-slow set-slow!)
  (slow-due cockpit-slow-due set-slow-due!)
  (ahead cockpit-ahead set-ahead!)      ; what is to come, strings
  (words cockpit-words set-said!)       ; the way home in words, or #f
  (ahead-due cockpit-ahead-due set-ahead-due!)
  (plan cockpit-plan set-plan!)         ; the lines of the map
  (plan-due cockpit-plan-due set-plan-due!)
  (paused? cockpit-paused? set-paused!)
  (ghost cockpit-ghost set-ghost!)      ; a dive to draw pale, #t: one that is not there yet, #f: none
  (ghost-name cockpit-ghost-name set-ghost-name!) ; what it is, a string
  (ghost-fork cockpit-ghost-fork set-ghost-fork!) ; (DIVE . STEPS-LEFT) on its way, or #f
  (done? cockpit-done? set-done!)
  (times cockpit-times set-times!)      ; when the last frames were drawn, the newest first
  (targets cockpit-targets set-targets!) ; a thunk: a list of targets
  (labels cockpit-labels set-labels!)   ; a list of targets that have a name alone
  (panel cockpit-panel set-panel!)      ; (PANEL PUT COLUMNS ROWS): draw first; the row it ends at, or #f
  (dark? cockpit-dark? set-dark!)       ; the camera sees nothing
  (orbit cockpit-orbit set-orbit!)      ; how the overview is turned and dipped, degrees, and how many times nearer; or #f
  (held-at cockpit-held-at set-held-at!) ; (COLUMN . ROW) where the mouse was last, its button down; or #f
  (releases? cockpit-releases? set-releases!) ; the terminal tells when keys come up
  (characters cockpit-characters set-characters!) ; the plain drawing and until when it is shown, a pair
  (belief? cockpit-belief? set-belief?!) ; the belief of the dive is shown, where there is one
  (believed cockpit-believed set-believed!) ; what that was when it was asked last, or #f
  (believed-due cockpit-believed-due set-believed-due!)
  ;; For its owner:
  (sent cockpit-sent set-sent!)         ; the stick values that the vehicle was told last, or #f
  (live? cockpit-live? set-live!)       ; #f: the owner's loop steps the dive
  (stepped cockpit-stepped set-stepped!)) ; by that loop, until when

;; A target is its name and where it is.
(define target cons)

(define (new-cockpit palette view paint)
  "Return a cockpit without a dive, for a terminal of PALETTE, that shows VIEW with tethers painted by PAINT."
  (make-cockpit palette (ascii-terminal?) #f #f #f #f #f view paint (eq? palette 'none) #f #f #t #f (new-sticks)
                "" 0 '((windings) (warnings)) 0 '() #f 0 '() 0 #f #f "what if" #f #f '() (const '()) '() #f #f #f #f #f '(() . 0) #t #f 0 #f #f (clock)))

(define (board! c dive)
  "Let C show DIVE, and ask of it anew."
  (let ((names (lambda (head) (let ((all (%names (engine-of dive) head))) (and (pair? all) (car all))))))
    (set-dive! c dive)
    (set-vehicle! c (names 'rov))
    (set-tether! c (names 'tether))
    (ask-anew! c)))

(define (ask-anew! c)
  "Let C forget what it knows of its dive."
  (set-slow! c '((windings) (warnings)))
  (set-ahead! c '())
  (set-said! c #f)
  (set-slow-due! c 0)
  (set-ahead-due! c 0)
  (set-plan-due! c 0)
  (set-believed! c #f)
  (set-believed-due! c 0))

(define (help-page c page)
  ;; Lines, or #f behind the last page; a margin stands at either side, the title and the hint above and below.
  (let ((size (or (cockpit-size c) '(80 . 24))))
    (keys-page (max 1 (- (car size) 4)) (- (cdr size) 2) page)))

(define (help-lines c)
  "Return the lines of the help that C shows, or #f."
  (and (cockpit-help c)
       (or (help-page c (cockpit-help c)) (help-page c 0))))

(define (turn-help! c)
  "Let C show its help, the next page of it, or behind the last none."
  (let ((next (if (cockpit-help c) (+ 1 (cockpit-help c)) 0)))
    (set-help! c (and (help-page c next) next))))

(define (look-anew! c)
  "Let the next frame be written whole."
  (set-size! c #f))

(define* (announce! c text #:optional (seconds 4))
  "Show TEXT for a while, or for SECONDS."
  (set-message! c text)
  (set-message-until! c (+ seconds (clock))))

(define (call-or-tell c thunk)
  "Call THUNK; a &bight-error that it raises is shown."
  (with-exception-handler
      (lambda (e)
        (if (bight-error? e)
            (begin (announce! c (bight-error-message e)) #f)
            (raise-exception e)))
    thunk
    #:unwind? #t))

(define-syntax-rule (trying c body ...)
  (call-or-tell c (lambda () body ...)))
