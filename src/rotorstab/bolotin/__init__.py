"""Bolotin's method, the paper's: boundary frequencies, regions, and Hill's determinant."""
