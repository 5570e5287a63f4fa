"""`animate` and what it returns."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from seismass.animation.shown import Shown, shown
from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import as_number, brief, content_hash, refusal, same_content
from seismass.base.views import view
from seismass.effective_mass.models import attached_scene
from seismass.media.roles import SLIDE
from seismass.model.codes import Use, code_fraction
from seismass.model.motion import MotionLike, as_motion
from seismass.model.scene import Scene
from seismass.runs.response import Response

if TYPE_CHECKING:
    from markupsafe import Markup

DEFAULT_CODE: Final = "asce7-10"
"""Code whose share of the live load is attached where none is chosen."""


@dataclass(frozen=True, eq=False)
class Animation:
    """An animation of one scene under one motion, as `animate` makes it.

    Attributes
    ----------
    title, note : str
        What it is called, and a line below.
    scene : Scene
        The real building.
    shown : Shown
        What is drawn.
    """

    title: str
    note: str
    scene: Scene
    shown: Shown

    __eq__ = same_content
    __hash__ = content_hash

    @property
    def sentences(self) -> tuple[str, ...]:
        """What happens, a sentence for each run."""
        return self.shown.sentences

    @view
    def fragment(self) -> Markup:
        """Return a part of a page, with its style and script; any number of them may be in one page.

        Its style applies to it alone, and its script to the element that the script stands in. `page_html` of
        `seismass.media.page` names the script in the policy of the page.
        """
        raise NotImplementedError

    @view
    def html(self) -> str:
        """Return a page that needs nothing but itself: play, pause, scrub, speed, and the same by keys."""
        raise NotImplementedError

    @view
    def write(self, path: str | Path, *, frames_per_second: float | None = None, speed: float = 1.0) -> None:
        """Write a page (.html), a GIF (.gif) or a film (.mp4, which needs ffmpeg).

        Parameters
        ----------
        path : path-like
            The file; its suffix decides.
        frames_per_second : float, optional
            Of a GIF (default 12.5, at most 50) or a film (default 25). A page draws as often as its screen.
        speed : float, default 1
            Time that passes in a GIF or film in a second.

        Raises
        ------
        InvalidOption
            Another suffix, or numbers that are out of range or have no meaning for a page.
        MissingPackage
            There is no ffmpeg to make a film with.
        OSError
            The file cannot be written.
        """
        raise NotImplementedError

    @view
    def _repr_html_(self) -> str:
        """A frame of its own, so that a notebook's style and script and those of the page do not meet."""
        raise NotImplementedError

    def __repr__(self) -> str:
        runs = " and ".join(run.label for run in self.shown.runs)
        seconds = (self.shown.rows - 1) * self.shown.step
        return f"Animation({self.title!r}, {runs}, {seconds:g} s, {self.shown.rows} rows)"


def _label(scene: Scene) -> str:
    """What the run of the scene itself is called."""
    if scene.building is None:
        return f"{'racks' if scene.racks else 'blocks'} on the ground"
    return SLIDE.name if scene.goods else "no goods"


def animate(
    scene: Scene,
    motion: MotionLike,
    *,
    code: str = DEFAULT_CODE,
    use: Use = "storage",
    fraction: float | None = None,
    title: str | None = None,
    note: str | None = None,
) -> Animation:
    """Solve a scene, and the model of a code beside it, and return their animation.

    The model has a share of the goods attached to the floors as mass and nothing that slides; stiffness, strength,
    damping and gravity load are those of the real building (`attached_scene`); racks are lumped on their floors. A
    scene without goods on a floor is shown alone.

    Parameters
    ----------
    scene : Scene
        Building and blocks, or blocks on the ground.
    motion : Motion or Record
        Ground motion.
    code : str, default "asce7-10"
        Code whose share of the live load the model has, as `code_fraction` takes it.
    use : {"storage", "ordinary", "archive", "shop", "garage"}
        Use of the floors, for the code.
    fraction : float, optional
        A share in place of the code's, from 0 to 1. Blocks are taken as the whole live load.
    title, note : str, optional
        What it is called, and a line below; by default the names of scene and record.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be.
    SimulationError
        A run could not be carried to its end.

    Examples
    --------
    >>> import seismass as sm
    >>> building = sm.Building.uniform(2, 0.4, yield_shear_over_weight=[0.3, 0.2])
    >>> scene = sm.Scene(building, sm.blocks_on_floors([1.0, 1.0], mu=0.2))
    >>> animation = sm.animate(scene, sm.builtin_record("synthetic-1"), fraction=0.25)
    >>> len(animation.html()) < 150_000
    True
    """
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", "animation", "a Scene", brief(scene))
    chosen = as_motion(motion, "motion", "animation")
    scene.on_ground("animation")
    scenes: list[tuple[str, float | None, Scene]] = [(_label(scene), None, scene)]
    if any(floor > 0 for floor in (*scene.block_floor, *(rack.floor for rack in scene.racks if rack.blocks))):
        if fraction is None:
            row = code_fraction(code, use)
            share, label = row.fraction, f"{row.code} model"
        else:
            share, label = as_number(fraction, "fraction", "animation", InvalidOption), "model"
            if not 0.0 <= share <= 1.0:
                raise refusal(InvalidOption, "fraction", "animation", "between 0 and 1", f"{share:g}")
        scenes.append((label, share, attached_scene(scene, share)))
    source: Any = getattr(motion, "name", "")
    return Animation(
        title=title if title is not None else scene.name or "Animation of a building",
        note=note if note is not None else ", ".join(part for part in (scene.note, str(source)) if part),
        scene=scene,
        shown=shown(scenes, chosen),
    )


def animation_of(
    response: Response,
    *,
    code: str = DEFAULT_CODE,
    use: Use = "storage",
    fraction: float | None = None,
    title: str | None = None,
) -> Animation:
    """Return the animation of a run, with the name of its record; see `Response.animate`."""
    name = "" if response.record is None else response.record.name
    note = ", ".join(part for part in (response.scene.note, name) if part)
    return animate(response.scene, response.motion, code=code, use=use, fraction=fraction, title=title, note=note)
