"""The script of perturbed_state.py; `make asan` runs it with a build that has sanitizers.

python tests/plugin/perturb.py 100000 [build/asan]
"""

from __future__ import annotations

import importlib.util
import os
import sys
import tempfile
from pathlib import Path


def use_build(folder: Path) -> None:
    """Take the compiled part from there; before anything of flaprig is imported."""
    name = "flaprig.native._native"
    (file,) = folder.glob("_native*.so")
    spec = importlib.util.spec_from_file_location(name, file)
    assert spec is not None and spec.loader is not None
    sys.modules[name] = module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)


def main() -> None:
    """In a folder of its own, where MuJoCo's log may lie."""
    sys.path.insert(0, str(Path(__file__).parents[2]))
    if len(sys.argv) > 2:
        use_build(Path(sys.argv[2]))

    import mujoco

    from flaprig.native import library
    from tests.plugin.perturbed_state import perturb

    print(f"{sys.argv[1]} perturbed states in {library.load()}", flush=True)
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        # thousands of warnings are right here
        mujoco.set_mju_user_warning(lambda text: None)
        print(dict(perturb(int(sys.argv[1]))))


if __name__ == "__main__":
    main()
