"""Which benchmarks pytest reads: those of learning need the extra `train`."""

from importlib.util import find_spec

LEARNING = ["bench_learning.py", "bench_vector.py"]
collect_ignore = [] if find_spec("stable_baselines3") else LEARNING
