"""`python -m flaprig`."""

import sys

from flaprig.cli import main

sys.exit(main())
