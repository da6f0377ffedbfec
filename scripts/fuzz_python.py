# SPDX-License-Identifier: MIT
"""Fuzzes a Python target by atheris: fuzz_python.py --target=NAME [libFuzzer's options, corpora, an input to repeat].

A target is a function of src/PACKAGE/fuzz/targets.py; bytes of text are changed line by line and word by word.
"""
import importlib.util
import pathlib
import random
import re
import sys
from typing import Callable, Dict, List, Tuple

ROOT = pathlib.Path(__file__).resolve().parents[1]
FILES = sorted(ROOT.glob("src/*/fuzz/targets.py"))
PACKAGES = ["ardee_common", *(file.parents[1].name for file in FILES)]

# Values at the limits of numbers and of derived sizes, and words with a meaning in YAML.
VALUES = (
    b"|0|-1|0.5|1e-320|1e9|1e300|1e309|.nan|.inf|nan|inf|4294967296|9223372036854775808|99999999999999999999999"
    b"|true|null|2001-01-01|0x10|1_000|12:30:45|[]|{}|[1, 2]|{a: 1}|&a|*a|!!binary aaaa|'|#"
).split(b"|")


def load(file: pathlib.Path) -> Dict[str, Callable[[bytes], None]]:
    """Returns the targets of a package, by name."""
    spec = importlib.util.spec_from_file_location(f"{file.parents[1].name}_targets", file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.TARGETS


def corpus(package: str) -> List[Tuple[Callable[[bytes], None], pathlib.Path]]:
    """Returns each target of a package with each input of its corpus, for the test that replays them."""
    folder = ROOT / "src" / package / "fuzz"
    targets = load(folder / "targets.py")
    inputs = [
        (run, path)
        for name, run in targets.items()
        for path in sorted((folder / "corpus" / name).iterdir())
    ]
    assert {path.parent.name for _, path in inputs} == set(targets)
    return inputs


def change_line(data: bytes, draw: random.Random) -> bytes:
    """Returns the text with a line less or more, or another word in one."""
    lines = data.splitlines(keepends=True)
    at = draw.randrange(len(lines))
    choice = draw.randrange(6)
    if choice == 0:
        del lines[at]
    elif choice == 1:
        lines.insert(draw.randrange(len(lines) + 1), lines[at])
    else:
        words = re.split(rb"([\s,:\[\]]+)", lines[at])
        words[draw.randrange(0, len(words), 2)] = draw.choice(VALUES)
        lines[at] = b"".join(words)
    return b"".join(lines)


def main() -> int:
    """Runs the fuzzer; `--target=NAME` comes first."""
    sys.path[:0] = [str(ROOT / "src" / package / "src") for package in PACKAGES]
    sys.path.append(str(ROOT / "pydeps_fuzz"))
    import atheris

    def mutate(data: bytes, most: int, seed: int) -> bytes:
        if not data.strip() or not data.isascii() or b"\0" in data or seed % 4 == 0:
            return atheris.Mutate(data, most)
        return change_line(data, random.Random(seed))[:most]

    with atheris.instrument_imports(include=PACKAGES):
        targets = {name: run for file in FILES for name, run in load(file).items()}
    wanted = sys.argv[1].partition("--target=")[2]
    if wanted not in targets:
        print(f"found {wanted!r}, expected --target= and one of {', '.join(targets)}")
        return 2
    atheris.Setup([sys.argv[0], *sys.argv[2:]], targets[wanted], custom_mutator=mutate)
    atheris.Fuzz()
    return 0


if __name__ == "__main__":
    raise SystemExit(main())
