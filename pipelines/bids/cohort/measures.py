# SPDX-License-Identifier: GPL-3.0-or-later
"""The measures of runs as one table, and which of its rows lie far from the others."""
import csv
import io
import json
import statistics

COLUMNS = {  # name: where it stands in run.json, what it is, its unit
    "largest_shift_mm": ("register.measures.largest_displacement_mm", "Largest displacement over the voxels", "mm"),
    "smallest_jacobian": ("solve.measures.smallest_jacobian", "Smallest volume ratio at an integration point", ""),
    "folded_voxels": ("register.measures.folded_voxels", "Voxels where the forward map turns inside out", ""),
    "not_inverted": ("register.measures.not_inverted", "Voxels whose inversion missed its tolerance", ""),
    "inverse_999_mm": ("register.measures.inverse_999_mm", "Forward, then back: 99.9 % of the brain", "mm"),
    "penetration_mm": ("solve.measures.largest_penetration_mm", "Deepest penetration of the skull", "mm"),
    "error_95_mm": ("solve.measures.estimated_error_95_mm", "Estimated error for want of nodes, 95 %", "mm"),
    "surface_distance_95_mm": ("segment.measures.brain.boundary_distance_95_mm",
                               "95 % of the brain's surface lie nearer to the labels' boundary", "mm"),
    "brain_mm3": ("segment.measures.brain.volume_mm3", "Volume of the brain", "mm3"),
    "nodes": ("discretise.sizes.nodes", "Nodes of the cloud", ""),
    "steps": ("solve.sizes.steps", "Steps to the end state", ""),
}
COSTS = {
    "seconds": ("Wall time of all stages", "s"),
    "peak_memory_mb": ("Most memory that a stage held", "MiB"),
}
WARNINGS = {
    "warnings": ("Warnings that the stages of the run gave", ""),
    "first_warning": ("The first of them; the run's page has all", ""),
}
MARK = "warning:"  # begins a note that warns
FAR = 3.5  # median absolute deviations, scaled to standard deviations: Iglewicz and Hoaglin's


def record_of(run):
    return json.loads((run / "run.json").read_text(encoding="utf-8"))


def looked_up(stages, path):
    value = stages
    for key in path.split("."):
        value = value.get(key) if isinstance(value, dict) else None
    return value


def row_of(record):
    stages = record["stages"]
    row = {name: looked_up(stages, path) for name, (path, _, _) in COLUMNS.items()}
    row["seconds"] = sum(stage.get("seconds", 0) for stage in stages.values())
    row["peak_memory_mb"] = max(stage.get("peak_memory_mb", 0) for stage in stages.values())
    warnings = warnings_of(stages)
    row["warnings"] = len(warnings)
    row["first_warning"] = warnings[0] if warnings else None
    return row


def warnings_of(stages):
    """In the order of the stages, without their mark."""
    notes = [note for stage in stages.values() for note in stage.get("notes", [])]
    return [note[len(MARK):].strip() for note in notes if note.startswith(MARK)]


def far_columns(rows):
    """For each row the measures in which it lies far from the others, with how far."""
    far = [{} for _ in rows]
    for name in COLUMNS:
        values = [row.get(name) for row in rows]
        known = [value for value in values if isinstance(value, (int, float))]
        if len(known) < 4:
            continue
        middle = statistics.median(known)
        deviation = 1.4826 * statistics.median(abs(value - middle) for value in known)
        # Where most are alike to the last digit, one in a thousand of their size is taken for different.
        deviation = max(deviation, 1e-3 * abs(middle) / FAR, 1e-9)
        for row, value in zip(far, values):
            if isinstance(value, (int, float)) and abs(value - middle) > FAR * deviation:
                row[name] = abs(value - middle) / deviation
    return far


def doubtful_first(rows, far):
    """Indices: those without a result, then those with warnings; of each those that lie farthest out, then by name."""
    return sorted(range(len(rows)),
                  key=lambda i: (rows[i]["status"] == "done", not rows[i].get("warnings"),
                                 -max(far[i].values(), default=0), rows[i]["name"]))


def written(value):
    if value is None or value == "":
        return "n/a"
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def as_table(rows, columns):
    stream = io.StringIO()
    table = csv.writer(stream, delimiter="\t", lineterminator="\n")
    table.writerow(columns)
    table.writerows([written(row.get(column)) for column in columns] for row in rows)
    return stream.getvalue()


def described(others):
    """The sidecar of the table; others: of the columns that are no measures."""
    units = {name: (text, unit) for name, (_, text, unit) in COLUMNS.items()} | COSTS | WARNINGS
    return others | {name: {"Description": text, **({"Units": unit} if unit else {})}
                     for name, (text, unit) in units.items()}
