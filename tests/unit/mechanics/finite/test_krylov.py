"""GMRES that can be asked on its way."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.sparse.linalg import LinearOperator, gmres

from rubfric.mechanics.finite.krylov import Krylov

Real = NDArray[np.float64]
SIZE = 30


@pytest.fixture
def matrix(rng: np.random.Generator) -> Real:
    return np.eye(SIZE) + 0.3 * rng.standard_normal((SIZE, SIZE)) / np.sqrt(SIZE)


def begun(matrix: Real, right: Real, guess: Real | None = None, most: int = SIZE) -> Krylov:
    return Krylov(lambda vector: (matrix @ vector, vector[:3]), right, guess, most)


@pytest.mark.parametrize("guessed", [False, True])
def test_vector_is_that_of_gmres(matrix: Real, rng: np.random.Generator, guessed: bool) -> None:
    right, guess = rng.standard_normal(SIZE), rng.standard_normal(SIZE) if guessed else None
    krylov = begun(matrix, right, guess)
    for _ in range(6):
        krylov.grow()
    operator = LinearOperator(matrix.shape, matvec=lambda vector: matrix @ vector, dtype=float)
    expected, _ = gmres(operator, right, x0=guess, rtol=0.0, restart=6, maxiter=1)
    np.testing.assert_allclose(krylov.vector(), expected, rtol=1e-9)
    missed = np.linalg.norm(right - matrix @ krylov.vector()) / np.linalg.norm(right)
    assert krylov.residual == pytest.approx(missed, rel=1e-8)
    assert krylov.applied == 6 + guessed


def test_what_stands_beside_follows_from_the_vector(matrix: Real, rng: np.random.Generator) -> None:
    krylov = begun(matrix, rng.standard_normal(SIZE), rng.standard_normal(SIZE))
    for _ in range(5):
        np.testing.assert_allclose(krylov.beside(), krylov.vector()[:3], rtol=1e-12)
        krylov.grow()
    np.testing.assert_allclose(krylov.beside(), krylov.vector()[:3], rtol=1e-12)


def test_residual_falls_to_round_off_in_the_whole_space(matrix: Real, rng: np.random.Generator) -> None:
    krylov = begun(matrix, rng.standard_normal(SIZE))
    residuals = [krylov.residual]
    while not krylov.full:
        krylov.grow()
        residuals.append(krylov.residual)
    assert residuals[0] == 1.0
    assert np.all(np.diff(residuals) < 1e-14)
    assert residuals[-1] < 1e-12


def test_space_has_its_bound(matrix: Real, rng: np.random.Generator) -> None:
    krylov = begun(matrix, rng.standard_normal(SIZE), most=2)
    assert not krylov.full
    krylov.grow()
    krylov.grow()
    assert krylov.full


def test_nothing_to_solve_is_solved(matrix: Real) -> None:
    krylov = begun(matrix, np.zeros(SIZE))
    assert krylov.full
    np.testing.assert_array_equal(krylov.vector(), 0.0)


def test_single_precision_solves_to_its_round_off(matrix: Real, rng: np.random.Generator) -> None:
    right = rng.standard_normal(SIZE)
    krylov = Krylov(lambda vector: (matrix @ vector, vector[:3]), right, None, SIZE, np.float32)
    while krylov.residual > 1e-4:
        krylov.grow()
    vector = krylov.vector()
    assert vector.dtype == np.float64
    missed = np.linalg.norm(right - matrix @ vector) / np.linalg.norm(right)
    assert krylov.residual == pytest.approx(missed, abs=2e-6)
    assert 0.0 < missed < 1.1e-4


def test_basis_stays_orthonormal_where_the_operator_hardly_turns_a_vector(
    matrix: Real, rng: np.random.Generator
) -> None:
    krylov = begun(1e6 * np.eye(SIZE) + matrix, rng.standard_normal(SIZE))
    for _ in range(4):
        krylov.grow()
    basis = krylov._basis[:5]
    np.testing.assert_allclose(basis @ basis.T, np.eye(5), atol=1e-14)
