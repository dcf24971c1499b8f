# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs cohorts of phantoms, disturbs them, and says what was kept; called by show.sh."""
import argparse
import hashlib
import os
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import time

sys.dont_write_bytecode = True
HERE = pathlib.Path(__file__).resolve().parent
APP = HERE.parents[1] / "pipelines/bids"
sys.path[:0] = [str(APP), str(HERE)]

import make_cohort  # noqa: E402
from cohort import marks, plan  # noqa: E402
from processes import end_orphans, kill_engine, kill_jobs, start, wait_for  # noqa: E402
from slurm import Slurm  # noqa: E402

OPTIONS = ("--set", "discretise.nodes=300", "--set", "segment.edge_length=11")
NOT_ALL = 4
BUSY, OVERHEAD, OPENS = 0.90, 1.0, 2.0  # share of the cores; s of a core a participant; s
STAMPED = {"stage.json", "run.json", "index.html"}  # hold the seconds that a stage took


class Show:
    def __init__(self, program, out):
        self.program, self.out = program, out
        self.lines, self.broken = [], 0

    def say(self, promise, kept, figure):
        self.broken += not kept
        self.lines.append(f"| {promise} | {'yes' if kept else '**no**'} | {figure} |")
        print(f"{'kept  ' if kept else 'BROKEN'} {promise}: {figure}", flush=True)

    def write(self, load):
        head = ["# Cohorts of phantoms", "", f"{len(os.sched_getaffinity(0))} cores; load of the machine at the begin "
                f"and the end {load:.1f} and {os.getloadavg()[0]:.1f}.", "", "| promise | kept | figure |",
                "| --- | --- | --- |"]
        (self.out / "show.md").write_text("\n".join(head + self.lines) + "\n", encoding="utf-8")

    def command(self, bids, out, *more):
        return [str(APP / "brainshift-bids"), str(bids), str(out), "participant", "--quiet", "--brainshift",
                str(self.program), *OPTIONS, *more]

    def cohort(self, name, participants, ways):
        make_cohort.main(self.program, str(self.out / name), participants, ways)
        return self.out / name


def fresh(folder):
    shutil.rmtree(folder, ignore_errors=True)
    return folder


def children_seconds():
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def measured(command):
    """Exit code, standard error, wall and processor seconds."""
    begin, used = time.monotonic(), children_seconds()
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stderr, time.monotonic() - begin, children_seconds() - used


def results(out):
    """SHA-256 of every file of every run that holds no times."""
    found = {}
    for folder in sorted((out / "work").glob("sub-*/run")):
        for file in folder.rglob("*"):
            if file.is_file() and file.name not in STAMPED:
                found[str(file.relative_to(out / "work"))] = hashlib.sha256(file.read_bytes()).digest()
    return found


def whole_stages(out):
    return {file: file.stat().st_ino for file in (out / "work").glob("sub-*/run/*/stage.json")}


def names_of(errors):
    return {line.split(":")[0] for line in errors.splitlines() if line.startswith("sub-")}


def busy_share(out, stages, cores):
    """Of the cores, from the first solve to the last, taken by a step that runs."""
    steps = [(mark.begin, mark.end) for folder in (out / "work").glob("sub-*") for stage in stages
             if (mark := marks.read(folder, stage))]
    solves = [(mark.begin, mark.end) for folder in (out / "work").glob("sub-*")
              if (mark := marks.read(folder, "solve" if "solve" in stages else "report")) and mark.code == 0]
    begin, end = min(s[0] for s in solves), max(s[1] for s in solves)
    taken = sum(max(0.0, min(stop, end) - max(start, begin)) for start, stop in steps)
    return taken / (cores * (end - begin))


