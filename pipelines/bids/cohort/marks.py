# SPDX-License-Identifier: GPL-3.0-or-later
"""What stage.sh says of each stage of a case: when it began and ended, an exit code, a sentence."""
import contextlib
import shutil
import tempfile
from pathlib import Path
from typing import NamedTuple


class Mark(NamedTuple):
    begin: float
    end: float
    code: int
    sentence: str


def read(folder, stage):
    """None where the stage has not ended, or the disk took no more of the mark."""
    try:
        begin, end, code, sentence = (folder / "marks" / stage).read_text(encoding="utf-8").split("\n")[:4]
        return Mark(float(begin), float(end), int(code), sentence)
    except (FileNotFoundError, ValueError):
        return None


def drop(folder, stages):
    """From the first stage on that failed, or whose files are gone: those are to be run again."""
    for place, stage in enumerate(stages):
        mark = read(folder, stage)
        if not mark or mark.code != 0 or not (folder / "run" / stage / "stage.json").exists():
            for later in stages[place:]:
                (folder / "marks" / later).unlink(missing_ok=True)
            return


@contextlib.contextmanager
def kept(folders):
    """The marks of cases, and what tells whether they hold, are afterwards what they were, whatever was done to them."""
    with tempfile.TemporaryDirectory() as place:
        copies = {folder: Path(place, str(i)) for i, folder in enumerate(folders) if (folder / "marks").is_dir()}
        for folder, copy in copies.items():
            shutil.copytree(folder / "marks", copy / "marks")
            for file in plan_files(folder):
                shutil.copy2(file, copy)
        try:
            yield
        finally:
            for folder, copy in copies.items():
                shutil.rmtree(folder / "marks", ignore_errors=True)
                shutil.copytree(copy / "marks", folder / "marks")
                for file in plan_files(copy):
                    shutil.copy2(file, folder)


def plan_files(folder):
    return [folder / name for name in ("case.sh", "scene.xml") if (folder / name).is_file()]


def is_newer(file, than):
    try:
        return file.stat().st_mtime_ns > than.stat().st_mtime_ns
    except FileNotFoundError:
        return False


def is_outdated(folder, stages):
    return is_newer(folder / "case.sh", folder / "marks" / stages[-1])


def has_failed(folder, stages):
    """Whether its own run, of its files and options as they are, ended without a result."""
    last = read(folder, stages[-1])
    return bool(last) and last.code != 0 and not is_outdated(folder, stages)


def fault(folder, stages):
    """Empty, or why a case has no result."""
    last = read(folder, stages[-1])
    if last and is_outdated(folder, stages):
        return "its files, its options or the program have changed since it was computed; the same command goes on"
    if last:
        return last.sentence or (f"ended with {last.code}" if last.code else "")
    begun = [stage for stage in stages if read(folder, stage)]
    return f"interrupted after {begun[-1]}; the same command goes on" if begun else "not run yet"
