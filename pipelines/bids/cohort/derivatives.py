# SPDX-License-Identifier: GPL-3.0-or-later
"""A finished run's files under the names of BIDS derivatives."""
import json
import os
import pathlib
import shutil

DIRECTIONS = "from-preop_to-intraop_mode"
FILES = {  # of the run: name among the derivatives
    "register/warped.nii.gz": "space-intraop_desc-brainshift_T1w.nii.gz",
    "register/warped_labels.nii.gz": "space-intraop_dseg.nii.gz",
    f"register/{DIRECTIONS}-image_xfm.h5": f"{DIRECTIONS}-image_xfm.h5",
    f"register/{DIRECTIONS}-image_xfm.json": f"{DIRECTIONS}-image_xfm.json",
    f"register/{DIRECTIONS}-points_xfm.h5": f"{DIRECTIONS}-points_xfm.h5",
    f"register/{DIRECTIONS}-points_xfm.json": f"{DIRECTIONS}-points_xfm.json",
    "register/jacobian.nii.gz": "desc-jacobian_map.nii.gz",
    "register/landmarks.csv": "desc-landmarks_points.csv",
    "run.json": "desc-brainshift_run.json",
}
LABEL_TABLE = "space-intraop_dseg.tsv"
ABOUT_IMAGE = "space-intraop_desc-brainshift_T1w.json"
ABOUT_LABELS = "space-intraop_dseg.json"
TEXTS = (LABEL_TABLE, ABOUT_IMAGE, ABOUT_LABELS)
DEFAULT_NAMES = {"1": "parenchyma", "2": "ventricles", "3": "tumour", "4": "fluid", "5": "skull", "6": "skin"}


def folder_of(case):
    out = pathlib.Path(case["derivatives"]) / f"sub-{case['participant']}"
    return (out / f"ses-{case['session']}" if case["session"] else out) / "anat"


def page_of(case):
    return pathlib.Path(case["derivatives"]) / f"{case['name']}.html"


def publish(case, folder):
    """The files that it wrote; those that an earlier run made and this one did not are gone."""
    withdraw(case)
    out, written = folder_of(case), []
    out.mkdir(parents=True, exist_ok=True)

    def path(ending):
        written.append(str(out / f"{case['name']}_{ending}"))
        return pathlib.Path(written[-1])

    for made, ending in FILES.items():
        if (folder / "run" / made).exists():
            place(folder / "run" / made, path(ending))
    record = json.loads((folder / "run" / "run.json").read_text(encoding="utf-8"))
    sources = [item["path"] for item in record["inputs"]]
    replace_text(path(LABEL_TABLE), label_table(record["options"].get("tissues", {})))
    about = {"Sources": sources, "SpatialReference": "the intraoperative brain, on the grid of the preoperative image"}
    replace_text(path(ABOUT_IMAGE), as_json({**about, "SkullStripped": False}))
    replace_text(path(ABOUT_LABELS), as_json(about))
    place(folder / "run/report/index.html", page_of(case))
    return written + [str(page_of(case))]


def withdraw(case):
    """What an earlier run of a case wrote that fails now. No file is left to be listed."""
    for ending in (*FILES.values(), *TEXTS):
        (folder_of(case) / f"{case['name']}_{ending}").unlink(missing_ok=True)
    page_of(case).unlink(missing_ok=True)
    return []


def label_table(tissues):
    named = {**DEFAULT_NAMES, **{label: tissue["name"] for label, tissue in tissues.items() if tissue.get("name")}}
    rows = [f"{label}\t{named[label]}" for label in sorted(named, key=lambda text: (len(text), text))]
    return "\n".join(["index\tname", *rows]) + "\n"


def place(source, target):
    """A second name of the file where the file system can give one, else a copy; whole or not at all."""
    partial = target.with_name(f".{target.name}.partial")
    partial.unlink(missing_ok=True)
    try:
        os.link(source, partial)
    except OSError:
        shutil.copyfile(source, partial)
    partial.replace(target)


def replace_text(target, text):
    partial = target.with_name(f".{target.name}.partial")
    partial.write_text(text, encoding="utf-8")
    partial.replace(target)


def as_json(value):
    return json.dumps(value, indent=2) + "\n"
