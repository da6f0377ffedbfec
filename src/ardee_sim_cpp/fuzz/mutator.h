// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace ardee::fuzz {

/// Takes the words of a libFuzzer dictionary (lines of "word") as names of elements to add.
void read_words(const std::string& dictionary_path);

/// Returns the input with a few changes, at most `most` bytes: of XML it moves elements and values,
/// of other text lines and values; empty if it cannot change the input.
std::string mutate_text(const std::string& input, std::size_t most, unsigned seed);

/// Returns `input` with an element of `other` inserted; empty if one of them is not XML.
std::string cross_xml(const std::string& input, const std::string& other, std::size_t most,
                      unsigned seed);

}  // namespace ardee::fuzz
