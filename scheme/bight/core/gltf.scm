;;; (bight core gltf) --- lines and bodies that move, as a scene in binary glTF 2.0, which Blender reads.
;;;
;;; A line is a tube on a skeleton, a joint for each of its points, with a key for each moment; a body is a small hull
;;; with keys of its own.  Numbers are metres, x east, y north, z up; the scene's root turns z to glTF's y.
;;; See the glTF 2.0 specification (Khronos, 2021), sections 3.6 (binary data), 3.7.3 (skins), 3.11 (animations), 4.4.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight core gltf)
  #:use-module (bight core json)
  #:use-module (bight core quaternion)
  #:use-module (bight core record)
  #:use-module (rnrs bytevectors)
  #:use-module (srfi srfi-1)
  #:use-module (srfi srfi-4)
  #:export (glb-bytes scene?))

(define sides 6)                        ; of a tube


;;; What a file is gathered in: its numbers, and the entries of its lists, the newest first.

(define-record <scene>
  (make-scene chunks size lists)
  scene?
  (chunks scene-chunks set-scene-chunks!) ; bytevectors
  (size scene-size set-scene-size!)       ; of them all
  (lists scene-lists set-scene-lists!))   ; an alist from the name of a list to its entries

(define (add! scene name entry)
  ;; Add ENTRY to the list NAME; return its index.
  (let ((entries (or (assoc-ref (scene-lists scene) name) '())))
    (set-scene-lists! scene (assoc-set! (scene-lists scene) name (cons entry entries)))
    (length entries)))

(define (padded bytes filler)
  ;; BYTES and as many FILLER as make their number a multiple of 4.
  (let* ((n (bytevector-length bytes)) (all (make-bytevector (* 4 (quotient (+ n 3) 4)) filler)))
    (bytevector-copy! bytes 0 all 0 n)
    all))

(define (add-numbers! scene type width vector component . bounds)
  ;; Add the numbers of VECTOR, WIDTH for each element of TYPE; return the index of their accessor.
  (let* ((bytes (padded vector 0)) (n (bytevector-length vector))
         (view (add! scene "bufferViews" `(("buffer" . 0) ("byteOffset" . ,(scene-size scene)) ("byteLength" . ,n)))))
    (set-scene-chunks! scene (cons bytes (scene-chunks scene)))
    (set-scene-size! scene (+ (scene-size scene) (bytevector-length bytes)))
    (add! scene "accessors"
          `(("bufferView" . ,view) ("componentType" . ,component) ("type" . ,type)
            ("count" . ,(quotient n (* width (if (= component 5126) 4 2)))) ,@bounds))))

(define (add-floats! scene type width lists . bounds)
  (apply add-numbers! scene type width (list->f32vector (concatenate lists)) 5126 bounds))

(define (add-shorts! scene type width lists)
  (add-numbers! scene type width (list->u16vector (concatenate lists)) 5123))

(define (as-single x) (f32vector-ref (f32vector x) 0))

(define (bounds-of lists)
  ;; The least and greatest of each coordinate, as the file rounds them.
  (map (lambda (name choose) (cons name (list->vector (map as-single (apply map choose lists)))))
       '("min" "max") (list min max)))


;;; Meshes.

(define (add-mesh! scene name places triangles . attributes)
  (add! scene "meshes"
        `(("name" . ,name)
          ("primitives"
           . ,(vector `(("attributes" ("POSITION" . ,(apply add-floats! scene "VEC3" 3 places (bounds-of places)))
                         ,@attributes)
                        ("indices" . ,(add-shorts! scene "SCALAR" 1 triangles))))))))

(define (quad a b c d) (list (list a b c) (list a c d)))

(define (tube-triangles n)
  (append-map (lambda (i)
                (append-map (lambda (k)
                              (let ((next (modulo (+ k 1) sides)) (a (* i sides)) (b (* (+ i 1) sides)))
                                (quad (+ a k) (+ a next) (+ b next) (+ b k))))
                            (iota sides)))
              (iota (- n 1))))

(define (ring turn)
  ;; Unit vectors about the tangent that TURN leads z to.
  (map (lambda (k)
         (let ((angle (/ (* 2 k (acos -1)) sides)))
           (rotated turn (list (cos angle) (sin angle) 0))))
       (iota sides)))

(define hull                            ; its bow is ahead: y
  (append-map (lambda (z) (map (lambda (p) (append p (list z)))
                               '((-0.2 -0.3) (0.2 -0.3) (0.2 0.1) (0 0.3) (-0.2 0.1))))
              '(-0.15 0.15)))

(define hull-triangles
  (append '((0 2 1) (0 3 2) (0 4 3) (5 6 7) (5 7 8) (5 8 9))
          (append-map (lambda (k) (let ((next (modulo (+ k 1) 5))) (quad k next (+ 5 next) (+ 5 k)))) (iota 5))))


;;; What moves.

(define (add-node! scene name place turn . more)
  (add! scene "nodes" `(("name" . ,name) ("translation" . ,(list->vector place)) ("rotation" . ,(list->vector turn))
                        ,@more)))

(define (channel-of! scene samplers times node path type width keys)
  ;; The channel that leads PATH of NODE through KEYS; its sampler is added to SAMPLERS, a scene of its own.
  (let ((output (add-floats! scene type width keys)))
    `(("sampler" . ,(add! samplers "samplers" `(("input" . ,times) ("output" . ,output))))
      ("target" ("node" . ,node) ("path" . ,path)))))

(define (channels-of! scene samplers times node places turns)
  (list (channel-of! scene samplers times node "translation" "VEC3" 3 places)
        (channel-of! scene samplers times node "rotation" "VEC4" 4 turns)))

(define (add-body! scene samplers times body)
  ;; BODY is (NAME PLACES TURNS); return its node and its channels.
  (let* ((mesh (add-mesh! scene (first body) hull hull-triangles))
         (node (add-node! scene (first body) (car (second body)) (car (third body)) `("mesh" . ,mesh))))
    (cons (list node) (channels-of! scene samplers times node (second body) (third body)))))

(define (tube-mesh! scene name radius places turns)
  (let ((normals (append-map ring turns)))
    (add-mesh! scene name
               (map (lambda (place normal) (map (lambda (p n) (+ p (* radius n))) place normal))
                    (append-map (lambda (place) (make-list sides place)) places) normals)
               (tube-triangles (length places))
               `("NORMAL" . ,(add-floats! scene "VEC3" 3 normals))
               `("JOINTS_0" . ,(add-shorts! scene "VEC4" 4 (append-map (lambda (i) (make-list sides (list i 0 0 0)))
                                                                       (iota (length places)))))
               `("WEIGHTS_0" . ,(add-floats! scene "VEC4" 4 (make-list (* sides (length places)) '(1 0 0 0)))))))

(define (add-line! scene samplers times radius line)
  ;; LINE is (NAME MOMENTS), each a list of points, as many in each; return nodes and channels.
  (let* ((name (first line)) (moments (second line)) (turns (turns-along moments))
         (joints (map (lambda (i place turn) (add-node! scene (simple-format #f "~a-~a" name i) place turn))
                      (iota (length (car moments))) (car moments) (car turns)))
         (inverse (add-floats! scene "MAT4" 16 (map inverse-matrix (car moments) (car turns))))
         (skin (add! scene "skins" `(("inverseBindMatrices" . ,inverse) ("joints" . ,(list->vector joints)))))
         (node (add! scene "nodes" `(("name" . ,name) ("skin" . ,skin)
                                     ("mesh" . ,(tube-mesh! scene name radius (car moments) (car turns)))))))
    (cons (cons node joints)
          (append-map (lambda (joint i)
                        (channels-of! scene samplers times joint
                                      (map (lambda (moment) (list-ref moment i)) moments)
                                      (map (lambda (turn) (list-ref turn i)) turns)))
                      joints (iota (length joints))))))


;;; The file.

(define (text-of scene channels samplers top)
  (let ((root (add! scene "nodes" `(("name" . "bight") ("rotation" . ,(vector (- (sqrt 0.5)) 0 0 (sqrt 0.5)))
                                    ("children" . ,(list->vector top))))))
    (call-with-output-string
      (lambda (port)
        (write-json
         `(("asset" ("version" . "2.0") ("generator" . "bight"))
           ("scene" . 0) ("scenes" . ,(vector `(("nodes" . ,(vector root)))))
           ("animations" . ,(vector `(("name" . "dive") ("channels" . ,(list->vector channels))
                                      ("samplers" . ,(list->vector (reverse (assoc-ref (scene-lists samplers)
                                                                                       "samplers")))))))
           ("buffers" . ,(vector `(("byteLength" . ,(scene-size scene)))))
           ,@(map (lambda (entry) (cons (car entry) (list->vector (reverse (cdr entry))))) (scene-lists scene)))
         port)))))

(define (joined chunks)
  (let ((all (make-bytevector (apply + (map bytevector-length chunks)))))
    (fold (lambda (bytes at)
            (bytevector-copy! bytes 0 all at (bytevector-length bytes))
            (+ at (bytevector-length bytes)))
          0 chunks)
    all))

(define (words . numbers)
  (uint-list->bytevector numbers (endianness little) 4))

(define (glb-bytes times radius lines bodies)
  "Return the bytes of a binary glTF file of what moves at TIMES, seconds that grow: LINES are lists of a name and,
for each time, a list of points (X Y Z), as many each time, drawn as tubes of RADIUS; BODIES are lists of a name, a
list of places and one of quaternions (X Y Z W)."
  (let* ((scene (make-scene '() 0 '())) (samplers (make-scene '() 0 '()))
         (input (add-floats! scene "SCALAR" 1 (map list times) `("min" . ,(vector (as-single (car times))))
                             `("max" . ,(vector (as-single (last times))))))
         (made (append (map-in-order (lambda (line) (add-line! scene samplers input radius line)) lines)
                       (map-in-order (lambda (body) (add-body! scene samplers input body)) bodies)))
         (text (padded (string->utf8 (text-of scene (append-map cdr made) samplers (append-map car made))) 32))
         (numbers (joined (reverse (scene-chunks scene)))))
    (joined (list (words #x46546c67 2 (+ 28 (bytevector-length text) (bytevector-length numbers))
                         (bytevector-length text) #x4e4f534a)
                  text (words (bytevector-length numbers) #x004e4942) numbers))))
