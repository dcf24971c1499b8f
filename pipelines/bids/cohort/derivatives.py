# SPDX-License-Identifier: GPL-3.0-or-later
"""A finished run's files under the names of BIDS derivatives."""

from . import dataset, measures
from .files import as_json, place, replace_text
from .names import case_name

TRANSFORM = "from-preop_to-intraop_mode"
FILES = {  # of the run: name among the derivatives
    "register/warped.nii.gz": "space-intraop_desc-brainshift_T1w.nii.gz",
    "register/warped_labels.nii.gz": "space-intraop_dseg.nii.gz",
    f"register/{TRANSFORM}-image_xfm.h5": f"{TRANSFORM}-image_xfm.h5",
    f"register/{TRANSFORM}-image_xfm.json": f"{TRANSFORM}-image_xfm.json",
    f"register/{TRANSFORM}-points_xfm.h5": f"{TRANSFORM}-points_xfm.h5",
    f"register/{TRANSFORM}-points_xfm.json": f"{TRANSFORM}-points_xfm.json",
    "register/jacobian.nii.gz": "desc-jacobian_map.nii.gz",
    "register/landmarks.csv": "desc-landmarks_points.csv",
    "run.json": "desc-brainshift_run.json",
}
RECORD = FILES["run.json"]
LABEL_TABLE = "space-intraop_dseg.tsv"
ABOUT_IMAGE = "space-intraop_desc-brainshift_T1w.json"
ABOUT_LABELS = "space-intraop_dseg.json"


def file_of(out, participant, session, ending):
    folder = out / f"sub-{participant}" / (f"ses-{session}" if session else "") / "anat"
    return folder / f"{case_name(participant, session)}_{ending}"


def page_of(out, name):
    return out / f"{name}.html"


def publish(out, case, run, known):
    """run: the folder of a finished run; known: the folders that BIDS URIs name. What the run says of itself."""
    def target(ending):
        return file_of(out, case.participant, case.session, ending)

    target("").parent.mkdir(parents=True, exist_ok=True)
    for made, ending in FILES.items():
        if (run / made).exists():
            place(run / made, target(ending))
        else:
            target(ending).unlink(missing_ok=True)
    record = measures.record_of(run)
    about = {"Sources": [dataset.uri(item["path"], known) for item in record["inputs"]],
             "SpatialReference": "the intraoperative brain, on the grid of the preoperative image"}
    replace_text(target(LABEL_TABLE), label_table(record.get("label_names", {})))
    replace_text(target(ABOUT_IMAGE), as_json({**about, "SkullStripped": case.skull_stripped}))
    replace_text(target(ABOUT_LABELS), as_json(about))
    place(run / "report/index.html", page_of(out, case.name))
    return record


def is_published(out, participant, session):
    return file_of(out, participant, session, RECORD).exists()


def withdraw(out, participant, session):
    """What an earlier run wrote of a case whose own run has failed."""
    for ending in (*FILES.values(), LABEL_TABLE, ABOUT_IMAGE, ABOUT_LABELS):
        file_of(out, participant, session, ending).unlink(missing_ok=True)


def label_table(names):
    rows = [f"{label}\t{names[label]}" for label in sorted(names, key=int)]
    return "\n".join(["index\tname", *rows]) + "\n"
