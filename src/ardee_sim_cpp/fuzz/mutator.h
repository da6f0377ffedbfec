// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ardee::fuzz {

/// Takes the words of a libFuzzer dictionary (lines of "word") as names of elements to add.
void read_words(const std::string& dictionary_path);

/// Returns the input with a few changes, at most `most` bytes: moves elements and values of what is
/// XML, lines and values of other text; empty where it can make nothing of the input.
std::string mutate_text(const std::string& input, std::size_t most, unsigned seed);

/// Returns `input` with an element of `other` put into it; empty where one of them is no XML.
std::string cross_xml(const std::string& input, const std::string& other, std::size_t most,
                      unsigned seed);

}  // namespace ardee::fuzz
