"""The contestants of the work-precision benchmark, one file each; `contestants.base` says what one is."""
