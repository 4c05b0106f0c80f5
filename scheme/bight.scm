;;; (bight) --- the language of bight: one module to import.
;;;
;;; The facade only hands on what other modules define.  The modules every dive needs are loaded at
;;; once; those that a dive may never need are loaded when one of their names is first used, be it a
;;; procedure or a macro.  The second list must name what they export: tests/scheme/scenario.scm asks.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight)
  #:use-module ((bight core verb) #:select (define-verb))
  #:export (language-names))

;; Modules, each alone if all its names belong to the language, else with the names that do.
(define at-once
  '(((bight core errors)
     &bight-error bight-error? bight-error-kind bight-error-procedure bight-error-message
     bight-error-given)
    ((bight core units))
    ((bight world types) define-tether-type define-vehicle tether-types vehicle-types)
    ((bight world)
     world define-world extend without with part worlds find-world
     world? world-name world-documentation world-parts world-file world-part-names world-part
     part? part-head part-name part-fields part-all-fields)
    ((bight dive) enter! with-dive dive? current-dive)
    ((bight dive task) every on cancel!)
    ((bight dive pilot) define-pilot make-pilot with-pilot)
    ((bight dive time) now time-step run run-until step! settle!)
    ((bight dive checkpoint) checkpoint checkpoint? restore! rewind! what-if state-hash)
    ((bight dive command))
    ((bight dive query)
     rov-position rov-velocity rov-heading rov-pitch rov-roll rov-depth rov-altitude rov-over rov-speed
     net-turns sticks held? range-to bearing-to current-at sea-depth
     tether-points tether-tail point-at tangent-at tensions tension-at
     anchor-tension rov-tension max-tension tether-force
     tether-twist tether-torque anchor-torque
     tether-length straight-distance taut-length free-length slack excess
     taut? parted? asleep? settled? model-of energy error-estimate accurate? tightest-bend equilibria
     deviation deviation? deviation-rms deviation-mean deviation-max deviation-worst
     events profile parts)))

