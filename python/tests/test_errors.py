"""What is wrong is said in one message; a panic would be no Exception and fail these tests."""

from __future__ import annotations

import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path

import numpy as np
import pytest

import fogcoil


def said(call: Callable[[], object]) -> str:
    with pytest.raises(fogcoil.InputError) as error:
        call()
    assert isinstance(error.value, ValueError) and "\n" not in str(error.value)
    return str(error.value)


def test_a_design_that_cannot_be_used_is_named_with_line_and_remedy(coil: fogcoil.Coil, fixtures: Path, tmp_path: Path) -> None:
    assert "cannot be read" in said(lambda: fogcoil.wind(tmp_path / "none.ron"))
    assert "is a directory" in said(lambda: fogcoil.homogenize(str(tmp_path)))
    assert said(lambda: fogcoil.Coil("(\n  nome: 1,\n)", folder=fixtures)).startswith("the text:2: ")
    assert "the text:2: " in said(lambda: fogcoil.Coil("(\n  nome: 1,\n)"))
    assert "folder" in said(lambda: fogcoil.Coil(fixtures / "coil-reference.ron", folder=fixtures))
    thin = said(lambda: coil.replace({"spool.hub_thickness_mm": -1.0}))
    assert "coil-reference.ron (altered):29: spool.hub_thickness_mm: -1 is not greater than 0; give the value in mm" in thin
    assert "there is spool.hub_thickness_mm" in said(lambda: coil.replace({"spool.hub_thickness": 1.0}))
    assert "is no field here" in said(lambda: coil["spool.hub"])
    assert "is no value" in said(lambda: coil.replace({"spool": [1, 2]}))  # type: ignore[dict-item]
    assert "hub_thicness_mm" in said(lambda: coil.replace({"spool.hub_thicness_mm": 1.0}))
    assert "not_there.ron" in said(lambda: coil.replace({"coil.material": 'FromCell("not_there.ron")'}))
    for value in ("", "(", "Some((", '"', "// x", "\0", "1e999", "nan"):
        said(partial(coil.replace, {"spool.hub_thickness_mm": value}))
    with pytest.raises(TypeError):
        fogcoil.wind(3)  # type: ignore[arg-type]


def test_what_looks_like_a_mistake_is_a_warning(coil: fogcoil.Coil) -> None:
    with pytest.warns(UserWarning, match="sagnac_diameter_mm: 20 mm lies outside the coil"):
        fogcoil.Coil(coil.text.replace("sagnac_diameter_mm: 92.325", "sagnac_diameter_mm: 20.0"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert fogcoil.Coil(coil.text).warnings == []


def test_a_tolerance_out_of_reach_is_refused(fixtures: Path) -> None:
    for tolerance in (0.0, -1.0, float("nan"), 1e-30):
        said(partial(fogcoil.homogenize, fixtures / "cell-reference.ron", tolerance))
    said(lambda: fogcoil.homogenize(fixtures / "cell-reference.ron", temperature_c=20.0))


def test_a_profile_is_checked_like_a_file_and_the_element_is_named(coil: fogcoil.Coil) -> None:
    run = fogcoil.simulate
    assert "profile: chamber_c[1]: " in said(lambda: run(coil, [0, 30, 60], [20, np.nan, 20]))
    assert "profile: time_s[2]: 30 s stands" in said(lambda: run(coil, [0, 30, 30], [20, 20, 20]))
    assert "profile: chamber_c[0]: " in said(lambda: run(coil, [0, 30], [-400, 20]))
    assert "differ in length (time_s 2, chamber_c 3)" in said(lambda: run(coil, [0, 30], [20, 20, 20]))
    assert "no array of numbers" in said(lambda: run(coil, [0, 30], ["a", "b"]))
    assert "dimensions" in said(lambda: run(coil, [0, 30], [[20], [20]]))
    assert "no row" in said(lambda: run(coil, [], []))
    assert "mount_left_c" in said(lambda: run(coil, [0, 30], [20, 20], mount_left_c=[20, 20]))
    assert "between" in said(lambda: run(coil, [0, 30], [20, 20], between="spline"))


def test_a_record_is_checked_like_a_file(coil: fogcoil.Coil, tmp_path: Path) -> None:
    ramp = {"time_s": 30.0 * np.arange(100), "chamber_c": 20 + 0.1 * np.arange(100), "rate_deg_per_h": np.full(100, 0.5)}
    diagnose = fogcoil.diagnose
    assert "fit: no record" in said(lambda: diagnose(coil, []))
    assert "give a list" in said(lambda: diagnose(coil, ramp))  # type: ignore[arg-type]
    assert "cannot be read" in said(lambda: diagnose(coil, [tmp_path / "none.csv"]))
    assert "fit[0]: there is no rate_deg_per_h" in said(lambda: diagnose(coil, [{"time_s": [0.0]}]))
    assert "neither a path nor columns" in said(lambda: diagnose(coil, [3]))
    assert "fit[0]: cannot be used" in said(lambda: diagnose(coil, [ramp]))  # a constant rate
    assert "differ in length" in said(lambda: diagnose(coil, [{**ramp, "spool_c": [20.0]}]))
    assert "fit[0]: time_s[0]: is empty" in said(lambda: diagnose(coil, [{**ramp, "time_s": np.full(100, np.nan)}]))
    assert "is the same recording as fit[0]" in said(lambda: diagnose(coil, [{**ramp, "rate_deg_per_h": np.sin(ramp["time_s"])}] * 2))
