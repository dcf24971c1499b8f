"""Run CalculiX on a deck and read back what it printed."""
import hashlib
import os
import re
import subprocess
import time
from dataclasses import dataclass, field

import numpy as np


@dataclass
class Solution:
    """Displacements (nodes, 3) in mm by share of the load, total reactions in micronewton by set and share."""

    fields: dict = field(default_factory=dict)
    forces: dict = field(default_factory=dict)
    reached: float = 0.0
    seconds: float = 0.0


def run(deck, node_count):
    """Solve `deck` (a path that ends in .inp), or read the results again of the same deck solved before.
    A run that stops early gives what it had reached."""
    stem = deck[:-len(".inp")]
    with open(deck, "rb") as file:
        fingerprint = hashlib.sha256(file.read()).hexdigest()
    seconds = seconds_of_solved(stem, fingerprint)
    if seconds is None:
        seconds = solve(stem)
        with open(stem + ".solved", "w") as note:
            note.write(f"{fingerprint} {seconds:.1f}\n")
    solution = read_dat(stem + ".dat", node_count)
    solution.seconds = seconds
    return solution


def seconds_of_solved(stem, fingerprint):
    if not os.path.exists(stem + ".solved"):
        return None
    with open(stem + ".solved") as note:
        solved, seconds = note.read().split()
    return float(seconds) if solved == fingerprint else None


def solve(stem):
    """Run CalculiX with one thread; the seconds it took."""
    if os.path.exists(stem + ".dat"):
        os.remove(stem + ".dat")
    start = time.time()
    with open(stem + ".log", "w") as log:
        subprocess.run(["ccx", "-i", os.path.basename(stem)], cwd=os.path.dirname(stem) or ".",
                       env=dict(os.environ, OMP_NUM_THREADS="1"), stdout=log, stderr=subprocess.STDOUT, check=False)
    return time.time() - start


def read_dat(path, node_count):
    """Read the displacement fields and total forces of a .dat file."""
    solution = Solution()
    title = re.compile(r"^ (displacements|total force) .* for set (\S+) and time +(\S+)")
    with open(path) as lines:
        kind = None
        for line in lines:
            found = title.match(line)
            if found:
                kind, name, share = found[1], found[2], round(float(found[3]), 6)
                solution.reached = max(solution.reached, share)
                if kind == "displacements":
                    solution.fields[share] = np.zeros((node_count, 3))
            elif line.strip() and kind == "displacements":
                node, *values = line.split()
                if int(node) <= node_count:
                    solution.fields[share][int(node) - 1] = [float(v) for v in values]
            elif line.strip() and kind == "total force":
                solution.forces.setdefault(name, {})[share] = np.array([float(v) for v in line.split()])
    return solution
