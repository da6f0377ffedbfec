// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace ardee {

/// A key that the parser of an element asked for, as a table of keys shows it.
struct AskedKey {
  std::string name;
  std::string kind;      // number, text, ...; empty: the element itself
  std::string fallback;  // value if the key is absent
  bool is_required = false;
  bool is_ignored = false;  // known, but without effect
};

/// Keys in the order in which they were first asked for.
class KeyLog {
 public:
  /// Adds a key. A repeated key keeps its record; a kind is added to a record without one.
  void add(const AskedKey& key) {
    for (AskedKey& known : keys_) {
      if (known.name != key.name) continue;
      if (known.kind.empty() && !key.kind.empty()) known = key;
      return;
    }
    keys_.push_back(key);
  }
  const std::vector<AskedKey>& keys() const { return keys_; }

 private:
  std::vector<AskedKey> keys_;
};

}  // namespace ardee
