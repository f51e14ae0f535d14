from .count.rank_gap import FaultDimension as FaultDimension
from .count.rank_gap import fault_dimension as fault_dimension
from .data.files import read_record as read_record
from .data.records import Record as Record
from .data.sources import record_from as record_from
from .model.models import StateSpaceModel as StateSpaceModel
from .model.past_inputs import MoespModel as MoespModel
from .model.past_inputs import OrderUndecided as OrderUndecided
from .model.past_inputs import pi_moesp as pi_moesp
from .model.past_inputs import pi_moesp_experiments as pi_moesp_experiments
from .model.past_outputs import po_moesp as po_moesp
from .model.residuals import ResidualSignal as ResidualSignal
from .model.residuals import residual as residual
from .pipeline import identify as identify
from .result import Identification as Identification
from .rows.counting import FaultCount as FaultCount
from .rows.counting import count_faults as count_faults
from .rows.space import fault_space_by_rows as fault_space_by_rows
from .signal.reconstruction import Reconstruction as Reconstruction
from .signal.reconstruction import reconstruct_fault as reconstruct_fault
from .space.by_ranks import fault_space as fault_space
from .space.result import FaultSpaceEstimate as FaultSpaceEstimate

__all__: list[str]