(define when-used
  '(((bight world build)
     make-jacket make-pier make-wreck make-hull make-net-pen make-pipeline make-ice-hole make-tunnel
     make-wellhead make-rigging)
    ((bight dive contact)
     contacts contact? contact-object contact-triangle contact-position contact-normal
     contact-arc-length contact-force contact-state contact-tail?
     segments segment? segment-model segment-from segment-to segment-length segment-ends segment-tail?
     clearance rov-clearance collide! collided? stuck? wear wear-profile)
    ((bight test scenario)
     define-scenario always never eventually skip run-scenario scenarios test-seed
     expect require about between above below)
    ((bight core scratch) scratch-file)
    ((bight test property) define-property assume)
    ((bight test generator) uniform integer one-of any-of list-of point-in made-of generator?)
    ((bight world random-dive) random-parts random-world random-pilot)
    ((bight test invariant)
     all-finite? nothing-crossed? energy-bounded? strain-watcher turns-watcher same-again?
     always-sound)
    ((bight lesson)
     define-lesson run-lesson last-answer counter count! setting jitter tell! told messages
     messages-left number-in way-flown off-the-way
     report? report-total report-passed? report-marks report-said report-text report-hash
     report-coached report-hints report-rewinds report-seconds report-instructed)
    ((bight lesson file) lessons)
    ((bight study) define-study)
    ((bight study case) study? study-cases run-case)
    ((bight study risk) wilson-interval)
    ((bight identify) identify)
    ((bight identify rehearse) measure!)
    ((bight identify found)
     identification? identified identified-correlations identified-covariance identified-score
     identified-type identified-warnings residuals-in-time residuals-along)
    ((bight dive aware)
     winding turns windings wrap-angle capstan-lock
     homotopy-class homotopy-class? class-decided? class-free?
     knotted? fouled? foul-reason free-to-haul? haul-trial haul-prospect
     way-home way-home-preview unwind-plan slack-to-reach follow-string)
    ((bight dive figures) contact-length seabed-length bend-ratio snap-count thrust-share)
    ((bight dive homing) fly-home! home-trial unwind-preview)
    ((bight dive tour)
     tour? tour-names tour-places tour-way tour-length tour-line-needed tour-left-out tour-risk)
    ((bight dive tour-flight) fly-tour! tour-trial)
    ((bight belief tour) plan-tour)
    ((bight dive foresight)
     foresee foresight? foresight-kind foresight-object foresight-seconds foresight-confidence
     foresight-turns)
    ((bight dive in-words) in-words)
    ((bight dive probe)
     awareness-probes probe-question probe-level probe-truth probe-stable? probe-error probe-score)
    ((bight cockpit coach) make-coach coach-looks! coach-log coach-rules define-coach-rule)
    ((bight test command) run-tests)
    ((bight dive instruments)
     instruments compass depth-sensor altimeter speed-log turn-counter ship-range ship-bearing
     load-cell payout-counter transponders fault! mend! faults thrusts sonar in-view? tether-in-view)
    ((bight dive saving) save! load-dive)
    ((bight dive recording)
     record! stop-recording! recording?)
    ((bight dive replay)
     replay difference? difference-step difference-time difference-quantities)
    ((bight dive flight) keep-flight!)
    ((bight dive frames) export-csv)
    ((bight dive export) export-npz export-vtk export-gltf)
    ((bight world moordyn) import-moordyn export-moordyn)
    ((bight world orcaflex) import-orcaflex)
    ((bight dive live) live! freeze! live?)
    ((bight dive threads) threads! threads)
    ((bight belief)
     believe! define-belief make-belief belief ask-belief belief? with-belief current-belief
     observe! mend-belief! belief-doubts effective-size belief-values belief-about belief-hash fork-belief belief-threads!
     tether-tube tube-holds?)
    ((bight belief keeping) save-belief! load-belief)
    ((bight belief advise) advise advice? advice-action advice-chances)
    ((bight belief answer)
     answer? answer-values answer-weights answer-probability answer-interval answer-quantile answer-mean
     answer-covariance answer-shares)
    ((bight lesson logbook)
     log-dive! log-lesson! log-probe! logbook logbook-file merge-logbook!
     log-entry? log-entry-kind log-entry-when log-entry-trainee log-entry-what log-entry-score
     log-entry-data)
    ((bight view) look)
    ((bight view status) status)
    ((bight view picture) snapshot show)
    ((bight cockpit view) pilot!)
    ((bight view film) film)
    ((bight view plot) plot sample! samples? samples-rows)
    ((bight world describe) describe)
    ((bight shell doc) help)))

;; Names that stand for more than those of Guile and its SRFIs.
(define in-place-of-guile-s '(help every))

(define interface (module-public-interface (current-module)))

(define (hand-on! entry)
  (module-use! interface
               (if (null? (cdr entry))
                   (resolve-interface (car entry))
                   (resolve-interface (car entry) #:select (cdr entry)))))

(define (look-further module name define?)
  ;; The binder of the interface, asked for every NAME it does not hold: a variable, or #f.
  (or-map (lambda (entry)
            (and (memq name (cdr entry))
                 (module-variable (resolve-interface (car entry)) name)))
          when-used))

(define-verb (language-names)
  "Return the sorted list of all names of the language."
  (define (names-of module)
    (append (module-map (lambda (name variable) name) module)
            (apply append (map names-of (module-uses module)))))
  (sort (append (names-of interface) (apply append (map cdr when-used)))
        (lambda (a b) (string<? (symbol->string a) (symbol->string b)))))

(for-each hand-on! at-once)
(set-module-binder! interface look-further)
(for-each (lambda (name) (hashq-set! (module-replacements interface) name #t))
          in-place-of-guile-s)

;; An alist from the modules to the names that each gives to the language, for (bight shell topics).
(set-procedure-property!
 language-names 'by-module
 (lambda ()
   (cons '((bight core errors) language-names)
         (append (map (lambda (entry)
                        (cons (car entry)
                              (if (null? (cdr entry))
                                  (module-map (lambda (name variable) name) (resolve-interface (car entry)))
                                  (cdr entry))))
                      at-once)
                 when-used))))
