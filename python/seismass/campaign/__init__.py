"""Studies of any size as folders: runs cut into parts that are written whole, on one machine or on many.

`Campaign` describes the runs, `CampaignFolder` is what they become; `read_campaign` reads a description from a file.
"""

from seismass.campaign.description import example_description, read_campaign
from seismass.campaign.folder import Campaign, CampaignFolder
from seismass.campaign.progress import CampaignProgress

__all__ = ["Campaign", "CampaignFolder", "CampaignProgress", "example_description", "read_campaign"]


def __dir__() -> list[str]:
    """Return the public names, for completion."""
    return list(__all__)
