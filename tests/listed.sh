# Every source, module, world and test is named in the Makefile.am of its folder: what is forgotten
# there is neither built nor tested nor shipped.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
cd "$top_srcdir" || exit 99

# listed FOLDER FIND-ARGUMENT...: the files found below FOLDER, tried against FOLDER/Makefile.am.
listed ()
{
  folder=$1
  shift
  : >"$scratch/missing"
  [ -f "$folder/Makefile.am" ] || { skip "$folder has no Makefile.am"; return; }
  tr -s ' \t\\' '\n\n\n' <"$folder/Makefile.am" >"$scratch/words"
  (cd "$folder" && find . "$@" -type f) | sed 's,^\./,,' | sort >"$scratch/files"
  while read -r file; do
    # A test in C is listed as the program it makes.
    grep -qxF -e "$file" -e "${file%.c}" "$scratch/words" || echo "$folder/Makefile.am does not name $file"
  done <"$scratch/files" >"$scratch/missing"
  empty "everything in $folder is listed" "$scratch/missing"
}

listed src -name '*.[ch]'
listed scheme -name '*.scm'
listed worlds -name '*.scm'
listed lessons -name '*.scm'
listed studies '(' -name '*.scm' -o -name '*.sh' ')'
listed tests '(' -path './law/*.[ch]' -o -path './unit/*.[ch]' -o -path './sc*/*.scm' -o -name '*.sh' ')'
listed bench -name '*.[ch]'
listed testbed '(' -name '*.[ch]' -o -name '*.scm' ')'
listed doc -path './figures/*.scm'

# What git ignores is there for whoever wrote it, and for nobody else.
if git rev-parse --is-inside-work-tree >"$scratch/inside" 2>&1 && [ -e .git ]; then
  git ls-files --others --ignored --exclude-standard -- src scheme worlds lessons studies tests bench testbed doc |
    grep -E '\.(c|cc|h|scm|sh|py|texi)$' | grep -v '^doc/[a-z-]*\.texi$' >"$scratch/ignored"
  empty 'and git ignores none of it' "$scratch/ignored"
  git ls-files -- ':(glob)*.c' ':(glob)*.h' ':(glob)*.scm' ':(glob)*.py' ':(glob)*.sh' >"$scratch/stray"
  empty 'and no source lies in the top folder' "$scratch/stray"
else
  skip 'this is no checkout of git'
  skip 'this is no checkout of git'
fi
finish
