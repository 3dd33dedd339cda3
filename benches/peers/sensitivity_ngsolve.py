"""Steady sensitivity of a coil with NGSolve: thermo-elasticity in a uniform ramp, order P on a free mesh graded towards the coil's corners.

usage: sensitivity_ngsolve.py PROBLEM.json [P=4] [H=0.05] [HMAX=4] [GRADING=0.4]
H, HMAX: largest element at the coil's corners and anywhere [mm]; GRADING as in Netgen.
PROBLEM.json is written by `cargo xtask bench sensitivity`, SI: solids [{r, y, stiffness (rr, yy, hoop, ry), thermal_stress}], coil first;
turns [[r, y, factor of the hoop strain, factor of the glass's radial strain]], row (m_rx, m_ry, m_rz, m_rt), direct (what needs no strain).
One direct solve for a uniform 1 K, then the strains at every turn: cheaper than two adjoint solves for one temperature field."""
import sys, json
from common import *
ph = Phases()
from ngsolve import *
from netgen.occ import WorkPlane, Glue, OCCGeometry
ph.lap("import")
arg = dict(enumerate(sys.argv[1:]))
ORDER, H, HMAX, GRADING = int(arg.get(1, 4)), float(arg.get(2, 0.05)), float(arg.get(3, 4)), float(arg.get(4, 0.4))

def main():
    d = json.load(open(sys.argv[1])); mm = 1e3
    coil = d["solids"][0]
    faces = []
    for k, s in enumerate(d["solids"]):
        (r0, r1), (y0, y1) = (np.array(s["r"]) * mm, np.array(s["y"]) * mm)
        f = WorkPlane().MoveTo(r0, y0).Rectangle(r1 - r0, y1 - y0).Face()
        for g in faces: f = f - g                       # where two overlap the earlier one holds
        f.faces.name = f"m{k+1}"; faces.append(f)
    shape = Glue(faces)
    for v in shape.vertices:
        if any(abs(v.p.x - r * mm) < 1e-6 for r in coil["r"]) and any(abs(v.p.y - y * mm) < 1e-6 for y in coil["y"]): v.maxh = H
    mesh = Mesh(OCCGeometry(shape, dim=2).GenerateMesh(maxh=HMAX, grading=GRADING))
    ph.lap("mesh")
    V = VectorH1(mesh, order=ORDER); u, v = V.TnT()
    r, n = x, len(faces)
    cf = lambda f: mesh.MaterialCF({f"m{k+1}": f(d["solids"][k]) for k in range(n)})
    C = [[cf(lambda s: s["stiffness"][i][j]) for j in range(4)] for i in range(4)]
    B = [cf(lambda s: s["thermal_stress"][i]) for i in range(3)]
    eps = lambda w: (Grad(w)[0, 0], Grad(w)[1, 1], w[0] / r, Grad(w)[0, 1] + Grad(w)[1, 0])
    e, f = eps(u), eps(v)
    k = BilinearForm(V, symmetric=True, condense=True)
    k += (sum(C[i][j] * e[j] * f[i] for i in range(3) for j in range(3)) + C[3][3] * e[3] * f[3]) * r * dx
    load = LinearForm((B[0] * f[0] + B[1] * f[1] + B[2] * f[2]) * r * dx)
    k.Assemble(); load.Assemble(); ph.lap("assemble")
    free = V.FreeDofs(True)
    free[V.GetDofNrs(NodeId(VERTEX, 0))[1]] = False      # one node held along the axis
    inv = k.mat.Inverse(free, "sparsecholesky"); ph.lap("factor")
    w = GridFunction(V); b = load.vec
    b.data += k.harmonic_extension_trans * b
    w.vec.data = inv * b
    w.vec.data += k.harmonic_extension * w.vec
    w.vec.data += k.inner_solve * b
    ph.lap("solve")
    t = np.array(d["turns"]); at = mesh(t[:, 0] * mm, t[:, 1] * mm)
    # positions are in mm, so displacements are too: strains need no conversion
    G, U = Grad(w)(at), w(at)
    rr, yy, hoop = G[:, 0], G[:, 3], U[:, 0] / (t[:, 0] * mm)
    m = d["row"]
    axial, radial = t[:, 2] @ hoop, t[:, 3] @ (m[0] * rr + m[1] * yy + m[2] * hoop + m[3])
    ph.lap("turns")
    report(f"ngsolve/p{ORDER}", "sensitivity", V.ndof, ph, dict(total=d["direct"] + axial + radial, axial=axial, radial=radial), sum(free))

main()
