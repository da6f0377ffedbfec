// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include "ardee_sim/devices/command.h"
#include "ardee_sim/devices/ports.h"

namespace ardee::python {

/// Returns the name of a kind of command, an index in the Command variant, as messages have it.
const char* command_name(std::size_t kind);

/// Returns the command of that kind from Python's value: numbers, lists of them, or a dict. Throws
/// py::type_error that says what was expected.
devices::Command to_command(std::size_t kind, const pybind11::object& value);

/// Calls a service with its arguments, and returns its answer, None or a dict.
pybind11::object call(const devices::Service& service, const pybind11::args& arguments);

}  // namespace ardee::python
