"""The reference method in floats: data in; model, number of faults, fault space and fault signal out.

    from faultspace.numeric import identify, pi_moesp, residual, fault_dimension, fault_space, reconstruct_fault

identify              the whole chain on arrays, data frames, a file, pieces or a record; an Identification
read_record           a record from a file; record_from: from whatever holds one; read_stretches: the parts of one with missing samples
doubts                what a record gives reason to doubt, with the evidence, what it does to the answer, and what to do
pi_moesp              A, B, C, D from faulty data, past inputs as instruments; pi_moesp_experiments: from several experiments
po_moesp              with past outputs, for comparison
residual              r = y - (response of the model to u), the initial state fitted or given
fault_dimension       how many faults a residual shows, or "undecided"
fault_space           all fault columns [f; g] that explain the residual
fault_onset           the samples from which on a residual is another one, with intervals
isolate               which single sensor or actuator lies in a fault space; isolate_shift: which explains a shift of the mean
reconstruct_fault     the fault signal for a chosen pair (F, G)

The audit's reference calls these very functions, and so does `identify` on records without noise and, but for the model, beside samples
that are stated to be healthy. On all others it calls estimators that come nearer to what the data allow:

arx_reduction         A, B, C, D under strong coloured faults, with standard errors; arx_reduction_experiments: from several experiments
cramer_rao            the least standard deviations that any unbiased estimate of A, B, C, D can have
fault_space_bound     the least error that any unbiased estimate of the fault space can have
count_faults          how many faults act on outputs and inputs, without a model
changes_since_healthy what has changed since a healthy part, whatever its rank; changes_within: the second half against the first
fault_space_by_rows   all fault columns, from the laws that outputs and inputs obey; identified_fault_space: the model's error in its angle

Monitor               a model against a stream of samples: alarms at a stated rate of false ones

The folders, each of which imports those below it only:

audit         anyone's implementation against exact ground truth; the one folder that imports the exact branch too
study         the paper's example and its Monte Carlo study; the Cramer-Rao bounds, and how far rounding may carry the answers
plant         what a plant's record needs: the steps of identify, samples without fault, changes, doubts, a monitor, what is told
method        arrays in, records out: model, ranks of a residual, rows of outputs and inputs, fault space, fault signal
data          records, readers, checks of what comes in

Arrays are time-major, y before u. The room imports numpy and scipy and never `faultspace.exact`, so that the exact results can judge it. A
name is loaded when it is first asked for; `__init__.pyi` lists them with their modules.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

if __name__ == "numeric":
    raise ImportError("this folder is no package of its own: write 'import faultspace.numeric'")
