// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "ardee_sim/devices/reading.h"

namespace ardee::python {

/// Returns the name of the Python class of a kind of reading, an index in the Reading variant.
const char* reading_class(std::size_t kind);

/// Returns the fields of a reading, as its Python class takes them. Arrays share its memory.
pybind11::dict reading_fields(const std::shared_ptr<const devices::Reading>& reading);

/// Returns the fields of a contact, as Python's Contact takes them.
pybind11::dict contact_fields(const physics::Contact& contact);

}  // namespace ardee::python
