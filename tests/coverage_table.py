#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Share of lines that the tests ran, a folder a line; what is below 90 % and not explained is a fault.

  python3 tests/coverage_table.py SUMMARY.json README.md     exit 1 where a folder below 90 % is not named in README.md
"""
import json
import sys
from collections import defaultdict
from pathlib import Path

WANTED = 90


def shares(summary):
    """{folder: (lines run, lines)}"""
    run, lines = defaultdict(int), defaultdict(int)
    for file in summary["files"]:
        folder = str(Path(file["filename"]).parent)
        run[folder] += file["line_covered"]
        lines[folder] += file["line_total"]
    return {folder: (run[folder], lines[folder]) for folder in sorted(lines) if lines[folder] > 0}


def main(summary, readme):
    explained = Path(readme).read_text()
    found = 0
    for folder, (run, lines) in shares(json.loads(Path(summary).read_text())).items():
        share = 100 * run / lines
        low = share < WANTED
        known = f"`{folder}`" in explained
        found += low and not known
        print(f"{share:6.1f} %  {run:6d} of {lines:6d}  {folder}" + ("" if not low else "  explained" if known else "  LOW"))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:3]))
