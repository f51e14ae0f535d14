"""Run `faultspace identify`, which reads a record, identifies it, writes the answer into a folder and prints it.

run              the command's body
Known            what the user knows of the record
"""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

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
from ..numeric.plant.report.folders import refuse
from ..numeric.plant.report.summary import summary
from .argument_names import as_options, naming, of_file
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED
from .reading_files import prepare_folder


@dataclass(frozen=True)
class Known:
    """What the user knows of the record; None stands for what is to be found."""

    order: int | None
    block_rows: int | None
    faults: int | None
    healthy_until: int | None
    healthy: str | None
    noise_level: Sequence[float] | None
    operating_point: str | None
    dt: float | None
    gaps: bool = False


def run(
    files: Sequence[str],
    known: Known,
    *,
    inputs: Sequence[str],
    outputs: Sequence[str],
    out: Path | None,
    as_json: bool,
    scheduler: str | None = None,
) -> int:
    """Identify and write the files of `report.NAMES` into `out`; the exit code is 0 whenever there is an answer, "undecided" included.

    Several files are experiments of one plant, and with `known.gaps` so are the parts of a file between missing samples. The workers of
    the Dask `scheduler` take the windows of long records in sections; the answer is the same.

    A folder with a file of these names that no earlier run wrote is refused before anything is read. Where there is no answer, folders that
    were made for it go again.
    """
    if known.healthy is not None and known.healthy_until is not None:
        raise InvalidInput("--healthy: got --healthy-until as well, expected one of them: a file without fault, or the number of samples")
    if not (inputs and outputs):
        read_record(files[0], inputs=inputs, outputs=outputs)  # refuses, and says what there is
    if out is None:
        raise InvalidInput("--out: got none, expected a folder for the answer: try --out answer")
    worded = as_options if known.healthy is None else of_file
    read = [*files, *([known.healthy] if known.healthy else [])]
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
            records = [one for path in files for one in _records(path, known.gaps, inputs, outputs, tell)]
            healthy: int | Record | None = known.healthy_until
            if known.healthy is not None:
                healthy = read_record(known.healthy, inputs=inputs, outputs=outputs, on_progress=tell)
            with naming(worded), in_file(data):
                answer = identify(
                    records if len(records) > 1 else records[0],
                    order=known.order,
                    block_rows=known.block_rows,
                    n_v=known.faults,
                    healthy=healthy,
                    noise_level=_one_or_each(known.noise_level),
                    operating_point=known.operating_point,
                    dt=known.dt,
                    on_progress=tell,
                )
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


def _one_or_each(levels: Sequence[float] | None) -> float | Sequence[float] | None:
    """Return the level that stands for all outputs, or those of each; None where there is none."""
    return levels[0] if levels and len(levels) == 1 else levels or None


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
