"""Faults in linear systems: exact answers about a system, a method for measured data, and verdicts with certificates on a paper's claims.

    import faultspace as fs

System, analyze, compare, limit    an exact system; its structure; whether two are equivalent; what subspace identification converges to
certify, check, verify             a certificate of what is so; the checker's word on it; the claims of the ledger decided anew
claim                              a claim of your own about such systems: refuted by a counterexample, proved, or neither
conjecture                         the sharpest bounds on a quantity of such systems by others that nothing that was tried refutes
identify, read_record              from measured data to model, number of faults, fault space and fault signal; a record from a file
Monitor                            a model against a stream of samples: alarms at a stated rate of false ones
monte_carlo, audit                 the paper's study; anyone's implementation against exact ground truth
report                             the page that a reviewer reads, of a run of verify
errors                             the errors of bad input
__version__                        the one place where the version is written; the build reads it from here

The rooms behind these names are `faultspace.exact`, `faultspace.numeric` and `faultspace.proofs`. Keys in brackets, [G25] say, are those of
BIBLIOGRAPHY.md; the paper is [G25]. A name is loaded when it is first asked for; the names and where they live are listed in the file
`__init__.pyi` beside this one.
"""

import lazy_loader

from . import errors as errors

__version__ = "0.1.0"

__getattr__, _, __all__ = lazy_loader.attach_stub(__name__, __file__)


def __dir__() -> list[str]:
    return [*__all__, "__version__"]
