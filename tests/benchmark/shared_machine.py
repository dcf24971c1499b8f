#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The program beside other busy processes and under limits: how much longer it takes than its share explains.

  shared_machine.py PROGRAM OUT.csv [--nodes N...] [--voxels MM] [--repeats N] [--beside N...] [--against PROGRAM]
                    [--spinning] [--priority 19 0] [--no-limits] [--no-stages] [--quick]

Real processes compete (sha256sum on an endless file), at the lowest and at normal priority; the limits are one
processor by taskset, and half a processor and one and a half by a control group, where one can be made. What a
processor gives here and now is counted by loops that wait for nobody, one and as many as there are processors. Of a
part that runs on one thread the share is that of one loop, of a part on all threads that of all: from the seconds and
the processor seconds alone follows how long each part is. The ratio is seconds over those that the shares explain;
alone it is 1. Each repetition goes through all situations; medians count. "before" is the build of --against,
"spinning" the same program with threads that wait as OpenMP has them by default.
"""
import argparse
import csv
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from dataclasses import dataclass, field
from pathlib import Path

LOOP = """
import sys, time
end = float(sys.argv[1])
count = 0
while time.monotonic() < end:
    for _ in range(2000):
        pass
    count += 1
print(count)
"""
SPINNING = {"GOMP_SPINCOUNT": "300000"}  # libgomp's own where OMP_WAIT_POLICY is not set


@dataclass
class Situation:
    name: str
    beside: int = 0
    nice: int = 0
    quota: float = 0  # processors' time; 0: no limit
    processors: int = 0  # by taskset; 0: all


class Group:
    """A control group with a quota of processors' time, of either version; made and removed with root's rights alone."""

    def __init__(self, quota):
        self.folder = None
        for root in ("/sys/fs/cgroup/cpu", "/sys/fs/cgroup/cpu,cpuacct", "/sys/fs/cgroup"):
            folder = Path(root) / f"brainshift-benchmark-{os.getpid()}"
            try:
                folder.mkdir()
            except OSError:
                continue
            self.folder = folder
            try:
                if (folder / "cpu.cfs_quota_us").exists():
                    (folder / "cpu.cfs_quota_us").write_text(str(int(quota * 100000)))
                else:
                    (folder / "cpu.max").write_text(f"{int(quota * 100000)} 100000")
                return
            except OSError:
                self.remove()

    def enter(self):
        (self.folder / "cgroup.procs").write_text(str(os.getpid()))

    def remove(self):
        if self.folder:
            self.folder.rmdir()
        self.folder = None


@dataclass
class Place:
    """Where the program and the loops run: in a group, on some processors."""
    group: Group = None
    processors: int = 0

    def enter(self):
        if self.group:
            self.group.enter()
        if self.processors:
            os.sched_setaffinity(0, sorted(os.sched_getaffinity(0))[:self.processors])


@dataclass
class Took:
    seconds: list = field(default_factory=list)
    processor: list = field(default_factory=list)

    def median(self):
        return statistics.median(self.seconds), statistics.median(self.processor)


def run(command, place, environment):
    """Seconds and processor seconds; ends the program where it fails."""
    begin = time.monotonic()
    process = subprocess.Popen([str(c) for c in command], env={**os.environ, **environment}, preexec_fn=place.enter,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    said = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if os.waitstatus_to_exitcode(status) not in (0, 3):
        sys.exit(f"{' '.join(map(str, command))}: {said}")
    return time.monotonic() - begin, usage.ru_utime + usage.ru_stime


def loops(count, place, seconds):
    """Turns a second of so many loops together."""
    end = time.monotonic() + 0.1 + seconds
    started = [subprocess.Popen([sys.executable, "-S", "-E", "-c", LOOP, str(end)], preexec_fn=place.enter,
                                stdout=subprocess.PIPE) for _ in range(count)]
    return max(1, sum(int(process.communicate()[0]) for process in started)) / seconds


def compete(situation):
    def lowered():
        os.nice(situation.nice)
    return [subprocess.Popen(["sha256sum", "/dev/zero"], preexec_fn=lowered, stdout=subprocess.DEVNULL)
            for _ in range(situation.beside)]


def jobs(program, folder, options):
    """Name and command of what is timed, on the phantom; {} is the program."""
    head, common = folder / "head", ["--quiet"]
    quiet = Place()
    small = ["--size", 40] if options.quick else []
    run([program, "phantom", *small, "--spacing", options.voxels, "--out", head], quiet, {})
    segment = ["segment", *common, "--t1", head / "t1.nii.gz", "--labels", head / "labels.nii.gz", "--brain-labels", 1, 2,
               3, *(["--edge-length", 14] if options.quick else []), "--out", folder / "segment"]
    run([program, *segment], quiet, {})
    found = []
    for nodes in options.nodes:
        cloud, solved = folder / f"cloud{nodes}", folder / f"solve{nodes}"
        run([program, "discretise", *common, "--surface", folder / "segment/brain.vtp", "--labels",
             head / "labels.nii.gz", "--nodes", nodes, "--out", cloud], quiet, {})
        solve = ["solve", *common, "--nodes", cloud / "nodes.vtu", "--cells", cloud / "cells.vtu", "--labels",
                 head / "labels.nii.gz", "--surface", folder / "segment/brain.vtp", "--load", head / "craniotomy.csv",
                 "--material=1:brain", "--material=2:ventricle", "--material=3:tumour",
                 *(["--tolerance", 0.5] if options.quick else []), "--out", solved]
        found.append((f"solve, {nodes:,} nodes", solve))
    if options.no_stages:
        return found
    run([program, *found[0][1]], quiet, {})
    found.append((f"segment, {options.voxels:g} mm", segment))
    found.append((f"register, {options.voxels:g} mm",
                  ["register", *common, "--solution", folder / f"solve{options.nodes[0]}/solution.vtu", "--brain",
                   folder / "segment/brain.vtp", "--t1", head / "t1.nii.gz", "--labels", head / "labels.nii.gz",
                   *(["--fade", 30] if options.quick else []), "--out", folder / "register"]))
    return found


def situations(options):
    all_of_them = [Situation("alone")]
    for nice in options.priority:
        all_of_them += [Situation(f"beside {n}, nice {nice}", beside=n, nice=nice) for n in options.beside]
    if options.no_limits:
        return all_of_them
    all_of_them.append(Situation("one processor (taskset)", processors=1))
    all_of_them += [Situation(f"{quota:g} processors' quota", quota=quota) for quota in (0.5, 1.5)]
    return all_of_them


def measure(situation, timed, variants, threads, took, rates, seconds):
    group = Group(situation.quota) if situation.quota else None
    if group and not group.folder:
        return
    place = Place(group, situation.processors)
    competitors = compete(situation)
    try:
        for count in {1, threads}:
            rates.setdefault((situation.name, count), []).append(loops(count, place, seconds))
        for job, command in timed:
            for variant, (program, environment) in variants.items():
                wall, processor = run([program, *command], place, environment)
                kept = took.setdefault((situation.name, job, variant), Took())
                kept.seconds.append(wall)
                kept.processor.append(processor)
                print(f"{situation.name}; {job}; {variant}: {wall:.2f} s, {processor:.2f} of processors", file=sys.stderr,
                      flush=True)
    finally:
        for process in competitors:
            process.kill()
            process.wait()
        if group:
            group.remove()


def explained(situation, alone, rates, threads):
    """Seconds that the shares explain. alone: seconds and processor seconds of the program alone."""
    seconds, processor = alone
    together = min(seconds, max(0.0, (processor - seconds) / max(1, threads - 1)))

    def slower(count):
        return statistics.median(rates["alone", count]) / statistics.median(rates[situation, count])
    return (seconds - together) * slower(1) + together * slower(threads)


def table(took, rates, variants, threads):
    rows = []
    for (situation, job, variant), kept in took.items():
        # How much of it runs on one thread is not to be seen where threads spin.
        alone, spent = took["alone", job, variant].median()[0], took["alone", job, "now"].median()
        seconds = kept.median()[0]
        due = explained(situation, (alone, alone * spent[1] / spent[0]), rates, threads)
        rows.append({"situation": situation, "job": job, "variant": variant, "seconds": round(seconds, 3),
                     "processor": round(kept.median()[1], 3), "explained": round(due, 3), "ratio": round(seconds / due, 2)})
    lines = ["| situation | what | " + " | ".join(f"{v}, s | ratio" for v in variants) + " |",
             "|" + " --- |" * (2 + 2 * len(variants))]
    for situation, job in dict.fromkeys((r["situation"], r["job"]) for r in rows):
        cells = [f"{r['seconds']:.2f} | {r['ratio']:.2f}" for v in variants for r in rows
                 if (r["situation"], r["job"], r["variant"]) == (situation, job, v)]
        lines.append(f"| {situation} | {job} | " + " | ".join(cells) + " |")
    return rows, "\n".join(lines)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("out", type=Path)
    parser.add_argument("--nodes", type=int, nargs="+", default=[1000, 10000, 100000])
    parser.add_argument("--voxels", type=float, default=1.5, metavar="MM")
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--beside", type=int, nargs="+", default=[1, 2, 4])
    parser.add_argument("--against", type=Path, help="another build, timed in the same run as 'before'")
    parser.add_argument("--spinning", action="store_true", help="the program with spinning threads, too")
    parser.add_argument("--priority", type=int, nargs="+", default=[19, 0], metavar="NICE", help="of the processes beside")
    parser.add_argument("--no-limits", action="store_true", help="without taskset and control groups")
    parser.add_argument("--no-stages", action="store_true", help="without segment and register")
    parser.add_argument("--quick", action="store_true", help="a small head and short loops: only that all of it runs")
    options = parser.parse_args()
    if options.quick:
        options.nodes, options.voxels, options.repeats, options.beside = [150], 6, 1, [1]
    program = options.program.resolve()
    variants = {"now": (program, {})}
    if options.against:
        variants["before"] = (options.against.resolve(), {})
    if options.spinning:
        variants["spinning"] = (program, SPINNING)
    threads = len(os.sched_getaffinity(0))
    took, rates = {}, {}
    scratch = Path(tempfile.mkdtemp())
    try:
        timed = jobs(program, scratch, options)
        for _ in range(options.repeats):
            for situation in situations(options):
                measure(situation, timed, variants, threads, took, rates, 0.3 if options.quick else 1)
    finally:
        shutil.rmtree(scratch)
    rows, text = table(took, rates, variants, threads)
    with open(options.out, "w", newline="") as file:
        writer = csv.DictWriter(file, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    print(f"{threads} processors, load before {os.getloadavg()[2]:.1f}\n\n{text}")


if __name__ == "__main__":
    main()
