"""The tables that the program writes, opened in the libraries that its users have."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import duckdb
import numpy as np
import numpy.typing as npt
import openpyxl
import pandas
import polars
import pyarrow
import pytest

import fogcoil
from test_diagnose import free_coil, record
from test_results import PLAN

PROGRAM = os.environ.get("FOGCOIL_PROGRAM")
"""The program that was built beside the package; python/test names it."""

needs_program = pytest.mark.skipif(PROGRAM is None, reason="FOGCOIL_PROGRAM names no program")


def run(folder: Path, *arguments: str, status: int = 0) -> None:
    ended = subprocess.run([str(PROGRAM), *arguments, "--quiet"], cwd=folder, capture_output=True, text=True)
    assert ended.returncode == status, ended.stderr


def same(found: Mapping[str, Any], expected: Mapping[str, npt.NDArray[Any]]) -> None:
    """The same names, and the same doubles and texts."""
    assert list(found) == list(expected)
    for name, values in expected.items():
        np.testing.assert_array_equal(np.asarray(found[name], dtype=values.dtype), values, name)


@needs_program
def test_a_table_of_a_sweep_opens_everywhere_with_the_same_doubles(fixtures: Path, tmp_path: Path) -> None:
    plan = PLAN.replace('"coil-reference.ron"', f'"{(fixtures / "coil-reference.ron").as_posix()}"')
    (tmp_path / "plan.ron").write_text(plan)
    run(tmp_path, "sweep", "plan.ron", "--out", "swept")
    swept = fogcoil.sweep(plan)
    rows = swept.arrow
    assert rows is not None
    expected = fogcoil.Columns(swept._found)
    # a problem that no design has is empty in a CSV, and null in Parquet
    assert all(problem is None for problem in expected.pop("problem"))
    csv, parquet = str(tmp_path / "swept" / "table.csv"), str(tmp_path / "swept" / "table.parquet")
    opened = [
        pandas.read_parquet(parquet),
        pandas.read_csv(csv),
        polars.read_parquet(parquet),
        polars.read_csv(csv),
        duckdb.sql(f"select * from '{parquet}'").df(),
        duckdb.sql(f"select * from '{csv}'").df(),
        # without a file
        swept.table,
        polars.DataFrame(rows),
        pyarrow.table(rows).to_pandas(),
        duckdb.sql("select * from rows").df(),
    ]
    for frame in opened:
        columns = {name: frame[name].to_numpy() for name in frame.columns}
        assert pandas.isna(columns.pop("problem")).all()
        same(columns, expected)
    spread = duckdb.sql(f"""select stddev("total") from '{parquet}' where "winding.cw_climbs" = 'Left'""").fetchall()
    assert spread[0][0] == pytest.approx(np.std(expected["total"][1::2], ddof=1))


@needs_program
def test_the_tables_of_a_batch_open_everywhere_and_serial_numbers_keep_their_zeros(coil: fogcoil.Coil, tmp_path: Path) -> None:
    design = free_coil(coil)
    (tmp_path / "drawing.ron").write_text(design.text)
    for unit, seed in (("A-0042", 5), ("A-0043", 6)):
        pandas.DataFrame(record(design, 60.0, seed)).to_csv(tmp_path / f"{unit}.csv", index=False)
    (tmp_path / "limits.ron").write_text('(limits: {"sensitivity": Magnitude(1e-9)})')
    run(tmp_path, "batch", "drawing.ron", "A-0042.csv", "A-0043.csv", "--limits", "limits.ron", "--out", "lot", status=1)
    csv, parquet, workbook = (str(tmp_path / "lot" / f"table.{end}") for end in ("csv", "parquet", "xlsx"))
    numbers = pandas.read_parquet(parquet).select_dtypes("number").dropna(axis="columns")
    assert {"sensitivity", "sensitivity_low", "arw", "noise_deg_per_h"} <= set(numbers.columns)
    by_row = openpyxl.load_workbook(workbook).active
    assert by_row is not None
    names, *rows = by_row.iter_rows(values_only=True)
    opened = [
        pandas.read_csv(csv, dtype={"serial": str}),
        pandas.read_excel(workbook, dtype={"serial": str}),
        pandas.DataFrame(rows, columns=list(names)),
        polars.read_parquet(parquet).to_pandas(),
        polars.read_csv(csv, schema_overrides={"serial": polars.String}).to_pandas(),
        duckdb.sql(f"select * from '{parquet}'").df(),
        duckdb.sql(f"select * from read_csv('{csv}', types = {{'serial': 'VARCHAR'}})").df(),
    ]
    for frame in opened:
        assert list(frame["unit"]) == ["A-0042", "A-0043"] and list(frame["serial"]) == ["0042", "0043"]
        assert list(frame["judged"]) == ["fail", "fail"]
        same(frame[list(numbers.columns)], {name: numbers[name].to_numpy() for name in numbers.columns})
