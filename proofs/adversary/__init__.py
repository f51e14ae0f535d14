"""An adversary for what no theorem says: searches that want a statement to be false, over continuous families.

    attacks      the records: an Attack, the Witness that it looks for, the Trial that it ends in
    following    floats: starts, descents, changes of sign along paths between points
    rounding     from a float to a rational point of the zero set, exactly
    engine       one attack from its starts to its end
    float_limits the limits of PI-MOESP and PO-MOESP in floats, for speed; nothing is decided by them
    limit_attacks, limit_catalogue, feedback_attacks   experiments and their limits
    structure_attacks, pair_attacks   systems, and pairs of fault matrices
    catalogue    all attacks
    witnesses    what an attack has found, once the checker has accepted it
    results      the file of results: written by a run, checked again by `verify`
    attacking    what a run of `verify` does with them

A random system is no adversary: what fails on a hypersurface is never met by samples, but a determinant changes its sign across it. A
sign that differs between two exact points of a connected family proves a zero between them; a rational zero gives certificates as well.
"""
