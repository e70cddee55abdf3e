"""`python -m fruitgui` is `fruitgui`."""

import sys

from fruitgui.cli import main

sys.exit(main())
