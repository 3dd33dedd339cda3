"""The compiled part; use the package's own functions."""

from __future__ import annotations

import os
from collections.abc import Callable, Mapping
from typing import SupportsFloat, SupportsIndex, Union

Path = Union[str, "os.PathLike[str]"]
Source = Path
Value = Union[SupportsFloat, SupportsIndex, str]
Columns = list[tuple[str, list[float]]]
Record = tuple[str, Union[Columns, None]]
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

class Table:
    """A table. Immutable."""

    def __arrow_c_stream__(self, requested_schema: object = None) -> object:
        """The table by Arrow's C data interface."""
    def columns(self) -> list[tuple[str, bytearray | tuple[bytearray] | list[str | None]]]:
        """Names and values: the bytes of doubles, in a tuple those of whole numbers of 64 bits, or texts."""

class Found:
    """A result for the package's own functions."""

    json: str
    text: str
    table: Table | None
    picture: str | None
    page: str | None

class DesignBox:
    """A design's model for all designs that differ from it within a box. Immutable."""

    def __new__(cls, coil: Coil, code: str | None) -> DesignBox: ...
    def including(self, coil: Coil) -> DesignBox: ...
    def simulate(self, coil: Coil, profile: Columns, between: str) -> tuple[Table, list[float]]: ...

def homogenize(cell: Cell, tolerance: float, temperature_c: float | None) -> Found: ...
def wind(coil: Coil) -> Found: ...
def sensitivity(coil: Coil) -> Found: ...
def trim(coil: Coil, profile: Columns | None, between: str) -> Found: ...
def compare(a: Coil, b: Coil, profile: Columns | None, between: str, code: str | None) -> Found: ...
def simulate(coil: Coil, profile: Columns, between: str, mechanisms: list[Path], code: str | None) -> Found: ...
def explain_sensitivity(coil: Coil, measured: float, signed: bool, code: str | None, progress: Progress | None) -> Found: ...
def explain_id(id: str | None) -> Found: ...
def explain_mechanism(source: Source) -> Found: ...
def template(kind: str) -> str: ...
def identify(targets: Source, folder: Path | None, progress: Progress | None) -> Found: ...
def sweep(plan: Source, folder: Path | None, code: str, progress: Progress | None) -> Found: ...
def optimise(plan: Source, folder: Path | None, progress: Progress | None) -> tuple[Found, Coil | None]: ...
def check(record: Record, meta: Path | None) -> Found: ...
def measure(record: Record, coil: Coil | None, meta: Path | None) -> Found: ...
def further_columns(mechanisms: list[Path]) -> list[str]: ...
def diagnose(
    coil: Coil,
    fit: list[Record],
    holdout: list[Record],
    mechanisms: list[Path],
    meta: Path | None,
    code: str | None,
    progress: Progress | None,
) -> tuple[Found, Coil | None]: ...
def recommend(
    coil: Coil,
    between: list[str],
    records: list[Record],
    limits: list[float],
    mechanisms: list[Path],
    meta: Path | None,
    code: str | None,
    progress: Progress | None,
) -> Found: ...
def calibrate(
    coil: Coil, units: list[list[Record]], meta: Path | None, code: str | None, progress: Progress | None
) -> tuple[Found, Coil]: ...
def batch(
    coil: Coil,
    records: list[str],
    out: Path,
    limits: Source | None,
    mechanisms: list[Path],
    meta: Path | None,
    map: Path | None,
    code: str | None,
    progress: Progress | None,
) -> Found: ...
