"""The compiled part; use the package's own functions."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import SupportsFloat, SupportsIndex, Union

Source = Union[str, "os.PathLike[str]"]
Value = Union[SupportsFloat, SupportsIndex, str]
Columns = list[tuple[str, bytearray]]
Table = list[tuple[str, list[float]]]
Record = tuple[str, Union[Table, None]]
Progress = Callable[[str, Union[tuple[int, int], None]], object]

__version__: str

class InputError(ValueError):
    """An input that cannot be used: what is wrong, where (``file:line: field``), and how to mend it."""

class Coil:
    """A coil's design, checked and immutable: the content of a ``COIL.ron``.

    ``source`` is a path, or RON text (anything that starts with a bracket or has more than one line); paths to cells inside a text
    are relative to ``folder``. What is allowed but looks like a mistake is a :class:`UserWarning`.

    ``coil["spool.hub_thickness_mm"]`` is a value of it; list elements are ``spool.flanges[0].side``. Pickles.

    Raises :class:`InputError`.
    """

    def __new__(cls, source: Source, folder: str | os.PathLike[str] | None = None) -> Coil: ...
    @property
    def name(self) -> str:
        """Its name."""
    @property
    def text(self) -> str:
        """The RON text, which ``pathlib.Path.write_text`` saves as a case file."""
    @property
    def warnings(self) -> list[str]:
        """What is allowed but looks like a mistake."""
    def __getitem__(self, field: str) -> float | int | bool | str:
        """A value: a number, a boolean, or RON text as it stands."""
    def replace(self, changes: Mapping[str, Value]) -> Coil:
        """The design with other values, ``{"spool.hub_thickness_mm": 3.0}``; all are put in before it is checked.

        Values are numbers, booleans, or a string of RON: ``{"winding.cw_climbs": "Left", "name": '"thin hub"'}``. A field that may be left
        out, and is, is added. Raises :class:`InputError`.
        """

class Cell:
    """A fibre's cell, checked and immutable: the content of a ``CELL.ron``. As :class:`Coil`."""

    def __new__(cls, source: Source, folder: str | os.PathLike[str] | None = None) -> Cell: ...
    @property
    def name(self) -> str:
        """Its name."""
    @property
    def text(self) -> str:
        """The RON text, which ``pathlib.Path.write_text`` saves as a case file."""
    def __getitem__(self, field: str) -> float | int | bool | str:
        """A value: a number, a boolean, or RON text as it stands."""
    def replace(self, changes: Mapping[str, Value]) -> Cell:
        """The cell with other values, ``{"pitch_um": 172.0}``; all are put in before it is checked. As :meth:`Coil.replace`."""

class DesignBox:
    """A design's model for all designs that differ from it within a box. Immutable."""

    def __new__(cls, coil: Coil, code: str | None) -> DesignBox: ...
    def including(self, coil: Coil) -> DesignBox: ...
    def simulate(self, coil: Coil, profile: Table, between: str) -> tuple[Columns, tuple[float, float]]: ...

def homogenize(cell: Cell, tolerance: float, temperature_c: float | None) -> str: ...
def wind(coil: Coil) -> tuple[list[str], list[int], list[int], Columns]: ...
def sensitivity(coil: Coil) -> str: ...
def compare(a: Coil, b: Coil, profile: Table | None, between: str, code: str | None) -> str: ...
def simulate(
    coil: Coil, profile: Table, between: str, mechanisms: list[str | os.PathLike[str]], code: str | None
) -> tuple[Columns, str]: ...
def further_columns(mechanisms: list[str | os.PathLike[str]]) -> list[str]: ...
def measure(record: Record, coil: Coil | None, meta: str | os.PathLike[str] | None) -> str: ...
def diagnose(
    coil: Coil,
    fit: list[Record],
    holdout: list[Record],
    mechanisms: list[str | os.PathLike[str]],
    meta: str | os.PathLike[str] | None,
    code: str | None,
    progress: Progress | None,
) -> tuple[str, str, Columns | None, Coil | None]: ...
