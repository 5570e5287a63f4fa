"""Factors of motions by a target alone: mean squares, one period, selection by shape."""
