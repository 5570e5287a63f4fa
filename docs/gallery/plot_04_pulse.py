"""
The velocity pulse of a record
==============================

A synthetic motion with a pulse of three seconds, and what the method of Baker (2007) finds in it.
"""

# %%
# The method needs the wavelets of PyWavelets: ``pip install "seismass[pulses]"``.
import seismass as sm

quiet = sm.builtin_record("synthetic-2")
pulse = sm.records.NearFaultPulse(period=3.0, velocity=1.2, centre=8.0)
time = quiet.motion.time
acceleration = quiet.acceleration + pulse.acceleration(time)
record = quiet.replace(acceleration=acceleration, name="synthetic-2 with a pulse of 3 s")
found = sm.pulses.baker2007(record)
print(found.text)

# %%
# The record, its pulse, and what remains without it:
found.plot()
