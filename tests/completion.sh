# Completion in bash and zsh: every command and every option of the help, and nothing else.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"

pre=$top_builddir/pre-inst-env
cd "$scratch" || exit 99
: >'a file.scm'
"$pre" bight --completion bash >bash.sh 2>err
result $? 'bash is told'
"$pre" bight --completion zsh >_bight 2>>err
result $? 'so is zsh'
empty 'without a complaint' err

# completed WORD...: what bash offers for the last of them, sorted.
completed ()
{
  bash -c '. ./bash.sh; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _bight; printf "%s\\n" "${COMPREPLY[@]}"' \
    bash "$@" | sort
}
if command -v bash >/dev/null; then
  [ "$(completed bight swe)" = sweep ] && [ "$(completed bight test --jun)" = --junit ]
  result $? 'a command and an option are completed'
  [ "$(completed bight 'a f')" = 'a file.scm' ]
  result $? 'and a file'
  for command in test sweep snapshot pilot lesson lessons bench; do
    "$pre" bight $command --help | sed -n 's/^  \(--*[a-zA-Z-]*\).*/\1/p' | sort >wanted
    completed bight $command - >found
    [ -s wanted ] && cmp -s wanted found
    result $? "the options of $command are those of its help"
  done
  "$pre" bight --help | sed -n 's/^\(Usage:\|      \) bight \([a-z-][a-z-]*\).*/\2/p' | sort -u >wanted
  { completed bight '' | grep -v '[._]\|^err$\|^wanted$\|^found$\|^check'; } | sort -u >found
  [ "$(wc -l <wanted)" -ge 12 ] && cmp -s wanted found
  words=$?
  result $words 'the commands are those of the help'
  [ $words -eq 0 ] || diag "$(diff wanted found)"
else
  skip 'bash is not here'
fi
if command -v zsh >/dev/null; then
  check 'zsh reads its own' zsh -n _bight
else
  skip 'zsh is not here'
fi
"$pre" bight --completion fish 2>err
[ $? -eq 1 ] && grep -qx 'bight: --completion needs a shell after it, bash or zsh' err
result $? 'another shell is refused'
finish
