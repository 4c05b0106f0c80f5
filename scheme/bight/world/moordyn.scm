;;; (bight world moordyn) --- lines of MoorDyn, version 2 (and the tables of version 1), as worlds, and back.
;;;
;;; An input file is sections of tables, led by a line of hyphens with the section's name in it, a line with the
;;; names of the columns and one with their units.  Columns are found by their names.  What has no counterpart
;;; (rods, bodies, free points, waves, curves for a stiffness) is refused by name, so that a world is the file's
;;; system or none.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight world moordyn)
  #:use-module (bight assembly)
  #:use-module ((bight core decimal) #:select (text->number))
  #:use-module (bight core errors)
  #:use-module (bight core schema)
  #:use-module ((bight core table) #:select (file-lines))
  #:use-module (bight core verb)
  #:use-module ((bight world atlas) #:select (type:the-world))
  #:use-module ((bight world shape) #:select (type:file-name))
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (import-moordyn export-moordyn))

;;; Sections: (NAME (NUMBER . WORDS) ...), the name in capitals.

(define (rule? line)
  (string-prefix? "---" (string-trim line)))

(define (section-name line)
  (string-join (string-tokenize (string-upcase line) char-set:letter)))

(define (sections lines)
  ;; Of LINES, (NUMBER . TEXT).
  (let loop ((rest lines) (found '()))
    (cond ((null? rest) (reverse (map (lambda (s) (cons (car s) (reverse (cdr s)))) found)))
          ((rule? (cdar rest)) (loop (cdr rest) (cons (list (section-name (cdar rest))) found)))
          ((null? found) (loop (cdr rest) found))
          (else (loop (cdr rest)
                      (cons (cons* (caar found) (cons (caar rest) (string-tokenize (cdar rest))) (cdar found))
                            (cdr found)))))))

(define (section all . names)
  ;; The rows of the first section of ALL with one of NAMES, or ().
  (or (any (lambda (name) (assoc-ref all name)) names) '()))

(define (same-word? a b) (string-ci=? a b))

(define (table rows)
  ;; Rows of a section below the names of its columns and their units: alists, with (line . NUMBER).
  (if (< (length rows) 2)
      '()
      (let ((names (cdar rows)))
        (map (lambda (row)
               (acons 'line (car row)
                      (map cons (take names (min (length names) (length (cdr row))))
                           (take (cdr row) (min (length names) (length (cdr row)))))))
             (cddr rows)))))

(define (cell proc file row . names)
  ;; The word of ROW in the first of the columns NAMES that it has.
  (or (any (lambda (name) (and=> (assoc name (filter (lambda (e) (string? (car e))) row) same-word?) cdr)) names)
      (bight-raise 'format proc "~a, line ~a has no ~a" file (assq-ref row 'line) (car names))))

(define (cell-number proc file row . names)
  (let* ((word (apply cell proc file row names)) (number (text->number word 10)))
    (if (and (real? number) (< (abs number) 1e15))
        (exact->inexact number)
        (bight-raise 'format proc "~a, line ~a: `~a' is one number here" file (assq-ref row 'line) (car names)))))


;;; Reading.

(define (refuse-entries proc file all)
  (for-each (lambda (s)
              (let ((strange (find (lambda (word) (string-prefix? word (car s))) '("ROD" "BOD" "FAILURE" "EXTERNAL"))))
                (when (and strange (pair? (table (cdr s))))
                  (bight-raise 'unsupported proc "~a, line ~a: a world has no counterpart for what is under ~a" file
                               (car (fourth (append (cdr s) (cdr s) (cdr s)))) (car s)))))
            all))

(define (options all)
  ;; alist of lower-case names and numbers, those that are numbers.
  (filter-map (lambda (row)
                (let ((words (cdr row)))
                  (and (>= (length words) 2)
                       (let ((value (text->number (first words) 10)))
                         (and (real? value) (cons (string-downcase (second words)) (exact->inexact value)))))))
              (section all "OPTIONS" "SOLVER OPTIONS")))

(define (option settings default . names)
  (or (any (lambda (name) (assoc-ref settings name)) names) default))

(define (refuse-options proc file settings)
  (for-each (lambda (name)
              (unless (zero? (option settings 0 name))
                (bight-raise 'unsupported proc "~a asks for ~a, waves or currents of files of their own: give the world its own"
                             file name)))
            '("wavekin" "currents")))

(define (point-kind proc file row)
  ;; fixed or moved.
  (let ((word (string-downcase (cell proc file row "Type" "Attachment"))))
    (cond ((member word '("fixed" "fix" "anchor")) 'fixed)
          ((member word '("coupled" "vessel" "cpld" "coupledpinned" "vesselpinned")) 'moved)
          (else (bight-raise 'unsupported proc "~a, line ~a: a point that is ~a; those of a world are fixed, or led by a vehicle"
                             file (assq-ref row 'line) word)))))

(define (points proc file all)
  ;; alist of ids: (KIND X Y Z).
  (map (lambda (row)
         (cons (cell proc file row "ID" "Node" "Point")
               (cons (point-kind proc file row)
                     (map (lambda (name) (cell-number proc file row name)) '("X" "Y" "Z")))))
       (table (section all "POINTS" "POINT PROPERTIES" "POINT LIST" "CONNECTION PROPERTIES" "CONNECTIONS"
                       "NODE PROPERTIES"))))

(define (damping given ea mass element)
  ;; N s: what is given, or for a negative number that share of the critical damping of one ELEMENT, m.
  (if (negative? given)
      (* (- given) element (sqrt (* ea mass)))
      given))

(define (type-fields proc file type element)
  (define (number . names) (apply cell-number proc file type names))
  (define v1? (assoc "Cdn" (filter (lambda (e) (string? (car e))) type) same-word?))
  (let ((ea (number "EA")) (mass (number "Mass/m" "MassDen" "MassDenInAir")))
    `((diameter ,(number "Diam"))
      (mass ,mass)
      (ea ,ea)
      (ba ,(damping (number "BA/-zeta" "BA") ea mass element))
      ,@(if v1? '() `((ei ,(number "EI"))))
      (cdn ,(number "Cd" "Cdn"))
      (cdt ,(number "CdAx" "Cdt"))
      (ca ,(number "Ca" "Can")))))

(define (led point) (string->symbol (string-append "point-" point)))

(define (end proc file row all id)
  ;; A point as the end of a tether.
  (let ((point (or (assoc-ref all id)
                   (bight-raise 'format proc "~a, line ~a: there is no point ~a" file (assq-ref row 'line) id))))
    (if (eq? 'moved (car point)) (list (led id)) (cdr point))))

(define (line-part proc file row types all-points friction)
  (define (ends)
    (map (lambda (names) (end proc file row all-points (apply cell proc file row names)))
         '(("AttachA" "NodeAnch" "NodeA") ("AttachB" "NodeFair" "NodeB"))))
  (let* ((name (cell proc file row "LineType"))
         (type (or (find (lambda (t) (string=? name (cell proc file t "TypeName" "LineType" "Name"))) types)
                   (bight-raise 'format proc "~a, line ~a: there is no line type of this name" file (assq-ref row 'line))))
         (n (inexact->exact (round (cell-number proc file row "NumSegs"))))
         (length (cell-number proc file row "UnstrLen"))
         (both (ends)))
    (unless (> n 0)
      (bight-raise 'format proc "~a, line ~a: a line has one segment or more" file (assq-ref row 'line)))
    `(tether (named ,(string->symbol (string-append "line-" (cell proc file row "ID" "Line"))))
             (from ,@(first both)) (to ,@(second both)) (length ,length) (model dynamic) (nodes ,(max 2 n))
             (friction ,friction)
             ,@(type-fields proc file type (/ length n)))))

(define-verb (import-moordyn (file file-name))
  "Return the world of the lines in FILE, an input file of MoorDyn 2: a tether line-N for each, a kinematic vehicle
point-N for each coupled point, still water and a level bed.  What MoorDyn adds to a line's mass along itself (CaAx) is
left out; its bed's stiffness is bight's own."
  (let* ((proc 'import-moordyn)
         (all (sections (file-lines proc file)))
         (settings (options all))
         (types (table (section all "LINE TYPES" "LINE DICTIONARY")))
         (lines (table (section all "LINES" "LINE PROPERTIES" "LINE LIST")))
         (known (points proc file all))
         (friction (option settings 0.3 "frictioncoefficient" "mu_kt")))
    (refuse-entries proc file all)
    (refuse-options proc file settings)
    (when (or (null? types) (null? lines))
      (bight-raise 'format proc "~a is no input file of MoorDyn: it has no section LINE TYPES, or none LINES" file))
    (build-world #f (string-append "The lines of " (basename file) ".") #f
                 (map data->part
                      `((sea (depth ,(option settings 100. "wtrdpth" "depth"))
                             (density ,(option settings 1025. "wtrdnsty" "rhow" "rho"))
                             (gravity ,(option settings 9.81 "g" "gravity")))
                        (seabed (friction ,friction))
                        ,@(filter-map (lambda (point)
                                        (and (eq? 'moved (cadr point))
                                             `(rov (named ,(led (car point))) (type kinematic) (at ,@(cddr point)))))
                                      known)
                        ,@(map (lambda (row) (line-part proc file row types known friction)) lines))))))


;;; Writing.

(define (value-of part name)
  ;; Of the field NAME of PART: its own, its type's, or the default.
  (let ((entry (assq name (all-fields part))))
    (if entry (cdr entry) (field-default (head-field (part-head-of part) name)))))

(define (all-of head parts)
  (filter (lambda (part) (eq? head (part-head-of part))) parts))

(define (mass-of tether sea)
  (or (assq-ref (all-fields tether) 'mass)
      (let ((d (value-of tether 'diameter)))
        (+ (/ (or (value-of tether 'wet-weight) 0) (value-of sea 'gravity))
           (* (value-of sea 'density) (acos -1) 1/4 d d)))))

(define stiffest 1e11)                  ; N: in place of a line that does not stretch

(define (end-point parts value)
  ;; (KIND X Y Z) of the end VALUE of a tether.
  (if (symbol? value)
      (cons "Coupled" (f64vector->list (value-of (find-part parts value) 'at)))
      (cons "Fixed" (f64vector->list value))))

(define (left-out parts)
  ;; The names of what MoorDyn's file will not have.
  (append
   (filter-map (lambda (part)
                 (and (or (not (memq (part-head-of part) '(sea rov tether seabed)))
                          (assq 'grid (all-fields part)) (assq 'mesh (all-fields part))
                          (assq 'clump (all-fields part)) (assq 'float (all-fields part)))
                      (part-name-of part)))
               parts)
   (let ((sea (car parts)))
     (filter (lambda (name) (assq name (all-fields sea))) '(current waves)))))

(define (write-row port . cells)
  (for-each (lambda (c)
              (let ((text (if (number? c) (number->string c) c)))
                (display (string-pad-right text (max 10 (string-length text))) port)
                (display " " port)))
            cells)
  (newline port))

(define (write-section port title names units rows)
  (simple-format port "---------------------- ~a ----------------------\n" title)
  (apply write-row port names)
  (apply write-row port units)
  (for-each (lambda (row) (apply write-row port row)) rows))

(define (type-row tether sea)
  (list (symbol->string (part-name-of tether)) (value-of tether 'diameter) (mass-of tether sea)
        (min stiffest (value-of tether 'ea)) (value-of tether 'ba) (value-of tether 'ei)
        (value-of tether 'cdn) (value-of tether 'ca) (value-of tether 'cdt) 0.))

(define (write-deck port parts tethers)
  (let ((sea (car parts)) (ids (iota (length tethers) 1)))
    (display "--------------------- MoorDyn Input File ----------------------\nWritten by bight.\n" port)
    (write-section port "LINE TYPES"
                   '("TypeName" "Diam" "Mass/m" "EA" "BA/-zeta" "EI" "Cd" "Ca" "CdAx" "CaAx")
                   '("(name)" "(m)" "(kg/m)" "(N)" "(N-s/-)" "(N-m^2)" "(-)" "(-)" "(-)" "(-)")
                   (map (lambda (tether) (type-row tether sea)) tethers))
    (write-section port "POINTS" '("ID" "Type" "X" "Y" "Z" "Mass" "Volume" "CdA" "Ca")
                   '("(#)" "(-)" "(m)" "(m)" "(m)" "(kg)" "(m^3)" "(m^2)" "(-)")
                   (append-map (lambda (tether i)
                                 (map (lambda (field id)
                                        `(,(number->string id) ,@(end-point parts (value-of tether field)) 0. 0. 0. 0.))
                                      '(from to) (list (- (* 2 i) 1) (* 2 i))))
                               tethers ids))
    (write-section port "LINES" '("ID" "LineType" "AttachA" "AttachB" "UnstrLen" "NumSegs" "LineOutputs")
                   '("(#)" "(name)" "(#)" "(#)" "(m)" "(-)" "(-)")
                   (map (lambda (tether i)
                          (list (number->string i) (symbol->string (part-name-of tether))
                                (number->string (- (* 2 i) 1)) (number->string (* 2 i))
                                (value-of tether 'length) (inexact->exact (value-of tether 'nodes)) "-"))
                        tethers ids))
    (simple-format port "---------------------- OPTIONS ----------------------\n")
    (for-each (lambda (value name) (write-row port value name))
              (list (value-of sea 'depth) (value-of sea 'density) (value-of sea 'gravity)
                    (value-of (car tethers) 'friction))
              '("WtrDpth" "WtrDnsty" "g" "FrictionCoefficient"))
    (display "---------------------- end ----------------------\n" port)))

(define-verb (export-moordyn (w the-world) (file file-name))
  "Write the tethers of the world W to FILE, an input file of MoorDyn 2: a line type and a line for each, a fixed point
for each end that is one, a coupled point for each that a vehicle holds.  Return the names of what the file has no place
for: obstacles, beds that are not level, clumps and floats, current and waves."
  (let* ((parts (world-parts-of w)) (tethers (all-of 'tether parts)))
    (when (null? tethers)
      (bight-raise 'def 'export-moordyn "a world without a tether has nothing for MoorDyn"))
    (catch 'system-error
      (lambda () (call-with-output-file file (lambda (port) (write-deck port parts tethers))))
      (lambda args
        (bight-raise 'io 'export-moordyn "cannot write ~s: ~a" file (strerror (system-error-errno args)))))
    (left-out parts)))
