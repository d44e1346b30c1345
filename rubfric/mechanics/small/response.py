"""Small strain, steady sliding, exact in time: the block's response to each harmonic of the road.

In the frame of the road every field depends on x only through harmonics n of wavenumber n k, which
excite the sliding rubber at the frequency n k v. For each of them the block is a chain of rows with complex
moduli, K_n = G*(n k v) K_shear + L*(n k v) K_dilatation, and one sweep over the rows from the top to the road
eliminates it, for all harmonics at once: what remains is the compliance of the surface.

With M the stiffness of a row of nodes u' to which all above it is condensed, and [A B; B^T .] that of the cells below
it, the next row u has, for pointwise dilatation,

    u' = -M^-1 B^T u,    M_next = A - B M^-1 B^T.

Where dilatation acts through its mean over each cell, its form is of rank one, L* h (c u + d u')². It is kept out of A,
B and M: the pressure q = L* h (c u + d u') of the cells is eliminated with u',

    w = c - B M^-1 d,    s = 1 / (L* h) + d M^-1 d,    q = w u / s,
    u' = -M^-1 (B^T u + d q),    M_next = A - B M^-1 B^T + w w^T / s,

which loses no digits however much larger the bulk modulus is than the shear modulus.

A field is stored by its complex amplitudes: f(x) = f_0 + 2 Re sum_n f_n exp(i n k x). The last harmonic,
n = columns / 2, is its own conjugate at the nodes, and stored by half.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from rubfric.arrays import Complex, Real, Whole
from rubfric.mechanics.block.block import Block
from rubfric.rubber.material import Material

# A harmonic decays as exp(-n k y): rows above n k y = 40 are at rest in double precision.
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
        From (i u_x, u_y) of a row of nodes to that of the row above, for the first m harmonics: the
        others have faded.
    """

    harmonics: Whole
    compliance: Complex
    shear_ratio: Complex
    transfer: list[Complex]

    def displacement(self, surface: Complex) -> Complex:
        """Return the amplitudes (u_x, u_y), mm, of every row of nodes from those of u_y at the surface.

        Parameters
        ----------
        surface : ndarray of complex, shape (n,)
            mm.

        Returns
        -------
        ndarray of complex, shape (rows + 1, 2, n)
            Rows from the road to the top.
        """
        rows = np.zeros((len(self.transfer) + 1, 2, len(surface)), dtype=complex)
        rows[0] = self.shear_ratio * surface, surface
        for below, (step, above) in enumerate(zip(self.transfer, rows[1:], strict=True)):
            count = step.shape[-1]
            above[:, :count] = step[:, 0] * rows[below, 0, :count] + step[:, 1] * rows[below, 1, :count]
        rows[:, 0] *= -1j
        return rows

    def bands(self) -> Iterator[tuple[slice, int]]:
        """Group the rows of cells by how many harmonics reach them, to within a factor of two.

        Yields
        ------
        rows : slice
            Rows of cells.
        count : int
            Harmonics, from the first, that reach any of them.
        """
        reach = [len(self.harmonics)] + [step.shape[-1] for step in self.transfer[:-1]]
        start = 0
        for row in range(1, len(reach) + 1):
            if row == len(reach) or reach[row] <= reach[start] // 2:
                yield slice(start, row), reach[start]
                start = row


def stiffness_moduli(material: Material, frequency: Real, plane: str) -> tuple[Complex, Complex]:
    """Return the moduli, MPa, that weigh ``Block.operators``: of shear and of dilatation.

    Plane strain: G* and K*. Plane stress, without stress across the thickness: G* and
    L* = 2 G* (3 K* - 2 G*) / (3 K* + 4 G*).

    Parameters
    ----------
    material : Material
    frequency : array_like, shape (...)
        Angular frequency, rad/s.
    plane : {"stress", "strain"}
    """
    shear, bulk = material.complex_shear_modulus(frequency), material.complex_bulk_modulus(frequency)
    if plane == "strain":
        return shear, bulk
    return shear, 2.0 * shear * (3.0 * bulk - 2.0 * shear) / (3.0 * bulk + 4.0 * shear)


def respond(block: Block, material: Material, velocity: float, harmonics: Whole) -> HarmonicResponse:
    """Eliminate the block down to its surface.

    The top carries uniform pressure and moves sideways as a whole; the sides are tied.

    Parameters
    ----------
    block : Block
    material : Material
    velocity : float
        v, mm/s; negative slides the other way.
    harmonics : ndarray of int, shape (n,)
        Ascending, from 1 to columns / 2.
    """
    wavenumber = block.wavenumbers[harmonics]
    shear, dilatation = stiffness_moduli(material, wavenumber * velocity, block.plane)
    moduli = (shear, dilatation) if block.pointwise else (shear,)
    chain = _weigh(block, harmonics, moduli)
    active = _active(block, wavenumber)
    heights = np.diff(block.row_positions) / block.column_width
    across, along = np.sin(np.pi / block.columns * harmonics), np.cos(np.pi / block.columns * harmonics)
    # u_x vanishes at the top: its harmonics are held, so only the entry yy is inverted there.
    zero = np.zeros(active[-1], dtype=complex)
    inverse = (zero, zero, 1.0 / chain.own[2, -1, : active[-1]])
    transfer: list[Complex] = []
    for row in range(block.rows - 1, -1, -1):
        above, count = active[row + 1], active[row]
        xx, xy, yy = chain.own[:, row, :count]
        step, correction = _eliminate(chain.upward[:, row, :above], inverse)
        gradient, stiffness = np.array((across, along / heights[row])), dilatation * heights[row]
        if not block.pointwise:
            _add_mean_dilatation(step, correction, inverse, gradient[:, :above], stiffness[:above])
        transfer.append(step)
        for entry, part in zip((xx, xy, yy), correction, strict=True):
            entry[:above] -= part
        determinant = xx * yy - xy * xy
        inverse = (yy / determinant, -xy / determinant, xx / determinant)
        if not block.pointwise:  # for the harmonics that have faded above, the row above is at rest
            _stiffen(inverse, gradient[:, above:count], stiffness[above:count], slice(above, count))
    _, coupling, compliance = inverse
    # A pressure p over one column acts on its node as the force p times the column's width.
    return HarmonicResponse(harmonics, compliance * block.column_width, coupling / compliance, transfer[::-1])


