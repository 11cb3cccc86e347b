# SPDX-FileCopyrightText: The Windfall authors
# SPDX-License-Identifier: MIT OR Apache-2.0
"""`windfall export`, run as a process beside Blender: the add-on has no compiled module, so it works with every Python."""

import os
import re
import shutil
import struct
import subprocess
import tempfile
import threading
from pathlib import Path

# Width of the terminal that the program draws its bars on; they are cut off in a narrow one.
COLUMNS = 200
# Time that an interrupted program has to put its files in order.
GRACE_S = 5.0


class Export:
    """An export into a new folder of its own, which is the caller's once the stage is written."""

    def __init__(self, program, scene, options, parent):
        """`options` are pairs of an option and its value, or an option alone."""
        executable = shutil.which(program)
        if executable is None:
            raise FileNotFoundError(f"there is no program '{program}': install Windfall, or name its program in the add-on's preferences")
        self.folder = Path(tempfile.mkdtemp(prefix="windfall-", dir=parent))
        # The collection in Blender is named after the file.
        self.stage = self.folder / (re.sub(r"\W+", "_", Path(scene).stem) + ".usda")
        self._text = ""
        command = [executable, "export", scene, *(str(word) for option in options for word in option), "--out", str(self.stage)]
        try:
            read, write = _terminal()
            self._process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=write)
            os.close(write)
        except OSError:
            self.discard()
            raise
        self._reader = threading.Thread(target=self._read, args=(read,), daemon=True)
        self._reader.start()

    def _read(self, stream):
        """Keeps what the program says; a pipe that nobody empties would stop it."""
        try:
            while data := os.read(stream, 65536):
                self._text += data.decode(errors="replace")
        except OSError:
            # The end of a terminal that nobody writes to any more.
            pass
        os.close(stream)

    def is_running(self):
        return self._process.poll() is None

    def wait(self):
        self._process.wait()

    def progress(self):
        """Latest state of the program's bar: what it counts, how many are done, how many there are."""
        found = re.findall(r"(frame|making leaves)\b\D*(\d+) of (\d+)", self._text)
        return (found[-1][0], int(found[-1][1]), int(found[-1][2])) if found else None

    def error(self):
        """The line that a program that failed has printed, or None."""
        if self._process.wait() == 0:
            return None
        self._reader.join()
        # Escapes of bars, and what drivers print before it.
        lines = re.sub(r"\x1b\[[0-9;]*[A-Za-z]", "\n", self._text).splitlines()
        errors = [line.strip() for line in lines if line.startswith("error: ")]
        return errors[-1].removeprefix("error: ") if errors else f"the program ended with status {self._process.returncode}"

    def cancel(self):
        """Ends the program and removes what it has written."""
        self._process.terminate()
        try:
            self._process.wait(GRACE_S)
        except subprocess.TimeoutExpired:
            self._process.kill()
            self._process.wait()
        self.discard()

    def discard(self):
        shutil.rmtree(self.folder, ignore_errors=True)


def _terminal():
    """Ends to read from and to write to. The program shows its progress on terminals only, so it is given one where there are any."""
    if os.name != "posix":
        return os.pipe()
    import fcntl
    import pty
    import termios

    read, write = pty.openpty()
    fcntl.ioctl(write, termios.TIOCSWINSZ, struct.pack("HHHH", 24, COLUMNS, 0, 0))
    return read, write
