# SPDX-License-Identifier: GPL-3.0-or-later
"""Predicts landmarks of patients by brainshift; called by run.sh."""
import csv
import gzip
import json
import pathlib
import re
import struct
import subprocess
import sys

import numpy as np

from ellipsoids import covered, distances, symmetric, write_table
from predictors import GIVEN, gaussian_process, none, read_pairs, rigid, spread_out
from residuals import write_picture

NOISE = 1.0  # mm, of a landmark along each axis: a voxel of the images is about as large
DEPTHS = (8.0, 6.0, 4.0, 2.0, 0.0)  # mm: so deep in the stand-in head the landmarks lie, the first that fits
LPS = np.diag([-1.0, -1.0, 1.0])
FIELDS = ("patient", "none", "rigid", "gaussian_process", "model", "inside_95")
BRAIN = (1, 2, 3)
MOST_MEAN, MOST_HARM, COVERED = 1.20, 1.03, (0.90, 0.98)


def read_labels(file):
    """Voxels and their affine, LPS, of a .nii.gz that brainshift wrote."""
    data = gzip.open(file).read()
    size = struct.unpack_from("<3h", data, 42)
    kind = {2: "<u1", 4: "<i2", 8: "<i4"}[struct.unpack_from("<h", data, 70)[0]]
    start = int(struct.unpack_from("<f", data, 108)[0])
    affine = np.array(struct.unpack_from("<12f", data, 280)).reshape(3, 4)
    voxels = np.frombuffer(data, kind, int(np.prod(size)), start).reshape(size, order="F")
    return voxels, LPS @ affine


def deep_inside(mask, spacing, depth):
    """The voxels whose ball of this radius, mm, is in the mask."""
    reach = [int(np.ceil(depth / s)) for s in spacing]
    result = mask.copy()
    for i in range(-reach[0], reach[0] + 1):
        for j in range(-reach[1], reach[1] + 1):
            for k in range(-reach[2], reach[2] + 1):
                if np.linalg.norm(np.array([i, j, k]) * spacing) <= depth:
                    result &= np.roll(mask, (i, j, k), (0, 1, 2))
    return result


class Head:
    """The stand-in: whole heads of these patients are not to be had."""

    def __init__(self, labels):
        voxels, self.affine = read_labels(labels)
        self.brain = np.isin(voxels, BRAIN)
        self.deep = {}  # by depth, mm
        middle = np.argwhere(self.brain).mean(axis=0)
        self.middle = self.affine[:, :3] @ middle + self.affine[:, 3]

    def holds(self, places, depth):
        if depth not in self.deep:
            self.deep[depth] = deep_inside(self.brain, np.linalg.norm(self.affine[:, :3], axis=0), depth)
        index = np.rint(np.linalg.solve(self.affine[:, :3], (places - self.affine[:, 3]).T).T).astype(int)
        within = ((index >= 0) & (index < self.brain.shape)).all(axis=1)
        return within.all() and self.deep[depth][tuple(index.T)].all()

    def shift(self, places):
        """The origin of the landmarks' frame goes to the middle of the brain, then all go by the least way after which
        they lie deep inside."""
        steps = np.arange(-40, 41, 2.0)
        moves = np.stack(np.meshgrid(steps, steps, steps, indexing="ij"), axis=-1).reshape(-1, 3)
        moves = moves[np.argsort(np.linalg.norm(moves, axis=1), kind="stable")]
        for depth in DEPTHS:
            for move in moves:
                if self.holds(places + self.middle + move, depth):
                    if depth < DEPTHS[0]:
                        print(f"the landmarks fit into the stand-in head {depth:g} mm deep only")
                    return self.middle + move
        raise ValueError("the landmarks do not fit into the stand-in head")


def write_load(file, places, displacement):
    rows = [",".join(f"{x:.9g}" for x in (*p, *d)) for p, d in zip(places, displacement)]
    file.write_text("# frame: LPS\nx,y,z,ux,uy,uz\n" + "\n".join(rows) + "\n")


def write_landmarks(file, places):
    rows = [f"{i},{p[0]:.9g},{p[1]:.9g},{p[2]:.9g},0,0,0,1,1,1,0,{i},," for i, p in enumerate(places)]
    file.write_text("# Markups fiducial file version = 4.11\n# CoordinateSystem = LPS\n" + "\n".join(rows) + "\n")


def scene_of(text):
    """The head's own scene without its skull: which side of the opening it lies on nobody knows."""
    text = re.sub(r"<load>.*?</load>", f'<load noise="{NOISE}" registration="unknown">\n'
                  '    <craniotomy file="landmarks.csv"/>\n  </load>', text, flags=re.S)
    text = text.replace("<contact/>", "<uncertainty/>").replace("landmarks.mrk.json", "landmarks.fcsv")
    return text.replace('nodes="12000"', 'nodes="1500"')


def rows_of(file):
    lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def numbers(rows, names):
    return np.array([[float(row[name]) for name in names] for row in rows])


