"""First eigenperiods of the oscillating plate (Landau-Lifshitz; Gray 2001): plane strain, L 0.2 m, H 0.02 m, clamped at one end,
E 2 MPa, nu 0.3975, rho 1000.  Quadratic elements, consistent mass; the thin-plate and Timoshenko values beside it.
usage: plate_modes.py"""
import numpy as np
import scipy.sparse.linalg as sla
from scipy.optimize import brentq
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector, MeshQuad
from skfem.helpers import ddot, dot, sym_grad, trace
from csm1 import graded
from hyperelastic import lame
from reference_output import write_csv

LENGTH, HEIGHT, YOUNG, POISSON, DENSITY = 0.2, 0.02, 2e6, 0.3975, 1000.0
MU, LAMBDA = lame(YOUNG, POISSON)


@BilinearForm
def stiffness(u, v, w):
    return LAMBDA * trace(sym_grad(u)) * trace(sym_grad(v)) + 2 * MU * ddot(sym_grad(u), sym_grad(v))


@BilinearForm
def mass(u, v, w):
    return DENSITY * dot(u, v)


def periods(thickness_elements, levels, count=3, free_to_thicken=False):
    """Element count and periods; free_to_thicken holds only x on the clamped face (and y at its middle), as beam theory does."""
    x = np.linspace(0, LENGTH, 5 * thickness_elements + 1)
    y = np.linspace(-HEIGHT / 2, HEIGHT / 2, thickness_elements + 1)
    m = MeshQuad.init_tensor(graded(x, True, False, levels), graded(y, True, True, levels) if levels else y)
    basis = Basis(m, ElementVector(ElementQuad2()), intorder=5)
    face = basis.get_dofs(lambda p: p[0] < 1e-12)
    middle = np.flatnonzero(np.hypot(*basis.doflocs) < 1e-12)
    clamp = np.concatenate([face.all(['u^1']), middle]) if free_to_thicken else face.flatten()
    free = np.setdiff1d(np.arange(basis.N), clamp)
    K, M = (form.assemble(basis).tocsc()[free][:, free] for form in (stiffness, mass))
    values = np.sort(sla.eigsh(K, count, M, sigma=0.0, return_eigenvectors=False))
    return m.nelements, 2 * np.pi / np.sqrt(values)


def thin_plate(k_length):
    return 2 * np.pi / np.sqrt(YOUNG * HEIGHT ** 2 * (k_length / LENGTH) ** 4 / (12 * DENSITY * (1 - POISSON ** 2)))


def timoshenko(shear_factor=5 / 6):
    """First cantilever period with shear and rotary inertia: zero of the boundary determinant, scaled by the thin-plate frequency."""
    EI, GA = YOUNG / (1 - POISSON ** 2) * HEIGHT ** 3 / 12, shear_factor * MU * HEIGHT
    rho_a, rho_i = DENSITY * HEIGHT, DENSITY * HEIGHT ** 3 / 12

    def determinant(omega):
        # state (w, psi, M, Q)' = S (w, psi, M, Q); w = psi = 0 at the clamp, M = Q = 0 at the tip
        S = np.array([[0, 1, 0, 1 / GA], [0, 0, 1 / EI, 0], [0, -rho_i * omega ** 2, 0, -1], [-rho_a * omega ** 2, 0, 0, 0]])
        value, vector = np.linalg.eig(S * LENGTH)
        transfer = (vector * np.exp(value)) @ np.linalg.inv(vector)
        return np.linalg.det(transfer[2:, 2:]).real

    omega = 2 * np.pi / thin_plate(1.8751041)
    return 2 * np.pi / brentq(determinant, 0.9 * omega, 1.0 * omega)


if __name__ == '__main__':
    rows = []
    print('clamped face free to thicken', periods(8, 0, 3, True)[1], 'Timoshenko', timoshenko())
    for thickness_elements, levels in ((1, 0), (2, 0), (4, 0), (8, 0), (16, 0), (8, 8), (16, 8), (16, 12), (32, 12)):
        count, T = periods(thickness_elements, levels)
        rows.append((thickness_elements, levels, count, *map(float, T)))
        print(rows[-1], flush=True)
    print('thin plate %.6f s, Timoshenko (5/6) %.6f s' % (thin_plate(1.8751041), timoshenko()))
    write_csv('plate_modes', 'convergence.csv', 'tools/fem/plate_modes.py; eigenperiods in seconds; quad2 elements, graded = halvings towards the clamp and its edges; '
              'thin plate %.6f s, Timoshenko beam (shear factor 5/6, E/(1-nu^2)) %.6f s' % (thin_plate(1.8751041), timoshenko()),
              ['elements_through_thickness', 'graded', 'elements', 'T1_s', 'T2_s', 'T3_s'], rows, '%.8f')
