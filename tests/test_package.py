"""The package as a user gets it: versions that agree, the loader's sentences, a working wheel."""

from __future__ import annotations

import re
import subprocess
import sys
import time
import tomllib
from concurrent.futures import ThreadPoolExecutor
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import mujoco
import pytest

from flaprig import _paths
from flaprig.native import library

built = pytest.mark.skipif(
    find_spec("flaprig.native._native") is None, reason="not built: run `make build`"
)


@pytest.fixture(scope="module")
def project(root: Path) -> dict[str, Any]:
    return tomllib.loads((root / "pyproject.toml").read_text())


# ---- versions ----------------------------------------------------------------------------------


def test_mujoco_version_is_the_same_everywhere(root: Path, project: dict[str, Any]) -> None:
    pin = f"mujoco=={library.MUJOCO_VERSION}"
    assert pin in project["build-system"]["requires"]
    assert pin in project["project"]["dependencies"]
    assert pin in (root / "constraints.txt").read_text().splitlines()
    assert mujoco.__version__ == library.MUJOCO_VERSION


def test_flaprig_version_is_the_same_everywhere(root: Path, project: dict[str, Any]) -> None:
    version = project["project"]["version"]
    assert re.fullmatch(r"\d+\.\d+\.\d+", version)
    assert f"\nversion: {version}\n" in (root / "CITATION.cff").read_text()
    # CMake takes it from pyproject.toml and writes no number of its own
    cmake = (root / "CMakeLists.txt").read_text()
    assert "project(flaprig VERSION ${SKBUILD_PROJECT_VERSION}" in cmake


def test_every_run_dependency_is_constrained(root: Path, project: dict[str, Any]) -> None:
    extras = project["project"]["optional-dependencies"].values()
    wanted = [*project["project"]["dependencies"], *(line for extra in extras for line in extra)]
    pinned = (root / "constraints.txt").read_text().splitlines()
    names = {plain(line.split("==")[0]) for line in pinned if not line.startswith("#")}
    assert not {plain(re.split("[=<>]", line)[0]) for line in wanted} - names


def plain(name: str) -> str:
    """A distribution's name in its normal form."""
    return re.sub("[-_.]+", "-", name).lower()


# ---- the loader --------------------------------------------------------------------------------


@pytest.mark.parametrize("installed", ["3.16.0", "3.17.1", "4.0.0"])
def test_wrong_mujoco_gives_one_sentence(installed: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mujoco, "__version__", installed)
    with pytest.raises(ImportError) as error:
        library.load()
    needed = library.MUJOCO_VERSION
    assert str(error.value) == (
        f"flaprig is compiled for mujoco {needed} and mujoco {installed} is installed: "
        f"pip install mujoco=={needed}"
    )


