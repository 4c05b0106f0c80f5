;;; (bight shell commands) --- the commands of the program: the table that all help is made of.
;;;
;;; One entry each; of these are made help, the manual page, the completion of shells, and the options known.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight shell commands)
  #:use-module (bight core errors)
  #:use-module (bight core late)
  #:use-module (bight core options)
  #:use-module (bight shell program)
  #:use-module (bight shell tasks)
  #:use-module (bight shell usage)
  #:use-module (srfi srfi-1)
  #:export (commands command-called first-words do-command print-usage))

(define commands
  (list
   (command "" #f "" '("the prompt; (help) there is a short tour"))
   (command "FILE.scm" #f "[ARG...]" '("run a script"))
   (command "-c" run-expression "EXPR" '("evaluate expressions and print their values"))
   (command "-" (lambda (arguments) (run-input ignore arguments)) ""
            '("run what comes on standard input"))
   (command "test" run-tests "[PATH...]"
            '("run scenario tests, print TAP; a PATH is a file or a folder")
            '("-j N" "so many at once; when left out, as many as there are cores")
            '("--only RE" "those alone whose name the regular expression matches")
            '("-k WORDS" "those alone whose file, name or sentence has the words, as \"bow and not slow\"")
            '("--last-failed" "those alone that failed when they were last run; all if none did")
            '("--fail-fast" "none after one that failed")
            '("--durations N" "tell the N slowest")
            '("--watch" "run them, then again what changes, until C-c; w shows how one failed, in the cockpit")
            '("--junit FILE" "write the report as JUnit XML too")
            '("--seed N" "begin the random things of every scenario with N; 1 when left out")
            '("--cases N" "try every property on N cases")
            '("--limit S" "seconds of processor time a scenario may take; 0 for no limit,"
              "600 when left out")
            '("--reproducers DIR" "write what shrinks a property that fails to DIR, as scenarios")
            '("--catalogue DIR" "write a page with a sentence and a view of each scenario and"
              "world to DIR")
            '("--list" "run nothing; print the scenarios with their sentences"))
   (command "lessons" (lambda (arguments) ((from (bight lesson command) lessons-command) arguments)) ""
            '("list the lessons with marks, or the marks of a group")
            '("--trainee WHO" "whose marks")
            '("--skills" "how well he has each skill, estimated from all marks, with intervals")
            '("--merge FILE" "take over what the logbook FILE, of another machine, has and yours has not")
            '("--group G" "the marks of all in the group")
            '("--group" "all groups compared, with intervals")
            '("--csv" "as comma-separated values"))
   (command "lesson" (lambda (arguments) ((from (bight lesson command) lesson-command) arguments))
            "[NAME|FILE]"
            '("take a lesson, or go on with it; a FILE from outside is enclosed; without one: which is next,"
              "and why")
            '("--trainee WHO" "who takes it")
            '("--group G" "the group he belongs to")
            '("--level L" "easy, normal or hard")
            '("--seed N" "begin what is random in it with N; 1 when left out")
            '("--display D" "which views are shown: three, plan or none; three when left out")
            '("--typed" "fly by what is typed, not by keys")
            '("--fresh" "from its beginning, not from where it was left")
            '("--instructor SOCKET" "let an instructor in at SOCKET: bight instruct SOCKET")
            '("--controller C" "fly by game controllers too: any, or the file of what bight controller recorded")
            '("--mapping FILE" "what their axes and buttons do")
            '("--quiet" "without the coach")
            '("--trust" "let a FILE from outside do all that you may")
            '("--pilot P" "show it flown by its pilot P, such as expert")
            '("--check" "prove it: its pilots fly it, the careless one in vain; every hint can be reached"))
   (command "experiment"
            (lambda (arguments) ((from (bight lesson experiment-command) experiment-command) arguments)) ""
            '("take part in an experiment: what does one learn who sees his tether not, from above, or in"
              "three dimensions?  consent, the draw of a group, then step by step each time")
            '("--trainee WHO" "who takes part")
            '("--table" "marks of the groups, with intervals"))
   (command "bench" run-benches "[NAME...]"
            '("measure run time against error: all families, short, in five minutes, or the whole of some;"
              "other options go to the one bench that is named")
            '("-o DIR" "where text, CSV, JSON, plots and a page go; bight-bench when left out")
            '("--data DIR" "of validation: measurements, other codes' results and tables to be held against")
            '("--list" "run nothing; print the benches there are")
            '("--quick" "the short form of those named")
            '("--minutes M" "repeat it round by round for so long; 5 when none is named")
            '("--rounds N" "repeat it so often")
            '("--compare OLD" "a report.json, or the programs' folder of another build: run again and say"
              "what is better, worse or noise; with a second .json compare the two; exit 1 if an error grew"))
   (command "snapshot" take-snapshot "WORLD..."
            '("write a picture of a world, or of several worlds or times into a folder")
            '("-o FILE" "the picture, a PNG; the folder of several")
            '("--view V" "chase, pilot, top, side, north, east, overview, plan or sonar")
            '("--size WxH" "in pixels")
            '("--paint P" "colour tethers plain, by tension, curvature or model")
            '("--overlay O" "figures, none, contacts, turns, taut-string, bvh, current; or several, with commas")
            '("--at X,Y,Z" "with this point in the middle")
            '("--extent M" "so many metres across")
            '("--zoom N" "so many times nearer")
            '("--visibility M" "in turbid water, in which one sees so many metres")
            '("--lights L" "lights at the camera: on or off")
            '("--run S" "as it is S seconds into a dive; several with commas")
            '("--trust" "let a file from outside do all that you may"))
   (command "pilot" fly "WORLD"
            '("fly a world live from the keyboard; ? there shows the keys")
            '("--view V" "which view it begins with")
            '("--paint P" "colour tethers plain, by tension, curvature or model")
            '("--colors C" "true, many, few or none")
            '("--instructor SOCKET" "let an instructor in at SOCKET: bight instruct SOCKET")
            '("--controller C" "fly by game controllers too: any, or the file of what bight controller recorded")
            '("--mapping FILE" "what their axes and buttons do")
            '("--belief B" "show a belief: clauses as (current (error 0.1)) says them, or a file of these")
            '("--tethers N" "how many tethers the belief has; 32 when left out")
            '("--trust" "let a file from outside do all that you may"))
   (command "controller" show-controllers ""
            '("show which game controllers there are, and what each axis and button does as it is moved, until C-c")
            '("--mapping FILE" "what their axes and buttons do")
            '("--record FILE" "keep what is done, to be flown again")
            '("--stream FILE" "show what was recorded, not what is plugged in")
            '("--for S" "end after so many seconds"))
   (command "instruct" instruct "SOCKET"
            '("an instructor's station: see the dive of a pupil who listens at SOCKET, hand in words, currents,"
              "obstacles adrift, faults, a lost light, a stopped clock; without a terminal, orders as lines of standard input"))
   (command "sweep" run-sweep "STUDY|FILE..."
            '("fly all cases of a study into one SQLite result; again, only what is missing")
            '("-j N" "so many dives at a time; when left out, as many as there are cores")
            '("-o FILE" "the result, or the picture of --map; STUDY.db here when left out")
            '("--shard I/N" "only the I-th of N parts, into a result of its own")
            '("--again" "also what failed or was timed out before")
            '("--patience S" "wait so long while another sweep writes the result")
            '("--slurm" "let Slurm fly it, in an array of tasks and a job that merges; wait for them")
            '("--tasks N" "with --slurm, in so many parts; 16 when left out")
            '("--detach" "with --slurm, wait for nothing")
            '("--sbatch OPTS" "with --slurm, more options for sbatch, as in --sbatch \"-p long --mem=4G\"")
            '("--case K" "fly the case K alone and print it")
            '("--merge" "bight sweep --merge RESULT SHARD...: put shards together")
            '("--table" "print what the RESULT says, in groups, with 95 % intervals")
            '("--rows" "print all cases of the RESULT, comma-separated")
            '("--map" "print the risk after each leg, or draw it, SVG or PNG by -o")
            '("--by V,..." "group by these variables; those the study lists when left out")
            '("--of MEASURE" "what to map; the first that is true or false when left out")
            '("--csv" "as comma-separated values"))
   (command "identify" run-identify "RUN.csv..."
            '("find what is unknown of a real tether from measurements: places of markers and forces over time;"
              "values with 90 % intervals, a score on what was held out, and a type of tether")
            '("--unknown U,..." "ea, ei, diameter, mass, wet-weight, cdn, cdt, ca, ba, bending-damping, gj,"
              "ei-stuck, slip-curvature, friction,"
              "length, set, tilt, vertical, current, clock, places")
            '("--type T" "a type of tether that it is like")
            '("--known N=V,..." "fields of the tether, as in diameter=0.004,mass=0.05,length=12")
            '("--places M,..." "where its markers are, in metres from the anchor")
            '("--clamped" "the first two and last two markers are held")
            '("--start S" "rest, or moving: along the markers of the first row")
            '("--hold-out H" "the share of each run that is not looked at; 0.5 when left out")
            '("--held H" "last, or all-over: of each tenth of a run")
            '("--loss L" "huber, cauchy or squares")
            '("--sigma COLUMN" "the column that tells how sure each row is, in metres or the unit it names")
            '("--density D" "of the water, kg/m3; 1000 when left out")
            '("--floor Z" "the height of a flat floor, in metres")
            '("--intervals N" "of the line that is flown; 60 when left out")
            '("--set-pieces N" "parts of equal length that an unknown set is found of; 1 when left out")
            '("--step S" "of its solver at most, in seconds; 0.01 when left out")
            '("--plot FILE" "how far off it is over time, and beside that file along the line, SVG or PNG")
            '("--name NAME" "of the type that is made; identified when left out")
            '("-o FILE" "write the type there, a script to be loaded, not to the terminal"))
   (command "replay" run-replay "FILE"
            '("do again what was recorded; exit 1 if it comes out otherwise"))
   (command "watch" watch "FILE"
            '("watch a recording in the terminal: play, pause, back and forth, from event to event; ? shows keys")
            '("--ghost OTHER" "with another recording pale beside it, such as the expert's")
            '("--at S" "standing still at this second of the recording, or at its end, as where a test failed")
            '("--film OUT" "write a film of it, or of a stretch, instead")
            '("--from S" "where the stretch begins, in seconds of the recording")
            '("--to S" "where it ends"))
   (command "follow" follow "SOURCE"
            '("let a real vehicle's telemetry drive a dive: udp:PORT of this machine or a .tlog (MAVLink, as of"
              "ArduSub), or a table with named columns from a file, a pipe, a socket or - ; nothing is sent there")
            '("--in WORLD" "where it dives: a world or a file; open-water when left out")
            '("--from-start" "take its first position for the place of the world's vehicle")
            '("--record FILE" "record the dive, for bight replay and bight watch")
            '("--keep FILE" "keep what comes, frames as a .tlog, to be followed again")
            '("--belief B" "carry a belief: clauses as (current (error 0.1)) says them, or a file of these")
            '("--tethers N" "how many tethers the belief has; 32 when left out")
            '("--tension-noise N" "the deviation of the tension that is told, newtons; 1 when left out")
            '("--for S" "end after so many seconds of the dive")
            '("--pace P" "from a file, in the cockpit: seconds in a second; 1 when left out")
            '("--view V" "which view the cockpit begins with")
            '("--plain" "in lines, without the cockpit, as where there is no terminal")
            '("--every S" "in lines: one each so many seconds of the dive; 10 when left out")
            '("--trust" "let a world from outside do all that you may"))
   (command "--listen[=SOCKET]" #f "[...]"
            '("do the rest, or open the prompt, and serve another prompt on a"
              "unix socket, yours alone, to an editor"))
   (command "--door[=SOCKET]" #f "[...]"
            '("the same for another program: a line there is a form or an answer"))
   (command "--completion" (lambda (arguments) (complete arguments)) "bash|zsh"
            '("print what a shell reads to complete words and options"))
   (command "--environment" print-environment ""
            '("print what a shell sets for plain guile to find (bight):"
              "eval \"$(bight --environment)\""))
   (command "--version" print-version "" '("print the version"))
   (command "--help" (lambda (arguments) (print-usage arguments)) "[COMMAND|all]"
            '("print this, or the options of a command"))))

(define (complete arguments)
  (unless (and (= 1 (length arguments)) (print-completion commands (car arguments)))
    (bad-usage "--completion needs a shell after it, bash or zsh"))
  0)

(define command-names
  (map command-name (filter command-run commands)))

;; What may be the first word, to name the one that was meant.
(define first-words
  (append (delete "-" command-names) '("--listen")))

(define (command-called word)
  ;; The command that WORD names, or #f.
  (find (lambda (command) (and (command-run command) (string=? word (command-name command))))
        commands))

(define closing-words "
A script and the prompt know the whole language; `(use-modules (bight))' gives it to plain guile.
`bight COMMAND --help' tells the options of a command.
Exit status: 0 if all is well, else 1 with a line on standard error.
")

(define (print-usage arguments)
  (cond ((null? arguments)
         (print-overview commands)
         (display closing-words))
        ((string=? (car arguments) "all") (for-each print-help commands))
        ((command-called (car arguments)) => print-help)
        (else (bad-usage "there is no command ~a~a" (car arguments)
                         (did-you-mean (car arguments) command-names))))
  0)

(define (help-wanted? arguments)
  (and (pair? arguments)
       (not (string=? "--" (car arguments)))
       (or (member (car arguments) '("--help" "-h"))
           (help-wanted? (cdr arguments)))))

(define (do-command command arguments)
  (if (and (help-wanted? arguments) (not (member (command-name command) '("-c" "-"))))
      (print-usage (list (command-name command)))
      ((command-run command) arguments)))
