# SPDX-License-Identifier: GPL-3.0-or-later
"""Calls Snakemake and tells how far it is."""
import argparse
import contextlib
import fcntl
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

from . import limits, marks, plan, program

STEPS = re.compile(r"^(\d+) of (\d+) steps")
WHOLE = ("report",)  # the run to its end in one rule


class SayVersion(argparse.Action):
    """The version is the program's: it is asked only where somebody wants to know."""

    def __call__(self, parser, options, *_):
        print(program.version(program.find(options.brainshift)).replace("brainshift", parser.prog, 1))
        parser.exit()


def positive(text):
    """A whole number from 1 on."""
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"{text} is not a whole number from 1 on")
    return int(text)


def parser_of(about):
    """about: the command's documentation, which holds its usage."""
    return argparse.ArgumentParser(description=about, usage=argparse.SUPPRESS,
                                   formatter_class=argparse.RawDescriptionHelpFormatter)


def add_options(parser):
    parser.add_argument("--jobs", "--n-cpus", "--n_cpus", type=positive, metavar="N",
                        help="cores of this machine, or jobs at a time in a cluster's queue")
    parser.add_argument("--mem-mb", "--mem_mb", type=positive, metavar="MB", help="memory of this machine for all jobs")
    parser.add_argument("--threads", type=positive, metavar="N", help="of each job; the results do not depend on it")
    parser.add_argument("--profile", default="local", metavar="NAME",
                        help="local, slurm or a folder with Snakemake's config.yaml (%(default)s)")
    parser.add_argument("--one-job", action="store_true",
                        help="all stages of a case in one job, not a job a stage: faster where heads are small")
    parser.add_argument("--per-job", type=positive, default=1, metavar="N",
                        help="cases that share a job of a cluster's queue (%(default)s)")
    parser.add_argument("--share-samples", type=positive, default=1, metavar="N",
                        help="the samples of <uncertainty> in N jobs of a case, which follow no other (%(default)s)")
    parser.add_argument("--dry-run", action="store_true", help="say what would be run, and stop")
    parser.add_argument("--quiet", action="store_true", help="no progress")
    parser.add_argument("--set", action="append", default=[], metavar="PATH=VALUE",
                        help="an option of all scenes, as discretise.nodes=6000 or solve.command='my_own {in} {out}'")
    parser.add_argument("--brainshift", metavar="FILE", help="the program, if it is not on the path")
    parser.add_argument("--version", "-v", action=SayVersion, nargs=0, help="say the program's version, and stop")
    parser.add_argument("--work-dir", "-w", type=Path, metavar="DIR", help="for the runs; OUT/work if absent")
    parser.add_argument("--snakemake", action="append", default=[], metavar="WORD",
                        help="a further word to Snakemake, as --snakemake=--printshellcmds")


def stages_of(options):
    return WHOLE if options.one_job else plan.STAGES


def work_folder(options):
    return (options.work_dir or options.out / "work").resolve()


def compute(options, cases, version, call="all"):
    """Runs the cases, as far as they are not whole; Snakemake's exit code. Calls of other names may run beside it."""
    work = work_folder(options)
    own = work / ".engine" / call
    brainshift = program.find(options.brainshift)
    profile = profile_folder(options.profile)
    if not shutil.which("snakemake"):
        raise program.Unusable("Snakemake is not installed; on Debian: apt-get install snakemake")
    with take_lock(own) as lock:
        local = options.profile == "local"
        cores = (options.jobs if local else None) or limits.processors()
        threads = options.threads or (max(1, cores // max(len(cases), 1)) if local else 1)
        folders = [work / case.name for case in cases]
        with marks.kept(folders) if options.dry_run else contextlib.nullcontext():
            plan.write(own, work, cases, stages_of(options), brainshift, version, threads, cores, options.share_samples)
            place = on_this_machine(options, cores) if local else in_queue(options, threads)
            command = words(own, profile, options.dry_run) + place + options.snakemake
            code = run(command, own, lock, Progress(options.quiet or options.dry_run))
    if options.dry_run:
        print((own / "snakemake.log").read_text(encoding="utf-8"), end="")
    elif code != 0:
        print(f"Snakemake ended with {code}; {own}/snakemake.log says why; the same command goes on", file=sys.stderr)
    return code


def take_lock(own):
    """Held until this process and Snakemake have ended, in whatever way."""
    own.mkdir(parents=True, exist_ok=True)
    lock = open(own / "lock", "a", encoding="utf-8")
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise program.Unusable(f"{own}: the same command is at work here already; wait for it or end it") from None
    return lock


def profile_folder(name):
    for folder in (plan.HOME / "profiles" / name, Path(name).resolve()):
        if (folder / "config.yaml").is_file():
            return str(folder)
    raise program.Unusable(f"--profile {name}: local, slurm or a folder with a config.yaml of Snakemake is wanted")


def words(own, profile, dry_run):
    return ["snakemake", "--snakefile", str(plan.HOME / "Snakefile"), "--directory", str(own), "--configfile",
            str(own / "plan.json"), "--profile", profile, "--nolock", "--rerun-incomplete", "--keep-going",
            "--rerun-triggers", "mtime"] + (["--dry-run"] if dry_run else [])


def on_this_machine(options, cores):
    return ["--jobs", str(cores), "--resources", f"mem_mb={options.mem_mb or limits.free_memory_mb()}"]


def in_queue(options, threads):
    """The cores are those of one job: cases that share it follow one another."""
    jobs = ["--jobs", str(options.jobs)] if options.jobs else []
    return jobs + ["--cores", str(threads), "--group-components", f"case={options.per_job}"]


@contextlib.contextmanager
def signals_passed_to(child):
    """To Snakemake and its jobs, which then end; so does who waits for them."""
    numbers = (signal.SIGHUP, signal.SIGINT, signal.SIGTERM)
    before = [signal.signal(number, lambda number, _: os.killpg(child.pid, number)) for number in numbers]
    try:
        yield
    finally:
        for number, handler in zip(numbers, before):
            signal.signal(number, handler)


def run(command, own, lock, tell):
    """Snakemake's exit code. What it prints goes to snakemake.log."""
    begin = time.monotonic()
    environment = {**os.environ, "XDG_CACHE_HOME": str(own / ".cache")}
    child = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace",
                             pass_fds=(lock.fileno(),), env=environment, start_new_session=True)
    with signals_passed_to(child), open(own / "snakemake.log", "wb", buffering=0) as stream:
        for line in child.stdout:
            with contextlib.suppress(OSError):  # a full disk; Snakemake is not left alone for it
                stream.write(line.encode())
            if step := STEPS.match(line):
                tell(int(step[1]), int(step[2]), time.monotonic() - begin)
        return child.wait()


class Progress:
    """A line with the time left: over itself on a terminal, else one at each tenth."""

    def __init__(self, quiet):
        self.quiet, self.tenth, self.terminal = quiet, 0, sys.stderr.isatty()

    def __call__(self, done, every, seconds):
        tenth = 10 * done // every
        if self.quiet or (not self.terminal and tenth == self.tenth):
            return
        self.tenth = tenth
        text = f"{done} of {every} steps, about {duration(seconds * (every - done) / done)} left"
        if self.terminal:
            print(f"\r\033[K{text}", end="\n" if done == every else "", file=sys.stderr, flush=True)
        else:
            print(text, file=sys.stderr, flush=True)


def duration(seconds):
    if seconds < 90:
        return f"{round(seconds)} s"
    return f"{round(seconds / 60)} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"
