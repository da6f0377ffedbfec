// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstring>
#include <deque>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "ardee_sim/core/error.h"
#include "ardee_sim/core/pose.h"

namespace ardee {

/// Saves values as bytes, or restores them from these bytes. One function of a class lists its
/// state for both directions, as in Boost.Serialization:
///   void serialize(StateArchive& state) { state(count_, poses_); }
class StateArchive {
 public:
  /// Saves.
  StateArchive() = default;
  /// Restores what an archive of the same objects has saved.
  explicit StateArchive(std::string saved) : bytes_(std::move(saved)), is_restoring_(true) {}

  bool is_restoring() const { return is_restoring_; }
  const std::string& bytes() const { return bytes_; }
  /// Saves or restores values in this order. Throws Error if the bytes end before.
  template <typename... Values>
  void operator()(Values&... values) {
    (transfer(values), ...);
  }
  /// Saves the size of a container, or gives it the saved size.
  template <typename Container>
  void size_of(Container& elements) {
    std::size_t size = elements.size();
    transfer(size);
    if (!is_restoring_) return;
    if (size > bytes_.size()) refuse();
    resize(elements, size);
  }
  /// Throws Error unless all that was saved has been restored.
  void finish() const {
    if (is_restoring_ && next_ != bytes_.size()) refuse();
  }
  /// Throws the Error of a state that does not fit these objects.
  [[noreturn]] static void refuse() {
    throw Error("found a saved state that does not fit, expected one of this world");
  }

 private:
  template <typename T, typename = void>
  struct HasSerialize : std::false_type {};
  template <typename T>
  struct HasSerialize<
      T, std::void_t<decltype(std::declval<T&>().serialize(std::declval<StateArchive&>()))>>
      : std::true_type {};

  void transfer_bytes(void* data, std::size_t size) {
    char* const address = static_cast<char*>(data);
    if (!is_restoring_) {
      bytes_.append(address, size);
      return;
    }
    if (size > bytes_.size() - next_) refuse();
    std::memcpy(address, bytes_.data() + next_, size);
    next_ += size;
  }

  template <typename Container>
  void transfer_elements(Container& elements) {
    size_of(elements);
    for (auto& each : elements) transfer(each);
  }

  /// Elements without a default constructor are there from construction on.
  template <typename Container>
  static void resize(Container& elements, std::size_t size) {
    if constexpr (std::is_default_constructible_v<typename Container::value_type>) {
      elements.resize(size);
    } else if (size != elements.size()) {
      refuse();
    }
  }

  template <typename T>
  void transfer(T& value) {
    if constexpr (HasSerialize<T>::value) {
      value.serialize(*this);
    } else {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>,
                    "expected a number, a plain struct or a class with serialize()");
      transfer_bytes(&value, sizeof value);
    }
  }
  template <typename Scalar, int kRows, int kColumns>
  void transfer(Eigen::Matrix<Scalar, kRows, kColumns>& matrix) {
    static_assert(kRows > 0 && kColumns > 0, "expected a matrix of fixed size");
    transfer_bytes(matrix.data(), sizeof matrix);
  }
  void transfer(Eigen::Quaterniond& quaternion) { transfer(quaternion.coeffs()); }
  void transfer(Pose& pose) { (*this)(pose.p, pose.q); }
  void transfer(Twist& twist) { (*this)(twist.linear, twist.angular); }
  void transfer(std::string& text) { transfer_elements(text); }
  template <typename T>
  void transfer(std::vector<T>& values) {
    transfer_elements(values);
  }
  template <typename T>
  void transfer(std::deque<T>& values) {
    transfer_elements(values);
  }
  template <typename T, std::size_t kSize>
  void transfer(std::array<T, kSize>& values) {
    for (T& each : values) transfer(each);
  }
  template <typename First, typename Second>
  void transfer(std::pair<First, Second>& both) {
    (*this)(both.first, both.second);
  }
  template <typename T>
  void transfer(std::optional<T>& value) {
    if constexpr (std::is_default_constructible_v<T>) {
      bool has_value = value.has_value();
      transfer(has_value);
      if (!has_value) value.reset();
      if (has_value && !value) value.emplace();
    }
    if (value) transfer(*value);
  }
  template <typename... Alternatives>
  void transfer(std::variant<Alternatives...>& value) {
    std::size_t index = value.index();
    transfer(index);
    if (is_restoring_) emplace<0>(value, index);
    std::visit([this](auto& alternative) { transfer(alternative); }, value);
  }
  template <std::size_t kIndex, typename... Alternatives>
  static void emplace(std::variant<Alternatives...>& value, std::size_t index) {
    if constexpr (kIndex == sizeof...(Alternatives)) {
      refuse();
    } else if (index == kIndex) {
      value.template emplace<kIndex>();
    } else {
      emplace<kIndex + 1>(value, index);
    }
  }

  std::string bytes_;
  std::size_t next_ = 0;  // to be restored
  bool is_restoring_ = false;
};

}  // namespace ardee
