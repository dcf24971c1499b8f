// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <numeric>
#include <utility>
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
    for (const Piece& piece : all_) {
      backend_.release(piece.memory);
    }
  }

  /// Room for so many, zero.
  template <class Number>
  Number* room(std::size_t count) {
    const std::size_t bytes = std::max<std::size_t>(count, 1) * sizeof(Number);
    if (used_ == all_.size()) {
      all_.emplace_back();
    }
    Piece& piece = all_[used_++];
    if (piece.bytes < bytes) {
      backend_.release(std::exchange(piece, {}).memory);
      piece.memory = backend_.allocate(bytes);
      piece.bytes = bytes;
    }
    backend_.clear(piece.memory, bytes);
    return static_cast<Number*>(piece.memory);
  }

  /// A copy.
  template <class Number>
  const Number* put(const std::vector<Number>& values) {
    Number* to = room<Number>(values.size());
    backend_.to_device(to, values.data(), values.size() * sizeof(Number));
    return to;
  }

  /// Others in place of what put() has copied, as many.
  template <class Number>
  void replace(const Number* copied, const std::vector<Number>& values) {
    backend_.to_device(const_cast<Number*>(copied), values.data(), values.size() * sizeof(Number));
  }

  /// Pieces in use. After go_back() those beyond are given out once more, one after the other, where they are large
  /// enough: what is put again, of about the same sizes, takes no new memory.
  std::size_t pieces() const { return used_; }
  void go_back(std::size_t pieces) { used_ = pieces; }

  std::size_t bytes() const {
    return std::accumulate(all_.begin(), all_.end(), std::size_t{0},
                           [](std::size_t sum, const Piece& piece) { return sum + piece.bytes; });
  }

 private:
  struct Piece {
    void* memory = nullptr;
    std::size_t bytes = 0;
  };
  const Backend& backend_;
  std::vector<Piece> all_;
  std::size_t used_ = 0;
};

}  // namespace brainshift::solve::device
