#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""One rule's work: a case up to a stage, and a mark that says that it is whole or why not.

  stage.py CASE STAGE MARK THREADS PROGRAM     in the folder of work

It ends with 0 when the case itself is at fault, so that the engine goes on with the others; the stages after it then
pass the fault on.
"""
import fcntl
import json
import pathlib
import subprocess
import sys
import time

from cohort import program
from cohort.derivatives import publish, withdraw


def earlier_fault(case_folder, stage, stages):
    place = stages.index(stage)
    return json.loads((case_folder / "marks" / f"{stages[place - 1]}.json").read_text())["fault"] if place else None


def run(brainshift, case, folder, stage, threads, lock):
    """None, or the fault. Who was killed may have left a program that still works here: the lock waits for it."""
    try:
        scene = program.scene_of(brainshift, case, folder)
    except program.Refused as refused:
        return {"stage": "scene", "code": refused.code, "sentence": str(refused)}
    log = folder / "logs" / f"{stage}.log"
    log.parent.mkdir(exist_ok=True)
    with open(log, "w+", encoding="utf-8", errors="replace") as stream:
        done = subprocess.run([brainshift, "--quiet", "--threads", threads, "run", scene, "--out", str(folder / "run"),
                               "--until", stage, *program.set_options(case)],
                              stdout=stream, stderr=stream, pass_fds=(lock.fileno(),), check=False)
        stream.seek(0)
        said = stream.read()
    if done.returncode == 0:
        return None
    sentence = program.last_line(said) if done.returncode > 0 else f"{stage} was killed by signal {-done.returncode}"
    return {"stage": stage, "code": done.returncode, "sentence": sentence}


def main(name, stage, mark, threads, brainshift):
    folder = pathlib.Path(name).resolve()
    case = json.loads((folder / "case.json").read_text(encoding="utf-8"))
    begin, files = time.time(), []
    fault = earlier_fault(folder, stage, case["stages"])
    if not fault:
        with open(folder / "lock", "w", encoding="utf-8") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            begin = time.time()
            fault = run(brainshift, case, folder, stage, threads, lock)
    if stage == case["stages"][-1] and case["derivatives"]:
        files = withdraw(case) if fault else publish(case, folder)
    text = json.dumps({"begin": begin, "end": time.time(), "fault": fault, "files": files})
    pathlib.Path(mark).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main(*sys.argv[1:])
