# SPDX-License-Identifier: GPL-3.0-or-later
"""Names of BIDS files: sub-01_ses-a_desc-brain_mask.nii.gz has entities, a suffix and an extension."""
import re
from typing import NamedTuple


class Name(NamedTuple):
    entities: dict
    suffix: str
    extension: str


def parse(file_name):
    """None where it is no BIDS name."""
    stem, dot, extension = file_name.partition(".")
    *pairs, suffix = stem.split("_")
    entities = dict(pair.split("-", 1) for pair in pairs if "-" in pair)
    if len(entities) != len(pairs) or "-" in suffix:
        return None
    return Name(entities, suffix, dot + extension)


def is_label(text):
    """Of a participant or session; sub-01_old is no participant's folder."""
    return re.fullmatch("[0-9A-Za-z+]+", text) is not None


def case_name(participant, session):
    return f"sub-{participant}" + (f"_ses-{session}" if session else "")


def case_parts(name):
    """Participant and session, which may be empty."""
    entities = dict(pair.split("-", 1) for pair in name.split("_"))
    return entities["sub"], entities.get("ses", "")


def without_prefix(label, prefix):
    """BIDS Apps take 01 and sub-01."""
    return label[len(prefix):] if label.startswith(prefix) else label
