# The reference of the C library, as Texinfo, from the installed headers: awk -f headers.awk HEADER...
#
# A header is blocks between blank lines: a comment, then what it is about.  With -v check=1 nothing is
# written but the functions that no comment is about, one a line.
#
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

function escape(text)
{
  gsub(/[@{}]/, "@&", text)
  return text
}

function say(text)
{
  if (!check)
    print text
}

# The words of a comment, without its marks.
function words(line)
{
  sub(/^ *\/\* */, "", line)
  sub(/ *\*\/ *$/, "", line)
  sub(/^ +\*? ?/, "", line)
  return line
}

function index_names(line,    name)
{
  while (match(line, /bt_[a-z0-9_]+ \(/)) {
    name = substr(line, RSTART, RLENGTH - 2)
    say("@findex " name)
    functions = functions " " name
    line = substr(line, RSTART + RLENGTH)
  }
}

function index_type(line)
{
  if (match(line, /^} bt_[a-z0-9_]+;/))
    say("@tindex " substr(line, 3, RLENGTH - 3))
  else if (match(line, /^typedef .* bt_[a-z0-9_]+;/)) {
    sub(/;.*/, "", line)
    sub(/.* /, "", line)
    say("@tindex " line)
  }
}

function end_block(    i)
{
  if (code_lines > 0) {
    for (i = 1; i <= code_lines; i++) {
      if (code[i] !~ /^ /)
        index_names(code[i])
      index_type(code[i])
      if (code[i] ~ /\/\*/)
        told = 1
    }
    # A function of the type that was told of just before needs no more.
    for (i = 1; i <= code_lines; i++)
      if (told_type != "" && code[i] ~ told_type " ")
        told = 1
    if (functions != "" && about == "" && !told)
      missing = missing header ":" functions "\n"
    if (about != "")
      say("@noindent\n" escape(about))
    say("@example")
    for (i = 1; i <= code_lines; i++)
      say(escape(code[i]))
    say("@end example\n")
    told_type = ""
    if (about != "" && match(code[code_lines], /^} bt_[a-z0-9_]+;/))
      told_type = substr(code[code_lines], 3, RLENGTH - 3)
  }
  about = ""
  functions = ""
  told = 0
  code_lines = 0
}

FNR == 1 {
  n = split(FILENAME, part, "/")
  header = "bight/" part[n]
  seen_head = 0
  depth = 0
  say("@subheading <" header ">")
}

# What the header is, up to its copyright line.
!seen_head {
  if ($0 !~ /Copyright/)
    say(escape(words($0)))
  if (/\*\//)
    seen_head = 1
  next
}

/^#/ || /^BT_(BEGIN|END)_DECLS/ || /^  extern "C"/ || /\\$/ { next }

/^\/\* ---- .* ---- \*\/$/ {
  end_block()
  sub(/^\/\* ---- /, "")
  sub(/ ---- \*\/$/, "")
  say("@subsubheading " escape($0))
  next
}

/^$/ && depth == 0 && !in_comment { end_block(); next }

# A comment at the margin is about what follows it.
/^\/\*/ && depth == 0 {
  if (code_lines > 0) {
    kept = about
    end_block()
  }
  about = words($0)
  in_comment = !/\*\//
  next
}
in_comment {
  about = about "\n" words($0)
  in_comment = !/\*\//
  next
}

{
  code[++code_lines] = $0
  depth += gsub(/{/, "{") - gsub(/}/, "}")
}

END {
  end_block()
  if (check)
    printf "%s", missing
}
