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
from ..base.messages import say
from .claim_commands import check, claim, conjecture, report, verify
from .failures import BAD_INPUT, INTERRUPTED, STOPPED, Terminated, asks_report, guarded, terminable
from .option_types import Expected, Floats, Json, Language, OneSystem, Plain, Scheduler, in_our_words, jobs_number, number

Given = ParamSpec("Given")

app = typer.Typer(
    name="faultspace",
    help="Exact verdicts on the claims of a paper about systems with additive faults, and exact answers about your own system.",
    epilog="A SYSTEM is a JSON file, - for standard input, or example:NAME (see: faultspace examples). "
    "Exit codes: 0 answered as expected, 1 not as expected, 2 bad input, 3 from check: verified under an assumption that is printed, "
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
def _top(context: typer.Context, version: Annotated[bool, typer.Option("--version", help="Print the version and stop.")] = False) -> None:
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


for _of_claims in (verify, check, claim, conjecture):
    _command()(_of_claims)


@_command()
def inspect(
    system: Annotated[list[str], typer.Argument(metavar="SYSTEM...", help="System files, - or example:NAME.")],
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
    expect: Annotated[Expected | None, typer.Option(help="Exit 1 unless this is the answer.")] = None,
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
    experiment: Annotated[list[str], typer.Argument(metavar="EXPERIMENT...", help="Experiment files, - or example:NAME.")],
    json: Json = False,
    floats_exactly: Floats = False,
) -> int:
    """Tell what identification converges to.

    The limits of PI-MOESP and PO-MOESP are exact, for filtered white noise as input and fault. An experiment is a system with B and D, the
    block rows "s" and "past", and "u_filter", "v_filter", "w_filter": matrices over lag.

    Example: faultspace limit example:fault-follows-input
    """
    from . import limiting

    return limiting.run(experiment, as_json=json, floats_exactly=floats_exactly)


@_command()
def identify(
    data: Annotated[
        list[str],
        typer.Argument(
            metavar="DATA...",
            help="A CSV, Parquet, NPZ, NPY or MAT file of measurements, or a folder of Parquet files, which are one record; several are "
            "experiments of one plant.",
        ),
    ],
    inputs: Annotated[list[str] | None, typer.Option("--inputs", metavar="NAME,...", help="Input channels; may be repeated.")] = None,
    outputs: Annotated[list[str] | None, typer.Option("--outputs", metavar="NAME,...", help="Output channels.")] = None,
    out: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write model, fault space, signal, plots there; only our own files are replaced.")
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
        int | None, typer.Option(metavar="K", parser=number(int, 1, 1000), help="The first K samples are without fault: count beyond them.")
    ] = None,
    healthy: Annotated[
        str | None,
        typer.Option("--healthy", metavar="FILE", help="A record without fault, of the same channels: model, means and noise from it."),
    ] = None,
    noise_level: Annotated[
        list[float] | None,
        typer.Option(
            metavar="SIGMA", parser=number(float, 0, 0.1), help="Deviation of the sensors' noise, once or once an output, in its units."
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
        typer.Option(metavar="SECONDS", parser=number(float, 0, 0.1), help="Time from sample to sample; the model's file keeps it."),
    ] = None,
    scheduler: Annotated[
        str | None, typer.Option(metavar="ADDRESS", help="Have the Dask cluster with this scheduler share the work of long records.")
    ] = None,
    verbose: Annotated[bool, typer.Option("-v", "--verbose", help="Print all evidence, too.")] = False,
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

    level = noise_level[0] if noise_level and len(noise_level) == 1 else noise_level or None
    known: dict[str, Any] = {"order": order, "block_rows": block_rows, "n_v": faults, "healthy": healthy_until}
    known |= {"noise_level": level, "operating_point": operating_point, "dt": dt}
    told: dict[str, Any] = {"inputs": inputs or [], "outputs": outputs or [], "gaps": gaps, "scheduler": scheduler, "verbose": verbose}
    return identifying.run(data, known, healthy=healthy, out=out, as_json=json, **told)


@_command()
def monitor(
    model: Annotated[str, typer.Argument(metavar="MODEL", help="The model.json of identify, its folder, or a saved monitor.")],
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
        int | None, typer.Option(metavar="K", parser=number(int, 1, 10000), help="Instead: the first K samples of the stream are one.")
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
        Path | None, typer.Option(metavar="FILE", help="Write the monitor there, every minute and at the end: a MODEL that goes on.")
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
    out: Annotated[Path, typer.Option(metavar="DIR", help="Write tables, figures and all cases there.")],
    systems: Annotated[
        int, typer.Option(metavar="K", parser=number(int, 1, 100), help="Random systems, a quarter each with 0, 1, 2, 3 zeros.")
    ] = 100,
    samples: Annotated[int, typer.Option(metavar="K", parser=number(int, 1, 1001), help="Samples of each record.")] = 1001,
    jobs: Annotated[
        int | None, typer.Option(metavar="K", parser=jobs_number, help="Processes at a time.", show_default="as many cores as are worth it")
    ] = None,
    scheduler: Scheduler = None,
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


@_command()
def audit(
    adapter: Annotated[
        str | None, typer.Argument(metavar="[ADAPTER]", help="module:object, file.py:object, module or file; else our own code.")
    ] = None,
    command: Annotated[str | None, typer.Option("--exec", metavar="CMD", help="A program that speaks JSON lines instead.")] = None,
    peer: Annotated[str | None, typer.Option(metavar="NAME", help="A published package instead; see --peers.")] = None,
    result: Annotated[Path | None, typer.Option("--from", metavar="FILE", help="Report what --json printed before; nothing runs.")] = None,
    peers: Annotated[bool, typer.Option("--peers", help="List the packages that adapters come for, and what each needs.")] = False,
    listed: Annotated[bool, typer.Option("--list", help="List the checks that would be asked, and ask none.")] = False,
    check: Annotated[
        list[str] | None,
        typer.Option(
            "--check", metavar="NAME", help="Only these: SLUG, SLUG[VECTOR] or SLUG[VECTOR]-FUNCTION, * and ? for anything; repeatable."
        ),
    ] = None,
    seed: Annotated[int, typer.Option(metavar="N", parser=number(int, 0, 0), help="Draw the vectors of all kinds of trouble anew.")] = 0,
    quick: Annotated[bool, typer.Option("--quick", help="Of every check one vector, and all kinds of trouble.")] = False,
    expected: Annotated[
        Path | None, typer.Option("--expected-failures", metavar="FILE", help="Known failures, a line each, NAME: REASON.")
    ] = None,
    junit: Annotated[Path | None, typer.Option(metavar="FILE", help="Write JUnit's XML there, too.")] = None,
    badge: Annotated[Path | None, typer.Option(metavar="FILE", help="Write a badge there, too: .svg, or .json for shields.io.")] = None,
    reproduce: Annotated[
        str | None, typer.Option(metavar="NAME", help="Print a script that shows this check without faultspace, and ask none.")
    ] = None,
    language: Annotated[Language, typer.Option(help="Of the script.")] = Language.python,
    export: Annotated[
        Path | None, typer.Option(metavar="DIR", help="Write the checks as JSON for use without faultspace, and ask none.")
    ] = None,
    timeout: Annotated[
        float,
        typer.Option(metavar="SECONDS", parser=number(float, 0.1, 60, 1e7), help="How long a check, with --exec an answer, may take."),
    ] = 60.0,
    memory: Annotated[
        float, typer.Option(metavar="GIB", parser=number(float, 0.5, 4, 1e6), help="How much memory a check may take.")
    ] = 4.0,
    environment: Annotated[
        list[str] | None, typer.Option("--env", metavar="NAME", help="It sees this variable of the environment, too; * is all; repeatable.")
    ] = None,
    quiet: Annotated[bool, typer.Option("-q", "--quiet", help="Print a line a cause, and the count.")] = False,
    verbose: Annotated[int, typer.Option("-v", "--verbose", count=True, help="Print a row a slug, too; -vv: a row a check.")] = 0,
    json: Json = False,
) -> int:
    """Put an implementation through checks.

    The answers are known exactly; exit 1 if a must is not met. The adapter has some of: identify, residual, window_ranks, fault_dimension,
    fault_space, reconstruct, structure, count_faults, identified_fault_space. It runs in a process of
    its own: what hangs, crashes, forks or takes too much memory is one failure, and the next check goes on.

    Example: faultspace audit mine.py --quick
    """
    from . import auditing

    subject = auditing.Asked(adapter, command, peer, tuple(check or ()), seed, quick, timeout, memory, tuple(environment or ()))
    if peers:
        return auditing.list_peers(as_json=json)
    if listed:
        return auditing.list_checks(subject, as_json=json)
    if export is not None:
        return auditing.export(subject, export)
    if reproduce is not None:
        return auditing.reproduce(subject, reproduce, language.value)
    found = auditing.performed(subject, expected) if result is None else auditing.saved(result, subject, expected)
    return auditing.report(found, junit=junit, badge=badge, detail=-1 if quiet else verbose, as_json=json)


_command()(report)


@_command()
def examples(folder: Annotated[Path | None, typer.Argument(metavar="[DIR]", help="Copy them there.")] = None, json: Json = False) -> int:
    """List or copy the packaged examples.

    They are systems, experiments and claims; into a folder goes a small record of faulty data, too.
    """
    from . import example_listing

    return example_listing.run(folder, as_json=json)
