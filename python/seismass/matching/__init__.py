"""Spectral matching."""
