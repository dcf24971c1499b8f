// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/slicer/check_outputs.hpp"

#include <unistd.h>

#include <stdexcept>
#include <system_error>
#include <vector>

#include "pipelines/slicer/description.hpp"
#include "segmentation/files/whole_path.hpp"

namespace brainshift::pipelines {
namespace {

namespace fs = std::filesystem;
using Kind = SlicerParameter::Kind;

struct Given {
  std::string flag;
  fs::path file;
};

[[noreturn]] void refuse_output(const Given& output, const std::string& why) {
  throw std::invalid_argument("--" + output.flag + " is '" + output.file.string() + "', " + why);
}

std::string ending_of_kind(const SlicerParameter& output) {
  for (const auto& [name, ending] : output.attributes) {
    if (name == "fileExtensions") {
      return ending;
    }
  }
  return {};
}

bool may_write_into(const fs::path& folder) {
  return ::access(folder.c_str(), W_OK | X_OK) == 0;
}

/// The folder may be there, or is made with those above it.
void check_folder(const Given& output) {
  std::error_code unknown;
  fs::path there = whole_path(output.file);
  while (!fs::exists(there, unknown) && there.has_relative_path()) {
    there = there.parent_path();
  }
  if (!fs::is_directory(there, unknown)) {
    refuse_output(output, "but " + there.string() + " is a file; name a folder");
  }
  if (!may_write_into(there)) {
    refuse_output(output,
                  "but you may not write into " + there.string() + "; change its permissions, or name another folder");
  }
}

void check_place(const Given& output) {
  std::error_code unknown;
  if (fs::is_directory(output.file, unknown)) {
    refuse_output(output, "which is a folder; name a file");
  }
  const fs::path folder = whole_path(output.file).parent_path();
  if (!fs::is_directory(folder, unknown)) {
    refuse_output(output, "but there is no folder " + folder.string() + "; make it, or name a file elsewhere");
  }
  if (!may_write_into(folder)) {
    refuse_output(output,
                  "but you may not write into its folder; change the folder's permissions, or name a file elsewhere");
  }
}

/// Whether both are one file, by whatever names.
bool is_same_file(const fs::path& a, const fs::path& b) {
  std::error_code unknown;
  return fs::equivalent(a, b, unknown) || whole_path(a) == whole_path(b);
}

std::vector<Given> inputs_of(const std::map<std::string, std::string>& values) {
  std::vector<Given> inputs;
  const auto add = [&](const std::string& flag) {
    if (const auto given = values.find(flag); given != values.end() && !given->second.empty()) {
      inputs.push_back({flag, given->second});
    }
  };
  for_each_parameter(Kind::input, [&](const SlicerParameter& input) { add(input.flag); });
  add("labels_are");  // an option whose value may be a file
  return inputs;
}

}  // namespace

void check_outputs(const std::map<std::string, std::string>& values, const fs::path& return_file) {
  std::vector<Given> files;
  for_each_parameter(Kind::output, [&](const SlicerParameter& output) {
    const auto given = values.find(output.flag);
    if (given == values.end()) {
      return;
    }
    const Given named{output.flag, given->second};
    const std::string ending = ending_of_kind(output);
    if (given->second.empty()) {
      throw std::invalid_argument("--" + output.flag + " is empty; name a " +
                                  (ending.empty() ? "folder" : "file that ends in " + ending) +
                                  ", or leave the option out");
    }
    if (ending.empty()) {
      check_folder(named);
      return;
    }
    if (!given->second.ends_with(ending)) {
      refuse_output(named, "but must end in " + ending);
    }
    files.push_back(named);
  });
  if (!return_file.empty()) {
    files.push_back({"returnparameterfile", return_file});
  }
  std::vector<Given> taken = inputs_of(values);
  const std::size_t inputs = taken.size();
  for (const Given& output : files) {
    check_place(output);
    for (std::size_t i = 0; i < taken.size(); ++i) {
      if (is_same_file(output.file, taken[i].file)) {
        refuse_output(output, "which is --" + taken[i].flag + ", too" +
                                  (i < inputs ? ", and would be written over" : "") + "; name another file");
      }
    }
    taken.push_back(output);
  }
}

}  // namespace brainshift::pipelines
