# SPDX-License-Identifier: GPL-3.0-or-later
"""What the module Brain Shift does without a window: it knows files, texts and processes, and nothing of Slicer."""
import os
import queue
import re
import shutil
import tempfile
import threading
from html import unescape
from pathlib import Path
from xml.etree import ElementTree

PROGRESS = re.compile(r"<filter-progress>([^<]*)</filter-progress>")
COMMENT = re.compile(r"<filter-comment>([^<]*)</filter-comment>")
ROWS = (
    ("largest displacement", "solve", "largest_displacement_mm", "mm"),
    ("estimated error of the computation, 95 %", "solve", "estimated_error_95_mm", "mm"),
    ("bound of the remaining error", "solve", "error_bound_mm", "mm"),
    ("least local volume ratio", "solve", "smallest_jacobian", ""),
    ("folded voxels", "register", "folded_voxels", ""),
    ("there and back, 99.9 %", "register", "inverse_999_mm", "mm"),
)


def command_of(setting, module_folder):
    """The words that start the module: by the setting, beside the module, or on the PATH. Raises ValueError."""
    beside = Path(module_folder) / "BrainShift"
    found = setting or (str(beside) if os.access(beside, os.X_OK) else shutil.which("brainshift"))
    if not found:
        raise ValueError("brainshift was not found: name its program under Program")
    if not os.path.isfile(found) or not os.access(found, os.X_OK):
        raise ValueError(f"{found} is no program that can be started; choose brainshift under Program")
    return [found] if Path(found).name == "BrainShift" else [found, "slicer"]


def parameter(module_folder, flag):
    """Choices, default and description of an option, by the description of the command-line module."""
    for element in ElementTree.parse(Path(module_folder) / "BrainShift.xml").iter():
        if element.findtext("longflag") == flag:
            choices = [choice.text for choice in element.findall("element")]
            return {"choices": choices, **{key: element.findtext(key, "") for key in ("default", "description")}}
    raise KeyError(flag)


def arguments_of(command, inputs, run, options):
    """The command line: inputs and options by their flags; what is empty is left out."""
    given = {**inputs, **options, "run": run}
    return command + [word for flag, value in given.items() if str(value) for word in (f"--{flag}", str(value))]


def missing_input(nodes):
    """The sentence about the first of t1, labels, before and after that is not chosen; else empty."""
    wanted = {"t1": "a T1", "labels": "a segmentation", "before": "points before", "after": "points after"}
    return next((f"Choose {what}." for name, what in wanted.items() if not nodes.get(name)), "")


def read_line(line):
    """(fraction, comment, text for the log) of a line of output; None where it holds none."""
    fractions, comments = PROGRESS.findall(line), COMMENT.findall(line)
    text = None if line.startswith("<filter-") else line.strip() or None
    return float(fractions[-1]) if fractions else None, unescape(comments[-1]) if comments else None, text


class RunFolder:
    """Where a run lies: in the folder that was chosen, or in a temporary one."""

    def __init__(self, chosen, temporary):
        self.is_temporary = not chosen
        self.path = Path(chosen or tempfile.mkdtemp(dir=temporary)).resolve()

    def drop(self):
        """Removes a temporary folder; what was chosen stays."""
        if self.is_temporary:
            shutil.rmtree(self.path, ignore_errors=True)


class Runner:
    """A started process, whose lines are collected beside the window's own thread."""

    def __init__(self, process):
        self.process = process
        self.lines = queue.Queue()
        self.cancelled = False
        self.reader = threading.Thread(target=self._read, daemon=True)
        self.reader.start()

    def _read(self):
        with self.process.stdout as lines:
            lines.reconfigure(errors="replace")  # a path may hold any bytes
            for line in lines:
                self.lines.put(line)
        self.process.wait()

    def new_lines(self):
        lines = []
        while not self.lines.empty():
            lines.append(self.lines.get())
        return lines

    def ended(self):
        """Whether it has ended and all of its lines are there."""
        return not self.reader.is_alive()

    def cancel(self):
        """It removes what it was writing, and ends."""
        self.cancelled = True
        self.process.terminate()


def failure_of(record):
    """Why the computation of a run.json is not whole; else empty."""
    return next((stage["failure"] for stage in record.get("stages", {}).values() if stage.get("failure")), "")


def quality_table(record):
    """[(what, value, unit)] of a run.json, then its failures and warnings."""
    stages = record.get("stages", {})
    rows = []
    for what, stage, measure, unit in ROWS:
        value = stages.get(stage, {}).get("measures", {}).get(measure)
        if value is not None:
            rows.append((what, f"{value:.3g}", unit))
    for name, stage in stages.items():
        notes = [note for note in stage.get("notes", []) if note.startswith("warning")]
        rows += [(name, text, "") for text in [*filter(None, [stage.get("failure")]), *notes]]
    return rows
