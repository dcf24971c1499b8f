# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a program and says what it took; the rows of a table."""
import csv
import os
import subprocess
from dataclasses import dataclass


@dataclass
class Took:
    seconds: float
    peak_mb: float
    status: int  # of the program; 124: it was stopped at the limit


def run(command, threads, log, folder=None, limit=600):
    """OpenMP's, ITK's and CalculiX's number of threads is set. GNU time starts the program, as a child's peak counts that of the
    process it came from."""
    variables = ("OMP_NUM_THREADS", "ITK_GLOBAL_DEFAULT_NUMBER_OF_THREADS", "CCX_NPROC_EQUATION_SOLVER", "CCX_NPROC_RESULTS",
                 "CCX_NPROC_STIFFNESS")
    said = os.path.abspath(log) + ".time"
    with open(log, "w") as out:
        done = subprocess.run(["/usr/bin/time", "--quiet", "-f", "%e %M", "-o", said, "timeout", str(limit), *command], cwd=folder,
                              env=dict(os.environ, **dict.fromkeys(variables, str(threads))), stdout=out,
                              stderr=subprocess.STDOUT, check=False)
    with open(said) as file:
        seconds, kilobytes = file.read().split()[-2:]
    return Took(float(seconds), float(kilobytes) / 1024, done.returncode)


def write_rows(path, rows):
    """All rows have the columns of the first."""
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, fieldnames=list(rows[0]))
        table.writeheader()
        table.writerows(rows)
