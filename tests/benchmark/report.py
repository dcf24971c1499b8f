# SPDX-License-Identifier: GPL-3.0-or-later
"""The tables of one benchmark's run as Markdown, from the CSV files in its folder; those that are not there are left out.

usage: report.py FOLDER [quick|usual|full]
"""
import csv
import os
import sys

import numpy as np


def rows_of(folder, name):
    """Rows of a CSV; empty where there is none. Google Benchmark writes about the machine before its titles."""
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return []
    with open(path, newline="") as file:
        lines = file.readlines()
    start = next((i for i, line in enumerate(lines) if line.startswith("name,")), 0)
    return list(csv.DictReader(lines[start:]))


def number(value, digits=3):
    """As people write it: three digits that count, no exponent."""
    if value is None or not np.isfinite(value):
        return ""
    if value == 0:
        return "0"
    places = max(0, digits - 1 - int(np.floor(np.log10(abs(value)))))
    return f"{round(value, places):.{places}f}" if places else f"{int(round(value)):,}"


def table(title, about, columns, rows):
    cells = [[c if isinstance(c, str) else number(c) for c in row] for row in rows]
    lines = [f"## {title}", *about, "", "| " + " | ".join(columns) + " |", "|" + " --- |" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in cells]) + "\n"


def ratio(a, b):
    return a / b if a is not None and b else np.nan


def machine_table(folder):
    rows = rows_of(folder, "machine.csv")
    value = {(r["figure"], int(r["threads"])): float(r["value"]) for r in rows}
    units = {r["figure"]: r["unit"] for r in rows}
    out = [[figure, unit, value[figure, 1], value.get((figure, 2)), ratio(value.get((figure, 2)), value[figure, 1])]
           for figure, unit in units.items()]
    return table("Machine", ["What loops in vector code reach here."], ["figure", "unit", "1 thread", "2 threads", "ratio"], out)


def memory_rate(folder, threads):
    """Bytes a second that this machine reads from memory."""
    found = [float(r["value"]) for r in rows_of(folder, "machine.csv")
             if r["figure"] == "read from memory" and int(r["threads"]) == threads]
    return 1e9 * found[0] if found else np.nan


def best_kernels(folder, name):
    """The fastest repetition of each, by (kernel, setting, threads)."""
    best = {}
    for row in rows_of(folder, name):
        words = row["name"].split("/")[0].split("; ")
        if not row["name"].endswith("real_time") or len(words) != 3:
            continue
        key = (words[0], words[1], int(words[2]))
        kept = {k: float(row[k]) for k in ("real_time", "cpu_time", "seconds_a_pair", "bytes_read", "bytes_a_second", "pairs")}
        if key not in best or kept["real_time"] < best[key]["real_time"]:
            best[key] = kept
    return best


def kernel_table(folder):
    best, native = best_kernels(folder, "kernels.csv"), best_kernels(folder, "kernels-native.csv")
    out = []
    for (kernel, setting, threads), row in best.items():
        floor = next((r for k, r in best.items() if k[0].startswith("plain rows") and k[2] == threads), None)
        paired = row["pairs"] > 0
        reads = row["bytes_read"] > 0
        alone = best.get((kernel, setting, 1))
        out.append([kernel, setting, str(threads), row["real_time"], row["cpu_time"], 1e9 * row["seconds_a_pair"] if paired else "",
                    row["bytes_read"] / 1e6 if reads else "", row["bytes_a_second"] / 1e9 if reads else "",
                    row["bytes_a_second"] / memory_rate(folder, threads) if reads else "",
                    ratio(row["seconds_a_pair"], floor["seconds_a_pair"]) if floor and reads else "",
                    ratio(alone["real_time"], row["real_time"]) if threads > 1 and alone else "",
                    ratio(row["real_time"], native[kernel, setting, threads]["real_time"])
                    if (kernel, setting, threads) in native else ""])
    about = ["The demo's brain, 20,000 nodes, neo-Hookean. `linear, 1 point`: linear basis, one integration point a cell, about two cells a "
             "node; `MMLS, 8 points`: the defaults. The fastest of the repetitions; a pair is an integration point with a node of its "
             "support. Bytes are those that one evaluation has to read at least once. The plain rows are the floor: a straight loop over "
             "rows of single-precision derivatives, without a law, without pressure patches."]
    return table("Kernels", about, ["kernel", "setting", "threads", "ms", "processor ms", "ns a pair", "MB read", "GB/s",
                                    "of the memory's rate", "time a pair / plain rows'", "1 thread / threads",
                                    "time / native build's"], out)


