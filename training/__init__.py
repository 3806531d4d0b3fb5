"""Learning: PPO with transfer, and the baselines that say what it adds. One file an algorithm."""
