#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""How long `brainshift live` takes from a load file's change to its transforms.

  live.py PROGRAM RUN --out DIR [--updates 1000] [--most 1.0] [--device cuda]

RUN is a finished run whose load lies in RUN/solve/load.csv. Each update changes its displacements by up to MOST mm:
deeper or shallower, tilted, and sideways, each by chance. DIR gets latency.csv (number, seconds, resident MB),
latency.svg and, on standard output, median, 99 % and largest. The answers in RUN/live are removed on the way.
"""
import argparse
import math
import os
import pathlib
import random
import shutil
import subprocess
import time

PATIENCE = 60  # s, for an answer


def read_load(file):
    lines = [line for line in file.read_text().splitlines() if line and not line.startswith("#")]
    return [[float(number) for number in line.split(",")[:6]] for line in lines[1:]]


def changed(rows, most, chance):
    """Three gentle changes that fade to the rim as the displacement does; the largest is `most` or less."""
    lengths = [math.hypot(*row[3:]) for row in rows]
    centre = [sum(row[axis] for row in rows) / len(rows) for axis in range(3)]
    reach = max(math.dist(row[:3], centre) for row in rows)
    shift, tilt = ([chance.gauss(0, 1) for _ in range(3)] for _ in range(2))
    vectors = []
    for row, length in zip(rows, lengths):
        lever = sum((row[axis] - centre[axis]) * tilt[axis] for axis in range(3)) / reach
        vectors.append([length / max(lengths) * (shift[axis] + lever * row[3 + axis] / length if length else 0)
                        for axis in range(3)])
    size = most * chance.random() / max(math.hypot(*vector) for vector in vectors)
    return [row[:3] + [row[3 + axis] + size * vector[axis] for axis in range(3)] for row, vector in zip(rows, vectors)]


def write_load(file, rows):
    part = file.with_suffix(".part")
    part.write_text("# frame: LPS\nx,y,z,ux,uy,uz\n" + "".join(",".join(map(repr, row)) + "\n" for row in rows))
    os.rename(part, file)


def resident_megabytes(process):
    for line in pathlib.Path(f"/proc/{process}/status").read_text().splitlines():
        if line.startswith("VmRSS:"):
            return int(line.split()[1]) / 1024
    raise RuntimeError("no VmRSS")


def wait_for(folder, live):
    deadline = time.monotonic() + PATIENCE
    while not folder.exists():
        if live.poll() is not None or time.monotonic() > deadline:
            raise SystemExit(f"no {folder}: the program has ended, or took more than {PATIENCE} s")
        time.sleep(0.001)


def part_of(values, share):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(share * len(ordered)))]


def svg(seconds):
    """A dot an update; lines at the median and 99 %."""
    width, height, edge = 800, 320, 40
    top = 1.1 * max(seconds)
    x = lambda i: edge + (width - 2 * edge) * i / max(1, len(seconds) - 1)
    y = lambda s: height - edge - (height - 2 * edge) * s / top
    parts = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" font-family="sans-serif" '
             f'font-size="12"><rect width="{width}" height="{height}" fill="white"/>']
    parts += [f'<circle cx="{x(i):.1f}" cy="{y(s):.1f}" r="1.5" fill="#1f77b4"/>' for i, s in enumerate(seconds)]
    for name, value in (("median", part_of(seconds, 0.5)), ("99 %", part_of(seconds, 0.99))):
        parts.append(f'<line x1="{edge}" x2="{width - edge}" y1="{y(value):.1f}" y2="{y(value):.1f}" stroke="#d62728"/>'
                     f'<text x="{edge + 4}" y="{y(value) - 4:.1f}">{name}: {value:.3f} s</text>')
    parts.append(f'<text x="{edge}" y="{height - 12}">update 1 to {len(seconds)}; seconds from 0 to {top:.2f}</text>')
    return "\n".join(parts) + "\n</svg>\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("run", type=pathlib.Path)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--updates", type=int, default=1000)
    parser.add_argument("--most", type=float, default=1.0)
    parser.add_argument("--device", help="as of the program")
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    rows, chance = read_load(arguments.run / "solve" / "load.csv"), random.Random(1)
    load, answers = arguments.out / "load.csv", arguments.run / "live"
    load.unlink(missing_ok=True)
    shutil.rmtree(answers, ignore_errors=True)
    measured = []
    command = [arguments.program, "live", arguments.run, "--load", load]
    command += ["--device", arguments.device] if arguments.device else []
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True) as live:
        live.stdout.readline()  # it watches
        for number in range(1, arguments.updates + 1):
            write_load(load, changed(rows, arguments.most, chance))
            begin = time.monotonic()
            wait_for(answers / f"{number:06}", live)
            measured.append((number, time.monotonic() - begin, resident_megabytes(live.pid)))
            live.stdout.readline()
            shutil.rmtree(answers / f"{number - 1:06}", ignore_errors=True)
        live.terminate()
    seconds = [row[1] for row in measured]
    (arguments.out / "latency.csv").write_text(
        "update,seconds,resident_mb\n" + "".join(f"{n},{s:.4f},{m:.1f}\n" for n, s, m in measured))
    (arguments.out / "latency.svg").write_text(svg(seconds))
    early = measured[min(len(measured) - 1, len(measured) // 10)][2]
    print(f"{len(seconds)} updates: median {part_of(seconds, 0.5):.3f} s, 99 % {part_of(seconds, 0.99):.3f} s, "
          f"largest {max(seconds):.3f} s; resident after a tenth {early:.0f} MB, at the end {measured[-1][2]:.0f} MB")


if __name__ == "__main__":
    main()
