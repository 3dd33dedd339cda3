"""Numbers against the paper, the nominal responses and the written design."""

from __future__ import annotations

import pickle
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import fogcoil


def test_the_reference_cell_has_the_constants_of_table_one(fixtures: Path) -> None:
    found = fogcoil.homogenize(fixtures / "cell-reference.ron")
    # Table I of Osunluk, Ogut and Ozbay, to half of its last digit
    for key, printed, half in [
        ("e_z", 14.5e9, 0.05e9),
        ("e_r", 95.2e6, 0.05e6),
        ("g_zr", 24.1e6, 0.05e6),
        ("nu_zr", 0.392, 0.0005),
        ("alpha_r", 193e-6, 0.5e-6),
    ]:
        assert found[key] == pytest.approx(printed, abs=half), key
        assert 0 < found["error_estimate"][key] <= 1e-6, key


def test_a_finer_tolerance_moves_no_constant_by_more_than_the_estimate(fixtures: Path) -> None:
    cell = fogcoil.Cell(fixtures / "cell-reference.ron")
    rough, fine = fogcoil.homogenize(cell, 1e-3), fogcoil.homogenize(cell, 1e-9)
    assert fine["error_estimate"]["e_r"] < rough["error_estimate"]["e_r"]
    for key, relative in rough["error_estimate"].items():
        assert fine[key] == pytest.approx(rough[key], rel=relative + 1e-9), key


def test_the_turn_table_is_that_of_the_winding(coil: fogcoil.Coil) -> None:
    turns = fogcoil.wind(coil)
    assert list(turns) == ["half", "layer", "turn", "y_mm", "r_mm", "z_start_m", "z_end_m"]
    assert len(turns["half"]) == 18 * (106 + 105) and set(turns["half"]) == {"CW", "CCW"}
    assert turns["layer"].dtype.kind == "i" and turns["half"][0] == "CCW" and turns["layer"][0] == 36
    assert turns["z_start_m"][0] == 0.0 and turns["z_end_m"][-1] == pytest.approx(1101.57, abs=0.005)  # Table III
    np.testing.assert_allclose(turns["z_end_m"] - turns["z_start_m"], 2e-3 * np.pi * turns["r_mm"], rtol=1e-9)
    np.testing.assert_array_equal(turns["z_start_m"][1:], turns["z_end_m"][:-1])
    turns["y_mm"] -= turns["y_mm"].mean()  # the arrays are the caller's own


def test_the_sensitivity_is_that_of_table_four_within_its_error(coil: fogcoil.Coil) -> None:
    found = fogcoil.sensitivity(coil)
    assert found["total"] == pytest.approx(-2.7335, abs=found["error_estimate"] + 5e-5)
    assert found["total"] == pytest.approx(found["shupe"] + found["eo_axial"] + found["eo_radial"], rel=1e-12)
    assert 0 < found["error_estimate"] < 2e-3 and set(found["part_error_estimates"]) == {"shupe", "eo_axial", "eo_radial"}


def test_a_comparison_is_of_both_designs_and_their_difference(coil: fogcoil.Coil) -> None:
    other = coil.replace({"spool.hub_thickness_mm": 4.4})
    found = fogcoil.compare(coil, other, [0.0, 600.0, 3600.0], [20.0, 30.0, 30.0])
    assert [(d["key"], d["a"], d["b"], d["unit"]) for d in found["differing"]] == [("spool.hub_thickness_mm", "4.0", "4.4", "mm")]
    total = found["sensitivity"]["total"]
    assert total["a"]["value"] == fogcoil.sensitivity(coil)["total"] and total["b"]["value"] == fogcoil.sensitivity(other)["total"]
    assert total["difference"]["value"] == pytest.approx(total["b"]["value"] - total["a"]["value"], abs=1e-12)
    assert 0 < total["difference"]["tolerance_sd"] < total["difference"]["tolerance_sd_apart"]
    alone = fogcoil.simulate(other, [0.0, 600.0, 3600.0], [20.0, 30.0, 30.0])
    assert found["bias"]["b"]["end_deg_per_h"] == alone["rate_deg_per_h"][-1]
    assert fogcoil.compare(coil, coil)["bias"] is None
    with pytest.raises(fogcoil.InputError, match="go together"):
        fogcoil.compare(coil, other, time_s=[0.0, 600.0])


def test_a_simulation_is_that_of_an_independent_code(coil: fogcoil.Coil, fixtures: Path) -> None:
    other = np.genfromtxt(fixtures / "nominal" / "P1.csv", delimiter=",", names=True)
    ours = fogcoil.simulate(coil, other["time_s"], other["chamber_c"], between="cubic")
    assert tuple(ours) == other.dtype.names
    for column, most in [("spool_c", 3e-4), ("rate_deg_per_h", 2.5e-3)]:  # of the peak, as in tests/nominal.rs
        peak = np.ptp(other[column])
        assert np.abs(ours[column] - other[column]).max() < most * peak, column
    assert ours.summary["rows"] == len(other) and ours.summary["steady_sensitivity_error_estimate"] > 0


