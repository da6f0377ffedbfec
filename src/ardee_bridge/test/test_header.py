# SPDX-License-Identifier: MIT
"""Tests the C header against the codec, as gcc compiles it; its generated parts and the docs' are up to date."""
import enum
import re
import subprocess

import pytest

from ardee_bridge.wire import codec, generate
from ardee_bridge.wire.scales import SCALES

COMPILERS = {
    "c11": ["gcc", "-std=c11", "-x", "c"],
    "c++17": ["g++", "-std=c++17", "-x", "c++"],
}
WARNINGS = ["-Wall", "-Wextra", "-Werror"]


def run_c(body, package, folder, standard):
    """Returns the output of a main() of this body, line by line."""
    source = folder / "main.txt"
    source.write_text(
        "#include <ardee_message.h>\n#include <stdio.h>\n#include <stdlib.h>\n#include <string.h>\nint main(void) {\n"
        + body
        + "\nreturn 0;\n}\n"
    )
    program = folder / "main"
    command = COMPILERS[standard] + WARNINGS + [f"-I{package / 'include'}", str(source)]
    built = subprocess.run(command + ["-o", str(program)], capture_output=True, text=True)
    assert built.returncode == 0, built.stderr
    return subprocess.run([str(program)], check=True, capture_output=True).stdout


@pytest.mark.parametrize("standard", COMPILERS)
def test_sizes_and_offsets_as_compiled(standard, package, tmp_path):
    body, expected = [], []
    for kind in codec.STRUCTS:
        body.append(f'printf("%zu\\n", sizeof({kind.C_NAME}));')
        expected.append(kind.size)
        for leaf in kind.leaves:
            whole = f"offsetof({kind.C_NAME}, {leaf.path})"
            body.append(f'printf("%zu %zu\\n", {whole}, sizeof((({kind.C_NAME}*)0)->{leaf.path}));')
            expected.extend((leaf.offset, leaf.kind.size))
    printed = run_c("\n".join(body), package, tmp_path, standard).split()
    assert [int(number) for number in printed] == expected


@pytest.mark.parametrize("standard", COMPILERS)
def test_constants_as_compiled(standard, package, tmp_path):
    expected = {row.constant: row.counts_per_unit for row in SCALES if row.constant}
    enums = {
        "ARDEE_MESSAGE_": codec.MessageType,
        "ARDEE_DATA_": codec.DataType,
        "ARDEE_MEASUREMENT_": codec.MeasurementType,
        "ARDEE_CONTROL_": codec.ControlCode,
        "ARDEE_IMAGE_": codec.ImageEncoding,
    }
    for prefix, kind in enums.items():
        expected.update({prefix + name: int(value) for name, value in kind.__members__.items()})
    expected.update(
        num_ArdeeDataTypes=11,
        ARDEE_RANGE_TOO_FAR=codec.RANGE_TOO_FAR,
        ARDEE_RANGE_TOO_NEAR=codec.RANGE_TOO_NEAR,
        ARDEE_LIDAR_SLOTS=codec.LIDAR_SLOTS,
        ARDEE_NO_VALUE=codec.LidarData.leaves[0].kind.limits[0],
    )
    body = "\n".join(f'printf("%ld\\n", (long)({name}));' for name in expected)
    printed = run_c(body, package, tmp_path, standard).split()
    assert [int(number) for number in printed] == list(expected.values())


def test_bytes_as_a_c_compiler_writes_them(package, tmp_path):
    body = """
    Ardee_Msg_GPSData gps;
    memset(&gps, 0, sizeof gps);
    gps.latitude = 401234567; gps.velocity.y = -3; gps.covariance_type = 2; gps.service = 513; gps.status = -1;
    fwrite(&gps, sizeof gps, 1, stdout);"""
    velocity = codec.Xyz(y=-3)
    gps = codec.GPSData(
        latitude=401234567, velocity=velocity, covariance_type=2, service=513, status=-1
    )
    assert run_c(body, package, tmp_path, "c11") == gps.pack()


