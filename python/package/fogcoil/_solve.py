"""Cells, windings, ramps and profiles."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, TypedDict, Union, cast

import numpy as np
import numpy.typing as npt

from fogcoil import _native
from fogcoil._arrays import CODE, Array, Columns, Result, arrays, profile_of, table
from fogcoil._native import Cell, Coil

AnyCoil = Union[Coil, str, "os.PathLike[str]"]
AnyCell = Union[Cell, str, "os.PathLike[str]"]


def coil_of(design: AnyCoil) -> Coil:
    """The design, read if it is a path or a text."""
    return design if isinstance(design, Coil) else Coil(design)


def homogenize(cell: AnyCell, tolerance: float = 1e-6, temperature_c: float | None = None) -> Result:
    """Effective constants of a fibre's cell, each to the relative error ``tolerance``.

    Keys: ``e_z e_r g_zr g_r k_plane_strain`` [Pa], ``nu_zr nu_r nu_rz``, ``alpha_z alpha_r`` [1/K], ``k_z k_r`` [W/(m K)], the mean radial
    strain of the glass per macroscopic strain ``m_rx m_ry m_rz`` and per kelvin ``m_rt`` [1/K]; ``error_estimate``: the numerical relative
    error of each; ``bounds``. z is the fibre, r across it.

    A cell of another kind (displaced or several fibres, voids) has constants along x, y and z, arrays ``stiffness`` [Pa] and
    ``thermal_stress`` [Pa/K], and ``transversely_isotropic``, the nearest constants. ``temperature_c`` is for constituents that are tables.
    """
    result = Result(_native.homogenize(cell if isinstance(cell, Cell) else Cell(cell), tolerance, temperature_c))
    for key in ("stiffness", "thermal_stress"):
        if key in result:
            result[key] = np.array(result[key])
    return result


def wind(coil: AnyCoil) -> Columns:
    """The turn table in order along the fibre: ``half`` ("CW", "CCW"), ``layer`` and ``turn`` from 1, ``y_mm``, ``r_mm``, ``z_start_m``,
    ``z_end_m``; a notebook shows the section."""
    return Columns(_native.wind(coil_of(coil)))


class Sensitivity(TypedDict):
    """Bias per temperature rate in a steady ramp [(deg/h)/(degC/min)]."""

    shupe: float
    """Thermal phase, eq. (1)."""
    eo_axial: float
    """Strain along the fibre, eq. (2)."""
    eo_radial: float
    """Strain across the fibre, eq. (2)."""
    total: float
    """The sum of the three."""
    length_m: float
    """The fibre's length, tails included [m]."""
    error_estimate: float
    """Numerical error of the total."""
    part_error_estimates: dict[str, float]
    """Numerical error of each part."""


def sensitivity(coil: AnyCoil) -> Sensitivity:
    """Bias per temperature rate in a steady ramp, by part. Half a second."""
    return cast(Sensitivity, Result(_native.sensitivity(coil_of(coil))))


def compare(
    a: AnyCoil,
    b: AnyCoil,
    time_s: npt.ArrayLike | None = None,
    chamber_c: npt.ArrayLike | None = None,
    *,
    between: str = "linear",
    cache: bool = True,
) -> Result:
    """Two designs side by side: the keys of ``fogcoil compare --json``.

    ``differing`` and ``tolerances`` list what differs. ``sensitivity[part]["a" | "b" | "difference"]`` has ``value``, ``error_estimate``
    (numerical) and ``tolerance_sd`` (one standard deviation) in (deg/h)/(degC/min), for the parts ``shupe``, ``eo_axial``, ``eo_radial`` and
    ``total``. The difference is b less a; numbers that both designs share deviate by the same in both, and ``tolerance_sd_apart`` is that of
    two units without a deviation in common. With a chamber ``chamber_c`` [degC] at the instants ``time_s`` [s], ``bias`` has the peak, the root mean
    square and the end of each course [deg/h], and of b less a row by row; without it is None.
    """
    profile = profile_of("compare", time_s, chamber_c)
    return Result(_native.compare(coil_of(a), coil_of(b), profile, between, CODE if cache else None))


def trim(
    coil: AnyCoil,
    time_s: npt.ArrayLike | None = None,
    chamber_c: npt.ArrayLike | None = None,
    *,
    between: str = "linear",
) -> Result:
    """Tail lengths, or turns to cut off, that null the steady sensitivity: the keys of ``fogcoil trim --json``.

    ``table`` has the sensitivity that is left for each number of turns cut off either end. With a chamber ``chamber_c`` [degC] at the instants
    ``time_s`` [s], ``transients_deg_per_h`` is what the tails' trim leaves of the bias.
    """
    return Result(_native.trim(coil_of(coil), profile_of("trim", time_s, chamber_c), between))


