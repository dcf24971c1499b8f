# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls of the program brainshift."""
import subprocess

NAMED_FILES = ("t1", "labels", "labels_are", "brain_mask", "tumour")


class Refused(Exception):
    """The program's sentence and its exit code."""

    def __init__(self, sentence, code):
        super().__init__(sentence)
        self.code = code


def ask(program, *words):
    """What it prints."""
    done = subprocess.run([program, *words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Refused(last_line(done.stderr), done.returncode)
    return done.stdout


def last_line(text):
    lines = [line for line in text.splitlines() if line.strip()]
    return lines[-1] if lines else "the program ended without a word"


def set_options(case):
    return [word for option in case["set"] for word in ("--set", option)]


def scene_of(program, case, folder):
    """The scene's file: the one that is given, or one made of the files at hand, newer than the case."""
    if case.get("scene"):
        return case["scene"]
    file = folder / "scene.xml"
    if not file.exists() or file.stat().st_mtime_ns < (folder / "case.json").stat().st_mtime_ns:
        words = [word for name in NAMED_FILES if case[name] for word in ("--" + name.replace("_", "-"), case[name])]
        text = ask(program, "--quiet", "scene", "--new", *words, "--points", *case["points"])
        partial = file.with_suffix(".partial")
        partial.write_text(text, encoding="utf-8")
        partial.replace(file)
    return str(file)
