"""Recordings against a design."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from typing import Any, TypedDict, TypeVar, Union, cast

from fogcoil import _native
from fogcoil._arrays import CODE, Columns, Result, table
from fogcoil._native import Coil, InputError
from fogcoil._solve import AnyCoil, coil_of

Record = Union[str, "os.PathLike[str]", Any]
"""A recording: the path of a CSV, or columns by name (a mapping, a DataFrame, a structured array): ``time_s``, ``rate_deg_per_h`` and, where
there are thermometers, ``chamber_c``, ``spool_c``; NaN where a value is missing."""

T = TypeVar("T")

ESSENTIAL = ("time_s", "rate_deg_per_h")
TEMPERATURES = ("chamber_c", "spool_c")


class Diagnosis(TypedDict):
    """What a unit's recordings say about its design."""

    verdict: str
    """``explained``, ``recalibrate``, ``unknown`` (structured, but nothing in the library explains it) or ``none`` (the design suffices)."""
    verdicts: dict[str, float]
    """Probability of each verdict."""
    mechanisms: list[dict[str, Any]]
    """``id`` and marginal ``probability``, the likeliest first."""
    set: list[str]
    """All that the data do not exclude, best first."""
    parameters: dict[str, dict[str, Any]]
    """``value`` and ``ci90`` of each parameter, fitted."""
    located: dict[str, Any]
    """``stage``, ``temperature_c``, ``time_s``, ``layers`` of the first mechanism; None where it cannot be located."""
    structure: str | None
    """What was seen, in words."""
    composed: dict[str, Any] | None
    """Where the verdict is ``unknown``: the small law that was composed, with ``terms`` (equation and parameters) and ``accepted``."""
    holdout: dict[str, Any] | None
    """Of the first record held out: ``rmse_nominal``, ``rmse_model``, ``noise_floor`` [deg/h] and more."""
    notes: list[str]
    """What a user should know besides."""
    text: str
    """The answer for people."""
    prediction: Columns | None
    """Of the first record held out: ``time_s``, ``rate_deg_per_h``, the rate offset taken from the fit."""
    model: Coil | None
    """The extended design, for :func:`fogcoil.simulate`; None if a coil file cannot hold it."""


def diagnose(
    coil: AnyCoil,
    fit: Sequence[Record],
    holdout: Sequence[Record] = (),
    *,
    mechanisms: Sequence[str | os.PathLike[str]] = (),
    meta: str | os.PathLike[str] | None = None,
    cache: bool = True,
    progress: Callable[[str], object] | None = None,
) -> Diagnosis:
    """Which mechanism explains why recordings of one unit differ from its design, fitted to ``fit`` and judged on ``holdout``.

    ``mechanisms`` are paths of files of your own (``fogcoil new --kind mechanism``), weighed against those of the program; the columns that
    they name are read from the records, too. ``meta`` is the path of a meta file; without it, ``meta.ron`` beside a CSV is read. ``progress`` (e.g. ``print``) is called with
    what is being done, and at each tenth of a long task. The first diagnosis of a design takes half a minute longer; with ``cache`` its models are kept on disk.
    """
    own = list(mechanisms)
    further = _native.further_columns(own)
    fits = [record(f"fit[{n}]", given, further) for n, given in enumerate(sequence("fit", fit))]
    held = [record(f"holdout[{n}]", given, further) for n, given in enumerate(sequence("holdout", holdout))]
    if not fits:
        raise InputError("fit: no record is given; give at least one")
    code, told = CODE if cache else None, by_tenths(progress)
    found, model = _native.diagnose(coil_of(coil), fits, held, own, meta, code, told)
    prediction = None if found.table is None else Columns(found)
    return cast(Diagnosis, Result(found, text=found.text, prediction=prediction, model=model))


def by_tenths(progress: Callable[[str], object] | None) -> _native.Progress | None:
    """Tells ``progress`` a task as it begins, and again at each tenth of one that is counted, ``task (k of n)``."""
    if progress is None:
        return None
    last = ("", 0)

    def told(task: str, done: tuple[int, int] | None) -> None:
        nonlocal last
        tenth = 10 * done[0] // done[1] if done else 0
        if task != last[0] or tenth > last[1]:
            last = (task, tenth)
            progress(f"{task} ({done[0]} of {done[1]})" if done else task)

    return told


def sequence(name: str, records: Sequence[T]) -> list[T]:
    """The records; a single one is no sequence of them."""
    if not isinstance(records, (list, tuple)):
        raise InputError(f"{name}: is a {type(records).__name__}; give a list of records, e.g. {name}=[record]")
    return list(records)


