#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Random problems through the program, judged; called by run.sh.

  random_problems.py PROGRAM --out DIR [--count N] [--first SEED] [--small] [--calculix] [--keep]

Each seed is written as files and solved by `brainshift solve`, then once more on a finer regular cloud with cells that
conform (or by CalculiX, or on paper), and on its own nodes to a fiftieth of the bound, from rest, in double precision.
DIR/problems.csv has a row a seed; seeds that this program has solved are not run again. Ends with 1 when a verdict is
neither "good" nor one that says that the reference or the state at rest could not be had.
"""
import argparse
import csv
import hashlib
import json
import math
import os
import pathlib
import resource
import shutil
import subprocess
import sys

import calculix
import problems
import table
import vtu

FIELDS = ("seed", "body", "cloud", "cells", "basis", "tissues", "load", "rim", "nodes", "exit", "steps", "took",
          "smallest_jacobian", "bound", "off_by", "reference", "moved", "error_95", "largest", "estimate_95", "balance",
          "seconds", "verdict", "says")
FINER = 1.6  # the reference's cloud, in each direction
FINER_SMALL = 1.26  # twice the nodes
SMALL_TOLERANCE = 0.05  # mm
LEAST_GOOD, FEWEST = 0.8, 10  # share of the problems; of fewer it says nothing
FACTOR = 5  # of the estimate: what it may be off by
MOST = 1 / 3  # of the largest displacement: where there is no estimate, and no rim
EXACT = 1e-3  # of the largest displacement: of states that are known on paper
IMBALANCE = 0.01


class Run:
    """One call of the program and what it left."""

    def __init__(self, program, arguments, out, seconds):
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        command = [str(a) for a in [program, "solve", *arguments, "--quiet", "--out", out]]
        limit = lambda: resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))
        done = subprocess.run(command, capture_output=True, text=True, preexec_fn=limit,
                              env={**os.environ, "OMP_NUM_THREADS": "1"})
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.seconds = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        self.exit, self.says, self.out = done.returncode, done.stderr.strip().splitlines(), out
        record = json.loads((out / "stage.json").read_text()) if (out / "stage.json").exists() else {}
        entry = record.get("entry", record)
        self.measures = entry.get("measures", {})
        self.sizes = entry.get("sizes", {})
        self.doubted = any("may be all wrong" in note for note in entry.get("notes", []))

    def solution(self):
        return vtu.read_solution(self.out / "solution.vtu")

    def balance(self):
        """The largest imbalance of a row, over the largest energy."""
        with open(self.out / "history.csv") as file:
            rows = [{k: float(v) for k, v in row.items()} for row in csv.DictReader(file)]
        most = max((max(abs(r["external_work_mJ"]), r["strain_energy_mJ"]) for r in rows), default=0)
        became = lambda r: r["strain_energy_mJ"] + r["kinetic_energy_mJ"] + r["dissipated_energy_mJ"]
        return max((abs(r["external_work_mJ"] - became(r)) for r in rows), default=0) / most if most > 0 else 0.0


def percentile(values, share):
    return sorted(values)[min(len(values) - 1, int(share * len(values)))]


def distances(a, b, dimensions):
    return [math.dist(u[:dimensions], v[:dimensions]) for u, v in zip(a, b)]


def reference(problem, folder, program, arguments, seconds):
    """(what it is, displacement as a function of the place or None: of what the program itself doubts, too)."""
    exact = problem.exact()
    if exact:
        return "paper", exact
    if arguments.calculix and calculix.can_solve(problem):
        bricks = calculix.Bricks(problem, FINER)
        values = bricks.solve(folder / "calculix", seconds)
        return ("CalculiX", lambda x: bricks.interpolate(values, x)) if values else ("CalculiX stopped", None)
    grid, more = problem.write_reference(folder / "finer", FINER_SMALL if problem.small else FINER)
    run = Run(program, more, folder / "finer" / "solved", seconds)
    if run.exit != 0:
        return f"finer: exit {run.exit}", None
    if run.doubted:
        return "finer: doubted", None
    values = run.solution()["displacement"]
    return "finer", lambda x: grid.interpolate(values, x)


def judge(seed, arguments):
    problem = problems.Problem(seed, arguments.small, arguments.laws)
    folder = arguments.out / str(seed)
    shutil.rmtree(folder, ignore_errors=True)
    given = problem.write(folder)
    stop = ["--tolerance", SMALL_TOLERANCE] if problem.small else []
    run = Run(arguments.program, given + stop, folder / "solved", arguments.seconds)
    row = {**problem.says(), "rim": int(problem.has_rim()), "nodes": len(problem.points), "exit": run.exit,
           "steps": run.sizes.get("steps", ""), "took": run.measures.get("took", ""),
           "smallest_jacobian": run.measures.get("smallest_jacobian", ""),
           "bound": run.measures.get("error_bound_mm", ""), "seconds": f"{run.seconds:.2f}",
           "says": " ".join(run.says)[:300]}
    name, wanted = reference(problem, folder, arguments.program, arguments, 4 * arguments.seconds)
    row["reference"] = name
    if run.exit != 0:
        row["verdict"] = "fails" if wanted else "neither solves"
        return problem, row
    faults = []
    found = run.solution()
    displacement = found["displacement"]
    n = problem.dimensions
    moved = max(math.hypot(*u[:n]) for u in displacement)
    row["moved"] = moved
    bound = float(row["bound"])
    part = 20 if problem.small else 50
    tight = Run(arguments.program, [*given, "--precision", "double", "--tolerance", max(bound / part, 1e-7), "--start",
                                    "rest"], folder / "tight", 4 * arguments.seconds)
    if tight.exit != 0:
        faults.append("tight" if tight.exit != 3 else "bound unknown")
    if tight.exit == 0:
        row["off_by"] = max(distances(displacement, tight.solution()["displacement"], n))
        if row["off_by"] > bound:
            faults.append("bound")
    row["balance"] = run.balance()
    if row["balance"] > IMBALANCE:
        faults.append("balance")
    if wanted:
        errors = distances(displacement, [wanted(x) for x in problem.points], n)
        row["error_95"], row["largest"] = percentile(errors, 0.95), max(errors)
        estimate = run.measures.get("estimated_error_95_mm")
        row["estimate_95"] = "" if estimate is None else estimate
        if name == "paper" and row["largest"] > EXACT * moved + bound:
            faults.append("not exact")
        elif estimate is not None and row["error_95"] > FACTOR * estimate + bound:
            faults.append("estimate")
        elif estimate is None and not problem.has_rim() and row["error_95"] > MOST * moved + bound:
            faults.append("far off")
    row["verdict"] = ", ".join(faults) or "good"
    return problem, row


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--count", type=int, default=300)
    parser.add_argument("--first", type=int, default=1)
    parser.add_argument("--seconds", type=int, default=15, help="of processor time a solve; a reference may take four")
    parser.add_argument("--small", action="store_true")
    parser.add_argument("--laws", action="store_true", help="two tissues in three are Ogden's")
    parser.add_argument("--anew", action="store_true", help="forget what an earlier call found")
    parser.add_argument("--calculix", action="store_true")
    parser.add_argument("--keep", action="store_true", help="files of seeds that are good, too")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    file_of_rows = arguments.out / "problems.csv"
    made_by = arguments.out / "made_by"  # rows of another program or of other options say nothing of this one
    key = f"{hashlib.sha256(open(arguments.program, 'rb').read()).hexdigest()} {arguments.small} {arguments.calculix} {arguments.laws}"
    if arguments.anew or not made_by.exists() or made_by.read_text() != key:
        file_of_rows.unlink(missing_ok=True)
    made_by.write_text(key)
    rows = list(csv.DictReader(open(file_of_rows))) if file_of_rows.exists() else []
    done = {int(row["seed"]) for row in rows}
    with open(file_of_rows, "a", newline="") as file:
        writer = csv.DictWriter(file, FIELDS)
        if not rows:
            writer.writeheader()
        for seed in range(arguments.first, arguments.first + arguments.count):
            if seed in done:
                continue
            problem, row = judge(seed, arguments)
            row = {k: f"{v:.4g}" if isinstance(v, float) else str(v) for k, v in row.items()}
            writer.writerow(row)
            file.flush()
            rows.append(row)
            (arguments.out / "problems.md").write_text(table.page(rows))
            print(*(row.get(k, "") for k in ("seed", "verdict", "body", "load", "error_95", "estimate_95", "seconds")),
                  flush=True)
            if row["verdict"] == "good" and not arguments.keep:
                shutil.rmtree(arguments.out / str(seed))
    bad = [row for row in rows if row["verdict"] not in ("good", "neither solves", "bound unknown")]
    good = sum(row["verdict"] == "good" for row in rows)
    if len(rows) >= FEWEST and good < LEAST_GOOD * len(rows):  # a program that solves nothing is not told by references that are its own
        print(f"{good} of {len(rows)} are good")
        return 1
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
