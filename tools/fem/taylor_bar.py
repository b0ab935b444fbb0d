"""Taylor bar, copper: L 32.4 mm, R 3.2 mm, 227 m/s against a rigid frictionless wall, rho 8930, E 117 GPa, nu 0.35,
yield stress 0.4 GPa, linear hardening modulus 0.1 GPa (d yield / d plastic strain), shape at 80 microseconds.
usage: taylor_bar.py   (the whole ladder, a quarter of an hour)

Axisymmetric explicit finite elements, written for this reference: 4-node quads, 2x2 Gauss points, mean dilatation
(Nagtegaal, Parks and Rice 1974; F-bar of de Souza Neto et al. 1996), updated Lagrangian, central differences, lumped mass.
J2 plasticity on the elastic left Cauchy-Green tensor with logarithmic strain and radial return (Simo 1992); the stress so
found is taken as Cauchy stress (`kirchhoff` takes it as Kirchhoff stress).  Wall: a node that would pass it is put on it,
and may leave again (release=False holds the foot's nodes on the wall for ever).  Bulk viscosity q = rho l |tr d| (quadratic l |tr d| + linear c) in compression.
"""
import numpy as np
from numba import njit
from reference_output import write_csv

LENGTH, RADIUS, SPEED, END = 32.4e-3, 3.2e-3, 227.0, 80e-6
DENSITY, YOUNG, POISSON, YIELD, HARDENING = 8930.0, 117e9, 0.35, 0.4e9, 0.1e9
BULK, SHEAR = YOUNG / (3 * (1 - 2 * POISSON)), YOUNG / (2 * (1 + POISSON))
WAVE_SPEED = np.sqrt((BULK + 4 / 3 * SHEAR) / DENSITY)


G = 1 / np.sqrt(3)
POINTS = np.array([[-G, -G], [G, -G], [G, G], [-G, G]])              # Gauss points, weight 1
CORNERS = np.sign(POINTS)
SHAPE = 0.25 * (1 + POINTS[:, None, 0] * CORNERS[:, 0]) * (1 + POINTS[:, None, 1] * CORNERS[:, 1])       # point, node
SLOPE = 0.25 * np.stack([CORNERS[:, 0] * (1 + POINTS[:, None, 1] * CORNERS[:, 1]), CORNERS[:, 1] * (1 + POINTS[:, None, 0] * CORNERS[:, 0])], -1)


@njit
def geometry(x, nodes, gradient, radius, weight):
    """Of one element: gradients (point, node, direction), radius and 2 pi r det(jacobian) of the Gauss points; its volume."""
    volume = 0.0
    for q in range(4):
        j00 = j01 = j10 = j11 = r = 0.0
        for a in range(4):
            xr, xz = x[nodes[a], 0], x[nodes[a], 1]
            j00 += SLOPE[q, a, 0] * xr
            j01 += SLOPE[q, a, 0] * xz
            j10 += SLOPE[q, a, 1] * xr
            j11 += SLOPE[q, a, 1] * xz
            r += SHAPE[q, a] * xr
        det = j00 * j11 - j01 * j10
        for a in range(4):
            d0, d1 = SLOPE[q, a, 0], SLOPE[q, a, 1]
            gradient[q, a, 0] = (j11 * d0 - j01 * d1) / det
            gradient[q, a, 1] = (j00 * d1 - j10 * d0) / det
        radius[q], weight[q] = r, 2 * np.pi * r * det
        volume += weight[q]
    return volume


@njit
def plastic_step(b0, b1, b2, b3, alpha):
    """Radial return of the trial elastic left Cauchy-Green tensor (rr, zz, rz, tt): the tensor, stress, alpha, volumetric strain."""
    mean, half = 0.5 * (b0 + b1), 0.5 * (b0 - b1)
    root = np.sqrt(half * half + b2 * b2)
    c, s = (half / root, b2 / root) if root > 0 else (1.0, 0.0)       # of the doubled angle
    e0, e1, e2 = 0.5 * np.log(mean + root), 0.5 * np.log(mean - root), 0.5 * np.log(b3)
    volume = e0 + e1 + e2
    e0, e1, e2 = e0 - volume / 3, e1 - volume / 3, e2 - volume / 3
    equivalent = 2 * SHEAR * np.sqrt(1.5 * (e0 * e0 + e1 * e1 + e2 * e2))
    excess = equivalent - (YIELD + HARDENING * alpha)
    if excess > 0:
        gamma = excess / (3 * SHEAR + HARDENING)
        keep = 1 - 3 * SHEAR * gamma / equivalent
        e0, e1, e2 = keep * e0, keep * e1, keep * e2
        alpha += gamma
        p0, p1 = np.exp(2 * (e0 + volume / 3)), np.exp(2 * (e1 + volume / 3))
        b0, b1, b2, b3 = 0.5 * (p0 + p1 + (p0 - p1) * c), 0.5 * (p0 + p1 - (p0 - p1) * c), 0.5 * (p0 - p1) * s, np.exp(2 * (e2 + volume / 3))
    pressure = BULK * volume
    s0, s1 = SHEAR * (e0 + e1) + pressure, SHEAR * (e0 - e1)
    return b0, b1, b2, b3, s0 + s1 * c, s0 - s1 * c, s1 * s, 2 * SHEAR * e2 + pressure, alpha, volume


