"""Fragility of slip."""
def slip_fragilities(*a, **k): raise NotImplementedError
