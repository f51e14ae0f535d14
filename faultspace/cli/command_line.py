"""Declare what the command `faultspace` understands. Each command's work is in a module of its own, imported when asked for.

main         runs it and returns the exit code
app          the commands, for typer
parser       what typer makes of them, once a process: their signatures take longer to read than most commands to run
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Sequence
from functools import cache, wraps
from pathlib import Path
from typing import Annotated, Any, ParamSpec

import typer
from typer.main import get_command

from .. import __version__
from ..base.errors import InvalidInput
from ..base.messages import say
from .audit_command import audit
from .conjecture_command import conjecture
from .failures import BAD_INPUT, INTERRUPTED, STOPPED, Terminated, asks_report, guarded, terminable
from .option_types import Effort, Expected, Floats, Json, OneSystem, Plain, Verbose, in_our_words, jobs_number, number
from .report_command import report

Given = ParamSpec("Given")

app = typer.Typer(
    name="faultspace",
    help="Exact verdicts on the claims of a paper about systems with additive faults, and exact answers about your own system.",
    epilog="A SYSTEM is a JSON file, - for standard input, or example:NAME (see: faultspace examples). "
    "Exit codes: 0 answered as expected, 1 not as expected, 2 bad input, 3 from check: verified under an assumption that is told, "
    "70 an error of ours, 130 interrupted, 143 terminated.",
    add_completion=False,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
)

# Some releases of typer bring their own click and none of them names this base of BadParameter.
_UsageError: type[Any] = typer.BadParameter.__bases__[0]


@cache
def parser() -> Any:
    """Return the group of all commands, which parses and runs one."""
    return get_command(app)


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line (`sys.argv` when no arguments are given) and return the exit code. It never raises for bad input."""
    unheard = sys.stdout is None
    for name in ("stdout", "stderr"):
        stream = getattr(sys, name)
        if stream is None:  # closed by the caller; the replacement lives as long as the process
            setattr(sys, name, open(os.devnull, "w"))  # noqa: SIM115
        elif hasattr(stream, "reconfigure"):  # what the terminal's encoding lacks is shown escaped
            stream.reconfigure(errors="backslashreplace")
    if unheard:  # before any long computation, whose answer nobody would see
        say("standard output: is closed, expected one that takes the answer")
        return BAD_INPUT
    try:
        given = list(sys.argv[1:] if arguments is None else arguments)
        with terminable():
            code = parser()(args=given, prog_name="faultspace", standalone_mode=False)
        if code in STOPPED:
            say(STOPPED[code])
        return code if isinstance(code, int) else 0
    except _UsageError as error:
        context = getattr(error, "ctx", None)
        say(f"{in_our_words(error.format_message())} (see: {context.command_path if context else 'faultspace'} --help)")
        return BAD_INPUT
    except (KeyboardInterrupt, typer.Abort) as error:
        code = error.code if isinstance(error, Terminated) else INTERRUPTED
        say(STOPPED[code])
        return code
    except Exception as error:  # before a command's body was reached
        return asks_report(error)


@app.callback(invoke_without_command=True)
def _top(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version and stop.")] = False,
) -> None:
    if version:
        typer.echo(f"faultspace {__version__}")
        raise typer.Exit(0)
    if context.invoked_subcommand is None:
        typer.echo(context.get_help(), err=True)
        raise typer.Exit(BAD_INPUT)


def _command(name: str | None = None) -> Callable[[Callable[Given, int]], Callable[Given, int]]:
    """Make a command of a function that parses nothing more, calls one module of this folder, imported by then only, and returns the exit
    code: everything that can go wrong in it is said on one line, and the process leaves with the code that belongs to it.
    """

    def made(body: Callable[Given, int]) -> Callable[Given, int]:
        @wraps(body)
        def command(*arguments: Given.args, **options: Given.kwargs) -> int:
            raise typer.Exit(guarded(lambda: body(*arguments, **options)))

        app.command(name, cls=Plain)(command)
        return body

    return made


