"""Many designs, and constituents, from files of plans and targets; the meaning of ids; files to start from."""

from __future__ import annotations

import os
from collections.abc import Callable

from fogcoil import _native
from fogcoil._arrays import CODE, Result
from fogcoil._diagnose import by_tenths
from fogcoil._native import Coil
from fogcoil._solve import AnyCoil, coil_of

Progress = Callable[[str], object]


def sweep(
    plan: _native.Source, *, folder: str | os.PathLike[str] | None = None, progress: Progress | None = None
) -> Result:
    """Designs around a drawing, computed by the thousand: the keys of ``fogcoil sweep --json``; ``table`` has a row for each.

    ``plan`` is the path of a plan, or its RON text, whose paths are relative to ``folder``. ``progress`` (e.g. ``print``) is called with each task as it
    begins, and at each tenth of it.
    """
    return Result(_native.sweep(plan, folder, CODE, by_tenths(progress)))


class Optimum(Result):
    """The best designs of a plan: the keys of ``fogcoil optimise --json``; ``table`` has a row for each design that was tried."""

    model: Coil | None
    """The optimum; None if no design that was tried keeps the limits."""


def optimise(
    plan: _native.Source, *, folder: str | os.PathLike[str] | None = None, progress: Progress | None = None
) -> Optimum:
    """The design with the least sensitivity, spread, mass or length, as a plan asks, within limits. ``plan``, ``folder`` and ``progress`` as for :func:`sweep`."""
    found, model = _native.optimise(plan, folder, by_tenths(progress))
    result = Optimum(found)
    result.model = model
    return result


def identify(
    targets: _native.Source, *, folder: str | os.PathLike[str] | None = None, progress: Progress | None = None
) -> Result:
    """Constituents from measured effective constants: the keys of ``fogcoil identify --json``.

    ``targets`` is the path of a file of targets, or its RON text. ``progress`` as for :func:`sweep`.
    """
    return Result(_native.identify(targets, folder, by_tenths(progress)))


def explain(
    subject: AnyCoil | None = None,
    sensitivity: float | None = None,
    *,
    signed: bool = False,
    cache: bool = True,
    progress: Progress | None = None,
) -> Result:
    """The meaning of an id of a mechanism or a warning, or of a file of a mechanism of your own; without a ``subject``, of all ids.

    With a measured ``sensitivity`` [(deg/h)/(degC/min)] ``subject`` is a coil: which change would give it. It is a magnitude unless it is negative, or ``signed``.
    """
    if sensitivity is not None and subject is not None:
        code = CODE if cache else None
        return Result(_native.explain_sensitivity(coil_of(subject), sensitivity, signed, code, by_tenths(progress)))
    if sensitivity is not None or isinstance(subject, Coil):
        raise _native.InputError("explain: a coil and a sensitivity go together; give both, or an id alone")
    name = None if subject is None else os.fspath(subject)
    if name is not None and (name.endswith(".ron") or "\n" in name or name.lstrip().startswith("(")):
        return Result(_native.explain_mechanism(name))
    return Result(_native.explain_id(name))


def new(kind: str = "coil") -> str:
    """The text of a commented file to start from: a ``coil``, a ``cell``, ``targets``, a ``mechanism`` or a ``profile``."""
    return _native.template(kind)
