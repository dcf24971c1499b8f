# SPDX-License-Identifier: GPL-3.0-or-later
"""The program brainshift."""
import os
import shutil
import subprocess


class Unusable(Exception):
    """A sentence: why nothing can be run."""


def find(given):
    found = shutil.which(given or os.environ.get("BRAINSHIFT") or "brainshift")
    if not found:
        raise Unusable(f"there is no program {given or 'brainshift'}; name it by --brainshift FILE")
    return os.path.abspath(found)


def version(program):
    done = subprocess.run([program, "--version"], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise Unusable(f"{program} does not start: {done.stderr.strip()}")
    return done.stdout.strip()
