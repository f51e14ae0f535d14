"""This is Octave's part of the identification benchmark: the control package's functions and the author's own, on the record in the folder.

packaged_script     moen4 or moesp of the control package
author_script       pi_moesp.m from a clone of ggleizer/fault_id
octave_command, octave_missing, octave_version

A script warms up, notes the peak of the resident memory as the Python methods do, repeats a quick call and writes the same line.
"""

from __future__ import annotations

import shutil
import subprocess
from functools import cache
from pathlib import Path

from benchmarks.identification_data import ORDER, Setting

PROGRAM = "octave-cli"

READING = """
fid = fopen ("y.bin"); y = fread (fid, [%(p)d, Inf], "double")'; fclose (fid);
fid = fopen ("u.bin"); u = fread (fid, [%(n_u)d, Inf], "double")'; fclose (fid);
"""

MEASURING = """
function kb = status (name)
  words = regexp (fileread ("/proc/self/status"), [name ":\\\\s+(\\\\d+)"], "tokens");
  kb = str2double (words{1}{1});
end
function text = table (M)
  lines = cell (1, rows (M));
  for i = 1:rows (M)
    lines{i} = ["[" strjoin(strsplit (sprintf ("%%.17g ", M(i,:))(1:end-1), " "), ",") "]"];
  end
  text = ["[" strjoin(lines, ",") "]"];
end
call (y(1:2000,:), u(1:2000,:));
fid = fopen ("/proc/self/clear_refs", "w"); fputs (fid, "5"); fclose (fid);
floor_kb = status ("VmRSS");
start = cputime (); [A, B, C, D] = call (y, u); seconds = cputime () - start;
peak_kb = status ("VmHWM");
for k = 2:5
  if seconds > 1, break; end
  start = cputime (); call (y, u); seconds = min (seconds, cputime () - start);
end
printf ("RESULT {\\"seconds\\": %%.9g, \\"megabytes\\": %%.9g, \\"A\\": %%s, \\"B\\": %%s, \\"C\\": %%s, \\"D\\": %%s}\\n", ...
        seconds, max (peak_kb - floor_kb, 0) / 1024, table (A), table (B), table (C), table (D));
"""

PACKAGED = """
pkg load control
function [A, B, C, D] = call (y, u)
  found = %(name)s (iddata (y, u, 1), %(order)d, "s", %(s)d);
  [A, B, C, D] = ssdata (found);
end
"""

# MATLAB's qr (X, "econ") is Octave's qr (X, 0); Q, which the author asks for and drops, is not formed.
AUTHORS = """
addpath ("%(folder)s");
function [Q, R] = qr (X, varargin)
  if isargout (1)
    [Q, R] = builtin ("qr", X, 0);
  else
    R = builtin ("qr", X, 0); Q = [];
  end
end
function [A, B, C, D] = call (y, u)
  [A, B, C, D] = pi_moesp (u, y, %(s)d, %(order)d);
end
"""


def _script(text: str, setting: Setting, **words: object) -> str:
    values = {"p": setting.p, "n_u": setting.n_u, "s": setting.block_rows, "order": ORDER} | words
    return "1;\n" + (text + READING + MEASURING) % values


def packaged_script(name: str, setting: Setting) -> str:
    """The program calls moen4 or moesp."""
    return _script(PACKAGED, setting, name=name)


def author_script(setting: Setting, fault_id: Path) -> str:
    """The program calls pi_moesp.m as it stands in the clone."""
    return _script(AUTHORS, setting, folder=fault_id.resolve())


def octave_command(script: str) -> list[str]:
    """This is the command that runs the script."""
    return [PROGRAM, "--no-gui", "--quiet", "--norc", "--eval", script]


@cache
def octave_missing() -> str | None:
    """Return why the scripts cannot run here, or None."""
    if shutil.which(PROGRAM) is None:
        return f"the program {PROGRAM} is not installed"
    loaded = subprocess.run(octave_command("pkg load control"), capture_output=True, check=False, stdin=subprocess.DEVNULL)
    return None if loaded.returncode == 0 else "Octave has no package control"


@cache
def octave_version() -> str:
    """It names the versions of Octave and of its control package."""
    asked = 'd = pkg ("describe", "control"); printf ("Octave %s, control %s", version (), d{1}.version)'
    run = subprocess.run(octave_command(asked), capture_output=True, check=False, stdin=subprocess.DEVNULL, text=True)
    return run.stdout.strip() or "Octave"