@pytest.mark.parametrize("standard", COMPILERS)
def test_a_motion_is_encoded_as_the_codec_does_and_refused_where_it_is_not_finite(
    standard, package, tmp_path
):
    body = """
    const double none = strtod("nan", NULL), infinite = strtod("inf", NULL);
    const double shares[][2] = {{0.5, -1.0}, {-2.0, 1e300}, {1.0 / 3, -0.1234567}, {none, 0.0},
                                {0.0, none}, {infinite, 0.0}, {0.0, -infinite}};
    for (int i = 0; i < 7; ++i) {
      Ardee_Msg_Data_Header header;
      Ardee_Msg_MotionCommands commands;
      memset(&header, 1, sizeof header);
      memset(&commands, 1, sizeof commands);
      fputc(ardee_encode_motion(shares[i][0], shares[i][1], &header, &commands), stdout);
      fwrite(&header, sizeof header, 1, stdout);
      fwrite(&commands, sizeof commands, 1, stdout);
    }"""
    expected = b""
    for speed, yaw_rate in ((0.5, -1.0), (-1.0, 1.0), (1 / 3, -0.1234567)):
        expected += b"\1" + b"".join(codec.encode_motion(speed, yaw_rate))
    assert run_c(body, package, tmp_path, standard) == expected + 4 * (b"\0" + 32 * b"\1")


def test_every_enumerator_of_the_header_is_in_the_codec(package):
    text = (package / "include" / "ardee_message.h").read_text()
    names = set(re.findall(r"^  ARDEE_([A-Z]+)_([A-Z0-9_]+) = ", text, re.MULTILINE))
    kinds = {
        "MESSAGE": codec.MessageType,
        "DATA": codec.DataType,
        "MEASUREMENT": codec.MeasurementType,
        "CONTROL": codec.ControlCode,
        "IMAGE": codec.ImageEncoding,
    }
    assert all(issubclass(kind, enum.IntEnum) for kind in kinds.values())
    assert names == {(word, name) for word, kind in kinds.items() for name in kind.__members__}


def test_listings_a_16_and_a_17_of_the_thesis_have_the_same_layout(package, tmp_path):
    """Compiles the printed headers in a namespace: each of its structs, fields and enumerators is ours."""
    listings = [
        package.parents[1] / "tests/data/listings" / name for name in ("a_16.txt", "a_17.txt")
    ]
    text = "".join(file.read_text() for file in listings)
    structs = set(re.findall(r"typedef struct (\w+)", text))
    kinds = [kind for kind in codec.STRUCTS if kind.C_NAME in structs]
    assert {kind.C_NAME for kind in kinds} >= {s for s in structs if s.startswith("Ardee_Msg_")}
    enumerators = re.findall(r"^\s*(\w+) = \d+,", text, re.MULTILINE)
    assert len(enumerators) == 11 + 2 + 11 + 2 + 4
    lines = ["#include <ardee_message.h>", "namespace printed {"]
    lines += [f'#include "{file}"' for file in listings] + ["}"]
    pairs = [f"sizeof({{}}{kind.C_NAME})" for kind in kinds]
    pairs += [f"offsetof({{}}{kind.C_NAME}, {leaf.path})" for kind in kinds for leaf in kind.leaves]
    pairs += [f"int({{}}{name})" for name in enumerators]
    lines += [
        f'static_assert({pair.format("printed::")} == {pair.format("")}, "");' for pair in pairs
    ]
    source = tmp_path / "printed.cpp"
    source.write_text("\n".join(lines) + "\n")
    command = ["g++", "-std=c++17", "-fsyntax-only", f"-I{package / 'include'}", str(source)]
    built = subprocess.run(command, capture_output=True, text=True)
    assert built.returncode == 0, built.stderr


def test_generated_parts_are_up_to_date(package):
    for file, text in generate.generated(package).items():
        assert file.read_text() == text, f"{file}: run `rosrun ardee_bridge generate_wire_files`"


def test_documented_sizes_and_types_are_those_of_the_codec(package):
    text = (package / "docs" / "wire_format.md").read_text()
    rows = re.findall(
        r"^\| [\w 2]+?[A-Z_a-z]* \| (\d+) \| (\d+) \| [01] \| .*? \| `(\w+)`, (?:always )?(\d+) bytes",
        text,
        re.MULTILINE,
    )
    documented = {(int(m), int(d)): (name, int(size)) for m, d, name, size in rows}
    expected = {key: (kind.C_NAME, kind.size) for key, kind in codec.DATA_STRUCTS.items()}
    assert documented == expected
