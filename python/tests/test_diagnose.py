"""A whole diagnosis, of a coil that is quick to model: a read-out drift is concealed in a recording, and found."""

from __future__ import annotations

import pathlib

import numpy as np
import numpy.typing as npt

import pytest

import fogcoil

DRIFT = 0.002
"""What is concealed [deg/h/K]."""
NOISE = 0.001
"""Of a row's rate [deg/h]."""


def free_coil(reference: fogcoil.Coil) -> fogcoil.Coil:
    """Without a spool, eight layers of twenty turns."""
    return reference.replace(
        {
            "spool": "None",
            "winding.layers": 8,
            "winding.turns_odd_layers": 20,
            "winding.turns_even_layers": 19,
            "coil.outer_radius_mm": 44.7,
            "coil.height_mm": 3.4,
            "optics.sagnac_diameter_mm": 88.2,
        }
    )


def record(coil: fogcoil.Coil, to_c: float, seed: int) -> dict[str, npt.NDArray[np.float64]]:
    """A ramp from 20 degC to ``to_c``, rows of 30 s, with noise and the drift."""
    noise = np.random.default_rng(seed)
    time = np.linspace(0.0, 30.0 * 299, 300)
    true = fogcoil.simulate(coil, time, np.interp(time, [1500, 4500], [20, to_c]))
    rate = true["rate_deg_per_h"] + DRIFT * (true["spool_c"] - 20) + noise.normal(0, NOISE, 300)
    chamber, spool = (true[name] + noise.normal(0, 0.01, 300) for name in ("chamber_c", "spool_c"))
    return {"time_s": time, "chamber_c": chamber, "spool_c": spool, "rate_deg_per_h": rate}


def test_a_concealed_drift_is_found_and_the_extended_design_simulates(coil: fogcoil.Coil) -> None:
    design = free_coil(coil)
    fit, held = record(design, 60.0, 1), record(design, 0.0, 2)
    tasks: list[str] = []
    found = fogcoil.diagnose(design, [fit], [held], progress=tasks.append)
    assert found["verdict"] == "explained" and found["set"] == ["rate-temperature-coefficient"]
    assert found["located"]["stage"] == "electronics" and "rate-temperature-coefficient" in found["text"] and tasks
    # each task as it begins, and its tenths
    names = [task.rsplit(" (", 1)[0] if task.endswith(")") and " of " in task else task for task in tasks]
    assert len(set(names)) > 5 and max(map(names.count, names)) <= 11, tasks
    drift = found["parameters"]["coefficient_deg_per_h_per_k"]
    assert drift["ci90"][0] < drift["value"] < drift["ci90"][1] and abs(drift["value"] - DRIFT) < 1e-4
    prediction, holdout, model = found["prediction"], found["holdout"], found["model"]
    assert prediction is not None and holdout is not None and model is not None
    np.testing.assert_array_equal(prediction["time_s"], held["time_s"])
    off = prediction["rate_deg_per_h"] - held["rate_deg_per_h"]
    assert np.sqrt(np.mean(off**2)) < 1.3 * NOISE < 0.1 * holdout["rmse_nominal"]
    assert model["drifts.read_out_deg_per_h_per_k"] == drift["value"]
    again = fogcoil.simulate(model, held["time_s"], np.interp(held["time_s"], [1500, 4500], [20, 0.0]))
    # the same, but for a constant offset
    assert np.std(again["rate_deg_per_h"] - held["rate_deg_per_h"]) < 1.3 * NOISE


HUMIDITY = """(
    id: "damp-board", title: "A board that feels the humidity", stage: Electronics,
    parameters: [(name: "size", unit: "deg/h/%", prior: Normal(0.0, 0.01))],
    columns: [(name: "humidity", unit: "%")],
    laws: [Rate("size * (humidity - 50)")],
)"""


def test_a_mechanism_of_a_file_sees_a_further_column(coil: fogcoil.Coil, tmp_path: pathlib.Path) -> None:
    design, path = free_coil(coil), tmp_path / "damp.ron"
    path.write_text(HUMIDITY)

    def damp(to_c: float, seed: int) -> dict[str, npt.NDArray[np.float64]]:
        of = record(design, to_c, seed)
        humidity = 50 + 30 * np.sin(of["time_s"] / 700)
        drift = DRIFT * (of["spool_c"] - 20)
        return {**of, "humidity": humidity, "rate_deg_per_h": of["rate_deg_per_h"] - drift + 0.0005 * (humidity - 50)}

    fit, held = damp(60.0, 3), damp(0.0, 4)
    found = fogcoil.diagnose(design, [fit], [held], mechanisms=[path])
    assert found["verdict"] == "explained" and found["set"] == ["damp-board"], found["text"]
    assert abs(found["parameters"]["size_deg_per_h_per_percent"]["value"] - 0.0005) < 2e-5
    fit.pop("humidity")
    with pytest.raises(fogcoil.InputError, match="humidity"):
        fogcoil.diagnose(design, [fit], mechanisms=[path])
