"""The reference cell (fixtures/cell-reference.ron: silica, primary, secondary, adhesive) with NGSolve, curved elements of order P.

usage: rve_cell_ngsolve.py [P] [H] [whole|quarter] [free|blocks] [vol=-2|0] [solver=umfpack] [bonus=0] [condense=1]
  whole    two fibres, periodic fluctuations: 5 elastic loads, 2 antiplane, 2 conduction
  quarter  the quarter of it, mirror planes on all four sides: 4 elastic loads, 1 + 1; G_xy from transverse isotropy
  free     triangles by Netgen (OCC circles); H = largest element [um], H/3 on the film's wall
  blocks   a few quadrilaterals per 30 degrees of each ring, graded towards the narrow part of the film; H = that number
  vol      order of the quadrature of the volumetric part, relative to the full one (default -2 for blocks, 0 for free)
Prints the effective constants (SI), their error against the converged solution, and one RESULT line."""
import sys
from common import *
ph = Phases()
from ngs_cell import *
ph.lap("import")
opt = dict(a.split("=") for a in sys.argv[1:] if "=" in a); arg = [a for a in sys.argv[1:] if "=" not in a]
ORDER = int(arg[0]) if arg else 6
H = float(arg[1]) if len(arg) > 1 else 2
QUARTER = "quarter" in arg; BLOCKS = "free" not in arg

def main():
    mesh = block_mesh(REFERENCE, QUARTER, ORDER, int(H)) if BLOCKS else free_mesh(REFERENCE, QUARTER, ORDER, H)
    ph.lap("mesh")
    # volumetric part: one point fewer per direction, no locking
    found = constants(REFERENCE, mesh, QUARTER, ORDER, int(opt.get("bonus", "0")), int(opt.get("vol", "-2" if BLOCKS else "0")),
                      opt.get("condense", "1") == "1", opt.get("solver", "umfpack"), lap=ph.lap)
    show(found.out, f"elements {mesh.ne} dof {found.dof} coupling {found.coupling}")
    report(f"ngsolve/p{ORDER}-{'quarter' if QUARTER else 'whole'}-{'blocks' if BLOCKS else 'free'}{H:g}", "rve-cell", found.dof, ph, found.out)

main()
