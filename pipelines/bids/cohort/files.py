# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are whole or not there."""
import json
import os
import shutil


def replace_text(target, text):
    partial = target.with_name(f".{target.name}.partial")
    try:
        partial.write_text(text, encoding="utf-8")
    except OSError as fault:
        fault.filename = str(target)  # a full disk names none
        raise
    partial.replace(target)


def as_json(value):
    return json.dumps(value, indent=2) + "\n"


def place(source, target):
    """A second name of the file where the file system can give one, else a copy; nothing where it is there already."""
    if target.exists() and alike(os.stat(source), os.stat(target)):
        return
    partial = target.with_name(f".{target.name}.partial")
    partial.unlink(missing_ok=True)
    try:
        os.link(source, partial)
    except OSError:
        shutil.copy2(source, partial)
    partial.replace(target)


def alike(one, other):
    return (one.st_size, one.st_mtime_ns) == (other.st_size, other.st_mtime_ns)
