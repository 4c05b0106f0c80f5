# The programs in Python that the manual shows do what it says: the engine through its C library, a sweep in pandas.
# The client of the door is tried by door.sh, NumPy's arrays by series.sh.
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.

. "$top_srcdir/tests/tap.sh"
. "$top_srcdir/tests/sweeps.sh"

PYTHONDONTWRITEBYTECODE=1
export PYTHONDONTWRITEBYTECODE

python_with () # MODULE: a Python that has it
{
  for python in python3 /usr/bin/python3; do
    if "$python" -c "import $1" >/dev/null 2>&1; then
      echo "$python"
      return
    fi
  done
}

# ---- The engine ----

python=$(python_with ctypes)
if [ -z "$python" ]; then
  skip 'there is no Python with ctypes'
  finish
fi
if [ "$sanitize" = yes ]; then
  skip 'a Python without the sanitizers cannot load the library'
else
  "$pre" "$python" "$top_srcdir/doc/engine.py" >told 2>err
  result $? 'engine.py flies a dive'
  empty 'and nothing is said on standard error' err
  bight -c "(enter! (world (sea (depth 50)) (rov (named minnow) (at 12 0 -5))
      (tether (named line) (type fathom) (from 0 0 -5) (to minnow) (length 20) (wet-weight 0.5) (model elastic))))
    (display (list 'is (/ (round (* 100 (z (point-at 10)))) 100) (/ (round (* 100 (rov-tension))) 100)))" >asked
  [ "$(sed -n 's/.*point \(.*\) m, .* \(.*\) N/(is \1 \2)/p' told)" = "$(tail -n 1 asked)" ]
  result $? 'what it tells is what the language tells of the same world'
  "$pre" "$python" - "$top_srcdir/doc" >out 2>&1 <<'PY'
import sys
sys.path.insert (0, sys.argv[1])
import engine
try:
    engine.part ("tether", {"length": -1})
    sys.exit ("-1 was taken")
except ValueError as e:
    assert "length" in str (e), e
PY
  result $? 'what is wrong is an exception with the words of the engine'
fi

# ---- A sweep ----

python=$(python_with pandas)
if [ -z "$python" ]; then
  skip 'there is no Python with pandas (Debian package: python3-pandas)'
  finish
fi
begin_study
"$python" "$top_srcdir/doc/sweep.py" one.db U push slack >out 2>err
result $? 'sweep.py reads a result'
bight sweep --table one.db --by U,push --csv | sed 1d >table
[ "$(grep -cE ' 2 +-?[0-9]' out)" -eq "$(wc -l <table)" ]
result $? 'it has the groups of the table, two cases in each'
finish
