#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The pages of the repository, held against what is there.

  python3 tests/structure/pages.py [ROOT]     exit 1 and one line a fault where a rule is broken

Rules: lines are at most 120 characters long; the first README has at most 120 lines and that of a stage 60; links
lead to files; a source file or a room that a page names is there; the equations of solve/METHOD.md are numbered in
order, and one that the code cites is there.
"""
import re
import sys
from pathlib import Path

STAGES = ["segmentation", "discretise", "solve", "register", "pipelines"]
FOLDERS = STAGES + ["tests"]
LONGEST_LINE = 120
MOST_LINES = {"README.md": 120, **{f"{stage}/README.md": 60 for stage in STAGES}}
LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
CODE = re.compile(r"`([^`\n]+)`")
SOURCE = re.compile(r"^[\w./-]*\.(?:hpp|cpp|py|sh|cmake)$")
PATH = re.compile(r"(?<![\w./-])((?:" + "|".join(FOLDERS) + r")/[\w./-]*\.\w+)")
EQUATION = re.compile(r"\((\d+)\)$")
CITATION = re.compile(r"METHOD\.md \((\d+)\)")


def pages(root):
    found = list(root.glob("*.md")) + [page for folder in FOLDERS for page in (root / folder).rglob("*.md")]
    return sorted(found)


def split(text):
    """The numbered lines of a page outside its fenced blocks, and those inside."""
    outside, inside, fenced = [], [], False
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            fenced = not fenced
        else:
            (inside if fenced else outside).append((number, line))
    return outside, inside


def whole(lines):
    """The lines as one text, in which a link may run over an end of line, and the number of the line at a place."""
    text = "\n".join(line for _, line in lines)
    return text, lambda place: lines[text.count("\n", 0, place)][0]


def is_there(name, page, root, known):
    """A bare name may be any source file's; a path starts at the root or at the page."""
    if "/" not in name:
        return name in known
    return any((base / name).exists() for base in (root, page.parent))


def faults_of(page, root, known):
    text = page.read_text()
    name = str(page.relative_to(root))
    lines = text.splitlines()
    for number, line in enumerate(lines, 1):
        if len(line) > LONGEST_LINE:
            yield f"{name}:{number}: {len(line)} characters; at most {LONGEST_LINE} are wanted"
    if len(lines) > MOST_LINES.get(name, len(lines)):
        yield f"{name}: {len(lines)} lines; at most {MOST_LINES[name]} are wanted"
    outside, inside = split(text)
    prose, number_at = whole(outside)
    for match in LINK.finditer(prose):
        target = match[1].split("#")[0]
        if target and "://" not in target and not (page.parent / target).exists():
            yield f"{name}:{number_at(match.start())}: the link to {match[1]} leads nowhere"
    for match in CODE.finditer(prose):
        for word in match[1].split():
            if SOURCE.match(word) and not is_there(word, page, root, known):
                yield f"{name}:{number_at(match.start())}: there is no {word}"
    for number, line in inside:
        for match in PATH.finditer(line):
            if not (root / match[1]).exists():
                yield f"{name}:{number}: there is no {match[1]}"
    yield from missing_rooms(name, page, outside)


def missing_rooms(name, page, lines):
    """The first column of a table of folders."""
    table = False
    for number, line in lines:
        table = line.startswith("| folder |") or (table and line.startswith("|"))
        if table:
            for room in CODE.findall(line.split("|")[1]):
                if not (page.parent / room).is_dir():
                    yield f"{name}:{number}: there is no folder {room}"


def missing_equations(root):
    method = root / "solve" / "METHOD.md"
    displayed = [line for line in method.read_text().splitlines() if line.startswith("    ")]
    numbers = [int(match[1]) for line in displayed if (match := EQUATION.search(line))]
    if numbers != list(range(1, len(numbers) + 1)):
        yield f"solve/METHOD.md: the equations are numbered {numbers}"
    for folder in FOLDERS:
        for file in sorted((root / folder).rglob("*.?pp")):
            for number in CITATION.findall(file.read_text()):
                if int(number) not in numbers:
                    yield f"{file.relative_to(root)}: METHOD.md has no equation ({number})"


def faults(root):
    known = {p.name for folder in FOLDERS for p in (root / folder).rglob("*") if SOURCE.match(p.name)}
    for page in pages(root):
        yield from faults_of(page, root, known)
    yield from missing_equations(root)


def main(arguments):
    found = list(faults(Path(arguments[0]).resolve() if arguments else Path(__file__).resolve().parents[2]))
    for fault in found:
        print(fault)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
