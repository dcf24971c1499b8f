# SPDX-License-Identifier: GPL-3.0-or-later
"""What is to be run: a folder a case with its case.sh, which stage.sh reads, and plan.json, which Snakemake reads.

case.sh is written anew only where the case's options, its files or the program have changed; all that Snakemake has to
know is that it is newer than the marks. So a file that was replaced by an older one counts, too.
"""
import concurrent.futures
import gzip
import hashlib
import json
import os
import re
import shlex
import struct
import subprocess
import xml.etree.ElementTree as tree
import zlib
from pathlib import Path
from typing import NamedTuple

from . import marks
from .files import replace_text

HOME = Path(__file__).resolve().parent.parent
STAGES = ("segment", "discretise", "solve", "register", "report")
# scene --explain says no less than a stage holds. Snakemake runs beside it in a job of a queue: planning 1,000
# participants takes it 141 MB.
SPARE_MB = 200
UNKNOWN_MB = 2000  # of another program in a stage, and where the scene cannot be explained: its run will say why
OF_MEMORY = ("image.", "discretise.", "solve.points_per_cell", "solve.basis", "solve.dilatation")
COST = re.compile(r"^  (\w+): .*about (\d+) MB$", re.MULTILINE)


class Case(NamedTuple):
    """A scene's file, or the words of `scene --new` that make one; the options of --set; the files it is made from."""
    name: str
    scene: str
    words: list
    options: list
    inputs: list


def write_case(work, case, version):
    folder = work / case.name
    folder.mkdir(parents=True, exist_ok=True)
    states = [(os.stat(file), file) for given in case.inputs for file in files_in(given)]
    lines = [f"# {version}", *(f"# {s.st_size} {s.st_mtime_ns} {json.dumps(file)}" for s, file in states),
             f"scene={shlex.quote(case.scene)}", f"files=({shlex.join(case.words)})",
             f"options=({shlex.join(set_words(case))})"]
    text = "\n".join(lines) + "\n"
    file = folder / "case.sh"
    if not file.exists() or file.read_text(encoding="utf-8", errors="surrogateescape") != text:
        replace_text(file, text)


def files_in(given):
    """The file itself, or the folder's files."""
    if os.path.isdir(given):
        return sorted(entry.path for entry in os.scandir(given) if entry.is_file())
    return [given] if os.path.exists(given) else []


def why_outdated(record, case, scene):
    """Empty where a run was made of the case's files as they are now; else a sentence. record: its run.json; scene: its
    scene, which names files of the case alone. What --set gave besides, or in the place of one, is of no case."""
    elements = tree.parse(scene).iter() if scene.exists() else ()
    named = {value for element in elements for value in element.attrib.values()}
    made_of = {given["path"]: given["sha256"] for given in record["inputs"]}
    sums = {file: hashlib.sha256(Path(file).read_bytes()).hexdigest() for file in case.inputs if os.path.isfile(file)}
    gone = [file for file in made_of if file in named - sums.keys() and made_of[file] not in sums.values()]
    if gone:
        return f"it was computed with {gone[0]}, which is no longer among its files; give the level participant again"
    replaced = named - made_of.keys()
    if any(sums[file] not in made_of.values() for file in sums.keys() - replaced):
        return "its files have changed since it was computed; give the level participant again"
    return ""


def set_words(case):
    return [word for option in case.options for word in ("--set", option)]


def scene_inputs(scene):
    """The scene's own file and those that it names."""
    scene = Path(scene)
    named = [(f"{element.tag}.{name}", value) for element in tree.parse(scene).iter()
             for name, value in element.attrib.items()]
    return [str(scene)] + files_named(named, scene.parent)


def option_inputs(options, folder):
    """Files that options PATH=VALUE name, from the scene's folder on."""
    return files_named([option.partition("=")[::2] for option in options], Path(folder))


def files_named(named, folder):
    """Of pairs of an option's path and value, those values that are files; an image may be a folder of slices."""
    return [str(folder / value) for path, value in named
            if value and len(value) < 4096 and not path.endswith(".command")
            and (os.path.isfile(folder / value) or path.startswith("image.") and os.path.isdir(folder / value))]


def grid(file):
    """Voxels along each axis, by the header of a NIfTI or FreeSurfer image; empty of another, or a damaged one."""
    try:
        with (gzip.open if file.endswith("z") else open)(file, "rb") as stream:
            head = stream.read(48)
        if file.endswith((".mgz", ".mgh")):
            return struct.unpack(">3i", head[4:16])
        order = "<" if head[:4] == struct.pack("<i", 348) else ">"
        return struct.unpack(order + "3h", head[42:48])
    except (OSError, EOFError, struct.error, zlib.error):
        return ()


def kind(case):
    """Cases of the same kind need the same memory: one of them is asked about."""
    images = [grid(file) for file in case.inputs if file.endswith((".nii", ".nii.gz", ".mgz", ".mgh"))]
    options = [o for o in case.options if o.startswith(OF_MEMORY) or o.partition("=")[0].endswith(".command")]
    return json.dumps([case.scene, images, options])


def explained(program, work, case):
    """MB of each stage, or nothing where the scene is at fault: its run will say so."""
    subprocess.run([HOME / "stage.sh", program, work / case.name, "1", "scene"], check=False)
    scene = case.scene or str(work / case.name / "scene.xml")
    done = subprocess.run([program, "scene", "--explain", scene, *set_words(case)], capture_output=True, text=True,
                          check=False)
    return {stage: int(mb) + SPARE_MB for stage, mb in COST.findall(done.stdout)} if done.returncode == 0 else {}


def memory(program, work, cases, workers):
    """By case: MB of each stage. The first of a kind that can be explained speaks for the others."""
    kinds = {}
    for case in cases:
        kinds.setdefault(kind(case), []).append(case)

    def of_kind(alike):
        return next((mb for case in alike if (mb := explained(program, work, case))), {})

    with concurrent.futures.ThreadPoolExecutor(workers) as pool:
        costs = list(pool.map(of_kind, kinds.values()))
    return {case.name: cost for alike, cost in zip(kinds.values(), costs) for case in alike}


def needs(cost, stages):
    every = {stage: cost.get(stage, UNKNOWN_MB) for stage in STAGES}
    return every if len(stages) == len(STAGES) else {stages[-1]: max(every.values()), "solve": every["solve"]}


def has_samples(case):
    """Whether its scene asks how far the answer may be off, or an option does."""
    return (any(option.startswith("uncertainty.") for option in case.options)
            or bool(case.scene) and tree.parse(case.scene).find("uncertainty") is not None)


def write(own, work, cases, stages, program, version, threads, cores, shares=1):
    for case in cases:
        write_case(work, case, version)
        marks.drop(work / case.name, stages)
    costs = memory(program, work, cases, cores)
    replace_text(own / "plan.json", json.dumps({
        "work": str(work), "program": program, "threads": threads, "stages": stages,
        "shares": {case.name: [f"{share}_of_{shares}" for share in range(1, shares + 1)]
                   for case in cases if shares > 1 and has_samples(case)},
        "cases": {case.name: needs(costs[case.name], stages) for case in cases}}))
