# SPDX-License-Identifier: MIT
"""Every fenced `console` block of READMEs, tutorials and how-to pages, run as it stands, a page at a time, in order.

A page is typed into one shell that starts in the workspace's root, with a home folder of its own, nothing sourced, and
a display that nobody sees. In a block

    $ rosrun package command       a line after `$ ` is a command; one that ends in a backslash goes on in the next
    what it prints ... at last     lines below are among those printed, in this order; `...` stands for any text

A command ends with exit code 0. One that ends in `&` goes on while the page does, and is ended with the page as by
Ctrl-C; the next command comes when it has printed what stands below it. What needs hardware, another computer or an
answer of a person stands in blocks of other kinds (`sh`, `text`).
"""
import os
import pathlib
import re
import signal
import subprocess
import time
from typing import Dict, Iterator, List, NamedTuple

import pytest

from ardee_common.ros_graph import RosGraph, wait_until

ROOT = pathlib.Path(__file__).resolve().parents[1]
FOREGROUND_S = 300.0
BACKGROUND_S = 90.0  # until it has printed what it should
BLOCK = re.compile(r"^( *)```console\n(.*?)^\1```$", re.MULTILINE | re.DOTALL)


class Command(NamedTuple):
    """A command of a page, and the lines that the page says it prints."""

    text: str
    printed: List[str]

    @property
    def stays(self) -> bool:
        return self.text.endswith("&") and not self.text.endswith("&&")


def commands_of(page: pathlib.Path) -> List[Command]:
    """The commands of all blocks of a page."""
    found: List[Command] = []
    for indent, block in BLOCK.findall(page.read_text()):
        goes_on = False
        for line in (line[len(indent) :] for line in block.splitlines()):
            if line.startswith("$ "):
                found.append(Command(line[2:], []))
            elif goes_on:
                found[-1] = found[-1]._replace(text=f"{found[-1].text}\n{line}")
            else:
                found[-1].printed.append(line)
            goes_on = line.endswith("\\") and not found[-1].printed
    return found


def pages() -> List[str]:
    """Pages of the tree that have a block."""
    candidates = [ROOT / "README.md", *ROOT.glob("src/*/README.md"), *ROOT.glob("docs/**/*.md")]
    return sorted(str(page.relative_to(ROOT)) for page in candidates if commands_of(page))


def says(printed: List[str], output: str) -> bool:
    """Are these lines among those of the output, in this order?"""
    plain = re.sub(r"\x1b(\[[0-9;]*m|\][^\a]*\a)", "", output).splitlines()
    found = iter(line.rstrip() for line in plain)
    wanted = (line.rstrip() for line in printed if line.strip() != "...")
    patterns = (".*".join(map(re.escape, line.split("..."))) for line in wanted)
    return all(any(re.fullmatch(pattern, line) for line in found) for pattern in patterns)


class Shell:
    """A bash that is typed into."""

    def __init__(self, env: Dict[str, str], folder: pathlib.Path) -> None:
        self._folder, self._count = folder, 0
        self._bash = subprocess.Popen(
            ["bash", "--noprofile", "--norc"],
            stdin=subprocess.PIPE,
            cwd=ROOT,
            env=env,
            start_new_session=True,
        )
        self._type("set -m")  # jobs, as in a terminal

    def _type(self, line: str) -> None:
        self._bash.stdin.write(f"{line}\n".encode())
        self._bash.stdin.flush()

    def run(self, command: Command) -> None:
        """Runs a command; fails if it ends badly or does not print what it should."""
        self._count += 1
        stem = self._folder / f"{self._count:02d}"
        script, log, code = (stem.with_suffix(end) for end in (".bash", ".log", ".code"))
        script.write_text(command.text + "\n")
        started = time.monotonic()
        self._type(f". {script} </dev/null >{log} 2>&1; echo $? >{code}")

        def ended() -> bool:
            return code.exists() and code.read_text().endswith("\n")

        def told() -> bool:
            return says(command.printed, log.read_text(errors="replace"))

        try:
            wait_until(ended, command.text, FOREGROUND_S)
            if command.stays:
                wait_until(told, command.text, BACKGROUND_S)
        except TimeoutError:
            pass
        print(f"--- {time.monotonic() - started:.1f} s: $ {command.text}")
        output = log.read_text(errors="replace")
        print(output[-3000:])
        assert ended(), f"still running: $ {command.text}"
        assert (
            code.read_text().strip() == "0"
        ), f"exit code {code.read_text()}$ {command.text}\n{output[-3000:]}"
        expected = "\n".join(command.printed)
        assert told(), f"$ {command.text}\nexpected:\n{expected}\nfound:\n{output[-3000:]}"

    def _processes(self) -> List[int]:
        """The processes of this shell's session, itself too."""
        found = []
        for folder in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                session = (folder / "stat").read_text().rpartition(")")[2].split()[3]
            except OSError:
                continue  # gone meanwhile
            if int(session) == self._bash.pid:
                found.append(int(folder.name))
        return found

    def close(self) -> None:
        """Ends the shell and what the page has left running, as by Ctrl-C."""
        self._type("exit")
        for pid in self._processes():
            if pid != self._bash.pid:
                os.kill(pid, signal.SIGINT)
        try:
            wait_until(
                lambda: self._bash.poll() is not None and not self._processes(), "all ended", 60.0
            )
        finally:
            self._bash.kill()
            self._bash.wait()


@pytest.fixture(scope="module")
def display() -> Iterator[str]:
    """A display that nobody sees."""
    read, write = os.pipe()
    words = ["Xvfb", "-displayfd", str(write), "-screen", "0", "1280x960x24", "-nolisten", "tcp"]
    server = subprocess.Popen(words, pass_fds=[write], stderr=subprocess.DEVNULL)
    os.close(write)
    with os.fdopen(read) as answer:
        number = answer.readline().strip()
    yield f":{number}"
    server.terminate()
    server.wait(10.0)


@pytest.mark.parametrize("page", pages())
def test_a_page_does_what_it_says(page: str, graph: RosGraph, display: str) -> None:
    home = graph.folder / "home"
    home.mkdir()
    env = {
        name: value
        for name, value in graph.env.items()
        if name.startswith("ROS_") and "PACKAGE" not in name
    }
    env.update(
        HOME=str(home), PATH="/usr/bin:/bin:/usr/sbin:/sbin", LANG="C.UTF-8", DISPLAY=display
    )
    env.update(ROS_MASTER_URI=graph.uri, PYTHONUNBUFFERED="1")
    shell = Shell(env, graph.folder)
    started = time.monotonic()
    try:
        for command in commands_of(ROOT / page):
            shell.run(command)
    finally:
        shell.close()
    print(f"=== {page}: {time.monotonic() - started:.0f} s")


def test_the_tutorials_have_commands() -> None:
    for page in sorted((ROOT / "docs" / "tutorials").glob("[1-9]*.md")):
        assert commands_of(page), page.name


def test_stated_lines_are_looked_for_in_order() -> None:
    output = "one\n\x1b[33mtwo 3.14 m\x1b[0m\nthree\nfour\n"
    assert says(["one", "two ... m"], output) and says(["one", "...", "four"], output)
    assert says([], output) and says(["three", "..."], output)
    assert not says(["two"], output) and not says(["two ... m", "one"], output)
    assert not says(["one", "one"], output) and not says(["five"], output)
