"""Finite viscoelasticity at a point: pure functions of arrays, no mesh and no time.

The free energy per reference volume is that of Linder, Tkachuk and Miehe (2011, J. Mech. Phys. Solids 59, 2134),

    W = U(J) + G_inf / 2 (tr Cb - 3) + sum_i G_i / 2 (A_i : Cb - ln det A_i - 3),    Cb = J^(-2/3) C,

with branch tensors that follow dA_i / dt = (Cb^-1 - A_i) / tau_i. Its stress S = 2 dW/dC is

    S = U'(J) J C^-1 + J^(-2/3) DEV[Q],    Q = G_inf 1 + sum_i G_i (A_i - Cb^-1),    DEV[Q] = Q - (Q : C) / 3 C^-1.

DEV[Cb^-1] vanishes: Cb^-1 may be taken from every A_i, so that the driving tensor Q of a relaxed rubber holds no
difference of large numbers. U(J) = K/4 (J² - 1) - K/2 ln J, which no finite load can press to nothing.

Arrays have their components first: F xx, xy, yx, yy for a deformation gradient; xx, yy, xy, zz for a symmetric
tensor. The unknowns at a point are F in plane strain (4), and F with the logarithm of the stretch across the
thickness in plane stress (5); the stresses that go with them are the first Piola-Kirchhoff stress P = F S and
C_zz S_zz, which vanishes in plane stress.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from rubfric.arrays import Real

XX, YY, XY, ZZ = range(4)


class Inverted(ArithmeticError):
    """A deformation that turns the material inside out."""


@dataclass(frozen=True)
class Deformation:
    """How points are deformed; shapes after the components are those of the points.

    Attributes
    ----------
    gradient : ndarray, shape (4, ...)
        F.
    squared : ndarray, shape (4, ...)
        C = F^T F.
    inverse : ndarray, shape (4, ...)
        Cb^-1, of determinant 1.
    area, volume : ndarray, shape (...)
        In-plane det F, and J.
    isochoric : ndarray, shape (...)
        J^(-2/3).
    growth : ndarray, shape (4, ...) or (5, ...)
        d ln J / d(unknowns).
    """

    gradient: Real
    squared: Real
    inverse: Real
    area: Real
    volume: Real
    isochoric: Real
    growth: Real

    @property
    def isochoric_squared(self) -> Real:
        """Cb, shape (4, ...)."""
        return self.isochoric * self.squared

    def of_rows(self, rows: slice) -> Deformation:
        """Return the points of some rows, the last axis but one."""
        return Deformation(*(getattr(self, field.name)[..., rows, :] for field in fields(self)))


@dataclass(frozen=True)
class Tangent:
    """Derivatives at points by the unknowns, of which there are m = 4 or 5.

    Attributes
    ----------
    local : ndarray, shape (m, m, ...)
        Of the stresses at constant Q and U', MPa; symmetric.
    by_driving : ndarray, shape (m, 4, ...)
        Of the stresses by Q, dimensionless.
    inverse : ndarray, shape (4, m, ...)
        Of Cb^-1, dimensionless.
    volume : ndarray, shape (m, ...)
        Of J; also that of the stresses by U'.
    """

    local: Real
    by_driving: Real
    inverse: Real
    volume: Real

    def of_rows(self, rows: slice) -> Tangent:
        """Return the points of some rows, the last axis but one."""
        return Tangent(*(getattr(self, field.name)[..., rows, :] for field in fields(self)))


def deform(gradient: Real, log_thickness: Real) -> Deformation:
    """Return the deformation of points.

    Parameters
    ----------
    gradient : ndarray, shape (4, ...)
        F.
    log_thickness : ndarray, shape (1, ...) or (0, ...)
        Logarithm of the stretch across the thickness; without entries in plane strain.

    Raises
    ------
    Inverted
        Where det F is not positive.
    """
    xx, xy, yx, yy = gradient
    area = xx * yy - xy * yx
    if not area.min() > 0.0:
        raise Inverted(f"smallest det F is {area.min():.3g}")
    squared = np.empty_like(gradient)
    squared[XX], squared[YY], squared[XY], squared[ZZ] = xx * xx + yx * yx, xy * xy + yy * yy, xx * xy + yx * yy, 1.0
    volume, inverse = area, np.empty_like(gradient)
    if len(log_thickness):
        thickness = np.exp(log_thickness[0])
        squared[ZZ] = thickness * thickness
        volume = area * thickness
    inverse[XX], inverse[YY], inverse[XY] = squared[YY], squared[XX], -squared[XY]
    inverse[:3] /= area * area
    inverse[ZZ] = 1.0 / squared[ZZ]
    isochoric = np.cbrt(volume) ** -2
    inverse /= isochoric
    growth = np.ones((4 + len(log_thickness), *area.shape))
    growth[0], growth[1], growth[2], growth[3] = yy, -yx, -xy, xx
    growth[:4] /= area
    return Deformation(gradient, squared, inverse, area, volume, isochoric, growth)


def volumetric_energy(bulk: float, volume: Real) -> Real:
    """Return U(J), MPa.

    Parameters
    ----------
    bulk : float
        K, MPa.
    volume : ndarray, shape (...)
        J, dimensionless.
    """
    return 0.25 * bulk * (volume * volume - 1.0) - 0.5 * bulk * np.log(volume)


def volumetric_stress(bulk: float, volume: Real) -> tuple[Real, Real]:
    """Return U'(J) and U''(J), MPa.

    Parameters
    ----------
    bulk : float
        K, MPa.
    volume : ndarray, shape (...)
        J, dimensionless.
    """
    reciprocal = 1.0 / volume
    return 0.5 * bulk * (volume - reciprocal), 0.5 * bulk * (1.0 + reciprocal * reciprocal)


def stress(state: Deformation, driving: Real, volumetric: Real) -> Real:
    """Return the stresses that go with the unknowns, MPa, shape (4, ...) or (5, ...).

    Parameters
    ----------
    state : Deformation
    driving : ndarray, shape (4, ...)
        Q, MPa.
    volumetric : ndarray, shape (...)
        U', MPa.
    """
    spin, product = _work(state, driving)
    return state.isochoric * spin + (volumetric * state.volume - state.isochoric * product / 3.0) * state.growth


def second_stress(state: Deformation, driving: Real, volumetric: Real) -> Real:
    """Return the second Piola-Kirchhoff stress S, MPa, shape (4, ...).

    Parameters
    ----------
    state : Deformation
    driving : ndarray, shape (4, ...)
        Q, MPa.
    volumetric : ndarray, shape (...)
        U', MPa.
    """
    product = contract(driving, state.squared)
    reciprocal = state.isochoric * state.inverse  # C^-1
    return state.isochoric * driving + (volumetric * state.volume - state.isochoric * product / 3.0) * reciprocal


def tangent(state: Deformation, driving: Real, volumetric: Real) -> Tangent:
    """Return the derivatives of the stresses, and of what Q and U' follow from; arguments as for ``stress``.

    Parameters
    ----------
    state : Deformation
    driving : ndarray, shape (4, ...)
        Q, MPa.
    volumetric : ndarray, shape (...)
        U', MPa.
    """
    spin, product = _work(state, driving)
    squared, growth, iso = state.squared, state.growth, state.isochoric
    size = len(growth)
    # ln J has the second derivative E / area - growth growth in F, and none in the thickness.
    bend = volumetric * state.volume - iso * product / 3.0
    stretch = volumetric * state.volume + iso * product * (2.0 / 9.0)
    local = np.empty((size, size, *state.area.shape))
    turned = (-2.0 / 3.0) * iso * spin
    for i in range(size):
        for j in range(i, size):
            twice = stretch - bend if j < 4 else stretch
            local[i, j] = turned[i] * growth[j] + growth[i] * turned[j] + twice * growth[i] * growth[j]
    local[0, 3] += bend / state.area
    local[1, 2] -= bend / state.area
    for i in (0, 2):
        local[i, i] += iso * driving[XX]
        local[i, i + 1] += iso * driving[XY]
        local[i + 1, i + 1] += iso * driving[YY]
    if size == 5:
        local[4, 4] += 2.0 * iso * spin[4]
    for i in range(size):
        for j in range(i):
            local[i, j] = local[j, i]
    inverse = _inverse_tangent(state)
    # dCb/2 by the unknowns: Q : Cb / 2 is the part of W that Q drives.
    by_driving = -growth[:, None] * (squared / 3.0)
    by_driving[:, XY] *= 2.0
    xx, xy, yx, yy = state.gradient
    for row, (along, across) in ((0, (xx, xy)), (2, (yx, yy))):
        by_driving[row, XX] += along
        by_driving[row, XY] += across
        by_driving[row + 1, XY] += along
        by_driving[row + 1, YY] += across
    if size == 5:
        by_driving[4, ZZ] += squared[ZZ]
    by_driving *= iso
    return Tangent(local, by_driving, inverse, state.volume * growth)


def inverse_change(state: Deformation, change: Real) -> Real:
    """Return the change of Cb^-1, shape (4, ...): ``Tangent.inverse`` times a change, which need not be held for it.

    Parameters
    ----------
    state : Deformation
    change : ndarray, shape (m, ...)
        Of the unknowns.
    """
    growth, (xx, yy, xy, zz) = state.growth, state.inverse
    answer = ((2.0 / 3.0) * (growth * change).sum(axis=0)) * state.inverse
    along, across = (growth[i] * change[0] + growth[i + 2] * change[2] for i in (0, 1))  # columns x of F^-1 dF
    right, up = (growth[i] * change[1] + growth[i + 2] * change[3] for i in (0, 1))  # columns y
    answer[XX] -= 2.0 * (along * xx + right * xy)
    answer[YY] -= 2.0 * (across * xy + up * yy)
    answer[XY] -= along * xy + right * yy + across * xx + up * xy
    if len(growth) == 5:
        answer[ZZ] -= 2.0 * zz * change[4]
    return answer


def local_change(state: Deformation, driving: Real, volumetric: Real, change: Real) -> Real:
    """Return the change of the stresses at constant Q and U', MPa: ``Tangent.local`` times a change.

    Parameters
    ----------
    state : Deformation
    driving : ndarray, shape (4, ...)
        Q, MPa.
    volumetric : ndarray, shape (...)
        U', MPa.
    change : ndarray, shape (m, ...)
        Of the unknowns.
    """
    spin, product = _work(state, driving)
    growth, iso = state.growth, state.isochoric
    bend = volumetric * state.volume - iso * product / 3.0
    stretch = volumetric * state.volume + iso * product * (2.0 / 9.0)
    spin *= iso
    swelling = growth * change
    plane = swelling[:4].sum(axis=0)
    whole = plane + swelling[4] if len(growth) == 5 else plane
    answer = spin * ((-2.0 / 3.0) * whole)
    answer += growth * (stretch * whole - (2.0 / 3.0) * (spin * change).sum(axis=0))
    answer[:4] -= growth[:4] * (bend * plane)
    bend /= state.area
    for i, j, sign in ((0, 3, 1.0), (1, 2, -1.0)):
        answer[i] += sign * bend * change[j]
        answer[j] += sign * bend * change[i]
    along, up, across = iso * driving[XX], iso * driving[YY], iso * driving[XY]
    for i in (0, 2):
        answer[i] += along * change[i] + across * change[i + 1]
        answer[i + 1] += across * change[i] + up * change[i + 1]
    if len(growth) == 5:
        answer[4] += 2.0 * spin[4] * change[4]
    return answer


def _inverse_tangent(state: Deformation) -> Real:
    """Return d(Cb^-1) / d(unknowns), shape (4, m, ...): the volume's part and -2 sym(F^-1 dF Cb^-1)."""
    growth, inverse = state.growth, state.inverse
    change = (2.0 / 3.0) * inverse[:, None] * growth
    undo = ((growth[0], growth[2]), (growth[1], growth[3]))  # F^-1
    plane = ((inverse[XX], inverse[XY]), (inverse[XY], inverse[YY]))
    for component, (a, b) in ((XX, (0, 0)), (YY, (1, 1)), (XY, (0, 1))):
        for i in (0, 1):
            for j in (0, 1):
                change[component, 2 * i + j] -= undo[a][i] * plane[j][b] + undo[b][i] * plane[j][a]
    if len(growth) == 5:
        change[ZZ, 4] -= 2.0 * inverse[ZZ]
    return change


def _work(state: Deformation, driving: Real) -> tuple[Real, Real]:
    """Return the derivative of Q : C / 2 by the unknowns, that is F Q and C_zz Q_zz; and Q : C; MPa."""
    xx, xy, yx, yy = state.gradient
    spin = np.empty_like(state.growth)
    spin[0], spin[1] = xx * driving[XX] + xy * driving[XY], xx * driving[XY] + xy * driving[YY]
    spin[2], spin[3] = yx * driving[XX] + yy * driving[XY], yx * driving[XY] + yy * driving[YY]
    if len(spin) == 5:
        spin[4] = driving[ZZ] * state.squared[ZZ]
    return spin, contract(driving, state.squared)


def contract(one: Real, other: Real) -> Real:
    """Return the double contraction of two symmetric tensors.

    Parameters
    ----------
    one : ndarray, shape (4, ...)
    other : ndarray, shape (4, ...)
    """
    total: Real = one[XX] * other[XX] + one[YY] * other[YY] + 2.0 * one[XY] * other[XY] + one[ZZ] * other[ZZ]
    return total
