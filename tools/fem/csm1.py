"""Turek-Hron CSM1 with a flat clamp: beam 0.35 x 0.02 m, clamped at x = 0.25, plane strain, rho 1000, g 2, E 1.4 MPa, nu 0.4.
Static tip displacement (middle of the free end, point A at (0.6, 0.2)) for St Venant-Kirchhoff (the benchmark's law)
and neo-Hookean.  usage: csm1.py"""
import numpy as np
from skfem import Basis, ElementQuad2, MeshQuad
from hyperelastic import NeoHookeanLog, Solid, StVenantKirchhoff, lame
from reference_output import write_csv

LENGTH, HEIGHT, LEFT, BOTTOM = 0.35, 0.02, 0.25, 0.19
YOUNG, POISSON, DENSITY, GRAVITY = 1.4e6, 0.4, 1000.0, 2.0


def graded(points, first, last, levels):
    """Halve the first and/or last interval `levels` times towards the end."""
    lo, hi = points[1] - points[0], points[-1] - points[-2]
    head = [points[0] + lo * 0.5 ** k for k in range(levels, 0, -1)] if first else []
    tail = [points[-1] - hi * 0.5 ** k for k in range(1, levels + 1)] if last else []
    return np.concatenate([points[:1], head, points[1:-1], tail, points[-1:]])


def mesh(thickness_elements, levels):
    x = np.linspace(LEFT, LEFT + LENGTH, round(thickness_elements * LENGTH / HEIGHT / 2) + 1)   # twice as long as high
    y = np.linspace(BOTTOM, BOTTOM + HEIGHT, thickness_elements + 1)
    return MeshQuad.init_tensor(graded(x, True, False, levels), graded(y, True, True, levels) if levels else y)


def tip(law, thickness_elements, levels):
    solid = Solid(Basis(mesh(thickness_elements, levels), ElementQuad2(), intorder=5), law)
    clamp = np.flatnonzero(solid.position[0] < LEFT + 1e-9)
    fixed = np.concatenate([2 * clamp, 2 * clamp + 1])
    u, weight = np.zeros(solid.size), solid.body_force((0.0, -DENSITY * GRAVITY))
    for part in np.linspace(0.2, 1.0, 5):
        u, force = solid.solve(u, fixed, part * weight, tolerance=1e-8)
    assert abs((force - weight)[2 * clamp + 1].sum() - DENSITY * GRAVITY * LENGTH * HEIGHT) < 1e-6      # support carries the weight
    n = solid.node(LEFT + LENGTH, BOTTOM + HEIGHT / 2)
    return solid.basis.mesh.nelements, float(1e3 * u[2 * n]), float(1e3 * u[2 * n + 1])


if __name__ == '__main__':
    rows = []
    for law in (StVenantKirchhoff, NeoHookeanLog):
        for thickness_elements, levels in ((2, 0), (4, 0), (8, 0), (4, 6), (8, 6), (8, 9), (16, 6)):
            rows.append((law.__name__, thickness_elements, levels, *tip(law(*lame(YOUNG, POISSON)), thickness_elements, levels)))
            print(rows[-1], flush=True)
    write_csv('csm1', 'convergence.csv', 'tools/fem/csm1.py; displacement of the middle of the free end, mm; quad2 elements, clamp on a flat face, '
              'graded = halvings of the elements along the clamp and its edges',
              ['law', 'elements_through_thickness', 'graded', 'elements', 'ux_mm', 'uy_mm'], rows, '%.6f')
