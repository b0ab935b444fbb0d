"""Cook's membrane, large strain, plane strain: corners (0,0) (48,44) (48,60) (0,44) mm, left edge clamped, dead shear traction
q = 6.25 N/mm^2 (F = 100 N per mm of thickness over the 16 mm edge) upwards on the right edge, E = 240.565 N/mm^2.
Displacement of the corner (48,60) and of the middle of the right edge (48,52).  usage: cooks_membrane.py
Elements: Q1 (displacement, locks), Q1P0, Q2P1 = quadratic with discontinuous linear pressure (see hyperelastic.py).
"""
import numpy as np
from skfem import Basis, ElementQuad1, ElementQuad2, MeshQuad
from csm1 import graded
from hyperelastic import NeoHookeanLog, NeoHookeanSplit, Solid, lame
from reference_output import write_csv

YOUNG, FORCE = 240.565, 100.0
ELEMENTS = {'Q1': (ElementQuad1, 0), 'Q1P0': (ElementQuad1, 1), 'Q2': (ElementQuad2, 0), 'Q2P1': (ElementQuad2, 3)}


def law(name, poisson):
    mu, lam = lame(YOUNG, poisson)
    return NeoHookeanLog(mu, lam) if name == 'log' else NeoHookeanSplit(mu, lam + 2 * mu / 3)


def membrane(n, levels):
    """n x n elements, those along all four sides halved `levels` times: the clamp's and the loaded edge's corners are singular."""
    line = np.linspace(0, 1, n + 1)
    m = MeshQuad.init_tensor(graded(line, True, True, levels), graded(line, True, True, levels))
    a, b = m.p
    return MeshQuad(np.array([48 * a, 44 * a + b * (44 - 28 * a)]), m.t)


def edge_load(solid):
    """Consistent nodal forces of the uniform dead traction: Simpson (quadratic) or trapezoid weights on each edge."""
    x = solid.position
    edge = np.flatnonzero(x[0] > 48 - 1e-9)
    edge = edge[np.argsort(x[1, edge])]
    step = 2 if solid.gradient.shape[2] == 9 else 1
    weights = np.array([1, 4, 1]) / 6 if step == 2 else np.array([1, 1]) / 2
    load = np.zeros(solid.size)
    for k in range(0, len(edge) - 1, step):
        nodes = edge[k:k + step + 1]
        load[2 * nodes + 1] += FORCE / 16 * (x[1, nodes[-1]] - x[1, nodes[0]]) * weights
    assert abs(load.sum() - FORCE) < 1e-9
    return load


def solve(name, poisson, element, n, levels, steps=5):
    shape, modes = ELEMENTS[element]
    solid = Solid(Basis(membrane(n, levels), shape(), intorder=5 if shape is ElementQuad2 else 3), law(name, poisson), modes)
    clamp = np.flatnonzero(solid.position[0] < 1e-9)
    load, u = edge_load(solid), np.zeros(solid.size)
    for part in np.linspace(1 / steps, 1, steps):
        u, force = solid.solve(u, np.concatenate([2 * clamp, 2 * clamp + 1]), part * load, tolerance=1e-8)
    assert abs(force[2 * clamp + 1].sum() + FORCE) < 1e-5
    return solid.basis.mesh.nelements, *(float(u[2 * solid.node(48, y) + i]) for y in (60, 52) for i in (0, 1))


if __name__ == '__main__':
    ladder = [(name, nu, element, n, levels) for name in ('log', 'split') for nu in (0.4999, 0.49, 0.4)
              for element, n, levels in (('Q2P1', 4, 0), ('Q2P1', 8, 0), ('Q2P1', 16, 0), ('Q2P1', 32, 0), ('Q2P1', 16, 5), ('Q2P1', 32, 5),
                                         ('Q1P0', 16, 0), ('Q1P0', 64, 0), ('Q1', 8, 0), ('Q1', 16, 0), ('Q1', 32, 0))]
    ladder += [(name, 0.4999, 'Q2P1', 64, 5) for name in ('log', 'split')]
    rows = []
    for case in ladder:
        try:
            rows.append((*case, *solve(*case)))
        except RuntimeError as problem:
            rows.append((*case, 0, *4 * [float('nan')]))
            print(problem)
        print(rows[-1], flush=True)
    write_csv('cooks_membrane', 'convergence.csv', 'tools/fem/cooks_membrane.py; displacements in mm; plane strain, E 240.565 N/mm^2, dead shear traction 6.25 N/mm^2 on the right edge; '
              'log: P = mu (F - F^-T) + lambda ln J F^-T, split: W = mu/2 (I1bar - 3) + K/2 (J - 1)^2; nan = no convergence',
              ['law', 'poisson', 'element', 'n', 'graded', 'elements', 'corner_ux', 'corner_uy', 'middle_ux', 'middle_uy'], rows, '%.6g')
