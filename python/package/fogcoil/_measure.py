"""A recording's figures as specifications of gyroscopes state them."""

from __future__ import annotations

import os
from typing import Any, TypedDict, cast

from fogcoil import _native
from fogcoil._arrays import Result
from fogcoil._diagnose import Record, record as checked
from fogcoil._solve import AnyCoil, coil_of


class Figure(TypedDict):
    """A number with the ends of its 90 % interval."""

    value: float
    ci90: list[float]


class Measurement(TypedDict):
    """Figures of a recording; None where it does not tell one, with the reason in ``notes``."""

    sensitivity: Figure | None
    """Bias of a steady ramp [(deg/h)/(degC/min)], the mean of heating and cooling."""
    heating: Figure | None
    """While the temperature rises."""
    cooling: Figure | None
    """While it falls."""
    asymmetry: Figure | None
    """Heating less cooling."""
    hysteresis: Figure | None
    """Bias at rest at one temperature, reached from below less reached from above [deg/h]."""
    bias_span: Figure | None
    """Largest less least bias at rest over the record's range of temperatures [deg/h]."""
    peak: Figure | None
    """Bias by temperature where it is largest, relative to the first row [deg/h]."""
    peak_time_s: float | None
    peak_under: dict[str, float] | None
    """Length of the record of the peak, ``length_s``, and its fastest change of temperature, ``fastest_c_per_min``."""
    arw: Figure | None
    """Angle random walk [deg/sqrt(h)]."""
    bias_instability: Figure | None
    """Floor of the Allan deviation [deg/h]; B of IEEE Std 952 is the floor over 0.664."""
    floor_time_s: float | None
    bias_instability_is_bound: bool
    """Whether it is an upper bound, as the temperature changed."""
    prediction: dict[str, Any] | None
    """Of the design that was given: ``value``, ``ci90`` and ``sigmas``, measured less predicted in standard deviations of both together."""
    notes: list[str]
    """What a user should know besides."""
    not_known: dict[str, str]
    """The reason for each figure that is not known."""
    without_interval: dict[str, float]
    """Figures whose interval alone is not known; they are None above."""


def measure(record: Record, coil: AnyCoil | None = None, *, meta: str | os.PathLike[str] | None = None) -> Measurement:
    """Bias sensitivity per degC/min, bias over temperature, hysteresis and noise of ``record``, each with a 90 % interval.

    ``record`` is a path or columns by name, as :func:`fogcoil.diagnose` takes them. With ``coil`` the sensitivity that the design predicts stands beside
    the measured one. ``meta`` is the path of a meta file; without it, ``meta.ron`` beside a CSV is read.
    """
    design = None if coil is None else coil_of(coil)
    return cast(Measurement, Result(_native.measure(checked("record", record), design, meta)))


def check(record: Record, *, meta: str | os.PathLike[str] | None = None) -> Result:
    """Is ``record`` usable, and which noise is in it? The keys of ``fogcoil check --json``; a notebook shows the Allan deviation."""
    return Result(_native.check(checked("record", record), meta))