@_command()
def verify(
    effort: Annotated[Effort, typer.Option(help="Samples of systems; or every small one, for the background.")] = Effort.quick,
    claim: Annotated[
        list[str] | None, typer.Option("--claim", metavar="ID", help="Only this claim, a page of it; may be repeated.")
    ] = None,
    jobs: Annotated[
        int | None, typer.Option(metavar="K", parser=jobs_number, help="Processes at a time.", show_default="all cores")
    ] = None,
    scheduler: Annotated[str | None, typer.Option(metavar="ADDRESS", help="Work on the Dask cluster with this scheduler instead.")] = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write the headline certificates and verdicts.json there.")] = None,
    recheck: Annotated[
        bool, typer.Option("--recheck", help="First compile the Rocq theory anew, whatever is cached, and let coqchk read it.")
    ] = False,
    resume: Annotated[
        Path | None,
        typer.Option(metavar="FILE", help="Keep what is decided there, and go on with what an earlier run has kept.", show_default=False),
    ] = None,
    verbose: Verbose = False,
    json: Json = False,
) -> int:
    """Decide the claims of the paper.

    A claim gets a line; -v adds the long tables, --claim prints a page of one. Exit 0 if every verdict is the expected one, else 1.
    """
    from . import verifying

    workers = jobs or (os.cpu_count() or 1 if scheduler is None else -1)
    return verifying.run(
        claim or [],
        effort=effort.value,
        jobs=workers,
        scheduler=scheduler,
        out=out,
        recheck=recheck,
        verbose=verbose,
        as_json=json,
        resume=resume,
    )


@_command()
def check(
    certificate: Annotated[list[str], typer.Argument(metavar="CERTIFICATE...", show_default=False, help="Certificate files.")],
    system: Annotated[
        list[str] | None,
        typer.Option("--system", metavar="FILE", help="Accept only what is about this system; may be repeated."),
    ] = None,
    rocq: Annotated[bool, typer.Option("--rocq", help="Have Rocq's kernel recompute them, too; needs coqc with MathComp.")] = False,
    json: Json = False,
) -> int:
    """Run the checker on certificates.

    Exit 0: all verified; 3: all verified, one or more under an assumption that is told; 1: one is
    rejected, or not accepted by Rocq; 2: one does not parse.
    """
    from . import checking

    return checking.run(certificate, systems=system or [], rocq=rocq, as_json=json)


@_command()
def claim(
    file: Annotated[str, typer.Argument(metavar="FILE", show_default=False, help="Claims in TOML, - or example:claims.")],
    only: Annotated[
        list[str] | None, typer.Option("--claim", metavar="ID", help="Only this claim of the file; may be repeated.", show_default=False)
    ] = None,
    ablation: Annotated[bool, typer.Option("--ablation/--no-ablation", help="Try each claim without each of its hypotheses, too.")] = True,
    most: Annotated[
        int | None,
        typer.Option(metavar="K", parser=number(int, 1, 10**9), help="Go through no more systems of a box.", show_default="10^9"),
    ] = None,
    jobs: Annotated[int, typer.Option(metavar="K", parser=jobs_number, help="Processes at a time, for large boxes.")] = 1,
    explain: Annotated[
        str | None, typer.Option(metavar="SYSTEM", help="Tell what each part of the claims is on this system, instead.", show_default=False)
    ] = None,
    sharpen: Annotated[
        list[str] | None,
        typer.Option(metavar="ID", help="Seek sharper bounds in the place of this claim's, instead; may be repeated.", show_default=False),
    ] = None,
    out: Annotated[Path | None, typer.Option(metavar="DIR", help="Write the certificates there.", show_default=False)] = None,
    resume: Annotated[
        Path | None, typer.Option(metavar="FILE", help="Keep there what was gone through, and go on from it.", show_default=False)
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Work on the Dask cluster with this scheduler instead.", show_default=False)
    ] = None,
    json: Json = False,
) -> int:
    """Decide claims of your own about systems.

    Each is refuted by a counterexample, the smallest of its box where that has one, proved, not refuted, or vacuous. The page
    docs/your-claims.md tells the language. Exit 1 where a claim names the verdict that it expects and gets another one.
    """
    from . import claiming

    if sharpen:
        if only or explain is not None:
            raise InvalidInput("--sharpen: got --claim or --explain, too, expected --sharpen ID alone")
        return claiming.sharpen(file, sharpen, most=most, jobs=jobs, out=out, as_json=json)
    return claiming.run(
        file, only=only or [], ablation=ablation, most=most, jobs=jobs, on=explain, out=out, as_json=json, cluster=scheduler, resume=resume
    )


_command()(conjecture)


@_command()
def inspect(
    system: Annotated[list[str], typer.Argument(metavar="SYSTEM...", show_default=False, help="System files, - or example:NAME.")],
    json: Json = False,
    floats_exactly: Floats = False,
) -> int:
    """Tell everything about a system, exactly.

    That is: indices, zeros, delays, window ranks, fault space. With --json one system gives an object, several an array of objects that
    also name their "file".
    """
    from . import inspecting

    return inspecting.run(system, as_json=json, floats_exactly=floats_exactly)


