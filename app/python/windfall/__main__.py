# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The command `windfall`: `python -m windfall render storm --out storm.png`."""

import signal
import sys

from ._windfall import main as _main


def main() -> None:
    """Runs the command with the arguments of this process, and ends it."""
    # The interpreter hears Ctrl-C only between two of its own steps, and the command is one.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    sys.exit(_main(["windfall", *sys.argv[1:]]))


if __name__ == "__main__":
    main()
