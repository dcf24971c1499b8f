# SPDX-License-Identifier: GPL-3.0-or-later
"""Landmark pairs of a .tag file, which of them go in, and predictors that know no mechanics."""
import re

import numpy as np

GIVEN = 6


def read_pairs(file):
    """Places in two volumes, (n × 3) each, mm, RAS, of an MNI tag point file."""
    number = r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?"
    row = re.compile(rf"^\s*({number}(?:\s+{number}){{5}})")
    found = [row.match(line) for line in file.read_text().splitlines()]
    pairs = np.array([[float(x) for x in match.group(1).split()] for match in found if match])
    if len(pairs) <= GIVEN:
        raise SystemExit(f"{file}: {len(pairs)} pairs of places; more than {GIVEN} are expected")
    return pairs[:, :3], pairs[:, 3:]


def spread_out(places, count):
    """One after the other, each the farthest from those before, beginning with the first."""
    taken = [0]
    while len(taken) < count:
        distance = np.linalg.norm(places[:, None] - places[taken][None], axis=2).min(axis=1)
        taken.append(int(distance.argmax()))
    return taken


def none(_before, _after):
    return lambda places: places


def rigid(before, after):
    """The rigid motion that is nearest in squares (Kabsch 1976)."""
    centre, target = before.mean(axis=0), after.mean(axis=0)
    u, _, v = np.linalg.svd((before - centre).T @ (after - target))
    turn = v.T @ np.diag([1, 1, np.sign(np.linalg.det(v.T @ u.T))]) @ u.T
    return lambda places: (places - centre) @ turn.T + target


def gaussian_process(before, after, length=20, size=1.5, noise=1):
    """What rigid motion leaves, smooth over `length` mm, of `size` mm; `noise` mm of each landmark."""
    moved = rigid(before, after)

    def covariance(places):
        distance = np.linalg.norm(places[:, None] - before[None], axis=2)
        return size**2 * np.exp(-(distance / length) ** 2 / 2)

    push = np.linalg.solve(covariance(before) + noise**2 * np.eye(len(before)), after - moved(before))
    return lambda places: moved(places) + covariance(places) @ push
