# SPDX-License-Identifier: GPL-3.0-or-later
"""How the displacement of each landmark varies over runs of the same scene."""
import csv
import statistics

AXES = ("ux", "uy", "uz")
COLUMNS = ("scene", "label", "runs", *(f"{axis}_{what}" for axis in AXES for what in ("mean", "sd")))


def spread(runs):
    """runs: (scene, landmarks.csv) of each; a scene without landmarks has no rows."""
    samples = {}
    for scene, file in runs:
        if file.exists():
            with open(file, newline="", encoding="utf-8") as stream:
                lines = (line for line in stream if not line.startswith("#"))
                for row in csv.DictReader(lines):
                    samples.setdefault((scene, row["label"]), []).append([float(row[axis]) for axis in AXES])
    return [row_of(scene, label, moved) for (scene, label), moved in samples.items()]


def row_of(scene, label, moved):
    row = {"scene": scene, "label": label, "runs": len(moved)}
    for axis, values in zip(AXES, zip(*moved)):
        row[f"{axis}_mean"] = statistics.fmean(values)
        row[f"{axis}_sd"] = statistics.stdev(values) if len(values) > 1 else None
    return row
