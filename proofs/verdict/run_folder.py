"""A run of `verify` as a folder: headline certificates, the verdicts, and where they come from.

write_run          writes it
write_document     a JSON document into a file, whole or not at all
VERDICTS, ORIGIN   the names of the two documents beside the certificates
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from ...base.writing import write_text
from ..trust.structure_certificates import Certificate, sha256
from .cards import with_cards
from .origin import origin
from .verdicts import Report

VERDICTS, ORIGIN = "verdicts.json", "origin.json"
SHORT = 12


def write_run(report: Report, folder: Path, more: Sequence[Certificate] = ()) -> int:
    """Write all headline certificates and more as kind-<first 12 of its SHA-256>.json, then verdicts.json and, beside it, origin.json,
    which says what made them and when; return how many certificates there are. Raises InvalidInput where a file cannot be written.
    """
    certificates = [*report.certificates(), *more]
    for certificate in certificates:
        write_document(folder / f"{certificate['kind']}-{sha256(certificate)[:SHORT]}.json", certificate)
    write_document(folder / VERDICTS, with_cards(report))
    write_document(folder / ORIGIN, origin(report).to_json())
    return len(certificates)


def write_document(path: Path, document: object) -> None:
    """Write the document into the file at `path`, as `write_text` does."""
    write_text(path, json.dumps(document, indent=1, sort_keys=True) + "\n")
