# SPDX-License-Identifier: GPL-3.0-or-later
"""Finds, for each participant and session of a BIDS folder, the T1w, its labels and the load; or says what is missing.

Labels and loads lie in derivatives: sub-01_dseg.nii.gz or FreeSurfer's mri/aparc+aseg.mgz, else a brain mask;
sub-01_desc-cortex_points.csv, or 3D Slicer markups sub-01_desc-before_points.mrk.json and ..._desc-after_points....
"""
import dataclasses
import json
import pathlib

from . import names

IMAGE = (".nii.gz", ".nii")
MARKUPS = (".mrk.json", ".fcsv")
FREESURFER = ("aparc+aseg.mgz", "aparc.DKTatlas+aseg.deep.mgz", "aseg.mgz")
BEST_LABELS = ("aparcaseg", "aseg")  # in FreeSurfer's numbers; fMRIPrep's third map knows no ventricles
OWN_SPACE = (None, "T1w", "orig")


class Missing(Exception):
    """A sentence: what of a participant is not there."""


@dataclasses.dataclass
class Case:
    """What is known of a participant in a session."""
    name: str
    participant: str
    session: str = ""
    t1: str = ""
    labels: str = ""
    labels_are: str = ""
    brain_mask: str = ""
    tumour: str = ""
    points: tuple = ()
    skull_stripped: bool = False


class Finder:
    """pick: entities by suffix, as {"T1w": {"acq": "mprage"}}, where several files would do."""

    def __init__(self, bids, derivatives, pick=None, preop_session=""):
        self.bids = pathlib.Path(bids)
        self.derivatives = [pathlib.Path(folder) for folder in derivatives]
        self.pick = pick or {}
        self.preop_session = preop_session

    def participants(self):
        return sorted(labels_of(self.bids, "sub"))

    def strays(self):
        """Folders that look like a participant's."""
        return sorted(f for f in self.bids.glob("sub-*") if f.is_dir() and not names.is_label(f.name[4:]))

    def cases(self, participant, sessions=()):
        """Cases of a participant, and the sentences of those that miss something, by name."""
        found, faults = [], {}
        for session in self._sessions(participant, sessions):
            name = names.case_name(participant, session)
            try:
                found.append(self._case(name, participant, session))
            except Missing as fault:
                faults[name] = str(fault)
        return found, faults

    def _sessions(self, participant, wanted):
        """Those in which there is a T1w or a load; one without a name where there are no sessions at all."""
        there = {label for root in (self.bids, *self.derivatives)
                 for label in labels_of(root / f"sub-{participant}", "ses")}
        if not there:
            return [] if wanted else [""]
        there.discard(self.preop_session)
        chosen = [s for s in sorted(there) if (not wanted or s in wanted) and self._concerns(participant, s)]
        return chosen or ([] if wanted else [""])

    def _concerns(self, participant, session):
        t1 = not self.preop_session and self._matching(self._raw(participant, session), "T1w", IMAGE)
        return bool(t1 or self._matching(self._derived(participant, session), "points"))

    def _case(self, name, participant, session):
        preop = self.preop_session or session
        raw = self._raw(participant, preop)
        of_the_image = [preop] if raw and not self._is_the_only_one(participant, preop) else dict.fromkeys([preop, ""])
        raw = raw or self._raw(participant, "")
        derived = [file for each in of_the_image for file in self._derived(participant, each)]
        loads = self._derived(participant, session)
        if session and self._is_the_only_one(participant, session):
            loads += self._derived(participant, "")
        case = Case(name, participant, session, t1=self._t1(raw, participant))
        case.skull_stripped = is_stripped(case.t1)
        self._find_labels(case, derived, [names.case_name(participant, each) for each in of_the_image])
        case.tumour = self._mask(derived, "label", ("tumor", "tumour"))
        case.points = self._points(loads, name)
        return case

    def _is_the_only_one(self, participant, session):
        """Whether what names no session is of this one: with others beside it, it may be of any."""
        others = [label for label in labels_of(self.bids / f"sub-{participant}", "ses") if label != session]
        return not session or bool(self.preop_session) or not others

    def _t1(self, files, participant):
        found = self._one(self._matching(files, "T1w", IMAGE), "T1w")
        if not found:
            raise Missing(f"no T1w image: no sub-{participant}_..._T1w.nii.gz under {self.bids}/sub-{participant}")
        return found

    def _find_labels(self, case, files, subjects):
        maps = [f for f in self._matching(files, "dseg", IMAGE) if own_space(f)]
        for best in BEST_LABELS:
            maps = [f for f in maps if names.parse(f.name).entities.get("desc") == best] or maps
        case.labels = self._one(maps, "dseg")
        case.labels_are = table_of(pathlib.Path(case.labels), self.derivatives) if case.labels else ""
        if case.labels_are:
            return
        without_table, case.labels = case.labels, self._freesurfer(subjects)
        if case.labels:
            case.labels_are = "freesurfer"
            return
        if without_table:
            raise Missing(f"{without_table} has no table of its numbers: put a .tsv of its name with the columns index "
                          "and name beside it, or dseg.tsv into the folder of derivatives")
        case.brain_mask = self._mask(files, "desc", ("brain",))
        if not case.brain_mask:
            raise Missing(f"no labels: put {case.name}_dseg.nii.gz with its .tsv, FreeSurfer's mri/aparc+aseg.mgz or "
                          f"{case.name}_desc-brain_mask.nii.gz into a folder of derivatives")

    def _mask(self, files, entity, values):
        """What picks one of two brain masks says nothing of a tumour's, and the other way round."""
        masks = [f for f in of_suffix(files, "mask", IMAGE) if own_space(f)
                 and names.parse(f.name).entities.get(entity) in values]
        return self._one((self._picked(masks, "mask") or masks) if len(masks) > 1 else masks, "mask")

    def _freesurfer(self, subjects):
        for root in (*self.derivatives, self.bids / "sourcedata" / "freesurfer"):
            for subject in subjects:
                for file in FREESURFER:
                    if there(root / subject / "mri" / file):
                        return str(root / subject / "mri" / file)
        return ""

    def _points(self, files, name):
        def described(desc, extensions):
            return self._one([f for f in self._matching(files, "points", extensions) if own_space(f)
                              and names.parse(f.name).entities.get("desc") == desc], "points")

        table = described("cortex", (".csv",))
        if table:
            return (table,)
        before, after = described("before", MARKUPS), described("after", MARKUPS)
        if before and after:
            return (before, after)
        if before or after:
            raise Missing(f"half a load: {before or after} is there, the markups {'after' if before else 'before'} "
                          "are not")
        raise Missing(f"no load: put {name}_desc-cortex_points.csv, or {name}_desc-before_points.mrk.json and "
                      f"{name}_desc-after_points.mrk.json, into a folder of derivatives")

    def _raw(self, participant, session):
        return listed(self.bids, participant, session)

    def _derived(self, participant, session):
        return [f for root in self.derivatives for f in listed(root, participant, session)]

    def _matching(self, files, suffix, extensions=()):
        return self._picked(of_suffix(files, suffix, extensions), suffix)

    def _picked(self, files, suffix):
        """An empty value: without the entity."""
        wanted = self.pick.get(suffix, {}).items()
        return [f for f in files if all(names.parse(f.name).entities.get(e, "") == value for e, value in wanted)]

    @staticmethod
    def _one(files, suffix):
        if len(files) > 1:
            raise Missing(f"{files[0]} and {files[1]} would both do; say which by --pick {suffix}:ENTITY-VALUE")
        if not files or not there(files[0]):
            return ""
        check_place(files[0])
        return str(files[0])