@dataclass(frozen=True)
class _Chain:
    """Stiffness of all rows for all harmonics, MPa, entry by entry of the basis (i u_x, u_y).

    Attributes
    ----------
    own : ndarray of complex, shape (3, rows + 1, n)
        xx, xy and yy of each row of nodes.
    upward : ndarray of complex, shape (4, rows, n)
        xx, xy, yx and yy between a row and the one above.
    """

    own: Complex
    upward: Complex


def _weigh(block: Block, harmonics: Whole, moduli: tuple[Complex, ...]) -> _Chain:
    """Return the stiffness that the forms of ``Block.operators`` make with as many moduli as are given."""
    operators = block.operators()
    angle = 2.0 * np.pi / block.columns * harmonics
    waves = np.stack((np.ones_like(angle), 2.0 * np.sin(0.5 * angle) ** 2, np.sin(angle)))
    # A form's parts, as in RowOperator: uniform and bending (0, 1) where both unknowns are alike, sine (2) otherwise.
    straight, mixed = slice(0, 2), slice(2, 3)

    def entry(part: str, parts: slice, low: int, high: int) -> Complex:
        terms = zip(operators, moduli, strict=False)
        return np.sum(
            [getattr(form, part)[parts, :, low, high].T @ (waves[parts] * weight) for form, weight in terms], axis=0
        )

    x, y = 0, 1
    own = [entry("diagonal", straight, x, x), entry("diagonal", mixed, x, y), entry("diagonal", straight, y, y)]
    upward = [entry("upward", mixed if low != high else straight, low, high) for low in (x, y) for high in (x, y)]
    return _Chain(np.stack(own), np.stack(upward))


def _active(block: Block, wavenumber: Real) -> list[int]:
    """Return for each row of nodes how many of the (ascending) harmonics reach it; the first is always kept."""
    reach = _FADED / wavenumber
    return [max(1, int(np.count_nonzero(reach >= position))) for position in block.row_positions]


def _eliminate(
    upward: Complex, inverse: tuple[Complex, Complex, Complex]
) -> tuple[Complex, tuple[Complex, Complex, Complex]]:
    """Return -S^-1 U^T, the transfer to the row above, and U S^-1 U^T (xx, xy, yy), the correction below.

    ``upward`` holds the entries xx, xy, yx, yy of U, and ``inverse`` xx, xy, yy of the symmetric S^-1.
    """
    xx, xy, yx, yy = upward
    first, mixed, last = inverse
    x_from_x, y_from_x = first * xx + mixed * xy, mixed * xx + last * xy
    x_from_y, y_from_y = first * yx + mixed * yy, mixed * yx + last * yy
    correction = (xx * x_from_x + xy * y_from_x, xx * x_from_y + xy * y_from_y, yx * x_from_y + yy * y_from_y)
    step = np.array(((x_from_x, x_from_y), (y_from_x, y_from_y)))
    return np.negative(step, out=step), correction


def _add_mean_dilatation(
    step: Complex,
    correction: tuple[Complex, Complex, Complex],
    inverse: tuple[Complex, Complex, Complex],
    gradient: Real,
    stiffness: Complex,
) -> None:
    """Add to the results of ``_eliminate``, in place, what the mean dilatation of the cells adds.

    Parameters
    ----------
    step : ndarray of complex, shape (2, 2, m)
        -M^-1 B^T, to which -M^-1 d w^T / s is added.
    correction, inverse : tuple of ndarray of complex, each of shape (m,)
        xx, xy, yy of B M^-1 B^T, from which w w^T / s is taken, and of M^-1.
    gradient : ndarray, shape (2, m)
        d, times the width of a column; c is d with its y component turned.
    stiffness : ndarray of complex, shape (m,)
        L* h, MPa, zero for a Poisson's ratio of 0 in plane stress; h is the height of the cells over their width.
    """
    across, along = gradient
    first, mixed, last = inverse
    lever = np.array((first * across + mixed * along, mixed * across + last * along))  # M^-1 d
    # B M^-1 d = -step^T d, as M is symmetric.
    w = np.array((across + step[0, 0] * across + step[1, 0] * along, step[0, 1] * across + step[1, 1] * along - along))
    scaled = w * stiffness / (1.0 + stiffness * (across * lever[0] + along * lever[1]))
    step -= lever[:, None] * scaled
    for part, (a, b) in zip(correction, ((0, 0), (0, 1), (1, 1)), strict=True):
        part -= w[a] * scaled[b]


def _stiffen(inverse: tuple[Complex, Complex, Complex], gradient: Real, stiffness: Complex, part: slice) -> None:
    """Make M^-1 the inverse of M + stiffness c c^T, in place, for a part of the harmonics (Sherman and Morrison)."""
    across, along = gradient[0], -gradient[1]
    first, mixed, last = (entry[part] for entry in inverse)
    lever = (first * across + mixed * along, mixed * across + last * along)  # M^-1 c
    scale = stiffness / (1.0 + stiffness * (across * lever[0] + along * lever[1]))
    for entry, (a, b) in zip(inverse, ((0, 0), (0, 1), (1, 1)), strict=True):
        entry[part] -= scale * lever[a] * lever[b]
