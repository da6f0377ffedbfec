// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "ardee_sim/description/model.h"

namespace ardee::python {

/// Binds a model's description as a class; the same description is the same Python object while
/// Python holds it.
void bind_description(pybind11::module_& module);

/// Returns the description as Python holds it.
pybind11::object to_python(const std::shared_ptr<const Model>& model);

}  // namespace ardee::python
