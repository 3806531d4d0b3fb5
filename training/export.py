"""A trained policy as plain arrays: an NPZ without pickle, and the policy run by numpy alone."""

from __future__ import annotations

import json
import zipfile
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import torch
from numpy.typing import NDArray

from flaprig.files import written_whole

Array = NDArray[np.float32]

# what the file says it is
FORMAT = "flaprig policy 1"
# most that a policy may hold, unpacked: a hundred times one of SB3's default size [bytes]
MOST_BYTES = 2**26
# what numpy, zlib and json raise for a file that is none; also one that claims to be endless
_UNREADABLE = (
    *(ValueError, KeyError, OSError, AttributeError, TypeError, EOFError, MemoryError),
    *(RecursionError, NotImplementedError, SyntaxError, zipfile.BadZipFile, zlib.error),
)
# arrays of SB3's MlpPolicy with separate actor and critic
_HIDDEN, _OUTPUT = "mlp_extractor.policy_net", "action_net"


@dataclass(frozen=True, eq=False)
class Policy:
    """The mean action of a policy: layers of tanh, the last one linear, clipped to [-1, 1].

    Attributes:
        weights: of each layer. Shapes (out, in).
        biases: of each layer. Shapes (out,).
    """

    weights: tuple[Array, ...]
    biases: tuple[Array, ...]

    def __call__(self, observation: NDArray[Any]) -> Array:
        """Actions. Shape (..., actions) for observations of shape (..., size)."""
        x = np.asarray(observation, np.float32)
        for weight, bias in zip(self.weights[:-1], self.biases[:-1], strict=True):
            x = np.tanh(x @ weight.T + bias)
        return np.clip(x @ self.weights[-1].T + self.biases[-1], -1.0, 1.0)


def save_policy(path: Path, policy: torch.nn.Module, about: dict[str, Any]) -> None:
    """Write all weights of an SB3 policy as NPZ, with a JSON text that says where it is from.

    Raises:
        OSError: the file cannot be written.
    """
    arrays = {name: value.cpu().numpy() for name, value in policy.state_dict().items()}
    text = json.dumps({"format": FORMAT, **about})
    with written_whole(path) as draft, open(draft, "wb") as stream:
        np.savez_compressed(stream, about=np.array(text), **arrays)


def check_size(path: Path, most: int) -> None:
    """Refuse a file that unpacks to more than `most` bytes, before it is unpacked.

    Raises:
        ValueError: it holds too much.
    """
    try:
        with zipfile.ZipFile(path) as archive:
            size = sum(entry.file_size for entry in archive.infolist())
    except (zipfile.BadZipFile, ValueError, NotImplementedError):
        size = path.stat().st_size
    if size > most:
        allowed = f"at most {most // 2**20} MiB unpacked"
        raise ValueError(f"{path} must be {allowed}, got {size / 2**20:.0f} MiB")


def load_weights(path: Path) -> dict[str, Array]:
    """Weights by name from an exported policy; nothing in the file is executed.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: not an exported policy.
    """
    if not path.is_file():
        raise FileNotFoundError(f"there is no policy file {path}")
    check_size(path, MOST_BYTES)
    try:
        with np.load(path, allow_pickle=False) as archive:
            arrays = {name: archive[name] for name in archive.files}
        about = json.loads(str(arrays.pop("about")))
    except _UNREADABLE:
        raise ValueError(f"{path} is no exported policy (NPZ without pickle)") from None
    if not isinstance(about, dict) or about.get("format") != FORMAT:
        raise ValueError(f"{path} is no exported policy of the format {FORMAT!r}")
    return arrays


def load_policy(path: Path) -> Policy:
    """The policy in an exported file, run by numpy.

    Raises:
        FileNotFoundError: there is no such file.
        ValueError: not an exported policy.
    """
    try:
        return policy_of(load_weights(path))
    except KeyError as missing:
        raise ValueError(f"{path}: the policy lacks {missing}") from None


def policy_of(arrays: dict[str, Array]) -> Policy:
    """The acting layers among an SB3 policy's arrays.

    Raises:
        KeyError: an array is missing.
    """
    names = [name for name in arrays if name.startswith(_HIDDEN) and name.endswith("weight")]
    names.sort(key=lambda name: int(name.split(".")[-2]))
    layers = [name.removesuffix(".weight") for name in names] + [_OUTPUT]
    weights = tuple(arrays[f"{layer}.weight"] for layer in layers)
    return Policy(weights, tuple(arrays[f"{layer}.bias"] for layer in layers))


def fill(policy: torch.nn.Module, arrays: dict[str, Array], path: Path) -> None:
    """Give an SB3 policy the weights of a file.

    Raises:
        ValueError: names or shapes that differ.
    """
    wanted = {name: tuple(value.shape) for name, value in policy.state_dict().items()}
    found = {name: tuple(value.shape) for name, value in arrays.items()}
    if wanted != found:
        wrong = sorted(k for k in wanted.keys() | found.keys() if wanted.get(k) != found.get(k))
        raise ValueError(f"{path}: the policy's arrays do not fit: {', '.join(wrong[:4])}")
    policy.load_state_dict({name: torch.from_numpy(value) for name, value in arrays.items()})
