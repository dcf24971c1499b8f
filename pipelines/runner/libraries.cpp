// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/libraries.hpp"

#include <gdcmTrace.h>
#include <itkMultiThreaderBase.h>
#include <itkObject.h>
#include <omp.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <vtkObject.h>

#include <cerrno>
#include <cstdint>
#include <exception>
#include <latch>
#include <thread>
#include <vector>

namespace brainshift::pipelines {

namespace {

/// The shortest turn that Linux gives, ns.
constexpr std::uint64_t turn = 100000;

/// Of Linux' sched_setattr(2), in its first version; the C library has no name for it everywhere.
struct SchedulingAttributes {
  std::uint32_t size = sizeof(SchedulingAttributes);
  std::uint32_t policy = SCHED_OTHER;
  std::uint64_t flags = 0;
  std::int32_t nice = 0;
  std::uint32_t priority = 0;
  std::uint64_t runtime = turn;
  std::uint64_t deadline = 0, period = 0;
};

/// How many threads of so many can be made: limits on processes or on memory may not allow them all.
int threads_allowed(int threads) {
  std::vector<std::thread> made;
  std::latch end(1);
  try {
    while (static_cast<int>(made.size()) + 1 < threads) {  // the first is the program's own
      made.emplace_back([&end] { end.wait(); });
    }
  } catch (const std::exception&) {
  }
  end.count_down();
  for (std::thread& thread : made) {
    thread.join();
  }
  return static_cast<int>(made.size()) + 1;
}

}  // namespace

void set_threads(int wanted) {
  const int threads = threads_allowed(wanted);
  const auto count = static_cast<itk::ThreadIdType>(threads);
  omp_set_num_threads(threads);
#pragma omp parallel
  {  // starts them now: where memory lacks later, OpenMP would end the program with words of its own
  }
  itk::MultiThreaderBase::SetGlobalMaximumNumberOfThreads(count);
  itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(count);
}

int threads_in_use() {
  return omp_get_max_threads();
}

void take_short_turns() {
#ifdef SYS_sched_setattr
  errno = 0;
  const int nice = getpriority(PRIO_PROCESS, 0);
  if (errno == 0 && sched_getscheduler(0) == SCHED_OTHER) {
    SchedulingAttributes attributes;
    attributes.nice = nice;
    syscall(SYS_sched_setattr, 0, &attributes, 0U);
  }
#endif
}

void silence_libraries() {
  itk::Object::SetGlobalWarningDisplay(false);
  vtkObject::SetGlobalWarningDisplay(0);
  gdcm::Trace::DebugOff();
  gdcm::Trace::WarningOff();
  gdcm::Trace::ErrorOff();
}

}  // namespace brainshift::pipelines
