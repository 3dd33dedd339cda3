"""Tables as DataFrames, results in a notebook, interrupts, and every command of the program."""

from __future__ import annotations

import signal
import threading
import time
from pathlib import Path

import numpy as np
import pandas
import polars
import pytest

import fogcoil
from fogcoil._arrays import frame

PLAN = """(
    design: "coil-reference.ron", sampling: Grid, outputs: [Sensitivity, Winding],
    vary: {"spool.hub_thickness_mm": Steps(3.0, 5.0, 2), "winding.cw_climbs": OneOf(["Right", "Left"])}, dimensions: FollowWinding,
)"""
ENDLESS = """(design: "coil-reference.ron", sampling: MonteCarlo(1000000), others: WithinTolerances)"""
BEST = """(
    design: "coil-reference.ron", vary: {"spool.hub_thickness_mm": Whole(3, 5, 1)}, dimensions: FollowWinding,
    minimise: [Sensitivity, Mass], trials: 10,
)"""


def test_a_table_is_a_frame_of_either_library_with_the_same_doubles(coil: fogcoil.Coil) -> None:
    turns = fogcoil.wind(coil)
    native = turns.arrow
    assert native is not None
    by_pandas, by_polars = turns.table, polars.DataFrame(native)
    assert isinstance(by_pandas, pandas.DataFrame) and isinstance(frame(native), pandas.DataFrame)
    assert list(by_pandas.columns) == list(turns) == by_polars.columns
    assert by_polars.schema["layer"] == polars.Int64 and by_polars.schema["half"] == polars.String
    for name, values in turns.items():
        np.testing.assert_array_equal(by_pandas[name].to_numpy(), values, name)
        np.testing.assert_array_equal(by_polars[name].to_numpy(), values, name)
    shown = turns._repr_html_()
    assert "data:image/svg+xml" in shown and "3798" in shown


def test_a_simulation_is_a_frame_and_shows_its_course(coil: fogcoil.Coil) -> None:
    run = fogcoil.simulate(coil, [0.0, 600.0, 1200.0], [20.0, 30.0, 30.0])
    np.testing.assert_array_equal(run.table["rate_deg_per_h"], run["rate_deg_per_h"])
    assert run.summary["rows"] == 3 and run.picture is not None and run.picture.startswith("<svg")


def test_a_sweep_is_that_of_its_designs(coil: fogcoil.Coil, fixtures: Path) -> None:
    told: list[str] = []
    found = fogcoil.sweep(PLAN, folder=fixtures, progress=told.append)
    rows = found.table
    assert found["points"] == len(rows) == 4 and told[-1] == "computing designs (4 of 4)"
    assert rows["winding.cw_climbs"].tolist() == ["Right", "Left"] * 2
    thin = coil.replace({"spool.hub_thickness_mm": 3.0, "sensor.radius_mm": 40.5})
    assert rows["total"][0] == pytest.approx(fogcoil.sensitivity(thin)["total"], rel=1e-11)
    assert found.page is not None and "4 designs" in found.page and "<iframe" in found._repr_html_()
    with pytest.raises(fogcoil.InputError, match="the text:.*seeds"):
        fogcoil.sweep(PLAN.replace("sampling", "seeds: 1, sampling"), folder=fixtures)


def test_an_optimum_is_a_design(fixtures: Path) -> None:
    found = fogcoil.optimise(BEST, folder=fixtures)
    assert found.model is not None and len(found.table) == found["tried"]
    assert fogcoil.sensitivity(found.model)["total"] == pytest.approx(found["optimum"]["total"], abs=1e-9)


@pytest.mark.skipif(threading.current_thread() is not threading.main_thread(), reason="signals go to the main thread")
def test_an_interrupt_ends_a_sweep_and_the_next_call_computes(coil: fogcoil.Coil, fixtures: Path) -> None:
    # tests that a shell starts in the background would ignore it
    signal.signal(signal.SIGINT, signal.default_int_handler)
    begun = threading.Event()

    def interrupt() -> None:
        begun.wait()
        signal.raise_signal(signal.SIGINT)

    threading.Thread(target=interrupt).start()
    asked = time.process_time()
    with pytest.raises(KeyboardInterrupt):
        fogcoil.sweep(ENDLESS, folder=fixtures, progress=lambda _: begun.set())
    assert time.process_time() - asked < 60.0, "a million designs take hours"

    def refuse(task: str) -> None:
        raise LookupError(task)

    with pytest.raises(LookupError, match="computing designs"):
        fogcoil.sweep(ENDLESS, folder=fixtures, progress=refuse)
    assert fogcoil.sensitivity(coil)["total"] < 0


def test_what_trimming_leaves(coil: fogcoil.Coil) -> None:
    found = fogcoil.trim(coil)
    assert found["sensitivity"] == pytest.approx(fogcoil.sensitivity(coil)["total"], abs=1e-9)
    assert len(found.table) == len(found["turns_cut_off"]) and set(found.table["half"]) == {"CW", "CCW"}


def test_a_record_is_checked_and_its_allan_deviation_is_drawn(fixtures: Path) -> None:
    found = fogcoil.check(fixtures / "recordings" / "logger.csv")
    assert found["usable"] is True and found.picture is not None and "Allan" in found.picture
    assert found.table is None and found.arrow is None


def test_ids_and_files_are_explained() -> None:
    assert fogcoil.explain("debond")["id"] == "debond"
    assert "debond" in {entry["id"] for entry in fogcoil.explain()["mechanisms"]}
    assert fogcoil.explain(fogcoil.new("mechanism")).text
    with pytest.raises(fogcoil.InputError, match="nearest: debond"):
        fogcoil.explain("debnd")
    with pytest.raises(fogcoil.InputError, match="kind: .* coil, cell"):
        fogcoil.new("spool")


def test_every_command_has_its_function() -> None:
    documents = Path(__file__).resolve().parents[2] / "crates" / "fogcoil" / "README.md"
    commands = {line.split()[1] for line in documents.read_text().splitlines() if line.startswith("fogcoil ")}
    assert commands >= {"sweep", "batch", "identify"}
    missing = {command for command in commands if not hasattr(fogcoil, command)}
    assert missing == {"completions"}, missing
