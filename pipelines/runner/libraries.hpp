// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::pipelines {

/// The number of threads of OpenMP and ITK, for all that follows; at least 1, and fewer where a limit does not allow as
/// many. Results do not depend on it. Starts those of OpenMP: only once an Interruption is there.
void set_threads(int threads);

/// Threads that the stages use now.
int threads_in_use();

/// Asks the system for short turns on a processor, which all threads made later inherit: as much time in all, but a
/// thread that wakes does not wait for the end of another process's long turn while the other threads wait for it.
/// Linux from 6.12 on does so; others ignore it.
void take_short_turns();

/// The libraries' own warnings do not reach the screen: our sentence is what the user reads.
void silence_libraries();

}  // namespace brainshift::pipelines
