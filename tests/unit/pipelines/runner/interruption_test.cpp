// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipelines/runner/interruption.hpp"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

#include "tests/unit/scratch_folder.hpp"

namespace brainshift::pipelines::interruption_test {

/// The exit code of a program of its own that sets up an interruption, whose farewell exits with 100 + the signal, and
/// then does `work`; 1 where nothing interrupted it. hang_up: what it does on SIGHUP, as who starts it has it.
template <class Work>
int exit_code_of(const Work& work, sighandler_t hang_up = SIG_DFL) {
  sigset_t signals, before;  // blocked over the fork: a library may start its threads anew in the child
  sigemptyset(&signals);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    sigaddset(&signals, signal);
  }
  pthread_sigmask(SIG_BLOCK, &signals, &before);
  const pid_t child = fork();
  if (child == 0) {
    std::signal(SIGINT, SIG_DFL);  // a test that runs in the background may ignore it
    std::signal(SIGTERM, SIG_DFL);
    std::signal(SIGQUIT, SIG_DFL);
    std::signal(SIGHUP, hang_up);
    Interruption interruption([](int signal) { _exit(100 + signal); });
    work(interruption);
    _exit(1);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

void interrupt(int signal) {
  kill(getpid(), signal);
  sleep(5);
}

TEST(Interruption, BidsFarewellWithTheSignal) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) {
    EXPECT_EQ(exit_code_of([&](Interruption&) { interrupt(signal); }), 100 + signal);
  }
}

TEST(Interruption, RemovesTheUnfinishedFolderAndNoOther) {
  const brainshift::test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "unfinished/deep");
  std::filesystem::create_directories(scratch / "finished");
  scratch.write("unfinished/deep/file", "x");
  exit_code_of([&](Interruption& interruption) {
    interruption.set_unfinished(scratch / "finished");
    interruption.set_unfinished(scratch / "unfinished");
    interrupt(SIGTERM);
  });
  EXPECT_FALSE(std::filesystem::exists(scratch / "unfinished"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "finished"));
}

TEST(Interruption, RemovesTheScratchFolderToo) {
  const brainshift::test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "unfinished");
  scratch.write("unfinished/file", "x");
  std::filesystem::create_directories(scratch / "scratch/run");
  exit_code_of([&](Interruption& interruption) {
    interruption.set_scratch(scratch / "scratch");
    interruption.set_unfinished(scratch / "unfinished");
    interrupt(SIGTERM);
  });
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path()));
}

TEST(Interruption, LeavesAFolderThatIsNoLongerUnfinished) {
  const brainshift::test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "finished");
  exit_code_of([&](Interruption& interruption) {
    interruption.set_unfinished(scratch / "finished");
    interruption.set_unfinished({});
    interrupt(SIGTERM);
  });
  EXPECT_TRUE(std::filesystem::exists(scratch / "finished"));
}

TEST(Interruption, EndsTheExternalCommand) {
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const int code = exit_code_of([&](Interruption& interruption) {
    const pid_t command = fork();
    if (command == 0) {
      setpgid(0, 0);
      sigset_t none;
      sigemptyset(&none);
      sigprocmask(SIG_SETMASK, &none, nullptr);
      sleep(20);
      _exit(0);
    }
    setpgid(command, command);
    interruption.set_command(command);
    interrupt(SIGINT);
  });
  EXPECT_EQ(code, 100 + SIGINT);
  close(pipe_ends[1]);
  pollfd end{.fd = pipe_ends[0], .events = POLLIN, .revents = 0};
  EXPECT_EQ(poll(&end, 1, 5000), 1) << "the command holds the pipe open as long as it lives";
  close(pipe_ends[0]);
}

TEST(Interruption, WaitsWhileItIsHeld) {
  const brainshift::test::ScratchFolder scratch;
  std::filesystem::create_directories(scratch / "unfinished");
  const int code = exit_code_of([&](Interruption& interruption) {
    interruption.set_unfinished(scratch / "unfinished");
    {
      const auto held = interruption.hold();
      kill(getpid(), SIGTERM);
      usleep(100'000);
      std::filesystem::rename(scratch / "unfinished", scratch / "finished");
    }
    sleep(5);
  });
  EXPECT_EQ(code, 100 + SIGTERM);
  EXPECT_TRUE(std::filesystem::exists(scratch / "finished"));
}

TEST(Interruption, DoesNotHearASignalThatIsIgnored) {
  const auto hang_up = [](Interruption&) {
    kill(getpid(), SIGHUP);
    usleep(150'000);
  };
  EXPECT_EQ(exit_code_of(hang_up, SIG_IGN), 1) << "as nohup starts it";
  EXPECT_EQ(exit_code_of(hang_up, SIG_DFL), 100 + SIGHUP);
}

}  // namespace brainshift::pipelines::interruption_test
