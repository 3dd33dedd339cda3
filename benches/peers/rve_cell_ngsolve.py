"""The reference cell (fixtures/cell-reference.ron: silica, primary, secondary, adhesive) with NGSolve, curved elements of order P.

usage: rve_cell_ngsolve.py [P] [H] [whole|quarter] [free|blocks] [vol=-2|0] [solver=umfpack] [bonus=0] [condense=1]
  whole    two fibres, periodic fluctuations: 5 elastic loads, 2 antiplane, 2 conduction
  quarter  the quarter of it, mirror planes on all four sides: 4 elastic loads, 1 + 1; G_xy from transverse isotropy
  free     triangles by Netgen (OCC circles); H = largest element [um], H/3 on the film's wall
  blocks   a few quadrilaterals per 30 degrees of each ring, graded towards the narrow part of the film; H = that number
  vol      order of the quadrature of the volumetric part, relative to the full one (default -2 for blocks, 0 for free)
Prints the effective constants (SI), their error against the converged solution, and one RESULT line."""
import sys, math
from common import *
ph = Phases()
from cell_common import *
from ngsolve import *
ph.lap("import")
opt = dict(a.split("=") for a in sys.argv[1:] if "=" in a); arg = [a for a in sys.argv[1:] if "=" not in a]
ORDER = int(arg[0]) if arg else 6
H = float(arg[1]) if len(arg) > 1 else 2
QUARTER = "quarter" in arg; BLOCKS = "free" not in arg
CONDENSE = opt.get("condense", "1") == "1"

W, HT = (c / (2 if QUARTER else 1) for c in CELL_SIZE)
CENTRES = ((0, 0), (W, HT)) if QUARTER else ((W / 2, HT / 2), (0, 0), (W, 0), (0, HT), (W, HT))
SIDES = ("left", "right", "bottom", "top")

