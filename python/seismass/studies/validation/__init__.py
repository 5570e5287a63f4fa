"""Validations of the paper: its section 4 by several programs, its shaking table over ranges, and its claims.

Nothing here needs OpenSees: its results are kept as data, with versions and settings. Recordings are not part of the
package; without them built-in motions stand in, and results say so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, ClassVar

import polars as pl

from seismass.base.arguments import ProgressLike
from seismass.base.values import short_repr
from seismass.base.views import view
from seismass.media.result import Result
from seismass.motions.records import Suite, builtin_suite
from seismass.motions.spectra import TargetSpectrum
from seismass.studies.study import Sensitivity, StudyResult, run_study
from seismass.studies.validation.paper_claims import Claim, Verdict, claims, claims_table
from seismass.studies.validation.shaking_table import (
    STAND_INS,
    Band,
    Platform,
    Station,
    components,
    platform,
    platform_scene,
)
from seismass.studies.validation.three_storeys import (
    SPRINGS,
    Histories,
    Section4,
    platform_tables,
    section4,
    section4_scene,
    section4_tables,
)

__all__ = [
    "STAND_INS",
    "Band",
    "Claim",
    "Histories",
    "Platform",
    "Section4",
    "Station",
    "Validation",
    "Verdict",
    "claims",
    "components",
    "paper_scenes",
    "platform",
    "platform_scene",
    "section4",
    "section4_scene",
    "validate",
]

__dir__ = __all__.copy  # for completion


@dataclass(frozen=True, eq=False)
class Validation(Result):
    """All validations.

    Attributes
    ----------
    study : StudyResult
        The parametric study that claims are taken from.
    section4 : Section4
        The three-storey building under the Brawley record.
    platform : Platform
        The platform under the time-compressed Erzincan record.
    claims : list of Claim
        The paper's claims with our numbers.
    """

    document: ClassVar[str] = "validation"

    study: StudyResult
    section4: Section4
    platform: Platform
    claims: list[Claim]

    __repr__ = short_repr

    def metadata(self) -> dict[str, Any]:
        """Return versions and motions, for files and pages."""
        return {
            "package_version": self.study.metadata["package_version"],
            "suite": self.study.metadata["suite"]["name"],
            "section4_motion": _motion_text("Brawley Airport", self.section4.synthetic),
            "platform_motion": _motion_text("Erzincan", self.platform.synthetic),
        }

    @property
    def tables(self) -> dict[str, pl.DataFrame]:
        """The tables by name, without lists in their cells: claims, and those of section 4 and of the platform."""
        return {
            "claims": claims_table(self.claims),
            **section4_tables(self.section4),
            **platform_tables(self.platform),
        }

    def to_dict(self) -> dict[str, Any]:
        """Return motions, claims, and what is robust of the platform, as plain values."""
        return {
            **self.metadata(),
            "claims": [vars(claim) for claim in self.claims],
            "platform": self.platform.robust,
            "differences": self.section4.differences.to_dicts(),
        }

    @property
    @view
    def figure_names(self) -> tuple[str, ...]:
        """Names: those of section 4 by component and slope, its sliding, and those of the platform by component."""
        raise NotImplementedError


def _motion_text(station: Station, synthetic: bool) -> str:
    if synthetic:
        return f"{STAND_INS[station]}, a built-in motion in place of the recording of {station}"
    return f"recording of {station}"


def paper_scenes(
    suite: Suite | None = None,
    *,
    springs: Sequence[tuple[float, int]] = SPRINGS,
    progress: ProgressLike = None,
) -> tuple[Section4, Platform]:
    """Solve the scenes of the paper's section 4: the three-storey building and the platform.

    Parameters
    ----------
    suite : Suite, optional
        As for `validate`.
    springs : sequence of (float, int), optional
        As for `section4`.
    progress : callable, optional
        As for `section4`.

    Raises
    ------
    RecordFormatError
        As for `validate`.
    """
    building = section4(components("Brawley Airport", suite), springs=springs, progress=progress)
    return building, platform(components("Erzincan", suite))


def validate(
    suite: Suite | None = None,
    target: TargetSpectrum | None = None,
    *,
    study: StudyResult | None = None,
    sensitivity: Sensitivity | None = None,
    scenes: tuple[Section4, Platform] | None = None,
    threads: int | None = None,
    progress: ProgressLike = None,
) -> Validation:
    """Run all validations.

    Parameters
    ----------
    suite : Suite, optional
        Motions of the study, unscaled; default the built-in suite of seven. Recordings of Brawley Airport and Erzincan
        in it, and other components of them in the same folder, are those of the paper's section 4. Built-in motions
        stand in where there are none.
    target : TargetSpectrum, optional
        Target spectrum of the study; default the ASCE 7 shape.
    study : StudyResult, optional
        A study of the suite that has been run.
    sensitivity : Sensitivity, optional
        Its sensitivity, for the claims.
    scenes : tuple of Section4 and Platform, optional
        What `paper_scenes` gave.
    threads : int, optional
        Number of threads; default all cores.
    progress : callable, optional
        Called with (analyses done, distinct analyses) of the study, then as for `section4`.

    Returns
    -------
    Validation
        Results and claims.

    Raises
    ------
    InvalidMotion, InvalidOption
        `suite` is not a Suite, or cannot be scaled.
    RecordFormatError
        A recording beside one of the suite cannot be read.

    Examples
    --------
    >>> from seismass.studies.validation import validate
    >>> found = validate()
    >>> found.section4.synthetic, found.claims[1].verdict
    (True, 'reproduced')
    """
    if study is None:
        records = builtin_suite("seven") if suite is None else suite
        spectrum = TargetSpectrum.asce7() if target is None else target
        study = run_study(records, spectrum, threads=threads, progress=progress)
    building, table = paper_scenes(suite, progress=progress) if scenes is None else scenes
    return Validation(study, building, table, claims(study, building, table, sensitivity=sensitivity))
