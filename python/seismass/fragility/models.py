"""The models that are compared: the building with sliding goods, that of a code, and that with all goods attached."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from seismass.base.errors import InvalidOption, InvalidScene
from seismass.base.values import FloatArray, as_number, brief, refusal
from seismass.effective_mass.models import SAME_DAMPING, ModelDamping, attached, check_damping, check_loaded
from seismass.model.scene import Scene

REAL: Final = "real"
"""The model with which others are compared: goods that slide."""
CODE: Final = "code"
ATTACHED: Final = "attached"
DEFAULT_CODE_SHARE: Final = 0.25
"""Share of the live load that ASCE 7 counts as mass for storage (12.7.2)."""


def compared_models(
    scene: Scene, code_share: float = DEFAULT_CODE_SHARE, *, damping: ModelDamping = SAME_DAMPING
) -> dict[str, Scene]:
    """Return a scene beside the models of it that have a share of the live load attached and no sliding goods.

    Parameters
    ----------
    scene : Scene
        Building and goods.
    code_share : float, default 0.25
        Share of the live load that the code's model has as mass: that of ASCE 7 for storage.
    damping : {"same", "ratio"}, default "same"
        As for `attached_scene`: the damping matrix of the real building, or its ratio in the model's own modes.

    Returns
    -------
    dict of str to Scene
        "real", "code" and "attached".

    Raises
    ------
    InvalidScene
        The scene has no building, or no block on one of its floors.
    InvalidOption
        The share is not between 0 and 1, or the damping is another word.

    Examples
    --------
    >>> import seismass as sm
    >>> scene = sm.Scene(sm.Building.uniform(2, 0.4), sm.blocks_on_floors([1.0, 0.0], mu=0.3))
    >>> {name: model.building.mass.tolist() for name, model in sm.fragility.compared_models(scene).items()}
    {'real': [1.0, 1.0], 'code': [1.25, 1.0], 'attached': [2.0, 1.0]}
    """
    loaded = check_loaded(scene)
    share = as_number(code_share, "code_share", "compared models", InvalidOption)
    if not 0.0 <= share <= 1.0:
        raise refusal(InvalidOption, "code_share", "compared models", "between 0 and 1", f"{share:g}")
    convention = check_damping(damping, "compared models")
    return {REAL: loaded, CODE: attached(loaded, share, convention), ATTACHED: attached(loaded, 1.0, convention)}


def as_models(models: Any, owner: str) -> dict[str, Scene]:
    """Return models by name, all of one number of storeys; one scene alone is the real building."""
    given = {REAL: models} if isinstance(models, Scene) else models
    if not isinstance(given, Mapping) or not given:
        raise refusal(InvalidScene, "models", owner, "a Scene, or a mapping of names to Scenes", brief(models))
    for name, scene in given.items():
        if not isinstance(name, str) or not name:
            raise refusal(InvalidScene, "models", owner, "named by text", brief(name))
        if not isinstance(scene, Scene):
            raise refusal(InvalidScene, f"model {name}", owner, "a Scene", brief(scene))
        scene.of_chain(owner)
    found = dict(given)
    first = next(iter(found.values()))
    for name, scene in found.items():
        if scene.storeys != first.storeys:
            requirement = f"of {first.storeys} storeys, as the first one"
            raise refusal(InvalidScene, f"model {name}", owner, requirement, str(scene.storeys))
        if not np.array_equal(_heights(scene), _heights(first)):
            requirement = f"those of the first one, {brief(_heights(first).tolist())}"
            got = brief(_heights(scene).tolist())
            raise refusal(InvalidScene, f"heights of model {name}", owner, requirement, got)
    return found


def _heights(scene: Scene) -> FloatArray:
    """Storey heights; none where they are not known."""
    known = None if scene.building is None else scene.building.heights
    return np.empty(0) if known is None else known
