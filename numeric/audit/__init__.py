"""The audit: any numeric implementation against exact ground truth. The one folder where the exact and the numeric branch meet.

    running.audit                     what all checks say of an implementation: an Audit (`outcome`)
    running.parametrize_with_checks   the same as pytest cases
    catalogue, subjects               every check that there is; who is put through them, and where it runs
    adapter, subprocess_adapter       what an implementation is: a few optional functions, in Python or behind JSON lines
    reference                         our own numeric branch as an implementation
    records                           Check, Measurement, CheckResult, and `perform`
    vectors, fault_vectors, recipe_vectors
                                      exact systems, data, answers and derived bounds as JSON; `python -m faultspace.numeric.audit.vectors`
    making_vectors, making_fault_vectors
                                      how they are computed, by the exact branch; bounds by `conditioning` and `residual_conditioning`
    rationals, drawing                rational matrices, their rounding, and how they are drawn

Checks: identification_checks, fault_checks, excitation_checks, structure_checks, consistency_checks, refusal_checks, manners_checks,
growth_checks.
Comparisons are of what no state basis changes, in exact arithmetic where the answer allows (`exact_comparison`).
"""
