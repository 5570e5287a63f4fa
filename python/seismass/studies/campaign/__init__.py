"""Studies of any size as folders: runs cut into parts that are written whole, on one machine or on many.

`Campaign` describes the runs, `CampaignFolder` is what they become; `read_campaign` reads a description from a file.
"""

from seismass.studies.campaign.engine import CampaignProgress
from seismass.studies.campaign.folder import Campaign, CampaignFolder, example_description, read_campaign

__all__ = ["Campaign", "CampaignFolder", "CampaignProgress", "example_description", "read_campaign"]

__dir__ = __all__.copy  # for completion
