#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What our files include of each other, held against the layout of the house.

  python3 tests/structure/includes.py [ROOT]     exit 1 and one line a fault where a rule is broken
  python3 tests/structure/includes.py --tree HEADER     our headers behind one header

Rules: stages include those below them alone, and the ground floor (sub-folders of segmentation/) no stage; folders do
not include each other in a circle, nor do units (a header and the source beside it); rooms of solve/ stand on the ones
listed before them; a program that includes solve/solve.hpp gets few of our headers.
"""
import re
import sys
from collections import defaultdict
from pathlib import Path

STAGES = ["segmentation", "discretise", "solve", "register", "pipelines"]
GROUND = ["segmentation/progress", "segmentation/options", "segmentation/geometry", "segmentation/files", "segmentation/image"]
SOLVE_ROOMS = [
    "solve/" + room
    for room in (
        "arrays", "material", "interface", "load", "shape", "quadrature", "boundary", "force", "body", "measured", "dynamics",
        "device", "ensemble", "device/each", "cut", "output", "run", "update", "region", "uncertainty",
    )
] + ["solve"]
MOST_HEADERS_OF_SOLVE = 15
INCLUDE = re.compile(r'^\s*#\s*include\s+"([^"]+)"', re.MULTILINE)
OTHERWISE = re.compile(r'^\s*#\s*include\s+(?:<((?:' + "|".join(STAGES) + r')/[^>]+)>|"([^"]*\.\./[^"]*)")', re.MULTILINE)


def read_includes(root):
    """{file: [files of ours that it includes]}, all relative to the root."""
    files = [p for stage in STAGES for p in (root / stage).rglob("*") if p.suffix in (".hpp", ".cpp", ".cu", ".cuh")]
    return {
        str(p.relative_to(root)): [i for i in INCLUDE.findall(p.read_text()) if (root / i).is_file()] for p in files
    }


def circles(graph):
    """Strongly connected components of more than one node, by Tarjan's algorithm."""
    index, low, stack, on_stack, found = {}, {}, [], set(), []

    def visit(node):
        index[node] = low[node] = len(index)
        stack.append(node)
        on_stack.add(node)
        for other in graph.get(node, ()):
            if other not in index:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in on_stack:
                low[node] = min(low[node], index[other])
        if low[node] == index[node]:
            component = set()
            while node not in component:
                component.add(stack.pop())
            on_stack.difference_update(component)
            if len(component) > 1:
                found.append(sorted(component))

    for node in graph:
        if node not in index:
            visit(node)
    return found


def grouped(includes, group):
    """The graph of groups: group(file) for each file, without arrows of a group to itself."""
    graph = defaultdict(set)
    for file, others in includes.items():
        graph[group(file)].update(group(other) for other in others if group(other) != group(file))
    return graph


def folder(file):
    return str(Path(file).parent)


def unit(file):
    return str(Path(file).with_suffix(""))


def reached(includes, start):
    seen, todo = set(), [start]
    while todo:
        for other in includes[todo.pop()]:
            if other not in seen:
                seen.add(other)
                todo.append(other)
    return sorted(seen)


def arrows_up(includes, floors, name_of):
    """Includes of a later floor by an earlier one; files on no floor count for nothing."""
    place = {floor: i for i, floor in enumerate(floors)}
    for file, others in sorted(includes.items()):
        for other in others:
            here, there = place.get(name_of(file)), place.get(name_of(other))
            if here is not None and there is not None and there > here:
                yield f"{file} includes {other}, which stands above it"


def faults(root):
    includes = read_includes(root)
    for file in includes:
        for names in OTHERWISE.findall((root / file).read_text()):
            yield f"{file} includes {''.join(names)}: a file of ours is named from the root, in quotes"
    yield from arrows_up(includes, STAGES, lambda f: f.split("/")[0])
    yield from arrows_up(includes, SOLVE_ROOMS, folder)
    for file, others in sorted(includes.items()):
        if folder(file) in GROUND:
            for other in others:
                if folder(other) not in GROUND[: GROUND.index(folder(file)) + 1]:
                    yield f"{file} is of the ground floor and includes {other}"
    for circle in circles(grouped(includes, folder)):
        yield "folders include each other in a circle: " + ", ".join(circle)
    for circle in circles(grouped(includes, unit)):
        yield "files include each other in a circle: " + ", ".join(circle)
    for room in {folder(f) for f in includes if f.startswith("solve/")} - set(SOLVE_ROOMS):
        yield f"{room} is not in the list of solve's rooms"
    behind = reached(includes, "solve/solve.hpp")
    if len(behind) > MOST_HEADERS_OF_SOLVE:
        yield f"solve/solve.hpp brings {len(behind)} of our headers, at most {MOST_HEADERS_OF_SOLVE} are wanted"


def main(arguments):
    root = Path(__file__).resolve().parents[2]
    if arguments[:1] == ["--tree"]:
        print("\n".join(reached(read_includes(root), arguments[1])))
        return 0
    found = list(faults(Path(arguments[0]).resolve() if arguments else root))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
