// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "segmentation/geometry/points.hpp"

namespace brainshift::solve {

/// Every value begins at a multiple of so many bytes, so that it can be read where it lies.
inline constexpr std::size_t archive_step = alignof(double);

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
  void matrix(const Eigen::MatrixXd& matrix) {
    plain(matrix.rows());
    plain(matrix.cols());
    put(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  }

 private:
  void put(const void* data, std::size_t size) {
    const char* first = static_cast<const char*>(data);
    bytes_.insert(bytes_.end(), first, first + size);
    bytes_.resize((bytes_.size() + archive_step - 1) / archive_step * archive_step);
  }
  std::vector<char>& bytes_;
};

/// Takes them out again in the same order. Throws std::length_error where there are too few.
class ArchiveReader {
 public:
  /// bytes: where a double may lie.
  explicit ArchiveReader(std::span<const char> bytes) : bytes_(bytes) {}

  template <class Value>
  void plain(Value& value) {
    std::memcpy(&value, take(1, sizeof value), sizeof value);
  }
  template <class Value>
  void many(std::vector<Value>& values) {
    std::size_t size = 0;
    plain(size);
    const auto* const first = reinterpret_cast<const Value*>(take(size, sizeof(Value)));
    values.assign(first, first + size);
  }
  void points(Points& points) {
    Eigen::Index rows = 0;
    plain(rows);
    points = Eigen::Map<const Points>(
        reinterpret_cast<const double*>(take(static_cast<std::size_t>(rows), 3 * sizeof(double))), rows, 3);
  }
  void matrix(Eigen::MatrixXd& matrix) {
    Eigen::Index rows = 0, columns = 0;
    plain(rows);
    plain(columns);
    if (columns == 0) {
      matrix.resize(rows, 0);
      return;
    }
    const char* const first = take(static_cast<std::size_t>(rows), static_cast<std::size_t>(columns) * sizeof(double));
    matrix = Eigen::Map<const Eigen::MatrixXd>(reinterpret_cast<const double*>(first), rows, columns);
  }
  bool at_end() const { return bytes_.empty(); }

 private:
  const char* take(std::size_t count, std::size_t size) {
    if (count > bytes_.size() / size) {
      throw std::length_error("kept run");
    }
    const char* const first = bytes_.data();
    const std::size_t steps = (count * size + archive_step - 1) / archive_step;
    bytes_ = bytes_.subspan(std::min(bytes_.size(), steps * archive_step));
    return first;
  }
  std::span<const char> bytes_;
};

}  // namespace brainshift::solve
