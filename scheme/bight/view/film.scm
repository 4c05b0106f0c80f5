;;; (bight view film) --- let the dive run and keep every picture of it.
;;;
;;; The pictures go to ffmpeg, one after the other, as they are drawn.  Where there is no ffmpeg, or a
;;; PNG was asked for, they become numbered files.  A film is written beside its place and moved there
;;; when it is whole.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight view film)
  #:use-module ((bight core errors) #:select (bight-raise))
  #:use-module (bight core programs)
  #:use-module (bight core verb)
  #:use-module (bight dive)
  #:use-module (bight dive time)
  #:use-module (bight shell progress)
  #:use-module (bight view picture)
  #:use-module ((ice-9 binary-ports) #:select (put-bytevector))
  #:use-module (ice-9 popen)
  #:export (film
            pass-time))

(define-argument-type (film-file value)
  "the name of a file to write, such as \"dive.mp4\""
  (if (and (string? value) (not (string-null? value)) (not (string-index value #\nul)))
      value
      refused))

(define (extension file)
  (let ((dot (string-rindex (basename file) #\.)))
    (and dot (> dot 0) (substring (basename file) (+ 1 dot)))))

(define (stem file)
  (let ((kind (extension file)))
    (if kind (substring file 0 (- (string-length file) (string-length kind) 1)) file)))


;;; Frames into numbered files.

(define (numbered file i)
  (string-append (stem file) "-" (string-pad (number->string i) 5 #\0) ".png"))

(define (keep-numbered file size draw-all)
  (draw-all (lambda (i pixels) (write-picture 'film pixels size (numbered file (+ i 1))))))


;;; Frames into ffmpeg.

(define (arguments-of size rate file)
  (let ((size (string-append (number->string (car size)) "x" (number->string (cdr size)))))
    (list "-nostdin" "-y" "-loglevel" "error" "-f" "rawvideo" "-pix_fmt" "bgra" "-s" size
          "-r" (number->string rate) "-i" "pipe:0"
          "-vf" "pad=ceil(iw/2)*2:ceil(ih/2)*2" "-pix_fmt" "yuv420p" file)))

(define (call-without-sigpipe thunk)
  ;; Call THUNK while a program that has gone is an error, not our end.
  (let ((old #f))
    (dynamic-wind
      (lambda () (set! old (sigaction SIGPIPE SIG_IGN)))
      thunk
      (lambda () (sigaction SIGPIPE (car old) (cdr old))))))

(define (ffmpeg-failed file log)
  (bight-raise 'io 'film "cannot write ~s: ~a" file (or (last-line log) "ffmpeg failed")))

(define (pour port file log draw-all)
  ;; Send all frames to PORT; a failure is told by what ffmpeg said.
  (catch 'system-error
    (lambda ()
      (draw-all (lambda (i pixels)
                  (put-bytevector port pixels)
                  (force-output port))))
    (lambda key+arguments
      (close-pipe port)
      (ffmpeg-failed file log))))

(define (keep-by-ffmpeg file size rate draw-all)
  (let ((part (string-append (stem file) ".part." (extension file))) (log (temporary-file)))
    (dynamic-wind
      (const #f)
      (lambda ()
        (call-without-sigpipe
         (lambda ()
           (let ((port (apply open-program-input log "ffmpeg" (arguments-of size rate part))))
             (pour port file log draw-all)
             ;; On a full disk ffmpeg may complain and end well all the same.
             (unless (and (eqv? 0 (status:exit-val (close-pipe port)))
                          (not (last-line log)))
               (ffmpeg-failed file log)))))
        (rename-or-raise 'film part file))
      (lambda ()
        (false-if-exception (delete-file part))
        (false-if-exception (delete-file log))))))


;;; The verb.

(define-argument-type (rate value)
  "pictures a second, from 1 to 120"
  (if (and (real? value) (integer? value) (<= 1 value 120)) (inexact->exact value) refused))

(define-argument-type (film-length value)
  "seconds of the dive, above 0 and up to 3600"
  (if (and (real? value) (< 0 value) (<= value 3600)) value refused))

(define (frames-of seconds rate speed)
  (max 1 (inexact->exact (round (/ (* seconds rate) speed)))))

;; How so many seconds pass between two frames; a recording that is filmed goes on otherwise.
(define pass-time (make-parameter (lambda (seconds) (run seconds))))

(define (shot view size paint overlay rate speed n)
  ;; A procedure that lets time pass and calls KEEP with the number and the pixels of each frame.
  (lambda (keep)
    (with-progress n
      (lambda (report)
        (do ((i 0 (+ i 1)))
            ((= i n))
          (keep i (picture-pixels 'film view size paint overlay))
          ((pass-time) (/ speed rate))
          (report (+ i 1)))))))

(define-verb (film (file film-file)
                   #:key (for film-length 10) (view views '(chase)) (size pixels '(640 . 360))
                   (paint (one-of plain tension curvature model) 'plain)
                   (overlay overlay '(figures))
                   (rate rate 25) (speed positive 1.0) (lights (or-false (one-of on off))) (visibility (or-false positive)))
  "Let FOR seconds pass and write a film of them to FILE through ffmpeg, or numbered PNGs where there is
none or FILE ends with .png.  RATE is in pictures a second, SPEED in seconds of the dive in a second; VIEW,
SIZE, PAINT, OVERLAY, LIGHTS and VISIBILITY are those of `snapshot'.  Return what was written."
  (this-dive 'film)
  (let* ((n (frames-of for rate speed))
         (draw-all (shot view size paint (in-water overlay lights visibility) rate speed n))
         (pictures? (or (not (extension file)) (string-ci=? "png" (extension file)))))
    (check-writable 'film file)
    (if (or pictures? (not (program? "ffmpeg")))
        (begin
          (keep-numbered file size draw-all)
          (written-note (numbered file 1) " to " (numbered file n)
                        (if pictures? "" "; with ffmpeg (Debian package: ffmpeg) it would be one file")))
        (begin
          (keep-by-ffmpeg file size rate draw-all)
          (written-note file ", " (number->string n) " pictures, "
                        (number->string (exact->inexact (/ n rate))) " s")))))
