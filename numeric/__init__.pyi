from .bound.information_bound import cramer_rao as cramer_rao
from .bound.spectra import Spectra as Spectra
from .count.rank_gap import FaultDimension as FaultDimension
from .count.rank_gap import fault_dimension as fault_dimension
from .data.files import read_record as read_record
from .data.records import Record as Record
from .data.sources import record_from as record_from
from .model.asymptotic_likelihood import arx_reduction as arx_reduction
from .model.asymptotic_likelihood import arx_reduction_experiments as arx_reduction_experiments
from .model.models import StateSpaceModel as StateSpaceModel
from .model.moesp_model import MoespModel as MoespModel
from .model.moesp_model import OrderUndecided as OrderUndecided
from .model.order_evidence import OrderEvidence as OrderEvidence
from .model.past_inputs import pi_moesp as pi_moesp
from .model.past_inputs import pi_moesp_experiments as pi_moesp_experiments
from .model.past_outputs import po_moesp as po_moesp
from .model.reduced_model import ReducedModel as ReducedModel
from .model.residuals import ResidualSignal as ResidualSignal
from .model.residuals import residual as residual
from .model.uncertainty import Uncertainty as Uncertainty
from .pipeline import identify as identify
from .result import Identification as Identification
from .signal.reconstruction import Reconstruction as Reconstruction
from .signal.reconstruction import reconstruct_fault as reconstruct_fault
from .space.by_ranks import fault_space as fault_space
from .space.result import FaultSpaceEstimate as FaultSpaceEstimate

__all__: list[str]