def record(name: str, given: Record, further: Sequence[str] = ()) -> _native.Record:
    """A record for the compiled part; messages call columns in memory ``name``."""
    if isinstance(given, (str, os.PathLike)):
        return os.fspath(given), None
    names = getattr(getattr(given, "dtype", None), "names", None) or given
    try:
        columns = {column: given[column] for column in (*ESSENTIAL, *TEMPERATURES, *further) if column in names}
    except (TypeError, LookupError) as error:
        raise InputError(f"{name}: is neither a path nor columns by name ({error})") from None
    missing = [column for column in ESSENTIAL if column not in columns]
    if missing:
        raise InputError(f"{name}: there is no {missing[0]}; a record has {', '.join(ESSENTIAL)} and {', '.join(TEMPERATURES)}")
    return name, table(name, columns)


def recommend(
    coil: AnyCoil,
    between: Sequence[str],
    records: Sequence[Record] = (),
    *,
    coldest_c: float = -40.0,
    hottest_c: float = 60.0,
    fastest_k_per_min: float = 2.0,
    hours: float = 24.0,
    mechanisms: Sequence[str | os.PathLike[str]] = (),
    meta: str | os.PathLike[str] | None = None,
    cache: bool = True,
    progress: Callable[[str], object] | None = None,
) -> Result:
    """The chamber programme, or the further sensor, that tells mechanisms apart: the keys of ``fogcoil recommend --json``.

    ``between`` are ids; ``nominal`` and ``recalibrate`` may stand among them. ``records`` of the unit give sizes and noise. ``table`` is the profile,
    ``time_s`` and ``chamber_c``; a notebook shows what it is expected to tell. ``mechanisms``, ``meta``, ``cache`` and ``progress`` as for
    :func:`diagnose`.
    """
    own, limits = list(mechanisms), [coldest_c, hottest_c, fastest_k_per_min, hours]
    further = _native.further_columns(own)
    given = [record(f"records[{n}]", one, further) for n, one in enumerate(sequence("records", records))]
    code = CODE if cache else None
    return Result(_native.recommend(coil_of(coil), list(between), given, limits, own, meta, code, by_tenths(progress)))


class Calibration(Result):
    """Common deviations of the units of a lot: the keys of ``fogcoil calibrate --json``."""

    model: Coil
    """The lot's design, for its further units."""


def calibrate(
    coil: AnyCoil,
    units: Sequence[Sequence[Record]],
    *,
    meta: str | os.PathLike[str] | None = None,
    cache: bool = True,
    progress: Callable[[str], object] | None = None,
) -> Calibration:
    """Constants of a lot from the records of its good ``units``, a list for each unit. ``meta``, ``cache`` and ``progress`` as for :func:`diagnose`."""
    given = [
        [record(f"units[{k}][{n}]", one) for n, one in enumerate(sequence(f"units[{k}]", unit))]
        for k, unit in enumerate(sequence("units", units))
    ]
    found, model = _native.calibrate(coil_of(coil), given, meta, CODE if cache else None, by_tenths(progress))
    result = Calibration(found)
    result.model = model
    return result


def batch(
    coil: AnyCoil,
    records: Sequence[str | os.PathLike[str]],
    limits: str | os.PathLike[str] | None = None,
    *,
    out: str | os.PathLike[str] | None = None,
    mechanisms: Sequence[str | os.PathLike[str]] = (),
    meta: str | os.PathLike[str] | None = None,
    map: str | os.PathLike[str] | None = None,
    cache: bool = True,
    progress: Callable[[str], object] | None = None,
) -> Result:
    """Many units of one design, each measured, diagnosed and judged by ``limits`` (a path or a RON text).

    ``records`` are recordings, folders with the recordings of one unit, or folders of such folders. Keys: ``units``, ``failing``, and ``problems``, the
    reasons of units that could not be diagnosed; ``table`` has a row for each unit. In ``out`` the units' findings and pages are kept, and an interrupted
    batch goes on from them; without it they are not. ``mechanisms``, ``meta``, ``cache`` and ``progress`` as for :func:`diagnose`; ``map`` is the path of
    a file that says how the records are read.
    """
    given, own, code = [os.fspath(path) for path in sequence("records", records)], list(mechanisms), CODE if cache else None
    with tempfile.TemporaryDirectory() as folder:
        kept = folder if out is None else out
        return Result(_native.batch(coil_of(coil), given, kept, limits, own, meta, map, code, by_tenths(progress)))
