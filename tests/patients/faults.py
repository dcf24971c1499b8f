# SPDX-License-Identifier: GPL-3.0-or-later
"""Loads that have more wrong with them than noise, on the program's own head; called by faults.sh.

The truth is the head's solution with all measured points and no noise, as in noise.py.
"""
import json
import pathlib
import subprocess
import sys

import numpy as np

from noise import chosen, phantom
from predictors import spread_out

DRAWS, POINTS, INNER, NOISE = 3, 20, 6, 0.5
ANGLE, SHIFT, OUTLIER = 5.0, 5.0, 10.0  # degrees, mm, mm
FINER_POINTS, FINER = 40, 0.15  # mm, of --tolerance
NOISY = f'noise="{NOISE}"'


def directions(count, random):
    rows = random.standard_normal((count, 3))
    return rows / np.linalg.norm(rows, axis=1, keepdims=True)


def noisy(head, points, random):
    given = head.measured[chosen(head.measured[:, :3], points, True, random)]
    given[:, 3:] += NOISE * random.standard_normal((points, 3))
    return given


def turned(places, random):
    """By ANGLE about the middle of the places, and moved by SHIFT, both in a direction that is drawn."""
    axis, shift = directions(2, random)
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(ANGLE)
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    middle = places.mean(axis=0)
    return (places - middle) @ turn.T + middle + SHIFT * shift


def registration(head, random):
    """Points of the opening and some inside, as a tracker has them whose registration is off."""
    yield f"| registration off by {ANGLE:g}° and {SHIFT:g} mm | taken as known, mm | unknown, mm | angle found | said, mm |"
    yield "|" + " --- |" * 5
    for draw in range(DRAWS):
        inside = np.array(spread_out(np.roll(head.places, -draw, axis=0), INNER)) + draw
        inside %= len(head.places)
        inner = np.column_stack([head.places[inside], head.truth[inside]])
        inner[:, 3:] += NOISE * random.standard_normal((INNER, 3))
        given = np.vstack([noisy(head, POINTS, random), inner])
        given[:, 3:] = turned(given[:, :3] + given[:, 3:], random) - given[:, :3]
        known = head.error(given, NOISY)
        unknown = head.error(given, NOISY + ' registration="unknown"')
        said = json.loads((head.folder / "run/run.json").read_text())["stages"]["solve"]["measures"]
        yield (f"| draw {draw + 1} | {known:.2f} | {unknown:.2f} | {said['registration_angle_deg']:.1f}° "
               f"| {said['registration_deviation_mm']:.1f} |")


def wrong_points(head, random):
    """Two of the points, which contradict all others."""
    rows = {"none wrong": [], "two wrong": [], "without the two": []}
    for _ in range(DRAWS):
        given = noisy(head, POINTS, random)
        wrong = given.copy()
        wrong[:2, 3:] += OUTLIER * directions(2, random)
        for name, load in zip(rows, (given, wrong, given[2:])):
            rows[name].append((head.error(load, NOISY), head.error(load, NOISY + ' robust="yes"')))
    yield f"| of {POINTS} points | all count, mm | robust, mm |"
    yield "|" + " --- |" * 3
    for name, errors in rows.items():
        yield "| {} | {:.3f} | {:.3f} |".format(name, *np.mean(errors, axis=0))


def finer_clouds(head, random):
    """What a run to a tolerance says of each cloud."""
    out = head.folder / "finer"
    subprocess.run([head.program, "run", "-q", str(head.write(noisy(head, FINER_POINTS, random), NOISY)), "--out",
                    str(out), "--until", "solve", "--tolerance", str(FINER)], check=True, stderr=subprocess.DEVNULL)
    yield f"| {FINER_POINTS} points, --tolerance {FINER} | 95 % within, mm | all within, mm |"
    yield "|" + " --- |" * 3
    for level in json.loads((out / "run.json").read_text())["tolerance"]["levels"][1:]:  # the first has none below it
        middle, largest = level["estimated_error_95_mm"], level["estimated_error_largest_mm"]
        yield f"| {level['nodes']} nodes | {middle:.3f} | {largest:.2f} |"


def main(program, out):
    out.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    head = phantom(program, out / "phantom", random)
    lines = []
    for table in (registration, wrong_points, finer_clouds):
        lines += [""] if lines else []
        for line in table(head, random):
            lines.append(line)
            print(line, flush=True)
    (out / "faults.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]))
