"""Between arrays, tables and the compiled part."""

from __future__ import annotations

import html
import importlib.util
import json
import sys
from base64 import b64encode
from typing import Any

import numpy as np
import numpy.typing as npt

from fogcoil import _native
from fogcoil._native import InputError

Array = npt.NDArray[Any]

# models are kept beside those of the command line; this names the code that made them
CODE: str = _native.__file__


def arrays(table: _native.Table) -> dict[str, Array]:
    """Columns as arrays of their own memory; a missing text is None."""

    def array(values: bytearray | tuple[bytearray] | list[str | None]) -> Array:
        if isinstance(values, bytearray):
            return np.frombuffer(values, dtype=np.float64)
        if isinstance(values, tuple):
            return np.frombuffer(values[0], dtype=np.int64)
        return np.array(values, dtype=object if None in values else None)

    return {name: array(values) for name, values in table.columns()}


def frame(table: _native.Table) -> Any:
    """A DataFrame of pandas or polars, whichever is imported, else installed; pandas if it is both."""
    known = ("pandas", "polars")
    there = [name for name in known if name in sys.modules] or [name for name in known if importlib.util.find_spec(name)]
    if not there:
        raise ImportError("a DataFrame needs pandas or polars: install one of them; the columns are arrays without")
    if there[0] == "polars":
        import polars

        return polars.DataFrame(table)
    if importlib.util.find_spec("pyarrow"):
        import pyarrow

        return pyarrow.table(table).to_pandas()
    import pandas

    return pandas.DataFrame(arrays(table))


class Shown:
    """A result that a notebook shows: the words of the command line, and its picture."""

    _found: _native.Found

    @property
    def text(self) -> str:
        """The words of the command line."""
        return self._found.text

    @property
    def picture(self) -> str | None:
        """An SVG document, where there is one."""
        return self._found.picture

    @property
    def page(self) -> str | None:
        """An HTML page that needs nothing but itself, where there is one."""
        return self._found.page

    @property
    def table(self) -> Any:
        """The table as a DataFrame of pandas or polars, whichever is imported, else installed; None where there is no table."""
        return None if self._found.table is None else frame(self._found.table)

    @property
    def arrow(self) -> _native.Table | None:
        """The table by Arrow's C data interface, as polars, pyarrow and DuckDB take it; None where there is no table."""
        return self._found.table

    def _repr_html_(self) -> str:
        shown = f"<pre>{html.escape(self.text)}</pre>"
        if self.picture is not None:
            data = b64encode(self.picture.encode()).decode()
            shown += f'<img alt="" style="max-width: 100%; background: white" src="data:image/svg+xml;base64,{data}">'
        if self.page is not None:
            shown += f'<iframe style="width: 100%; height: 40em; border: 0" srcdoc="{html.escape(self.page)}"></iframe>'
        return shown


class Result(Shown, dict[str, Any]):
    """The keys of the command's ``--json``, with ``text``, ``table``, ``picture`` and ``page``; a notebook shows it."""

    def __init__(self, found: _native.Found, **further: Any) -> None:
        super().__init__(json.loads(found.json), **further)
        self._found = found


class Columns(Shown, dict[str, Array]):
    """Columns by name as numpy arrays; ``table`` is the same as a DataFrame, ``summary`` its figures. A notebook shows it."""

    summary: dict[str, Any]
    """The keys of the command's ``--json``."""

    def __init__(self, found: _native.Found) -> None:
        super().__init__({} if found.table is None else arrays(found.table))
        self._found = found
        self.summary = json.loads(found.json)


def table(about: str, columns: dict[str, Any]) -> _native.Columns:
    """Columns of numbers, all of one length; ``about`` is what a message calls them."""
    lists = []
    for name, values in columns.items():
        try:
            array = np.asarray(values, dtype=np.float64)
        except (TypeError, ValueError) as error:
            raise InputError(f"{about}: {name}: is no array of numbers ({error})") from None
        if array.ndim != 1:
            raise InputError(f"{about}: {name}: has {array.ndim} dimensions; give one number an instant")
        lists.append((name, array.tolist()))
    lengths = {name: len(values) for name, values in lists}
    if len(set(lengths.values())) > 1:
        each = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise InputError(f"{about}: the columns differ in length ({each}); give one value an instant in each")
    return lists


def profile_of(
    name: str, time_s: npt.ArrayLike | None, chamber_c: npt.ArrayLike | None
) -> _native.Columns | None:
    """A profile that may be left out; ``name`` is that of the function."""
    if (time_s is None) != (chamber_c is None):
        raise InputError(f"{name}: time_s and chamber_c go together; give both or neither")
    return None if time_s is None else table("profile", {"time_s": time_s, "chamber_c": chamber_c})
