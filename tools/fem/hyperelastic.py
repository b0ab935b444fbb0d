"""Static finite-strain elasticity, total Lagrangian, plane strain and 3D: shared by block_finite_strain.py,
csm1.py and cooks_membrane.py.  `python hyperelastic.py` checks every tangent against finite differences.

Material laws (P first Piola-Kirchhoff stress, J = det F, E Green-Lagrange strain):
  StVenantKirchhoff   P = F (lambda tr(E) 1 + 2 mu E)
  NeoHookeanLog       P = mu (F - F^-T) + lambda ln J F^-T
  NeoHookeanSplit     W = mu/2 (J^-2/3 tr(F^T F) - 3) + K/2 (J - 1)^2
A law is split as P = P0(F) + pressure dTheta/dF with pressure = kappa Theta(J), Theta = ln J or J - 1.
`pressure_modes` = m replaces Theta by its L2 projection on m local polynomials (1, xi, eta, zeta) in each
element: the mixed element with discontinuous pressure (Q2/P-1 for m = dim + 1 and quadratic elements,
Q1/P0 for m = 1 and linear ones; Simo, Taylor and Pister 1985), eliminated element by element.  Newton treats that
pressure as an unknown of its own: the geometric part of the tangent uses the linearised pressure, not the projected one,
which keeps the steps stable at large kappa.
Plane strain embeds F in 3D with F33 = 1.
"""
import numpy as np
import pypardiso
import scipy.sparse as sparse


def lame(young, poisson):
    """(mu, lambda) from Young's modulus and Poisson's ratio."""
    return young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))


def outer(a, b, pattern):
    return np.einsum(pattern + '->...iJkL', a, b)


class StVenantKirchhoff:
    kappa = None

    def __init__(self, mu, lam):
        self.mu, self.lam = mu, lam

    def stress(self, F, inverse, J):
        I = np.eye(3)
        E = 0.5 * (np.swapaxes(F, -1, -2) @ F - I)
        S = self.lam * np.trace(E, axis1=-2, axis2=-1)[..., None, None] * I + 2 * self.mu * E
        A = outer(np.broadcast_to(I, S.shape), S, '...ik,...JL') + self.lam * outer(F, F, '...iJ,...kL')
        A += self.mu * (outer(F, F, '...iL,...kJ') + outer(F @ np.swapaxes(F, -1, -2), np.broadcast_to(I, S.shape), '...ik,...JL'))
        return F @ S, A


class NeoHookeanLog:
    def __init__(self, mu, lam):
        self.mu, self.kappa = mu, lam

    def stress(self, F, inverse, J):
        I = np.broadcast_to(np.eye(3), F.shape)
        P = self.mu * (F - np.swapaxes(inverse, -1, -2))
        return P, self.mu * (outer(I, I, '...ik,...JL') + outer(inverse, inverse, '...Li,...Jk'))

    def theta(self, J):
        """Theta, J dTheta/dJ and J d(J dTheta/dJ)/dJ."""
        return np.log(J), np.ones_like(J), np.zeros_like(J)


class NeoHookeanSplit:
    def __init__(self, mu, bulk):
        self.mu, self.kappa = mu, bulk

    def stress(self, F, inverse, J):
        I = np.broadcast_to(np.eye(3), F.shape)
        m = (self.mu * J ** (-2 / 3))[..., None, None]
        I1 = np.einsum('...iJ,...iJ', F, F)[..., None, None]
        P = m * (F - I1 / 3 * np.swapaxes(inverse, -1, -2))
        m, I1 = m[..., None, None], I1[..., None, None]
        A = outer(I, I, '...ik,...JL') - 2 / 3 * (outer(F, inverse, '...iJ,...Lk') + outer(inverse, F, '...Ji,...kL'))
        A += 2 / 9 * I1 * outer(inverse, inverse, '...Ji,...Lk') + I1 / 3 * outer(inverse, inverse, '...Li,...Jk')
        return P, m * A

    def theta(self, J):
        return J - 1, J, J


