# SPDX-License-Identifier: GPL-3.0-or-later
"""A synthetic head as 3D Slicer hands it over: .nrrd, a segmentation with names, and lists of points."""
import csv
import gzip
import json
import struct
import subprocess

SEGMENTS = {1: "brain", 2: "ventricles", 3: "tumour", 4: "CSF", 5: "skull", 6: "skin"}


def nrrd_of(nifti, keys=()):
    """A NIfTI file's image as NRRD, in LPS."""
    data = gzip.decompress(nifti.read_bytes())
    size = struct.unpack_from("<3h", data, 42)
    kind = {4: ("short", 2), 16: ("float", 4)}[struct.unpack_from("<h", data, 70)[0]]
    rows = [struct.unpack_from("<4f", data, 280 + 16 * row) for row in range(3)]
    rows = [[-value for value in rows[0]], [-value for value in rows[1]], rows[2]]  # from RAS
    vector = lambda column: "(" + ",".join(f"{row[column]:.9g}" for row in rows) + ")"
    header = ["NRRD0004", f"type: {kind[0]}", "dimension: 3", "space: left-posterior-superior"]
    header += ["sizes: {} {} {}".format(*size), "space directions: " + " ".join(vector(i) for i in range(3))]
    header += ["kinds: domain domain domain", "endian: little", "encoding: gzip", f"space origin: {vector(3)}", *keys]
    begin = int(struct.unpack_from("<f", data, 108)[0])
    voxels = data[begin : begin + size[0] * size[1] * size[2] * kind[1]]
    return ("\n".join(header) + "\n\n").encode() + gzip.compress(voxels)


def markups_of(points):
    controls = [{"label": f"F-{i}", "position": list(p)} for i, p in enumerate(points, 1)]
    return json.dumps({"markups": [{"type": "Fiducial", "coordinateSystem": "LPS", "controlPoints": controls}]})


def make_head(program, folder):
    """{name of the module's input: file}."""
    phantom = [program, "phantom", "--size", "40", "--quiet", "--out", folder / "head"]
    subprocess.run(phantom, check=True, capture_output=True)
    keys = [line for i, (label, name) in enumerate(SEGMENTS.items()) for line in (
        f"Segment{i}_ID:=s{i}", f"Segment{i}_Name:={name}", f"Segment{i}_LabelValue:={label}", f"Segment{i}_Layer:=0")]
    lines = (folder / "head" / "craniotomy.csv").read_text().splitlines()
    rows = [[float(v) for v in row[:6]] for row in csv.reader(l for l in lines if l[0] not in "#x")]
    files = {"t1": "t1.nrrd", "labels": "labels.nrrd", "before": "before.mrk.json", "after": "after.mrk.json"}
    files = {name: folder / file for name, file in files.items()}
    files["t1"].write_bytes(nrrd_of(folder / "head" / "t1.nii.gz"))
    files["labels"].write_bytes(nrrd_of(folder / "head" / "labels.nii.gz", keys))
    files["before"].write_text(markups_of(row[:3] for row in rows))
    files["after"].write_text(markups_of([a + u for a, u in zip(row[:3], row[3:])] for row in rows))
    return files
