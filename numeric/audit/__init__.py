"""The audit: any numeric implementation against exact ground truth. The one room where the exact and the numeric branch meet.

    running.audit                     records of all checks on what an implementation offers
    running.parametrize_with_checks   the same as pytest cases
    adapter, subprocess_adapter       what an implementation is: a few optional functions, in Python or behind JSON lines
    reference                         our own numeric branch as an implementation
    records                           Check, Measurement, Record, and `perform`
    vectors, vector_files             exact systems, data, answers and derived bounds as JSON; `python -m faultspace.numeric.audit.vectors`
    making_vectors                    how they are computed, by the exact branch; bounds by `conditioning` and `residual_conditioning`

Checks: identification_checks, fault_checks, structure_checks, consistency_checks, refusal_checks, good_manners.
Comparisons are of what no state basis changes, in exact arithmetic where the answer allows (`exact_comparison`).
"""
