// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace brainshift::pipelines {

/// Begins to measure anew, where the system can (Linux).
void reset_peak_memory();

/// The most memory that this process held since the reset, MB; since its start where there is no reset; 0 where the
/// system does not say.
double peak_memory_mb();

/// Memory that can be had without swapping, MB; infinite where the system does not say.
double available_memory_mb();

}  // namespace brainshift::pipelines
