"""A process that was forked from one that has used all cores can use them too."""

import os
import signal

import numpy as np
import pytest

import seismass as sm


@pytest.mark.skipif(not hasattr(os, "fork"), reason="no fork on this system")
@pytest.mark.filterwarnings("ignore:.*fork.*:DeprecationWarning")
def test_spectra_after_a_fork_are_those_before_it():
    """The threads of the parent do not exist in the child, which must not wait for them."""
    motion = sm.Motion(np.sin(np.arange(200) * 0.1), dt=0.01)
    before = sm.response_spectrum(motion, [0.1, 0.5, 1.0])
    child = os.fork()
    if child == 0:
        signal.alarm(60)
        same = np.array_equal(before, sm.response_spectrum(motion, [0.1, 0.5, 1.0]))
        os._exit(0 if same else 1)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0
