# SPDX-License-Identifier: GPL-3.0-or-later
"""Whole runs of a scene with each preset, on one thread and on two: seconds and peak memory of each stage, from run.json.

usage: stages.py OUT.csv FOLDER BRAINSHIFT SCENE [PRESET,...]     (default: as the scene is, and every preset)
"""
import json
import os
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "peers"))
import timed  # noqa: E402

STAGES = ("segment", "discretise", "solve", "register", "report")


def run(folder, program, scene, preset, threads):
    out = f"{folder}/{preset}_{threads}"
    os.makedirs(folder, exist_ok=True)
    chosen = [] if preset == "default" else ["--preset", preset]
    took = timed.run([program, "--threads", str(threads), "run", scene, "--out", out, "--force", "--quiet", *chosen], threads,
                     f"{out}.log")
    if took.status != 0:
        raise RuntimeError(f"the run of {scene} failed, see {out}.log")
    with open(f"{out}/run.json") as file:
        stages = json.load(file)["stages"]
    solved = stages["solve"]
    row = {"preset": preset, "threads": threads, "nodes": solved["sizes"]["nodes"], "points": solved["sizes"]["integration_points"],
           "steps": solved["sizes"]["steps"], "seconds": took.seconds,
           # the program looks at the peak stage by stage, after which the system knows only that of the last
           "peak_mb": max(stages[name]["peak_memory_mb"] for name in STAGES)}
    for name in STAGES:
        row[f"{name}_s"] = stages[name]["seconds"]
        row[f"{name}_mb"] = stages[name]["peak_memory_mb"]
    return {**row, "stepping_s": solved["measures"]["seconds_stepping"],
            "fields_and_images_s": stages["register"]["measures"]["seconds_fields_and_images"]}


def main(out, folder, program, scene, presets="default,fast,balanced,accurate"):
    rows = []
    for preset in presets.split(","):
        for threads in (1, 2):
            rows.append(run(folder, program, scene, preset, threads))
            print(f"{preset}, {threads} threads: {rows[-1]['seconds']:.1f} s", flush=True)
            timed.write_rows(out, rows)


if __name__ == "__main__":
    main(*sys.argv[1:])