def free_mesh():
    from netgen.occ import WorkPlane, Glue, OCCGeometry, IdentificationType, gp_Trsf, Vec
    rest = WorkPlane().Rectangle(W, HT).Face(); parts = []
    for r in RADII[::-1]:
        discs = [WorkPlane().MoveTo(x, y).Circle(x, y, r).Face() for x, y in CENTRES]
        if r == RADII[-1]:
            for f in discs: f.edges.maxh = H / 3
        disc = sum(discs[1:], discs[0])
        parts.append(rest - disc); rest = rest * disc
    for k, f in enumerate([rest] + parts[::-1]): f.faces.name = f"m{k+1}"
    g = Glue([rest] + parts[::-1])
    for k, name in enumerate(SIDES):
        for e in g.edges:
            if abs(e.center[k // 2] - (0, W, 0, HT)[k]) < 1e-6: e.name = name
    if not QUARTER:
        for ax, tr in ((0, (W, 0, 0)), (1, (0, HT, 0))):
            for e in g.edges:
                if e.name != SIDES[2 * ax]: continue
                for f in g.edges:
                    if f.name == SIDES[2 * ax + 1] and abs(e.center[1 - ax] - f.center[1 - ax]) < 1e-6:
                        e.Identify(f, f"{ax}{e.center[1 - ax]:.3f}", IdentificationType.PERIODIC, gp_Trsf.Translation(Vec(*tr)))
    mesh = Mesh(OCCGeometry(g, dim=2).GenerateMesh(maxh=H, grading=0.5))
    mesh.Curve(ORDER)
    return mesh

def block_mesh():
    """Straight blocks between rays from each fibre centre, then bent: chords to arcs of the same angle, the hexagon's sides stay."""
    from netgen.meshing import Mesh as NgMesh, FaceDescriptor, Element1D, Element2D, MeshPoint, Pnt, PointId
    t = breaks(int(H))
    ng = NgMesh(dim=2); pts, ids, data = [], {}, []
    for k in range(4): ng.Add(FaceDescriptor(surfnr=k + 1, domin=k + 1, bc=k + 1)); ng.SetMaterial(k + 1, f"m{k+1}")
    def node(x, y):
        key = (round(x * 1e4), round(y * 1e4))
        if key not in ids: pts.append((x, y)); ids[key] = ng.Add(MeshPoint(Pnt(x, y, 0)))
        return ids[key]
    for cx, cy in CENTRES:
        for s in range(12):
            if not (-1e-9 < cx + math.cos(math.radians(30 * s + 15)) < W and -1e-9 < cy + math.sin(math.radians(30 * s + 15)) < HT): continue
            flat = 60 * ((s + 1) // 2)                                 # direction of the nearest hexagon side
            br = [flat + b for b in t] if s % 2 == 0 else [flat - b for b in t[::-1]]
            for a0, a1 in zip(br[:-1], br[1:]):
                def at(r, a):
                    q = PITCH / 2 / math.cos(math.radians(a - flat)) if r is None else r
                    return node(cx + q * math.cos(math.radians(a)), cy + q * math.sin(math.radians(a)))
                row = [cx, cy, math.radians((a0 + a1) / 2), math.radians((a1 - a0) / 2), math.radians(flat)]
                ng.Add(Element2D(1, [node(cx, cy), at(RADII[0], a0), at(RADII[0], a1)])); data.append(row)
                for k, (r0, r1) in enumerate(zip(RADII, RADII[1:] + (None,))):
                    ng.Add(Element2D(k + 2, [at(r0, a0), at(r1, a0), at(r1, a1), at(r0, a1)])); data.append(row)
    P = np.array(pts); num = np.array([i.nr for i in ids.values()])
    for k, name in enumerate(SIDES):
        i = np.flatnonzero(abs(P[:, k // 2] - (0, W, 0, HT)[k]) < 1e-6); i = num[i[np.argsort(P[i, 1 - k // 2])]]
        for a, b in zip(i[:-1], i[1:]): ng.Add(Element1D([int(a), int(b)], index=k + 1))
        ng.SetBCName(k, name)
        if k % 2 and not QUARTER:
            for a, b in zip(last, i): ng.AddPointIdentification(PointId(int(a)), PointId(int(b)), identnr=k // 2 + 1, type=2)
        last = i
    ng.Update(); mesh = Mesh(ng)
    const = []
    for c in np.array(data).T:
        gf = GridFunction(L2(mesh, order=0)); gf.vec.FV().NumPy()[:] = c; const.append(gf)
    cx, cy, mid, d, flat = const
    a = (x - cx) * cos(mid) + (y - cy) * sin(mid); b = (y - cy) * cos(mid) - (x - cx) * sin(mid)
    def bend(R, xi): return R * (cos(xi * d) - cos(d)), R * (sin(xi * d) - xi * sin(d))      # arc minus chord
    xi = b / (a * tan(d)); ring = bend(a / cos(d), xi)
    s = a / (RADII[0] * cos(d)); u = b / (RADII[0] * sin(d)); core = [q * (s * s - u * u) / (1 - u * u) for q in bend(RADII[0], u)]
    r3 = RADII[-1] * cos(d); ah = a * PITCH / 2 / ((x - cx) * cos(flat) + (y - cy) * sin(flat))
    film = [q * (ah - a) / (ah - r3) for q in bend(RADII[-1], xi)]
    da, db = [mesh.MaterialCF(dict(m1=core[i], m2=ring[i], m3=ring[i], m4=film[i])) for i in (0, 1)]
    shift = GridFunction(VectorH1(mesh, order=ORDER))
    shift.Set(CF((da * cos(mid) - db * sin(mid), da * sin(mid) + db * cos(mid))), bonus_intorder=4)
    mesh.SetDeformation(shift)
    return mesh

def main():
    mesh = block_mesh() if BLOCKS else free_mesh()
    ph.lap("mesh")
    DX = dx(bonus_intorder=int(opt.get("bonus", "0"))); vol = W * HT
    DXV = dx(bonus_intorder=int(opt.get("vol", "-2" if BLOCKS else "0")))    # one point fewer per direction: no locking
    names = [f"m{k+1}" for k in range(4)]
    cf = lambda v: mesh.MaterialCF({n: float(q) for n, q in zip(names, v)})
    wrap = (lambda V: V) if QUARTER else Periodic
    def gram(fes, form, loads):
        """F^T K^-1 F, inner unknowns eliminated element by element."""
        free = fes.FreeDofs(CONDENSE)
        if not QUARTER:
            for dof in fes.GetDofNrs(NodeId(VERTEX, 0)): free[dof] = False
        k = BilinearForm(fes, symmetric=True, condense=CONDENSE); k += form; k.Assemble()
        F = MultiVector(k.mat.CreateColVector(), len(loads))
        for j, f in enumerate(loads): F[j].data = f.Assemble().vec
        ph.lap("assemble")
        inv = k.mat.Inverse(free, opt.get("solver", "umfpack")); ph.lap("factor")
        G = np.zeros((len(loads), len(loads)))
        if CONDENSE:
            X = (k.inner_solve * F).Evaluate(); G += np.array(InnerProduct(F, X).NumPy())
            for j in range(len(loads)): F[j].data += k.harmonic_extension_trans * F[j]
        X = (inv * F).Evaluate(); G += np.array(InnerProduct(F, X).NumPy())
        ph.lap("solve")
        return G

    lam, mu = cf(LAM), cf(MU)
    V = wrap(VectorH1(mesh, order=ORDER, **(dict(dirichletx="left|right", dirichlety="bottom|top") if QUARTER else {})))
    u, v = V.TnT(); e, g = Grad(u), Grad(v)
    frac = Integrate(CF(tuple(cf(row) for row in np.eye(4))), mesh, order=2 * ORDER); frac = np.array(list(frac)) / vol
    div, shear = lambda w: w[0, 0] + w[1, 1], lambda w: w[0, 1] + w[1, 0]
    loads = [LinearForm(f) for f in (-lam * div(g) * DXV - 2 * mu * g[0, 0] * DX, -lam * div(g) * DXV - 2 * mu * g[1, 1] * DX, -lam * div(g) * DXV)]
    loads.append(LinearForm(-cf(BETA) * div(g) * DXV))
    if not QUARTER: loads.append(LinearForm(-mu * shear(g) * DX))
    loads.append(LinearForm(cf([0.5 / (frac[0] * vol), 0, 0, 0]) * div(g) * DX))
    G = gram(V, lam * div(e) * div(g) * DXV + mu * (2 * e[0, 0] * g[0, 0] + 2 * e[1, 1] * g[1, 1] + shear(e) * shear(g)) * DX, loads)
    Q = wrap(H1(mesh, order=ORDER, dirichlet="left|right" if QUARTER else "")); p, q = Q.TnT()
    R = [gram(Q, c * grad(p) * grad(q) * DX, [LinearForm(-c * grad(q)[i] * DX) for i in range(1 if QUARTER else 2)])[0, 0]
         for c in (cf(MU), cf(KCOND))]
    out = effective(frac, vol, G, *R)
    ph.lap("solve")
    show(out, f"elements {mesh.ne} dof {V.ndof} coupling {sum(V.FreeDofs(CONDENSE))}")
    report(f"ngsolve/p{ORDER}-{'quarter' if QUARTER else 'whole'}-{'blocks' if BLOCKS else 'free'}{H:g}", "rve-cell", V.ndof, ph, out)

main()
