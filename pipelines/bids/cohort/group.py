# SPDX-License-Identifier: GPL-3.0-or-later
"""The group level: one table, its sidecar and one page of all cases, doubtful ones first."""
from . import measures, pages
from .files import as_json, replace_text

TABLE = "group_measures.tsv"
PAGE = "group.html"
OTHERS = {
    "name": {"Description": "Participant and session"},
    "status": {"Description": "Whether there is a result", "Levels": {"done": "yes", "no result": "no"}},
    "sentence": {"Description": "Why there is no result"},
    "outlier_in": {"Description": f"Measures more than {measures.FAR} robust standard deviations from the median"},
}


def write(out, done, sentences):
    """done: measures by name; sentences: by name why the others have none."""
    rows = [{"name": name, "status": "done", **row} for name, row in done.items()]
    rows += [{"name": name, "status": "no result", "sentence": sentence} for name, sentence in sentences.items()]
    rows.sort(key=lambda row: row["name"])
    far = measures.far_columns(rows)
    for row, places in zip(rows, far):
        row["outlier_in"] = " ".join(places)
    columns = ["name", "status", *measures.COLUMNS, *measures.COSTS, "outlier_in", *measures.WARNINGS, "sentence"]
    replace_text(out / TABLE, measures.as_table(rows, columns))
    replace_text(out / TABLE.replace(".tsv", ".json"), as_json(measures.described(OTHERS)))
    replace_text(out / PAGE, pages.group_page(rows, far, TABLE))
