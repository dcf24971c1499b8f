// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <malloc.h>

#include <utility>

namespace brainshift::bench {

/// Bytes of the heap that are in use now, by glibc's own count over all of its arenas and of what it maps.
inline double heap_in_use() {
  const struct mallinfo2 info = ::mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

/// Bytes that a part holds: what the heap gets back when it goes.
template <class Part>
double freed(Part& part) {
  const double before = heap_in_use();
  { const Part gone = std::move(part); }
  return before - heap_in_use();
}

}  // namespace brainshift::bench
