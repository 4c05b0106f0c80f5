;;; Controllers without any: streams of events, what mappings make of them, sticks that add up, and one that is lost.
;;; That devices give such events is tests/unit/controller.c's.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(use-modules (bight cockpit controller)
             (bight cockpit controller-command)
             (bight cockpit mapping)
             (srfi srfi-1))

(define (with-files . texts)
  "Return what the last of TEXTS, a procedure of file names, returns for files that hold the others."
  (apply (last texts)
         (map (lambda (text i)
                (let ((file (scratch-file (number->string i))))
                  (call-with-output-file file (lambda (port) (display text port)))
                  file))
              (drop-right texts 1) (iota (- (length texts) 1)))))

(define (flown events . mapping)
  "Return the controllers after EVENTS, text without seconds, and what came of them, in a pair."
  (apply with-files
         (string-append "(bight-events 1)" events)
         (append mapping
                 (list (lambda (stream . mapping)
                         (let ((all (open-controllers stream (and (pair? mapping) (car mapping)))))
                           (cons all (append-map (lambda (event) (note-event! all event)) (poll-events! all 0)))))))))

(define (sticks-after events . mapping)
  (controller-sticks (car (apply flown events mapping))))

(define pad "(0 plugged 0 \"Pad of somebody\" #t)")

