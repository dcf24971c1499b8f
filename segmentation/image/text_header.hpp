// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

// Private: headers that are lines of text, as MetaImage's and NRRD's are.

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace brainshift {

/// The lines at the begin of a file, the voxels being behind them.
class TextHeader {
 public:
  explicit TextHeader(const std::filesystem::path& file);

  /// The next line, without its end; valid as long as this is. Throws std::invalid_argument, naming the file, when none
  /// ends within the first MiB.
  std::string_view next_line();

  /// Where the last line ends, bytes.
  std::uint64_t place() const { return place_; }

 private:
  std::filesystem::path file_;
  std::string text_;
  std::size_t place_ = 0;
};

/// The fields of such a header, and its length.
struct HeaderFields {
  std::map<std::string, std::string> values;
  std::uint64_t length = 0;  ///< bytes

  /// Of the first of these names that is there; empty without one.
  std::string value(std::initializer_list<const char*> names) const;
  std::string value(const char* name) const { return value({name}); }
};

/// Numbers between blanks, also those not finite. Throws std::invalid_argument, naming file and field, when one is none
/// or there are not so many.
std::vector<double> numbers_in(const std::filesystem::path& file, const std::string& field, const std::string& text,
                               std::size_t count);

/// The same, for numbers of voxels.
std::vector<std::uint64_t> counts_in(const std::filesystem::path& file, const std::string& field,
                                     const std::string& text, std::size_t count);

}  // namespace brainshift
