"""What `performance.py` measures, a file per section of its page: each has `section(quick=...)`."""
