"""Names of the package, imported when they are first used; `__init__.py` reads them here."""

from . import design, runs
from .assessment import Assessment, OwnBuilding, assess, read_building
from .base import distributions, errors
from .base.errors import SeismassError
from .base.units import STANDARD_GRAVITY
from .design import scaling
from .effective_mass import (
    EffectiveMass,
    EffectiveMassMap,
    EffectiveMassParameters,
    LiveLoadUncertainty,
    attached_scene,
    effective_mass,
    effective_mass_map,
    effective_mass_of_design,
    live_load_uncertainty,
)
from .model import codes, friction, occupancy
from .model.block import Block, SlidingBase, Stops, blocks_on_floors
from .model.building import Building, Rayleigh
from .model.rack import Rack, RackBlock
from .model.scene import Scene
from .motions import matching, pulses, records, spectra
from .motions.motion import Motion
from .motions.records import (
    Pair,
    Record,
    Suite,
    builtin_record,
    builtin_suite,
    read_pair,
    read_record,
    read_records,
    read_suite,
)
from .motions.spectra import TargetSpectrum, response_spectrum
from .runs import (
    Grid,
    Response,
    SceneFile,
    long_table,
    read_scene,
    simulate,
    simulate_many,
    stream_many,
    write_many,
)
from .show import animation, explore, plots
from .show.animation import Animation, animate
from .studies import campaign, evidence, fragility, risk, slip, study, validation

__version__: str

__all__ = [
    "STANDARD_GRAVITY",
    "Animation",
    "Assessment",
    "Block",
    "Building",
    "EffectiveMass",
    "EffectiveMassMap",
    "EffectiveMassParameters",
    "Grid",
    "LiveLoadUncertainty",
    "Motion",
    "OwnBuilding",
    "Pair",
    "Rack",
    "RackBlock",
    "Rayleigh",
    "Record",
    "Response",
    "Scene",
    "SceneFile",
    "SeismassError",
    "SlidingBase",
    "Stops",
    "Suite",
    "TargetSpectrum",
    "__version__",
    "animate",
    "animation",
    "assess",
    "attached_scene",
    "blocks_on_floors",
    "builtin_record",
    "builtin_suite",
    "campaign",
    "codes",
    "design",
    "distributions",
    "effective_mass",
    "effective_mass_map",
    "effective_mass_of_design",
    "errors",
    "evidence",
    "explore",
    "fragility",
    "friction",
    "live_load_uncertainty",
    "long_table",
    "matching",
    "occupancy",
    "plots",
    "pulses",
    "read_building",
    "read_pair",
    "read_record",
    "read_records",
    "read_scene",
    "read_suite",
    "records",
    "response_spectrum",
    "risk",
    "runs",
    "scaling",
    "simulate",
    "simulate_many",
    "slip",
    "spectra",
    "stream_many",
    "study",
    "validation",
    "write_many",
]
