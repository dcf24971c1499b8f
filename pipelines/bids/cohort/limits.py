# SPDX-License-Identifier: GPL-3.0-or-later
"""What this machine, and the container or queue that this process is in, leave it."""
import math
import os
from pathlib import Path

MOUNT = Path("/sys/fs/cgroup")


def groups(controller, own=Path("/proc/self/cgroup"), mount=MOUNT):
    """The folders of the control groups that this process is in, of both versions, from its own up."""
    try:
        lines = own.read_text(encoding="utf-8").splitlines()
    except OSError:
        return
    for line in lines:
        _, names, path = line.split(":", 2)
        if not names or controller in names.split(","):
            top = mount / controller if names else mount
            place = top / path.lstrip("/")
            yield from (folder for folder in (place, *place.parents) if folder.is_relative_to(top))


def numbers_in(file):
    """None where there is no such file; infinity for "max"."""
    try:
        return [math.inf if word == "max" else float(word) for word in file.read_text(encoding="ascii").split()]
    except (OSError, ValueError):
        return None


def memory_limit_mb(**where):
    bytes_allowed = [found[0] for folder in groups("memory", **where) for name in ("memory.max", "memory.limit_in_bytes")
                     if (found := numbers_in(folder / name))]
    return min(bytes_allowed, default=math.inf) / 2**20


def processor_quota(**where):
    quotas = []
    for folder in groups("cpu", **where):
        both = numbers_in(folder / "cpu.max")
        if not both:
            both = (numbers_in(folder / "cpu.cfs_quota_us") or []) + (numbers_in(folder / "cpu.cfs_period_us") or [])
        if len(both) == 2 and both[0] > 0:  # -1: none
            quotas.append(both[0] / both[1])
    return min(quotas, default=math.inf)


def free_memory_mb():
    with open("/proc/meminfo", encoding="ascii") as stream:
        fields = dict(line.split(":", 1) for line in stream)
    return int(min(int(fields["MemAvailable"].split()[0]) / 1024, memory_limit_mb()))


def processors():
    given, quota = len(os.sched_getaffinity(0)), processor_quota()
    return given if math.isinf(quota) else max(1, min(given, math.ceil(quota)))
