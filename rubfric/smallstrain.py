"""Small strain, steady sliding, exact in time: the block's response to each harmonic of the road.

In the frame of the road every field depends on x only through harmonics n of wavenumber n k, which the
sliding rubber feels at the frequency n k v. For each of them the block is a chain of rows with complex
moduli, K_n = G*(n k v) K_shear + L*(n k v) K_dilatation, and one sweep over the rows from the top to the road
eliminates it, for all harmonics at once: what remains is the compliance of the surface.

A field is stored by its complex amplitudes: f(x) = f_0 + 2 Re sum_n f_n exp(i n k x), without the 2 for the
last harmonic, n = columns / 2.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rubfric.block import Block, RowOperator
from rubfric.material import Material

Complex = NDArray[np.complex128]
Real = NDArray[np.float64]

# A harmonic decays as exp(-n k y): rows above n k y = 40 do not feel it in double precision.
_FADED = 40.0


@dataclass(frozen=True)
class HarmonicResponse:
    """The block eliminated down to its surface, for a set of harmonics.

    Attributes
    ----------
    harmonics : ndarray of int, shape (n,)
        n, ascending, all at least 1.
    compliance : ndarray of complex, shape (n,)
        Amplitude of the surface's u_y over that of the contact pressure, mm/MPa.
    shear_ratio : ndarray of complex, shape (n,)
        Amplitude of i u_x over that of u_y at the surface, dimensionless.
    transfer : list of ndarray of complex, each of shape (2, 2, m)
        From (i u_x, u_y) of a row of nodes to that of the row above, for the first m harmonics.
    """

    harmonics: NDArray[np.int64]
    compliance: Complex
    shear_ratio: Complex
    transfer: list[Complex]

    def displacement(self, surface: Complex) -> list[Complex]:
        """Return the amplitudes (u_x, u_y), mm, of every row of nodes from those of u_y at the surface.

        Parameters
        ----------
        surface : ndarray of complex, shape (n,)
            mm.

        Returns
        -------
        list of ndarray, each of shape (2, m)
            Rows from the road to the top; the first m harmonics, the others have faded.
        """
        row = np.stack((self.shear_ratio * surface, surface))
        rows = [row]
        for step in self.transfer:
            below = row[:, : step.shape[-1]]
            row = step[:, 0] * below[0] + step[:, 1] * below[1]
            rows.append(row)
        return [np.stack((-1j * turned[0], turned[1])) for turned in rows]


def stiffness_moduli(material: Material, frequency: Real, plane: str) -> tuple[Complex, Complex]:
    """Return the moduli, MPa, that weigh ``Block.operators``: of shear and of dilatation.

    Plane strain: G* and K*. Plane stress, without stress across the thickness: G* and
    L* = 2 G* (3 K* - 2 G*) / (3 K* + 4 G*).
    """
    shear, bulk = material.complex_shear_modulus(frequency), material.complex_bulk_modulus(frequency)
    if plane == "strain":
        return shear, bulk
    return shear, 2.0 * shear * (3.0 * bulk - 2.0 * shear) / (3.0 * bulk + 4.0 * shear)


def respond(block: Block, material: Material, velocity: float, harmonics: NDArray[np.int64]) -> HarmonicResponse:
    """Eliminate the block down to its surface.

    The top carries uniform pressure and moves sideways as a whole; the sides are tied.

    Parameters
    ----------
    velocity : float
        v, mm/s; negative slides the other way.
    harmonics : ndarray of int, shape (n,)
        Ascending, from 1 to columns / 2.
    """
    wavenumber = 2.0 * np.pi / block.width * harmonics
    moduli = stiffness_moduli(material, wavenumber * velocity, block.plane)
    operators = block.operators()
    angle = 2.0 * np.pi / block.columns * harmonics
    waves = (2.0 * np.sin(0.5 * angle) ** 2, np.sin(angle))
    active = _active(block, wavenumber)

    transfer: list[Complex] = []
    count = active[-1]
    _, _, stiffness = _weigh(operators, "diagonal", block.rows, moduli, waves, count)
    zero = np.zeros(count, dtype=complex)
    inverse = (zero, zero, 1.0 / stiffness)  # u_x vanishes at the top: its harmonics are held
    for row in range(block.rows - 1, -1, -1):
        above, count = active[row + 1], active[row]
        xx, xy, yy = _weigh(operators, "diagonal", row, moduli, waves, count)
        if above:
            step, correction = _eliminate(_weigh_upward(operators, row, moduli, waves, above), inverse)
            transfer.append(step)
            for entry, part in zip((xx, xy, yy), correction, strict=True):
                entry[:above] -= part
        else:
            transfer.append(np.zeros((2, 2, 0), dtype=complex))
        determinant = xx * yy - xy * xy
        inverse = (yy / determinant, -xy / determinant, xx / determinant)
    _, coupling, compliance = inverse
    # A pressure p over one column acts on its node as the force p times the column's width.
    return HarmonicResponse(
        harmonics, compliance * block.column_width, coupling / compliance, transfer[::-1]
    )


def _active(block: Block, wavenumber: Real) -> list[int]:
    """Return for each row of nodes how many of the (ascending) harmonics reach it."""
    reach = _FADED / wavenumber
    return [int(np.count_nonzero(reach >= position)) for position in block.row_positions]


def _weigh(
    operators: tuple[RowOperator, RowOperator],
    part: str,
    row: int,
    moduli: tuple[Complex, Complex],
    waves: tuple[Real, Real],
    count: int,
) -> tuple[Complex, Complex, Complex]:
    """Return the entries xx, xy, yy of a row's own block, for the first ``count`` harmonics."""
    bend, sine = (wave[:count] for wave in waves)
    xx, xy, yy = (np.zeros(count, dtype=complex) for _ in range(3))
    for operator, modulus in zip(operators, moduli, strict=True):
        uniform, curved, mixed = operator.diagonal[:, row]
        weight = modulus[:count]
        xx += weight * (uniform[0, 0] + curved[0, 0] * bend)
        yy += weight * (uniform[1, 1] + curved[1, 1] * bend)
        xy += weight * (mixed[0, 1] * sine)
    return xx, xy, yy


