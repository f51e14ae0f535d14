"""Questions with exact answers: systems, data, answers and derived bounds, as JSON that any language can read.

rationals            rational matrices, and the one way in which they become floats
exact_comparison     float answers read as rationals, and compared with the truth
fault_vectors        residuals of faults, and the same records in other units, bases and orders
recipe_vectors       long records, of which the recipe is kept
shipped_vectors      the vectors of systems and records without fault, and the reader of all that is in data/
"""
