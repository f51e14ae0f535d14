"""The reference method in floats: data in; system matrices, fault dimension, fault space and fault signal out.

From data to model
    pi_moesp.pi_moesp                  A, B, C, D from faulty data, past inputs as instruments; several experiments; an order or none
    pi_moesp_chunks                    the same on a record read in pieces
    compression                        what of the data the estimate needs, without ever holding the Hankel matrix; mergeable; by
                                       displacement_gram or sequential_qr
    input_matrices                     B, D and x0 for known A, C
    models, distances                  state-space models; distances between subspaces and between models
    po_moesp                           the past-output variant, kept for comparison

From residual to faults
    residuals.residual                 r = y - (response of the model to u), the initial state fitted
    fault_dimension.fault_dimension    how many faults, or "undecided": hankel_ranks where r is exact to rounding, kernel_row_test in noise
    fault_against_healthy              how many beyond what a record without faults shows (healthy_reference), and the direction of one
    fault_space.fault_space            all fault columns [f; g] that explain the residual; noisy_fault_space by likelihood or least squares,
                                       fault_space_uncertainty how far off; fault_space_error the rounding
    toeplitz_factorisation             the published way to the fault space, for comparison
    reconstruction.reconstruct_fault   the fault signal for a chosen pair (F, G); fault_zeros what limits it

How far rounding may carry the answers: conditioning, residual_conditioning. Pictures: plots, study_plots.

The paper's experiments
    example_v                          its example
    monte_carlo.monte_carlo              its study, as published and as corrected; study_systems, study_experiments,
                                       study_cases, study_workers

The audit (numeric/audit, which imports the exact branch too): anyone's implementation against exact ground truth.

Inside: input_checks, residual_arguments, residual_windows, kernel_likelihood, kernel_basis_likelihood, joint_kernel_basis,
fault_space_estimate, tapered_moments, largest_root.

Arrays are time-major, y before u. The room imports numpy and scipy and never `faultspace.exact`, so that the exact results can judge it.
"""

if __name__ == "numeric":
    raise ImportError("this folder is no package of its own: write 'import faultspace.numeric'")
