# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands at the top of a folder of derivatives."""
from .files import as_json, replace_text

ABOUT = ("Computed brain shift of each participant: the preoperative T1w and its labels, warped to the intraoperative "
         "brain, and the transforms between them. group.html lists all.\n")
NOT_OF_BIDS = "work/\n*.html\ngroup_measures.*\n*_run.json\n*_xfm.*\n*_map.nii.gz\n*_points.csv\n"


def write(out, source, version):
    out.mkdir(parents=True, exist_ok=True)
    name, _, number = version.partition(" ")
    replace_text(out / "dataset_description.json", as_json({
        "Name": "Computed brain shift", "BIDSVersion": "1.8.0", "DatasetType": "derivative",
        "GeneratedBy": [{"Name": name, "Version": number, "Description": "The preoperative MRI warped, by mechanics, "
                         "from displacements measured on the cortex"}],
        "SourceDatasets": [{"URL": source.as_uri()}]}))
    replace_text(out / "README", ABOUT)
    replace_text(out / ".bidsignore", NOT_OF_BIDS)
