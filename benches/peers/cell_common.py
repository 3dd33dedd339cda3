"""The reference cell (fixtures/cell-reference.ron) for the rve_cell_* scripts: data, converged constants, assembly of the answer."""
import math
import numpy as np

PITCH = 170.0; CELL_SIZE = (PITCH, PITCH * math.sqrt(3.0))                  # um
RADII = (40.0, 56.0, 82.5)
# E [Pa], nu, alpha [1/K], k [W/mK]: silica, primary, secondary, adhesive
E, NU, ALPHA, KCOND = np.array([[70200e6, 0.17, 0.55e-6, 1.38], [2e6, 0.4998, 250e-6, 0.15],
                                [870e6, 0.4118, 102.75e-6, 0.30], [5.593e6, 0.49985, 250e-6, 0.45]]).T
MU = E / (2 * (1 + NU)); LAM = E * NU / ((1 + NU) * (1 - 2 * NU)); BETA = ALPHA * (3 * LAM + 2 * MU)

# converged: a spectral code and NGSolve (orders 9-12, three meshes) agree to all digits printed
TRUE = dict(E_z=14502.3165e6, E_r=95.204994e6, G_zr=24.069245e6, G_xy=24.056231e6, nu_zr=.39183723, nu_r=.97880111,
            alpha_z=3.3600953e-6, alpha_r=1.9324022e-4, k_z=.50983184, k_r=.34149326,
            M_rx=.028357616, M_rz=-.14804431, M_rT=-1.0504148e-5)

# stress xx, yy, zz, xy per phase for the unit macro strains xx, yy, zz, the unit thermal stress, and macro shear xy
SOURCES = np.zeros((4, 5, 4))
for m in range(4):
    SOURCES[m, :3, :3] = LAM[m] + 2 * MU[m] * np.eye(3); SOURCES[m, 3, :3] = BETA[m]; SOURCES[m, 4, 3] = MU[m]

def breaks(n):
    """Angles [deg] from the narrowest part of the film (0) to the hexagon's corner (30), graded."""
    return [30 * (i / n) ** 1.3 for i in range(n + 1)]

def effective(frac, vol, elastic, mu, k):
    """Effective constants from the Gram matrices F^T K^-1 F. Elastic loads: -int S_j:eps(v) for j = xx, yy, zz, T [, xy], last the
    mean of (v_x,x + v_y,y)/2 over the silica; mu, k: -int c v,x."""
    A = np.einsum("m,mjk->kj", frac, SOURCES); G = elastic[:-1, :-1] / vol; M = elastic[-1]
    C = A[:3, :3] - G[:3, :3]; beta = A[:3, 3] - G[:3, 3]
    s = np.linalg.inv(C); alpha = s @ beta
    return dict(E_z=1 / s[2, 2], E_r=1 / s[0, 0], G_zr=frac @ MU - mu / vol,
                G_xy=frac @ MU - G[4, 4] if len(G) == 5 else 0.5 / (s[0, 0] - s[0, 1]),      # without the shear load: by isotropy
                nu_zr=-s[0, 2] / s[2, 2], nu_r=-s[0, 1] / s[0, 0], alpha_z=alpha[2], alpha_r=alpha[0],
                k_z=frac @ KCOND, k_r=frac @ KCOND - k / vol, M_rx=0.5 + M[0], M_rz=M[2], M_rT=-M[3])

def show(out, text):
    err = {k: abs(w / TRUE[k] - 1) for k, w in out.items()}; worst = max(err, key=err.get)
    for k, w in out.items(): print(f"# {k:8} {w:.9g}  error {err[k]:.1e}")
    print(f"# {text} | E_r {err['E_r']:.1e} worst {err[worst]:.1e} ({worst})")
