"""What a sweep says, in pandas:  python3 sweep.py RESULT.db VARIABLE... MEASURE"""
# Copyright (C) 2026 the bight authors.  GPL-3.0-or-later.
import sqlite3
import sys

import pandas

result, *variables, measure = sys.argv[1:]
cases = pandas.read_sql("select * from cases where status = 'done'", sqlite3.connect(f"file:{result}?mode=ro", uri=True))
print(cases.groupby(variables)[measure].agg(["count", "mean", "std"]))
