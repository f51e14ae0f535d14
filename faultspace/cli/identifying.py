"""Run `faultspace identify`, which reads a record, identifies it, writes the answer into a folder and prints it.

run              the command's body
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path

from rich.text import Text

from ..base.errors import InvalidInput, in_file, quote_path
from ..base.messages import say
from ..base.progress import evenly, working
from ..numeric.data.files import read_record
from ..numeric.pipeline import identify
from ..numeric.report import files as report
from ..numeric.report.folders import refuse
from ..numeric.report.summary import summary
from .argument_names import as_options
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED
from .reading_files import prepare_folder


def run(
    data: str,
    *,
    inputs: Sequence[str],
    outputs: Sequence[str],
    out: Path,
    order: int | None,
    block_rows: int | None,
    faults: int | None,
    healthy_until: int | None,
    remove_means: bool,
    dt: float | None,
    as_json: bool,
) -> int:
    """Identify and write the files of `report.NAMES` into `out`; the exit code is 0 whenever there is an answer, "undecided" included.

    A folder with a file of these names that no earlier run wrote is refused before anything is read. Where there is no answer, folders that
    were made for it go again.
    """
    taken = [name for name in report.NAMES if (out / name).exists() and _same(out / name, data)]
    if taken:
        raise InvalidInput(f"{quote_path(data)}: would be overwritten by the answer of this name, expected another --out")
    refuse(out, report.NAMES)
    new = _missing(out)
    try:
        prepare_folder(out)
        with working(f"reading {quote_path(data)}") as telling:
            tell = evenly(telling)
            record = read_record(data, inputs=inputs, outputs=outputs, on_progress=tell)
            with in_file(data):
                answer = identify(
                    record,
                    order=order,
                    block_rows=block_rows,
                    n_v=faults,
                    healthy=healthy_until,
                    remove_means=remove_means,
                    dt=dt,
                    on_progress=tell,
                )
            tell("writing", 0, 0)
            written, remarks = report.write(answer, out, data, tell, worded=as_options)
    except BaseException:
        for folder in new:
            with suppress(OSError):
                folder.rmdir()
        raise
    for remark in remarks:
        say(remark)
    if as_json:
        print_json(report.document(answer, data, folder=str(out), worded=as_options) | {"files": written})
        return ANSWERED
    console = answers()
    for line in summary(answer, data, folder=str(out), worded=as_options):
        paragraph(console, Text(line, style="bold cyan" if line.startswith("#") else ""))
    console.print()
    paragraph(console, f"written into {quote_path(str(out))}: {', '.join(written)}")
    return ANSWERED


def _missing(folder: Path) -> list[Path]:
    """Return the folders that would have to be made for this one, innermost first."""
    try:
        return [part for part in (folder, *folder.parents) if not part.exists()]
    except OSError:
        return []


def _same(path: Path, other: str) -> bool:
    try:
        return path.samefile(other)
    except OSError:
        return False