def test_designs_are_altered_in_sweeps_and_threads(coil: fogcoil.Coil, fixtures: Path) -> None:
    assert coil["spool.hub_thickness_mm"] == 4.0 and coil["winding.layers"] == 36 and coil["spool.hub_bonded"] is True
    assert coil["winding.cw_climbs"] == "Right" and coil["spool.flanges[0].side"] == "Right"
    mirrored = coil.replace({"winding.cw_climbs": "Left", "spool.flanges[0].side": "Left"})
    # a path is relative to the file that was altered
    from_cell = 'FromCell("cell-reference.ron")'
    cell = coil.replace({"coil.material": from_cell, "dehomogenization": from_cell})
    thicker = coil.replace({"spool.hub_thickness_mm": np.float64(4.4), "spool.flanges[0].thickness_mm": np.int64(3)})
    assert thicker["spool.hub_thickness_mm"] == 4.4 and coil["spool.hub_thickness_mm"] == 4.0
    with ThreadPoolExecutor(2) as pool:
        totals = [found["total"] for found in pool.map(fogcoil.sensitivity, [coil, mirrored, cell, thicker])]
    # wound and held the other way round it is the same coil seen from its other face
    assert totals[1] == pytest.approx(totals[0], rel=1e-6)
    assert totals[2] == pytest.approx(-2.7025, abs=1.5e-3) and abs(totals[3] - totals[0]) > 0.01  # as in docs/validation.md
    again = pickle.loads(pickle.dumps(cell))
    assert again.text == cell.text and again.name == "reference-coil"
    assert fogcoil.Coil(coil.text, folder=fixtures).text == coil.text


def test_the_package_says_its_version_and_what_replace_does(fixtures: Path) -> None:
    manifest = (fixtures.parent / "Cargo.toml").read_text()
    assert f'version = "{fogcoil.__version__}"' in manifest
    for kind in (fogcoil.Coil, fogcoil.Cell):
        assert kind.replace.__doc__ and "other values" in kind.replace.__doc__


def test_other_threads_run_while_a_coil_is_solved(coil: fogcoil.Coil) -> None:
    ticks: list[float] = []
    done = threading.Event()

    def tick() -> None:
        while not done.wait(0.001):
            ticks.append(time.monotonic())

    ticker = threading.Thread(target=tick)
    ticker.start()
    begun = time.monotonic()
    fogcoil.sensitivity(coil)
    ended = time.monotonic()
    done.set()
    ticker.join()
    assert sum(begun < at < ended for at in ticks) > 5, (begun, ended, len(ticks))


@pytest.fixture(scope="module")
def box(coil: fogcoil.Coil) -> fogcoil.DesignBox:
    return fogcoil.DesignBox(coil)


def test_a_box_of_designs_simulates_as_the_full_chain_does(coil: fogcoil.Coil, box: fogcoil.DesignBox) -> None:
    time_s = np.arange(0.0, 6 * 3600.0, 60.0)
    chamber_c = 20.0 + 20.0 * np.sin(time_s / 3000.0)
    thin = coil.replace({"spool.hub_thickness_mm": float(coil["spool.hub_thickness_mm"]) - 0.12})
    found = box.simulate(thin, time_s, chamber_c)
    full = fogcoil.simulate(thin, time_s, chamber_c, cache=False)
    for key in ("spool_c", "rate_deg_per_h"):
        off = np.abs(found[key] - full[key]).max()
        assert off < found.summary["error_estimate"][key] < 2e-3 * np.ptp(full[key]), key
    change = np.abs(full["rate_deg_per_h"] - fogcoil.simulate(coil, time_s, chamber_c)["rate_deg_per_h"]).max()
    assert np.abs(found["rate_deg_per_h"] - full["rate_deg_per_h"]).max() < 0.05 * change


def test_a_design_outside_a_box_is_refused_until_the_box_includes_it(coil: fogcoil.Coil, box: fogcoil.DesignBox) -> None:
    thick = coil.replace({"spool.hub_thickness_mm": float(coil["spool.hub_thickness_mm"]) + 0.3})
    time_s, chamber_c = [0.0, 600.0, 1200.0], [20.0, 30.0, 30.0]
    with pytest.raises(fogcoil.InputError, match="HubThickness.*outside the range"):
        box.simulate(thick, time_s, chamber_c)
    found = box.including(thick).simulate(thick, time_s, chamber_c)
    full = fogcoil.simulate(thick, time_s, chamber_c)
    np.testing.assert_allclose(found["spool_c"], full["spool_c"], atol=5e-3)


def test_a_box_holds_the_heater_of_its_own_design(coil: fogcoil.Coil) -> None:
    # in the bare hub: the reference spool has no flange at the left
    heated = coil.replace({"heat": "(heaters: [(side: Left, power_w: 0.5)])"})
    time_s = np.arange(0.0, 6 * 3600.0, 60.0)
    found = fogcoil.DesignBox(heated).simulate(heated, time_s, np.full_like(time_s, 20.0))
    full = fogcoil.simulate(heated, time_s, np.full_like(time_s, 20.0))
    assert full["spool_c"][-1] > 25.0
    np.testing.assert_allclose(found["spool_c"], full["spool_c"], atol=5e-3)
    np.testing.assert_allclose(found["rate_deg_per_h"], full["rate_deg_per_h"], atol=5e-3 * np.abs(full["rate_deg_per_h"]).max())