@njit
def forces(x, dx, dt, quads, be, alpha, gradient, radius, weight, volumes, kirchhoff, linear, quadratic, force):
    """Move the elements by dx (end at x), update their state, add the internal force; the smallest element size / wave speed."""
    force[:] = 0
    limit = 1.0
    f = np.empty((4, 5))
    for e in range(len(quads)):
        nodes, g, b = quads[e], gradient[e], be[e]
        for q in range(4):                                            # increment of the deformation gradient, old gradients
            f00 = f11 = 1.0
            f01 = f10 = ft = 0.0
            for a in range(4):
                d0, d1 = dx[nodes[a], 0], dx[nodes[a], 1]
                f00 += d0 * g[q, a, 0]
                f01 += d0 * g[q, a, 1]
                f10 += d1 * g[q, a, 0]
                f11 += d1 * g[q, a, 1]
                ft += SHAPE[q, a] * d0
            f[q, 0], f[q, 1], f[q, 2], f[q, 3], f[q, 4] = f00, f01, f10, f11, 1 + ft / radius[e, q]
        V_old = volumes[e]
        V = volumes[e] = geometry(x, nodes, g, radius[e], weight[e])
        i, j, k, l = nodes[0], nodes[1], nodes[2], nodes[3]
        area = 0.5 * abs((x[k, 0] - x[i, 0]) * (x[l, 1] - x[j, 1]) - (x[l, 0] - x[j, 0]) * (x[k, 1] - x[i, 1]))
        longest = 0.0
        for a in range(4):
            m, n = nodes[a], nodes[(a + 1) % 4]
            longest = max(longest, (x[m, 0] - x[n, 0]) ** 2 + (x[m, 1] - x[n, 1]) ** 2)
        size = area / np.sqrt(longest)
        rate = np.log(V / V_old) / dt if dt > 0 else 0.0
        bulk_viscosity = 0.0
        if rate < 0:
            bulk_viscosity = DENSITY * size * rate * (linear * WAVE_SPEED - quadratic * size * rate)
        limit = min(limit, size / (WAVE_SPEED + abs(rate) * size * quadratic))
        for q in range(4):
            f00, f01, f10, f11, ft = f[q, 0], f[q, 1], f[q, 2], f[q, 3], f[q, 4]
            scale = (V / V_old / (ft * (f00 * f11 - f01 * f10))) ** (2 / 3)      # squared mean-dilatation factor
            rr, zz, rz = b[q, 0], b[q, 1], b[q, 2]
            b0 = scale * (f00 * f00 * rr + 2 * f00 * f01 * rz + f01 * f01 * zz)
            b1 = scale * (f10 * f10 * rr + 2 * f10 * f11 * rz + f11 * f11 * zz)
            b2 = scale * (f00 * f10 * rr + (f00 * f11 + f01 * f10) * rz + f01 * f11 * zz)
            b0, b1, b2, b3, srr, szz, srz, stt, alpha[e, q], volume = plastic_step(b0, b1, b2, scale * ft * ft * b[q, 3], alpha[e, q])
            b[q, 0], b[q, 1], b[q, 2], b[q, 3] = b0, b1, b2, b3
            w = weight[e, q]
            factor = w / np.exp(volume) if kirchhoff else w
            srr, szz, srz, stt = factor * srr + w * bulk_viscosity, factor * szz + w * bulk_viscosity, factor * srz, factor * stt + w * bulk_viscosity
            for a in range(4):
                n = nodes[a]
                force[n, 0] -= srr * g[q, a, 0] + srz * g[q, a, 1] + stt * SHAPE[q, a] / radius[e, q]
                force[n, 1] -= srz * g[q, a, 0] + szz * g[q, a, 1]
    return limit


