// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace ardee {

/// A key that the parser of an element asked for, as a table of keys shows it.
struct AskedKey {
  std::string name;
  std::string kind;      // number, text, ...; empty: the element itself
  std::string fallback;  // what counts without it
  bool is_required = false;
  bool is_ignored = false;  // known, and nothing is done with it
};

/// Keys in the order in which they were first asked for.
class KeyLog {
 public:
  /// What is known of a key when it is asked for again stays; a kind is added to one without.
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