@_command()
def compare(
    first: OneSystem,
    second: OneSystem,
    expect: Annotated[Expected | None, typer.Option(help="Exit 1 unless this is the answer.", show_default=False)] = None,
    word: Annotated[bool, typer.Option("--word", help='The separating word in full; with --json as "word".')] = False,
    json: Json = False,
    floats_exactly: Floats = False,
) -> int:
    """Tell whether two systems are equivalent.

    They are if they make the same outputs. If not, it tells on how many samples they first differ, and a word that one makes and the other
    cannot. B and D play no part.
    """
    from . import comparing

    expected = expect.value if expect else None
    return comparing.run((first, second), as_json=json, expected=expected, word=word, floats_exactly=floats_exactly)


@_command()
def limit(
    experiment: Annotated[
        list[str], typer.Argument(metavar="EXPERIMENT...", show_default=False, help="Experiment files, - or example:NAME.")
    ],
    json: Json = False,
    floats_exactly: Floats = False,
) -> int:
    """Tell what identification converges to.

    The limits of PI-MOESP and PO-MOESP are exact, for filtered white noise as input and fault. An experiment is a system with B and D, the
    block rows "s" and "past", and "u_filter", "v_filter", "w_filter": matrices over lag.
    """
    from . import limiting

    return limiting.run(experiment, as_json=json, floats_exactly=floats_exactly)