(define-scenario a-pad-flies-as-pads-do
  "The usual mapping of a pad: left stick rises and turns, right stick goes ahead and aside; buttons are keys."
  (in open-water)
  (expect (sticks-after pad) => '(0.0 0.0 0.0 0.0))
  (expect (sticks-after (string-append pad "(0 axis 0 \"righty\" -1) (0 axis 0 \"leftx\" 1)")) => '(1.0 0.0 0.0 1.0))
  (expect (sticks-after (string-append pad "(0 axis 0 \"rightx\" -1) (0 axis 0 \"lefty\" 1)")) => '(0.0 -1.0 -1.0 0.0))
  (expect (cdr (flown (string-append pad "(0 button 0 \"a\" #t) (0 button 0 \"a\" #f) (0 button 0 \"a\" #t)"
                                     "(0 axis 0 \"righttrigger\" 0.4) (0 axis 0 \"righttrigger\" 0.9)"
                                     "(0 axis 0 \"righttrigger\" 1) (0 button 0 \"b\" #t)")))
          => '((plugged "Pad of somebody") #\space #\space #\] #\m))
  (expect (sticks-after "(0 plugged 3 \"lever\" #f) (0 axis 3 \"axis1\" -1) (0 button 3 \"hat0down\" #t)")
          => '(1.0 0.0 -1.0 0.0)))

(define-scenario dead-zones-end-nowhere-abruptly
  "Nothing in the dead zone, all at the end, and no jump between; fifty steps and no more."
  (in open-water)
  (for-each (lambda (dead)
              (expect (without-dead-zone dead dead) => 0.0)
              (expect (without-dead-zone 1 dead) => 1.0)
              (expect (without-dead-zone -1 dead) => -1.0)
              (expect (without-dead-zone (+ dead 1e-6) dead) is (between 0 1e-4))
              (expect (without-dead-zone (- -0.01 dead) dead) is (between -0.11 -0.0099)))
            '(0 0.12 0.5 0.9))
  (define (surge value) (first (sticks-after (simple-format #f "~a (0 axis 0 \"righty\" ~a)" pad value))))
  (expect (surge -0.12) => 0.0)
  (expect (map surge '(-0.56 -0.561 -0.559)) => '(0.5 0.5 0.5))
  (expect (length (delete-duplicates (map (lambda (i) (surge (* -1/200 i))) (iota 201)))) => 51))

(define-scenario several-fly-together
  "What two ask for adds up, to full and no more; each has its own clause of the mapping."
  (in open-water)
  (let ((both "(0 plugged 0 \"Foo pad\" #t) (0 plugged 1 \"BAR lever\" #f)
               (0 axis 0 \"righty\" -0.56) (0 axis 1 \"axis0\" 0.5)")
        (mapping "(bight-mapping 1) (dead-zone 0) (controller \"bar\" (surge \"axis0\") (key \"button9\" \"[\"))"))
    (expect (sticks-after both mapping) => '(1.0 0.0 0.0 0.0))
    (expect (sticks-after (string-append both "(0 axis 1 \"axis0\" -1)") mapping) => '(-0.5 0.0 0.0 0.0))
    (expect (cdr (flown (string-append both "(0 button 1 \"button9\" #t) (0 button 0 \"button9\" #t)") mapping))
            => '((plugged "Foo pad") (plugged "BAR lever") #\[))))

(define-scenario one-that-is-lost-asks-nothing
  "What a lost controller asked for is gone with it, and that is told; plugged in again it begins anew."
  (in open-water)
  (let* ((held (string-append pad "(0 axis 0 \"righty\" -1)"))
         (lost (flown (string-append held "(0 lost 0)"))))
    (expect (cdr lost) => '((plugged "Pad of somebody") (lost "Pad of somebody")))
    (expect (controller-sticks (car lost)) => '(0.0 0.0 0.0 0.0))
    (expect (controller-names (car lost)) => '())
    (expect (sticks-after (string-append held "(0 lost 0) (0 axis 0 \"righty\" -1) (0 plugged 1 \"Pad\" #t)"))
            => '(0.0 0.0 0.0 0.0))
    (expect (sticks-after (string-append held "(0 plugged 1 \"other\" #t) (0 lost 1)")) => '(1.0 0.0 0.0 0.0))))

(define-scenario streams-keep-their-times
  "An event comes when its time has come, counted from the first look."
  (in open-water)
  (with-files
   (string-append "(bight-events 1)" pad "(1.5 axis 0 \"righty\" -1) (2 lost 0)")
   (lambda (stream)
     (let ((all (open-controllers stream #f)))
       (expect (map first (poll-events! all 100)) => '(plugged))
       (expect (poll-events! all 101.4) => '())
       (expect (poll-events! all 101.5) => '((axis 0 "righty" -1)))
       (expect (map first (poll-events! all 200)) => '(lost))))))

(define-scenario what-is-no-mapping-is-refused
  "With what is wrong and what is allowed; nothing is believed before it is read."
  (in open-water)
  (for-each (lambda (text)
              (expect (with-files text read-mapping) raises format))
            '("" "(bight-mapping 2)" "(bight-mapping 1) (controller \"\" (surge \"a\" 9))"
              "(bight-mapping 1) (dead-zone 1)"
              "(bight-mapping 1) (controller \"\" (key \"a\" \"spce\"))" "(bight-mapping 1) (controller \"\" (key \"a\"))"
              "(bight-mapping 1) (exit)" "(bight-mapping 1) (controller 3)" "(bight-mapping 1" "(bight-mapping 1) #.(exit)"))
  (expect (with-files "(bight-mapping 1) (controller \"\" (serge \"a\"))" read-mapping) raises name)
  (for-each (lambda (events)
              (expect (with-files (string-append "(bight-events 1)" events) read-stream) raises format))
            '("(1 axis 0 \"a\" 2)" "(1 axis 0 \"a\")" "(2 lost 0) (1 lost 0)" "(-1 lost 0)" "(1 lost \"a\")" "(1 plugged 0 a #t)" "5"
              "(+nan.0 lost 0)"))
  (expect (open-controllers "no-such-file" #f) raises io)
  (with-files "(bight-events 1)"
    (lambda (stream)
      (expect (open-controllers stream "no-such-mapping") raises io)
      (expect (open-controllers stream (dirname stream)) raises io)
      (expect (controller-command `(("--stream" . ,stream) ("--for" . "0")
                                    ("--record" . ,(string-append (dirname stream) "/no-such-folder/record"))))
              raises io))))

(define-scenario what-is-done-is-said
  "In words that name the control, what it does, and where the sticks stand."
  (in open-water)
  (let ((all (car (flown (string-append pad "(0 axis 0 \"righty\" -1)")))))
    (expect (event-line '(axis 0 "righty" -1) all) => "0 righty -1.00   surge +1.00 sway +0.00 heave +0.00 yaw +0.00"))
  (expect (binding-line (first (bindings-for '() "pad" #t))) => "  lefty: heave -1.00, dead zone 0.12")
  (expect (binding-line (find binding-key (bindings-for '() "pad" #t))) => "  lefttrigger: key ["))
