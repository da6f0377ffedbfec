// SPDX-License-Identifier: MIT
// Fuzzes the targets: `ardee_fuzzer --target=NAME [libFuzzer's options]`; --list names them.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "fuzz/mutator.h"
#include "fuzz/targets.h"

// Mutator of bytes from libFuzzer.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace {

constexpr unsigned kBytesOneIn = 8;  // one in so many changes is of bytes, whatever their meaning

const ardee::fuzz::Target* chosen = nullptr;

/// Returns the rest of an argument that begins with `option`, or nullptr.
const char* value_of(const char* argument, const char* option) {
  const std::size_t length = std::strlen(option);
  return std::strncmp(argument, option, length) == 0 ? argument + length : nullptr;
}

std::string text_of(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

std::size_t put(const std::string& text, std::uint8_t* data) {
  std::copy(text.begin(), text.end(), data);
  return text.size();
}

}  // namespace

// Assimp leaks some memory when it refuses a broken file, and ODE its work list at an invalid
// number; the leak check is for our own code.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() { return "leak:libassimp\nleak:libode\n"; }

// libFuzzer itself skips arguments that begin with two dashes.
extern "C" int LLVMFuzzerInitialize(int* count, char*** arguments) {
  for (int i = 1; i < *count; ++i) {
    const char* argument = (*arguments)[i];
    if (const char* path = value_of(argument, "-dict=")) ardee::fuzz::read_words(path);
    if (const char* name = value_of(argument, "--target=")) {
      chosen = ardee::fuzz::find_target(name);
    }
    if (std::strcmp(argument, "--list") == 0) {
      for (const auto& target : ardee::fuzz::targets()) std::puts(target.name);
      std::exit(0);
    }
  }
  if (!chosen) {
    std::fputs("expected --target=NAME with one of the names of --list\n", stderr);
    std::exit(2);
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ardee::fuzz::accepts(*chosen, text_of(data, size));
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (seed % kBytesOneIn != 0) {
    const std::string changed = ardee::fuzz::mutate_text(text_of(data, size), most, seed);
    if (!changed.empty()) return put(changed, data);
  }
  return LLVMFuzzerMutate(data, size, most);
}

extern "C" std::size_t LLVMFuzzerCustomCrossOver(const std::uint8_t* first, std::size_t first_size,
                                                 const std::uint8_t* second,
                                                 std::size_t second_size, std::uint8_t* out,
                                                 std::size_t most, unsigned seed) {
  return put(
      ardee::fuzz::cross_xml(text_of(first, first_size), text_of(second, second_size), most, seed),
      out);
}
