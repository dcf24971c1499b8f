// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/external_command.hpp"
#include "segmentation/files/whole_path.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <deque>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace brainshift::pipelines {
namespace {

std::string quoted(const std::filesystem::path& path) {
  std::string text = "'";
  for (const char c : whole_path(path).string()) {
    text += c == '\'' ? "'\\''" : std::string(1, c);
  }
  return text + "'";
}

/// At most the last twenty that are not empty: the folder they lie in goes when the command has failed.
std::string last_lines(const std::filesystem::path& file) {
  constexpr std::size_t most = 20;
  std::ifstream stream(file);
  std::deque<std::string> last;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) {
      last.push_back(line);
    }
    if (last.size() > most) {
      last.pop_front();
    }
  }
  std::string text;
  for (const std::string& line : last) {
    text += (text.empty() ? "" : "\n  ") + line;
  }
  return text;
}

/// In the child: never returns. Only calls that are safe after fork.
[[noreturn]] void become_shell(const char* text, const char* directory, const char* log) {
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  setpgid(0, 0);
  std::signal(SIGPIPE, SIG_DFL);  // the program ignores them
  std::signal(SIGXFSZ, SIG_DFL);
  const int nothing = open("/dev/null", O_RDONLY);  // a command that asks at the terminal would wait for ever
  const int file = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0644);
  if (nothing < 0 || file < 0 || dup2(nothing, STDIN_FILENO) < 0 || dup2(file, STDOUT_FILENO) < 0 ||
      dup2(file, STDERR_FILENO) < 0 || chdir(directory) != 0) {
    _exit(126);
  }
  execl("/bin/sh", "sh", "-c", text, static_cast<char*>(nullptr));
  _exit(127);
}

}  // namespace

std::string fill_in(const ExternalCommand& command) {
  const std::pair<std::string, std::string> places[] = {{"{in}", quoted(command.in)}, {"{out}", quoted(command.out)}};
  std::string text;
  // In one pass: what was put in is not looked at again, whatever the folder's name holds.
  for (std::string_view rest = command.command; !rest.empty();) {
    const auto* place = std::ranges::find_if(places, [&](const auto& p) { return rest.starts_with(p.first); });
    const bool found = place != std::end(places);
    text += found ? place->second : std::string(1, rest.front());
    rest.remove_prefix(found ? place->first.size() : 1);
  }
  return text;
}

void run_external_command(const ExternalCommand& command, Interruption& interruption) {
  const std::string text = fill_in(command);
  const std::string directory = std::filesystem::absolute(command.directory).string();
  const std::string log = (command.out / "command.log").string();
  const pid_t child = fork();
  if (child == 0) {
    become_shell(text.c_str(), directory.c_str(), log.c_str());
  }
  if (child < 0) {
    throw std::runtime_error("the command '" + command.command + "' cannot be started");
  }
  setpgid(child, child);  // as the child does, so that it holds whoever comes first
  interruption.set_command(child);
  int status = 0;
  pid_t ended = 0;
  do {
    ended = waitpid(child, &status, 0);
  } while (ended < 0 && errno == EINTR);
  interruption.set_command(0);
  if (ended < 0) {  // where whoever started the program ignores the end of its children
    throw std::runtime_error("the command '" + command.command + "' ended, but not how: " + std::strerror(errno));
  }
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    const std::string said = last_lines(log);
    throw std::invalid_argument("the command '" + command.command + "' ended with code " + std::to_string(code) +
                                (said.empty() ? ", saying nothing" : ", saying: " + said));
  }
}

}  // namespace brainshift::pipelines
