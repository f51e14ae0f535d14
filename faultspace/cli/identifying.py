"""Run `faultspace identify`, which reads a record, identifies it, writes the answer into a folder and prints it.

run              the command's body
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from rich.text import Text

from ..base.errors import InvalidInput, in_file, quote_path
from ..base.messages import say
from ..base.progress import Progress, evenly, working
from ..base.sheets import counted
from ..base.tasks import shared
from ..numeric.data.files import read_record, read_stretches
from ..numeric.data.records import Record
from ..numeric.plant.pipeline import identify
from ..numeric.plant.report import result_files as report
from ..numeric.plant.report.first_screen import first_screen
from ..numeric.plant.report.folders import refuse
from ..numeric.plant.report.summary import summary
from .argument_names import as_options, naming, of_file
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED
from .reading_files import prepare_folder


def run(
    files: Sequence[str],
    known: Mapping[str, Any],
    *,
    healthy: str | None,
    gaps: bool,
    inputs: Sequence[str],
    outputs: Sequence[str],
    out: Path | None,
    as_json: bool,
    verbose: bool = False,
    scheduler: str | None = None,
) -> int:
    """Identify by what is `known`, the arguments of the library, or by a file `healthy` in the place of so many samples, and write the
    files of `report.NAMES` into `out`; the exit code is 0 whenever there is an answer, "undecided" included.

    Several files are experiments of one plant, and with `gaps` so are the parts of a file between missing samples. The workers of
    the Dask `scheduler` take the windows of long records in sections; the answer is the same.

    A folder with a file of these names that no earlier run wrote is refused before anything is read. Where there is no answer, folders that
    were made for it go again.
    """
    if healthy is not None and known["healthy"] is not None:
        raise InvalidInput("--healthy: got --healthy-until as well, expected one of them: a file without fault, or the number of samples")
    if not (inputs and outputs):
        read_record(files[0], inputs=inputs, outputs=outputs)  # refuses, and says what there is
    for name in files:
        if not Path(name).exists():
            read_record(name, inputs=inputs, outputs=outputs)  # refuses, before what else is missing is told
    if out is None:
        raise InvalidInput("--out: got none, expected a folder for the answer: try --out answer")
    worded = as_options if healthy is None else of_file
    read = [*files, *([healthy] if healthy else [])]
    data = _named(files)
    if any(Path(path).is_dir() and _same(out, path) for path in read):
        raise InvalidInput(f"{quote_path(data)}: is a folder of measurements, expected another --out: try --out answer")
    if any(_same(out / name, path) for name in report.NAMES if (out / name).exists() for path in read):
        raise InvalidInput(f"{quote_path(data)}: would be overwritten by the answer of this name, expected another --out")
    refuse(out, report.NAMES)
    new = _missing(out)
    try:
        prepare_folder(out)
        with shared(scheduler) as cluster, working(f"reading {quote_path(data)}") as telling:
            tell = evenly(telling)
            records = [one for path in files for one in _records(path, gaps, inputs, outputs, tell)]
            if healthy is not None:
                known = {**known, "healthy": read_record(healthy, inputs=inputs, outputs=outputs, on_progress=tell)}
            with naming(worded), in_file(data):
                answer = identify(records if len(records) > 1 else records[0], **known, on_progress=tell)
            if cluster is not None and cluster.lost:
                say(f"{cluster.lost}; what was left was done here, and the answer is the same")
            tell("writing the answer", 0, 0)
            written, remarks = report.write(answer, out, data, tell, worded=worded)
    except BaseException:
        for folder in new:
            with suppress(OSError):
                folder.rmdir()
        raise
    for remark in remarks:
        say(remark)
    if as_json:
        print_json(report.document(answer, data, worded=worded) | {"files": written})
        return ANSWERED
    console = answers()
    if not verbose:
        for line in first_screen(answer, data, worded=worded):
            label = line[: line.find(":") + 1]
            paragraph(console, Text(line.removeprefix(label)), Text(label, style="bold"))
        evidence = f"the evidence is in {report.PAGE} in {quote_path(str(out))}, beside {len(written) - 1} more files; -v prints it"
        paragraph(console, evidence, Text("Files:   ", style="bold"))
        return ANSWERED
    for line in summary(answer, data, worded=worded):
        paragraph(console, Text(line, style="bold cyan" if line.startswith("#") else ""))
    console.print()
    paragraph(console, f"written into {quote_path(str(out))}: {', '.join(written)}")
    return ANSWERED


def _records(path: str, gaps: bool, inputs: Sequence[str], outputs: Sequence[str], tell: Progress) -> list[Record]:
    """Return the record of a file, or the parts of it between missing samples."""
    if gaps:
        return read_stretches(path, inputs=inputs, outputs=outputs, on_progress=tell)
    return [read_record(path, inputs=inputs, outputs=outputs, on_progress=tell)]


def _named(files: Sequence[str]) -> str:
    """Return what the answer is about: the file, or the first of several with the number of the others."""
    return files[0] if len(files) == 1 else f"{files[0]} and {counted(len(files) - 1, 'file')} more"


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
