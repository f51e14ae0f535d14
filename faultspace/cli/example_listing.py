"""Run `faultspace examples`, which lists what comes with the package or copies it into a folder, with a record of faulty data."""

from __future__ import annotations

import json
import shlex
from pathlib import Path

from rich.text import Text

from ..base.errors import quote_path
from ..base.messages import say
from ..base.writing import write_text
from ..example_data import FILE_NAME, INPUTS, OUTPUTS, csv_text, faulty_record
from ..packaged_examples import CLAIMS, DESCRIPTIONS, EXPERIMENTS, PREFIX, content
from .consoles import answers, paragraph, print_json
from .failures import ANSWERED
from .reading_files import prepare_folder, write_json

RESULT = "result"  # the folder beside the record that the printed command writes into


def run(folder: Path | None, *, as_json: bool) -> int:
    """List the examples; with a folder, copy them there first, overwriting files of these names only."""
    if folder is not None:
        prepare_folder(folder)
        for name in DESCRIPTIONS | EXPERIMENTS:
            write_json(folder / f"{name}.json", json.loads(content(PREFIX + name)))
        for name in CLAIMS:
            write_text(folder / f"{name}.toml", content(PREFIX + name).decode())
        write_text(folder / FILE_NAME, csv_text(faulty_record()))
        say(f"{len(DESCRIPTIONS)} systems and {len(EXPERIMENTS)} experiments are in {quote_path(str(folder))}")
        say(f"claims.toml is there, too; decide its claims with: faultspace claim {shlex.quote(str(folder / 'claims.toml'))}")
        data, out = shlex.quote(str(folder / FILE_NAME)), shlex.quote(str(folder / RESULT))
        channels = f"--inputs {','.join(INPUTS)} --outputs {','.join(OUTPUTS)}"
        say(f"{FILE_NAME} is a record with a fault; find it with: faultspace identify {data} {channels} --out {out}")
    if as_json:
        print_json({PREFIX + name: description for name, description in (DESCRIPTIONS | EXPERIMENTS | CLAIMS).items()})
        return ANSWERED
    console = answers()
    width = max(len(PREFIX + name) for name in DESCRIPTIONS | EXPERIMENTS | CLAIMS) + 2
    for name, description in (DESCRIPTIONS | EXPERIMENTS | CLAIMS).items():
        paragraph(console, description, Text(f"{PREFIX + name:<{width}}", style="bold"))
    return ANSWERED
