# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs heads and writes the table of them; called by run.sh."""
import array
import csv
import html
import json
import pathlib
import resource
import subprocess
import sys
import time
import xml.etree.ElementTree as tree

sys.dont_write_bytecode = True
sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "random"))

import vtu  # noqa: E402

DIRECTION = (0.5, -0.1, 0.86)  # of the opening from the brain's middle, LPS: the left frontal and parietal lobe
FIELDS = ("head", "converged", "seconds", "segment_seconds", "peak_mb", "smallest_jacobian", "folded_voxels",
          "brain_ml")
MORE = ("processor_seconds", "distance_95_mm", "nodes", "steps", "penetration_mm", "fault")
PICTURES = ("axial_labels", "coronal_labels", "sagittal_labels", "axial_displacement", "coronal_displacement",
            "sagittal_displacement", "surface")
BOUNDS = {"seconds": 30, "segment_seconds": 10, "peak_mb": 1500, "folded_voxels": 0}
LEAST_JACOBIAN = 0.3


def points(file):
    """Points of a .vtp that brainshift wrote."""
    root = tree.parse(file).getroot()
    element = root.find(".//Points/DataArray")
    text = root.find("AppendedData").text.strip()[1:][int(element.get("offset")):]
    values = array.array("d", vtu.unpacked(text))
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


def run_head(program, folder, row, out, options):
    run = out / row["head"]
    run.mkdir(parents=True, exist_ok=True)
    scene = run / "scene.xml"
    begin, used = time.monotonic(), processor_seconds()
    scene.write_text(scene_text(folder, row, (0, 0, 0)))
    fault = run_program(program, "run", scene, "--out", run / "run", "--until", "segment", "--force")
    if not fault:
        scene.write_text(scene_text(folder, row, opening(run / "run/segment/brain.vtp")))
        fault = run_program(program, "run", scene, "--out", run / "run", *options)
    return row_of(row["head"], run / "run", time.monotonic() - begin, processor_seconds() - used, fault)


def processor_seconds():
    """Of the programs that have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def row_of(head, run, seconds, used, fault):
    stages = [entry(run / name) for name in ("segment", "discretise", "solve", "register")]
    segment, discretise, solve, register = (stage.get("measures", {}) for stage in stages)
    brain = segment.get("brain", {})
    return {"head": head, "converged": "yes" if solve.get("converged") else "no", "seconds": round(seconds, 1),
            "segment_seconds": stages[0].get("seconds"),
            "peak_mb": max((stage.get("peak_memory_mb", 0) for stage in stages)),
            "smallest_jacobian": solve.get("smallest_jacobian"), "folded_voxels": register.get("folded_voxels"),
            "brain_ml": round(brain.get("volume_mm3", 0) / 1000), "processor_seconds": round(used, 1),
            "distance_95_mm": brain.get("boundary_distance_95_mm"),
            "nodes": stages[1].get("sizes", {}).get("nodes"), "steps": stages[2].get("sizes", {}).get("steps"),
            "penetration_mm": solve.get("largest_penetration_mm"), "fault": fault}


def missed(row):
    """What of the bounds a row misses."""
    names = [name for name, most in BOUNDS.items() if row[name] is None or row[name] > most]
    if row["smallest_jacobian"] is None or row["smallest_jacobian"] <= LEAST_JACOBIAN:
        names.append("smallest_jacobian")
    return (["converged"] if row["converged"] == "no" else []) + names


def text_of(value):
    return f"{value:.3g}" if isinstance(value, float) else str(value if value is not None else "")


def write_tables(rows, out):
    with open(out / "heads.csv", "w", newline="", encoding="utf-8") as stream:
        table = csv.DictWriter(stream, FIELDS, extrasaction="ignore", lineterminator="\n")
        table.writeheader()
        table.writerows(rows)
    columns = FIELDS + MORE
    lines = ["| " + " | ".join(columns) + " | misses |", "|" + " --- |" * (len(columns) + 1)]
    for row in outliers_first(rows):
        cells = [text_of(row[c]) for c in columns]
        lines.append("| " + " | ".join(cells) + " | " + ", ".join(missed(row)) + " |")
    (out / "heads.md").write_text("# Heads\n\n" + "\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


def outliers_first(rows):
    return sorted(rows, key=lambda r: (-len(missed(r)), r["smallest_jacobian"] or 0))


def section(row, out):
    """A head on the page: what it measured and misses, its slices and its surface."""
    report = pathlib.Path(row["head"]) / "run/report"
    pictures = "".join(f'<img src="{html.escape(str(report / name))}.svg" alt="{name}" loading="lazy"/>\n'
                       for name in PICTURES if (out / report / f"{name}.svg").exists())
    figures = ", ".join(f"{name} {text_of(row[name])}" for name in FIELDS[1:] + MORE if row[name] not in ("", None))
    misses = ", ".join(missed(row))
    return (f'<h2>{html.escape(row["head"])}</h2>\n<p>{html.escape(figures)}</p>\n'
            + (f"<p><b>misses: {misses}</b></p>\n" if misses else "") + pictures)


def write_page(rows, out):
    style = "body{font:15px sans-serif;margin:24px}img{width:32%;vertical-align:top;margin:2px}"
    body = "".join(section(row, out) for row in outliers_first(rows))
    (out / "index.html").write_text(f'<!DOCTYPE html>\n<meta charset="utf-8"/><title>Heads</title>'
                                    f"<style>{style}</style>\n<h1>Heads</h1>\n{body}", encoding="utf-8")


def main():
    quick = sys.argv[1] == "--quick"
    program, out, *folders = sys.argv[2 if quick else 1:]
    options = ("--set", "discretise.nodes=2000") if quick else ()
    if quick:
        del BOUNDS["seconds"], BOUNDS["segment_seconds"]
    out = pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    rows = []
    for folder in map(pathlib.Path, folders):
        with open(folder / "heads.tsv", newline="", encoding="utf-8") as stream:
            for row in csv.DictReader(stream, delimiter="\t"):
                rows.append(run_head(program, folder, {k: v or "" for k, v in row.items()}, out, options))
                print(rows[-1]["head"], rows[-1]["fault"] or "done", file=sys.stderr, flush=True)
    write_tables(rows, out)
    write_page(rows, out)
    sys.exit(1 if any(missed(row) or row["fault"] for row in rows) else 0)


main()
