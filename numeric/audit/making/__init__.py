"""How the vectors are computed, by the exact branch; bounds by `conditioning` and `residual_conditioning`.

all_vectors      every file; `python -m faultspace.numeric.audit.making --out DIR` writes them
fault_records, trouble_vectors    those of faults, and those of each kind of trouble
planting         rational matrices and systems from a seed, and bounds rounded up
"""