class Solid:
    """Unknown displacement of one body on a scalar skfem basis (degree of freedom = dim * node + component)."""

    def __init__(self, basis, law, pressure_modes=0):
        self.basis, self.law, self.dim = basis, law, basis.mesh.dim()
        self.nodes = basis.element_dofs.T                                    # element, node
        self.gradient = np.moveaxis(np.array([b[0].grad for b in basis.basis]), (2, 3, 0, 1), (0, 1, 2, 3)).copy()  # e, q, node, J
        self.weight = basis.dx
        self.position = basis.doflocs
        self.size = self.dim * basis.N
        self.dofs = (self.dim * self.nodes[:, :, None] + np.arange(self.dim)).reshape(len(self.nodes), -1)
        q = basis.X
        self.modes = np.vstack([np.ones(q.shape[1]), *(q - 0.5)])[:pressure_modes].T if pressure_modes else None
        self.linearised_pressure = None       # element, mode; set by solve

    def deformation(self, u, part=slice(None)):
        d = self.dim
        F = np.zeros(self.weight[part].shape + (3, 3)) + np.eye(3)
        F[..., :d, :d] += np.einsum('eai,eqaJ->eqiJ', u.reshape(-1, d)[self.nodes[part]], self.gradient[part], optimize=True)
        return F

    def stress(self, F, weight, linearised_pressure=None):
        """P, tangent A, and what the elimination needs when the pressure is projected."""
        inverse, J = np.linalg.inv(F), np.linalg.det(F)
        P, A = self.law.stress(F, inverse, J)
        if self.law.kappa is None:
            return P, A, None
        theta, first, second = self.law.theta(J)
        kappa, slope = self.law.kappa, first[..., None, None] * np.swapaxes(inverse, -1, -2)
        projection = None
        if self.modes is None:
            p = used = kappa * theta
            A = A + kappa * outer(slope, slope, '...iJ,...kL')
        else:
            gram = np.linalg.inv(np.einsum('eq,qm,qn->emn', weight, self.modes, self.modes))
            projected = kappa * np.einsum('emn,en->em', gram, np.einsum('eq,qm,eq->em', weight, self.modes, theta))
            p = projected @ self.modes.T
            used = p if linearised_pressure is None else linearised_pressure @ self.modes.T
            projection = (kappa * gram, slope, projected)
        A = A + (used * second)[..., None, None, None, None] * outer(inverse, inverse, '...Ji,...Lk')
        A = A - (used * first)[..., None, None, None, None] * outer(inverse, inverse, '...Li,...Jk')
        return P + p[..., None, None] * slope, A, projection

    def assemble(self, u, free=None, chunk=200):
        """Internal force; with `free` also the upper triangle of the tangent on those degrees of freedom."""
        d, force = self.dim, np.zeros(self.size)
        number = np.full(self.size, -1)
        if free is not None:
            number[free] = np.arange(len(free))
        rows, columns, values, self.elimination = [], [], [], []
        for start in range(0, len(self.nodes), chunk):
            part = slice(start, start + chunk)
            w, g, dofs = self.weight[part], self.gradient[part], self.dofs[part]
            guess = None if self.linearised_pressure is None else self.linearised_pressure[part]
            P, A, projection = self.stress(self.deformation(u, part), w, guess)
            np.add.at(force, dofs, np.einsum('eq,eqiJ,eqaJ->eai', w, P[..., :d, :d], g, optimize=True).reshape(dofs.shape))
            if free is None:
                continue
            ne, nq, nb = g.shape[:3]
            B = np.zeros((ne, nq, d, d, nb, d))
            for i in range(d):
                B[:, :, i, :, :, i] = np.swapaxes(g, 2, 3)
            B = B.reshape(ne, nq, d * d, nb * d)
            A = (w[..., None, None, None, None] * A[..., :d, :d, :d, :d]).reshape(ne, nq, d * d, d * d)
            K = np.swapaxes(B.reshape(ne, -1, nb * d), 1, 2) @ (A @ B).reshape(ne, -1, nb * d)
            if projection is not None:
                stiffness, slope, projected = projection
                C = np.einsum('eq,qm,eqr,eqrs->ems', w, self.modes, slope[..., :d, :d].reshape(ne, nq, d * d), B, optimize=True)
                K += np.swapaxes(C, 1, 2) @ stiffness @ C
                self.elimination.append((projected, stiffness @ C))
            n = number[dofs]
            r, c = np.repeat(n, n.shape[1], axis=1).ravel(), np.tile(n, n.shape[1]).ravel()
            keep = (r >= 0) & (c >= r)
            rows.append(r[keep].astype(np.int32)); columns.append(c[keep].astype(np.int32)); values.append(K.ravel()[keep])
        if free is None:
            return force
        K = sparse.coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(len(free),) * 2)
        return force, K.tocsr()

    def solve(self, u, fixed, load=None, tolerance=1e-10, report=False):
        """Newton from u, whose fixed values are already right; load is the dead nodal force. Relative residual <= tolerance."""
        load = np.zeros(self.size) if load is None else load
        free = np.setdiff1d(np.arange(self.size), fixed)
        solver = pypardiso.PyPardisoSolver(mtype=-2)
        u, self.linearised_pressure = u.copy(), None
        for iteration in range(30):
            force, K = self.assemble(u, free)
            residual = (load - force)[free]
            scale = max(np.abs(force).max(), np.abs(load).max())
            if report:
                print('  iteration %d: residual %.2e' % (iteration, np.abs(residual).max() / scale), flush=True)
            if np.abs(residual).max() <= tolerance * scale:
                solver.free_memory(everything=True)
                self.linearised_pressure = None
                return u, force
            step = np.zeros(self.size)
            step[free] = solver.solve(K, residual)
            u += step
            if self.modes is not None:
                projected, slope = (np.concatenate(part) for part in zip(*self.elimination))
                self.linearised_pressure = projected + np.einsum('ems,es->em', slope, step[self.dofs])
        raise RuntimeError('Newton did not converge')

    def body_force(self, density_times_acceleration):
        f = np.zeros((self.basis.N, self.dim))
        shape = np.array([np.broadcast_to(b[0].value, self.weight.shape) for b in self.basis.basis])
        np.add.at(f, self.nodes, np.einsum('aeq,eq->ea', shape, self.weight)[:, :, None] * np.asarray(density_times_acceleration))
        return f.ravel()

    def cauchy(self, u, part=slice(None)):
        F = self.deformation(u, part)
        P = self.stress(F, self.weight[part])[0]
        return P @ np.swapaxes(F, -1, -2) / np.linalg.det(F)[..., None, None]

    def node(self, *point):
        distance = np.linalg.norm(self.position - np.array(point)[:, None], axis=0)
        assert distance.min() < 1e-9 * max(1.0, np.abs(point).max()), 'no node at that point'
        return int(distance.argmin())


def check_tangents():
    from skfem import Basis, ElementHex1, ElementQuad2, MeshHex, MeshQuad
    random = np.random.default_rng(1)
    for mesh, element in ((MeshHex().refined(1), ElementHex1()), (MeshQuad().refined(1), ElementQuad2())):
        for law in (StVenantKirchhoff(1.0, 2.0), NeoHookeanLog(1.0, 2.0), NeoHookeanSplit(1.0, 3.0)):
            for modes in (0,) if law.kappa is None else (0, 1, mesh.dim() + 1):
                solid = Solid(Basis(mesh, element, intorder=4), law, modes)
                u, du = random.uniform(-0.05, 0.05, (2, solid.size))
                K = solid.assemble(u, np.arange(solid.size))[1]
                K = K + sparse.triu(K, 1).T
                step = 1e-6
                difference = (solid.assemble(u + step * du) - solid.assemble(u - step * du)) / (2 * step)
                error = np.abs(K @ du - difference).max() / np.abs(difference).max()
                print('%s %dD modes %d: tangent error %.1e' % (type(law).__name__, mesh.dim(), modes, error))
                assert error < 1e-7


if __name__ == '__main__':
    check_tangents()