def _weigh_upward(
    operators: tuple[RowOperator, RowOperator],
    row: int,
    moduli: tuple[Complex, Complex],
    waves: tuple[Real, Real],
    count: int,
) -> tuple[Complex, Complex, Complex, Complex]:
    """Return the entries xx, xy, yx, yy of the block that couples a row to the one above."""
    bend, sine = (wave[:count] for wave in waves)
    xx, xy, yx, yy = (np.zeros(count, dtype=complex) for _ in range(4))
    for operator, modulus in zip(operators, moduli, strict=True):
        uniform, curved, mixed = operator.upward[:, row]
        weight = modulus[:count]
        xx += weight * (uniform[0, 0] + curved[0, 0] * bend)
        yy += weight * (uniform[1, 1] + curved[1, 1] * bend)
        xy += weight * (mixed[0, 1] * sine)
        yx += weight * (mixed[1, 0] * sine)
    return xx, xy, yx, yy


def _eliminate(
    upward: tuple[Complex, Complex, Complex, Complex], inverse: tuple[Complex, Complex, Complex]
) -> tuple[Complex, tuple[Complex, Complex, Complex]]:
    """Return the transfer -S^-1 U^T to the row above, and the correction U S^-1 U^T (xx, xy, yy)."""
    xx, xy, yx, yy = upward
    first, mixed, last = inverse
    low_x = (first * xx + mixed * xy, mixed * xx + last * xy)
    low_y = (first * yx + mixed * yy, mixed * yx + last * yy)
    correction = (xx * low_x[0] + xy * low_x[1], xx * low_y[0] + xy * low_y[1], yx * low_y[0] + yy * low_y[1])
    step = -np.stack((np.stack((low_x[0], low_y[0])), np.stack((low_x[1], low_y[1]))))
    return step, correction
