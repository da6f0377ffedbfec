# SPDX-License-Identifier: MIT
"""The documentation site is built without a warning, and its troubleshooting page quotes messages that exist."""
import pathlib
import re
import subprocess

ROOT = pathlib.Path(__file__).resolve().parents[1]
SITE = ROOT / "build" / "docs"
# Messages of ROS, Qt, argparse and the system, by words of theirs.
OF_OTHERS = (
    "RLException",
    "[rospack]",
    "command not found",
    "invalid choice",
    "Failed to contact master",
    "Unable to communicate with master",
    "Unable to register with master",
    "Unable to contact my own server",
    "Couldn't find an AF_INET address",
    "roscore cannot run",
    "does not appear to be published yet",
    "Unable to determine topic type",
    "as there were no subscribers",
    "new node registered with same name",
    "KDL",
    "The root link base_footprint",
    "could not connect to display",
    "qt.qpa",
    "Qt platform plugin",
    "QStandardPaths",
    "No transform from",
    "Address already in use",
    "Cannot assign requested address",
    "Network is unreachable",
)


def test_the_site_is_built_without_a_warning() -> None:
    run = subprocess.run(
        [str(ROOT / "scripts" / "docs")], stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    assert run.returncode == 0, run.stdout.decode()
    commands = (SITE / "reference" / "commands.html").read_text()
    assert "rosrun ardee_world generate_field" in commands and "pool of crop models" in commands
    keys = (SITE / "reference" / "yaml_keys.html").read_text()
    assert "rows_per_plot" in keys and "lane_width_m" in keys
    launch = (SITE / "reference" / "launch_files.html").read_text()
    assert "start with the clock stopped" in launch
    api = (SITE / "reference" / "python" / "ardee_navigation_lbirnt.html").read_text()
    assert "RowFollower" in api
    for page in ("support.html", "reference/wire_format.html", "tutorials/6_measure_it.html"):
        assert (SITE / page).is_file(), page


def test_each_message_of_the_troubleshooting_page_is_printed_by_something() -> None:
    page = (ROOT / "docs" / "troubleshooting.md").read_text()
    files = [*ROOT.glob("src/**/*"), *ROOT.glob("scripts/*"), *ROOT.glob("compat/**/*")]
    kinds = ("", ".py", ".cpp", ".h", ".bash")
    code = "\n".join(
        file.read_text(errors="replace")
        for file in files
        if file.is_file() and file.suffix in kinds and "test" not in file.parts
    )
    terms = re.findall(r"^(`.*)\n: ", page, re.MULTILINE)
    messages = [message for term in terms for message in re.findall(r"`([^`]+)`", term)]
    assert len(messages) > 40
    for message in messages:
        parts = [part.strip() for part in message.split("...") if len(part.strip()) > 5]
        found = all(part in code for part in parts) or any(words in message for words in OF_OTHERS)
        assert parts and found, message
