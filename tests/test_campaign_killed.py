"""Campaigns that are killed, whose workers are killed, or whose disk is full: the rest is solved, to the same bytes."""

from __future__ import annotations

import errno
import multiprocessing
import os
import random
import signal
import subprocess
import sys
import textwrap
import threading
import time
from pathlib import Path

import pytest

import seismass as sm
from seismass.studies.campaign.manifest import part_path

PROGRAM = """
    import sys
    import numpy as np
    import seismass as sm

    def campaign():
        building = sm.Building.uniform(2, 0.3, yield_shear_over_weight=[0.3, 0.18])
        mu, scale = np.linspace(0.1, 0.5, 40), np.linspace(0.5, 2, 25)
        grid = sm.Grid.product(building, mass_ratio=[0.5, 1.0], mu=mu, scale=scale)
        return sm.campaign.Campaign(grid, sm.builtin_suite("seven")[4].with_duration(9.0), part_runs=20)
"""
RUN = textwrap.dedent(PROGRAM) + "\ncampaign().run(place, threads=1)\n"
"""Solves the campaign into a folder."""
KILLS = 20


def made() -> sm.campaign.Campaign:
    space: dict[str, object] = {}
    exec(textwrap.dedent(PROGRAM), space)
    found = space["campaign"]()  # type: ignore[operator]
    assert isinstance(found, sm.campaign.Campaign)
    return found


def files(folder: Path) -> dict[str, bytes]:
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.fixture(scope="module")
def undisturbed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    place = tmp_path_factory.mktemp("killed") / "undisturbed"
    made().run(place)
    return place


@pytest.mark.skipif(sys.platform != "linux", reason="the start of a process is read from /proc")
def test_a_client_killed_at_random_times_ends_in_the_same_bytes(undisturbed: Path, tmp_path: Path) -> None:
    server = multiprocessing.get_context("forkserver")
    server.set_forkserver_preload(["numpy", "polars", "seismass", "seismass.studies.campaign"])
    rng = random.Random(7)
    place = tmp_path / "a"
    total = len(list((undisturbed / "parts").iterdir()))
    kills = 0
    for kill in range(KILLS):
        child = server.Process(target=exec, args=(RUN, {"place": str(place)}))
        child.start()
        # A share of what is missing, then a time within a part.
        there = len(list((place / "parts").glob("part-*"))) if (place / "parts").is_dir() else 0
        wanted = there + (rng.randint(0, max((total - there) // (KILLS - kill), 1)) if kill else 0)
        deadline = time.monotonic() + 60.0
        while child.is_alive() and time.monotonic() < deadline:
            if (place / "parts").is_dir() and len(list((place / "parts").glob("part-*"))) >= wanted:
                break
            time.sleep(0.002)
        time.sleep(rng.uniform(0.0, 0.03))
        child.kill()
        child.join()
        kills += child.exitcode == -signal.SIGKILL
    assert kills >= KILLS - 2  # some may have been at their end
    folder = made().run(place)
    assert folder.complete
    assert files(place) == files(undisturbed)


@pytest.mark.skipif(sys.platform != "linux", reason="kills a process")
def test_a_killed_worker_loses_no_part(undisturbed: Path, tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="distributed is not installed: no workers are started")
    place = tmp_path / "a"
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0") as cluster,
        distributed.Client(cluster) as client,
    ):
        pids = list(client.run(os.getpid).values())

        def kill() -> None:
            while len(list((place / "parts").glob("part-*"))) < 20:
                time.sleep(0.002)
            os.kill(pids[0], signal.SIGKILL)

        killer = threading.Thread(target=kill)
        (place / "parts").mkdir(parents=True)
        killer.start()
        made().run(place, executor=client.get_executor(retries=3))
        killer.join()
        assert pids[0] not in client.run(os.getpid).values()
    assert files(place) == files(undisturbed)


@pytest.mark.skipif(sys.platform != "linux", reason="the system refuses to write more, as a full disk does")
def test_a_full_disk_is_an_error_and_nothing_is_lost(undisturbed: Path, tmp_path: Path) -> None:
    place = tmp_path / "a"
    campaign = made()
    campaign.run(place, shard=(1, 3))
    before = files(place)
    limit = part_path(place, 1).stat().st_size // 2
    program = RUN.replace(
        "\ncampaign()",
        f"\nplace = sys.argv[1]\nimport resource\nresource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))\n"
        "try:\n    campaign().run(place)\n"
        "except OSError as error:\n    print(error.errno, error)\n    sys.exit()\n"
        "campaign()",
    )
    child = subprocess.run([sys.executable, "-c", program, str(place)], capture_output=True, text=True, timeout=120)
    assert child.stdout.split()[0] in (str(errno.EFBIG), str(errno.EIO)), child.stderr
    assert "part-0000002.parquet" in child.stdout
    assert files(place) == before
    campaign.run(place)
    assert files(place) == files(undisturbed)


def test_a_folder_that_cannot_be_written_to_is_an_error_at_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = tmp_path / "a"
    made().run(place, shard=(1, 200))
    before = files(place)
    place.chmod(0o500)
    (place / "parts").chmod(0o500)
    if os.access(place / "parts", os.W_OK):  # the superuser may write everywhere
        monkeypatch.setattr(os, "access", lambda *_: False)
    try:
        with pytest.raises(PermissionError) as raised:
            made().run(place)
    finally:
        place.chmod(0o700)
        (place / "parts").chmod(0o700)
    assert str(place) in str(raised.value.filename)
    assert files(place) == before
