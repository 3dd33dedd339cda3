"""Cells of many kinds with NGSolve: the quarter cell in curved blocks graded towards the narrow part of the film, at two orders, whose
difference is the error to expect.

usage: cells_ngsolve.py CELLS.json [LOWER=8] [HIGHER=10] [N=4] [POWER=2] [whole]
CELLS.json holds a list of cells, in SI; `cargo xtask cells --peers-python PATH` writes it:
  {"pitch": m, "square": bool, "rings": [{"outer_radius": m, "glass": bool, "solid": SOLID}, ...], "adhesive": SOLID}
  SOLID = [youngs_modulus, poisson_ratio, thermal_expansion, conductivity]
N, POWER: blocks per 30 degrees (square: 45) and their grading; whole: no mirror planes. Prints for each cell a line
RESULT {"version": ..., "orders": [...], "lower": {...}, "higher": {...}}, the constants named as `fogcoil homogenize --json` names them."""
import sys, json, ngsolve
from ngs_cell import *
WHOLE = "whole" in sys.argv
FILE, *NUMBERS = [a for a in sys.argv[1:] if a != "whole"]
LOWER, HIGHER, N, POWER = [int(a) for a in NUMBERS] + [8, 10, 4, 2][len(NUMBERS):]

def read(c):
    rings = c["rings"]
    return Cell(c["pitch"] * 1e6, [r["outer_radius"] * 1e6 for r in rings], [r["solid"] for r in rings] + [c["adhesive"]],
                [r["glass"] for r in rings], c["square"])

def solve(cell, order):
    mesh = block_mesh(cell, not WHOLE, order, N, POWER)
    out = constants(cell, mesh, not WHOLE, order, bonus=4, volumetric=-2, shear=True).out     # no locking
    return {{"G_xy": "g_r"}.get(k, k.lower()): float(v) for k, v in out.items()}

ngsolve.ngsglobals.msg_level = 0
for c in json.load(open(FILE)):
    cell = read(c)
    lower, higher = (solve(cell, order) for order in (LOWER, HIGHER))
    print("RESULT " + json.dumps(dict(version=ngsolve.__version__, orders=[LOWER, HIGHER], lower=lower, higher=higher)), flush=True)
