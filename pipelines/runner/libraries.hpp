// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::pipelines {

/// The number of threads of OpenMP and ITK, for all that follows; at least 1, and fewer where a limit does not allow as
/// many. Results do not depend on it. Starts those of OpenMP: only once an Interruption is there.
void set_threads(int threads);

/// Threads that the stages use now.
int threads_in_use();

/// Asks the system for short turns on a processor, which all threads made later and the program that is started anew
/// inherit: as much time in all, but a thread that wakes does not wait for the end of another process's long turn while
/// the other threads wait for it. Linux from 6.12 on does so; others ignore it.
void take_short_turns();

/// A thread that waits for others spins for some microseconds and then sleeps, so that another process on its processor
/// does not hold up all of them. OpenMP reads this when it is loaded: the program starts anew with the setting, unless
/// the user has one. Takes short turns, too. `arguments` are those of main().
void wait_asleep(char** arguments);

/// The libraries' own warnings do not reach the screen: our sentence is what the user reads.
void silence_libraries();

}  // namespace brainshift::pipelines
