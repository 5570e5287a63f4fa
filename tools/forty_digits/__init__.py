"""Plane scenes solved with forty digits, to hold the kernel against: `python tools/plane_forty_digits.py`.

It uses Python's decimal numbers and nothing of the package.
"""
