// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/xml_text.h"

#include <iconv.h>

#include <algorithm>
#include <cerrno>
#include <string_view>

#include "ardee_sim/core/error.h"

namespace ardee {
namespace {

constexpr std::size_t kMaxDepth = 90;  // below tinyxml2's own limit of 100

bool starts_with(std::string_view text, std::string_view part) {
  return text.substr(0, part.size()) == part;
}

Error error_at(std::string_view text, std::size_t at, const std::string& name,
               const std::string& what) {
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<long>(at), '\n');
  return Error(Source{name, static_cast<int>(line), ""}, what);
}

/// The encoding that the first bytes or the XML declaration name; empty for UTF-8 or ASCII.
std::string encoding_of(std::string_view text) {
  if (starts_with(text, "\xFF\xFE") || starts_with(text, "\xFE\xFF")) return "UTF-16";
  if (starts_with(text, std::string_view("<\0", 2))) return "UTF-16LE";
  if (starts_with(text, std::string_view("\0<", 2))) return "UTF-16BE";
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  const std::size_t begin = text.find("<?xml");
  if (begin == std::string_view::npos || std::all_of(text.begin(), text.end(), is_ascii)) return "";
  const std::string_view declaration = text.substr(begin, text.find("?>", begin) - begin);
  const std::size_t key = declaration.find("encoding");
  const std::size_t open = std::min(declaration.find_first_of("'\"", key), declaration.size());
  const std::string_view value = declaration.substr(std::min(open + 1, declaration.size()));
  const std::string encoding(value.substr(0, value.find_first_of("'\"")));
  const bool is_utf8 = encoding == "UTF-8" || encoding == "utf-8";
  return key == std::string_view::npos || is_utf8 ? "" : encoding;
}

std::string to_utf8(std::string text, const std::string& encoding, const std::string& name) {
  const Source source{name, 0, ""};
  const iconv_t converter = iconv_open("UTF-8", encoding.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1)) {
    throw Error(source, "found encoding '" + encoding + "', expected UTF-8 or one that is known");
  }
  std::string converted;
  char* in = text.data();
  std::size_t in_left = text.size();
  bool fits = true;
  while (in_left > 0 && fits) {
    char buffer[4096];
    char* out = buffer;
    std::size_t out_left = sizeof(buffer);
    const std::size_t result = iconv(converter, &in, &in_left, &out, &out_left);
    fits = result != static_cast<std::size_t>(-1) || errno == E2BIG;
    converted.append(buffer, sizeof(buffer) - out_left);
  }
  iconv_close(converter);
  if (!fits)
    throw Error(source, "found bytes that are no " + encoding + ", expected that encoding");
  return converted;
}

/// The position behind `ending`, looked for from `from`, or the end of the text.
std::size_t behind(std::string_view text, std::string_view ending, std::size_t from) {
  const std::size_t found = text.find(ending, from);
  return found == std::string_view::npos ? text.size() : found + ending.size();
}

/// The position behind the tag or document type at `at`. Quoted text does not end it.
std::size_t behind_tag(std::string_view text, std::size_t at) {
  char quote = '\0';
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (quote != '\0') {
      if (c == quote) quote = '\0';
    } else if (c == '"' || c == '\'') {
      quote = c;
    } else if (c == '>') {
      return at + 1;
    }
  }
  return at;
}

void blank(std::string& text, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (text[i] != '\n') text[i] = ' ';
  }
}

/// Removes a document type; refuses one with declarations, which would change the meaning of the
/// text.
std::size_t remove_document_type(std::string& text, std::size_t at, const std::string& name) {
  const std::size_t end = behind_tag(text, at);
  const std::string_view whole = std::string_view(text).substr(at, end - at);
  if (!starts_with(whole, "<!DOCTYPE") || whole.find('[') != std::string_view::npos) {
    throw error_at(text, at, name,
                   "found a declaration of an entity, element or the like, expected none");
  }
  blank(text, at, end);
  return end;
}

}  // namespace

std::string plain_xml(std::string text, const std::string& name) {
  const std::string encoding = encoding_of(text);
  if (!encoding.empty()) text = to_utf8(std::move(text), encoding, name);
  if (const std::size_t nul = text.find('\0'); nul != std::string::npos) {
    throw error_at(text, nul, name, "found a NUL byte, expected text");
  }
  std::size_t depth = 0;
  for (std::size_t at = text.find('<'); at < text.size(); at = text.find('<', at)) {
    const std::string_view rest = std::string_view(text).substr(at);
    if (starts_with(rest, "<!--")) {
      at = behind(text, "-->", at + 4);
    } else if (starts_with(rest, "<![CDATA[")) {
      at = behind(text, "]]>", at + 9);
    } else if (starts_with(rest, "<?")) {
      const std::size_t end = behind(text, "?>", at + 2);
      blank(text, at, end);
      at = end;
    } else if (starts_with(rest, "<!")) {
      at = remove_document_type(text, at, name);
    } else if (starts_with(rest, "</")) {
      depth -= depth > 0 ? 1 : 0;
      at = behind_tag(text, at);
    } else {
      const std::size_t end = behind_tag(text, at);
      if (text[end - 1] != '>' || text[end - 2] != '/') ++depth;
      if (depth > kMaxDepth) {
        throw error_at(text, at, name,
                       "found elements nested more than " + std::to_string(kMaxDepth) +
                           " deep, expected fewer");
      }
      at = end;
    }
  }
  return text;
}

}  // namespace ardee
