"""Cells of coated fibres for the scripts that solve them: data, assembly of the answer; the reference cell (fixtures/cell-reference.ron)
with its converged constants."""
import math
import numpy as np

class Cell:
    """pitch, outer radii of the rings [um]; E [Pa], nu, alpha [1/K], k [W/mK] of the rings from the inside out, then of the adhesive;
    which of them are glass."""
    def __init__(self, pitch, radii, constituents, glass=(True,), square=False):
        self.pitch, self.radii, self.square = pitch, tuple(radii), square
        self.size = (pitch, pitch * (1 if square else math.sqrt(3.0)))
        E, nu, alpha, self.k = np.array(constituents, float).T
        self.mu = E / (2 * (1 + nu)); self.lam = E * nu / ((1 + nu) * (1 - 2 * nu)); self.beta = alpha * (3 * self.lam + 2 * self.mu)
        self.phases = len(E); self.glass = np.array([k < len(glass) and bool(glass[k]) for k in range(self.phases)])
        # stress xx, yy, zz per phase for the unit macro strains xx, yy, zz and the unit thermal stress
        self.sources = np.zeros((self.phases, 4, 3))
        for m in range(self.phases):
            self.sources[m, :3] = self.lam[m] + 2 * self.mu[m] * np.eye(3); self.sources[m, 3] = self.beta[m]

    def angles(self, n, power=1.3):
        """From the narrowest part of the film (0) to the corner of hexagon or square [deg], graded."""
        return [(45 if self.square else 30) * (i / n) ** power for i in range(n + 1)]

# silica, primary, secondary, adhesive
REFERENCE = Cell(170.0, (40.0, 56.0, 82.5), [[70200e6, 0.17, 0.55e-6, 1.38], [2e6, 0.4998, 250e-6, 0.15],
                                             [870e6, 0.4118, 102.75e-6, 0.30], [5.593e6, 0.49985, 250e-6, 0.45]])

# converged: a spectral code and NGSolve (orders 9-12, three meshes) agree to all digits printed
TRUE = dict(E_z=14502.3165e6, E_r=95.204994e6, G_zr=24.069245e6, G_xy=24.056231e6, nu_zr=.39183723, nu_r=.97880111,
            alpha_z=3.3600953e-6, alpha_r=1.9324022e-4, k_z=.50983184, k_r=.34149326,
            M_rx=.028357616, M_rz=-.14804431, M_rT=-1.0504148e-5)

def effective(cell, frac, vol, elastic, mu, k, xy=None):
    """Effective constants from the Gram matrices F^T K^-1 F. Elastic loads: -int S_j:eps(v) for j = xx, yy, zz, T, last the mean of
    (v_x,x + v_y,y)/2 over the glass; xy: macro shear, without it by isotropy; mu, k: -int c v,x."""
    A = np.einsum("m,mjk->kj", frac, cell.sources); G = elastic[:4, :4] / vol; M = elastic[4]
    C = A[:, :3] - G[:3, :3]; beta = A[:, 3] - G[:3, 3]
    s = np.linalg.inv(C); alpha = s @ beta
    return dict(E_z=1 / s[2, 2], E_r=1 / s[0, 0], G_zr=frac @ cell.mu - mu / vol,
                G_xy=0.5 / (s[0, 0] - s[0, 1]) if xy is None else frac @ cell.mu - xy / vol,
                K_plane_strain=(C[0, 0] + C[0, 1]) / 2, nu_zr=-s[0, 2] / s[2, 2], nu_r=-s[0, 1] / s[0, 0], nu_rz=-s[2, 0] / s[0, 0],
                alpha_z=alpha[2], alpha_r=alpha[0], k_z=frac @ cell.k, k_r=frac @ cell.k - k / vol,
                M_rx=0.5 + M[0], M_ry=0.5 + M[1], M_rz=M[2], M_rT=-M[3])

def show(out, text):
    err = {k: abs(out[k] / w - 1) for k, w in TRUE.items()}; worst = max(err, key=err.get)
    for k, e in err.items(): print(f"# {k:8} {out[k]:.9g}  error {e:.1e}")
    print(f"# {text} | E_r {err['E_r']:.1e} worst {err[worst]:.1e} ({worst})")
