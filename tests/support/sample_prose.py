#!/usr/bin/env python3
"""Draw comments, messages and identifiers of the project at random. A reader who has not seen the code then counts the
samples that need a second reading.

The same seed draws the same samples from the same sources. A sample is a whole comment, because a single line of a
comment cannot be judged. Draw samples with three different seeds.

usage: sample_prose.py [--seed N] [--comments 100] [--messages 20] [--identifiers 20]
"""

import argparse
import pathlib
import random
import re

ROOT = pathlib.Path(__file__).resolve().parents[2]
FOLDERS = ("filters", "viewer", "python", "tests", "examples")
CPP = {".h", ".cpp", ".cxx"}
LONGEST = 12  # maximum number of lines of a sample; a longer comment is cut off
WORD = re.compile(r"[A-Za-z]{2,}")
STRING = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
DECLARED = re.compile(r"\b(?:class|struct|enum class|enum)\s+([A-Za-z_]\w+)|"
                      r"\b(?:Index|int|bool|double|auto|void|Status|Vec3|Points|Weights|std::\w+(?:<[^;()]*>)?)[&*]?\s+"
                      r"([a-z]\w{2,})\s*[=({;,)]")


def sources():
    for folder in FOLDERS:
        yield from sorted(path for path in (ROOT / folder).rglob("*") if path.suffix in CPP | {".py"})


def comments_of(path, lines):
    """Yield the line number and the text of each comment."""
    mark = r"\s*#(?!!)" if path.suffix == ".py" else r"\s*///?<?"
    block, start = [], 0
    for number, line in enumerate([*lines, ""], 1):
        alone = re.match(mark + r"\s?(.*)$", line)
        if alone:
            start = start if block else number
            block.append(alone[1].strip())
            continue
        if block:
            yield start, block
            block = []
        behind = re.search(r"[;{,)]\s*//[/<\s]*(.+)$", line) if path.suffix != ".py" else None
        if behind and "://" not in line:
            yield number, [behind[1].strip()]


def is_prose(text):
    return len(WORD.findall(text)) >= 3 and not re.match(r"[-=*]{3}|clang-format|NOLINT|namespace", text)


def messages_of(path, text):
    """Yield the string literals that are sentences. Tests are ignored, and adjacent literals are joined."""
    if path.parts[len(ROOT.parts)] == "tests":
        return
    joined = re.sub(r'"\s*\n\s*"', "", text)
    for found in STRING.finditer(joined):
        if len(WORD.findall(found[1])) >= 4 and "#include" not in joined[max(0, found.start() - 12):found.start()]:
            yield found[1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--comments", type=int, default=100)
    parser.add_argument("--messages", type=int, default=20)
    parser.add_argument("--identifiers", type=int, default=20)
    options = parser.parse_args()
    comments, messages, identifiers = [], set(), set()
    for path in sources():
        text = path.read_text(encoding="utf-8")
        name = path.relative_to(ROOT)
        for line, block in comments_of(path, text.splitlines()):
            if is_prose(" ".join(block)):
                comments.append(f"{name}:{line}\n" + "\n".join("      " + each for each in block[:LONGEST]))
        messages.update(messages_of(path, text))
        if path.suffix in CPP:
            identifiers.update(one or other for one, other in DECLARED.findall(text))
    draw = random.Random(options.seed)
    for title, samples, count in (("Comments", comments, options.comments),
                                  ("Messages", sorted(messages), options.messages),
                                  ("Identifiers", sorted(identifiers), options.identifiers)):
        print(f"{title}: {count} of {len(samples):,}\n")
        for number, sample in enumerate(draw.sample(samples, min(count, len(samples))), 1):
            print(f"{number:4}. {sample}")
        print()


if __name__ == "__main__":
    main()