def test_missing_library_says_to_build(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(library, "find_spec", lambda name: None)
    with pytest.raises(ImportError, match="is missing: build it with `make build`"):
        library.load()


@built
def test_load_is_idempotent() -> None:
    assert library.load() == library.load()
    assert registered() == list(library.PLUGINS)
    assert not names_a_plugin("flaprig.no_such_air")


@built
def test_threads_load_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """Eight threads at once and a slow load: without the lock each would load."""
    loaded: list[Path] = []

    def slow_load(path: Path) -> None:
        time.sleep(0.02)
        loaded.append(path)

    monkeypatch.setattr(library, "_registered", lambda: bool(loaded))
    monkeypatch.setattr(library, "_in_process", lambda path: True)
    monkeypatch.setattr(library, "_load", slow_load)
    with ThreadPoolExecutor(8) as pool:
        paths = list(pool.map(lambda _: library.load(), range(8)))
    assert len(loaded) == 1 and set(paths) == set(loaded)


def registered() -> list[str]:
    """The flaprig plugins that a model may name."""
    return [name for name in library.PLUGINS if names_a_plugin(name)]


def names_a_plugin(name: str) -> bool:
    xml = f'<mujoco><extension><plugin plugin="{name}"/></extension></mujoco>'
    try:
        mujoco.MjModel.from_xml_string(xml)
    except ValueError:
        return False
    return True


@built
def test_second_copy_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """COUPLING trap 10: an editable copy beside a wheel kills the process without this guard."""
    first = library.load()
    second = tmp_path / first.name
    second.write_bytes(first.read_bytes())
    monkeypatch.setattr(library, "_find", lambda: second)
    with pytest.raises(ImportError, match="a second copy of flaprig cannot be loaded") as error:
        library.load()
    assert str(second) in str(error.value)
    if sys.platform == "linux":
        assert str(first) in str(error.value)


@built
def test_broken_library_is_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    broken = tmp_path / "libflaprig_air.so"
    broken.write_text("no library")
    monkeypatch.setattr(library, "_find", lambda: broken)
    monkeypatch.setattr(library, "_registered", lambda: False)
    with pytest.raises(ImportError, match="does not load"):
        library.load()


@built
def test_stub_describes_the_compiled_module(tmp_path: Path, root: Path) -> None:
    """What mypy reads is what was compiled; after a change of bindings.cpp: `make stub`."""
    stub = tmp_path / "_native.pyi"
    stubgen = [sys.executable, "-m", "nanobind.stubgen", "-q", "-m", "flaprig.native._native"]
    subprocess.run([*stubgen, "-o", str(stub)], cwd=root, check=True)
    kept = root / "flaprig" / "native" / "_native.pyi"
    assert kept.read_text() == stub.read_text(), "run `make stub`"


# ---- models and assets -------------------------------------------------------------------------


def test_paths_do_not_depend_on_the_working_folder(tmp_path: Path, root: Path) -> None:
    code = "from flaprig import _paths; print(_paths.models_dir()); print(_paths.RIG_XML)"
    models, rig = run_python(code, tmp_path, path=root).splitlines()
    assert Path(models) == _paths.models_dir() and Path(models).is_absolute()
    assert Path(rig) == _paths.RIG_XML == Path(models) / "rig.xml"


def test_models_inside_the_package_come_first(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A wheel has them inside; a clone beside the package; neither is an error that says so."""
    package = tmp_path / "flaprig"
    monkeypatch.setattr(_paths, "_PACKAGE", package)
    with pytest.raises(FileNotFoundError, match="the folder models/ is neither in"):
        _paths.models_dir()
    (tmp_path / "models").mkdir()
    assert _paths.models_dir() == tmp_path / "models"
    (package / "models").mkdir(parents=True)
    assert _paths.models_dir() == package / "models"


def run_python(code: str, cwd: Path, path: Path) -> str:
    """What the code prints in a new process that sees `path` first."""
    command = [sys.executable, "-c", f"import sys; sys.path.insert(0, {str(path)!r})\n{code}"]
    done = subprocess.run(command, cwd=cwd, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout


# ---- the wheel ---------------------------------------------------------------------------------

# runs in an empty folder and sees the wheel only: meta_path[0] may be the editable install's finder
USE_WHEEL = """
sys.meta_path[:] = [f for f in sys.meta_path if "ScikitBuild" not in type(f).__name__]
import mujoco
from flaprig import _paths
from flaprig.native import library
print(library.load())
model = mujoco.MjModel.from_xml_path(str(_paths.RIG_XML))
data = mujoco.MjData(model)
mujoco.mj_step(model, data, 10)
print(_paths.RIG_XML, model.nplugin, data.time > 0, data.warning.number.sum())
"""


@pytest.mark.slow
@built
def test_wheel_works_from_an_empty_folder(tmp_path: Path, root: Path) -> None:
    """Build, unpack elsewhere, and step the rig with its air."""
    target, empty = tmp_path / "target", tmp_path / "empty"
    empty.mkdir()
    pip = [sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index"]
    pip += ["--no-build-isolation", "--target", str(target), str(root)]
    done = subprocess.run(pip, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr

    loaded, used = run_python(USE_WHEEL, empty, path=target).splitlines()
    package = target / "flaprig"
    assert Path(loaded).parent == package / "native"
    xml, plugins, moved, warnings = used.split()
    assert Path(xml) == package / "models" / "rig.xml"
    assert int(plugins) >= 1 and moved == "True" and int(warnings) == 0
    assert (package / "native" / "plugin" / "README.md").is_file()
    assert not [*package.rglob("*.cpp"), *package.rglob("*.hpp")]
