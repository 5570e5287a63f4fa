"""What the runs of a campaign will take on this machine, from a few of them."""

from __future__ import annotations

import io
import time
from typing import Final, NamedTuple

from seismass.campaign.campaign import CampaignRuns

SAMPLE: Final = 256
"""Runs solved at the beginning, in the middle and at the end of the campaign."""


class Estimate(NamedTuple):
    """Estimate for all runs: seconds by the threads of this process, and bytes of the parts, which compress better as
    they grow.
    """

    seconds: float
    bytes: float


def estimated(campaign: CampaignRuns, *, threads: int | None = None) -> Estimate:
    """Return the estimate for all runs of a campaign, from three stretches of it."""
    size = min(SAMPLE, campaign.part_runs)
    solved, spent, written = 0, 0.0, 0
    for part in sorted({1, (campaign.parts + 1) // 2, campaign.parts}):
        runs = campaign.runs_of(part)[:size]
        began = time.perf_counter()
        frame = campaign.solve_runs(runs, threads=threads)
        spent += time.perf_counter() - began
        solved += len(runs)
        buffer = io.BytesIO()
        frame.write_parquet(buffer, compression="zstd")
        written += buffer.tell()
    return Estimate(campaign.total * spent / solved, campaign.total * written / solved)
