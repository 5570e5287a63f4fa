"""One scene under one motion, with everything about it."""

from __future__ import annotations

import warnings
from typing import Any, Final, overload

from seismass import _kernel
from seismass.base.errors import DoubtfulInput, InvalidOption, InvalidScene, SeismassError
from seismass.base.values import as_count, as_flag, brief, refusal
from seismass.model.plausibility import motion_remarks
from seismass.model.scene import Scene
from seismass.motions.motion import Motion, MotionLike, as_motion
from seismass.motions.records.record import Record
from seismass.runs.plane import MotionPair, PlaneResponse, is_motion_pair, motions_in_plane
from seismass.runs.quantities import of_chains_alone
from seismass.runs.response import Response


@overload
def simulate(
    scene: Scene,
    motion: MotionLike,
    *,
    histories: bool | int = False,
    displacements_only: bool = False,
    events: bool = True,
    energy: bool = False,
    floor_force: bool = False,
    duration: float | None = None,
) -> Response: ...


@overload
def simulate(
    scene: Scene,
    motion: MotionPair,
    *,
    histories: bool | int = False,
    displacements_only: bool = False,
    events: bool = True,
    energy: bool = False,
    floor_force: bool = False,
    duration: float | None = None,
) -> PlaneResponse: ...


def simulate(
    scene: Scene,
    motion: MotionLike | MotionPair,
    *,
    histories: bool | int = False,
    displacements_only: bool = False,
    events: bool = True,
    energy: bool = False,
    floor_force: bool = False,
    duration: float | None = None,
) -> Response | PlaneResponse:
    """Solve one scene under one motion, exactly: every event is located, every regime is solved in closed form.

    Parameters
    ----------
    scene : Scene
        Building, blocks and racks.
    motion : Motion or Record; Pair, or two of them
        Ground motion. A scene in two directions takes a Pair, or motions in x and in y of one step: the shorter one is
        continued with zeros, and the vertical one is that of the pair or of the first.
    histories : bool or int, default False
        True keeps histories at every sample, a number at every so many samples from the first. A row at the time of an
        event is the state after it.
    displacements_only : bool, default False
        Keep the histories of drifts and slips alone, not those of velocities, accelerations and forces: a third of the
        memory, and less time.
    events : bool, default True
        Keep the event log.
    energy : bool, default False
        Compute the energy balance.
    floor_force : bool, default False
        Keep peaks of floor forces, of shear buildings in one direction, without a sliding base, alone.
    duration : float, optional
        End at the sample nearest to this time (s), before the last sample or after it.

    Returns
    -------
    Response or, of a scene in two directions, PlaneResponse
        Peaks, residuals, and what else was asked for. A collapse is a result, not an error.

    Raises
    ------
    InvalidScene, InvalidMotion, InvalidOption
        An argument is not what it must be.
    SimulationError
        The run could not be carried to its end.

    Examples
    --------
    >>> import seismass as sm
    >>> scene = sm.Scene(None, [sm.Block(0, mass=100.0, mu=0.1)])
    >>> response = sm.simulate(scene, sm.Motion([2.0, 2.0, 0.0, 0.0], dt=0.1), histories=True)
    >>> response.counts["slip"]
    1
    """
    if not isinstance(scene, Scene):
        raise refusal(InvalidScene, "scene", "simulate", "a Scene", brief(scene))
    motions: tuple[Motion, ...] = (
        motions_in_plane(motion) if scene.engine == "plane" else (as_motion(motion, "motion", "simulate"),)
    )
    if duration is not None:
        motions = tuple(each.with_duration(duration) for each in motions)
    motion_alone = motions[0]
    every = (
        int(histories)
        if isinstance(histories, bool)
        else as_count(histories, "histories", "simulate", InvalidOption, least=1)
    )
    switches = (("displacements_only", displacements_only), ("energy", energy), ("events", events))
    flags = [as_flag(value, name, "simulate", InvalidOption) for name, value in switches]
    floor_force = as_flag(floor_force, "floor_force", "simulate", InvalidOption)
    if floor_force and scene.engine != "chain":
        raise of_chains_alone()
    if scene._plane_scene is not None:
        other = motions[1].acceleration
        of_plane = _kernel.simulate_plane(scene._plane_scene, motion_alone._kernel, other, every, *flags)
        return PlaneResponse(of_plane, scene, (motion_alone, motions[1]))
    run: _kernel.Response | _kernel.GeneralResponse
    if scene._general_scene is not None:
        run = _kernel.simulate_general(scene._general_scene, motion_alone._kernel, every, *flags)
    else:
        run = _kernel.simulate(scene._kernel, motion_alone._kernel, every, *flags, floor_force=floor_force)
    return Response(run, scene, motion_alone, motion if isinstance(motion, Record) else None)


def instruction_set() -> str:
    """Return the name of the instruction set that the kernel uses: "baseline", "avx2" or "avx512".

    It is the widest that the machine has, or the one that the environment variable SEISMASS_INSTRUCTIONS names when the
    kernel is first used, if the machine has it ("baseline": every machine). Results agree to rounding between
    instruction sets, and to the bit with the same one, on every machine.

    Examples
    --------
    >>> import seismass as sm
    >>> sm.runs.instruction_set() in ("baseline", "avx2", "avx512")
    True
    """
    return _kernel.instruction_set()


MOST_LOOKED_AT: Final = 100
"""Scenes and motions of a batch that are looked at, from the first on."""


def warn_of_doubts(scenes: Any, motions: Any) -> None:
    """Warn (`DoubtfulInput`) at the caller's line of the first doubtful scene (of a grid: if its first is) and the
    first doubtful motion of a batch. An iterator of motions is not looked at: it can be read only once.
    """
    doubtful = [(number, scene.remarks) for number, scene in enumerate(_listed(scenes), start=1) if scene.remarks]
    if doubtful:
        number, remarks = doubtful[0]
        others = f" (and {len(doubtful) - 1} more scenes)" if len(doubtful) > 1 else ""
        warnings.warn(f"scene {number}: {'; '.join(remarks)}{others}", DoubtfulInput, stacklevel=3)
    listed = [motions] if hasattr(motions, "acceleration") else motions if hasattr(motions, "__len__") else ()
    first = [] if getattr(listed, "shape", None) == () else list(listed)[:MOST_LOOKED_AT]
    alone = [each for one in first for each in (one if is_motion_pair(one) else (one,))]
    strong = motion_remarks([each for each in alone if hasattr(each, "acceleration")])
    if strong:
        others = f" (and {len(strong) - 1} more motions)" if len(strong) > 1 else ""
        warnings.warn(f"{strong[0]}{others}", DoubtfulInput, stacklevel=3)


def _listed(scenes: Any) -> list[Scene]:
    """The first scenes of a batch; other values are refused elsewhere."""
    from seismass.runs.grid.grid import Grid  # one run needs no grid

    if isinstance(scenes, Grid):
        try:
            return [scenes.scene(1)]
        except SeismassError:
            return []
    listed = [scenes] if isinstance(scenes, Scene) else scenes if isinstance(scenes, list | tuple) else []
    return [scene for scene in listed[:MOST_LOOKED_AT] if isinstance(scene, Scene)]
