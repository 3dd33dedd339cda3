"""Thermal bias of fibre-optic-gyroscope coils: the program ``fogcoil``, with numpy arrays in and out.

Every function takes a design as a path, as RON text, or as a :class:`Coil` (a :class:`Cell`), which ``replace`` alters::

    coil = fogcoil.Coil("coil-reference.ron")
    for hub in np.linspace(2.0, 6.0, 9):
        print(hub, fogcoil.sensitivity(coil.replace({"spool.hub_thickness_mm": hub}))["total"])

Keys and columns are those of the command line (``--json``, CSV) and carry their units; what has none in its name is SI, sensitivities are
in (deg/h)/(degC/min). Signs: y = 0 is the coil's left face, z = 0 the outer end of the CCW half.

A :class:`DesignBox` simulates one changed design after another in milliseconds.

A result shows itself in a notebook, with its picture; ``result.table`` is a DataFrame of pandas or polars, and any library that reads Arrow's C data
interface takes ``result.arrow``. Ctrl-C ends what is computed at its next step.

Bad input is an :class:`InputError`, a :class:`ValueError` whose message says what, where and how to mend it; ``RuntimeError`` is a failure
of the program's own. Other threads run while anything is computed, so that ``concurrent.futures.ThreadPoolExecutor`` makes sweeps parallel.
"""

from fogcoil._arrays import Columns, Result
from fogcoil._diagnose import Calibration, Diagnosis, Record, batch, calibrate, diagnose, recommend
from fogcoil._measure import Measurement, check, measure
from fogcoil._native import Cell, Coil, InputError, __version__
from fogcoil._plans import Optimum, explain, identify, new, optimise, sweep
from fogcoil._solve import DesignBox, Sensitivity, Simulation, compare, homogenize, sensitivity, simulate, trim, wind

__all__ = [
    "Calibration",
    "Cell",
    "Coil",
    "Columns",
    "DesignBox",
    "Diagnosis",
    "InputError",
    "Measurement",
    "Optimum",
    "Record",
    "Result",
    "Sensitivity",
    "Simulation",
    "__version__",
    "batch",
    "calibrate",
    "check",
    "compare",
    "diagnose",
    "explain",
    "homogenize",
    "identify",
    "measure",
    "new",
    "optimise",
    "recommend",
    "sensitivity",
    "simulate",
    "sweep",
    "trim",
    "wind",
]
