"""flaprig: the digital twin of a robotic flapping wing."""
