# SPDX-License-Identifier: GPL-3.0-or-later
"""Processes of a cohort that is at work: starts, finds, waits for and kills them."""
import contextlib
import os
import pathlib
import random
import signal
import subprocess
import time


def start(command):
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def descendants(process):
    """Of a process, the deepest last."""
    found, queue = [], [process]
    while queue:
        children = pathlib.Path(f"/proc/{queue.pop(0)}/task").glob("*/children")
        with contextlib.suppress(OSError):  # it may end while it is looked at
            new = [int(number) for file in children for number in file.read_text().split()]
            found += new
            queue += new
    return found


def name_of(process):
    with contextlib.suppress(OSError):
        return pathlib.Path(f"/proc/{process}/comm").read_text().strip()
    return ""


def kill_jobs(process, times, pause):
    """Kills a job's shell or its brainshift at random, some times; how many were killed."""
    killed = 0
    for _ in range(times):
        time.sleep(pause)
        jobs = [p for p in descendants(process) if name_of(p) in ("stage.sh", "brainshift")]
        if jobs:
            with contextlib.suppress(ProcessLookupError):
                os.kill(random.choice(jobs), signal.SIGKILL)
                killed += 1
    return killed


def kill_engine(app):
    """The command and Snakemake at once, as a lost login does; the jobs on this machine live on as orphans."""
    engine = [p for p in descendants(app.pid) if name_of(p) == "snakemake"]
    for process in (app.pid, *engine):
        with contextlib.suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    app.wait()


def wait_for(condition, seconds=300):
    end = time.monotonic() + seconds
    while not condition() and time.monotonic() < end:
        time.sleep(0.05)


def end_orphans(folder):
    """The Snakemake of a job that was killed: this Slurm has no control groups, and loses it."""
    for process in pathlib.Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):
            words = (process / "cmdline").read_text().split("\0")
            if "snakemake" in words and any(word.startswith(str(folder)) for word in words):
                os.kill(int(process.name), signal.SIGKILL)
