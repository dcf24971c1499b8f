# SPDX-License-Identifier: GPL-3.0-or-later
"""The program brainshift."""
import os
import shutil
import subprocess
import sys


class Unusable(Exception):
    """A sentence: why nothing can be run."""


def exit_code(snakemake, without_result):
    """snakemake: its own exit code; without_result: those that have none."""
    return 1 if snakemake else 4 if without_result else 0


def closing(done, every, warned, place, told):
    """The last line. warned: how many of those done have warnings; told: where these are told."""
    if warned:
        return f"{done} of {every} done, {warned} of them with warnings: see {told}"
    return f"{done} of {every} done: {place}"


def guarded(name, main):
    """What main says is the exit code; of what cannot be run or written, a sentence."""
    try:
        return main()
    except Unusable as fault:
        print(f"{name}: {fault}", file=sys.stderr)
        return 2
    except OSError as fault:
        print(f"{name}: {fault.filename or 'a file'}: {fault.strerror}; see to that and give the same command again",
              file=sys.stderr)
        return 1


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
