"""A cell (cell_common.Cell) with NGSolve: meshes of curved elements, and the cell problems on them. The whole cell holds two fibres of
hexagonal packing or one of square, periodic fluctuations; the quarter of it has mirror planes on all four sides."""
from types import SimpleNamespace
from cell_common import *
from ngsolve import *

SIDES = ("left", "right", "bottom", "top")

def layout(cell, quarter):
    """Width, height and the fibres' axes."""
    w, h = (c / (2 if quarter else 1) for c in cell.size)
    if quarter: return w, h, ((0, 0),) if cell.square else ((0, 0), (w, h))
    return w, h, ((w / 2, h / 2),) if cell.square else ((w / 2, h / 2), (0, 0), (w, 0), (0, h), (w, h))

def free_mesh(cell, quarter, order, largest):
    """Triangles by Netgen (OCC circles); largest element [um], a third of it on the film's wall."""
    from netgen.occ import WorkPlane, Glue, OCCGeometry, IdentificationType, gp_Trsf, Vec
    w, h, centres = layout(cell, quarter)
    rest = WorkPlane().Rectangle(w, h).Face(); parts = []
    for r in cell.radii[::-1]:
        discs = [WorkPlane().MoveTo(x, y).Circle(x, y, r).Face() for x, y in centres]
        if r == cell.radii[-1]:
            for f in discs: f.edges.maxh = largest / 3
        disc = sum(discs[1:], discs[0])
        parts.append(rest - disc); rest = rest * disc
    for k, f in enumerate([rest] + parts[::-1]): f.faces.name = f"m{k+1}"
    g = Glue([rest] + parts[::-1])
    for k, name in enumerate(SIDES):
        for e in g.edges:
            if abs(e.center[k // 2] - (0, w, 0, h)[k]) < 1e-6: e.name = name
    if not quarter:
        for ax, tr in ((0, (w, 0, 0)), (1, (0, h, 0))):
            for e in g.edges:
                if e.name != SIDES[2 * ax]: continue
                for f in g.edges:
                    if f.name == SIDES[2 * ax + 1] and abs(e.center[1 - ax] - f.center[1 - ax]) < 1e-6:
                        e.Identify(f, f"{ax}{e.center[1 - ax]:.3f}", IdentificationType.PERIODIC, gp_Trsf.Translation(Vec(*tr)))
    mesh = Mesh(OCCGeometry(g, dim=2).GenerateMesh(maxh=largest, grading=0.5))
    mesh.Curve(order)
    return mesh

def block_mesh(cell, quarter, order, n, power=1.3):
    """n quadrilaterals per 30 (square: 45) degrees of each ring, graded towards the narrow part of the film with that power: straight
    blocks between rays from each fibre axis, then bent: chords to arcs of the same angle, the sides of hexagon or square stay."""
    from netgen.meshing import Mesh as NgMesh, FaceDescriptor, Element1D, Element2D, MeshPoint, Pnt, PointId
    w, h, centres = layout(cell, quarter)
    t = cell.angles(n, power); sector = t[-1]; radii = cell.radii
    ng = NgMesh(dim=2); pts, ids, data = [], {}, []
    for k in range(cell.phases): ng.Add(FaceDescriptor(surfnr=k + 1, domin=k + 1, bc=k + 1)); ng.SetMaterial(k + 1, f"m{k+1}")
    def node(x, y):
        key = (round(x * 1e4), round(y * 1e4))
        if key not in ids: pts.append((x, y)); ids[key] = ng.Add(MeshPoint(Pnt(x, y, 0)))
        return ids[key]
    for cx, cy in centres:
        for s in range(round(360 / sector)):
            mid = math.radians(sector * (s + 0.5))
            if not (-1e-9 < cx + math.cos(mid) < w and -1e-9 < cy + math.sin(mid) < h): continue
            flat = 2 * sector * ((s + 1) // 2)                         # direction of the nearest side
            br = [flat + b for b in t] if s % 2 == 0 else [flat - b for b in t[::-1]]
            for a0, a1 in zip(br[:-1], br[1:]):
                def at(r, a):
                    q = cell.pitch / 2 / math.cos(math.radians(a - flat)) if r is None else r
                    return node(cx + q * math.cos(math.radians(a)), cy + q * math.sin(math.radians(a)))
                row = [cx, cy, math.radians((a0 + a1) / 2), math.radians((a1 - a0) / 2), math.radians(flat)]
                ng.Add(Element2D(1, [node(cx, cy), at(radii[0], a0), at(radii[0], a1)])); data.append(row)
                for k, (r0, r1) in enumerate(zip(radii, radii[1:] + (None,))):
                    ng.Add(Element2D(k + 2, [at(r0, a0), at(r1, a0), at(r1, a1), at(r0, a1)])); data.append(row)
    P = np.array(pts); num = np.array([i.nr for i in ids.values()])
    for k, name in enumerate(SIDES):
        i = np.flatnonzero(abs(P[:, k // 2] - (0, w, 0, h)[k]) < 1e-6); i = num[i[np.argsort(P[i, 1 - k // 2])]]
        for a, b in zip(i[:-1], i[1:]): ng.Add(Element1D([int(a), int(b)], index=k + 1))
        ng.SetBCName(k, name)
        if k % 2 and not quarter:
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
    s = a / (radii[0] * cos(d)); u = b / (radii[0] * sin(d)); core = [q * (s * s - u * u) / (1 - u * u) for q in bend(radii[0], u)]
    wall = radii[-1] * cos(d); ah = a * cell.pitch / 2 / ((x - cx) * cos(flat) + (y - cy) * sin(flat))
    film = [q * (ah - a) / (ah - wall) for q in bend(radii[-1], xi)]
    kinds = {f"m{k+1}": ring for k in range(cell.phases)} | {"m1": core, f"m{cell.phases}": film}
    da, db = [mesh.MaterialCF({m: q[i] for m, q in kinds.items()}) for i in (0, 1)]
    shift = GridFunction(VectorH1(mesh, order=order))
    shift.Set(CF((da * cos(mid) - db * sin(mid), da * sin(mid) + db * cos(mid))), bonus_intorder=4)
    mesh.SetDeformation(shift)
    return mesh

def constants(cell, mesh, quarter, order, bonus=0, volumetric=0, condense=True, solver="umfpack", shear=False, lap=lambda name: None):
    """Effective constants on a mesh, its unknowns and those left after condensation. bonus, volumetric: order of the quadrature, and of
    that of the volumetric part, relative to the full one; shear: solve macro shear xy on the quarter too, else by isotropy."""
    w, h, _ = layout(cell, quarter); vol = w * h
    DX, DXV = dx(bonus_intorder=bonus), dx(bonus_intorder=volumetric)
    names = [f"m{k+1}" for k in range(cell.phases)]
    cf = lambda v: mesh.MaterialCF({n: float(q) for n, q in zip(names, v)})
    wrap = (lambda V: V) if quarter else Periodic
    def gram(fes, form, loads):
        """F^T K^-1 F, inner unknowns eliminated element by element."""
        free = fes.FreeDofs(condense)
        if not quarter:
            for dof in fes.GetDofNrs(NodeId(VERTEX, 0)): free[dof] = False
        k = BilinearForm(fes, symmetric=True, condense=condense); k += form; k.Assemble()
        F = MultiVector(k.mat.CreateColVector(), len(loads))
        for j, f in enumerate(loads): F[j].data = f.Assemble().vec
        lap("assemble")
        inv = k.mat.Inverse(free, solver); lap("factor")
        G = np.zeros((len(loads), len(loads)))
        if condense:
            X = (k.inner_solve * F).Evaluate(); G += np.array(InnerProduct(F, X).NumPy())
            for j in range(len(loads)): F[j].data += k.harmonic_extension_trans * F[j]
        X = (inv * F).Evaluate(); G += np.array(InnerProduct(F, X).NumPy())
        lap("solve")
        return G

    lam, mu = cf(cell.lam), cf(cell.mu)
    frac = Integrate(CF(tuple(cf(row) for row in np.eye(cell.phases))), mesh, order=2 * order); frac = np.array(list(frac)) / vol
    div, slip = lambda w: w[0, 0] + w[1, 1], lambda w: w[0, 1] + w[1, 0]
    def plane(loads, **mirrors):
        V = wrap(VectorH1(mesh, order=order, **(mirrors if quarter else {})))
        u, v = V.TnT(); e, g = Grad(u), Grad(v)
        form = lam * div(e) * div(g) * DXV + mu * (2 * e[0, 0] * g[0, 0] + 2 * e[1, 1] * g[1, 1] + slip(e) * slip(g)) * DX
        return gram(V, form, [LinearForm(f) for f in loads(g)]), V
    def even(g):
        yield from (-lam * div(g) * DXV - 2 * mu * g[i, i] * DX for i in (0, 1))
        yield -lam * div(g) * DXV
        yield -cf(cell.beta) * div(g) * DXV
        yield cf(0.5 * cell.glass / (frac[cell.glass].sum() * vol)) * div(g) * DX
        if not quarter: yield from odd(g)
    def odd(g): yield -mu * slip(g) * DX
    G, V = plane(even, dirichletx="left|right", dirichlety="bottom|top")
    xy = G[5, 5] if not quarter else plane(odd, dirichletx="bottom|top", dirichlety="left|right")[0][0, 0] if shear else None
    Q = wrap(H1(mesh, order=order, dirichlet="left|right" if quarter else "")); p, q = Q.TnT()
    R = [gram(Q, c * grad(p) * grad(q) * DX, [LinearForm(-c * grad(q)[i] * DX) for i in range(1 if quarter else 2)])[0, 0]
         for c in (mu, cf(cell.k))]
    out = effective(cell, frac, vol, G, *R, xy)
    lap("solve")
    return SimpleNamespace(out=out, dof=V.ndof, coupling=sum(V.FreeDofs(condense)))