SCALE_PARTS = ("discretise", "prepare", "shape_functions", "nodal_shape_functions", "integration_points", "correction", "order_nodes")


def scale_table(folder):
    rows = [{k: float(v) for k, v in r.items()} for r in rows_of(folder, "scale.csv")]
    rows.sort(key=lambda r: r["nodes"])

    def peak(r):
        return max(r["discretise_peak_bytes"], r["prepare_peak_bytes"], r["stepping_peak_bytes"])

    def parts(r):
        return sum(r[p + "_s"] for p in SCALE_PARTS[2:])

    figures = {
        "points": lambda r: r["points"], "pairs": lambda r: r["pairs"],
        "cloud and cells, s": lambda r: r["discretise_s"], "preparing, s": lambda r: r["prepare_s"],
        "of it shape functions at points, s": lambda r: r["shape_functions_s"],
        "at nodes, s": lambda r: r["nodal_shape_functions_s"], "integration points, s": lambda r: r["integration_points_s"],
        "correction, s": lambda r: r["correction_s"], "layout and the rest, s": lambda r: max(r["prepare_s"] - parts(r), 0),
        "step, ms": lambda r: 1e3 * r["step_s"], "of it internal force, ms": lambda r: 1e3 * r["force_s"],
        "internal force, ns a pair": lambda r: 1e9 * r["force_s"] / r["pairs"],
        "it reads, GB/s": lambda r: r["bytes_read_a_step"] / r["force_s"] / 1e9,
        "of the memory's rate": lambda r: r["bytes_read_a_step"] / r["force_s"] / memory_rate(folder, int(r["threads"])),
        "held while stepping, bytes a node": lambda r: r["held"] / r["nodes"],
        "peak, cloud and cells, bytes a node": lambda r: r["discretise_peak_bytes"] / r["nodes"],
        "peak, preparing, bytes a node": lambda r: r["prepare_peak_bytes"] / r["nodes"],
        "peak, stepping, bytes a node": lambda r: r["stepping_peak_bytes"] / r["nodes"],
        "peak, MB": lambda r: peak(r) / 1e6}
    out = []
    for name, figure in figures.items():
        values = [figure(r) for r in rows]
        fit = np.polyfit(np.log([r["nodes"] for r in rows]), np.log(values), 1)[0] if len(rows) > 1 and min(values) > 0 else np.nan
        out.append([name, *values, f"{fit:.2f}" if np.isfinite(fit) else ""])
    about = [f"An ellipsoid as large as a brain, linear basis, one integration point a cell, two cells a node, double precision, "
             f"{rows[0]['threads']:.0f} threads. The exponent is that of a least-squares line through logarithms."]
    return table("Scale", about, ["", *[f"{r['nodes']:,.0f} nodes" for r in rows], "exponent"], out)


def stage_table(folder):
    rows = [{k: v if k == "preset" else float(v) for k, v in r.items()} for r in rows_of(folder, "stages.csv")]
    alone = {r["preset"]: r["seconds"] for r in rows if r["threads"] == 1}
    names = ("segment", "discretise", "solve", "register", "report")
    out = [[r["preset"], str(int(r["threads"])), r["nodes"], r["points"], r["steps"], r["seconds"],
            ratio(alone[r["preset"]], r["seconds"]), *[r[f"{n}_s"] for n in names], r["stepping_s"], r["fields_and_images_s"], r["peak_mb"],
            ", ".join(number(r[f"{n}_mb"]) for n in names)] for r in rows]
    return table("Whole runs", ["The demo's head, from the image to the report; `default` is the scene as it is. Files are read and written in all of them."],
                 ["preset", "threads", "nodes", "points", "steps", "whole, s", "1 thread / threads", *[f"{n}, s" for n in names],
                  "of solve: stepping, s", "of register: fields and warped images, s", "peak, MB", "peak of each stage, MB"], out)