@njit
def march(x, v, mass, quads, be, alpha, axis, kirchhoff, linear, quadratic, release, safety):
    """Central differences to END, all arrays in place: steps, work of the internal forces, work of the wall."""
    count = len(quads)
    gradient, radius, weight, volumes = np.empty((count, 4, 4, 2)), np.empty((count, 4)), np.empty((count, 4)), np.empty(count)
    for e in range(count):
        volumes[e] = geometry(x, quads[e], gradient[e], radius[e], weight[e])
    force, dx = np.zeros_like(x), np.zeros_like(x)
    foot = x[:, 1] < 1e-12
    t, dt, steps, work, wall = 0.0, 0.0, 0, 0.0, 0.0
    limit = forces(x, dx, dt, quads, be, alpha, gradient, radius, weight, volumes, kirchhoff, linear, quadratic, force)
    while t < END:
        step = min(safety * limit, END - t)
        middle = 0.5 * (step + dt)
        for n in range(len(x)):
            r_old, z_old = v[n, 0], v[n, 1]
            v[n, 0] = 0.0 if axis[n] else r_old + middle * force[n, 0] / mass[n]
            v[n, 1] = z_old + middle * force[n, 1] / mass[n]
            if x[n, 1] + v[n, 1] * step < 0 or (foot[n] and not release):
                free = v[n, 1]
                v[n, 1] = -x[n, 1] / step
                wall += 0.5 * mass[n] * (v[n, 1] - free) * (v[n, 1] + z_old)
            work += 0.5 * middle * (force[n, 0] * (v[n, 0] + r_old) + force[n, 1] * (v[n, 1] + z_old))
            dx[n, 0], dx[n, 1] = v[n, 0] * step, v[n, 1] * step
            x[n, 0] += dx[n, 0]
            x[n, 1] += dx[n, 1]
        dt = step
        t += step
        limit = forces(x, dx, dt, quads, be, alpha, gradient, radius, weight, volumes, kirchhoff, linear, quadratic, force)
        steps += 1
    return steps, work, wall


def run(across, kirchhoff=False, linear=0.06, quadratic=1.5, release=True, safety=0.8):
    along = round(across * LENGTH / RADIUS)
    r, z = np.linspace(0, RADIUS, across + 1), np.linspace(0, LENGTH, along + 1)
    x = np.array(np.meshgrid(r, z, indexing='ij')).reshape(2, -1).T.copy()
    number = np.arange(len(x)).reshape(across + 1, along + 1)
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1).reshape(-1, 4)
    mass = np.zeros(len(x))
    gradient, radius, weight = np.empty((4, 4, 2)), np.empty(4), np.empty(4)
    for nodes in quads:
        geometry(x, nodes, gradient, radius, weight)
        mass[nodes] += DENSITY * weight @ SHAPE
    assert abs(mass.sum() / (DENSITY * np.pi * RADIUS ** 2 * LENGTH) - 1) < 1e-12
    v = np.zeros_like(x)
    v[:, 1] = -SPEED
    be = np.zeros((len(quads), 4, 4)) + np.array([1.0, 1.0, 0.0, 1.0])
    alpha = np.zeros((len(quads), 4))
    start = 0.5 * mass.sum() * SPEED ** 2
    steps, work, wall = march(x, v, mass, quads, be, alpha, x[:, 0] < 1e-12, kirchhoff, linear, quadratic, release, safety)
    kinetic = 0.5 * (mass[:, None] * v ** 2).sum()
    foot = x[number[:, 0]]
    side, end = x[number[-1]], x[number[:, -1]]
    result = dict(across=across, along=along, steps=steps, length=1e3 * end[:, 1].mean(), length_axis=1e3 * end[0, 1], foot_radius=1e3 * foot[-1, 0],
                  largest_radius=1e3 * side[:, 0].max(), foot_lift=1e3 * foot[-1, 1], foot_gap=1e3 * foot[0, 1], plastic_strain=alpha.mean(axis=1).max(), plastic_strain_point=alpha.max(),
                  kinetic=kinetic / start, velocity=(mass * v[:, 1]).sum() / mass.sum(), balance=(start + work + wall - kinetic) / start)
    return result, side * 1e3


if __name__ == '__main__':
    ladder = [dict(across=n) for n in (6, 10, 16, 20)] + [dict(across=n, release=False) for n in (10, 16, 20)]
    ladder += [dict(across=10, kirchhoff=True), dict(across=10, linear=0.0, quadratic=0.0), dict(across=10, safety=0.4)]
    rows = []
    for case in ladder:
        result, side = run(**case)
        variant = ' '.join('%s=%s' % item for item in case.items() if item[0] != 'across') or 'base'
        rows.append((variant, *(value if isinstance(value, int) else float(value) for value in result.values())))
        print(variant, {k: round(float(v), 5) for k, v in result.items()}, flush=True)
        if set(case) <= {'across', 'release'}:
            name = 'profile.csv' if case.get('release', True) else 'profile_held_foot.csv'
            write_csv('taylor_bar', name, f'tools/fem/taylor_bar.py {case}; side surface at 80 microseconds, mm, from the foot to the free end', ['r_mm', 'z_mm'], side, '%.5f')
        write_csv('taylor_bar', 'convergence.csv', 'tools/fem/taylor_bar.py; mm, m/s; at 80 microseconds; parts of the initial kinetic energy: kinetic (left), balance (kinetic energy minus work of the nodal forces)',
                  ['variant', *result], rows, '%.6g')
