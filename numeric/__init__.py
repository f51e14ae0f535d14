"""The reference method in floats: data in; system matrices, fault dimension, fault space and fault signal out.

    pi_moesp.pi_moesp                  A, B, C, D from faulty data, past inputs as instruments; chunks, several experiments
    compression                        what of the data the estimate needs, without ever holding the Hankel matrix; mergeable
    residuals.residual                 r = y - (response of the model to u), the initial state fitted
    fault_dimension.fault_dimension    how many faults, or an honest "undecided"
    fault_space.fault_space            all fault columns [f; g] that explain the residual
    reconstruction.reconstruct_fault   the fault signal for a chosen pair (F, G)
    distances                          between subspaces and between models
    po_moesp                           the past-output variant, kept for comparison

Arrays are time-major, y before u. The room imports numpy and scipy and never `faultspace.exact`, so that the exact results can judge it.
"""

if __name__ == "numeric":
    raise ImportError("this folder is no package of its own: write 'import faultspace.numeric'")