def of_suffix(files, suffix, extensions=()):
    parsed = ((f, names.parse(f.name)) for f in files)
    return [f for f, name in parsed if name and name.suffix == suffix
            and (not extensions or name.extension in extensions)]


def listed(root, participant, session):
    """Files of a participant's session, in its folder and one below, in a fixed order."""
    top = root / f"sub-{participant}" / (f"ses-{session}" if session else "")
    if not top.is_dir():
        return []
    folders = [top] + sorted(f for f in top.iterdir() if f.is_dir() and not f.name.startswith("ses-"))
    return [f for folder in folders for f in sorted(folder.iterdir()) if not f.is_dir()]


def labels_of(folder, entity):
    """Those of folders sub-LABEL or ses-LABEL."""
    return [f.name[len(entity) + 1:] for f in folder.glob(f"{entity}-*")
            if f.is_dir() and names.is_label(f.name[len(entity) + 1:])]


def check_place(file):
    """A file of another participant or session than its folder's is somebody's mistake."""
    entities = names.parse(file.name).entities
    for entity in ("sub", "ses"):
        label = entities.get(entity)
        folders = [part for part in file.parts[:-1] if part.startswith(f"{entity}-")]
        if label and folders and f"{entity}-{label}" not in folders:
            raise Missing(f"{file} is by its name of {entity}-{label}, but does not lie in a folder of that name; see "
                          "whose it is")


def is_stripped(t1):
    """What the image's sidecar says."""
    try:
        image = pathlib.Path(t1)
        about = json.loads(image.with_name(image.name.partition(".")[0] + ".json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return isinstance(about, dict) and about.get("SkullStripped") is True


def own_space(file):
    return names.parse(file.name).entities.get("space") in OWN_SPACE


def there(file):
    if file.is_symlink() and not file.exists():
        raise Missing(f"{file} is a link whose content is not here; get it first, as by datalad get")
    return file.is_file()


def table_of(labels, roots):
    """What a map's numbers are: a .tsv beside it, or above it by BIDS's inheritance; FreeSurfer's. Empty: not known."""
    root = next(root for root in roots if root in labels.parents)
    wanted = names.parse(labels.name).entities.items()
    for folder in labels.parents:
        tables = [(len(name.entities), str(f)) for f in folder.glob("*dseg.tsv")
                  if (name := names.parse(f.name)) and name.suffix == "dseg" and name.entities.items() <= wanted]
        if tables:
            return max(tables)[1]
        if folder == root:
            break
    return "freesurfer" if names.parse(labels.name).entities.get("desc") in BEST_LABELS else ""