def undisturbed(show, bids, participants, ways, more, label):
    out = fresh(show.out / f"out_{label}")
    code, errors, wall, used = measured(show.command(bids, out, *more))
    named = names_of(errors)
    show.say(f"{label}: {participants - ways} of {participants} done, {ways} named",
             code == (NOT_ALL if ways else 0) and len(named) == ways == len(errors.splitlines()),
             f"exit code {code}, {len(named)} named, {wall:.0f} s wall, {used:.0f} s of processors")
    return out, wall, used


def singles(show, out, sample):
    """The same scenes by brainshift run alone: the bytes, and what a participant takes of a processor and of time."""
    folders = [f.parent for f in sorted((out / "work").glob("sub-*/run/run.json"))]
    chosen = folders[::max(1, len(folders) // sample)]
    expected, same, used = results(out), True, 0.0
    for folder in (f.parent for f in chosen):
        single = fresh(show.out / "single")
        *_, processor = measured([show.program, "--quiet", "--threads", "1", "run", folder / "scene.xml", "--out", single,
                                  *OPTIONS])
        used += processor
        for file in single.rglob("*"):
            if file.is_file() and file.name not in STAMPED:
                name = str((folder / "run" / file.relative_to(single)).relative_to(out / "work"))
                same = same and expected.get(name) == hashlib.sha256(file.read_bytes()).digest()
    show.say("the bytes of single runs", same, f"{len(chosen)} runs")
    return used / len(chosen), len(folders)


def finish(show, command, out, whole, expected, what):
    """The same command again: all done, nothing whole made again, the same bytes."""
    for attempt in range(5):
        code, errors, wall, _ = measured(command)
        if code == 0:
            break
    after = whole_stages(out)
    again = sum(after.get(file) != number for file, number in whole.items())
    show.say(what, code == 0 and again == 0 and results(out) == expected,
             f"{len(whole)} stages were whole, {again} made again, the others in {wall:.0f} s, exit code {code}"
             + (f": {errors.strip()}" if code else ""))


def killed_runs(show, bids, more, expected, label, pause, slurm=None):
    out = fresh(show.out / f"out_killed_{label}")
    command = show.command(bids, out, *more)
    app = start(command)
    if slurm:
        wait_for(lambda: len(whole_stages(out)) >= 3)
        killed = slurm.kill_jobs(2)
    else:
        killed = kill_jobs(app.pid, 4, pause)
    wait_for(lambda: len(whole_stages(out)) >= 8 or app.poll() is not None)
    kill_engine(app)
    if slurm:
        slurm.restart_controller()
    whole = whole_stages(out)
    finish(show, command, out, whole, expected,
           f"{label}: {killed} jobs killed, then the engine{' and the controller of the queue' if slurm else ''}")


def full_disk(show, bids, expected):
    out = show.out / "out_full"
    out.mkdir(exist_ok=True)
    subprocess.run(["mount", "-t", "tmpfs", "-o", "size=8m", "tmpfs", out], check=True)
    try:
        command = show.command(bids, out)
        code, errors, _, _ = measured(command)
        show.say("a full disk is said", code in (1, NOT_ALL) and "Traceback" not in errors
                 and ("disk full" in errors or "No space left" in errors),
                 f"exit code {code}; {errors.strip().splitlines()[-1] if errors.strip() else ''}")
        whole = whole_stages(out)
        subprocess.run(["mount", "-o", "remount,size=2g", out], check=True)
        finish(show, command, out, whole, expected, "a full disk, then room")
    finally:
        subprocess.run(["umount", out], check=True)


def opens(show, page):
    """Above an empty page, each the quickest of three: a browser's start depends on what else the machine does."""
    browser = shutil.which("chromium") or shutil.which("google-chrome")
    if not browser:
        return
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"]
    environment = {**os.environ, "HOME": str(show.out / "home")}

    def opened(address):
        begin = time.monotonic()
        done = subprocess.run([*command, address], capture_output=True, text=True, check=False, env=environment)
        return time.monotonic() - begin, done.stdout.count("<tr") - 1

    empty = min(opened("about:blank")[0] for _ in range(3))
    seconds, rows = min(opened(page.as_uri()) for _ in range(3))
    show.say("the group's page opens in under 2 s", seconds - empty < OPENS and rows > 0,
             f"{max(0.0, seconds - empty):.1f} s above the browser's start of {empty:.1f} s, {rows} rows, "
             f"{page.stat().st_size / 1000:.0f} kB")


def on_this_machine(show, arguments, cores):
    bids = show.cohort("bids", arguments.participants, arguments.broken)
    stages = ("--jobs", str(cores))
    out, _, used = undisturbed(show, bids, arguments.participants, arguments.broken, stages, "local")
    single, done = singles(show, out, 10)
    share, above = busy_share(out, plan.STAGES, cores), (used - single * done) / done
    show.say("a job a stage: the cores are busy from the first solve to the last", share >= BUSY,
             f"{100 * share:.1f} %; a participant takes {above:.2f} s of a core above its run of {single:.2f} s")
    opens(show, out / "group.html")
    code, _, wall, _ = measured(show.command(bids, out, *stages))
    show.say("the same command again runs nothing but what failed", code == (NOT_ALL if arguments.broken else 0),
             f"{wall:.1f} s")
    return bids


def in_one_job(show, bids, arguments, cores):
    more = ("--one-job", "--jobs", str(cores))
    out, _, used = undisturbed(show, bids, arguments.participants, arguments.broken, more, "local, a job a participant")
    single, done = singles(show, out, 10)
    show.say("a job a participant: the cores are busy", (share := busy_share(out, ("report",), cores)) >= BUSY,
             f"{100 * share:.1f} %")
    above = (used - single * done) / done
    show.say("a job a participant: s of a core above its run", above <= OVERHEAD, f"{above:.2f} s; its run "
             f"{single:.2f} s")


def on_slurm(show, arguments, cores, faulted, expected):
    ways = min(arguments.broken, arguments.slurm // 2)
    bids = show.cohort("bids_slurm", arguments.slurm, ways)
    with Slurm(show.out / "slurm", cores) as slurm:
        more = ("--profile", str(slurm.profile(APP / "profiles/slurm")))
        shared = (*more, "--per-job", str(max(1, arguments.slurm // (4 * cores))))
        out, *_ = undisturbed(show, bids, arguments.slurm, ways, shared, "Slurm")
        singles(show, out, 3)
        share = busy_share(out, plan.STAGES, cores)
        show.say("Slurm: the cores are busy from the first solve to the last", share >= BUSY, f"{100 * share:.1f} %")
        killed_runs(show, faulted, more, expected, "Slurm", 1.0, slurm)
    end_orphans(show.out)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    for name, default in (("participants", 100), ("broken", 5), ("faulted", 10), ("slurm", 100)):
        parser.add_argument(f"--{name}", type=int, default=default)
    arguments = parser.parse_args()
    show = Show(arguments.program.resolve(), arguments.out.resolve())
    show.out.mkdir(parents=True, exist_ok=True)
    random.seed(1)
    cores, load = len(os.sched_getaffinity(0)), os.getloadavg()[0]
    try:
        if arguments.participants:
            bids = on_this_machine(show, arguments, cores)
            in_one_job(show, bids, arguments, cores)
        faulted = show.cohort("bids_faulted", arguments.faulted, 0)
        out, _, _ = undisturbed(show, faulted, arguments.faulted, 0, (), "local, whole")
        expected = results(out)
        killed_runs(show, faulted, (), expected, "local", 1.0)
        if os.geteuid() == 0:
            full_disk(show, faulted, expected)
        if os.geteuid() == 0 and arguments.slurm and shutil.which("slurmctld"):
            on_slurm(show, arguments, cores, faulted, expected)
    finally:
        show.write(load)
    return 1 if show.broken else 0


if __name__ == "__main__":
    sys.exit(main())
