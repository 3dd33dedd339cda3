"""Between numpy's arrays and the compiled part."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from fogcoil import _native
from fogcoil._native import InputError

Array = npt.NDArray[np.float64]

# models are kept beside those of the command line; this names the code that made them
CODE: str = _native.__file__


def arrays(columns: _native.Columns) -> dict[str, Array]:
    """Columns as arrays of their own memory."""
    return {name: np.frombuffer(data, dtype=np.float64) for name, data in columns}


def table(about: str, columns: dict[str, Any]) -> _native.Table:
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
