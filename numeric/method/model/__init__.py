"""From data to the system matrices and the residual of the model."""
