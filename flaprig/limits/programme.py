"""A least-squares problem under linear bounds, as Clarabel takes it.

P. Goulart & Y. Chen, Clarabel: an interior-point solver for conic programs with quadratic
objectives, arXiv 2405.12762.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_array, csr_array, triu, vstack

Array = NDArray[np.float64]
# (A, b) of A x <= b or A x = b
Rows = tuple[csr_array, Array]

# tolerances of the solver, relative
TOLERANCE = 1e-10
# iterations: usually ten to thirty are needed
ITERATIONS = 200


def least_squares(
    matrix: csr_array, target: Array, at_most: list[Rows], equal: list[Rows]
) -> Array | None:
    """The x of smallest |matrix x - target| with A x <= b and A x = b; None when there is none.

    Raises:
        RuntimeError: the solver gave up.
    """
    # imported here: only strokes beyond the limits need it
    import clarabel

    quadratic = csc_array(triu(matrix.T @ matrix, format="csc") / target.size)
    linear = -(matrix.T @ target) / target.size
    rows = csc_array(vstack([a for a, _ in (*equal, *at_most)], format="csc"))
    right = np.concatenate([b for _, b in (*equal, *at_most)])
    zeros = sum(b.size for _, b in equal)
    cones = [clarabel.ZeroConeT(zeros), clarabel.NonnegativeConeT(right.size - zeros)]
    settings = clarabel.DefaultSettings()
    settings.verbose = False
    settings.max_iter = ITERATIONS
    settings.max_threads = 1
    settings.tol_gap_abs = settings.tol_gap_rel = settings.tol_feas = TOLERANCE
    solution = clarabel.DefaultSolver(quadratic, linear, rows, right, cones, settings).solve()
    status, states = solution.status, clarabel.SolverStatus
    if status in (states.PrimalInfeasible, states.AlmostPrimalInfeasible):
        return None
    if status not in (states.Solved, states.AlmostSolved, states.InsufficientProgress):
        raise RuntimeError(f"least_squares: Clarabel gave up with status {status}")
    return np.array(solution.x)
