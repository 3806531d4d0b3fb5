"""Where models/ and assets/ are: inside the package in a wheel, beside it in a clone."""

from __future__ import annotations

from pathlib import Path

_PACKAGE = Path(__file__).resolve().parent


def _folder(name: str) -> Path:
    """The folder in the package if it is there (wheel), else beside it (clone)."""
    inside = _PACKAGE / name
    return inside if inside.is_dir() else _PACKAGE.parent / name


def _existing(name: str) -> Path:
    folder = _folder(name)
    if not folder.is_dir():
        raise FileNotFoundError(
            f"flaprig: the folder {name}/ is neither in {_PACKAGE} nor beside it; "
            "install the package again, or work in a complete clone"
        )
    return folder


def models_dir() -> Path:
    """The folder of the MJCF models. FileNotFoundError when the installation lacks it."""
    return _existing("models")


def assets_dir() -> Path:
    """The folder of meshes, textures and data. FileNotFoundError when the installation lacks it."""
    return _existing("assets")


# the rig of the paper; not checked here, so that importing never fails
RIG_XML = _folder("models") / "rig.xml"
