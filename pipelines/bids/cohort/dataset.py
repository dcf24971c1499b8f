# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands at the top of a folder of derivatives, and how its files name those that they were made from."""
import json
from pathlib import Path

from .files import as_json, replace_text
from .program import Unusable

ABOUT = ("Computed brain shift of each participant: the preoperative T1w and its labels, warped to the intraoperative "
         "brain, and the transforms between them. group.html lists all.\n")
# The standard has no names for pages, for a group's table and, as yet, for transforms and points.
NOT_OF_BIDS = "work/\n*.html\ngroup_measures.*\n*_run.json\n*_xfm.*\n*_map.nii.gz\n*_points.csv\n"


def links(bids, derivatives):
    """Folders by the names that BIDS URIs give them: BIDS_DIR is raw; folders of derivatives elsewhere are numbered."""
    elsewhere = [folder for folder in derivatives if bids not in folder.parents]
    return {"raw": bids} | {f"derivatives{number}": folder for number, folder in enumerate(elsewhere, 1)}


def uri(file, known):
    """bids:raw:sub-01/anat/... of a file in one of the known folders, the deepest that holds it; else its address."""
    file = Path(file)
    holding = [(len(folder.parts), name) for name, folder in known.items() if folder in file.parents]
    if not holding:
        return file.as_uri()
    name = max(holding)[1]
    return f"bids:{name}:{file.relative_to(known[name]).as_posix()}"


def refuse_others(out, bids):
    """A dataset that is not ours keeps its description."""
    if out.resolve() == bids.resolve():
        raise Unusable(f"{out}: is the folder of the images; choose another for OUT, as derivatives/brainshift in it")
    try:
        about = json.loads((out / "dataset_description.json").read_text(encoding="utf-8"))
        makers = [maker.get("Name") for maker in about.get("GeneratedBy", [])]
    except FileNotFoundError:
        return
    except (ValueError, AttributeError, TypeError):
        makers = []
    if "brainshift" not in makers:
        raise Unusable(f"{out}: is another dataset, by its dataset_description.json; choose another folder for OUT")


def write(out, known, version):
    """known: what links() gives."""
    out.mkdir(parents=True, exist_ok=True)
    name, _, number = version.partition(" ")
    addresses = {name: folder.as_uri() for name, folder in known.items()}
    replace_text(out / "dataset_description.json", as_json({
        "Name": "Computed brain shift", "BIDSVersion": "1.8.0", "DatasetType": "derivative",
        "GeneratedBy": [{"Name": name, "Version": number, "Description": "The preoperative MRI warped, by mechanics, "
                         "from displacements measured on the cortex"}],
        "SourceDatasets": [{"URL": address} for address in addresses.values()], "DatasetLinks": addresses}))
    replace_text(out / "README", ABOUT)
    replace_text(out / ".bidsignore", NOT_OF_BIDS)
