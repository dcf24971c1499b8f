# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls Snakemake and tells how far it is."""
import fcntl
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

HOME = Path(__file__).resolve().parent.parent
STEPS = re.compile(r"^(\d+) of (\d+) steps")


class Unusable(Exception):
    """A sentence: why nothing can be run."""


def take_lock(work):
    """Held until this process and Snakemake have ended, in whatever way."""
    work.mkdir(parents=True, exist_ok=True)
    lock = open(work / "lock", "a", encoding="utf-8")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise Unusable(f"{work}: another run works in this folder; wait for it or end it") from None
    return lock


def find_program(given):
    found = shutil.which(given or os.environ.get("BRAINSHIFT") or "brainshift")
    if not found:
        raise Unusable(f"there is no program {given or 'brainshift'}; name it by --brainshift FILE")
    return os.path.abspath(found)


def profile_folder(name):
    folder = HOME / "profiles" / name
    return str(folder if folder.is_dir() else Path(name).resolve())


def memory_mb():
    """What this machine has free."""
    with open("/proc/meminfo", encoding="ascii") as stream:
        fields = dict(line.split(":", 1) for line in stream)
    return int(fields["MemAvailable"].split()[0]) // 1024


def snakemake(work, profile, jobs, mem_mb, dry_run, more):
    if not shutil.which("snakemake"):
        raise Unusable("Snakemake is not installed; on Debian: apt-get install snakemake")
    words = ["snakemake", "--snakefile", str(HOME / "Snakefile"), "--directory", str(work), "--configfile",
             str(work / "plan.json"), "--profile", profile_folder(profile), "--nolock", "--rerun-incomplete",
             "--keep-going", "--rerun-triggers", "mtime"]
    words += ["--jobs", str(jobs)] if jobs else []
    words += ["--resources", f"mem_mb={mem_mb}"] if mem_mb else []
    return words + (["--dry-run"] if dry_run else []) + more


def run(words, work, lock, tell):
    """Snakemake's exit code. What it prints goes to work/snakemake.log."""
    begin, log = time.monotonic(), work / "snakemake.log"
    environment = {**os.environ, "XDG_CACHE_HOME": str(work / ".cache"), "PYTHONDONTWRITEBYTECODE": "1"}
    child = subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                             pass_fds=(lock.fileno(),), env=environment)
    for number in (signal.SIGINT, signal.SIGTERM):  # Snakemake ends its jobs, and then this loop
        signal.signal(number, lambda number, _: child.send_signal(number))
    with open(log, "w", encoding="utf-8") as stream:
        for line in child.stdout:
            stream.write(line)
            stream.flush()
            if step := STEPS.match(line):
                tell(int(step[1]), int(step[2]), time.monotonic() - begin)
    return child.wait()


class Progress:
    """A line with the time left: over itself on a terminal, else one at each tenth."""

    def __init__(self, quiet):
        self.quiet, self.tenth = quiet, -1
        self.terminal = sys.stderr.isatty()

    def __call__(self, done, all_steps, seconds):
        tenth = 10 * done // all_steps
        if self.quiet or (not self.terminal and tenth == self.tenth):
            return
        self.tenth = tenth
        left = duration(seconds * (all_steps - done) / max(done - 1, 1))
        end = "\n" if not self.terminal or done == all_steps else ""
        start = "\r\033[K" if self.terminal else ""
        print(f"{start}{done} of {all_steps} steps, about {left} left", end=end, file=sys.stderr, flush=True)


def duration(seconds):
    minutes = round(seconds / 60)
    if minutes < 1:
        return f"{round(seconds)} s"
    return f"{minutes} min" if minutes < 120 else f"{minutes / 60:.1f} h"
