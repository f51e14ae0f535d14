from . import errors as errors
from . import exact as exact
from . import numeric as numeric
from . import proofs as proofs
from .exact.limits.moesp import limit as limit
from .exact.structure.behavior import compare as compare
from .exact.structure.record import analyze as analyze
from .exact.system.systems import System as System
from .numeric.audit.running import audit as audit
from .numeric.data.files import read_record as read_record
from .numeric.plant.monitor.monitoring import Monitor as Monitor
from .numeric.plant.pipeline import identify as identify
from .numeric.study.studies import monte_carlo as monte_carlo
from .proofs.brought.claiming import claim as claim
from .proofs.brought.conjecturing import conjecture as conjecture
from .proofs.checking import check as check
from .proofs.trust.certifying import certify as certify
from .proofs.verification import verify as verify
from .review.reporting import report as report

__version__: str
