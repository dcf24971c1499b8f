# SPDX-License-Identifier: GPL-3.0-or-later
"""Whether the ellipsoids of <uncertainty> hold the truth on the program's own head; called by phantoms.sh.

The truth is the head's solution with all measured points, imposed exactly, and constants that were drawn from what the
program calls their range. The program is told of a quarter of the points, with noise, and of the usual constants.
"""
import pathlib
import re
import subprocess
import sys

import numpy as np

from ellipsoids import covered, distances, symmetric, write_table
from patients import BRAIN, numbers, read_labels, rows_of, write_landmarks, write_load

TRUTHS, PLACES, GIVEN, NOISE = 6, 150, 20, 0.5
NEAR, NEARER = 75, 30  # more places within so many mm of the measured points: of all places few lie there
NODES = 12000  # of fewer, which tissues are much stiffer than others changes the answer as much as constants do
ALIKE = 'craniotomy_factor="1"'  # the nodes know nothing of the load
XYZ = ("x", "y", "z", "ux", "uy", "uz")
STIFFNESS = 0.25
COVERED = (0.90, 0.98)


def brain_in(labels):
    voxels, affine = read_labels(labels)
    return np.argwhere(np.isin(voxels, BRAIN)) @ affine[:, :3].T + affine[:, 3]


def chosen(places, count, random):
    return places[random.choice(len(places), count, replace=False)]


def places_in(labels, random):
    return chosen(brain_in(labels), PLACES, random)


def phantom_scene(program, folder, nodes):
    """The scene of a phantom whose runs all have the same nodes, and all its measured points.

    Otherwise what differs would mostly be that nodes are finer where each load is.
    """
    subprocess.run([program, "phantom", "--out", str(folder)], check=True, stdout=subprocess.DEVNULL)
    scene = (folder / "scene.xml").read_text().replace('nodes="12000"', f'nodes="{nodes}" {ALIKE}')
    scene = scene.replace("landmarks.mrk.json", "landmarks.fcsv")
    return scene, numbers(rows_of(folder / "craniotomy.csv"), XYZ)


def with_constants(text, random):
    def drawn(match):
        stiffness = float(match.group(1)) * np.exp(STIFFNESS * random.standard_normal())
        own = float(match.group(2))
        ratio = random.uniform(own - 0.04, min(own + 0.04, 0.498))
        return f'youngs_modulus="{stiffness:.6g}" poisson_ratio="{ratio:.6g}"'
    return re.sub(r'youngs_modulus="([^"]*)" poisson_ratio="([^"]*)"', drawn, text)


def run(program, work, scene, out):
    (work / "scene.xml").write_text(scene)
    subprocess.run([program, "run", "-q", str(work / "scene.xml"), "--out", str(out), "--until", "register"], check=True)
    return numbers(rows_of(out / "register" / "landmarks.csv"), ("ux", "uy", "uz"))


def main(program, out):
    out.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    work = out / "head"
    text, measured = phantom_scene(program, work, NODES)
    brain = brain_in(work / "labels.nii.gz")
    near = brain[distances(brain, measured[:, :3]) < NEARER]
    places = np.vstack([chosen(brain, PLACES, random), chosen(near, NEAR, np.random.default_rng(2))])
    write_landmarks(work / "landmarks.fcsv", places)
    found, everywhere = [], []
    for truth in range(TRUTHS):
        write_load(work / "craniotomy.csv", measured[:, :3], measured[:, 3:])
        true = run(program, work, with_constants(text, random), out / "run")
        given = measured[random.choice(len(measured), GIVEN, replace=False)]
        write_load(work / "craniotomy.csv", given[:, :3], given[:, 3:] + NOISE * random.standard_normal((GIVEN, 3)))
        told = text.replace("<load>", f'<load noise="{NOISE}">').replace("<contact/>", "<contact/><uncertainty/>")
        error = run(program, work, told, out / "run") - true
        six = numbers(rows_of(out / "run" / "solve" / "uncertainty.csv"), ("xx", "yy", "zz", "xy", "yz", "zx"))
        of_truth = list(zip(distances(places, given[:, :3]), error, symmetric(six)))
        found += of_truth
        everywhere += of_truth[:PLACES]
        print(f"truth {truth + 1}: error {np.linalg.norm(error, axis=1).mean():.2f} mm", flush=True)
    write_table(out / "coverage.md", found)
    inside = np.mean([covered(error, covariance) for _, error, covariance in everywhere])
    print(f"{100 * inside:.1f} % of {len(everywhere)} places all over the brain lie inside their 95 % ellipsoid")
    return 0 if COVERED[0] <= inside <= COVERED[1] else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2])))