class Simulation(Columns):
    """Columns in time: ``time_s``, ``chamber_c``, ``spool_c``, and the bias ``shupe_deg_per_h``, ``eo_axial_deg_per_h``,
    ``eo_radial_deg_per_h``, of a design whose read-out drifts ``read_out_deg_per_h``, with mechanisms ``mechanisms_deg_per_h``, and
    ``rate_deg_per_h`` (their sum), means since the row before; ``summary`` has error estimates. ``table`` is a DataFrame."""


def simulate(
    coil: AnyCoil,
    time_s: npt.ArrayLike,
    chamber_c: npt.ArrayLike,
    *,
    left_c: npt.ArrayLike | None = None,
    right_c: npt.ArrayLike | None = None,
    mount_left_c: npt.ArrayLike | None = None,
    mount_right_c: npt.ArrayLike | None = None,
    between: str = "linear",
    mechanisms: Sequence[str | os.PathLike[str]] = (),
    further: Mapping[str, npt.ArrayLike] | None = None,
    cache: bool = True,
) -> Simulation:
    """Thermometer and bias while the chamber follows ``chamber_c`` [degC] at the instants ``time_s`` [s], from rest at the first.

    End walls and mounts follow the chamber unless they are given. ``between``: how temperatures run between the instants, ``"linear"`` or
    ``"cubic"`` (a recorded chamber). ``mechanisms`` are paths of files of your own, with values, that are at work; ``further`` are
    the columns that their laws name, at the same instants. The coil's model takes seconds to build; with ``cache`` it is kept on disk for the next time.
    """
    given = {"left_c": left_c, "right_c": right_c, "mount_left_c": mount_left_c, "mount_right_c": mount_right_c}
    drives = {name: values for name, values in given.items() if values is not None}
    profile = table("profile", {"time_s": time_s, "chamber_c": chamber_c, **drives, **(further or {})})
    return Simulation(_native.simulate(coil_of(coil), profile, between, list(mechanisms), CODE if cache else None))


class BoxSimulation(dict[str, Array]):
    """The columns of a :class:`Simulation`, as numpy arrays."""

    summary: dict[str, Any]
    """``error_estimate`` of ``spool_c`` and ``rate_deg_per_h``."""


class DesignBox:
    """One model for all designs within a box about ``coil``: what takes :func:`simulate` a second takes it milliseconds.

    The box reaches three standard deviations of the design's tolerances to either side, mounts, contact resistances and heaters as far as
    mechanisms go. It takes half a minute to build; with ``cache`` it is kept on disk, shared with :func:`diagnose`::

        box = fogcoil.DesignBox(coil)
        for hub in np.linspace(3.9, 4.1, 50):
            run = box.simulate(coil.replace({"spool.hub_thickness_mm": hub}), time_s, chamber_c)
    """

    def __init__(self, coil: AnyCoil, *, cache: bool = True) -> None:
        self._native = _native.DesignBox(coil_of(coil), CODE if cache else None)

    def simulate(
        self, coil: AnyCoil, time_s: npt.ArrayLike, chamber_c: npt.ArrayLike, *, between: str = "linear"
    ) -> BoxSimulation:
        """As :func:`simulate`, of a design in the box; end walls and mounts follow the chamber.

        ``summary["error_estimate"]`` says how far ``spool_c`` and ``rate_deg_per_h`` are anywhere from those of :func:`simulate`, an estimate.
        Raises :class:`InputError` if the design lies outside the box, or differs in its winding (but for tails) or in its parts.
        """
        profile = table("profile", {"time_s": time_s, "chamber_c": chamber_c})
        columns, (spool, rate) = self._native.simulate(coil_of(coil), profile, between)
        result = BoxSimulation(arrays(columns))
        result.summary = {"error_estimate": {"spool_c": spool, "rate_deg_per_h": rate}}
        return result

    def including(self, coil: AnyCoil) -> DesignBox:
        """The box made anew, so wide that it holds ``coil``, too: nothing is extrapolated. It is not kept on disk."""
        wider = DesignBox.__new__(DesignBox)
        wider._native = self._native.including(coil_of(coil))
        return wider