def read_rigid(file):
    values = np.array([float(x) for x in re.search(r"Parameters: (.*)", file.read_text()).group(1).split()])
    return values[:9].reshape(3, 3), values[9:]


def predict(program, work, before, after, given):
    """Where the program says that all places go (LPS), the covariance of each without its own error, and the run's
    record. The head's mesh is made once: only the load differs."""
    write_load(work / "landmarks.csv", before[given], (after - before)[given])
    write_landmarks(work / "landmarks.fcsv", before)
    subprocess.run([program, "run", "-q", str(work / "scene.xml"), "--out", str(work / "run"), "--until", "register"],
                   check=True)
    turn, move = read_rigid(work / "run" / "solve" / "registration_error.tfm")
    moved = numbers(rows_of(work / "run" / "register" / "landmarks.csv"), ("intraop_x", "intraop_y", "intraop_z"))
    c = numbers(rows_of(work / "run" / "solve" / "uncertainty.csv"), ("xx", "yy", "zz", "xy", "yz", "zx"))
    record = json.loads((work / "run" / "run.json").read_text())["stages"]["solve"]["measures"]
    return moved @ turn.T + move, symmetric(c), record


def patient_of(file):
    return re.match(r"Case\d+", file.name).group(0)


def row_of(program, work, head, file):
    before, after = (pairs @ LPS for pairs in read_pairs(file))
    if len(before) <= GIVEN:
        raise ValueError(f"{len(before)} pairs: more than the {GIVEN} that are given are needed")
    given = spread_out(before, GIVEN)
    left = [i for i in range(len(before)) if i not in given]
    shift = head.shift(before)
    predicted, covariance, record = predict(program, work, before + shift, after + shift, given)
    error = predicted - shift - after
    own = NOISE * record["noise_factor"]
    row = {"patient": patient_of(file)}
    for method in (none, rigid, gaussian_process):
        guess = method(before[given], after[given])(before[left])
        row[method.__name__] = np.linalg.norm(guess - after[left], axis=1).mean()
    row["model"] = np.linalg.norm(error[left], axis=1).mean()
    whole = covariance + own**2 * np.eye(3)
    row["inside_95"] = np.mean([covered(error[i], whole[i]) for i in left])
    near = distances(before[left], before[given])
    places = [(near[k], error[i], whole[i]) for k, i in enumerate(left)]
    return row, {"places": places, "before": before, "after": after, "error": error, "given": given, "landmarks": len(left)}


def rows_as_they_come(program, out, files):
    """Rows, cases and the patients that could not be predicted. patients.csv has each row as soon as it is known."""
    work = out / "head"
    if not (work / "labels.nii.gz").exists():
        subprocess.run([program, "phantom", "--out", str(work)], check=True)
    (work / "scene.xml").write_text(scene_of((work / "scene.xml").read_text()))
    head = Head(work / "labels.nii.gz")
    rows, cases, lost = [], [], []
    with (out / "patients.csv").open("w", newline="") as stream:
        table = csv.writer(stream)
        table.writerow(FIELDS)
        for file in files:
            try:
                row, case = row_of(program, work, head, file)
            except (ValueError, subprocess.CalledProcessError) as error:
                lost.append(f"{patient_of(file)}: {error}")
                continue
            print(" ".join(f"{v:.3f}" if isinstance(v, float) else str(v) for v in row.values()), flush=True)
            table.writerow([row[name] if name == "patient" else f"{row[name]:.4f}" for name in FIELDS])
            stream.flush()
            rows.append(row)
            cases.append(case)
    return rows, cases, lost


def faults(rows, counts):
    mean = np.mean([row["model"] for row in rows])
    inside = np.average([row["inside_95"] for row in rows], weights=counts)
    if mean > MOST_MEAN:
        yield f"the mean error is {mean:.3f} mm, at most {MOST_MEAN} mm are wanted"
    for row in rows:
        if row["model"] > MOST_HARM * row["rigid"]:
            yield f"{row['patient']}: {row['model']:.2f} mm, rigid {row['rigid']:.2f} mm"
    if not COVERED[0] <= inside <= COVERED[1]:
        yield f"{100 * inside:.1f} % of the landmarks lie inside their 95 % ellipsoid"


def main(program, out, folder):
    out.mkdir(parents=True, exist_ok=True)
    files = sorted(folder.glob("Case*-MRI-beforeUS.tag"))
    if not files:
        raise SystemExit(f"{folder}: no Case*-MRI-beforeUS.tag in it")
    rows, cases, lost = rows_as_they_come(program, out, files)
    if not rows:
        raise SystemExit("\n".join(lost))
    write_table(out / "coverage.md", [place for case in cases for place in case["places"]])
    write_picture(out / "residuals.svg", rows, cases)
    counts = [case["landmarks"] for case in cases]
    means = {name: np.average([row[name] for row in rows], weights=counts if name == "inside_95" else None)
             for name in FIELDS[1:]}
    print("mean", " ".join(f"{name} {value:.3f}" for name, value in means.items()))
    found = lost + list(faults(rows, counts))
    print("\n".join(found))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])))
