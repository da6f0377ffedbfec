// SPDX-License-Identifier: MIT
#include "ardee_sim/readers/instance_table.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "ardee_sim/core/limits.h"
#include "ardee_sim/readers/limits.h"

namespace ardee {
namespace {

constexpr std::size_t kColumns = 10;
constexpr std::size_t kLongestLine = 1024;
using Fields = std::array<std::string_view, kColumns>;

/// Text with a mark for each unprintable character.
std::string quoted_line(std::string_view text) {
  std::string shown(text);
  std::replace_if(
      shown.begin(), shown.end(), [](unsigned char c) { return c < ' '; }, '?');
  return in_quotes(shown);
}

/// The fields of the present line as values.
class RowReader {
 public:
  RowReader(const std::string& path, int line) : path_(path), line_(line) {}

  Error error(const std::string& what) const { return Error(Source{path_, line_, ""}, what); }

  InstanceRow read(std::string_view line) {
    split(line);
    InstanceRow row;
    row.line = line_;
    row.model = text(0);
    row.name = text(1);
    row.pose =
        Pose::from_xyz_rpy({length(2), length(3), length(4)}, {length(5), length(6), length(7)});
    row.scale = number(8, 0.0, kMaxScale);
    if (!(row.scale > 0.0)) throw unexpected(8, "a positive number");
    const double label = number(9, 0.0, kMaxLabel);
    if (label != std::floor(label)) throw unexpected(9, "a whole number");
    row.label = static_cast<std::uint32_t>(label);
    return row;
  }

 private:
  void split(std::string_view line) {
    const auto count = static_cast<std::size_t>(1 + std::count(line.begin(), line.end(), ','));
    if (count != kColumns) {
      throw error("found " + std::to_string(count) + " columns in " + quoted_line(line) +
                  ", expected " + std::to_string(kColumns) + ": " + std::string(kInstanceColumns));
    }
    for (std::string_view& field : fields_) {
      const std::size_t comma = std::min(line.find(','), line.size());
      field = line.substr(0, comma);
      line.remove_prefix(std::min(comma + 1, line.size()));
    }
  }

  Error unexpected(std::size_t column, const std::string& expected) const {
    std::string_view name = kInstanceColumns;
    for (std::size_t i = 0; i < column; ++i) name.remove_prefix(name.find(',') + 1);
    return error("column " + std::string(name.substr(0, name.find(','))) + ": found " +
                 quoted_line(fields_[column]) + ", expected " + expected);
  }

  std::string_view text(std::size_t column) const {
    if (fields_[column].empty()) throw unexpected(column, "a text");
    return fields_[column];
  }

  double length(std::size_t column) const {
    return number(column, -limits::kAbsurd, limits::kAbsurd);
  }

  double number(std::size_t column, double low, double high) const {
    const std::string_view field = fields_[column];
    const char* const end = field.data() + field.size();
    double value = 0.0;
    const auto [stop, status] = std::from_chars(field.data(), end, value);
    if (status == std::errc() && stop == end && value >= low && value <= high) return value;
    std::ostringstream expected;
    expected << "a number in [" << low << ", " << high << "]";
    throw unexpected(column, expected.str());
  }

  const std::string& path_;
  int line_;
  Fields fields_;
};

/// The lines of a file, one at a time.
class Lines {
 public:
  Lines(const std::string& path, const Source& source) : path_(path) {
    std::error_code error;
    if (std::filesystem::is_regular_file(path, error)) stream_.open(path, std::ios::binary);
    if (!stream_.is_open()) {
      throw Error(source, "cannot read '" + path + "', expected a readable file");
    }
  }

  int number() const { return number_; }

  /// The next line without its end, or false after the last.
  bool next(std::string_view& line) {
    ++number_;
    stream_.getline(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    const auto length = static_cast<std::size_t>(stream_.gcount());
    if (stream_.bad()) throw error("cannot be read, expected a readable file");
    if (stream_.eof()) {
      if (length == 0) return false;
      throw error("found a line without an end, expected a file that is not cut off");
    }
    if (stream_.fail()) {
      throw error("found a line of more than " + std::to_string(kLongestLine) +
                  " bytes, expected a shorter one");
    }
    line = std::string_view(buffer_.data(), length - 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return true;
  }

 private:
  Error error(const std::string& what) const { return Error(Source{path_, number_, ""}, what); }

  const std::string& path_;
  std::ifstream stream_;
  std::array<char, kLongestLine + 1> buffer_{};
  int number_ = 0;
};

}  // namespace

void read_instance_table(const std::string& path, const Source& source,
                         const std::function<void(const InstanceRow&)>& visit) {
  Lines lines(path, source);
  std::string_view line;
  if (!lines.next(line)) line = "";
  if (line != kInstanceColumns) {
    throw RowReader(path, 1).error("found " + quoted_line(line) + ", expected the header '" +
                                   std::string(kInstanceColumns) + "'");
  }
  while (lines.next(line)) visit(RowReader(path, lines.number()).read(line));
}

}  // namespace ardee
