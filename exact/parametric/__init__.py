"""Systems with indeterminate entries: what holds for almost all of them, and on which strata it does not."""