TEXTS = ("program", "setting", "note")


def brain_table(folder):
    rows = [{k: v if k in TEXTS else float(v) for k, v in r.items()} for r in rows_of(folder, "brain.csv")]
    direct = {r["threads"]: r for r in rows if r["setting"] == "C3D10, spooles" and not r["note"]}
    out = []
    for r in rows:
        base = direct.get(r["threads"], {})
        out.append([r["program"], r["setting"], str(int(r["threads"])), r["nodes"], r["seconds"], r["peak_mb"], r["error_95_mm"],
                    r["error_largest_mm"], r["error_mean_mm"], ratio(base.get("seconds"), r["seconds"]),
                    ratio(r["peak_mb"], base.get("peak_mb")), r["note"]])
    about = ["A homogeneous brain (neo-Hookean, 3000 Pa, 0.49), a craniotomy pushed in by 8 mm, the far side held, the rest free, no contact: the "
             "brain of the verification. Both programs solve the same load to large strain; seconds are those of the whole program, files "
             "included, without CalculiX's mesh (gmsh) and brainshift's cloud, which the note gives. `refined` has half the spacing within 10 mm of "
             "where the load is, as CalculiX's mesh is refined there (`unrefined` is not). brainshift: eight points a cell, single precision. Errors are at 800 points against 66,027 nodes "
             "of quadratic tetrahedra, which are themselves wrong by 0.03 mm (95 %). The ratios are to C3D10, spooles, of as many threads."]
    return table("Brain shift by CalculiX", about, ["program", "setting", "threads", "nodes", "s", "peak, MB", "error, 95 %, mm", "largest, mm",
                                                    "mean, mm", "C3D10 direct's time / time", "memory / C3D10 direct's", "note"], out)


def resample_table(folder):
    rows = [{k: v if k in TEXTS else float(v) for k, v in r.items()} for r in rows_of(folder, "resample.csv")]
    ours = {r["threads"]: r["seconds"] for r in rows if r["program"] == "brainshift"}
    out = [[r["program"], str(int(r["threads"])), r["seconds"], ratio(r["seconds"], ours[r["threads"]]), r["whole_seconds"], r["peak_mb"],
            r["largest_percent"], r["percent_999"], r["mean_percent"], r["note"]] for r in rows]
    about = ["The demo's 1 mm head with the demo's field on its grid, linear interpolation. Differences are from brainshift's image, in per cent "
             "of the range of intensities."]
    return table("Resampling by plastimatch and transformix", about,
                 ["program", "threads", "resampling, s", "time / brainshift's", "whole program, s", "peak, MB", "largest difference, %", "99.9 %, %",
                  "mean, %", "resampling is"], out)


TABLES = {"machine.csv": machine_table, "kernels.csv": kernel_table, "scale.csv": scale_table, "stages.csv": stage_table,
          "brain.csv": brain_table, "resample.csv": resample_table}


def about_the_run(size):
    """A line that says where and how; nearly nothing in it is known of every machine."""
    with open("/proc/cpuinfo") as file:
        model = next((line.split(":")[1].strip() for line in file if line.startswith("model name")), "unknown processor")
    words = [model, f"{os.cpu_count()} threads", f"mean load while the last table was made {os.getloadavg()[1]:.1f}"]
    if size == "quick":
        words.append("QUICK: small bodies, few repetitions; the texts below speak of the usual ones")
    return "; ".join(words) + ".\n"


def main(folder, size="usual"):
    made = [make(folder) for name, make in TABLES.items() if rows_of(folder, name)]
    text = "\n".join(["# Benchmark", about_the_run(size), *made])
    with open(os.path.join(folder, "benchmark.md"), "w") as file:
        file.write(text)
    print(text)


if __name__ == "__main__":
    main(*sys.argv[1:])
