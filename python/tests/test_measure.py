"""A known sensitivity is measured again."""

from __future__ import annotations

import numpy as np
import pytest

import fogcoil

SENSITIVITY = -2.0
"""What the record is made of [(deg/h)/(degC/min)]."""


def test_a_known_sensitivity_is_measured_and_a_record_at_rest_tells_none() -> None:
    noise = np.random.default_rng(1)
    time = 60.0 * np.arange(1, 400)
    chamber = np.interp(time, [3600, 9600, 13200, 19200], [-40, 60, 60, -40])
    rate = 3.0 + SENSITIVITY * np.diff(chamber, prepend=chamber[0]) + noise.normal(0, 0.05, time.size)
    record = {"time_s": time, "chamber_c": chamber + noise.normal(0, 0.01, time.size), "rate_deg_per_h": rate}
    found = fogcoil.measure(record)
    sensitivity = found["sensitivity"]
    assert sensitivity is not None
    low, high = sensitivity["ci90"]
    assert low < SENSITIVITY < high and high - low < 0.5
    assert found["hysteresis"] is None and any("hysteresis" in note for note in found["notes"])
    still = fogcoil.measure({**record, "chamber_c": np.full(time.size, 20.0)})
    assert still["sensitivity"] is None and any("there is no ramp" in note for note in still["notes"])
    with pytest.raises(fogcoil.InputError, match="rate_deg_per_h"):
        fogcoil.measure({"time_s": time})