@_command()
def identify(
    data: Annotated[
        list[str],
        typer.Argument(
            metavar="DATA...",
            show_default=False,
            help="A CSV, Parquet, NPZ, NPY or MAT file of measurements, or a folder of Parquet files, which are one record; several are "
            "experiments of one plant.",
        ),
    ],
    inputs: Annotated[
        list[str] | None, typer.Option("--inputs", metavar="NAME,...", show_default=False, help="Input channels; may be repeated.")
    ] = None,
    outputs: Annotated[list[str] | None, typer.Option("--outputs", metavar="NAME,...", show_default=False, help="Output channels.")] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            metavar="DIR", show_default=False, help="Write model, fault space, signal, plots there; only our own files are replaced."
        ),
    ] = None,
    order: Annotated[
        int | None, typer.Option(metavar="N", parser=number(int, 1, 3), help="Number of states.", show_default="chosen from the data")
    ] = None,
    block_rows: Annotated[
        int | None,
        typer.Option(metavar="K", parser=number(int, 2, 20), help="Samples of a window.", show_default="what the record carries"),
    ] = None,
    faults: Annotated[
        int | None, typer.Option(metavar="K", parser=number(int, 0, 1), help="Number of independent faults.", show_default="estimated")
    ] = None,
    healthy_until: Annotated[
        int | None,
        typer.Option(
            metavar="K", parser=number(int, 1, 1000), help="The first K samples are without fault: count beyond them.", show_default=False
        ),
    ] = None,
    healthy: Annotated[
        str | None,
        typer.Option(
            "--healthy",
            metavar="FILE",
            help="A record without fault, of the same channels: model, means and noise from it.",
            show_default=False,
        ),
    ] = None,
    noise_level: Annotated[
        list[float] | None,
        typer.Option(
            metavar="SIGMA",
            parser=number(float, 0, 0.1),
            help="Deviation of the sensors' noise, once or once an output, in its units.",
            show_default=False,
        ),
    ] = None,
    operating_point: Annotated[
        str | None,
        typer.Option(
            metavar="means|zero",
            help="About what the plant is linear.",
            show_default="means of the healthy samples, else of the record unless zero may be it",
        ),
    ] = None,
    gaps: Annotated[
        bool, typer.Option("--gaps", help="Samples are missing: take the parts between them as experiments of one plant.")
    ] = False,
    dt: Annotated[
        float | None,
        typer.Option(
            metavar="SECONDS",
            parser=number(float, 0, 0.1),
            help="Time from sample to sample; the model's file keeps it.",
            show_default=False,
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option(
            metavar="ADDRESS", help="Have the Dask cluster with this scheduler share the work of long records.", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Find model and faults in measured data.

    --inputs, --outputs and --out are needed; without them the message tells the channels of DATA, and a command to try.
    The answer: model, number of faults, fault space and fault signal; "undecided" where the data cannot tell, which is one too: exit 0.
    DIR may hold what an earlier run wrote, which is replaced; a file of the same name that is not ours is never touched, but refused.

    Several files of the same channels give one model, one number of faults and one fault space; onset, changes and signal are of each.
    A channel is a column's name, in double quotes where it has a comma; of a matrix NAME[:,j], NAME[:,i:j] or NAME (all columns), counted
    from 0. In text without a line of names the matrix is called data.
    """
    from . import identifying

    settings = {"order": order, "block_rows": block_rows, "faults": faults, "healthy_until": healthy_until}
    known = identifying.Known(**settings, healthy=healthy, noise_level=noise_level, operating_point=operating_point, dt=dt, gaps=gaps)
    return identifying.run(data, known, inputs=inputs or [], outputs=outputs or [], out=out, as_json=json, scheduler=scheduler)


@_command()
def monitor(
    model: Annotated[
        str, typer.Argument(metavar="MODEL", show_default=False, help="The model.json of identify, its folder, or a saved monitor.")
    ],
    inputs: Annotated[
        list[str] | None, typer.Option("--inputs", metavar="NAME,...", help="Input columns.", show_default="as in the model's file")
    ] = None,
    outputs: Annotated[
        list[str] | None, typer.Option("--outputs", metavar="NAME,...", help="Output columns.", show_default="as in the model's file")
    ] = None,
    healthy: Annotated[
        str | None,
        typer.Option("--healthy", metavar="FILE", help="A record without fault to calibrate by.", show_default="the model's own"),
    ] = None,
    healthy_until: Annotated[
        int | None,
        typer.Option(
            metavar="K", parser=number(int, 1, 10000), help="Instead: the first K samples of the stream are one.", show_default=False
        ),
    ] = None,
    follow: Annotated[
        str | None, typer.Option("--follow", metavar="FILE", help="Watch a file that grows.", show_default="standard input")
    ] = None,
    idle: Annotated[
        float | None,
        typer.Option(metavar="SECONDS", parser=number(float, 0, 60), help="Stop when nothing came for so long.", show_default="never"),
    ] = None,
    level: Annotated[
        float | None,
        typer.Option(
            metavar="RATE",
            parser=number(float, 0, 1e-4),
            help="False alarms a sample, all tests together.",
            show_default="0.0001, or as saved",
        ),
    ] = None,
    window: Annotated[
        int | None,
        typer.Option(metavar="K", parser=number(int, 2, 20), help="Samples of the chi-square test.", show_default="20, or as in MODEL"),
    ] = None,
    save: Annotated[
        Path | None,
        typer.Option(
            metavar="FILE", help="Write the monitor there, every minute and at the end: a MODEL that goes on.", show_default=False
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Watch a plant: a model against a stream.

    Lines of a CSV table with a line of names come from standard input or a growing file; an empty field is a missing sample. Each alarm is
    a line as it comes, with --json a JSON object; the last is the summary. Without --healthy the samples of MODEL's own record that were
    stated to be healthy say what is usual, else those before its first onset, else all. Exit 0 at the end, whatever the alarms.
    """
    from . import monitoring

    watching = monitoring.Watching(healthy, healthy_until, follow, idle, level, window, save)
    return monitoring.run(model, watching, inputs=inputs or [], outputs=outputs or [], as_json=json)


@_command("monte-carlo")
def monte_carlo(
    out: Annotated[Path, typer.Option(metavar="DIR", show_default=False, help="Write tables, figures and all cases there.")],
    systems: Annotated[
        int, typer.Option(metavar="K", parser=number(int, 1, 100), help="Random systems, a quarter each with 0, 1, 2, 3 zeros.")
    ] = 100,
    samples: Annotated[int, typer.Option(metavar="K", parser=number(int, 1, 1001), help="Samples of each record.")] = 1001,
    jobs: Annotated[
        int | None,
        typer.Option(metavar="K", parser=jobs_number, help="Processes at a time.", show_default="as many cores as are worth it"),
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Work on the Dask cluster with this scheduler instead.", show_default=False)
    ] = None,
    dask: Annotated[str | None, typer.Option(hidden=True)] = None,  # the name that it had
    seed: Annotated[
        int, typer.Option(metavar="K", parser=number(int, 0, 1907), help="Equal seeds give equal results, whoever does the work.")
    ] = 1907,
    resume: Annotated[bool, typer.Option("--resume", help="Go on with what an unfinished run has kept in DIR, if one has.")] = False,
    json: Json = False,
) -> int:
    """Repeat the paper's Monte Carlo study.

    It is run as published, with its vacuous cases marked, and as corrected, each with the true and with an identified model.
    Each case is kept in DIR as it comes: --resume goes on where a run was stopped, and ends with the same files.
    DIR may hold what an earlier run wrote, which is replaced; a file of the same name that is not ours is never touched, but refused.
    """
    from . import studying

    return studying.run(
        systems=systems, samples=samples, jobs=jobs, scheduler=scheduler or dask, seed=seed, out=out, resume=resume, as_json=json
    )


_command()(audit)
_command()(report)


@_command()
def examples(
    folder: Annotated[Path | None, typer.Argument(metavar="[DIR]", show_default=False, help="Copy them there.")] = None,
    json: Json = False,
) -> int:
    """List or copy the packaged examples.

    They are systems, experiments and claims; into a folder goes a small record of faulty data, too.
    """
    from . import example_listing

    return example_listing.run(folder, as_json=json)
