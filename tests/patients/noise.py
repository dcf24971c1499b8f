# SPDX-License-Identifier: GPL-3.0-or-later
"""How far off a load with noise leaves the brain, beside the same points imposed exactly; called by noise.sh.

The truth is the head's solution with all measured points and no noise. Of these points some are given, spread evenly
or by chance, with noise that is drawn. Each processor takes a row of the table by itself.
"""
import concurrent.futures
import copy
import os
import pathlib
import shutil
import subprocess
import sys

import numpy as np

from patients import numbers, rows_of, write_load
from phantoms import ALIKE, XYZ, phantom_scene, places_in, write_landmarks
from predictors import spread_out

DRAWS = 10
CELLS = [(points, noise) for points in (10, 20, 40) for noise in (0.3, 0.5, 1.0)]
DEMO_CELLS = [(20, 0.5)]


class Head:
    """A scene whose load is replaced, and what its whole load without noise moves."""

    def __init__(self, program, folder, scene, load, measured, places):
        self.program, self.folder, self.scene, self.load = program, folder, scene, load
        self.measured, self.places = measured, places
        self.truth = self.moved(measured)

    def write(self, given, attributes=""):
        """A scene with this load, of these attributes."""
        write_load(self.folder / "given.csv", given[:, :3], given[:, 3:])
        text = self.scene.replace(self.load, f'<load {attributes}><craniotomy file="given.csv"/></load>')
        (self.folder / "given.xml").write_text(text)
        return self.folder / "given.xml"

    def moved(self, given, attributes=""):
        """Displacement at the landmarks, mm."""
        return solved(self.program, self.write(given, attributes), self.folder / "run")

    def error(self, given, attributes=""):
        """Of 95 % of the brain, mm."""
        return np.quantile(np.linalg.norm(self.moved(given, attributes) - self.truth, axis=1), 0.95)

    def beside(self, name):
        """The same in a folder of its own."""
        other = copy.copy(self)
        other.folder = self.folder.with_name(name)
        shutil.rmtree(other.folder, ignore_errors=True)
        shutil.copytree(self.folder, other.folder)
        return other


def solved(program, scene, out):
    subprocess.run([program, "run", "-q", str(scene), "--out", str(out), "--until", "register"], check=True,
                   stderr=subprocess.DEVNULL)
    return numbers(rows_of(out / "register" / "landmarks.csv"), ("ux", "uy", "uz"))


def between(text, first, last):
    begin = text.index(first)
    return text[begin:text.index(last, begin) + len(last)]


def phantom(program, folder, random):
    scene, measured = phantom_scene(program, folder, 2500)
    places = places_in(folder / "labels.nii.gz", random)
    write_landmarks(folder / "landmarks.fcsv", places)
    return Head(program, folder, scene, between(scene, "<load>", "</load>"), measured, places)


def demo(program, folder, random, scene_file):
    folder.mkdir(exist_ok=True)
    scene = scene_file.read_text().replace('nodes="12000"', f'nodes="12000" {ALIKE}')
    (folder / "demo.xml").write_text(scene)
    subprocess.run([program, "run", "-q", str(folder / "demo.xml"), "--out", str(folder / "whole"), "--until", "solve"],
                   check=True, stderr=subprocess.DEVNULL)
    places = places_in(folder / "whole" / "segment" / "labels.nii.gz", random)
    write_landmarks(folder / "landmarks.fcsv", places)
    scene = scene.replace("<contact/>", '<contact/><landmarks file="landmarks.fcsv"/>')
    measured = numbers(rows_of(folder / "whole" / "solve" / "load.csv"), XYZ)
    return Head(program, folder, scene, between(scene, "<load>", "</load>"), measured, places)


def chosen(places, points, evenly, random):
    if not evenly:
        return random.choice(len(places), points, replace=False)
    first = random.integers(len(places))
    return (np.array(spread_out(np.roll(places, -first, axis=0), points)) + first) % len(places)


def row(name, head, points, noise, evenly):
    """Of the table: means over the draws."""
    random = np.random.default_rng([points, round(10 * noise), evenly])
    how = "spread evenly" if evenly else "by chance"
    head = head.beside(f"{name}, {points} {how}, {noise} mm")
    errors = []
    for _ in range(DRAWS):
        given = head.measured[chosen(head.measured[:, :3], points, evenly, random)]
        given[:, 3:] += noise * random.standard_normal((points, 3))
        errors.append((head.error(given), head.error(given, f'noise="{noise}"')))
    shutil.rmtree(head.folder)
    exact, weighed = np.mean(errors, axis=0)
    return f"| {name} | {points}, {how} | {noise} | {exact:.3f} | {weighed:.3f} | {weighed / exact:.2f} |"


def main(program, out, scene):
    out.mkdir(parents=True, exist_ok=True)
    random = np.random.default_rng(1)
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    heads = [("phantom", phantom(program, out / "phantom", random), CELLS)]
    if scene.is_file():
        heads.append(("demo", demo(program, out / "demo", random, scene), DEMO_CELLS))
    rows = [(name, head, *cell, evenly) for name, head, cells in heads for cell in cells for evenly in (True, False)]
    lines = ["| head | points | noise, mm | imposed exactly, mm | weighed, mm | ratio |", "|" + " --- |" * 6]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as processors:
        for line in processors.map(lambda cell: row(*cell), rows):
            lines.append(line)
            print(line, flush=True)
    (out / "noise.md").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main(sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3]))
