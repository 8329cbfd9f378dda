"""Run the command-line program in a separate folder and check the files that it writes."""

import json
import os
import pathlib
import subprocess

import shapes

PROGRAM = os.environ["BINDPOSE_PROGRAM"]


class Run:
    """One run of the program: exit code, both outputs, and the report if it was written to standard output."""

    def __init__(self, words, folder, environment=None):
        self.words = [str(word) for word in words]
        before = set(os.listdir(folder))
        done = subprocess.run([PROGRAM, *self.words], cwd=folder, capture_output=True, text=True, timeout=300,
                              check=False, env={**os.environ, **(environment or {})})
        self.code, self.out, self.err = done.returncode, done.stdout, done.stderr
        self.new_files = sorted(set(os.listdir(folder)) - before)

    @property
    def report(self):
        return json.loads(self.out)

    def is_good(self):
        assert self.code == 0, self.err
        assert not any(".part-" in name for name in self.new_files)
        return self

    def is_refused(self, *words, code=2):
        """Expect one sentence that contains these words, the exit code, and no new files."""
        assert self.code == code, (self.words, self.code, self.err)
        lines = [line for line in self.err.splitlines() if ": warning: " not in line]
        assert len(lines) == 1, self.err
        assert lines[0].startswith(f"bindpose {self.words[0]}: "), self.err
        for word in words:
            assert word in lines[0]
        assert self.new_files == []
        return self


class Folder:
    def __init__(self, path):
        self.path = pathlib.Path(path)

    def __truediv__(self, name):
        return self.path / name

    def write(self, name, text):
        mode = "wb" if isinstance(text, bytes) else "w"
        with open(self.path / name, mode) as file:
            file.write(text)
        return name

    def off(self, name, mesh):
        return self.write(name, shapes.off(mesh))

    def run(self, *words, environment=None):
        return Run(words, self.path, environment)
