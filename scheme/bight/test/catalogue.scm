;;; (bight test catalogue) --- a page with a sentence and a view of every scenario and every world.
;;;
;;; Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

(define-module (bight test catalogue)
  #:use-module ((bight core markup) #:select (as-xml))
  #:use-module ((bight core programs) #:select (check-writable))
  #:use-module (bight test tap)
  #:use-module (srfi srfi-1)
  #:export (write-catalogue))

(define style "
body { max-width: 60em; margin: 2em auto; padding: 0 1em; font-family: sans-serif; line-height: 1.4 }
section { border-top: 1px solid #ccc; margin-top: 1.5em }
h3 { margin-bottom: 0.2em }
pre { background: #f4f6f8; padding: 0.8em; overflow-x: auto; line-height: 1.1 }
img { max-width: 100% }
.fail { color: #b00020 } .skip { color: #806000 }
.where { color: #666; font-size: 85% }
")

(define (print-view view port)
  (let ((lines (first view)) (picture (second view)))
    (when picture
      (simple-format port "<p><img src=\"~a\" alt=\"the dive at its end\" loading=\"lazy\"></p>~%"
                     (as-xml picture)))
    (unless (every string-null? lines)
      (simple-format port "<pre>~a</pre>~%" (as-xml (string-join lines "\n"))))))

(define (status-words point)
  (case (point-status point)
    ((fail) " <span class=\"fail\">failed</span>")
    ((skip) " <span class=\"skip\">skipped</span>")
    (else "")))

(define (print-section point port)
  (simple-format port "<section>~%<h3>~a~a</h3>~%<p>~a</p>~%"
                 (as-xml (or (point-label point) (basename (point-file point))))
                 (status-words point)
                 (as-xml (point-sentence point)))
  (when (point-location point)
    (simple-format port "<p class=\"where\">~a</p>~%" (as-xml (point-location point))))
  (when (eq? 'fail (point-status point))
    (simple-format port "<pre class=\"fail\">~a</pre>~%"
                   (as-xml (string-join (point-details point) "\n"))))
  (when (point-view point)
    (print-view (point-view point) port))
  (display "</section>\n" port))

(define (print-group title points port)
  (simple-format port "<h2>~a</h2>~%" (as-xml title))
  (for-each (lambda (point) (print-section point port)) points))

(define (without-location world)
  ;; A world's place in a file says nothing here.
  (make-point (point-file world) (point-label world) (point-sentence world) #f (point-status world) #f
              (point-details world) 0. (point-view world)))

(define (write-catalogue folder worlds scenarios)
  "Write FOLDER/index.html with the points of WORLDS and of SCENARIOS, these by file."
  (let ((file (string-append folder "/index.html")))
    (check-writable 'run-tests file)
    (call-with-output-file file
      (lambda (port)
        (set-port-encoding! port "UTF-8")
        (simple-format port "<!DOCTYPE html>
<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Scenarios and worlds of bight</title>
<style>~a</style></head><body>~%<h1>Scenarios and worlds</h1>
<p>~a scenarios: ~a passed, ~a failed, ~a skipped. Each view shows the dive as the scenario left it.</p>~%"
                       style (length scenarios) (count-of 'pass scenarios) (count-of 'fail scenarios)
                       (count-of 'skip scenarios))
        (print-group "Worlds" (map without-location worlds) port)
        (for-each (lambda (name)
                    (print-group (basename name)
                                 (filter (lambda (p) (string=? name (point-file p))) scenarios)
                                 port))
                  (delete-duplicates (map point-file scenarios)))
        (display "</body></html>\n" port)))))
