"""The multi-layer perceptron on the features of one view (paper 3.2).

scikit-learn trains it; running it takes its weights and numpy only.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from fruitgui.frame import F64, Ints
from fruitgui.progress import Cancelled, never_cancelled, stop_if

HIDDEN = (32,)
"""Neurons of the hidden layers: a few dozen features and a few kinds need no more."""

_BATCH = 256
_STEP = 8e-3

Rows = Callable[[np.random.Generator], tuple[F64, Ints]]
"""Draws one epoch's rows (n, F), n ≥ 256, and the number of the kind of each."""


@dataclass(frozen=True, slots=True, eq=False)
class Network:
    """Weights (in, out) and biases (out,) of each layer; rectifiers between, softmax at the end."""

    weights: tuple[F64, ...]
    biases: tuple[F64, ...]

    def log_probabilities(self, rows: F64) -> F64:
        """Return the log-probability of each kind (n, K) for standardised rows (n, F)."""
        signal = rows
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            signal = np.maximum(signal @ weight + bias, 0.0)
        logits = signal @ self.weights[-1] + self.biases[-1]
        return log_softmax(logits)


def log_softmax(logits: F64) -> F64:
    """Return the logarithm of the softmax over the last axis."""
    shifted = logits - logits.max(axis=-1, keepdims=True)
    return np.asarray(shifted - np.log(np.exp(shifted).sum(axis=-1, keepdims=True)))


def fit_network(
    rows: Rows,
    kinds: int,
    epochs: int,
    random: np.random.Generator,
    decay: float = 1e-2,
    cancelled: Cancelled = never_cancelled,
) -> Network:
    """Return a network trained for `epochs` epochs of freshly drawn rows.

    Drawing anew each time is what carries the augmentation. The weights of the last third of the epochs are
    averaged (Polyak & Juditsky 1992), so that the result does not hang on the rows that were drawn last.

    Args:
        rows: draws the rows of one epoch.
        kinds: how many kinds there are, K ≥ 1.
        epochs: how often rows are drawn.
        random: the source of all chance.
        decay: L2 penalty on the weights.
        cancelled: asked after each epoch.

    Raises:
        CancelledByUserError: `cancelled` said so.
    """
    if kinds == 1:
        width = rows(random)[0].shape[1]
        return Network((np.zeros((width, 1)),), (np.zeros(1),))
    from sklearn.neural_network import MLPClassifier
    from threadpoolctl import threadpool_limits  # type: ignore[import-untyped]

    perceptron = MLPClassifier(
        HIDDEN, alpha=decay, batch_size=_BATCH, learning_rate_init=_STEP, random_state=int(random.integers(2**31))
    )
    states: list[list[F64]] = []
    with threadpool_limits(limits=1):
        for epoch in range(epochs):
            stop_if(cancelled)
            drawn, numbers = rows(random)
            perceptron.partial_fit(drawn, numbers, classes=np.arange(kinds))
            if 3 * (epoch + 1) > 2 * epochs:
                states.append([np.array(part) for part in (*perceptron.coefs_, *perceptron.intercepts_)])
    parts = [np.mean(part, axis=0) for part in zip(*states, strict=True)]
    layers = len(parts) // 2
    return _with_softmax(parts[:layers], parts[layers:])


def _with_softmax(weights: list[F64], biases: list[F64]) -> Network:
    """Return the network; with two kinds the one logistic output becomes two of a softmax."""
    if weights[-1].shape[1] == 1:
        weights[-1] = np.hstack([np.zeros_like(weights[-1]), weights[-1]])
        biases[-1] = np.concatenate([np.zeros_like(biases[-1]), biases[-1]])
    return Network(tuple(weights), tuple(biases))
