# SPDX-License-Identifier: GPL-3.0-or-later
"""The group level: one table, its sidecar and one page of all cases, outliers first."""
import json

from . import measures, pages
from .derivatives import as_json, folder_of, replace_text
from .plan import STAGES

TABLE = "group_measures.tsv"
OTHERS = {
    "name": {"Description": "Participant and session"},
    "status": {"Description": "Whether there is a result", "Levels": {"done": "yes", "no result": "no"}},
    "sentence": {"Description": "Why there is no result"},
    "outlier_in": {"Description": f"Measures more than {measures.FAR} robust standard deviations from the median"},
}
NOT_BIDS = "work/\n*.html\n*.log\ngroup_measures.*\n"


def faults(work, names):
    """Of the cases that were run and have no result: the sentence of each."""
    found = {}
    for name in names:
        fault = fault_of(work / name)
        if fault:
            found[name] = fault
    return found


def fault_of(folder):
    """Empty, or why a case has no result. The last mark that is there knows."""
    for stage in reversed(STAGES):
        mark = folder / "marks" / f"{stage}.json"
        if mark.exists():
            try:
                fault = json.loads(mark.read_text(encoding="utf-8"))["fault"]
            except ValueError:  # the disk was full
                return f"{stage} was interrupted; the same command goes on"
            if fault:
                return f"{fault['stage']}: {fault['sentence']}"
            return "" if stage == STAGES[-1] else f"interrupted after {stage}; the same command goes on"
    return "not run yet"


def write(out, cases, sentences):
    rows = []
    for case in cases:
        record = folder_of({**case, "derivatives": out}) / f"{case['name']}_desc-brainshift_run.json"
        if case["name"] not in sentences:
            rows.append({"name": case["name"], "status": "done",
                         **measures.row_of(json.loads(record.read_text(encoding="utf-8")))})
    for name, sentence in sentences.items():
        rows.append({"name": name, "status": "no result", "sentence": sentence})
        replace_text(out / f"{name}.html", pages.fault_page(name, sentence))
    rows.sort(key=lambda row: row["name"])
    far = measures.far_columns(rows)
    for row, places in zip(rows, far):
        row["outlier_in"] = " ".join(places)
    columns = ["name", "status", *measures.COLUMNS, *measures.COSTS, "outlier_in", "sentence"]
    replace_text(out / TABLE, measures.as_table(rows, columns))
    replace_text(out / TABLE.replace(".tsv", ".json"), as_json(measures.described(OTHERS)))
    replace_text(out / "group.html", pages.group_page(rows, far, TABLE))


def write_dataset(out, source, version):
    out.mkdir(parents=True, exist_ok=True)
    name, _, number = version.partition(" ")
    replace_text(out / "dataset_description.json", as_json({
        "Name": "Computed brain shift", "BIDSVersion": "1.8.0", "DatasetType": "derivative",
        "GeneratedBy": [{"Name": name, "Version": number, "Description": "Preoperative MRI warped to the brain as it "
                         "lies after the opening, by mechanics from displacements of the cortex"}],
        "SourceDatasets": [{"URL": source.as_uri()}]}))
    replace_text(out / "README", "Computed brain shift of each participant: the preoperative T1w and its labels, warped "
                 "to the intraoperative brain, and the transforms. group.html lists all.\n")
    replace_text(out / ".bidsignore", NOT_BIDS)
