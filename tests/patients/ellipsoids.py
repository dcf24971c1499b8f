# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether ellipsoids that are said to hold 95 % of the truths do, by the distance from what was measured."""
import numpy as np

CHI_SQUARED_95 = 7.815  # of three
RINGS = (0, 10, 20, 30, 45, np.inf)  # mm from the nearest measured point


def symmetric(six):
    """(m x 3 x 3) of rows xx, yy, zz, xy, yz, zx."""
    return np.stack([six[:, [0, 3, 5]], six[:, [3, 1, 4]], six[:, [5, 4, 2]]], axis=1)


def covered(error, covariance):
    return error @ np.linalg.solve(covariance, error) <= CHI_SQUARED_95


def distances(places, measured):
    return np.linalg.norm(places[:, None] - measured[None], axis=2).min(axis=1)


def row_of(name, places):
    """How many, root mean square error and standard deviation, share inside; mm and %."""
    error = np.sqrt(np.mean([e @ e for _, e, _ in places]))
    said = np.sqrt(np.mean([np.trace(c) for _, _, c in places]))
    inside = 100 * np.mean([covered(e, c) for _, e, c in places])
    return f"| {name} | {len(places)} | {error:.2f} | {said:.2f} | {inside:.1f} |"


def write_table(file, places):
    """places: (distance, error, covariance) each."""
    lines = ["| mm from the nearest measured point | places | error, mm | said, mm | inside, % |",
             "| --- | --- | --- | --- | --- |"]
    for low, high in zip(RINGS, RINGS[1:]):
        within = [place for place in places if low <= place[0] < high]
        if within:
            lines.append(row_of(f"{low} to {high}" if np.isfinite(high) else f"beyond {low}", within))
    lines.append(row_of("all", places))
    file.write_text("\n".join(lines) + "\n")
    print("\n".join(lines))
