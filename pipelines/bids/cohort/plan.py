# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be run: a folder a case with its case.json, and plan.json, which Snakemake reads.

case.json is written anew only where the case's options, its files or the program have changed; all that Snakemake has to
know is that it is newer than the marks. So a file that was replaced by an older one counts, too.
"""
import concurrent.futures
import gzip
import json
import os
import re
import struct
import xml.etree.ElementTree as tree
from pathlib import Path

from . import program
from .derivatives import as_json, replace_text

STAGES = ("segment", "discretise", "solve", "register", "report")
WHOLE = ("report",)
# scene --explain estimates what a stage's own arrays take. Measured on a real head and on phantoms, a stage held up to
# 3.1 times as much while that was small, and 1.8 times while it was large: twice the estimate and this covers both.
SPARE_MB = 200
UNKNOWN_MB = 2000  # of another program in a stage, and where the scene cannot be explained: its run will say why
COST = re.compile(r"^  (\w+): .*about (\d+) MB$", re.MULTILINE)


def write_case(work, case, inputs):
    """True where it is new or has changed."""
    folder = work / case["name"]
    folder.mkdir(parents=True, exist_ok=True)
    states = {file: [(state := os.stat(file)).st_size, state.st_mtime_ns] for file in inputs if os.path.exists(file)}
    text = as_json({**case, "inputs": states})
    file = folder / "case.json"
    if file.exists() and file.read_text(encoding="utf-8") == text:
        return False
    replace_text(file, text)
    return True


def drop_marks(folder, stages):
    """From the first stage on that failed, or whose files are gone: those are to be run again."""
    gone = False
    for stage in stages:
        mark = folder / "marks" / f"{stage}.json"
        gone = gone or not mark.exists() or not whole(mark, folder / "run" / stage / "stage.json")
        if gone:
            mark.unlink(missing_ok=True)


def whole(mark, stage_file):
    try:
        said = json.loads(mark.read_text(encoding="utf-8"))
    except ValueError:
        return False
    return not said["fault"] and stage_file.exists() and all(os.path.exists(file) for file in said["files"])


def scene_inputs(scene):
    """The scene's own file and those that it names."""
    scene = Path(scene)
    named = [scene.parent / value for element in tree.parse(scene).iter() for value in element.attrib.values()]
    return [str(scene)] + [str(file) for file in named if file.is_file()]


def grid(file):
    """Voxels along each axis, by the header of a NIfTI or FreeSurfer image; empty where it cannot be read."""
    try:
        with (gzip.open if file.endswith("z") else open)(file, "rb") as stream:
            head = stream.read(348)
        if file.endswith((".mgz", ".mgh")):
            return struct.unpack(">3i", head[4:16])
        order = "<" if struct.unpack("<i", head[:4])[0] == 348 else ">"
        return struct.unpack(order + "3h", head[42:48])
    except (OSError, EOFError, struct.error):
        return ()


def size_key(case):
    """Cases with the same key need the same memory: one of them is asked about."""
    options = [o for o in case["set"] if o.startswith(("discretise.", "solve.", "image."))
               or o.partition("=")[0].endswith(".command")]
    images = [grid(file) for file in (case.get("t1"), case.get("labels"), case.get("brain_mask")) if file]
    return json.dumps([case.get("scene"), images, options])


def explained(brainshift, work, case):
    """MB of each stage, or nothing where the scene is at fault."""
    try:
        scene = program.scene_of(brainshift, case, work / case["name"])
        text = program.ask(brainshift, "scene", "--explain", scene, *program.set_options(case))
    except program.Refused:
        return {}
    return {stage: 2 * int(mb) + SPARE_MB for stage, mb in COST.findall(text)}


def memory(brainshift, work, cases, workers):
    """By case: MB of each stage. The first of a kind that can be explained speaks for the others."""
    kinds = {}
    for case in cases:
        kinds.setdefault(size_key(case), []).append(case)

    def of_kind(kind):
        return next((mb for case in kind if (mb := explained(brainshift, work, case))), {})

    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        costs = list(pool.map(of_kind, kinds.values()))
    return {case["name"]: cost for kind, cost in zip(kinds.values(), costs) for case in kind}


def needs(cost, stages):
    every = {stage: cost.get(stage, UNKNOWN_MB) for stage in STAGES}
    return every if tuple(stages) == STAGES else {stages[-1]: max(every.values())}


def write_plan(work, cases, stages, brainshift, threads, cores):
    costs = memory(brainshift, work, cases, cores)
    plan = {"program": brainshift, "threads": threads, "stages": stages,
            "cases": {case["name"]: needs(costs[case["name"]], stages) for case in cases}}
    replace_text(work / "plan.json", json.dumps(plan))
    return plan
