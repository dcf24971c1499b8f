// SPDX-License-Identifier: GPL-3.0-or-later
//
// What a user starts. OpenMP reads how its threads wait when it is loaded, before main(): so this, which loads nothing,
// sets it, and becomes the program. That takes a millisecond; the program that sets it for itself and starts anew loads
// its hundred libraries twice.
#include <sys/auxv.h>
#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

// A thread that has nothing to do looks so often, some microseconds, before it sleeps: alone that costs nothing
// measurable, and beside a busy process a thread that spins on takes the processor from the one that it waits for.
constexpr const char* spins = "1000";

/// Where the program lies, from the folder of this one: in a build, and where it is installed.
constexpr const char* places[] = {"program/brainshift", BRAINSHIFT_PROGRAM_INSTALLED};

/// Returns where there is no program.
void become(const char* program, char** arguments) {
  char path[PATH_MAX] = {};
  if (realpath(reinterpret_cast<const char*>(getauxval(AT_EXECFN)), path) == nullptr) {
    return;
  }
  char* name = std::strrchr(path, '/') + 1;
  const auto room = static_cast<std::size_t>(path + PATH_MAX - name);
  if (std::snprintf(name, room, "%s", program) < static_cast<int>(room)) {
    execv(path, arguments);
  }
}

}  // namespace

int main(int, char** arguments) {
  if (std::getenv("OMP_WAIT_POLICY") == nullptr && std::getenv("GOMP_SPINCOUNT") == nullptr) {
    setenv("GOMP_SPINCOUNT", spins, 1);
  }
  for (const char* program : places) {
    become(program, arguments);
  }
  std::fprintf(stderr, "brainshift: the program itself cannot be started (%s); build or install brainshift again\n",
               std::strerror(errno));
  return 1;
}
