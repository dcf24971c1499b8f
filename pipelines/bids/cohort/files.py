# SPDX-License-Identifier: GPL-3.0-or-later
"""Files that are whole or not there."""
import contextlib
import json
import os
import shutil
import socket


@contextlib.contextmanager
def replaced(target):
    """The file to write to, which then takes the target's place. Its name is this process's own: another call, on another
    machine too, may write the same target at the same time."""
    partial = target.with_name(f".{target.name}.{socket.gethostname()}.{os.getpid()}.partial")
    try:
        yield partial
        partial.replace(target)
    except OSError as fault:
        fault.filename = str(target)  # a full disk names none
        raise
    finally:
        partial.unlink(missing_ok=True)


def replace_text(target, text):
    """Names of files need not be UTF-8: their bytes stay what they are."""
    with replaced(target) as partial:
        partial.write_text(text, encoding="utf-8", errors="surrogateescape")


def as_json(value):
    return json.dumps(value, indent=2) + "\n"


def place(source, target):
    """A second name of the file where the file system can give one, else a copy; nothing where it is there already."""
    if target.exists() and alike(os.stat(source), os.stat(target)):
        return
    with replaced(target) as partial:
        try:
            os.link(source, partial)
        except OSError:
            shutil.copy2(source, partial)


def alike(one, other):
    return (one.st_size, one.st_mtime_ns) == (other.st_size, other.st_mtime_ns)
