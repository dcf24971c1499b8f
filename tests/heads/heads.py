# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs heads and writes the table of them; called by run.sh."""
import array
import base64
import csv
import json
import pathlib
import struct
import subprocess
import sys
import time
import xml.etree.ElementTree as tree
import zlib

DIRECTION = (0.5, -0.1, 0.86)  # of the opening from the brain's middle, LPS: the left frontal and parietal lobe
FIELDS = ("head", "converged", "seconds", "segment_seconds", "peak_mb", "smallest_jacobian", "folded_voxels",
          "brain_ml")
MORE = ("distance_95_mm", "nodes", "steps", "penetration_mm", "fault")
BOUNDS = {"seconds": 30, "segment_seconds": 10, "peak_mb": 1500, "folded_voxels": 0}
LEAST_JACOBIAN = 0.3


def decoded(text, size):
    return base64.b64decode(text[:4 * ((size + 2) // 3)])[:size]


def points(file):
    """Points of a .vtp that brainshift wrote: appended base64 of zlib blocks."""
    root = tree.parse(file).getroot()
    element = root.find(".//Points/DataArray")
    text = root.find("AppendedData").text.strip()[1:][int(element.get("offset")):]
    blocks = struct.unpack("<I", decoded(text, 4))[0]
    header = 4 * (3 + blocks)
    sizes = struct.unpack_from(f"<{blocks}I", decoded(text, header), 12)
    packed = decoded(text[4 * ((header + 2) // 3):], sum(sizes))
    plain, start = b"", 0
    for size in sizes:
        plain += zlib.decompress(packed[start:start + size])
        start += size
    values = array.array("d", plain)
    return list(zip(values[0::3], values[1::3], values[2::3]))


def opening(surface):
    """The point of the surface nearest to the ray from the brain's middle."""
    vertices = points(surface)
    middle = [(min(axis) + max(axis)) / 2 for axis in zip(*vertices)]
    length = sum(d * d for d in DIRECTION) ** 0.5

    def angle(vertex):
        away = [v - m for v, m in zip(vertex, middle)]
        along = sum(a * d for a, d in zip(away, DIRECTION)) / length
        return along / sum(a * a for a in away) ** 0.5

    return max(vertices, key=angle)


def scene_text(folder, row, centre):
    names = {"t1": "t1", "labels": "labels", "brain_mask": "brain_mask", "tumour": "tumour"}
    image = " ".join(f'{name}="{(folder / row[column]).resolve()}"' for column, name in names.items() if row[column])
    place = " ".join(f"{c:.3f}" for c in centre)
    return (f'<scene version="1">\n  <image {image}/>\n  <load><simulated centre="{place}"/></load>\n  <contact/>\n'
            "</scene>\n")


def run_program(program, *words):
    """Empty, or the last line that the program said of a fault."""
    done = subprocess.run([program, "-q", *map(str, words)], capture_output=True, text=True, check=False)
    return "" if done.returncode == 0 else (done.stderr.strip().splitlines() or ["ended without a word"])[-1]


def entry(folder):
    file = folder / "stage.json"
    return json.loads(file.read_text())["entry"] if file.exists() else {}


def run_head(program, folder, row, out):
    run = out / row["head"]
    run.mkdir(parents=True, exist_ok=True)
    scene = run / "scene.xml"
    begin = time.monotonic()
    scene.write_text(scene_text(folder, row, (0, 0, 0)))
    fault = run_program(program, "run", scene, "--out", run / "run", "--until", "segment", "--force")
    if not fault:
        scene.write_text(scene_text(folder, row, opening(run / "run/segment/brain.vtp")))
        fault = run_program(program, "run", scene, "--out", run / "run")
    moved = run / "run/register"
    if not fault and not row["t1"]:  # the fields and the labels; there is no image to warp
        moved = run / "run/register_labels"
        labels = run / "run/segment/labels.nii.gz"
        fault = run_program(program, "register", "--solution", run / "run/solve/solution.vtu", "--brain",
                            run / "run/segment/brain.vtp", "--t1", labels, "--labels", labels,
                            "--out", moved)
    return row_of(row["head"], run / "run", moved, time.monotonic() - begin, fault)


def row_of(head, run, moved, seconds, fault):
    stages = [entry(run / name) for name in ("segment", "discretise", "solve")] + [entry(moved)]
    segment, discretise, solve, register = (stage.get("measures", {}) for stage in stages)
    brain = segment.get("brain", {})
    return {"head": head, "converged": "yes" if solve.get("converged") else "no", "seconds": round(seconds, 1),
            "segment_seconds": stages[0].get("seconds"),
            "peak_mb": max((stage.get("peak_memory_mb", 0) for stage in stages)),
            "smallest_jacobian": solve.get("smallest_jacobian"), "folded_voxels": register.get("folded_voxels"),
            "brain_ml": round(brain.get("volume_mm3", 0) / 1000),
            "distance_95_mm": brain.get("boundary_distance_95_mm"),
            "nodes": stages[1].get("sizes", {}).get("nodes"), "steps": stages[2].get("sizes", {}).get("steps"),
            "penetration_mm": solve.get("largest_penetration_mm"), "fault": fault}


def missed(row):
    """What of the bounds a row misses."""
    names = [name for name, most in BOUNDS.items() if row[name] is None or row[name] > most]
    if row["smallest_jacobian"] is None or row["smallest_jacobian"] <= LEAST_JACOBIAN:
        names.append("smallest_jacobian")
    return (["converged"] if row["converged"] == "no" else []) + names


def write_tables(rows, out):
    with open(out / "heads.csv", "w", newline="", encoding="utf-8") as stream:
        table = csv.DictWriter(stream, FIELDS, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    columns = FIELDS + MORE
    lines = ["| " + " | ".join(columns) + " | misses |", "|" + " --- |" * (len(columns) + 1)]
    for row in sorted(rows, key=lambda r: (-len(missed(r)), r["smallest_jacobian"] or 0)):
        cells = [f"{row[c]:.3g}" if isinstance(row[c], float) else str(row[c] if row[c] is not None else "")
                 for c in columns]
        lines.append("| " + " | ".join(cells) + " | " + ", ".join(missed(row)) + " |")
    (out / "heads.md").write_text("# Heads\n\n" + "\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


def main():
    program, out = sys.argv[1], pathlib.Path(sys.argv[2])
    out.mkdir(parents=True, exist_ok=True)
    rows = []
    for folder in map(pathlib.Path, sys.argv[3:]):
        with open(folder / "heads.tsv", newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(stream, delimiter="\t"):
                rows.append(run_head(program, folder, {k: v or "" for k, v in row.items()}, out))
                print(rows[-1]["head"], rows[-1]["fault"] or "done", file=sys.stderr, flush=True)
    write_tables(rows, out)
    sys.exit(1 if any(missed(row) or row["fault"] for row in rows) else 0)


main()
