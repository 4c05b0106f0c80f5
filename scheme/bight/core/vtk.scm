;;; (bight core vtk) --- lines and points in VTK's XML files, and the list of those of a series.
;;;
;;; A .vtp file holds the lines and points of one moment, its numbers as they are in memory behind the XML; a .pvd
;;; file names the .vtp files and their times, and is what ParaView opens.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core vtk)
  #:use-module ((bight core markup) #:select (as-xml))
  #:use-module ((ice-9 binary-ports) #:select (open-bytevector-output-port put-bytevector))
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (vtp-bytes pvd-bytes))

(define byte-order
  (if (eq? 'little (native-endianness)) "LittleEndian" "BigEndian"))

(define (size-bytes n)
  (let ((bytes (make-bytevector 8)))
    (bytevector-u64-native-set! bytes 0 n)
    bytes))

(define (array type name components)
  ;; A procedure of the offset of its numbers that returns the element.
  (lambda (offset)
    (simple-format #f "<DataArray type=\"~a\" Name=\"~a\" NumberOfComponents=\"~a\" format=\"appended\" offset=\"~a\"/>\n"
                   type name components offset)))

(define (offsets data)
  ;; Where each of DATA, bytevectors, begins behind the XML, its size before it.
  (reverse (cdr (fold (lambda (bytes offsets) (cons (+ (car offsets) 8 (bytevector-length bytes)) offsets))
                      '(0) data))))

(define (ends sizes)
  ;; Where each of the cells of SIZES, one behind another, ends.
  (list->s64vector (cdr (reverse (fold (lambda (n ends) (cons (+ n (car ends)) ends)) '(0) sizes)))))

(define (vtp-bytes places lines numbers)
  "Return the bytes of a .vtp file: PLACES, lists (X Y Z), are points by themselves; LINES are lists of such
lists; NUMBERS are named numbers of all points in this order, an alist of strings and lists."
  (let* ((points (append places (concatenate lines)))
         (n (length places))
         (data (append
                (map (lambda (entry) (list->f64vector (cdr entry))) numbers)
                (list (list->s64vector (iota (+ n (length lines))))
                      (list->f64vector (concatenate points))
                      (list->s64vector (iota n)) (ends (make-list n 1))
                      (list->s64vector (iota (- (length points) n) n)) (ends (map length lines)))))
         (elements (append (map (lambda (entry) (array "Float64" (as-xml (car entry)) 1)) numbers)
                           (list (array "Int64" "part" 1) (array "Float64" "Points" 3)
                                 (array "Int64" "connectivity" 1) (array "Int64" "offsets" 1)
                                 (array "Int64" "connectivity" 1) (array "Int64" "offsets" 1))))
         (texts (map (lambda (element offset) (element offset)) elements (offsets data)))
         (own (take texts (length numbers))) (rest (drop texts (length numbers))))
    (call-with-values open-bytevector-output-port
      (lambda (port get)
        (define (text . words) (put-bytevector port (string->utf8 (string-concatenate words))))
        (text "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"" byte-order
              "\" header_type=\"UInt64\">\n<PolyData>\n"
              (simple-format #f "<Piece NumberOfPoints=\"~a\" NumberOfVerts=\"~a\" NumberOfLines=\"~a\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n"
                             (length points) n (length lines))
              "<PointData>\n" (string-concatenate own) "</PointData>\n<CellData>\n" (first rest) "</CellData>\n"
              "<Points>\n" (second rest) "</Points>\n<Verts>\n" (third rest) (fourth rest) "</Verts>\n"
              "<Lines>\n" (fifth rest) (sixth rest) "</Lines>\n</Piece>\n</PolyData>\n"
              "<AppendedData encoding=\"raw\">\n_")
        (for-each (lambda (bytes)
                    (put-bytevector port (size-bytes (bytevector-length bytes)))
                    (put-bytevector port bytes))
                  data)
        (text "\n</AppendedData>\n</VTKFile>\n")
        (get)))))

(define (pvd-bytes entries)
  "Return the bytes of a .pvd file that lists ENTRIES, pairs of a time in seconds and the name of a file."
  (string->utf8
   (string-append
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
    (string-concatenate
     (map (lambda (entry)
            (simple-format #f "<DataSet timestep=\"~a\" part=\"0\" file=\"~a\"/>\n" (car entry) (as-xml (cdr entry))))
          entries))
    "</Collection>\n</VTKFile>\n")))
