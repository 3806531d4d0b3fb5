"""The subcommands: one file each, with its arguments as a dataclass and a `run` function."""
