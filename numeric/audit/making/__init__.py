"""How the vectors are computed, by the exact branch; bounds by `conditioning` and `residual_conditioning`.

all_vectors      every file; `python -m faultspace.numeric.audit.making --out DIR` writes them
fault_records    those of faults
drawing          rational matrices from a seed, and bounds rounded up
"""
