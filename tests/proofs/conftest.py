"""What several tests of Rocq's theory need."""

from __future__ import annotations

from pathlib import Path

import pytest

from faultspace.proofs.rocq.build import NoRocq, compiled_theory


@pytest.fixture
def theory() -> Path:
    """Provides the compiled theory; skips, with the reason, where Rocq or MathComp is missing."""
    try:
        return compiled_theory()
    except NoRocq as reason:
        pytest.skip(str(reason))
