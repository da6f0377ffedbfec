// SPDX-License-Identifier: MIT
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

namespace ardee::python {

namespace py = pybind11;

/// Returns a read-only array over memory that `owner` keeps alive, without a copy.
template <typename T>
py::array_t<T> view(const T* data, const std::vector<py::ssize_t>& shape,
                    std::shared_ptr<const void> owner) {
  auto* kept = new std::shared_ptr<const void>(std::move(owner));
  const py::capsule capsule(
      kept, [](void* each) { delete static_cast<std::shared_ptr<const void>*>(each); });
  py::array_t<T> array(shape, data, capsule);
  array.attr("flags").attr("writeable") = false;
  return array;
}

/// Returns a read-only array that owns these values.
template <typename T>
py::array_t<T> hold(std::vector<T> values, const std::vector<py::ssize_t>& shape) {
  const auto owner = std::make_shared<const std::vector<T>>(std::move(values));
  return view(owner->data(), shape, owner);
}

/// Returns a read-only array of one dimension.
template <typename T>
py::array_t<T> hold(std::vector<T> values) {
  const auto size = static_cast<py::ssize_t>(values.size());
  return hold(std::move(values), {size});
}

}  // namespace ardee::python
