// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "solve/device/backend.hpp"

namespace brainshift::solve::device {

/// What was allocated on a device; it goes with this.
class Memory {
 public:
  explicit Memory(const Backend& backend) : backend_(backend) {}
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;
  ~Memory() {
    for (void* memory : all_) {
      backend_.release(memory);
    }
  }

  /// Room for so many, zero.
  template <class Number>
  Number* room(std::size_t count) {
    const std::size_t bytes = std::max<std::size_t>(count, 1) * sizeof(Number);
    all_.reserve(all_.size() + 1);
    all_.push_back(backend_.allocate(bytes));
    backend_.clear(all_.back(), bytes);
    bytes_ += bytes;
    return static_cast<Number*>(all_.back());
  }

  /// A copy.
  template <class Number>
  const Number* put(const std::vector<Number>& values) {
    Number* to = room<Number>(values.size());
    backend_.to_device(to, values.data(), values.size() * sizeof(Number));
    return to;
  }

  std::size_t bytes() const { return bytes_; }

 private:
  const Backend& backend_;
  std::vector<void*> all_;
  std::size_t bytes_ = 0;
};

}  // namespace brainshift::solve::device
