"""A desktop for tests of windows: an X server and a window manager, with keys and mouse motions by xdotool."""

import contextlib
import os
import subprocess
import time

SECONDS = 60  # time limit in seconds, for a busy machine


def wait_for(condition, what):
    """Return the result of the condition as soon as it is true."""
    end = time.monotonic() + SECONDS
    while time.monotonic() < end:
        found = condition()
        if found:
            return found
        time.sleep(0.05)
    raise AssertionError(f"{what}: not after {SECONDS} s")


class Desktop:
    """An X server with a window manager, and the programs that a test starts."""

    def __init__(self, home, screen="1400x1000x24", **environment):
        """Start the X server and the window manager. Programs get the home folder `home` and the variables of
        `environment`."""
        self.home = home
        self.running = []
        self.variables = environment
        read, write = os.pipe()
        self.start("Xvfb", "-displayfd", str(write), "-screen", "0", screen, "-noreset", pass_fds=[write])
        os.close(write)
        with os.fdopen(read) as stream:
            self.display = ":" + stream.readline().strip()
        self.start("openbox")
        self.wait_for(lambda: self.tool("getactivewindow", check=False) is not None and self.is_managed(),
                      "a window manager")

    def environment(self):
        base = {key: value for key, value in os.environ.items() if not key.startswith(("XDG_", "QT_", "WAYLAND"))}
        return {**base, "DISPLAY": getattr(self, "display", ""), "HOME": str(self.home), "XDG_RUNTIME_DIR": str(self.home),
                **self.variables}

    def start(self, *words, **more):
        process = subprocess.Popen(words, env=self.environment(),
                                   **{"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, **more})
        self.running.append(process)
        return process

    def wait_for(self, condition, what):
        """Wait like wait_for(), and check that all started programs are still running."""
        def is_met():
            ended = [f"{process.args[0]} with {process.poll()}" for process in self.running if process.poll() is not None]
            assert not ended, f"{what}: ended before it: {', '.join(ended)}"
            return condition()
        return wait_for(is_met, what)

    def tool(self, *words, check=True):
        """Run xdotool and return its output."""
        done = subprocess.run(["xdotool", *map(str, words)], env=self.environment(), capture_output=True, text=True,
                              check=False)
        assert not check or done.returncode == 0, f"xdotool {words}: {done.stderr}"
        return done.stdout.strip()

    def is_managed(self):
        """Report whether a window manager is running. It writes its capabilities to the root window."""
        return subprocess.run(["xdotool", "get_num_desktops"], env=self.environment(), capture_output=True,
                              check=False).returncode == 0

    def window(self, name):
        """Return the topmost window whose title matches this expression, or None."""
        found = self.tool("search", "--onlyvisible", "--name", name, check=False).split()
        return found[-1] if found else None

    def wait_for_window(self, name):
        window = self.wait_for(lambda: self.window(name), f"a window '{name}'")
        self.activate(window)
        return window

    def activate(self, window):
        """Give the keyboard focus to this window."""
        def is_active():
            self.tool("windowactivate", window, check=False)
            return self.tool("getwindowfocus", check=False) == window
        self.wait_for(is_active, "the focus")

    def keys(self, *keys):
        for key in keys:
            self.tool("key", "--clearmodifiers", key)
            time.sleep(0.05)

    def close(self, window, process):
        """Close the window with the keys Alt+F4, and wait until the program ends. If the program does not end within
        five seconds, press the keys again: a window manager ignores keys that arrive before the new focus is active.
        """
        for _ in range(SECONDS // 5):
            self.tool("windowactivate", window, check=False)
            self.keys("alt+F4")
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(5)
                break
        code, windows = process.poll(), self.tool("search", "--onlyvisible", "--name", ".", check=False).split()
        assert code == 0, f"exit code {code}, and window {window} is {'' if window in windows else 'not '}open"
        self.running.remove(process)

    def end(self):
        for process in reversed(self.running):
            process.kill()
            process.wait()
