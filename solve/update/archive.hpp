// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// Puts values at the end of bytes, as this machine has them in memory.
class ArchiveWriter {
 public:
  explicit ArchiveWriter(std::vector<char>& bytes) : bytes_(bytes) {}

  template <class Value>
  void plain(const Value& value) {
    static_assert(std::is_trivially_copyable_v<Value>);
    put(&value, sizeof value);
  }
  template <class Value>
  void many(const std::vector<Value>& values) {
    static_assert(std::is_trivially_copyable_v<Value>);
    plain(values.size());
    put(values.data(), values.size() * sizeof(Value));
  }
  void points(const Points& points) {
    plain(points.rows());
    put(points.data(), static_cast<std::size_t>(points.size()) * sizeof(double));
  }

 private:
  void put(const void* data, std::size_t size) {
    const char* first = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<char>& bytes_;
};

/// Takes them out again in the same order. Throws std::length_error where there are too few.
class ArchiveReader {
 public:
  explicit ArchiveReader(std::span<const char> bytes) : bytes_(bytes) {}

  template <class Value>
  void plain(Value& value) {
    get(&value, sizeof value);
  }
  template <class Value>
  void many(std::vector<Value>& values) {
    std::size_t size = 0;
    plain(size);
    check(size, sizeof(Value));
    values.resize(size);
    get(values.data(), size * sizeof(Value));
  }
  void points(Points& points) {
    Eigen::Index rows = 0;
    plain(rows);
    check(static_cast<std::size_t>(rows), 3 * sizeof(double));
    points.resize(rows, 3);
    get(points.data(), static_cast<std::size_t>(points.size()) * sizeof(double));
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  void check(std::size_t count, std::size_t size) const {
    if (count > bytes_.size() / size) {
      throw std::length_error("kept run");
    }
  }
  void get(void* data, std::size_t size) {
    check(size, 1);
    if (size > 0) {  // no points lie nowhere
      std::memcpy(data, bytes_.data(), size);
    }
    bytes_ = bytes_.subspan(size);
  }
  std::span<const char> bytes_;
};

}  // namespace brainshift::solve
