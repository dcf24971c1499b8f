#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Many runs of the phantom in one process tree: does anything grow?

  PYTHONPATH=BUILD/python python3 many_runs.py PROGRAM [--runs 100]

Each round runs the scene in this process, by the Python module, and in a child, by the program, into folders that are
then removed. What this process holds (memory, threads, open files), what is left in the folder for scratch files and
the child's peak memory are written for each round. Ends with 1 where the last third of the rounds holds more of
anything than the middle one, of memory more than 2 %, or where any round gives other bytes than the first. Memory is
not judged below 30 rounds, of which it differs by as much from one to the next. Exit 77 where the module is missing.
"""
import argparse
import hashlib
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

try:
    import brainshift
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

SMALL = {"segment.edge_length": 14, "discretise.nodes": 150, "solve.basis": "linear", "solve.points_per_cell": 1,
         "solve.tolerance": 0.5, "register.fade": 30}
ENOUGH = 30  # rounds, to judge memory
COUNTED = ("threads here", "open files here", "scratch files")  # judged after any number of rounds
ALLOWED = {"memory here, MB": 1.02, "peak of the child, MB": 1.02}  # of what else is counted, 1


def status(name):
    lines = Path("/proc/self/status").read_text().splitlines()
    return int(next(line for line in lines if line.startswith(name + ":")).split()[1])


def digest(folder):
    """Of all but the records, which hold times."""
    files = sorted(p for p in folder.rglob("*") if p.suffix in (".gz", ".vtu", ".vtp", ".csv", ".h5"))
    return hashlib.sha256(b"".join(hashlib.sha256(p.read_bytes()).digest() for p in files)).hexdigest()


def round_of(program, scene, folder):
    """What is held after one more run here and one more in a child, and the digests of both."""
    here, there = folder / "here", folder / "there"
    brainshift.run(scene, here, until="register", set=SMALL)
    small = [f"--set={name}={value}" for name, value in SMALL.items()]
    child = subprocess.Popen([program, "run", scene, "--quiet", "--until", "register", *small, "--out", there])
    _, ended, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(ended)
    if child.returncode != 0:
        sys.exit(f"{program}: exit code {child.returncode}")
    digests = digest(here), digest(there)
    shutil.rmtree(here)
    shutil.rmtree(there)
    return {"memory here, MB": status("VmRSS") / 1024, "threads here": status("Threads"),
            "open files here": len(os.listdir("/proc/self/fd")),
            "scratch files": sum(1 for _ in Path(tempfile.gettempdir()).iterdir()),
            "peak of the child, MB": used.ru_maxrss / 1024}, digests


def grown(rounds):
    """Name, mean of the middle third and mean of the last third of what grew."""
    third = len(rounds) // 3
    for name in rounds[0]:
        middle, last = (statistics.mean(r[name] for r in part) for part in (rounds[third:2 * third], rounds[-third:]))
        print(f"{name}: {rounds[0][name]:.1f} after the first, {middle:.1f} in the middle, {last:.1f} at the end")
        if last > middle * ALLOWED.get(name, 1):
            yield name


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--runs", type=int, default=100)
    options = parser.parse_args()
    if options.runs < 3:
        parser.error("--runs is at least 3")
    with tempfile.TemporaryDirectory() as scratch:
        head = Path(scratch) / "head"
        tempfile.tempdir = os.environ["TMPDIR"] = str(Path(scratch) / "temporary")
        os.mkdir(tempfile.tempdir)
        brainshift.write_phantom(head, size=40, spacing=6)
        rounds, seen = [], set()
        for _ in range(options.runs):
            held, digests = round_of(options.program.resolve(), head / "scene.xml", Path(scratch))
            rounds.append(held)
            seen.update(digests)
        judged = rounds[0] if options.runs >= ENOUGH else COUNTED
        more = [name for name in grown(rounds) if name in judged]
    same = "the same bytes" if len(seen) == 1 else f"{len(seen)} different results"
    growth = "grown: " + ", ".join(more) if more else "nothing grew" if options.runs >= ENOUGH else (
        "no thread or file more, memory not judged")
    print(f"{options.runs} runs here and as many in children: {same}, {growth}")
    return 1 if more or len(seen) > 1 else 0


if __name__ == "__main__":
    sys.exit(main())
