#!/bin/sh
# emacs.sh: tests the major mode for Emacs. Skipped without Emacs.
# usage: tests/editors/emacs.sh PATH-OF-PETRI FLITTER-MODE

# shellcheck source=tests/support/check.sh
. "$(dirname "$0")/../support/check.sh"
petri=$(program "$1") || exit 2
mode=$(realpath "$2")
command -v emacs >/dev/null || {
    echo "skipped: emacs is not installed (Debian: emacs-nox)"
    exit 77
}
scratch
export HOME="$work"
cp "$mode" flitter-mode.el
emacs -Q --batch --eval '(setq byte-compile-error-on-warn t)' -f batch-byte-compile flitter-mode.el >out 2>err
status=$?
check "the mode compiles without warnings" status_is 0
cat >script.fl <<'END'
let in2=sin(1:30) -- it's
for i in ..3
    !particle id=:x #t y=beat z='a -- b' w=x' v=func(x) x
func spin(n, m=2)
    n+m
let t="""one
-- 'two""" k=2
%include "f.fl"
END
cat >session.el <<END
(require 'flitter-mode)
(setq flitter-program "$petri")
(find-file "script.fl")
(font-lock-ensure)
(defun face-of (word line)
  (goto-char (point-min))
  (forward-line (1- line))
  (search-forward word)
  (princ (format "%s %s\n" word (get-text-property (match-beginning 0) 'face))))
(princ (format "%s %s%s\n" major-mode comment-start tab-width))
(face-of "let" 1) (face-of "in2" 1) (face-of "sin" 1) (face-of "it's" 1) (face-of "for" 2) (face-of "in" 2)
(face-of "!particle" 3) (face-of ":x" 3) (face-of "#t" 3) (face-of "beat" 3) (face-of "b'" 3) (face-of "x'" 3)
(face-of "func" 3) (face-of "spin" 4) (face-of "two" 7) (face-of "k" 7) (face-of "%include" 8)
(flitter-format-buffer)
(princ (buffer-substring (point-min) (save-excursion (goto-char (point-min)) (line-end-position))))
(goto-char (point-max))
(insert "!group")
(newline-and-indent)
(setq last-command 'indent-for-tab-command this-command last-command)
(flitter-indent-line)
(princ (format "\n%d\n" (current-indentation)))
END
emacs -Q --batch -L . -l session.el >out 2>err
status=$?
cat >wanted <<'END'
flitter-mode -- 4
let font-lock-keyword-face
in2 font-lock-variable-name-face
sin font-lock-builtin-face
it's font-lock-comment-face
for font-lock-keyword-face
in font-lock-keyword-face
!particle font-lock-type-face
:x font-lock-constant-face
#t font-lock-constant-face
beat font-lock-constant-face
b' font-lock-string-face
x' nil
func font-lock-keyword-face
spin font-lock-function-name-face
two font-lock-string-face
k font-lock-variable-name-face
%include font-lock-preprocessor-face
let in2=sin(1:30)  -- it's
4
END
check "each token has the expected face; formatting and indentation work" diff wanted out
finish
