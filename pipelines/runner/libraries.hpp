// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::pipelines {

/// The number of threads of OpenMP and ITK, for all that follows; at least 1. Results do not depend on it.
void set_threads(int threads);

/// Threads that the stages use now.
int threads_in_use();

/// The libraries' own warnings do not reach the screen: our sentence is what the user reads.
void silence_libraries();

}  // namespace brainshift::pipelines
