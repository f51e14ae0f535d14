"""The bootstrap of kernel rows finds by how much the ratios of rows that are laws exceed what they should be."""

from __future__ import annotations

from scipy.special import chdtri, fdtrc

from faultspace.numeric.method.rows import law_tests as laws
from faultspace.numeric.method.rows.evidence import Evidence
from tests.numeric.planted import joint_record
from tests.numeric.test_rows import plant


def test_the_bootstrap_finds_the_misfit() -> None:
    """Under laws a ratio over the mean of four drawn ones is about F(f, 4 f), of 12 degrees of freedom and more: twice 0.018 is the chance
    that one of the two is beyond the half of SUFFICES, and that of two records of three being refused three times its square, 0.004."""
    freedom = 12
    refused = 2 * float(fdtrc(freedom, 4 * freedom, chdtri(freedom, laws.SUFFICES / 2) / freedom))
    assert 3 * refused**2 < 0.005
    held = []
    for seed in (20, 21, 22):
        y, u = joint_record(plant(seed, 3, 1), seed, 500, 40)
        evidence = Evidence([(y, u)], 3)
        assert (evidence.data.degree - evidence.order) * evidence.data.moments.channels >= freedom
        quick = laws.tested(evidence, 2)
        careful = laws.bootstrapped(evidence, quick, 4)
        held.append(quick.holds and careful.holds)
        assert quick.sphericity is not None and careful.sphericity is not None
        assert careful.flatness != quick.flatness and careful.sphericity.level != quick.sphericity.level
    assert held.count(True) >= 2, held
    many = laws.tested(evidence, 3)
    assert many.holds is False and laws.bootstrapped(evidence, many, 4) is many
