#!/usr/bin/env python3
"""Validate glTF files by Khronos' gltf-validator: validate_gltf.py --modules FOLDER FILE_OR_FOLDER…

All .glb files in the folders are validated. FOLDER is the folder node_modules in which npm installed the package
gltf-validator. Prints one line per file with an error or a warning, and a summary. Exit code 1: there is an error, or a warning
whose code is not allowed by --allow.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys

# Reads a list of paths from the standard input, and prints the messages of each file.
SCRIPT = """
const fs = require('fs'), path = require('path'), validator = require('gltf-validator');
const files = JSON.parse(fs.readFileSync(0));
(async () => {
  const results = {};
  for (const file of files) {
    const read = uri => Promise.resolve(new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri)))));
    try {
      const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)),
        {uri: path.basename(file), maxIssues: 0, externalResourceFunction: read});
      results[file] = report.issues.messages.filter(message => message.severity < 2)
        .map(message => [message.severity, message.code, message.pointer || '', message.message]);
    } catch (error) {
      results[file] = [[0, 'NOT_GLTF', '', String(error)]];
    }
  }
  process.stdout.write(JSON.stringify(results));
})();
"""


def validate(files, modules):
    """Return the errors (0) and warnings (1) of each file: lists of severity, code, place and text."""
    done = subprocess.run(["node", "-e", SCRIPT], input=json.dumps([str(file) for file in files]), text=True,
                          capture_output=True, check=False, env={"NODE_PATH": str(modules), "PATH": "/usr/local/bin:/usr/bin:/bin"})
    if done.returncode:
        sys.exit(f"validate_gltf.py: {done.stderr.strip()}")
    return json.loads(done.stdout)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("paths", nargs="+", type=pathlib.Path)
    parser.add_argument("--modules", type=pathlib.Path, required=True, help="folder node_modules with gltf-validator")
    parser.add_argument("--allow", action="append", default=[], metavar="CODE", help="a warning that is allowed")
    parser.add_argument("--skip", action="append", default=[], metavar="NAME", help="name of files that are not validated")
    options = parser.parse_args()
    files = sorted({file for path in options.paths for file in ([path] if path.is_file() else path.rglob("*.glb"))
                    if file.name not in options.skip})
    if not files:
        sys.exit("validate_gltf.py: there is no .glb file")
    counts = collections.Counter()
    refused = 0
    for file, messages in validate([file.absolute() for file in files], options.modules.absolute()).items():
        for severity, code, place, text in messages:
            counts[code] += 1
            is_refused = severity == 0 or code not in options.allow
            refused += is_refused
            if is_refused:
                print(f"{file}: {'error' if severity == 0 else 'warning'} {code} {place}: {text}")
    print(f"{len(files)} files, " + (", ".join(f"{code}: {count}" for code, count in sorted(counts.items()))
                                     or "no error, no warning"))
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main())
