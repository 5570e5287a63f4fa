"""Public names stand in groups, and completion shows them alone."""

from __future__ import annotations

import inspect

import pytest

import seismass as sm

GROUPS = sorted(name for name in sm.__all__ if inspect.ismodule(getattr(sm, name)))


def test_the_top_holds_what_a_first_hour_needs() -> None:
    names = [name for name in sm.__all__ if name not in GROUPS and not name.startswith("_")]
    assert len(names) <= 47
    assert {"Building", "Scene", "simulate", "assess", "effective_mass", "read_record"} <= set(names)
    wanted = [
        "records",
        "spectra",
        "scaling",
        "matching",
        "pulses",
        "design",
        "fragility",
        "slip",
        "risk",
        "campaign",
        "plots",
        "codes",
    ]
    assert set(wanted) <= set(GROUPS)


@pytest.mark.parametrize("group", GROUPS)
def test_completion_shows_the_public_names_of_a_group_and_nothing_else(group: str) -> None:
    module = getattr(sm, group)
    assert sorted(dir(module)) == sorted(module.__all__)
    for name in module.__all__:
        value = getattr(module, name)
        assert not inspect.ismodule(value) or name in GROUPS
        if inspect.isclass(value) or inspect.isfunction(value):
            assert value.__module__.startswith("seismass.")
            assert value.__doc__
