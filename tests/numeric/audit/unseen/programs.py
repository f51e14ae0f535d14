"""Programs that answer right and misbehave: they hang, fork, eat memory, flood their streams, or answer another question.

Whoever wrote them had not read how the audit runs programs. Each offers `window_ranks` alone, answered by the reference, and misbehaves at
its second question, the first one after `functions`. All end by themselves within a minute, whatever the audit does.

Program     slug, what is wrong, and the source that runs before each answer (`number` counts them, from 1)
PROGRAMS    all of them
source      a whole program, for `python FILE`
"""

from __future__ import annotations

from dataclasses import dataclass

LIVES = 40  # seconds, for what would live for ever: a test that fails must not leave it behind


@dataclass(frozen=True)
class Program:
    """This is a program that misbehaves before it answers the question of that number, or after."""

    name: str
    wrong: str
    before: str = "pass"
    after: str = "pass"
    answer: str = "answer"


_FRAME = """
import json, os, signal, subprocess, sys, time
from faultspace.numeric.audit import reference
import numpy as np

END = time.monotonic() + {lives}
held = []

def more():
    return time.monotonic() < END

def number_in(entry):
    return float(entry) if entry is not None else float("nan")

def answered(question):
    if question["call"] == "functions":
        return {{"functions": ["window_ranks"]}}
    try:
        r = np.array([[number_in(one) for one in row] for row in question["r"]], dtype=float)
        return {{"ranks": [int(one) for one in reference.window_ranks(r, question["windows"])]}}
    except (ValueError, ArithmeticError) as error:
        return {{"refused": str(error)}}

number = -1
last = None
for line in sys.stdin:
    number += 1
    answer = answered(json.loads(line))
    if number >= 1:
        {before}
    told = ({answer}) if number >= 1 else answer
    if told is not None:
        print(json.dumps(told) if not isinstance(told, str) else told, flush=True)
    last = answer
    if number >= 1:
        {after}
"""


def source(program: Program) -> str:
    """Return the source of the program."""
    return _FRAME.format(
        lives=LIVES,
        before=program.before.replace("\n", "\n        "),
        after=program.after.replace("\n", "\n        "),
        answer=program.answer,
    )


PROGRAMS = (
    Program("hangs", "The program waits for ever before it answers.", "while more():\n    time.sleep(0.2)"),
    Program(
        "trickles-and-hangs",
        "The program prints a blank now and then, and never answers.",
        'while more():\n    sys.stdout.write(" ")\n    sys.stdout.flush()\n    time.sleep(0.05)',
    ),
    Program(
        "trickles-lines-and-hangs",
        "The program prints an empty line now and then, and never answers.",
        'while more():\n    print("", flush=True)\n    time.sleep(0.05)',
    ),
    Program(
        "trickles-and-eats-memory",
        "The program takes another twenty megabytes with each blank that it prints.",
        'while more() and len(held) < 400:\n    held.append(b"x" * 20_000_000)\n'
        '    sys.stdout.write(" ")\n    sys.stdout.flush()\n    time.sleep(0.02)',
    ),
    Program(
        "eats-memory-in-a-child",
        "A process that the program starts takes the memory.",
        "subprocess.run([sys.executable, '-c',"
        " 'import time\\nx=[]\\nfor k in range(400):\\n    x.append(b\"x\"*20_000_000); time.sleep(.02)'])",
    ),
    Program(
        "floods-standard-output",
        "The program prints one line that does not end.",
        'while more():\n    sys.stdout.write("x" * 1_000_000)\n    sys.stdout.flush()',
    ),
    Program(
        "floods-standard-error",
        "The program writes hundreds of megabytes of warnings.",
        'for _ in range(300):\n    sys.stderr.write("warning " * 125_000)',
    ),
    Program(
        "forks-many",
        "The program starts two hundred processes that wait.",
        "held += [subprocess.Popen(['sleep', '30']) for _ in range(200)]",
    ),
    Program(
        "forks-in-a-chain",
        "A process starts the next one and ends, again and again, in sessions of their own.",
        "if os.fork() == 0:\n    for stream in (0, 1, 2):\n        os.close(stream)\n    while more():\n"
        "        os.setsid() if os.getpid() != os.getsid(0) else None\n"
        "        time.sleep(0.1)\n        if os.fork():\n            os._exit(0)\n    os._exit(0)",
    ),
    Program(
        "leaves-a-daemon",
        "Each answer leaves a process behind, in a session of its own, whose parent is gone.",
        "if os.fork() == 0:\n    os.setsid()\n    if os.fork():\n        os._exit(0)\n"
        "    for stream in (0, 1, 2):\n        os.close(stream)\n"
        "    time.sleep(30)\n    os._exit(0)\nos.wait()",
    ),
    Program(
        "leaves-a-child",
        "Each answer leaves a process behind.",
        "held.append(subprocess.Popen(['sleep', '30'], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL))",
    ),
    Program(
        "ignores-the-end",
        "The program hangs, and ignores the signals that ask it to end.",
        "for one in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):\n    signal.signal(one, signal.SIG_IGN)\n"
        "while more():\n    time.sleep(0.2)",
    ),
    Program("stops-itself", "The program is stopped, as by control-Z.", "os.kill(os.getpid(), signal.SIGSTOP)"),
    Program(
        "closes-its-output", "The program closes its output and lives on.", "os.close(1)\nwhile more():\n    time.sleep(0.2)\nos._exit(0)"
    ),
    Program("ends-in-silence", "The program ends with exit code 0 in the place of an answer.", "os._exit(0)"),
    Program(
        "ends-after-ten", "The program ends after ten answers, as if there were no more questions.", "if number > 10:\n    os._exit(0)"
    ),
    Program("answers-the-question-before", "Each answer is that of the question before.", answer='last if number > 1 else {"ranks": [1]}'),
    Program("answers-twice", "Each answer is printed twice.", after="print(json.dumps(answer), flush=True)"),
    Program(
        "answers-half-a-line",
        "The answer lacks its last characters and its end of line.",
        "sys.stdout.write(json.dumps(answer)[:-3])\nsys.stdout.flush()\nwhile more():\n    time.sleep(0.2)\n",
    ),
    Program(
        "answers-in-another-word", "The ranks are called rank.", answer='{"rank": answer.get("ranks")} if "ranks" in answer else answer'
    ),
    Program(
        "answers-in-text",
        "The ranks are strings.",
        answer='{"ranks": [str(one) for one in answer["ranks"]]} if "ranks" in answer else answer',
    ),
    Program(
        "answers-in-fractions",
        "The ranks have a half added.",
        answer='{"ranks": [one + 0.5 for one in answer["ranks"]]} if "ranks" in answer else answer',
    ),
    Program(
        "refuses-and-answers", "Answers say both that they are refused and what they would be.", answer='{**answer, "refused": "perhaps"}'
    ),
    Program("refuses-everything", "The program declines every question.", answer='{"refused": "not today"}'),
    Program("answers-nothing", "The answer is an empty object.", answer="{}"),
    Program("answers-null", "The answer is null.", answer='"null"'),
)
