// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/phantoms/program.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace brainshift {
namespace fs = std::filesystem;

ProgramResult run_shell(const std::string& command) {
  const ScratchFolder scratch;
  const std::string script = "brainshift() { '" BRAINSHIFT_PROGRAM "' \"$@\"; }\n" + command + "\n";
  write_text(scratch / "script", script);
  const std::string line = "/bin/sh " + (scratch / "script").string() + " >" + (scratch / "out").string() + " 2>" +
                           (scratch / "err").string();
  const int status = std::system(line.c_str());
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, bytes_of(scratch / "out"), bytes_of(scratch / "err")};
}

std::vector<std::map<std::string, double>> read_table(const fs::path& file) {
  std::ifstream stream(file);
  const auto fields = [&stream] {
    std::vector<std::string> found;
    std::string line, field;
    while (std::getline(stream, line) && line.starts_with('#')) {
    }
    for (std::istringstream rest(line); std::getline(rest, field, ',');) {
      found.push_back(field);
    }
    return found;
  };
  const std::vector<std::string> names = fields();
  std::vector<std::map<std::string, double>> rows;
  for (auto values = fields(); values.size() == names.size() && stream; values = fields()) {
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size(); ++i) {
      row[names[i]] = std::stod(values[i]);
    }
  }
  return rows;
}

std::vector<std::string> half_written(const fs::path& folder) {
  std::vector<std::string> found;
  const auto look_at = [&](const fs::path& file) {
    const std::string ending = file.extension().string();
    if (ending == ".partial" || ending == ".old" || file.filename().string().find(".part.") != std::string::npos) {
      found.push_back(file.string());
    }
  };
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    look_at(entry.path());
  }
  for (const auto& entry : fs::directory_iterator(folder.parent_path())) {
    if (entry.path().filename().string().starts_with(folder.filename().string() + ".")) {
      look_at(entry.path());
    }
  }
  return found;
}

}  // namespace brainshift
