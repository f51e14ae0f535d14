"""Processes that an implementation leaves behind: how a test starts one, and sees that it ends.

child      source that starts one that would live for a minute, and writes its number into a file
ends       whether it is gone within seconds
"""

from __future__ import annotations

import time
from pathlib import Path

import psutil


def child(number: Path, options: str = "") -> str:
    """Return a line of source, for where `sys` is imported; `options` are further arguments of Popen."""
    started = f"subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)']{options})"
    return f"import subprocess; open({str(number)!r}, 'w').write(str({started}.pid))"


def ends(number: Path) -> bool:
    """Say whether the process of that number is gone, or goes within five seconds."""
    one = int(number.read_text())
    for _ in range(100):
        try:
            if psutil.Process(one).status() == psutil.STATUS_ZOMBIE:
                return True
        except psutil.NoSuchProcess:
            return True
        time.sleep(0.05)
    return False
