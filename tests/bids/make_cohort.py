#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A BIDS folder of phantoms: two heads of different resolution, a load for each participant, some broken on purpose.

  make_cohort.py PROGRAM DIR PARTICIPANTS BROKEN     the last BROKEN of them, each in another way (five are known)
"""
import gzip
import json
import os
import pathlib
import shutil
import subprocess
import sys

HEADS = ({"size": "24", "spacing": "5.5"}, {"size": "28", "spacing": "5"})
LABELS = "index\tname\n1\tparenchyma\n2\tventricles\n3\ttumour\n4\tCSF\n5\tskull\n6\tskin\n"


def scaled(load, factor):
    """The craniotomy.csv with its displacements times a factor."""
    *head, names, = [line for line in load.splitlines() if line[0] in "#x"]
    rows = [line.split(",") for line in load.splitlines() if line[0] not in "#x"]
    moved = [",".join(row[:3] + [repr(factor * float(u)) for u in row[3:]]) for row in rows]
    return "\n".join([*head, names, *moved]) + "\n"


def add_participant(bids, name, head, factor):
    anatomy = bids / name / "anat"
    derived = bids / "derivatives" / "planning" / name / "anat"
    anatomy.mkdir(parents=True)
    derived.mkdir(parents=True)
    os.link(head / "t1.nii.gz", anatomy / f"{name}_T1w.nii.gz")
    (anatomy / f"{name}_T1w.json").write_text('{"Modality": "MR"}\n')
    os.link(head / "labels.nii.gz", derived / f"{name}_dseg.nii.gz")
    load = (head / "craniotomy.csv").read_text()
    (derived / f"{name}_desc-cortex_points.csv").write_text(scaled(load, factor))


def broken(bids, name, way):
    anatomy = bids / name / "anat"
    derived = bids / "derivatives" / "planning" / name / "anat"
    t1, labels = anatomy / f"{name}_T1w.nii.gz", derived / f"{name}_dseg.nii.gz"
    points = derived / f"{name}_desc-cortex_points.csv"
    if way == 0:
        t1.unlink()
        (anatomy / f"{name}_T2w.nii.gz").write_bytes(labels.read_bytes())
    elif way == 1:
        labels.unlink()
    elif way == 2:
        points.unlink()
    elif way == 3:  # the T1 was cut off when it was copied
        plain = gzip.decompress(t1.read_bytes())
        t1.unlink()
        t1.write_bytes(gzip.compress(plain[:len(plain) // 2]))
    else:  # no frame is named
        points.write_text("\n".join(points.read_text().splitlines()[1:]) + "\n")


def main(program, folder, participants, ways):
    bids = pathlib.Path(folder)
    shutil.rmtree(bids, ignore_errors=True)
    bids.mkdir(parents=True)
    heads = [bids / f".head{number}" for number in range(len(HEADS))]
    for head, options in zip(heads, HEADS):
        words = [word for name, value in options.items() for word in ("--" + name, value)]
        subprocess.run([program, "--quiet", "phantom", "--out", str(head), *words], check=True)
    about = {"Name": "Phantoms", "BIDSVersion": "1.8.0", "License": "CC0", "Authors": ["brainshift"]}
    (bids / "dataset_description.json").write_text(json.dumps(about))
    (bids / "README").write_text("Synthetic heads, each with its own load. Some are broken on purpose.\n")
    for number in range(participants):
        name = f"sub-{number + 1:05d}"
        add_participant(bids, name, heads[number % len(heads)], 0.5 + 0.5 * (number + 1) / participants)
        if number >= participants - ways:
            broken(bids, name, (participants - 1 - number) % 5)
    planning = bids / "derivatives" / "planning"
    (planning / "dataset_description.json").write_text(json.dumps({**about, "GeneratedBy": [{"Name": "phantom"}]}))
    (planning / "dseg.tsv").write_text(LABELS)
    for head in heads:
        shutil.rmtree(head)


if __name__ == "__main__":
    main(sys.argv[1], sys.argv[2], int(sys.argv[3]), int(sys.argv[4]))
