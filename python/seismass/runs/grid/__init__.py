"""Scenes described by columns in place of objects."""
